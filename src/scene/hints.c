/* Hints on lights, colours and the camera. */
#include "scene/hints.h"

#include "scene/geometry.h"
#include "scene/hints_plane.h"
#include "scene/light.h"

/* --- Lights --- */

static bool light_is_black(const Light *light)
{
    return colour_is_black(light->ambient) && colour_is_black(light->diffuse) && colour_is_black(light->specular);
}

/* The box that the light is shut in; -1: none. */
static int box_around(const Scene *scene, const Light *light)
{
    for (int i = 0; i < scene->object_count; i++)
        if (hint_is_in_box(scene, i, light->position) && hint_is_box(scene, i) &&
            !hint_is_in_box(scene, i, scene->camera.position))
            return i;
    return -1;
}

/* What the camera sees of each face, the light is on the other side of. */
static bool is_behind_all(const Scene *scene, const Light *light)
{
    for (int i = 0; i < scene->face_count; i++) {
        const Face *face = &scene->faces[i];
        int eye = plane_side(face, &scene->planes[i], scene->camera.position);
        int side = plane_side(face, &scene->planes[i], light->position);
        if (eye * side > 0 && !(face->one_sided && eye < 0))
            return false;
    }
    return scene->face_count > 0;
}

/* Adds hints on lights that reach nothing. A mirror may show faces from their other sides. Returns through *hidden
 * whether no light reaches what is seen. */
static bool find_lights(Hints *hints, const Scene *scene, bool mirrors, bool *hidden, Error *error)
{
    *hidden = scene->light_count > 0;
    for (int i = 0; i < scene->light_count; i++) {
        const Light *light = &scene->lights[i];
        int box = box_around(scene, light);
        bool behind = box < 0 && !mirrors && is_behind_all(scene, light);
        Hint hint = {box >= 0 ? HINT_LIGHT_IN_BOX : HINT_LIGHT_BEHIND, i, box, 1};
        *hidden = *hidden && (box >= 0 || behind || light_is_black(light));
        if (!light_is_black(light) && (box >= 0 || behind) && !hint_add(hints, hint, error))
            return false;
    }
    return true;
}

/* --- Colours --- */

/* Full strength is 1; more than 8 is hardly meant, and 0 to 255 is what picture programs have. */
static bool looks_like_bytes(Vec3 colour)
{
    double largest = vec3_largest(colour);
    return largest >= 8 && largest <= 255;
}

static bool find_colours(Hints *hints, const Scene *scene, Error *error)
{
    if (looks_like_bytes(scene->shading.background) && !hint_add(hints, (Hint){HINT_COLOUR, -1, -1, 1}, error))
        return false;
    for (int i = 0; i < scene->material_count; i++) {
        const Material *material = &scene->materials[i];
        bool odd = looks_like_bytes(material->ambient) || looks_like_bytes(material->diffuse);
        if (odd && !hint_add(hints, (Hint){HINT_COLOUR, i, -1, 1}, error))
            return false;
    }
    return true;
}

/* --- The camera --- */

/* Is the face outside the pyramid over the screen, all of it on one side? */
static bool is_out_of_view(const View *view, const Face *face)
{
    int outside[5] = {0};
    double distance = vec3_length(view->forward);
    for (int k = 0; k < face->vertex_count; k++) {
        Vec3 v = vec3_sub(face_vertex(face, k), view->eye);
        double ahead = vec3_dot(v, view->forward) / distance, margin = 1e-9 * vec3_length(v);
        double x = vec3_dot(v, view->right), y = vec3_dot(v, view->up);
        double half_width = ahead * view->width / 2 / distance, half_height = ahead * view->height / 2 / distance;
        outside[0] += ahead < -margin;
        outside[1] += x > half_width + margin;
        outside[2] += x < -half_width - margin;
        outside[3] += y > half_height + margin;
        outside[4] += y < -half_height - margin;
    }
    for (int i = 0; i < 5; i++)
        if (outside[i] == face->vertex_count)
            return true;
    return false;
}

static bool is_unseen(const Scene *scene)
{
    View view = view_of(scene);
    for (int i = 0; i < scene->face_count; i++) {
        const Face *face = &scene->faces[i];
        if (is_out_of_view(&view, face))
            continue;
        int side = plane_side(face, &scene->planes[i], scene->camera.position);
        if (side > 0 || (side < 0 && !face->one_sided))
            return false;
    }
    return true;
}

/* --- Black --- */

static bool has_no_colour(const Scene *scene)
{
    for (int i = 0; i < scene->face_count; i++) {
        const Material *material = &scene->materials[scene->faces[i].material];
        if (!colour_is_black(material->ambient) || !colour_is_black(material->diffuse) ||
            !colour_is_black(material->specular))
            return false;
    }
    return true;
}

static bool find_blank(Hints *hints, const Scene *scene, bool hidden, Error *error)
{
    bool unseen = is_unseen(scene), no_light = true;
    if (unseen && scene->face_count > 0 && !hint_add(hints, (Hint){HINT_NO_FACE_SEEN, -1, -1, 1}, error))
        return false;
    for (int i = 0; i < scene->light_count; i++)
        no_light = no_light && light_is_black(&scene->lights[i]);
    hidden = hidden && scene->shading.shadow == SHADOW_BLACK;
    if (!colour_is_black(scene->shading.background) || !(unseen || no_light || hidden || has_no_colour(scene)))
        return true;
    HintBlack reason = unseen     ? BLACK_NO_FACE_SEEN
                       : no_light ? BLACK_NO_LIGHT
                       : hidden   ? BLACK_LIGHTS_HIDDEN
                                  : BLACK_NO_COLOUR;
    return hint_add(hints, (Hint){HINT_BLACK, (int)reason, -1, 1}, error);
}

/* --- All of them --- */

static bool has_mirrors(const Scene *scene)
{
    for (int i = 0; i < scene->face_count; i++)
        if (scene->materials[scene->faces[i].material].reflection > 0)
            return scene->shading.max_bounces > 0;
    return false;
}

bool hints_find(Hints *hints, const Scene *scene, Error *error)
{
    bool hidden;
    *hints = (Hints){0};
    return hints_find_planes(hints, scene, error) && find_colours(hints, scene, error) &&
           find_lights(hints, scene, has_mirrors(scene), &hidden, error) && find_blank(hints, scene, hidden, error);
}

bool hints_find_blank(Hints *hints, const Scene *scene, Error *error)
{
    Hints lights = {0};
    bool hidden;
    *hints = (Hints){0};
    bool good =
        find_lights(&lights, scene, has_mirrors(scene), &hidden, error) && find_blank(hints, scene, hidden, error);
    hints_free(&lights);
    return good;
}

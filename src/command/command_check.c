/* rectray check: reads a scene as render would, and tells what it holds, what rendering it needs and what of it can be
 * left out. With --geometry: every face exactly as it is traced, for programs (docs/commands.md has the format). */
#include "base/text.h"
#include "command/command.h"
#include "reader/scene_json.h"
#include "scene/survey.h"
#include "trace/skip.h"

#include <cjson/cJSON.h>
#include <stdlib.h>

/* --- What it holds --- */

static void print_row(const char *label, const char *unit, int count)
{
    printf("  %-14s%d%s\n", label, count, unit);
}

static void print_position(const char *label, Vec3 p, Vec3 centre)
{
    p = vec3_add(p, centre);
    printf("%s (%g, %g, %g)", label, p.x, p.y, p.z);
}

static void print_contents(const Scene *scene, const Survey *survey)
{
    printf("holds\n");
    printf("  %-14s%d x %d pixels, %d x %d rays each\n", "picture", scene->screen.columns, scene->screen.rows,
           scene->grid, scene->grid);
    printf("  %-14s", "camera");
    print_position("at", scene->camera.position, scene->centre);
    print_position(", looking at", scene->camera.look_at, scene->centre);
    printf("\n");
    print_row("lights", "", scene->light_count);
    print_row("materials", "", scene->material_count);
    print_row("objects", "", scene->object_count);
    print_row("faces", "", survey->numbers);
    if (scene->face_count > survey->numbers)
        print_row("", " traced: faces that are not planar are split in two", scene->face_count);
    if (survey->triangles > 0)
        print_row("", " of them triangles", survey->triangles);
    if (survey->one_sided > 0)
        print_row("", " of them one-sided", survey->one_sided);
    if (survey->mirrors > 0)
        print_row("", " of them reflecting", survey->mirrors);
    const char *shadow = scene_shadow_rules[scene->shading.shadow];
    const char *viewer = scene_viewer_rules[scene->shading.viewer];
    printf("  %-14sshadow %s, viewer %s, at most %d bounces\n", "shading", shadow, viewer, scene->shading.max_bounces);
    print_position("  traced around", scene->centre, vec3(0, 0, 0));
    printf("\n");
}

/* --- What it needs --- */

static void print_needs(const Scene *scene, const Survey *survey)
{
    long long primary = (long long)scene->screen.columns * scene->screen.rows * scene->grid * scene->grid;
    printf("needs\n");
    printf("  primary rays  %lld\n", primary);
    if (survey->shadow_rays)
        printf("  shadow rays   at most %d for each point that is hit\n", scene->light_count);
    if (survey->reflections)
        printf("  reflections   at most %d for each primary ray\n", scene->shading.max_bounces);
}

/* --- What can be skipped --- */

static const char *why_no_reflections(const Scene *scene, const Survey *survey)
{
    if (survey->mirrors == 0)
        return "no face reflects";
    return scene->shading.max_bounces == 0 ? "max_bounces is 0" : "without light every path ends at its first hit";
}

/* These return the number of characters that they printed, as printf does. */

static int print_count(int count, const char *text)
{
    return count > 0 ? printf("  %d %s %s\n", count, count == 1 ? "face" : "faces", text) : 0;
}

static int print_skippable_lights(const Scene *scene, const Survey *survey)
{
    int printed = 0;
    /* A light without colours adds nothing, but under the black rule it may keep a path going. */
    bool useless = !survey->reflections || scene->shading.shadow == SHADOW_AMBIENT;
    if (survey->lights_black > 0)
        printed += printf("  %d of the lights: black%s\n", survey->lights_black,
                          useless ? "" : ", though a path goes on from where they reach");
    if (survey->lights_ambient > 0 && scene->shading.shadow == SHADOW_AMBIENT)
        printed += printf("  shadow rays to %d of the lights: their ambient colour, all they have, always counts\n",
                          survey->lights_ambient);
    return printed;
}

static int print_skippable_faces(const Survey *survey)
{
    return print_count(survey->edge_on, "for primary rays: the camera is in the plane") +
           print_count(survey->back_to_camera, "for primary rays: one-sided, with the camera behind") +
           print_count(survey->behind_camera, "for primary rays: behind the camera") +
           print_count(survey->unreachable, "of these altogether: nothing else sees them, and they block no light");
}

/* Every other face of a closed box. False without memory. */
static bool print_skippable_boxes(const Scene *scene, int *printed, Error *error)
{
    unsigned char *closed = calloc((size_t)scene->face_count + 1, 1);
    if (!closed)
        return error_memory(error, "the boxes of the scene");
    skip_closed_boxes(scene, closed);
    int faces = 0;
    for (int i = 0; i < scene->face_count; i++)
        faces += closed[i] != 0;
    free(closed);
    if (faces > 0)
        *printed += printf("  every other of the %d faces of closed boxes, for the camera and for each light\n", faces);
    return true;
}

static bool print_skippable(const Scene *scene, const Survey *survey, Error *error)
{
    int printed = 0;
    printf("can skip\n");
    if (!survey->shadow_rays)
        printed += printf("  shadow rays: there is no %s\n", scene->face_count == 0 ? "face" : "light");
    if (!survey->reflections)
        printed += printf("  reflected rays: %s\n", why_no_reflections(scene, survey));
    if (survey->shiny == 0)
        printed += printf("  the specular term: no face has a specular colour\n");
    printed += print_skippable_lights(scene, survey);
    for (int i = 0; i < scene->material_count; i++)
        if (!survey->material_used[i])
            printed += printf("  material %s: no face has it\n", text_quote(scene->materials[i].name).text);
    printed += print_skippable_faces(survey);
    if (!print_skippable_boxes(scene, &printed, error))
        return false;
    if (printed == 0)
        printf("  nothing\n");
    return true;
}

/* --- Every face, exactly --- */

/* INDEX and the name as a JSON string, which no line break or quote can leave. */
static bool print_name(const char *keyword, int index, const char *name, Error *error)
{
    char *copy = text_copy(name, error);
    if (!copy)
        return false;
    text_make_utf8(copy);
    cJSON *string = cJSON_CreateStringReference(copy);
    char *text = cJSON_PrintUnformatted(string);
    if (text)
        printf("%s %d %s\n", keyword, index, text);
    cJSON_free(text);
    cJSON_Delete(string);
    free(copy);
    return text ? true : error_memory(error, "a name");
}

static void print_face(const Face *face)
{
    printf("face %d %d %d %s %d", face->number, face->object, face->material, face->one_sided ? "front" : "both",
           face->vertex_count);
    for (int k = 0; k < face->vertex_count; k++)
        for (int i = 0; i < 3; i++)
            printf(" %a", (double)face->vertices[k][i]);
    printf("\n");
}

static bool print_geometry(const Scene *scene, Error *error)
{
    printf("# rectray geometry 1\n");
    printf("centre %a %a %a\n", scene->centre.x, scene->centre.y, scene->centre.z);
    for (int i = 0; i < scene->object_count; i++)
        if (!print_name("object", i, scene->objects[i].name, error))
            return false;
    for (int i = 0; i < scene->material_count; i++)
        if (!print_name("material", i, scene->materials[i].name, error))
            return false;
    for (int i = 0; i < scene->face_count; i++)
        print_face(&scene->faces[i]);
    return true;
}

/* --- The command --- */

static bool print_report(const char *path, const Scene *scene, Error *error)
{
    Survey survey;
    bool done = survey_scene(&survey, scene, error);
    if (done) {
        printf("%s: a valid scene\n", path);
        print_contents(scene, &survey);
        print_needs(scene, &survey);
        done = print_skippable(scene, &survey, error);
    }
    survey_free(&survey);
    return done;
}

bool command_check(const Options *options, Error *error)
{
    Scene scene;
    if (!scene_load(&scene, options->operands[0], error))
        return false;
    bool done = true;
    if (options->geometry)
        done = print_geometry(&scene, error);
    else if (!options->quiet)
        done = print_report(options->operands[0], &scene, error);
    scene_free(&scene);
    return done;
}

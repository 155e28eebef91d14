/* The camera sees a pyramid over the screen. */
#include "scene/hints_view.h"

#include "scene/geometry.h"

enum { FEW_PIXELS = 4 };

/* What the faces in view cover of the screen, in pixels. */
typedef struct Cover {
    double low[2], high[2];
    bool endless; /* a vertex is beside the camera or behind it */
    bool few[2];  /* the picture has so few pixels along the axis that it tells nothing */
} Cover;

/* The place of a vertex before the camera, in pixels from the middle of the screen. */
static void cover_vertex(Cover *cover, const View *view, Vec3 v)
{
    double distance = vec3_length(view->forward), ahead = vec3_dot(v, view->forward) / distance;
    if (!(ahead > 0)) {
        cover->endless = true;
        return;
    }
    const double at[2] = {vec3_dot(v, view->right) / ahead * distance / view->width * view->columns,
                          vec3_dot(v, view->up) / ahead * distance / view->height * view->rows};
    for (int axis = 0; axis < 2; axis++) {
        cover->low[axis] = fmin(cover->low[axis], at[axis]);
        cover->high[axis] = fmax(cover->high[axis], at[axis]);
    }
}

/* Is the face outside the pyramid, all of it on one side? */
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

/* Can a ray from the camera hit the face? */
static bool is_in_view(const Scene *scene, const View *view, int index)
{
    const Face *face = &scene->faces[index];
    if (is_out_of_view(view, face))
        return false;
    int side = plane_side(face, &scene->planes[index], scene->camera.position);
    return side > 0 || (side < 0 && !face->one_sided);
}

/* Between the centres of pixels something that is less than a pixel wide may be seen by no ray. */
static bool is_tiny(const Cover *cover)
{
    for (int axis = 0; axis < 2; axis++)
        if (!cover->endless && !cover->few[axis] && cover->high[axis] - cover->low[axis] < 1)
            return true;
    return false;
}

bool hints_find_view(Hints *hints, const Scene *scene, bool *unseen, Error *error)
{
    View view = view_of(scene);
    Cover cover = {.low = {HUGE_VAL, HUGE_VAL}, .high = {-HUGE_VAL, -HUGE_VAL}};
    cover.few[0] = view.columns < FEW_PIXELS;
    cover.few[1] = view.rows < FEW_PIXELS;
    *unseen = true;
    for (int i = 0; i < scene->face_count && (*unseen || is_tiny(&cover)); i++) {
        if (!is_in_view(scene, &view, i))
            continue;
        *unseen = false;
        for (int k = 0; k < scene->faces[i].vertex_count; k++)
            cover_vertex(&cover, &view, vec3_sub(face_vertex(&scene->faces[i], k), view.eye));
    }
    if (scene->face_count == 0 || (!*unseen && !is_tiny(&cover)))
        return true;
    return hint_add(hints, (Hint){*unseen ? HINT_NO_FACE_SEEN : HINT_TINY, 0, -1, 1}, error);
}

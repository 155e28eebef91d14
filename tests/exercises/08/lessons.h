/* A small tracer made of the three functions, and the pixels of the lessons. Included by test.c alone, after the
 * student's file. */
#ifndef EXERCISE_LESSONS_H
#define EXERCISE_LESSONS_H

#include "exercises/08/judge.h"

/* The side of the plane that a point lies on: the student's distance, and the exact side where it is in doubt. */
static int side_of(const Face *face, const Plane *plane, Vec3 point)
{
    Distance distance = distance_from_plane(face, plane, point);
    return fabs(distance.value) > distance.error ? sign_of(distance.value) : plane_side(face, plane, point);
}

static bool passes_inside(const Face *face, Vec3 o, Vec3 r, int towards)
{
    for (int k = 0; k < face->vertex_count; k++) {
        Vec3 a = face_vertex(face, k), b = face_vertex(face, (k + 1) % face->vertex_count);
        if (side_of_edge(o, r, a, b) * towards < 0)
            return false;
    }
    return true;
}

static int nearest_of(const Scene *scene, Ray ray, double *t)
{
    int nearest = -1;
    *t = HUGE_VAL;
    for (int i = 0; i < scene->face_count; i++) {
        const Face *face = &scene->faces[i];
        const Plane *plane = &scene->planes[i];
        double approach = vec3_dot(plane->normal, ray.direction);
        int towards = sign_of(approach), side = side_of(face, plane, ray.origin);
        if (towards * side >= 0)
            continue;
        double own = -distance_from_plane(face, plane, ray.origin).value / approach;
        if (own < *t && passes_inside(face, ray.origin, ray.direction, towards)) {
            nearest = i;
            *t = own;
        }
    }
    return nearest;
}

static bool is_blocked(const Scene *scene, Vec3 from, Vec3 light)
{
    Vec3 r = vec3_sub(light, from);
    for (int i = 0; i < scene->face_count; i++) {
        const Face *face = &scene->faces[i];
        const Plane *plane = &scene->planes[i];
        int start = side_of(face, plane, from);
        if (start * side_of(face, plane, light) < 0 && passes_inside(face, from, r, -start))
            return true;
    }
    return false;
}

/* A pixel of a scene without mirrors, by the student's three functions. */
static Vec3 student_pixel(const Textbook *textbook, int column, int row, unsigned char rgb[3])
{
    const Scene *scene = textbook->scene;
    View view = view_of(scene);
    view.grid = 1;
    Ray ray = {view.eye, view_direction(&view, column, row, 0, 0)};
    double t;
    int index = nearest_of(scene, ray, &t);
    Vec3 colour = index < 0 ? scene->shading.background : vec3(0, 0, 0);
    if (index >= 0) {
        const Face *face = &scene->faces[index];
        const Plane *plane = &scene->planes[index];
        Vec3 p = vec3_add(ray.origin, vec3_scale(t, ray.direction));
        bool behind = vec3_dot(plane->normal, ray.direction) > 0;
        Vec3 n = behind ? vec3_negate(plane->normal) : plane->normal, v = vec3_unit(vec3_sub(view.eye, p));
        Vec3 shifted = shifted_point(face, plane, n, p);
        for (int i = 0; i < scene->light_count; i++) {
            Vec3 light = scene->lights[i].position;
            int side = side_of(face, plane, light);
            bool reaches = (behind ? -side : side) > 0 && !is_blocked(scene, shifted, light);
            Illumination terms =
                illuminate(&scene->materials[face->material], &scene->lights[i], n, vec3_unit(vec3_sub(light, p)), v);
            colour = vec3_add(colour, terms.ambient);
            if (reaches)
                colour = vec3_add(colour, vec3_add(terms.diffuse, terms.specular));
        }
    }
    rgb[0] = colour_to_byte(colour.x);
    rgb[1] = colour_to_byte(colour.y);
    rgb[2] = colour_to_byte(colour.z);
    return colour;
}

static Vec3 our_pixel(const Textbook *textbook, int column, int row, unsigned char rgb[3])
{
    RenderReport report = {0};
    Scene scene = *textbook->scene;
    scene.grid = 1;
    Tracer tracer = {.scene = &scene, .report = &report};
    Vec3 colour = reference_pixel(&tracer, column, row);
    rgb[0] = colour_to_byte(colour.x);
    rgb[1] = colour_to_byte(colour.y);
    rgb[2] = colour_to_byte(colour.z);
    return colour;
}

/* Rows of a lesson, pixel by pixel, with the student's functions and with ours. */
static void judge_rows(const char *path, int first, int last, int step)
{
    const Scene *scene = scene_of(path);
    RenderReport report = {0};
    Textbook textbook = {.scene = scene, .report = &report};
    for (int row = first; row < last; row += step)
        for (int column = 0; column < scene->screen.columns; column += step) {
            unsigned char theirs[3], ours[3];
            student_pixel(&textbook, column, row, theirs);
            our_pixel(&textbook, column, row, ours);
            Outcome returned = {0}, expected = {0};
            for (int k = 0; k < 3; k++) {
                add_integer(&returned, (const char *[]){"red", "green", "blue"}[k], theirs[k]);
                add_integer(&expected, (const char *[]){"red", "green", "blue"}[k], ours[k]);
            }
            shown_at(path, column, row);
            compare(&returned, &expected);
        }
}

static void acne_is_gone(void)
{
    judge_rows(ACNE, 120, 240, 5);
}

static void cracks_are_gone(void)
{
    judge_rows(CRACKS, 120, 129, 4);
    judge_rows(CRACKS, 30, 31, 2);
}

#endif

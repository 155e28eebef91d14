/* What `rectray check` tells of a valid scene, as text. */
#include "base/text.h"
#include "command/check_report.h"
#include "command/hint_words.h"
#include "opencl/device_scene.h"
#include "trace/adaptive.h"
#include "trace/hints_probe.h"
#include "trace/reference_render.h"
#include "trace/skip.h"

#include <math.h>
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
    printf("  %-14s%d x %d pixels, ", "picture", scene->screen.columns, scene->screen.rows);
    if (scene->adaptive && scene->grid > 1)
        printf("1 ray each, %d where something changes\n", adaptive_samples(scene->grid));
    else
        printf("%d x %d rays each\n", scene->grid, scene->grid);
    printf("  %-14s", "camera");
    print_position("at", scene->camera.position, scene->centre);
    print_position(", looking at", scene->camera.look_at, scene->centre);
    printf("\n");
    print_row("lights", "", scene->light_count);
    print_row("materials", "", scene->material_count);
    print_row("objects", "", scene->object_count);
    if (scene->part_count > 0)
        print_row("", " named parts of models", scene->part_count);
    print_row("faces", "", survey->numbers);
    if (scene->face_count > survey->numbers)
        print_row("", " traced: pieces of faces that were cut", scene->face_count);
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

static void print_needs(const CheckReport *report)
{
    const Scene *scene = report->scene;
    const Survey *survey = &report->survey;
    printf("needs\n");
    if (report->primary_tried > 0)
        printf("  primary rays  about %.2f million: adaptive sampling, estimated from %d pixels\n",
               report->primary_rays / 1e6, report->primary_tried);
    else
        printf("  primary rays  %.0f\n", report->primary_rays);
    if (survey->shadow_rays)
        printf("  shadow rays   at most %d for each point that is hit\n", scene->light_count);
    if (survey->reflections)
        printf("  reflections   at most %d for each primary ray\n", scene->shading.max_bounces);
    printf("  memory        about %.0f MiB to render it on a CPU\n",
           device_scene_process_bytes(scene->face_count) / 1048576);
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

static int print_skippable_lights(const CheckReport *report)
{
    const Scene *scene = report->scene;
    const Survey *survey = &report->survey;
    int printed = 0;
    const char *but = check_black_lights_are_useless(report) ? "" : ", though a path goes on from where they reach";
    if (survey->lights_black > 0)
        printed += printf("  %d of the lights: black%s\n", survey->lights_black, but);
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

static void print_skippable(const CheckReport *report)
{
    const Scene *scene = report->scene;
    const Survey *survey = &report->survey;
    int printed = 0;
    printf("can skip\n");
    if (!survey->shadow_rays)
        printed += printf("  shadow rays: there is no %s\n", scene->face_count == 0 ? "face" : "light");
    if (!survey->reflections)
        printed += printf("  reflected rays: %s\n", why_no_reflections(scene, survey));
    if (survey->shiny == 0)
        printed += printf("  the specular term: no face has a specular colour\n");
    printed += print_skippable_lights(report);
    for (int i = 0; i < scene->material_count; i++)
        if (!survey->material_used[i])
            printed += printf("  material %s: no face has it\n", text_quote(scene->materials[i].name).text);
    printed += print_skippable_faces(survey);
    if (report->closed > 0)
        printed += printf("  every other of the %d faces of closed boxes, for the camera and for each light\n",
                          report->closed);
    if (printed == 0)
        printf("  nothing\n");
}

/* --- All of it --- */

/* A scene that is sampled adaptively is tried on some pixels, for only the picture knows which need more rays. */
static bool count_primary_rays(CheckReport *report, Error *error)
{
    enum { TRIED = 4096 };
    const Scene *scene = report->scene;
    double pixels = (double)scene->screen.columns * scene->screen.rows;
    report->primary_rays = pixels * scene->grid * scene->grid;
    if (!scene->adaptive || scene->grid == 1)
        return true;
    const RenderSettings settings = {.precision = PRECISION_DOUBLE};
    RenderReport trial;
    Accel accel;
    bool done = accel_build(&accel, scene, ACCEL_AUTO, 0, error);
    if (done) {
        report->primary_tried =
            reference_try(scene, &accel, &settings, pixels < TRIED ? (int)pixels : TRIED, HUGE_VAL, &trial);
        report->primary_rays = pixels * (double)trial.rays.primary / report->primary_tried;
    }
    accel_free(&accel);
    return done;
}

bool check_report_make(CheckReport *report, const char *path, const Scene *scene, Error *error)
{
    *report = (CheckReport){.path = path, .scene = scene};
    unsigned char *closed = calloc((size_t)scene->face_count + 1, 1);
    if (!closed)
        return error_memory(error, "the boxes of the scene");
    skip_closed_boxes(scene, closed, 0);
    for (int i = 0; i < scene->face_count; i++)
        report->closed += closed[i] != 0;
    free(closed);
    return count_primary_rays(report, error) && survey_scene(&report->survey, scene, error) &&
           hints_find(&report->hints, scene, error) && hints_probe(&report->hints, scene, false, error);
}

void check_report_free(CheckReport *report)
{
    survey_free(&report->survey);
    hints_free(&report->hints);
    hint_places_free(&report->places);
}

bool check_black_lights_are_useless(const CheckReport *report)
{
    return !report->survey.reflections || report->scene->shading.shadow == SHADOW_AMBIENT;
}

void check_report_text(const CheckReport *report)
{
    printf("%s: a valid scene\n", report->path);
    print_contents(report->scene, &report->survey);
    print_needs(report);
    print_skippable(report);
    if (report->hints.count > 0)
        printf("hints\n");
    for (int i = 0; i < report->hints.count; i++) {
        const Hint *hint = &report->hints.list[i];
        JsonPlace place = hint_place(&report->places, report->scene, hint);
        if (place.line > 0)
            printf("  %s:%ld:%ld: %s\n", report->path, place.line, place.column, hint_words(report->scene, hint).text);
        else
            printf("  %s\n", hint_words(report->scene, hint).text);
    }
}

/* rectray check: reads a scene as render would, and tells what it holds, what rendering it needs and what of it can be
 * left out. With --geometry: every face exactly as it is traced, for programs (docs/commands.md has the format). */
#include "base/text.h"
#include "command/check_report.h"
#include "command/command.h"
#include "command/scene_open.h"
#include "reader/stage.h"

#include <cjson/cJSON.h>
#include <stdlib.h>

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

static bool print_report(const Options *options, const Scene *scene, Error *error)
{
    CheckReport report;
    const char *path = options->operands[0];
    bool done = check_report_make(&report, text_input_name(path), scene, error);
    /* A pipe cannot be read again, and a changed scene has other places. */
    if (done && report.hints.count > 0 && options->edit_count == 0 && !text_is_stream(path) && !stage_is_model(path))
        done = hint_places_read(&report.places, path, error);
    if (done && options->json)
        done = check_report_json(&report, options->verbose, error);
    else if (done)
        check_report_text(&report);
    check_report_free(&report);
    return done;
}

bool command_check(const Options *options, Error *error)
{
    Scene scene;
    bool good =
        scene_open_load(&scene, options, error) && scene_open_tell(&scene.notes, options, options->verbose, error);
    if (good && options->geometry)
        good = print_geometry(&scene, error);
    else if (good && !options->quiet)
        good = print_report(options, &scene, error);
    else if (!good && options->json && !options->geometry && !options->quiet && error->kind == ERROR_INPUT)
        check_refusal_json(options->operands[0], error);
    scene_free(&scene);
    return good;
}

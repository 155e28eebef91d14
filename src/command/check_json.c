/* What `rectray check` tells, as one JSON document: docs/check.schema.json. */
#include "command/check_report.h"
#include "command/hint_words.h"
#include "opencl/device_scene.h"
#include "json/json_node.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>

/* The named parts of models. */
static void add_parts(JsonNode array, const Scene *scene)
{
    for (int i = 0; i < scene->part_count; i++) {
        const ScenePart *part = &scene->parts[i];
        const Object *object = &scene->objects[scene->faces[part->first_face].object];
        int end = object->first_face + object->face_count;
        bool is_last = i + 1 == scene->part_count || scene->parts[i + 1].first_face >= end;
        JsonNode node = json_node_append_object(array);
        json_node_text(node, "object", object->name);
        json_node_text(node, "name", part->name);
        json_node_number(node, "faces_traced", (is_last ? end : scene->parts[i + 1].first_face) - part->first_face);
    }
}

static void add_contents(JsonNode node, const Scene *scene, const Survey *survey)
{
    json_node_number(node, "columns", scene->screen.columns);
    json_node_number(node, "rows", scene->screen.rows);
    json_node_number(node, "grid", scene->grid);
    json_node_bool(node, "adaptive", scene->adaptive);
    JsonNode camera = json_node_object(node, "camera");
    json_node_vector(camera, "position", vec3_add(scene->camera.position, scene->centre));
    json_node_vector(camera, "look_at", vec3_add(scene->camera.look_at, scene->centre));
    json_node_number(node, "lights", scene->light_count);
    json_node_number(node, "materials", scene->material_count);
    json_node_number(node, "objects", scene->object_count);
    add_parts(json_node_array(node, "parts"), scene);
    json_node_number(node, "faces", survey->numbers);
    json_node_number(node, "faces_traced", scene->face_count);
    json_node_number(node, "triangles", survey->triangles);
    json_node_number(node, "one_sided", survey->one_sided);
    json_node_number(node, "reflecting", survey->mirrors);
    json_node_text(node, "shadow", scene_shadow_rules[scene->shading.shadow]);
    json_node_text(node, "viewer", scene_viewer_rules[scene->shading.viewer]);
    json_node_number(node, "max_bounces", scene->shading.max_bounces);
    json_node_vector(node, "centre", scene->centre);
}

static void add_needs(JsonNode node, const CheckReport *report)
{
    const Scene *scene = report->scene;
    const Survey *survey = &report->survey;
    json_node_number(node, "primary_rays", round(report->primary_rays));
    json_node_number(node, "primary_rays_estimated_from", report->primary_tried);
    json_node_number(node, "shadow_rays_of_a_point", survey->shadow_rays ? scene->light_count : 0);
    json_node_number(node, "reflections_of_a_ray", survey->reflections ? scene->shading.max_bounces : 0);
    json_node_number(node, "memory_bytes", round(device_scene_process_bytes(scene->face_count)));
}

static void add_skippable(JsonNode node, const CheckReport *report)
{
    const Scene *scene = report->scene;
    const Survey *survey = &report->survey;
    bool ambient_counts = scene->shading.shadow == SHADOW_AMBIENT;
    json_node_bool(node, "shadow_rays", !survey->shadow_rays);
    json_node_bool(node, "reflected_rays", !survey->reflections);
    json_node_bool(node, "specular", survey->shiny == 0);
    json_node_number(node, "lights_black", check_black_lights_are_useless(report) ? survey->lights_black : 0);
    json_node_number(node, "lights_ambient", ambient_counts ? survey->lights_ambient : 0);
    JsonNode materials = json_node_array(node, "materials");
    for (int i = 0; i < scene->material_count; i++)
        if (!survey->material_used[i])
            json_node_append_text(materials, scene->materials[i].name);
    json_node_number(node, "faces_edge_on", survey->edge_on);
    json_node_number(node, "faces_back_to_camera", survey->back_to_camera);
    json_node_number(node, "faces_behind_camera", survey->behind_camera);
    json_node_number(node, "faces_unreachable", survey->unreachable);
    json_node_number(node, "faces_of_closed_boxes", report->closed);
}

static void add_place(JsonNode node, const NotePlace *place)
{
    if (place->line > 0)
        json_node_number(node, "line", (double)place->line);
    if (place->column > 0)
        json_node_number(node, "column", (double)place->column);
    if (place->detail)
        json_node_text(node, "detail", place->detail);
}

static void add_notes(JsonNode array, const Notes *notes, bool every)
{
    for (int i = 0; i < notes->count; i++) {
        const Note *note = &notes->items[i];
        JsonNode node = json_node_append_object(array);
        json_node_text(node, "kind", note->kind->name);
        json_node_text(node, "file", note->path);
        json_node_number(node, "count", (double)note->count);
        add_place(node, &note->places[0]);
        json_node_text(node, "text", note_summary(note).text);
        JsonNode places = every ? json_node_array(node, "places") : node;
        for (int k = 0; every && k < note->place_count; k++) {
            JsonNode place = json_node_append_object(places);
            add_place(place, &note->places[k]);
            json_node_number(place, "count", (double)note->places[k].count);
        }
    }
}

/* Prints the document and frees it. False without memory. */
static bool print_node(JsonNode node)
{
    char *text = *node.failed ? NULL : cJSON_PrintUnformatted(node.object);
    cJSON_Delete(node.object);
    if (text)
        printf("%s\n", text);
    cJSON_free(text);
    return text != NULL;
}

static JsonNode document(const char *path, bool valid, bool *failed)
{
    JsonNode node = json_node_new(failed);
    json_node_number(node, "check", 1);
    json_node_text(node, "file", path);
    json_node_bool(node, "valid", valid);
    return node;
}

bool check_report_json(const CheckReport *report, bool every, Error *error)
{
    bool failed = false;
    JsonNode node = document(report->path, true, &failed);
    add_contents(json_node_object(node, "holds"), report->scene, &report->survey);
    add_needs(json_node_object(node, "needs"), report);
    add_skippable(json_node_object(node, "can_skip"), report);
    add_notes(json_node_array(node, "notes"), &report->scene->notes, every);
    JsonNode hints = json_node_array(node, "hints");
    for (int i = 0; i < report->hints.count; i++) {
        JsonNode hint = json_node_append_object(hints);
        json_node_text(hint, "kind", hint_names[report->hints.list[i].kind]);
        json_node_text(hint, "text", hint_words(report->scene, &report->hints.list[i]).text);
        JsonPlace place = hint_place(&report->places, report->scene, &report->hints.list[i]);
        if (place.line > 0) {
            json_node_number(hint, "line", (double)place.line);
            json_node_number(hint, "column", (double)place.column);
            json_node_text(hint, "path", place.path);
        }
    }
    return print_node(node) || error_memory(error, "the report as JSON");
}

void check_refusal_json(const char *path, const Error *refusal)
{
    bool failed = false;
    JsonNode node = document(path, false, &failed);
    json_node_text(node, "error", refusal->text);
    print_node(node);
}

/* What grading has found, as JSON. */
#include "grade/grade_report.h"
#include "grade/grade_words.h"
#include "walkthrough/walkthrough_json_event.h"
#include "json/json_node.h"

/* Prints the object and deletes it. */
static bool print(const GradeReport *report, cJSON *object, bool failed, Error *error)
{
    char *text = failed ? NULL : cJSON_Print(object);
    if (text)
        fprintf(report->out, "%s\n", text);
    cJSON_free(text);
    cJSON_Delete(object);
    return text ? true : error_memory(error, "a grade");
}

static void put_slip(JsonNode node, const Slip *slip)
{
    json_node_text(node, "slip", slip->name);
    json_node_text(node, "title", slip->title);
    json_node_text(node, "right", slip->right);
    json_node_text(node, "wrong", slip->wrong);
    json_node_text(node, "read", ink_text("docs/%s", slip->read).text);
    json_node_bool(node, "rounding", slip->rounding);
}

static void put_pixel(JsonNode node, const char *name, int column, int row)
{
    JsonNode pixel = json_node_object(node, name);
    json_node_number(pixel, "column", column);
    json_node_number(pixel, "row", row);
}

static void put_difference(JsonNode node, const Difference *difference)
{
    JsonNode first = json_node_object(node, "difference");
    EventKind kind =
        difference->expected_event != EVENT_KIND_COUNT ? difference->expected_event : difference->given_event;
    json_node_number(first, "after", difference->events);
    json_node_number(first, "hit", difference->hit);
    json_node_text(first, "event", walkthrough_event_name(kind));
    if (difference->kind == DIFFERENCE_VALUE)
        json_node_text(first, "member", difference->member);
    json_node_text(first, "expected", grade_words_expected(difference).text);
    json_node_text(first, "given", grade_words_given(difference).text);
    json_node_text(first, "read", ink_text("docs/%s", grade_words_read(difference)).text);
}

bool grade_report_json(const GradeReport *report, const Grade *grade, Error *error)
{
    bool failed = false;
    JsonNode node = json_node_new(&failed);
    json_node_text(node, "scene", report->scene);
    json_node_text(node, "given", report->given);
    json_node_bool(node, "same", grade->same);
    put_pixel(node, "pixel", grade->walk.request.column, grade->walk.request.row);
    JsonNode tolerance = json_node_object(node, "tolerance");
    json_node_number(tolerance, "absolute", report->tolerance.absolute);
    json_node_number(tolerance, "relative", report->tolerance.relative);
    json_node_number(node, "events", grade->given->count);
    if (grade->difference.kind != DIFFERENCE_NONE)
        put_difference(node, &grade->difference);
    JsonNode causes = json_node_array(node, "causes");
    for (int i = 0; i < grade->cause_count; i++) {
        JsonNode cause = json_node_append_object(causes);
        put_slip(cause, grade->causes[i].slip);
        json_node_bool(cause, "whole", grade->causes[i].rest == DIFFERENCE_NONE);
        json_node_number(cause, "events", grade->causes[i].events);
    }
    json_node_number(node, "more_causes", grade->more_causes);
    return print(report, node.object, failed, error);
}

static void put_bytes(JsonNode node, const char *name, const unsigned char rgb[3])
{
    json_node_vector(node, name, vec3(rgb[0], rgb[1], rgb[2]));
}

bool grade_report_picture_json(const GradeReport *report, const GradePicture *grade, Error *error)
{
    bool failed = false;
    JsonNode node = json_node_new(&failed);
    json_node_text(node, "scene", report->scene);
    json_node_text(node, "picture", report->given);
    json_node_bool(node, "same", grade->differing == 0);
    json_node_number(node, "tolerance", report->tolerance.absolute);
    json_node_number(node, "differing", (double)grade->differing);
    json_node_number(node, "rounded", (double)grade->rounded);
    if (grade->differing > 0) {
        JsonNode first = json_node_object(node, "first");
        put_pixel(first, "tile", grade->column - grade->column % GRADE_TILE, grade->row - grade->row % GRADE_TILE);
        put_pixel(first, "pixel", grade->column, grade->row);
        put_bytes(first, "expected", grade->expected);
        put_bytes(first, "given", grade->given);
    }
    json_node_number(node, "tried", grade->tried);
    json_node_number(node, "equal_tried", grade->equal_tried);
    JsonNode causes = json_node_array(node, "causes");
    for (int i = 0; i < grade->cause_count; i++) {
        JsonNode cause = json_node_append_object(causes);
        put_slip(cause, grade->causes[i].slip);
        json_node_number(cause, "explained", grade->causes[i].explained);
        json_node_number(cause, "kept", grade->causes[i].kept);
    }
    return print(report, node.object, failed, error);
}

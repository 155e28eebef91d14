/* Walks down a text by the steps of a path, and cuts it open where the value stands. */
#include "json/json_edit.h"

#include "base/text.h"
#include "json/json_bulk.h"

#include <cjson/cJSON.h>
#include <stdio.h>
#include <stdlib.h>

enum { STEP_BYTES = 256 };

/* One step of a path: a key, or an index. */
typedef struct Step {
    char key[STEP_BYTES];
    long index; /* -1: a key */
} Step;

static const char *key_step(const char *path, size_t length, Step *step)
{
    if (length == 0 || length >= STEP_BYTES)
        return NULL;
    memcpy(step->key, path, length);
    step->key[length] = '\0';
    step->index = -1;
    return path + length;
}

/* Reads ".key", "key", "[3]" or ["any key"]. Returns where the next step begins, or NULL. */
static const char *next_step(const char *path, bool first, Step *step)
{
    if (path[0] == '[' && path[1] == '"') {
        const char *end = strstr(path, "\"]");
        return end && key_step(path + 2, (size_t)(end - path - 2), step) ? end + 2 : NULL;
    }
    if (path[0] == '[') {
        char *end;
        step->index = number_is_digit(path[1]) ? strtol(path + 1, &end, 10) : -1;
        return step->index >= 0 && *end == ']' ? end + 1 : NULL;
    }
    if (*path == '.' && !first)
        path++;
    else if (!first)
        return NULL;
    return key_step(path, strcspn(path, ".["), step);
}

/* Whether a path leads deeper than a JSON text may go. */
static bool is_too_deep(const char *path)
{
    Step step;
    const char *rest = path;
    for (int i = 0; i < JSON_MAX_DEPTH && rest && *rest; i++)
        rest = next_step(rest, rest == path, &step);
    return rest && *rest;
}

/* Whether a key, with its quotes, is a word. An escape in it is read as cJSON reads it. */
static bool key_is(JsonSpan key, const char *word)
{
    size_t length = (size_t)(key.end - key.begin);
    if (!memchr(key.begin, '\\', length))
        return json_span_is((JsonSpan){key.begin + 1, key.end - 1}, word);
    cJSON *item = cJSON_ParseWithLength(key.begin, length);
    bool same = cJSON_IsString(item) && strcmp(item->valuestring, word) == 0;
    cJSON_Delete(item);
    return same;
}

/* The key at `at`, with its quotes, and in *value where its value begins. Returns the value's end; NULL: there is no
 * key. */
static const char *read_member(const char *at, JsonSpan *key, const char **value)
{
    key->begin = json_blanks(at);
    key->end = *key->begin == '"' ? json_bulk_skip(key->begin) : NULL;
    at = key->end ? json_bulk_mark(key->end, ':') : NULL;
    *value = at ? json_blanks(at) : NULL;
    return at ? json_bulk_skip(at) : NULL;
}

static const char *find_member(const char *object, const char *word, JsonSpan *key)
{
    const char *value;
    for (const char *at = json_bulk_mark(object, '{'); at; at = json_bulk_mark(at, ',')) {
        if (!(at = read_member(at, key, &value)))
            return NULL;
        if (key_is(*key, word))
            return value;
    }
    return NULL;
}

/* Where the value of a member or an element begins; NULL: there is none, or `at` is no object or list. */
static const char *find_child(const char *at, const Step *step)
{
    JsonSpan key;
    if (step->index < 0)
        return find_member(at, step->key, &key);
    at = json_bulk_mark(at, '[');
    for (long i = 0; at; i++) {
        at = json_blanks(at);
        if (i == step->index && *at != ']')
            return at;
        at = json_bulk_skip(at);
        at = at ? json_bulk_mark(at, ',') : NULL;
    }
    return NULL;
}

/* Whether a text is one JSON value and nothing else. */
static bool is_value(const char *text)
{
    return json_scan(text, (long)strlen(text)).place == NULL;
}

/* What is put together from pieces; NULL without memory. */
static char *joined(const char *const *pieces, const size_t *lengths, int count)
{
    size_t length = 0, used = 0;
    for (int i = 0; i < count; i++)
        length += lengths[i];
    char *text = malloc(length + 1);
    for (int i = 0; text && i < count; used += lengths[i++])
        memcpy(text + used, pieces[i], lengths[i]);
    if (text)
        text[length] = '\0';
    return text;
}

/* The text with `value` instead of what stands from `begin` to `end`. */
static char *replaced(const char *text, const char *begin, const char *end, const char *value)
{
    const char *pieces[] = {text, value, end};
    size_t lengths[] = {(size_t)(begin - text), strlen(value), strlen(end)};
    return joined(pieces, lengths, 3);
}

/* Whether a key can be put between quotes as it is. */
static bool is_plain(const char *key)
{
    char quoted[STEP_BYTES + 2];
    snprintf(quoted, sizeof quoted, "\"%s\"", key);
    return !strchr(key, '\\') && is_value(quoted);
}

/* "KEY": VALUE, or with `rest`, further keys of the path, "KEY": {"REST": VALUE}. NULL where a step is no plain
 * key, or without memory. */
static char *new_member(const char *key, const char *rest, const char *value)
{
    Step next;
    const char *after = *rest ? next_step(rest, false, &next) : NULL;
    bool inner = *rest != '\0';
    if (!is_plain(key) || (inner && (!after || next.index >= 0)))
        return NULL;
    char *below = inner ? new_member(next.key, after, value) : NULL;
    if (inner && !below)
        return NULL;
    const char *pieces[] = {"\"", key, inner ? "\": {" : "\": ", inner ? below : value, inner ? "}" : ""};
    size_t lengths[5];
    for (int i = 0; i < 5; i++)
        lengths[i] = strlen(pieces[i]);
    char *text = joined(pieces, lengths, 5);
    free(below);
    return text;
}

/* Adds a member to the object that begins at `object`. */
static char *with_member(const char *text, const char *object, const Step *step, const char *rest, const char *value)
{
    const char *inside = object + 1;
    bool empty = *json_blanks(inside) == '}';
    char *added = new_member(step->key, rest, value);
    if (!added)
        return NULL;
    const char *pieces[] = {text, added, empty ? "" : ", ", inside};
    size_t lengths[] = {(size_t)(inside - text), strlen(added), empty ? 0 : 2, strlen(inside)};
    char *result = joined(pieces, lengths, 4);
    free(added);
    return result;
}

static char *edit(const char *text, const char *path, const char *value, Error *error)
{
    const char *at = json_blanks(text), *rest = path;
    do {
        Step step;
        const char *before = rest, *child;
        rest = next_step(rest, rest == path, &step);
        if (!rest) {
            error_set(error, ERROR_USAGE, "a path is made of keys and indices, such as lights[0].position[1]");
            return NULL;
        }
        child = find_child(at, &step);
        if (!child && step.index < 0 && *at == '{' && error->kind == ERROR_NONE)
            return with_member(text, at, &step, rest, value);
        if (!child) {
            error_set(error, ERROR_USAGE, "%.*s has no %.*s", before == path ? 9 : (int)(before - path),
                      before == path ? "the scene" : path, (int)(rest - before - (*before == '.')),
                      before + (*before == '.'));
            return NULL;
        }
        at = child;
    } while (*rest);
    const char *end = json_bulk_skip(at);
    return end ? replaced(text, at, end, value) : NULL;
}

char *json_edit(const char *text, const char *path, const char *value, Error *error)
{
    char *word = NULL;
    if (is_too_deep(path)) {
        error_set(error, ERROR_USAGE, "a path has at most %d steps", JSON_MAX_DEPTH);
        return NULL;
    }
    if (!is_value(value)) {
        const char *pieces[] = {"\"", value, "\""};
        size_t lengths[] = {1, strlen(value), 1};
        word = joined(pieces, lengths, 3);
        if (!word || !is_value(word)) {
            error_set(error, ERROR_USAGE, "the value is neither JSON nor a plain word");
            free(word);
            return NULL;
        }
    }
    char *result = edit(text, path, word ? word : value, error);
    if (!result && error->kind == ERROR_NONE)
        error_set(error, ERROR_USAGE, "the path does not lead to a value that can be set");
    free(word);
    return result;
}

bool json_has(const char *text, const char *word)
{
    JsonSpan key;
    return find_member(text, word, &key) != NULL;
}

char *json_without(const char *text, const char *word)
{
    JsonSpan key;
    const char *value = find_member(text, word, &key), *end = value ? json_bulk_skip(value) : text;
    if (!value)
        return replaced(text, text, text, "");
    const char *before = key.begin, *after = json_blanks(end);
    while (before[-1] == ' ' || before[-1] == '\t' || before[-1] == '\n' || before[-1] == '\r')
        before--;
    if (before[-1] == ',')
        return replaced(text, before - 1, end, "");
    return replaced(text, key.begin, *after == ',' ? json_blanks(after + 1) : after, "");
}

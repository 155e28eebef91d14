/* JSON with places: loading, and errors that point into the text. */
#include "json/json.h"

#include "base/text.h"
#include "json/json_find.h"
#include "json/json_scan.h"

#include <stdarg.h>
#include <stdlib.h>
#include <string.h>

/* Room for the longest path and what is wrong with it. */
typedef struct Message {
    char text[4096 + 512];
    size_t length;
} Message;

static void append(Message *message, const char *format, ...)
{
    size_t room = sizeof message->text - message->length;
    va_list arguments;
    va_start(arguments, format);
    int length = vsnprintf(message->text + message->length, room, format, arguments);
    va_end(arguments);
    message->length += (size_t)length < room ? (size_t)length : room - 1;
}

/* Whether a byte continues a sequence of UTF-8. */
static bool is_continuation(const char *c)
{
    return ((unsigned char)*c & 0xC0) == 0x80;
}

/* The line of the place, cut to a window of some 100 characters, and a caret on the line below. */
static Message excerpt_of(const Json *json, const char *start_of_line, const char *place)
{
    enum { BEFORE = 70, WINDOW = 100 };
    const char *end = json->text + json->length;
    const char *begin = place - start_of_line > BEFORE ? place - BEFORE : start_of_line;
    const char *stop = begin;
    while (begin < place && is_continuation(begin))
        begin++;
    while (stop < end && *stop != '\n' && *stop != '\r' && stop - begin < WINDOW)
        stop++;
    const char *dots = begin > start_of_line ? "..." : "";
    Message message = {.length = 0};
    append(&message, "  %s", dots);
    for (const char *c = begin; c < stop;) {
        int length = text_utf8_length(c);
        bool shown = length > 0 && c + length <= stop && ((unsigned char)*c >= 0x20 || *c == '\t') && *c != 0x7F;
        append(&message, "%.*s", shown ? length : 1, shown ? c : "?");
        c += shown ? length : 1;
    }
    append(&message, "\n  %*s", (int)strlen(dots), "");
    for (const char *c = begin; c < place; c++)
        if (!is_continuation(c))
            append(&message, "%c", *c == '\t' ? '\t' : ' ');
    append(&message, "^");
    return message;
}

/* The line and column of a place. Returns where its line begins. */
static const char *count_lines(const Json *json, const char *place, long *line, long *column)
{
    const char *start_of_line = json->text;
    *line = *column = 1;
    for (const char *c = json->text; c < place; c++)
        if (*c == '\n') {
            ++*line;
            start_of_line = c + 1;
        }
    for (const char *c = start_of_line; c < place; c++)
        *column += !is_continuation(c);
    return start_of_line;
}

static bool fail_at(const Json *json, const char *place, const char *path, const char *reason)
{
    long line, column;
    const char *start_of_line = count_lines(json, place, &line, &column);
    return error_set(json->error, ERROR_INPUT, "%s:%ld:%ld: %s%s%s\n%s", json->name, line, column, path,
                     *path ? ": " : "", reason, excerpt_of(json, start_of_line, place).text);
}

/* The way from the root to a value, and how many values begin before it. */
typedef struct Search {
    const cJSON *wanted;
    const cJSON *chain[JSON_MAX_DEPTH + 2];
    int depth;
    long values_before;
} Search;

static bool search(Search *found, const cJSON *item)
{
    found->chain[found->depth] = item;
    if (item == found->wanted)
        return true;
    found->values_before++;
    found->depth++;
    for (const cJSON *child = item->child; child; child = child->next)
        if (search(found, child))
            return true;
    found->depth--;
    return false;
}

static bool is_plain_key(const char *key)
{
    size_t length = strspn(key, "abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ_0123456789");
    return length > 0 && length <= 64 && key[length] == '\0';
}

/* objects[2].faces[0], or materials["light grey"].ambient */
static Message path_of(const Search *found)
{
    Message path = {.length = 0};
    for (int i = 1; i <= found->depth; i++) {
        const cJSON *parent = found->chain[i - 1], *item = found->chain[i];
        int index = 0;
        for (const cJSON *child = parent->child; child != item; child = child->next)
            index++;
        if (cJSON_IsArray(parent))
            append(&path, "[%d]", index);
        else if (is_plain_key(item->string))
            append(&path, "%s%s", i > 1 ? "." : "", item->string);
        else
            append(&path, "[%s]", text_quote(item->string).text);
    }
    return path;
}

static bool fail_item(const Json *json, const cJSON *item, bool at_key, const char *format, va_list arguments)
{
    Search found = {.wanted = item};
    search(&found, json->root);
    JsonToken token = json_find_value(json->text, found.values_before);
    Message reason = {.length = 0};
    vsnprintf(reason.text, sizeof reason.text, format, arguments);
    return fail_at(json, at_key && token.key ? token.key : token.value, path_of(&found).text, reason.text);
}

JsonPlace json_place(const Json *json, const cJSON *item)
{
    JsonPlace place;
    Search found = {.wanted = item};
    search(&found, json->root);
    count_lines(json, json_find_value(json->text, found.values_before).value, &place.line, &place.column);
    snprintf(place.path, sizeof place.path, "%.250s", path_of(&found).text);
    return place;
}

bool json_fail(const Json *json, const cJSON *item, const char *format, ...)
{
    va_list arguments;
    va_start(arguments, format);
    bool result = fail_item(json, item, false, format, arguments);
    va_end(arguments);
    return result;
}

bool json_fail_key(const Json *json, const cJSON *item, const char *format, ...)
{
    va_list arguments;
    va_start(arguments, format);
    bool result = fail_item(json, item, true, format, arguments);
    va_end(arguments);
    return result;
}

typedef struct Key {
    const cJSON *item;
    int index; /* among its object's members */
} Key;

static int compare_keys(const void *a, const void *b)
{
    const Key *x = a, *y = b;
    int order = strcmp(x->item->string, y->item->string);
    return order ? order : x->index - y->index;
}

/* Sorts the keys of each object, so that a hostile file with a million of them takes no million squared comparisons. */
static bool check_keys(const Json *json, const cJSON *item)
{
    int count = cJSON_IsObject(item) ? cJSON_GetArraySize(item) : 0;
    if (count > 1) {
        Key *keys = malloc((size_t)count * sizeof *keys);
        if (!keys)
            return error_memory(json->error, "keys");
        int i = 0;
        for (const cJSON *child = item->child; child; child = child->next, i++)
            keys[i] = (Key){child, i};
        qsort(keys, (size_t)count, sizeof *keys, compare_keys);
        Key repeated = {NULL, count};
        for (i = 1; i < count; i++)
            if (strcmp(keys[i].item->string, keys[i - 1].item->string) == 0 && keys[i].index < repeated.index)
                repeated = keys[i];
        free(keys);
        if (repeated.item)
            return json_fail_key(json, repeated.item, "the key stands twice in this object; keep one of the two");
    }
    for (const cJSON *child = item->child; child; child = child->next)
        if (child->child && !check_keys(json, child))
            return false;
    return true;
}

/* Takes over json->text. */
static bool parse(Json *json)
{
    JsonFault fault = json_scan(json->text, json->length);
    bool good = false;
    if (fault.place)
        fail_at(json, fault.place, "", fault.reason);
    else if (!(json->root = cJSON_ParseWithLength(json->text, (size_t)json->length + 1)))
        error_memory(json->error, "the tree of a JSON file"); /* the scan left no other reason */
    else
        good = check_keys(json, json->root);
    if (!good)
        json_free(json);
    return good;
}

bool json_load(Json *json, const char *path, Error *error)
{
    *json = (Json){.name = text_input_name(path), .error = error};
    json->text = text_read_input(path, JSON_MAX_BYTES, &json->length, error);
    return json->text && parse(json);
}

bool json_take(Json *json, const char *name, char *text, long length, Error *error)
{
    *json = (Json){.name = name, .text = text, .length = length, .error = error};
    return parse(json);
}

bool json_parse(Json *json, const char *name, const char *text, long length, Error *error)
{
    *json = (Json){0};
    char *copy = malloc((size_t)length + 1);
    if (!copy)
        return error_memory(error, name);
    memcpy(copy, text, (size_t)length);
    copy[length] = '\0';
    return json_take(json, name, copy, length, error);
}

void json_free(Json *json)
{
    cJSON_Delete(json->root);
    free(json->text);
    *json = (Json){0};
}

/* JSON with places: errors that point into the text. */
#include "json/json.h"

#include "base/text.h"
#include "json/json_find.h"

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
    for (const char *c; (c = memchr(start_of_line, '\n', (size_t)(place - start_of_line))); start_of_line = c + 1)
        ++*line;
    for (const char *c = start_of_line; c < place; c++)
        *column += !is_continuation(c);
    return start_of_line;
}

bool json_fail_at(const Json *json, const char *place, const char *path, const char *reason)
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

/* Appends objects[2].faces[0], or materials["light grey"].ambient. */
static void append_path(Message *path, const Search *found)
{
    for (int i = 1; i <= found->depth; i++) {
        const cJSON *parent = found->chain[i - 1], *item = found->chain[i];
        int index = 0;
        for (const cJSON *child = parent->child; child != item; child = child->next)
            index++;
        if (cJSON_IsArray(parent))
            append(path, "[%d]", index);
        else if (is_plain_key(item->string))
            append(path, "%s%s", path->length > 0 ? "." : "", item->string);
        else
            append(path, "[%s]", text_quote(item->string).text);
    }
}

/* Finds a value of the tree, and its path in the file. */
static JsonToken find(const Json *json, const cJSON *item, Message *path)
{
    Search found = {.wanted = item};
    search(&found, json->root);
    *path = (Message){.length = 0};
    if (json->whole) {
        Search list = {.wanted = json->list};
        search(&list, json->whole->root);
        append_path(path, &list);
        append(path, "[%d]", json->index);
    }
    append_path(path, &found);
    return json_find_value(json->begin, json->cuts, found.values_before);
}

const char *json_where(const Json *json, const cJSON *item)
{
    Message path;
    return find(json, item, &path).value;
}

static bool fail_item(const Json *json, const cJSON *item, bool at_key, const char *format, va_list arguments)
{
    Message path, reason = {.length = 0};
    JsonToken token = find(json, item, &path);
    vsnprintf(reason.text, sizeof reason.text, format, arguments);
    return json_fail_at(json, at_key && token.key ? token.key : token.value, path.text, reason.text);
}

JsonPlace json_place(const Json *json, const cJSON *item)
{
    JsonPlace place;
    Message path;
    count_lines(json, find(json, item, &path).value, &place.line, &place.column);
    snprintf(place.path, sizeof place.path, "%.250s", path.text);
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

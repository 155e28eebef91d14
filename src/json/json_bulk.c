/* Parts of a JSON text: passing over values. */
#include "json/json_bulk.h"

/* What changes the depth, and what has to be looked at: a quote, the end of the text. */
enum { OPENS = 1, CLOSES = -1, STOPS = 2 };

static const signed char kinds[256] = {
    ['['] = OPENS, ['{'] = OPENS, [']'] = CLOSES, ['}'] = CLOSES, ['"'] = STOPS, ['\0'] = STOPS,
};

static const char *skip_string(const char *at)
{
    for (at++; *at != '"'; at++) {
        at += *at == '\\';
        if (*at == '\0')
            return NULL;
    }
    return at + 1;
}

const char *json_bulk_skip(const char *at)
{
    at = json_blanks(at);
    if (*at == '"')
        return skip_string(at);
    if (kinds[(unsigned char)*at] != OPENS) {
        const char *end = at + strcspn(at, " \t\r\n,:[]{}\"");
        return end > at ? end : NULL;
    }
    for (int depth = 0;;) {
        int kind = kinds[(unsigned char)*at];
        if (kind == STOPS) {
            at = *at == '"' ? skip_string(at) : NULL;
            if (!at)
                return NULL;
            continue;
        }
        depth += kind;
        at++;
        if (depth == 0)
            return at;
    }
}

bool json_bulk_keys_differ(const char *at)
{
    enum { FEW = 8 };
    JsonSpan keys[FEW];
    int count = 0;
    at = json_bulk_mark(at, '{');
    for (; at && count < FEW; count++) {
        if (!(at = json_bulk_string(at, &keys[count])) || !(at = json_bulk_mark(at, ':')))
            return false;
        for (int i = 0; i < count; i++)
            if (keys[i].end - keys[i].begin == keys[count].end - keys[count].begin &&
                memcmp(keys[i].begin, keys[count].begin, (size_t)(keys[i].end - keys[i].begin)) == 0)
                return false;
        const char *end = json_bulk_skip(at);
        if (memchr(at, '{', (size_t)(end - at)))
            return false;
        at = json_blanks(end);
        if (*at == '}')
            return true;
        at = json_bulk_mark(at, ',');
    }
    return false;
}

bool json_bulk_find(const char *text, const char *key, JsonSpan *inside)
{
    JsonSpan name;
    for (const char *at = json_bulk_mark(text, '{'); at; at = json_bulk_mark(at, ',')) {
        if (!(at = json_bulk_string(at, &name)) || !(at = json_bulk_mark(at, ':')))
            return false;
        const char *begin = json_blanks(at);
        if (!(at = json_bulk_skip(at)))
            return false;
        if (*begin == '[' && json_span_is(name, key)) {
            *inside = (JsonSpan){begin + 1, at - 1};
            return true;
        }
    }
    return false;
}

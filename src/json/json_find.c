/* A value's place: the text is known to be JSON, so that quotes, brackets and commas are all that is looked at. */
#include "json/json_find.h"

#include <stddef.h>
#include <string.h>

static const char *string_end(const char *at)
{
    for (at++; *at != '"'; at++)
        if (*at == '\\')
            at++;
    return at + 1;
}

JsonToken json_find_value(const char *text, JsonCuts cuts, long values_before)
{
    JsonToken token = {.key = NULL};
    int cut = 0;
    for (const char *at = text;;) {
        if (cut < cuts.count && at == cuts.spans[cut].begin) {
            at = cuts.spans[cut++].end;
            values_before--;
        }
        at += strspn(at, " \t\r\n,:]}");
        const char *end = *at == '"'                 ? string_end(at)
                          : *at == '{' || *at == '[' ? at + 1
                                                     : at + strcspn(at, " \t\r\n,]}");
        if (*at == '"' && end[strspn(end, " \t\r\n")] == ':') {
            token.key = at;
        } else if (values_before-- == 0) {
            token.value = at;
            return token;
        } else
            token.key = NULL;
        at = end;
    }
}

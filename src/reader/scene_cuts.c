/* What a scene file's tree of values does without. */
#include "reader/scene_cuts.h"

#include "base/array.h"

#include <stdlib.h>

static bool add(JsonCuts *cuts, int *capacity, JsonSpan inside, Error *error)
{
    JsonSpan *grown = array_grown(cuts->spans, cuts->count, capacity, sizeof *grown, "lists", error);
    if (!grown)
        return false;
    cuts->spans = grown;
    grown[cuts->count++] = inside;
    return true;
}

/* Adds the lists of the object that begins at `at`. Returns its end; NULL where it is not plain, or without memory. */
static const char *find_lists(const char *at, JsonCuts *cuts, int *capacity, Error *error)
{
    at = json_bulk_mark(at, '{');
    for (bool more = at != NULL; more;) {
        JsonSpan key;
        if (!(at = json_bulk_string(at, &key)) || !(at = json_bulk_mark(at, ':')))
            return NULL;
        const char *begin = json_blanks(at);
        if (!(at = json_bulk_skip(begin)))
            return NULL;
        if (*begin == '[' && (json_span_is(key, "vertices") || json_span_is(key, "faces")) &&
            !add(cuts, capacity, (JsonSpan){begin + 1, at - 1}, error))
            return NULL;
        at = json_blanks(at);
        more = *at == ',';
        at = *at == ',' || *at == '}' ? at + 1 : NULL;
    }
    return at;
}

bool scene_cuts_find(JsonSpan objects, JsonCuts *cuts, Error *error)
{
    int capacity = 0;
    *cuts = (JsonCuts){NULL, 0};
    for (const char *at = objects.begin; at && at < objects.end; at = at ? json_bulk_mark(at, ',') : NULL)
        at = find_lists(at, cuts, &capacity, error);
    if (error->kind == ERROR_NONE)
        return true;
    free(cuts->spans);
    return false;
}

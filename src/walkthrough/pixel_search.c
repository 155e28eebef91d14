/* Finds a pixel that shows something: traces the rays through the centres of pixels and looks at what they meet. */
#include "walkthrough/pixel_search.h"

#include "base/suggest.h"
#include "trace/accel.h"
#include "trace/reference.h"
#include "walkthrough/walkthrough.h"

#include <limits.h>
#include <stdlib.h>
#include <string.h>

enum { FEW_PIXELS = 20000 }; /* so many are searched one by one */

/* What the ray through one centre has met. */
typedef struct Sight {
    bool shown; /* the wished face */
    int bounces;
    bool blocked; /* the wished light, at the first hit */
    double light; /* the sum of the colour */
} Sight;

typedef struct Search {
    const PixelWish *wish;
    int object, face; /* that are wished for; -1: any. `face` is its number in the object */
    const char *part; /* of the object; NULL: any */
    bool in_mirrors;  /* the face may also be a later hit of the path */
    const Scene *whole;
    Scene scene; /* a copy with one ray for each pixel */
    Tracer tracer;
    Sight sight;
} Search;

static bool is_in_part(const Search *search, int face)
{
    const char *part = search->part ? scene_part_of(&search->scene, face) : NULL;
    return !search->part || (part && strcmp(part, search->part) == 0);
}

static bool is_wished(const Search *search, int face)
{
    return search->object < 0 ||
           (search->scene.faces[face].object == search->object && is_in_part(search, face) &&
            (search->face < 0 || walkthrough_face_in_object(&search->scene, face) == search->face));
}

static void look(void *user, const Event *event)
{
    Search *search = user;
    Sight *sight = &search->sight;
    if (event->kind == EVENT_HIT && (event->as.hit.step == 0 || search->in_mirrors))
        sight->shown = sight->shown || is_wished(search, event->as.hit.face);
    else if (event->kind == EVENT_LIGHT_END && sight->bounces == 0)
        sight->blocked = sight->blocked || (event->as.light_end.light == search->wish->blocked_light &&
                                            event->as.light_end.verdict == LIGHT_BLOCKED);
    else if (event->kind == EVENT_REFLECTED)
        sight->bounces = event->as.reflected.bounce;
}

/* Whether the pixel fits; its sight stays in the search. */
static bool fits(Search *search, int column, int row)
{
    const PixelWish *wish = search->wish;
    Sight *sight = &search->sight;
    *sight = (Sight){.shown = false};
    Vec3 colour = reference_sample(&search->tracer, column, row, 0, 0);
    sight->light = colour.x + colour.y + colour.z;
    return (sight->shown || search->object < 0) && (wish->blocked_light < 0 || sight->blocked) &&
           sight->bounces >= wish->mirrors;
}

/* A pixel among those that fit, and how good it is: the least value is the best. */
typedef struct Best {
    int column, row;
    double value; /* HUGE_VAL: none yet */
} Best;

/* The sum of the colour that the picture has there, with all rays of the pixel. */
static double light_of(const Search *search, int column, int row)
{
    Tracer tracer = search->tracer;
    tracer.scene = search->whole;
    tracer.recorder = NULL;
    Vec3 colour = reference_pixel(&tracer, column, row);
    return colour.x + colour.y + colour.z;
}

/* Takes the pixel if it fits and is better than the best one. With a centre, the value is the distance from there; else
 * the light. Of pixels whose centre is lighter than the best one, only the centre is looked at. */
static void take_better(Search *search, Best *best, int column, int row, const Best *centre)
{
    double value = centre ? hypot(column - centre->column, row - centre->row) : 0;
    if (value >= best->value || !fits(search, column, row))
        return;
    if (!centre && search->sight.light < best->value)
        value = light_of(search, column, row);
    else if (!centre)
        return;
    if (value < best->value)
        *best = (Best){column, row, value};
}

/* The best of a grid of pixels `step` apart. */
static Best search_grid(Search *search, int step, const Best *centre)
{
    Best best = {.value = HUGE_VAL};
    const Screen *screen = &search->scene.screen;
    for (int row = step / 2; row < screen->rows; row += step)
        for (int column = step / 2; column < screen->columns; column += step)
            take_better(search, &best, column, row, centre);
    return best;
}

/* Goes on to the darkest of the pixels around as long as there is a darker one. */
static Best search_around(Search *search, Best best, int reach)
{
    const Screen *screen = &search->scene.screen;
    for (Best place = {.value = HUGE_VAL}; best.value < place.value;) {
        place = best;
        for (int row = place.row - reach; row <= place.row + reach; row++)
            for (int column = place.column - reach; column <= place.column + reach; column++)
                if (row >= 0 && row < screen->rows && column >= 0 && column < screen->columns)
                    take_better(search, &best, column, row, NULL);
    }
    return best;
}

/* The middle of those that fit; its value is HUGE_VAL where none does. */
static Best middle_of(Search *search, int step)
{
    double columns = 0, rows = 0, count = 0;
    const Screen *screen = &search->scene.screen;
    for (int row = step / 2; row < screen->rows; row += step)
        for (int column = step / 2; column < screen->columns; column += step)
            if (fits(search, column, row)) {
                columns += column;
                rows += row;
                count++;
            }
    return (Best){(int)(columns / fmax(count, 1)), (int)(rows / fmax(count, 1)), count > 0 ? 0 : HUGE_VAL};
}

static Best search_all(Search *search, int step)
{
    if (search->wish->darkest)
        return search_around(search, search_grid(search, step, NULL), step - 1);
    Best middle = middle_of(search, step);
    return middle.value < HUGE_VAL ? search_grid(search, step, &middle) : middle;
}

/* Whether the first `length` characters are "OBJECT", or "OBJECT: PART" where there is a part. */
static bool is_called(const char *object, const char *part, const char *name, size_t length)
{
    size_t begin = strlen(object), whole = part ? begin + 2 + strlen(part) : begin;
    return length == whole && strncmp(name, object, begin) == 0 &&
           (!part || (strncmp(name + begin, ": ", 2) == 0 && strncmp(name + begin + 2, part, strlen(part)) == 0));
}

static void find_owner(Search *search, const Scene *scene, const char *name, size_t length)
{
    for (int i = 0; i < scene->object_count && search->object < 0; i++)
        if (is_called(scene->objects[i].name, NULL, name, length))
            search->object = i;
    for (int i = 0; i < scene->part_count && search->object < 0; i++) {
        int object = scene->faces[scene->parts[i].first_face].object;
        if (is_called(scene->objects[object].name, scene->parts[i].name, name, length)) {
            search->object = object;
            search->part = scene->parts[i].name;
        }
    }
}

/* Says that no object is called so, and which one may be meant. */
static bool refuse_name(const Scene *scene, const char *name, size_t length, Error *error)
{
    const char **known = calloc((size_t)scene->object_count + 1, sizeof *known);
    char *word = strndup(name, length);
    const char *meant = NULL;
    for (int i = 0; known && i < scene->object_count; i++)
        known[i] = scene->objects[i].name;
    if (known && word)
        meant = suggest_word(word, known);
    if (meant)
        error_set(error, ERROR_USAGE, "--face '%s': no object has that name; did you mean '%s'?", name, meant);
    else
        error_set(error, ERROR_USAGE, "--face '%s': no object has that name; `rectray check` counts them", name);
    free(word);
    free(known);
    return false;
}

/* Finds the object, its part, and the number of the face in it, that the wish names. */
static bool find_face(Search *search, const Scene *scene, Error *error)
{
    const char *name = search->wish->face;
    search->object = search->face = -1;
    if (!name)
        return true;
    const char *slash = strrchr(name, '/');
    char *end = NULL;
    long number = slash ? strtol(slash + 1, &end, 10) : -1;
    bool numbered = slash && end != slash + 1 && *end == '\0' && number >= 0;
    size_t length = numbered ? (size_t)(slash - name) : strlen(name);
    find_owner(search, scene, name, length);
    if (search->object < 0)
        return refuse_name(scene, name, length, error);
    search->face = !numbered ? -1 : number < INT_MAX ? (int)number : INT_MAX;
    const Object *object = &scene->objects[search->object];
    int last =
        object->face_count > 0 ? walkthrough_face_in_object(scene, object->first_face + object->face_count - 1) : -1;
    return search->face <= last ||
           error_set(error, ERROR_USAGE, "--face '%s': the last face of that object is %d", name, last);
}

bool pixel_search(const Scene *scene, const PixelWish *wish, int *column, int *row, Error *error)
{
    Search search = {.wish = wish, .whole = scene, .scene = *scene};
    Accel accel;
    if (!find_face(&search, scene, error) || !accel_build(&accel, scene, ACCEL_AUTO, 1, error))
        return false;
    search.scene.grid = 1;
    RenderReport report = {0};
    Recorder recorder = {look, &search};
    search.tracer = (Tracer){.scene = &search.scene, .accel = &accel, .report = &report, .recorder = &recorder};
    int step = 1;
    while (((double)scene->screen.columns / step) * ((double)scene->screen.rows / step) > FEW_PIXELS)
        step++;
    /* First coarsely, directly, then in mirrors; then pixel by pixel. */
    Best best = {.value = HUGE_VAL};
    for (int k = 0; k < 4 && best.value == HUGE_VAL; k++) {
        search.in_mirrors = k % 2 == 1;
        if ((k < 2 || step > 1) && (!search.in_mirrors || wish->face))
            best = search_all(&search, k < 2 ? step : 1);
    }
    accel_free(&accel);
    *column = best.column;
    *row = best.row;
    return best.value < HUGE_VAL || error_set(error, ERROR_USAGE, "no pixel shows that through its centre");
}

/* Two walkthroughs event by event. Both lists have the same order: sampling, the point of the screen, then hit by hit
 * the search, the hit, the lights, what it adds, the mirror; the end, the bytes. So they are merged as sorted lists
 * are: the event whose key is smaller is one that the other walkthrough has not. */
#include "walkthrough/walkthrough_diff_events.h"

#include "walkthrough/walkthrough_words.h"

#include <limits.h>
#include <string.h>

enum { SIDES = 2, DIGITS = 4, LABEL = 18, ROWS = 3, NAME = 24 };

/* --- The order of events --- */

typedef enum Phase { PHASE_SEARCH, PHASE_HIT, PHASE_LIGHT, PHASE_SUM, PHASE_MIRROR } Phase;

typedef struct Key {
    int hit; /* -1: before the path, INT_MAX: after it */
    Phase phase;
    int light, part;
} Key;

/* Where one of the walkthroughs is. */
typedef struct Cursor {
    const Walkthrough *walk;
    long next;          /* in its list */
    const Event *event; /* NULL: the list has ended */
    double blocker;     /* t of the face that the latest shadow ray met */
    WalkthroughPlace place;
    Key key;
} Cursor;

static int compare(const Key *a, const Key *b)
{
    const int pairs[4][2] = {
        {a->hit, b->hit}, {(int)a->phase, (int)b->phase}, {a->light, b->light}, {a->part, b->part}};
    for (int i = 0; i < 4; i++)
        if (pairs[i][0] != pairs[i][1])
            return pairs[i][0] < pairs[i][1] ? -1 : 1;
    return 0;
}

/* False for events that have no row. */
static bool key_of(const Cursor *cursor, const Event *event, Key *key)
{
    int hit = walkthrough_hit_number(&cursor->place),
        light = cursor->place.light ? cursor->place.light->as.light.light : 0;
    bool told = cursor->place.told;
    switch (event->kind) {
    case EVENT_ADAPTIVE:
        *key = (Key){-1, PHASE_SEARCH, 0, 0};
        return true;
    case EVENT_SAMPLE:
        *key = (Key){-1, PHASE_HIT, 0, 0};
        return told;
    case EVENT_TALLY:
        *key = event->as.tally.shadow ? (Key){hit, PHASE_LIGHT, light, 0} : (Key){hit + 1, PHASE_SEARCH, 0, 0};
        return told;
    case EVENT_HIT:
        *key = (Key){hit, PHASE_HIT, 0, 0};
        return told;
    case EVENT_MISS:
        *key = (Key){hit + 1, PHASE_HIT, 0, 0};
        return told;
    case EVENT_LIGHT_END:
        *key = (Key){hit, PHASE_LIGHT, light, 1};
        return told;
    case EVENT_TERMS:
        *key = (Key){hit, PHASE_LIGHT, light, 2};
        return told;
    case EVENT_SHADED:
        *key = (Key){hit, PHASE_SUM, 0, 0};
        return told;
    case EVENT_REFLECTED:
        *key = (Key){hit, PHASE_MIRROR, 0, 0};
        return told;
    case EVENT_PATH_END:
        *key = (Key){INT_MAX, PHASE_SEARCH, 0, 0};
        return told;
    case EVENT_PIXEL:
        *key = (Key){INT_MAX, PHASE_SUM, 0, 0};
        return true;
    default:
        return false;
    }
}

static void advance(Cursor *cursor)
{
    for (cursor->event = NULL; cursor->next < cursor->walk->count && !cursor->event;) {
        const Event *event = &cursor->walk->events[cursor->next++];
        walkthrough_follow(&cursor->place, cursor->walk, event);
        if (event->kind == EVENT_OCCLUDER && event->as.occluder.test.verdict == FACE_INSIDE)
            cursor->blocker = event->as.occluder.test.t;
        if (key_of(cursor, event, &cursor->key))
            cursor->event = event;
    }
}

/* --- Events in words --- */

/* What an event says: up to three rows. */
typedef struct EventRows {
    InkText labels[ROWS], words[ROWS];
    int count;
} EventRows;

static void add(EventRows *rows, InkText label, InkText words)
{
    rows->labels[rows->count] = label;
    rows->words[rows->count++] = words;
}

static void say_search(EventRows *rows, const Cursor *cursor, const Event *event)
{
    int nodes = event->as.tally.nodes_met, tested = event->as.tally.tested;
    InkText words = ink_text("%d face%s", tested, tested == 1 ? "" : "s");
    if (nodes > 0)
        words = ink_text("%s, %d node%s", words.text, nodes, nodes == 1 ? "" : "s");
    if (event->as.tally.shadow)
        add(rows, ink_text("P%d light %d tests", cursor->key.hit, cursor->key.light), words);
    else
        add(rows, ink_text("P%d tests", cursor->key.hit), words);
}

static void say_hit(EventRows *rows, const Cursor *cursor, const Event *event)
{
    const Scene *scene = cursor->walk->scene;
    int hit = cursor->key.hit;
    add(rows, ink_text("P%d", hit), walkthrough_face_words(scene, event->as.hit.face, NAME));
    add(rows, ink_text("P%d t", hit), ink_number(event->as.hit.test.t, DIGITS));
    add(rows, ink_text("P%d at", hit), ink_vector(walkthrough_world(scene, event->as.hit.point), DIGITS));
}

static void say_light(EventRows *rows, const Cursor *cursor, const Event *event)
{
    InkText words = ink_text("reaches it");
    if (event->as.light_end.verdict == LIGHT_BEHIND_FACE)
        words = ink_text(cursor->place.light->as.light.side < 0 ? "behind the face" : "in the face's plane");
    else if (event->as.light_end.verdict == LIGHT_BLOCKED)
        words = ink_text("blocked by %s, t = %s",
                         walkthrough_face_words(cursor->walk->scene, event->as.light_end.blocker, NAME).text,
                         ink_number(cursor->blocker, DIGITS).text);
    add(rows, ink_text("P%d light %d", cursor->key.hit, cursor->key.light), words);
}

static void say_terms(EventRows *rows, const Cursor *cursor, const Event *event)
{
    const Illumination *terms = &event->as.terms.illumination;
    InkText label = ink_text("P%d light %d", cursor->key.hit, cursor->key.light);
    if (!event->as.terms.ambient_only)
        add(rows, ink_text("%s dots", label.text),
            ink_text("L.N %s, N.H %s", ink_number(terms->l_dot_n, DIGITS).text,
                     ink_number(terms->n_dot_h, DIGITS).text));
    add(rows, ink_text("%s I", label.text), ink_vector(event->as.terms.sum, DIGITS));
}

static EventRows rows_of(const Cursor *cursor)
{
    const Event *event = cursor->event;
    const unsigned char *rgb = event->as.pixel.rgb;
    EventRows rows = {.count = 0};
    int hit = cursor->key.hit;
    switch (event->kind) {
    case EVENT_ADAPTIVE:
        add(&rows, ink_text("sampling"),
            event->as.adaptive.reason == ADAPTIVE_SAME
                ? ink_text("one ray is enough")
                : ink_text("more rays: %s", walkthrough_adaptive_reasons[event->as.adaptive.reason]));
        break;
    case EVENT_SAMPLE:
        add(&rows, ink_text("Q"), ink_vector(walkthrough_world(cursor->walk->scene, event->as.sample.q), DIGITS));
        add(&rows, ink_text("R"), ink_vector(event->as.sample.r, DIGITS));
        break;
    case EVENT_TALLY:
        say_search(&rows, cursor, event);
        break;
    case EVENT_HIT:
        say_hit(&rows, cursor, event);
        break;
    case EVENT_MISS:
        add(&rows, ink_text("P%d", hit), ink_text("none: out of the scene"));
        add(&rows, ink_text("background"), ink_vector(event->as.miss.weight_times_background, DIGITS));
        break;
    case EVENT_LIGHT_END:
        say_light(&rows, cursor, event);
        break;
    case EVENT_TERMS:
        say_terms(&rows, cursor, event);
        break;
    case EVENT_SHADED:
        add(&rows, ink_text("P%d weight", hit), ink_number(event->as.shaded.weight, DIGITS));
        add(&rows, ink_text("P%d adds", hit), ink_vector(event->as.shaded.contribution, DIGITS));
        break;
    case EVENT_REFLECTED:
        add(&rows, ink_text("P%d mirror R'", hit), ink_vector(event->as.reflected.direction, DIGITS));
        break;
    case EVENT_PATH_END:
        add(&rows, ink_text("it ends"), walkthrough_reason_words(cursor->walk, &cursor->place, event));
        break;
    default:
        add(&rows, ink_text("bytes"), ink_text("(%d, %d, %d)", rgb[0], rgb[1], rgb[2]));
    }
    return rows;
}

/* --- The rows --- */

/* A row, unless both sides say the same; a side that is too wide gets a line of its own. */
static void print_row(const Ink *ink, const char *label, const char *a, const char *b)
{
    int side = (ink->columns - LABEL - 2) / 2;
    if (strcmp(a, b) == 0)
        return;
    if (ink_width(a) <= side && ink_width(b) <= side) {
        fprintf(ink->out, "%-*s%s%*s  %s\n", LABEL, label, a, side - ink_width(a), "", b);
        return;
    }
    ink_hanging(ink, LABEL, "%-*s%s", LABEL, label, a);
    ink_hanging(ink, LABEL, "%-*s%s", LABEL, "", b);
}

/* NULL where there is no such row. */
static const char *words_of(const EventRows *rows, const char *label)
{
    for (int i = 0; i < rows->count; i++)
        if (strcmp(rows->labels[i].text, label) == 0)
            return rows->words[i].text;
    return NULL;
}

/* The event of one of them alone, or of both. */
static void print_rows(const Ink *ink, const EventRows *a, const EventRows *b)
{
    for (int i = 0; i < a->count; i++) {
        const char *words = words_of(b, a->labels[i].text);
        print_row(ink, a->labels[i].text, a->words[i].text, words ? words : "-");
    }
    for (int i = 0; i < b->count; i++)
        if (!words_of(a, b->labels[i].text))
            print_row(ink, b->labels[i].text, "-", b->words[i].text);
}

void walkthrough_diff_events(const Ink *ink, const Walkthrough *first, const Walkthrough *other)
{
    Cursor cursors[SIDES] = {{.walk = first}, {.walk = other}};
    for (int i = 0; i < SIDES; i++)
        advance(&cursors[i]);
    while (cursors[0].event || cursors[1].event) {
        int order = !cursors[0].event ? 1 : !cursors[1].event ? -1 : compare(&cursors[0].key, &cursors[1].key);
        EventRows rows[SIDES] = {{.count = 0}, {.count = 0}};
        bool has[SIDES] = {order <= 0, order >= 0};
        for (int i = 0; i < SIDES; i++)
            if (has[i]) {
                rows[i] = rows_of(&cursors[i]);
                advance(&cursors[i]);
            }
        print_rows(ink, &rows[0], &rows[1]);
    }
}

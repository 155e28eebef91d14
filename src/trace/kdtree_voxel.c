/* A voxel while a k-d tree is built. The section numbers are those of Wald and Havran 2006. */
#include "trace/kdtree_voxel.h"

#include "scene/geometry.h"

#include <assert.h>
#include <stdlib.h>
#include <string.h>

/* A step to a child costs as much as this many face tests: less makes trees twice
 * as large that are no faster. A cut that leaves one side empty is worth more than
 * the heuristic knows (section 3.3), for it spares rays that end elsewhere. */
#define STEP_COST KDTREE_STEP_COST
#define EMPTY_BONUS 0.8

static bool voxel_allocate(Voxel *voxel, int faces)
{
    size_t events = 2 * (size_t)faces;
    size_t size = 3 * events * sizeof(VoxelEvent) + (size_t)faces * sizeof(int);
    voxel->events[0] = malloc(size > 0 ? size : 1);
    if (!voxel->events[0])
        return false;
    voxel->events[1] = voxel->events[0] + events;
    voxel->events[2] = voxel->events[1] + events;
    voxel->faces = (int *)(voxel->events[2] + events);
    voxel->face_count = faces;
    return true;
}

void voxel_free(Voxel *voxel)
{
    free(voxel->events[0]);
    *voxel = (Voxel){.face_count = 0};
}

bool voxel_copy(Voxel *copy, const Voxel *voxel)
{
    *copy = *voxel;
    if (!voxel_allocate(copy, voxel->face_count))
        return false;
    for (int axis = 0; axis < 3; axis++)
        memcpy(copy->events[axis], voxel->events[axis], (size_t)voxel->event_count[axis] * sizeof(VoxelEvent));
    memcpy(copy->faces, voxel->faces, (size_t)voxel->face_count * sizeof(int));
    return true;
}

/* --- The events of a scene, sorted --- */

/* The bits of a float, so turned that they ascend as the floats do. */
static uint32_t ascending_bits(float x)
{
    uint32_t bits;
    memcpy(&bits, &x, sizeof bits);
    return bits & 0x80000000u ? ~bits : bits | 0x80000000u;
}

/* Radix sort, 11 bits of the position at a time; `spare` has room for as many events. */
static void sort_events(VoxelEvent *events, int count, VoxelEvent *spare)
{
    enum { DIGITS = 2048 };
    for (int shift = 0; shift < 33; shift += 11) {
        int start[DIGITS + 1] = {0};
        for (int i = 0; i < count; i++)
            start[(ascending_bits(events[i].position) >> shift) % DIGITS + 1]++;
        for (int i = 0; i < DIGITS; i++)
            start[i + 1] += start[i];
        for (int i = 0; i < count; i++)
            spare[start[(ascending_bits(events[i].position) >> shift) % DIGITS]++] = events[i];
        memcpy(events, spare, (size_t)count * sizeof *events);
    }
}

static void add_event(Voxel *voxel, int axis, float position, int place, VoxelEventType type)
{
    voxel->events[axis][voxel->event_count[axis]++] = (VoxelEvent){position, 4 * (uint32_t)place + (uint32_t)type};
}

bool voxel_of_scene(Voxel *voxel, const Scene *scene)
{
    assert(scene->face_count > 0);
    *voxel = (Voxel){.box = box_empty()};
    VoxelEvent *spare = malloc(2 * (size_t)scene->face_count * sizeof *spare);
    if (!spare || !voxel_allocate(voxel, scene->face_count)) {
        free(spare);
        return false;
    }
    for (int i = 0; i < scene->face_count; i++) {
        Box box = face_box(&scene->faces[i], &scene->planes[i]);
        voxel->box = box_union(voxel->box, box);
        voxel->faces[i] = i;
        for (int axis = 0; axis < 3; axis++) {
            if (box.low[axis] == box.high[axis]) {
                add_event(voxel, axis, box.low[axis], i, BOX_PLANAR);
            } else {
                add_event(voxel, axis, box.low[axis], i, BOX_BEGINS);
                add_event(voxel, axis, box.high[axis], i, BOX_ENDS);
            }
        }
    }
    for (int axis = 0; axis < 3; axis++)
        sort_events(voxel->events[axis], voxel->event_count[axis], spare);
    free(spare);
    return true;
}

/* --- Where to cut (section 4.2, algorithm 3) --- */

/* Half the surface of a part of a voxel that has the whole of two sides: ends + girth * its length along the third. */
typedef struct Slices {
    double low, high, ends, girth, area; /* area: of the whole voxel */
} Slices;

static Slices slices_of(const Box *box, int axis)
{
    int b = (axis + 1) % 3, c = (axis + 2) % 3;
    double width = (double)box->high[b] - (double)box->low[b], height = (double)box->high[c] - (double)box->low[c];
    return (Slices){(double)box->low[axis], (double)box->high[axis], width * height, width + height,
                    box_half_area(*box)};
}

/* The best cut so far, and who wants to see all. */
typedef struct Choice {
    VoxelCut best;
    void (*each)(void *user, const VoxelCut *cut); /* NULL: nobody */
    void *user;
} Choice;

/* Takes the cut if it is a better one. A cut along the voxel's own
 * side must take the faces in that side away, or it is none. */
static void try_cut(const Slices *slices, VoxelCut cut, Choice *choice)
{
    double low = (double)cut.position - slices->low, high = slices->high - (double)cut.position;
    if ((low == 0 && cut.low_count == 0) || (high == 0 && cut.high_count == 0))
        return;
    double low_area = slices->ends + slices->girth * low, high_area = slices->ends + slices->girth * high;
    cut.cost = STEP_COST + (low_area * cut.low_count + high_area * cut.high_count) / slices->area;
    if (cut.low_count == 0 || cut.high_count == 0)
        cut.cost *= EMPTY_BONUS;
    if (choice->each)
        choice->each(choice->user, &cut);
    if (cut.cost < choice->best.cost)
        choice->best = cut;
}

/* Sweeps the plane through the events of an axis: those before it are on the low side. */
static void sweep_axis(const Voxel *voxel, int axis, Choice *choice)
{
    const VoxelEvent *events = voxel->events[axis];
    const Slices slices = slices_of(&voxel->box, axis);
    int count = voxel->event_count[axis], low = 0, high = voxel->face_count;
    for (int i = 0; i < count;) {
        float position = events[i].position;
        int of_type[3] = {0, 0, 0};
        for (; i < count && events[i].position == position; i++)
            of_type[events[i].code % 4]++;
        int planar = of_type[BOX_PLANAR];
        high -= planar + of_type[BOX_ENDS];
        try_cut(&slices, (VoxelCut){axis, position, true, low + planar, high, 0}, choice);
        if (planar > 0)
            try_cut(&slices, (VoxelCut){axis, position, false, low, high + planar, 0}, choice);
        low += planar + of_type[BOX_BEGINS];
    }
}

VoxelCut voxel_best_cut(const Voxel *voxel, void (*each)(void *user, const VoxelCut *cut), void *user)
{
    Choice choice = {.best = {.cost = HUGE_VAL}, .each = each, .user = user};
    for (int axis = 0; axis < 3; axis++)
        if (voxel->box.low[axis] < voxel->box.high[axis])
            sweep_axis(voxel, axis, &choice);
    return choice.best;
}

/* --- Cutting (section 4.3; boxes stay sorted when they are cut, so that nothing need be sorted anew) --- */

static void place_faces(Voxel *voxel, const VoxelCut *cut, VoxelPlaces *places)
{
    memset(places, 0, (size_t)voxel->face_count * sizeof *places); /* on both sides until an event says otherwise */
    for (int i = 0; i < voxel->event_count[cut->axis]; i++) {
        VoxelEvent event = voxel->events[cut->axis][i];
        VoxelEventType type = (VoxelEventType)(event.code % 4);
        bool in_plane = event.position == cut->position;
        if (type == BOX_PLANAR ? event.position < cut->position || (in_plane && cut->planar_low)
                               : type == BOX_ENDS && event.position <= cut->position)
            places[event.code / 4].high = -1;
        else if (type == BOX_PLANAR || (type == BOX_BEGINS && event.position >= cut->position))
            places[event.code / 4].low = -1;
    }
}

static void cut_faces(Voxel *high, Voxel *low, VoxelPlaces *places)
{
    int low_count = 0, high_count = 0;
    for (int i = 0; i < high->face_count; i++) {
        int face = high->faces[i];
        if (places[i].low == 0) {
            low->faces[low_count] = face;
            places[i].low = low_count++;
        }
        if (places[i].high == 0) {
            high->faces[high_count] = face;
            places[i].high = high_count++;
        }
    }
    high->face_count = high_count;
}

/* Where the cut is across this axis, a face on both sides ends at the plane on one and begins there on the other. */
static void cut_events(Voxel *high, Voxel *low, int axis, const VoxelCut *cut, const VoxelPlaces *places)
{
    int count = high->event_count[axis];
    low->event_count[axis] = high->event_count[axis] = 0;
    for (int i = 0; i < count; i++) {
        VoxelEvent event = high->events[axis][i];
        VoxelEventType type = (VoxelEventType)(event.code % 4);
        VoxelPlaces place = places[event.code / 4];
        bool across = axis == cut->axis;
        if (place.low >= 0)
            add_event(low, axis, across && event.position > cut->position ? cut->position : event.position, place.low,
                      type);
        if (place.high >= 0)
            add_event(high, axis, across && event.position < cut->position ? cut->position : event.position, place.high,
                      type);
    }
}

bool voxel_cut(Voxel *voxel, const VoxelCut *cut, VoxelPlaces *places, Voxel *low)
{
    *low = (Voxel){.box = voxel->box};
    if (!voxel_allocate(low, cut->low_count))
        return false;
    place_faces(voxel, cut, places);
    cut_faces(voxel, low, places);
    for (int axis = 0; axis < 3; axis++)
        cut_events(voxel, low, axis, cut, places);
    low->box.high[cut->axis] = cut->position;
    voxel->box.low[cut->axis] = cut->position;
    return true;
}

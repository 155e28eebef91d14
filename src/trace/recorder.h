/* The walkthrough as data: the events that the reference tracer records while it traces one pixel.
 * The tracer knows no format; text, JSON, OBJ and SVG are made from these events elsewhere. A NULL recorder
 * is silent and costs one comparison. To add an event: a kind here, a struct in the union, one call in
 * reference.c, and a case in every format. */
#ifndef RECTRAY_RECORDER_H
#define RECTRAY_RECORDER_H

#include "scene/geometry.h"
#include "scene/light.h"
#include "trace/accel.h"
#include "trace/adaptive.h"
#include "trace/traversal.h"

/* Tables, a line each. */
/* clang-format off */

typedef enum EventKind {
    EVENT_ADAPTIVE,     /* adaptive sampling has judged the pixel */
    EVENT_SAMPLE,       /* a primary ray starts */
    EVENT_FACE,         /* a face was tested against the current ray */
    EVENT_NODE,         /* a node of a tree was met */
    EVENT_HIT,          /* the nearest face is known */
    EVENT_MISS,         /* no face hit */
    EVENT_LIGHT,        /* a light is looked at from the hit point */
    EVENT_OCCLUDER,     /* a face was tested against the shadow ray */
    EVENT_LIGHT_END,    /* the light's verdict */
    EVENT_TERMS,        /* what the light adds */
    EVENT_SHADED,       /* the hit's illumination and its weight */
    EVENT_REFLECTED,    /* the path goes on */
    EVENT_PATH_END,     /* why the path ended */
    EVENT_PIXEL,        /* the average and the bytes */
    EVENT_TALLY,        /* not the tracer's: the walkthrough's count of a ray's faces, by verdict */
    EVENT_KIND_COUNT
} EventKind;

typedef enum LightVerdict { LIGHT_BEHIND_FACE, LIGHT_BLOCKED, LIGHT_REACHES } LightVerdict;

typedef enum PathEnd {
    PATH_MISSED,       /* no hit: the background is added */
    PATH_IN_SHADOW,    /* no light reaches the point, rule "black" */
    PATH_NOT_MIRROR,   /* the face's reflection is 0 */
    PATH_MAX_BOUNCES,
} PathEnd;

typedef struct Event {
    EventKind kind;
    union {
        AdaptiveVerdict adaptive;
        struct { int column, row, i, j; ScreenPoint at; Vec3 c, q, r; } sample; /* C, Q, R */
        /* nearest_t: of the faces before, HUGE_VAL if none */
        struct { int face; FaceTest test; double nearest_t; } face;
        struct { TraversalNode visit; AccelNode shape; } node;
        /* normal: turned to the ray; step: 0 for the first hit */
        struct { int face; FaceTest test; Vec3 point, normal, shifted; int step; } hit;
        struct { Vec3 background, weight_times_background; double weight; } miss;
        /* height: N.(light - v0), over the face's plane; side: its exact sign */
        struct { int light, side; Vec3 position, to_light; double distance, height; Vec3 l, shadow_origin; } light;
        struct { int face; FaceTest test; } occluder;
        struct { int light; LightVerdict verdict; int blocker; } light_end; /* blocker: a face or -1 */
        /* sum: this light's */
        struct { int light; Illumination illumination; Vec3 l, v, sum; double exponent; bool ambient_only; } terms;
        struct { Vec3 illumination, contribution, total; double weight; int lights_reaching; } shaded;
        /* bounce: 1 for the first */
        struct { Vec3 r_unit, direction, origin; double reflection, weight; int bounce; } reflected;
        struct { PathEnd reason; Vec3 colour; int bounces; } path_end; /* colour: of this sample */
        struct { Vec3 sum, average, clamped; int samples; unsigned char rgb[3]; } pixel;
        /* shadow: of a shadow ray; nodes: by verdict; leaves: among those entered */
        struct {
            int tested, verdicts[FACE_VERDICT_COUNT], nodes_met, nodes[NODE_VERDICT_COUNT], leaves;
            bool shadow;
        } tally;
    } as;
} Event;

/* clang-format on */

typedef struct Recorder {
    void (*record)(void *user, const Event *event);
    void *user;
} Recorder;

#endif

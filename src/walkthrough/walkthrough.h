/* The walkthrough of one pixel: the events that the reference tracer recorded while it traced it, as a list. The
 * formats (walkthrough_text.c and its like) read the list from the beginning to its end. A WalkthroughPlace follows
 * them, so that each knows which ray, hit and light an event speaks of. To add a format, see walkthrough_formats.h. */
#ifndef RECTRAY_WALKTHROUGH_H
#define RECTRAY_WALKTHROUGH_H

#include "base/error.h"
#include "scene/scene.h"
#include "trace/accel.h"
#include "trace/recorder.h"

#include <stdio.h>

/* Of the faces that a ray hits, so many are told where the rest is only counted. */
enum { WALKTHROUGH_HITS_TOLD = 8 };

typedef struct WalkthroughRequest {
    int column, row; /* in the picture */
    int i, j;        /* the sample that is told in full, in the grid; of the others only the colour is */
    bool verbose;    /* every face tested is told, at some 220 bytes each */
} WalkthroughRequest;

/* The bytes of a pixel and its neighbours, row by row; the pixel itself is in the middle. */
enum { AROUND_SELF = 4 };

typedef struct WalkthroughAround {
    bool there[9]; /* false: outside the picture, or not looked at */
    unsigned char rgb[9][3];
} WalkthroughAround;

/* In the list each ray's search begins with an EVENT_TALLY; events follow for the nodes met, and for those faces that
 * are told. */
typedef struct Walkthrough {
    const Scene *scene;     /* borrowed */
    const char *scene_name; /* borrowed; as the user gave it */
    WalkthroughRequest request;
    int grid; /* the pixel has grid x grid samples; refined by adaptive sampling, grid of them */
    Event *events;
    long count, capacity;
    WalkthroughAround around; /* nothing is there before walkthrough_look_around */
    /* While recording: */
    bool telling; /* inside the sample that is told */
    bool found;   /* it was traced */
    bool failed;  /* out of memory */
    bool shadow;  /* the search is a shadow ray's */
    long tally;   /* the current search's tally in the list, -1: none yet */
    Event hits[WALKTHROUGH_HITS_TOLD + 1];
    int hit_count;
} Walkthrough;

/* Traces the pixel and records it. accel may be NULL: every face is tested. Free the walkthrough also after a failure:
 * want of memory, or a sample that adaptive sampling left out. */
bool walkthrough_record(Walkthrough *walk, const Scene *scene, const Accel *accel, const char *scene_name,
                        WalkthroughRequest request, Error *error);

/* The same for another tracer: an empty walkthrough, and who is to be told the events. */
void walkthrough_begin(Walkthrough *walk, const Scene *scene, const char *scene_name, WalkthroughRequest request);
Recorder walkthrough_recorder(Walkthrough *walk);

/* Traces the pixels around the one that was recorded. A failure is want of memory. */
bool walkthrough_look_around(Walkthrough *walk, Error *error);

void walkthrough_free(Walkthrough *walk);

/* Where in the path an event stands. Zeroed before the first event. */
typedef struct WalkthroughPlace {
    const Event *sample, *hit, *light; /* the latest; hit and light are NULL before the first of the sample */
    bool told;                         /* whether the sample is the one that is told in full */
    bool shadow;                       /* the latest search is a shadow ray's */
    Ray ray;                           /* the one being followed */
    double length;                     /* |R| of the ray that arrived at the latest hit */
    double weight;                     /* of the next hit */
} WalkthroughPlace;

/* Takes the event into account; called before a format speaks of it. */
void walkthrough_follow(WalkthroughPlace *place, const Walkthrough *walk, const Event *event);

/* The number in P1, P2, ...: of the latest hit; 0 before the first. */
int walkthrough_hit_number(const WalkthroughPlace *place);

/* What the events leave to be derived, for the formats that show it. */
typedef struct WalkthroughEdge {
    Vec3 e, c; /* e = v[k+1] - v[k], c = P - v[k] */
} WalkthroughEdge;

WalkthroughEdge walkthrough_edge(const Face *face, int k, Vec3 point);

/* The two sides whose cross product is the normal's direction: v2 - v0 and v3 - v1; of a triangle v1 - v0, v2 - v0. */
typedef struct WalkthroughSides {
    Vec3 a, b;
} WalkthroughSides;

WalkthroughSides walkthrough_sides(const Face *face);

/* The ray of the search that a node belongs to: the path's, or the one from the shifted point to the light. */
Ray walkthrough_search_ray(const WalkthroughPlace *place);

/* What V is the unit vector of, at the latest hit: C - P, or -R. */
Vec3 walkthrough_to_viewer(const Scene *scene, const WalkthroughPlace *place);

/* A position as the scene file gives it, from one as it is traced. */
Vec3 walkthrough_world(const Scene *scene, Vec3 position);

/* The face's number within its object, from 0, as the scene file lists them. */
int walkthrough_face_in_object(const Scene *scene, int face);

/* A face as traced is piece `number`, from 1, of `count` of the face in the file; 1 of 1 where that was not cut. */
typedef struct WalkthroughPiece {
    int number, count;
} WalkthroughPiece;

WalkthroughPiece walkthrough_piece(const Scene *scene, int face);

/* Whether the ray meets the face within its edges, nearest or not. */
bool walkthrough_is_hit(const FaceTest *test);

/* The size of the scene: the longest side of the box around its faces and its camera, as traced. */
double walkthrough_scene_size(const Scene *scene);

/* One word for each value of an enumeration. */
extern const char *const walkthrough_face_verdicts[];
extern const char *const walkthrough_node_verdicts[];
extern const char *const walkthrough_light_verdicts[];
extern const char *const walkthrough_path_ends[];
extern const char *const walkthrough_adaptive_reasons[];

#endif

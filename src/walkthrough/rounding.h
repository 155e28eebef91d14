/* What rounding does to one pixel: its path in textbook arithmetic (trace/textbook.h) beside the exact one, hit by hit
 * and light by light, and where the two part. The walkthrough holds the exact one. */
#ifndef RECTRAY_ROUNDING_H
#define RECTRAY_ROUNDING_H

#include "trace/render.h"
#include "trace/textbook.h"
#include "walkthrough/walkthrough_formats.h"

typedef struct RoundingLight {
    LightVerdict verdict;
    int blocker;   /* a face, of LIGHT_BLOCKED; else -1 */
    double height; /* of the light over the face, on the ray's side, as it was computed */
    Ray ray;       /* the shadow ray */
} RoundingLight;

typedef struct RoundingHit {
    Ray ray;
    int face; /* -1: the ray leaves the scene, and what follows is 0 */
    double t;
    Vec3 point, shifted;
    double above; /* how far the shifted point lies over the face's plane, on the ray's side; its sign is exact */
    int light_count;
    RoundingLight *lights;
} RoundingHit;

typedef struct RoundingPath {
    RoundingHit *hits; /* of the sample that is told; the last one may be a miss */
    int count;
    RoundingLight *lights; /* of all hits */
    Vec3 colour;           /* of the sample */
    unsigned char rgb[3];  /* of the pixel */
} RoundingPath;

typedef struct Rounding {
    const Walkthrough *walk; /* the exact one, borrowed */
    Walkthrough told;        /* the textbook's */
    Precision precision;
    float shift;
    RoundingPath textbook, exact; /* what both say, in short */
} Rounding;

/* Where the two part: at hit k, from 0, or at one of its lights. */
typedef struct RoundingPart {
    int hit, light; /* light -1: the hit itself; hit -1: nowhere */
} RoundingPart;

/* Traces the walkthrough's pixel again, with the settings' precision and shift. Fails for want of memory, and for a
 * scene with adaptive sampling, which is not in the text. */
bool rounding_make(Rounding *rounding, const Walkthrough *walk, const RenderSettings *settings, Error *error);
void rounding_free(Rounding *rounding);

/* The first place where a face or a verdict is another one. */
RoundingPart rounding_part(const Rounding *rounding);

/* Whether the two agree on the face of hit k, or on that light's verdict there. */
bool rounding_same_face(const Rounding *rounding, int k);
bool rounding_same_verdict(const Rounding *rounding, int k, int light);

/* The numbers by which textbook arithmetic decides whether a ray hits a face. */
FaceTest rounding_textbook_test(const Rounding *rounding, int face, Ray ray);

/* The D of the face's plane in textbook arithmetic. */
double rounding_textbook_d(const Rounding *rounding, int face);

/* The text: bytes, where they part and why; then, unless style.parts is WALKTHROUGH_SUMMARY, the walkthrough with the
 * textbook's numbers, and at each step what is exactly so. */
void rounding_write_text(FILE *out, const Rounding *rounding, WalkthroughStyle style);

/* The same as JSON. Fails only for want of memory. */
bool rounding_write_json(FILE *out, const Rounding *rounding, Error *error);

/* The summary, the text cut into its steps, and all places where the two part: for the web page, one JSON object. */
bool rounding_write_steps(FILE *out, const Rounding *rounding, WalkthroughStyle style, Error *error);

#endif

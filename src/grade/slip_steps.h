/* The steps of the algorithm as a table of functions, so that one of them can be another. A slip is such a table in
 * which a step is done wrongly: slip.h. The steps done rightly call the functions of scene/, and so have no formulas of
 * their own. To add a step: its member here, its right form in slip_steps.c, its call in slip_trace.c. */
#ifndef RECTRAY_SLIP_STEPS_H
#define RECTRAY_SLIP_STEPS_H

#include "scene/geometry.h"
#include "scene/light.h"
#include "trace/recorder.h"

/* A point that a ray meets. */
typedef struct SlipHit {
    int face; /* -1: none */
    FaceTest test;
    Ray ray;      /* the ray that arrived */
    Ray primary;  /* the one that the path began with */
    Vec3 r;       /* unit direction of `ray` */
    Vec3 point;   /* P */
    Vec3 normal;  /* N turned to the side that the ray came from */
    Vec3 shifted; /* where the rays that leave start */
} SlipHit;

/* What the illumination by one light is made of. */
typedef struct SlipShine {
    const Scene *scene;
    const SlipHit *hit;
    int index; /* of the light */
    Material material;
    Light light;
    Vec3 l, v;    /* unit vectors to the light and to the viewer */
    bool reaches; /* whether the light reaches the point */
    int reaching; /* how many lights did so before this one */
} SlipShine;

/* What may end a path. */
typedef struct SlipEnd {
    const Scene *scene;
    const Material *material;
    int reaching, bounces;
} SlipEnd;

/* In the order in which a path comes by them. In a slip, NULL is the right step. */
typedef struct SlipSteps {
    void (*scene)(Scene *scene); /* changes a copy of the scene: its rules, not its lists. NULL: nothing */
    void (*colours)(Material *material, Light *light);                     /* changes copies of both. NULL: nothing */
    View (*view)(const Scene *scene);                                      /* 1 */
    ScreenPoint (*screen_point)(const View *view, const Event *sample);    /* 1 */
    Vec3 (*direction)(const View *view, ScreenPoint at);                   /* 1 */
    FaceTest (*test)(const Scene *scene, int face, Ray ray);               /* 3, 4 */
    bool (*nearer)(const SlipHit *nearest, double t);                      /* 5 */
    Vec3 (*point)(const Scene *scene, Ray ray, double t);                  /* 3 */
    Vec3 (*normal)(const Scene *scene, const SlipHit *hit);                /* 6 */
    Vec3 (*shifted)(const Scene *scene, const SlipHit *hit);               /* 6 */
    int (*side)(const Scene *scene, const SlipHit *hit, int light);        /* 6: > 0 where the light is in front */
    FaceTest (*between)(const Scene *scene, int face, Vec3 from, Vec3 to); /* 6: inside where it is in the way */
    bool shadows_apart;         /* 6: shadow rays are tested rightly, although `test` is not */
    Vec3 (*to_light)(Vec3 way); /* 7: L */
    Vec3 (*viewer)(const Scene *scene, const SlipHit *hit);                           /* 7: V */
    Illumination (*terms)(const SlipShine *shine);                                    /* 7 */
    Vec3 (*lit)(const SlipShine *shine, const Illumination *terms);                   /* 8: what counts of the terms */
    Vec3 (*add_light)(Vec3 sum, Vec3 light);                                          /* 8 */
    bool (*ends)(const SlipEnd *end, PathEnd *reason);                                /* 9 */
    Ray (*reflected)(const SlipHit *hit);                                             /* 9 */
    double (*weight)(double before, double reflection);                               /* 9 */
    Vec3 (*contribution)(double weight, Vec3 illumination, const Material *material); /* 9 */
    Vec3 (*miss)(double weight, Vec3 background);                                     /* 9 */
    Vec3 (*add_hit)(Vec3 total, Vec3 contribution);                                   /* 9 */
    Vec3 (*average)(Vec3 sum, int samples);                                           /* 10 */
    void (*bytes)(Vec3 colour, unsigned char rgb[3]);                                 /* 10 */
} SlipSteps;

/* The slip's steps, and the right ones where it has none. `between` stays NULL where the slip has a `test`, which then
 * serves shadow rays, too: a program mostly has one function for both. */
SlipSteps slip_steps_of(const SlipSteps *slip);

/* The steps done rightly that slips begin with. */
Illumination slip_steps_terms(const SlipShine *shine);
Vec3 slip_steps_lit(const SlipShine *shine, const Illumination *terms);
int slip_steps_side(const Scene *scene, const SlipHit *hit, int light);

#endif

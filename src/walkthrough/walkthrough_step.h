/* The steps of the walkthrough's text, for whoever wants more of them than their headings: what a step is about, which
 * functions do it, and which sections of docs/algorithm.md explain it. To add a kind of step: a kind here and a line in
 * walkthrough_step.c. */
#ifndef RECTRAY_WALKTHROUGH_STEP_H
#define RECTRAY_WALKTHROUGH_STEP_H

typedef enum WalkthroughStepKind {
    STEP_PRIMARY, /* the primary ray */
    STEP_NEAREST, /* the nearest face along a ray */
    STEP_LIGHT,   /* one light at one hit */
    STEP_ADDS,    /* what a hit adds to the pixel */
    STEP_MIRROR,  /* the reflected ray */
    STEP_SUM,     /* the end of the path, and the pixel */
    STEP_KIND_COUNT
} WalkthroughStepKind;

typedef struct WalkthroughStep {
    WalkthroughStepKind kind;
    int number; /* as its heading says, from 1 */
    int hit;    /* the k of Pk that it is about: of STEP_PRIMARY and STEP_NEAREST, the one that the ray looks for */
    int light;  /* of STEP_LIGHT; else -1 */
    const char *title;
} WalkthroughStep;

/* Is told of each step before its heading is written. */
typedef struct WalkthroughStepListener {
    void (*begin)(void *user, const WalkthroughStep *step);
    void *user;
} WalkthroughStepListener;

enum { STEP_MAX_FUNCTIONS = 5, STEP_MAX_SECTIONS = 3 };

/* Where a kind of step stands in the code and on the page. */
typedef struct WalkthroughStepSource {
    const char *word;
    const char *functions[STEP_MAX_FUNCTIONS + 1]; /* "function file"; ends in a NULL */
    int sections[STEP_MAX_SECTIONS + 1];           /* of docs/algorithm.md; ends in a 0 */
} WalkthroughStepSource;

extern const WalkthroughStepSource walkthrough_step_sources[STEP_KIND_COUNT];

#endif

/* The slips that grading knows: mistakes that people make when they write a ray tracer, each as a table of steps in
 * which one is done wrongly. A pixel that is traced so is what a program with this slip finds. To add one: its step and
 * its line in one of the files slips_NAME.c, and a row in the table of docs/grading.md. */
#ifndef RECTRAY_SLIP_H
#define RECTRAY_SLIP_H

#include "grade/slip_steps.h"

typedef struct Slip {
    const char *name;  /* one word, for scripts */
    const char *title; /* what is done, as a sentence */
    const char *right; /* the formula, or the rule */
    const char *wrong; /* what the slip makes of it */
    const char *read;  /* where it is explained: a file of docs/ and a heading in it */
    SlipSteps steps;
    double unit;      /* colours are given in such a unit; 0: 1 */
    double byte_unit; /* and so are bytes; 0: 1 */
    bool rounding;    /* no slip: arithmetic that rounds otherwise */
} Slip;

/* Lists that end in a NULL name. */
extern const Slip slip_camera[], slip_face[], slip_edge[], slip_light[], slip_term[], slip_shading[], slip_mirror[],
    slip_colour[];

/* The slip with that number in all the lists, in their order; NULL behind the last. */
const Slip *slip_number(int number);

#endif

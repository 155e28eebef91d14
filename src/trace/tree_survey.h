/* What a tree looks like as a whole. */
#ifndef RECTRAY_TREE_SURVEY_H
#define RECTRAY_TREE_SURVEY_H

#include "trace/accel.h"

enum { TREE_LEAF_SIZES = 17 };

typedef struct TreeSurvey {
    int nodes, leaves, depth;     /* depth: of the deepest node; the root's is 0 */
    int entries;                  /* faces of all leaves, each counted once per leaf */
    int most;                     /* faces of the fullest leaf */
    int of_size[TREE_LEAF_SIZES]; /* leaves of so many faces; the last counts those of more, too */
    /* Of a random line that meets the root's box: how many nodes it meets, and how many faces it is tested against, by
     * the chance that it meets each node's box, the ratio of the surfaces. */
    double expected_nodes, expected_tests;
    double sah_cost; /* in face tests: what the builder makes small */
    double bytes;
} TreeSurvey;

/* The accel has a tree. */
TreeSurvey tree_survey(const Accel *accel);

#endif

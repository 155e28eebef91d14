/* How a tree is built, as text. */
#ifndef RECTRAY_TREE_STEPS_H
#define RECTRAY_TREE_STEPS_H

#include "trace/accel.h"

/* Prints the first `count` nodes, level by level, each with the planes that were tried and what each would cost: with
 * all of them, or across each axis with the cheapest. */
bool tree_steps_print(const Scene *scene, const Accel *accel, int count, bool all_planes, Error *error);

#endif

/* Why a ray enters a node of a tree or passes it over. */
#ifndef RECTRAY_WALKTHROUGH_NODE_H
#define RECTRAY_WALKTHROUGH_NODE_H

#include "walkthrough/ink.h"
#include "walkthrough/walkthrough.h"

/* When a ray is in a box: from where it is between the planes of all three axes, to where it leaves the first of them.
 * It misses the box where leave < enter. */
typedef struct NodeCrossing {
    double enter, leave;
    int enter_axis, leave_axis; /* 0, 1, 2; -1: the ray begins inside, or never leaves */
} NodeCrossing;

NodeCrossing node_crossing(Box box, Ray ray);

/* The t at which a ray meets the plane of a k-d tree's inner node; infinite along it. */
double node_plane_t(const AccelNode *shape, Ray ray);

/* The child that the ray meets first. */
int node_near_child(const AccelNode *shape, Ray ray);

/* "missed: leaves x at t = 4.1, enters y at t = 5.2", "begins at t = 9.3, beyond the nearest hit 7.2". */
InkText node_reason(const Event *event, Ray ray, bool shadow);

#endif

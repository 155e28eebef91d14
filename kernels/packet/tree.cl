/* The search of a tree by a bundle of rays: TREE, a build option, is packet/bvh.cl, packet/kdtree.cl or
 * packet/all_faces.cl. */
#include TREE

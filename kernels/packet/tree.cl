/* The tree of the scene, traversed by a bundle of rays. The host chooses the file that TREE stands for: packet/bvh.cl,
 * packet/kdtree.cl or packet/all_faces.cl. All three define the same functions. */
#include TREE

/* Eight faces at a time: the verdict on their shapes, their rounded vertices and their planes. Each number is the one
 * that shape.c and geometry.c have for a single face, to the last bit. The loops over the lanes have no branches, so
 * that a compiler makes vector instructions of them. */
#ifndef RECTRAY_FACE_LANES_H
#define RECTRAY_FACE_LANES_H

#include "base/vec3.h"

/* Before a function: it is compiled for the vectors of every processor, and the program chooses when it starts. Other
 * compilers than GCC make one function of it. */
#if defined(__x86_64__) && defined(__gnu_linux__) && defined(__GNUC__) && !defined(__clang__) && \
    !defined(__SANITIZE_ADDRESS__)
#define FOR_EVERY_PROCESSOR __attribute__((target_clones("avx512f", "avx2", "default")))
#else
#define FOR_EVERY_PROCESSOR
#endif

enum { FACE_LANES = 8, FACE_VERTICES_MOST = 4 };

/* Vertex k of face l is x[k][l], y[k][l], z[k][l]. All faces have 3 vertices, or all have 4; row 3 of a triangle is
 * its vertex 0. */
typedef struct FaceLanes {
    double x[FACE_VERTICES_MOST][FACE_LANES], y[FACE_VERTICES_MOST][FACE_LANES], z[FACE_VERTICES_MOST][FACE_LANES];
    int count;
} FaceLanes;

/* Plane.normal, and so on, of every face. */
typedef struct PlaneLanes {
    double normal[3][FACE_LANES], normal_low[3][FACE_LANES], d[FACE_LANES], error[FACE_LANES], length[FACE_LANES];
} PlaneLanes;

/* The box around the vertices of each lane's faces so far. */
typedef struct BoundLanes {
    double low[3][FACE_LANES], high[3][FACE_LANES];
} BoundLanes;

void face_lanes_grow(const FaceLanes *restrict faces, BoundLanes *restrict bounds);

/* Bit l is set where face l may be other than SHAPE_GOOD by shape_of: a closer look is needed. */
unsigned face_lanes_shapes(const FaceLanes *faces);

/* Moves the centre to the origin and rounds to float32. Bit l is set where a coordinate is then beyond the limit. */
unsigned face_lanes_round(FaceLanes *faces, Vec3 centre, double limit);

/* Of rounded faces: their planes, as by face_plane. Bit l is set where face l has none, or may be other than SHAPE_GOOD
 * by shape_of_rounded. */
unsigned face_lanes_planes(const FaceLanes *restrict faces, PlaneLanes *restrict planes);

#endif

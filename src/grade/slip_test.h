/* The formulas of steps 3 and 4 as they stand, without the guards against rounding, for slips to change. */
#ifndef RECTRAY_SLIP_TEST_H
#define RECTRAY_SLIP_TEST_H

#include "grade/slip_steps.h"

/* 3. N.R, N.O + D and t. */
FaceTest slip_test_plane(const Scene *scene, int face, Ray ray);

/* 4. The test with its t, which may have been changed: the edges and the verdict. */
FaceTest slip_test_with_t(const Scene *scene, int face, Ray ray, FaceTest test);

/* 3 and 4, as the text has them. The values of all edges are filled. */
FaceTest slip_test_taught(const Scene *scene, int face, Ray ray);

/* The test with another verdict. */
FaceTest slip_test_judged(FaceTest test, bool hit);

/* Whether the point is inside the edges from `first` up to `end`. */
bool slip_test_inside(const FaceTest *test, int first, int end);

/* Whether the face has two sides, or the ray comes from its front. */
bool slip_test_faces_ray(const Scene *scene, int face, const FaceTest *test);

/* The same, and the plane is before the ray's origin. */
bool slip_test_ahead(const Scene *scene, int face, const FaceTest *test);

#endif

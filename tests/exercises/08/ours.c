/* Our own functions of src/scene/geometry.c under the names of exercise 8. */
#include "exercises/08/rounding.h"

#define face_vertex our_face_vertex
#define face_plane our_face_plane
#define face_box our_face_box
#define face_test our_face_test
#define face_test_segment our_face_test_segment
#define plane_side our_plane_side
#define point_left_of our_point_left_of
#define point_shifted our_point_shifted
#define view_of our_view_of
#define view_screen_point our_view_screen_point
#define view_direction our_view_direction
#undef ROUNDING
#include "src/scene/geometry.c"

static Distance distance_from_plane(const Face *face, const Plane *plane, Vec3 o)
{
    Vec3 x = vec3_sub(o, our_face_vertex(face, 0));
    return (Distance){plane_distance(face, plane, o), (plane->error + 8 * ROUNDING) * vec3_magnitudes(x)};
}

static Vec3 shifted_point(const Face *face, const Plane *plane, Vec3 n, Vec3 p)
{
    return our_point_shifted(face, plane, n, p);
}

static int side_of_edge(Vec3 o, Vec3 r, Vec3 a, Vec3 b)
{
    double value = our_point_left_of(r, o, a, b);
    return (value > 0) - (value < 0);
}

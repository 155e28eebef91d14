/* Exercise 8, rounding: what the student's functions answer, judged by exact arithmetic. Inputs are of the lessons of
 * docs/rounding.md, and at random near what is hard. */
#include "exercises/08/judge.h"
#include "exercises/student.h"

#include "exercises/08/distances.h"
#include "exercises/08/lessons.h"
#include "exercises/08/points.h"
#include "exercises/08/sides.h"

static const ExerciseTest TESTS[] = {
    {"height_over_the_ground", "The height of a point over the ground", height_over_the_ground},
    {"far_from_the_origin", "Distances far from the origin, as in lesson 4", far_from_the_origin},
    {"errors_are_bounds", "The error of a distance, at 2000 planes", errors_are_bounds},
    {"no_leak", "Shifted points in a small scene, as in lesson 2", no_leak},
    {"no_acne", "Shifted points in a large scene, as in lesson 1", no_acne},
    {"from_where_it_is", "Points that lie deep, and faces from behind", from_where_it_is},
    {"at_the_origin", "A point whose coordinates are 0", at_the_origin},
    {"clear_sides", "Sides of edges that the ray passes at a distance", clear_sides},
    {"shared_edges", "Both sides of the edges of lesson 3", shared_edges},
    {"rays_at_an_edge", "Rays aimed at an edge", rays_at_an_edge},
    {"acne_is_gone", "Pixels of lesson 1", acne_is_gone},
    {"cracks_are_gone", "Pixels of lesson 3", cracks_are_gone},
    {NULL, NULL, NULL},
};

int main(int argc, char **argv)
{
    Exercise exercise = {
        .tests = TESTS, .pixel = student_pixel, .ours = our_pixel, .scene = LEAK, .columns = 160, .rows = 120};
    return exercise_main(argc, argv, &exercise);
}

/* Exercise 9, a k-d tree: the student's costs, cuts and walks beside ours. */
#include "exercises/exercise.h"

#include "exercises/09/tree.h"
#include "exercises/student.h"

#include "exercises/09/cuts.h"
#include "exercises/09/picture.h"
#include "exercises/09/walks.h"

static const ExerciseTest TESTS[] = {
    {"cost_of_a_cut", "What a cut costs, by hand", cost_of_a_cut},
    {"empty_part", "A cut that leaves one part empty", empty_part},
    {"three_boxes", "The best cut between three boxes", three_boxes},
    {"flat_faces", "Faces that lie in the plane", flat_faces},
    {"cuts_of_a_scene", "The first cuts of two scenes", cuts_of_a_scene},
    {"a_leaf", "A walk through one leaf", a_leaf},
    {"near_first", "Two leaves, from the low side and from the high side", near_first},
    {"own_parts", "A leaf that the ray never comes to", own_parts},
    {"not_beyond_the_limit", "Leaves beyond the nearest hit", not_beyond_the_limit},
    {"stops_when_told", "A search that is over", stops_when_told},
    {"walks_of_a_scene", "300 rays through the tree of scenes/cornell.json", walks_of_a_scene},
    {NULL, NULL, NULL},
};

int main(int argc, char **argv)
{
    Exercise exercise = {
        .tests = TESTS, .pixel = student_pixel, .ours = our_pixel, .scene = CORNELL, .columns = 96, .rows = 96};
    return exercise_main(argc, argv, &exercise);
}

/* Where the steps of the walkthrough stand in the code and in docs/algorithm.md. tests/page_test.py holds the table to
 * both. */
#include "walkthrough/walkthrough_step.h"

const WalkthroughStepSource walkthrough_step_sources[STEP_KIND_COUNT] = {
    [STEP_PRIMARY] = {.word = "primary",
                      .functions = {"view_of scene/geometry.c", "view_screen_point scene/geometry.c",
                                    "view_direction scene/geometry.c"},
                      .sections = {1}},
    [STEP_NEAREST] = {.word = "nearest",
                      .functions = {"face_plane scene/geometry.c", "face_test scene/geometry.c",
                                    "nearest_hit trace/reference.c", "place_hit trace/reference.c",
                                    "point_shifted scene/geometry.c"},
                      .sections = {3, 4, 5}},
    [STEP_LIGHT] = {.word = "light",
                    .functions = {"look_at_light trace/reference.c", "plane_side scene/geometry.c",
                                  "find_blocker trace/reference.c", "face_test_segment scene/geometry.c",
                                  "illuminate scene/light.c"},
                    .sections = {6, 7, 8}},
    [STEP_ADDS] = {.word = "adds",
                   .functions = {"shade trace/reference.c", "trace_path trace/reference.c"},
                   .sections = {8, 9}},
    [STEP_MIRROR] = {.word = "mirror",
                     .functions = {"path_ends trace/reference.c", "reflected_ray trace/reference.c"},
                     .sections = {9}},
    [STEP_SUM] = {.word = "sum",
                  .functions = {"end_path trace/reference.c", "average_of trace/reference.c",
                                "colour_to_byte scene/light.c"},
                  .sections = {10}},
};

/* The stress tests; main.c lists them by number and name. */
#ifndef RECTRAY_STRESS_TESTS_H
#define RECTRAY_STRESS_TESTS_H

#include "suite.h"

void test_grid_misses(Suite *suite);
void test_grid_counts(Suite *suite);
void test_embree(Suite *suite);
void test_boxes(Suite *suite);
void test_nested(Suite *suite);
void test_agreement(Suite *suite);
void test_t(Suite *suite);
void test_grazing(Suite *suite);
void test_self_hits(Suite *suite);
void test_shadows(Suite *suite);
void test_light_on_face(Suite *suite);
void test_axes(Suite *suite);
void test_trees(Suite *suite);
void test_bit_patterns(Suite *suite);
void test_bad_faces(Suite *suite);
void test_invariance(Suite *suite);
void test_mirrors(Suite *suite);
void test_translation(Suite *suite);
void test_pictures(Suite *suite);
void test_powers(Suite *suite);

#endif

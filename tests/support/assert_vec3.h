/* Compares a vector with the coordinates that a test expects. */
#ifndef RECTRAY_TESTS_ASSERT_VEC3_H
#define RECTRAY_TESTS_ASSERT_VEC3_H

#include "base/vec3.h"

#include "unity.h"

#define ASSERT_VEC3_WITHIN(tolerance, ex, ey, ez, actual)        \
    do {                                                         \
        Vec3 actual_ = (actual);                                 \
        TEST_ASSERT_DOUBLE_WITHIN((tolerance), (ex), actual_.x); \
        TEST_ASSERT_DOUBLE_WITHIN((tolerance), (ey), actual_.y); \
        TEST_ASSERT_DOUBLE_WITHIN((tolerance), (ez), actual_.z); \
    } while (0)

#endif

/* The bounding volume hierarchy: what every tree must be, and how good it is. */
#include "trace/bvh.h"
#include "trace/bvh_morton.h"

#include "support/crowds.h"
#include "support/plain_bvh.h"
#include "support/small_scene.h"

#include "unity.h"

#include <string.h>

enum { FACES = 3000, MAX_LEAF = 8 };

static Error error;

void setUp(void)
{
    error = (Error){.kind = ERROR_NONE};
}
void tearDown(void) {}

static Bvh tree_of(const Scene *scene, int threads)
{
    Bvh bvh;
    TEST_ASSERT_TRUE(bvh_build(&bvh, scene, threads, &error));
    return bvh;
}

static Bvh sorted_tree_of(const Scene *scene, int threads)
{
    Bvh bvh;
    TEST_ASSERT_TRUE(bvh_morton_build(&bvh, scene, threads, &error));
    return bvh;
}

static bool box_holds(Box outer, Box inner)
{
    Box both = box_union(outer, inner);
    return memcmp(&both, &outer, sizeof both) == 0;
}

/* Checks the subtree and counts each face that its leaves hold. */
static void check_node(const Bvh *bvh, const Scene *scene, int index, int depth, int *seen)
{
    const BvhNode *node = &bvh->nodes[index];
    TEST_ASSERT_TRUE(index >= 0 && index < 2 * bvh->face_count);
    TEST_ASSERT_LESS_THAN_INT(BVH_MAX_DEPTH, depth);
    TEST_ASSERT_LESS_OR_EQUAL_INT(MAX_LEAF, node->count);
    for (int i = 0; i < node->count; i++) {
        int face = bvh->order[node->first + i];
        TEST_ASSERT_TRUE(i == 0 || face > bvh->order[node->first + i - 1]);
        TEST_ASSERT_TRUE(box_holds(node->box, face_box(&scene->faces[face], &scene->planes[face])));
        seen[face]++;
    }
    if (node->count > 0)
        return;
    TEST_ASSERT_TRUE(box_holds(node->box, bvh->nodes[index + 1].box));
    TEST_ASSERT_TRUE(box_holds(node->box, bvh->nodes[node->first].box));
    check_node(bvh, scene, index + 1, depth + 1, seen);
    check_node(bvh, scene, node->first, depth + 1, seen);
}

static void each_face_should_be_in_one_leaf_and_in_all_boxes_above(void)
{
    for (int i = 0; i < 2 * CROWD_KINDS; i++) {
        Scene scene = crowd_scene((Crowd)(i / 2), FACES, 17);
        Bvh bvh = i % 2 ? sorted_tree_of(&scene, 1) : tree_of(&scene, 1);
        int seen[FACES] = {0};
        check_node(&bvh, &scene, 0, 0, seen);
        for (int k = 0; k < FACES; k++)
            TEST_ASSERT_EQUAL_INT(1, seen[k]);
        bvh_free(&bvh);
        scene_free(&scene);
    }
}

static void a_floor_below_many_faces_should_be_set_apart_at_the_root(void)
{
    Scene scene = crowd_scene(CROWD_TILES, 200, 17);
    scene.faces[123] = face_at_height(-50, -50, 50, 50, -1);
    scene.planes[123] = face_plane(&scene.faces[123]);
    for (int sorted = 0; sorted < 2; sorted++) {
        Bvh bvh = sorted ? sorted_tree_of(&scene, 1) : tree_of(&scene, 1);
        TEST_ASSERT_EQUAL_INT(1, bvh.nodes[1].count);
        TEST_ASSERT_EQUAL_INT(123, bvh.order[bvh.nodes[1].first]);
        bvh_free(&bvh);
    }
    scene_free(&scene);
}

static void one_face_should_be_a_leaf(void)
{
    Scene scene = crowd_scene(CROWD_QUADS, 1, 17);
    Bvh bvh = tree_of(&scene, 2);
    TEST_ASSERT_EQUAL_INT(1, bvh.nodes[0].count);
    TEST_ASSERT_EQUAL_INT(0, bvh.order[0]);
    bvh_free(&bvh);
    bvh_free(&bvh);
    bvh = sorted_tree_of(&scene, 2);
    TEST_ASSERT_EQUAL_INT(1, bvh.nodes[0].count);
    bvh_free(&bvh);
    scene_free(&scene);
}

static bool same_subtree(const Bvh *a, const Bvh *b, int index)
{
    const BvhNode *x = &a->nodes[index], *y = &b->nodes[index];
    if (memcmp(x, y, sizeof *x) != 0)
        return false;
    if (x->count > 0)
        return memcmp(a->order + x->first, b->order + x->first, (size_t)x->count * sizeof(int)) == 0;
    return same_subtree(a, b, index + 1) && same_subtree(a, b, x->first);
}

static void the_tree_should_not_depend_on_the_threads(void)
{
    Scene scene = crowd_scene(CROWD_QUADS, 30000, 23);
    Bvh one = tree_of(&scene, 1), many = tree_of(&scene, 5);
    TEST_ASSERT_TRUE(same_subtree(&one, &many, 0));
    bvh_free(&one);
    bvh_free(&many);
    scene_free(&scene);
}

/* As many faces as are sorted in several pieces. */
static void a_sorted_tree_should_not_depend_on_the_threads(void)
{
    Scene scene = crowd_scene(CROWD_QUADS, 300000, 23);
    Bvh one = sorted_tree_of(&scene, 1), many = sorted_tree_of(&scene, 5);
    TEST_ASSERT_TRUE(same_subtree(&one, &many, 0));
    static int seen[300000];
    check_node(&one, &scene, 0, 0, seen);
    for (int i = 0; i < 300000; i++)
        TEST_ASSERT_EQUAL_INT(1, seen[i]);
    bvh_free(&one);
    bvh_free(&many);
    scene_free(&scene);
}

/* --- The same tree as the plain builder's, whatever is done to be fast --- */

static void compare_with_plain(const Scene *scene, const char *told)
{
    Bvh plain = plain_bvh(scene), one = tree_of(scene, 1), many = tree_of(scene, 3);
    TEST_ASSERT_TRUE_MESSAGE(same_subtree(&plain, &one, 0), told);
    TEST_ASSERT_TRUE_MESSAGE(same_subtree(&plain, &many, 0), told);
    bvh_free(&plain);
    bvh_free(&one);
    bvh_free(&many);
}

/* Every second face that lies across an axis at 0 lies at -0: an equal number, but other bits. */
static void negate_zeros(Scene *scene)
{
    for (int i = 0; i < scene->face_count; i += 2)
        for (int k = 0; k < 12; k++)
            if (scene->faces[i].vertices[k / 3][k % 3] == 0)
                scene->faces[i].vertices[k / 3][k % 3] = -0.0f;
}

static void the_tree_should_be_the_plain_builder_s_node_for_node(void)
{
    static const int counts[] = {1, 2, 3, 7, 8, 9, 16, 17, 31, 32, 33, 500, 5000};
    for (int kind = 0; kind < CROWD_KINDS; kind++)
        for (size_t i = 0; i < sizeof counts / sizeof *counts; i++) {
            Scene scene = crowd_scene((Crowd)kind, counts[i], 31 + (unsigned)i);
            negate_zeros(&scene);
            char told[64];
            snprintf(told, sizeof told, "crowd %d of %d faces", kind, counts[i]);
            compare_with_plain(&scene, told);
            scene_free(&scene);
        }
}

static void large_faces_should_be_set_apart_as_the_plain_builder_does(void)
{
    for (int large = 0; large <= 5; large++) {
        Scene scene = crowd_scene(CROWD_TILES, 128, 17);
        for (int i = 0; i < large; i++) {
            int face = (i * 37 + 5) % 128;
            scene.faces[face] = face_at_height(-20 - i, -20, 20, 20 + i, -1 - i);
            scene.planes[face] = face_plane(&scene.faces[face]);
        }
        compare_with_plain(&scene, "large faces");
        scene_free(&scene);
    }
}

/* More faces than one thread takes: the top of the tree is built level by level. */
static void a_large_tree_should_be_the_plain_builder_s(void)
{
    Scene quads = crowd_scene(CROWD_QUADS, 40000, 5), equal = crowd_scene(CROWD_EQUAL, 20000, 5);
    compare_with_plain(&quads, "many quads");
    compare_with_plain(&equal, "many equal faces");
    scene_free(&quads);
    scene_free(&equal);
}

/* --- How good it is: what a random line through the root costs, a box test a face test each --- */

static double tree_cost(const Bvh *bvh, int index)
{
    const BvhNode *node = &bvh->nodes[index];
    double area = box_half_area(node->box);
    return node->count > 0 ? area * node->count : area + tree_cost(bvh, index + 1) + tree_cost(bvh, node->first);
}

static int sort_axis;

static int compare_middles(const void *a, const void *b)
{
    const Box *x = a, *y = b;
    float p = x->low[sort_axis] + x->high[sort_axis], q = y->low[sort_axis] + y->high[sort_axis];
    return (p > q) - (p < q);
}

/* The same cost for a tree that halves the faces across the longest axis, down to four. */
static double median_cost(Box *boxes, int count)
{
    Box all = box_empty();
    for (int i = 0; i < count; i++)
        all = box_union(all, boxes[i]);
    if (count <= 4)
        return box_half_area(all) * count;
    float size[3];
    for (int axis = 0; axis < 3; axis++)
        size[axis] = all.high[axis] - all.low[axis];
    sort_axis = size[0] >= size[1] && size[0] >= size[2] ? 0 : size[1] >= size[2] ? 1 : 2;
    qsort(boxes, (size_t)count, sizeof *boxes, compare_middles);
    return box_half_area(all) + median_cost(boxes, count / 2) + median_cost(boxes + count / 2, count - count / 2);
}

static void the_heuristic_should_beat_halving(void)
{
    for (int kind = 0; kind < CROWD_EQUAL; kind++) {
        Scene scene = crowd_scene((Crowd)kind, FACES, 29);
        Bvh bvh = tree_of(&scene, 1);
        static Box boxes[FACES];
        for (int i = 0; i < FACES; i++)
            boxes[i] = face_box(&scene.faces[i], &scene.planes[i]);
        TEST_ASSERT_TRUE(tree_cost(&bvh, 0) <= 1.001 * median_cost(boxes, FACES));
        bvh_free(&bvh);
        scene_free(&scene);
    }
}

/* Some of the crowds are flat, which cells of unequal sides would spoil. */
static void sorting_should_cost_little_more_than_the_heuristic(void)
{
    for (int kind = 0; kind < CROWD_EQUAL; kind++) {
        Scene scene = crowd_scene((Crowd)kind, FACES, 29);
        Bvh split = tree_of(&scene, 1), sorted = sorted_tree_of(&scene, 1);
        double ratio = tree_cost(&sorted, 0) / tree_cost(&split, 0);
        TEST_ASSERT_TRUE_MESSAGE(ratio < 1.2, "by sorting / by the heuristic");
        bvh_free(&split);
        bvh_free(&sorted);
        scene_free(&scene);
    }
}

int main(void)
{
    UNITY_BEGIN();
    RUN_TEST(each_face_should_be_in_one_leaf_and_in_all_boxes_above);
    RUN_TEST(a_floor_below_many_faces_should_be_set_apart_at_the_root);
    RUN_TEST(one_face_should_be_a_leaf);
    RUN_TEST(the_tree_should_not_depend_on_the_threads);
    RUN_TEST(a_sorted_tree_should_not_depend_on_the_threads);
    RUN_TEST(the_tree_should_be_the_plain_builder_s_node_for_node);
    RUN_TEST(large_faces_should_be_set_apart_as_the_plain_builder_does);
    RUN_TEST(a_large_tree_should_be_the_plain_builder_s);
    RUN_TEST(the_heuristic_should_beat_halving);
    RUN_TEST(sorting_should_cost_little_more_than_the_heuristic);
    return UNITY_END();
}

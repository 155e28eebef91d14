/* The tree as the kernels walk it: it holds what the binary tree holds, and no other wide nodes are met more seldom. */
#include "kernels/shared/layout.h" /* before the system's limits.h, which has a PATH_MAX of its own */

#include "opencl/device_tree.h"

#include "support/crowds.h"

#include "unity.h"

enum { FACES = 500, FEW = 14, MANY = 80000, WIDTHS = 3 };

static const int widths[WIDTHS] = {4, 8, 16};
static Error error;

void setUp(void)
{
    error = (Error){.kind = ERROR_NONE};
}
void tearDown(void) {}

/* closed[i] is i % 7: a side of a closed box, or 0. */
typedef struct Trees {
    Scene scene;
    unsigned char closed[MANY];
    Accel accel;
    DeviceTree packed;
} Trees;

static Trees trees_of(Crowd kind, int faces, int width)
{
    Trees trees = {.scene = crowd_scene(kind, faces, 23)};
    for (int i = 0; i < faces; i++)
        trees.closed[i] = (unsigned char)(i % 7);
    DevicePlan plan = {trees.closed, width, 1};
    TEST_ASSERT_TRUE(accel_build(&trees.accel, &trees.scene, ACCEL_BVH, 1, &error));
    TEST_ASSERT_TRUE(device_tree_pack(&trees.packed, &trees.accel, &plan, &error));
    return trees;
}

static void trees_free(Trees *trees)
{
    device_tree_free(&trees->packed);
    accel_free(&trees->accel);
    scene_free(&trees->scene);
}

static Box child_box(const DeviceTree *tree, int node, int child)
{
    const float *boxes = tree->floats + (size_t)node * 6 * (size_t)tree->node_width + child;
    Box box;
    for (int axis = 0; axis < 3; axis++) {
        box.low[axis] = boxes[2 * axis * tree->node_width];
        box.high[axis] = boxes[(2 * axis + 1) * tree->node_width];
    }
    return box;
}

static bool box_holds(Box outer, Box inner)
{
    for (int axis = 0; axis < 3; axis++)
        if (inner.low[axis] < outer.low[axis] || inner.high[axis] > outer.high[axis])
            return false;
    return true;
}

/* Only a leaf of one side of a closed box has that side's key. */
static void check_key(const Trees *trees, int child)
{
    int closed = child < 0 && LEAF_COUNT(child) == 1 ? trees->closed[trees->accel.bvh.order[LEAF_FIRST(child)]] : 0;
    for (int side = 0; side < 6; side++)
        TEST_ASSERT_EQUAL_INT(closed == 1 + side, LEAF_KEY(child) == SIDE_KEY(side));
}

/* Counts each face below a wide node in seen; returns the sum of the areas of the wide nodes. */
static double check_node(const Trees *trees, int node, Box outer, int *seen)
{
    const DeviceTree *tree = &trees->packed;
    Box whole = box_empty();
    double area = 0;
    for (int i = 0; i < tree->node_width; i++) {
        int child = tree->ints[node * tree->node_width + i];
        if (child == NO_CHILD)
            continue;
        Box box = child_box(tree, node, i);
        TEST_ASSERT_TRUE(box_holds(outer, box));
        check_key(trees, child);
        box_grow(&whole, &box);
        if (child >= 0) {
            area += check_node(trees, child, box, seen);
            continue;
        }
        for (int k = LEAF_FIRST(child); k < LEAF_FIRST(child) + LEAF_COUNT(child); k++) {
            int face = trees->accel.bvh.order[k];
            TEST_ASSERT_TRUE(box_holds(box, face_box(&trees->scene.faces[face], &trees->scene.planes[face])));
            seen[face]++;
        }
    }
    return area + box_half_area(whole);
}

static const Box everywhere = {{-FLT_MAX, -FLT_MAX, -FLT_MAX}, {FLT_MAX, FLT_MAX, FLT_MAX}};

static void each_face_should_be_in_one_leaf_and_in_all_boxes_above(void)
{
    for (int kind = 0; kind < CROWD_KINDS; kind++)
        for (int w = 0; w < WIDTHS; w++) {
            Trees trees = trees_of((Crowd)kind, FACES, widths[w]);
            int seen[FACES] = {0};
            check_node(&trees, 0, everywhere, seen);
            for (int i = 0; i < FACES; i++)
                TEST_ASSERT_EQUAL_INT(1, seen[i]);
            trees_free(&trees);
        }
}

static double least_shared(const double *left, const double *right, int places)
{
    double least = HUGE_VAL;
    for (int k = 1; k < places; k++)
        least = left[k] + right[places - k] < least ? left[k] + right[places - k] : least;
    return least;
}

/* The least sums of the areas of the wide nodes below `node`, by the places that it gets in the one above: 1 to width -
 * 1. Tries all. */
static void least_areas(const Bvh *bvh, int node, int width, double *areas)
{
    const BvhNode *root = &bvh->nodes[node];
    double left[16], right[16];
    for (int places = 1; places < width; places++)
        areas[places] = 0;
    if (root->count > 0)
        return;
    least_areas(bvh, node + 1, width, left);
    least_areas(bvh, root->first, width, right);
    double own = box_half_area(root->box) + least_shared(left, right, width);
    for (int places = 1; places < width; places++)
        areas[places] = fmin(own, least_shared(left, right, places));
}

static void the_areas_of_the_wide_nodes_should_be_the_least(void)
{
    for (int kind = 0; kind < CROWD_EQUAL; kind++) {
        Trees trees = trees_of((Crowd)kind, FEW, 4);
        int seen[FEW] = {0};
        double area = check_node(&trees, 0, everywhere, seen), least[16];
        least_areas(&trees.accel.bvh, 0, 4, least);
        TEST_ASSERT_DOUBLE_WITHIN(1e-9 * least[1], least[1], area);
        trees_free(&trees);
    }
}

static void one_face_should_be_the_root_s_only_child(void)
{
    Trees trees = trees_of(CROWD_QUADS, 1, 16);
    TEST_ASSERT_EQUAL_INT(LEAF(0, 1), trees.packed.ints[0]);
    for (int i = 1; i < 16; i++)
        TEST_ASSERT_EQUAL_INT(NO_CHILD, trees.packed.ints[i]);
    trees_free(&trees);
}

/* The nodes below `node`, which is numbered `next`, are numbered from the root down, child after child. Returns the
 * first number that is left. */
static int check_numbers(const DeviceTree *tree, int node, int next, int level, int *depth)
{
    TEST_ASSERT_EQUAL_INT(next++, node);
    *depth = level > *depth ? level : *depth;
    for (int i = 0; i < tree->node_width; i++) {
        int child = tree->ints[node * tree->node_width + i];
        if (child != NO_CHILD && child >= 0)
            next = check_numbers(tree, child, next, level + 1, depth);
    }
    return next;
}

/* A tree so large that threads share it. */
static void a_large_tree_should_be_as_a_small_one_whatever_the_threads(void)
{
    Trees trees = trees_of(CROWD_QUADS, MANY, 16);
    const DeviceTree *one = &trees.packed;
    DeviceTree many;
    int depth = 0, nodes = check_numbers(one, 0, 0, 1, &depth);
    TEST_ASSERT_EQUAL_INT(one->int_count, nodes * 16);
    TEST_ASSERT_GREATER_OR_EQUAL_INT(1 + depth * 15, one->stack_size);
    TEST_ASSERT_LESS_THAN_INT(2 * (1 + depth * 15), one->stack_size);
    static int seen[MANY];
    double area = check_node(&trees, 0, everywhere, seen), least[16];
    least_areas(&trees.accel.bvh, 0, 16, least);
    TEST_ASSERT_DOUBLE_WITHIN(1e-9 * least[1], least[1], area);
    for (int i = 0; i < MANY; i++)
        TEST_ASSERT_EQUAL_INT(1, seen[i]);
    DevicePlan plan = {trees.closed, 16, 3};
    TEST_ASSERT_TRUE(device_tree_pack(&many, &trees.accel, &plan, &error));
    TEST_ASSERT_EQUAL_MEMORY(one->ints, many.ints, one->int_count * sizeof(int));
    TEST_ASSERT_EQUAL_MEMORY(one->floats, many.floats, one->float_count * sizeof(float));
    device_tree_free(&many);
    trees_free(&trees);
}

int main(void)
{
    UNITY_BEGIN();
    RUN_TEST(each_face_should_be_in_one_leaf_and_in_all_boxes_above);
    RUN_TEST(the_areas_of_the_wide_nodes_should_be_the_least);
    RUN_TEST(one_face_should_be_the_root_s_only_child);
    RUN_TEST(a_large_tree_should_be_as_a_small_one_whatever_the_threads);
    return UNITY_END();
}

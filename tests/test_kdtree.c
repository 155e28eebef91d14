/* The k-d tree: what every tree must be, and how good it is. */
#include "trace/kdtree.h"

#include "support/crowds.h"
#include "support/xorshift.h"

#include "unity.h"

#include <string.h>

enum { FACES = 1500 };

static Error error;

void setUp(void)
{
    error = (Error){.kind = ERROR_NONE};
}
void tearDown(void) {}

static KdTree tree_of(const Scene *scene, int threads)
{
    KdTree tree;
    TEST_ASSERT_TRUE(kdtree_build(&tree, scene, threads, &error));
    return tree;
}

typedef struct Check {
    const KdTree *tree;
    const Scene *scene;
    int nodes, in_leaves, seen[FACES];
} Check;

static bool boxes_touch(Box a, Box b)
{
    for (int axis = 0; axis < 3; axis++)
        if (a.low[axis] > b.high[axis] || b.low[axis] > a.high[axis])
            return false;
    return true;
}

static Box low_side(const KdNode *node, Box box)
{
    box.high[node->axis] = node->split;
    return box;
}

static Box high_side(const KdNode *node, Box box)
{
    box.low[node->axis] = node->split;
    return box;
}

static void check_leaf(Check *check, const KdNode *node, Box box)
{
    TEST_ASSERT_EQUAL_INT(check->in_leaves, node->first);
    for (int i = 0; i < node->count; i++) {
        int face = check->tree->order[node->first + i];
        TEST_ASSERT_TRUE(i == 0 || face > check->tree->order[node->first + i - 1]);
        TEST_ASSERT_TRUE(boxes_touch(box, face_box(&check->scene->faces[face], &check->scene->planes[face])));
        check->seen[face]++;
    }
    check->in_leaves += node->count;
}

/* Checks the subtree whose space is `box`. */
static void check_node(Check *check, int index, int depth, Box box)
{
    const KdNode *node = &check->tree->nodes[index];
    TEST_ASSERT_LESS_OR_EQUAL_INT(KDTREE_MAX_DEPTH, depth);
    TEST_ASSERT_EQUAL_INT(check->nodes, index); /* depth first, without gaps */
    check->nodes++;
    if (node->axis == KDTREE_LEAF) {
        check_leaf(check, node, box);
        return;
    }
    TEST_ASSERT_TRUE(box.low[node->axis] <= node->split && node->split <= box.high[node->axis]);
    check_node(check, index + 1, depth + 1, low_side(node, box));
    check_node(check, node->first, depth + 1, high_side(node, box));
}

static void each_face_should_be_in_leaves_that_it_touches(void)
{
    static Check check;
    for (int kind = 0; kind < CROWD_KINDS; kind++) {
        Scene scene = crowd_scene((Crowd)kind, FACES, 17);
        KdTree tree = tree_of(&scene, 1);
        memset(&check, 0, sizeof check);
        check.tree = &tree;
        check.scene = &scene;
        check_node(&check, 0, 0, tree.box);
        TEST_ASSERT_EQUAL_INT(tree.node_count, check.nodes);
        TEST_ASSERT_EQUAL_INT(tree.order_count, check.in_leaves);
        TEST_ASSERT_LESS_OR_EQUAL_INT(KDTREE_MAX_COPIES * FACES, tree.order_count);
        for (int i = 0; i < FACES; i++)
            TEST_ASSERT_GREATER_THAN_INT(0, check.seen[i]);
        kdtree_free(&tree);
        scene_free(&scene);
    }
}

/* Is the face in a leaf whose closed space holds the point? */
static bool is_found_at(const KdTree *tree, int index, int face, const float *point)
{
    const KdNode *node = &tree->nodes[index];
    if (node->axis == KDTREE_LEAF) {
        for (int i = 0; i < node->count; i++)
            if (tree->order[node->first + i] == face)
                return true;
        return false;
    }
    return (point[node->axis] <= node->split && is_found_at(tree, index + 1, face, point)) ||
           (point[node->axis] >= node->split && is_found_at(tree, node->first, face, point));
}

static void a_face_should_be_found_all_over_its_box(void)
{
    for (int kind = 0; kind < CROWD_KINDS; kind++) {
        Scene scene = crowd_scene((Crowd)kind, FACES, 19);
        KdTree tree = tree_of(&scene, 1);
        uint64_t state = 41;
        for (int i = 0; i < 20 * FACES; i++) {
            int face = i % FACES;
            Box box = face_box(&scene.faces[face], &scene.planes[face]);
            float point[3];
            for (int axis = 0; axis < 3; axis++) {
                float part = (float)(random_next(&state) % 5) / 4;
                point[axis] = part == 1 ? box.high[axis] : box.low[axis] + part * (box.high[axis] - box.low[axis]);
            }
            TEST_ASSERT_TRUE(is_found_at(&tree, 0, face, point));
        }
        kdtree_free(&tree);
        scene_free(&scene);
    }
}

static void one_face_should_be_one_leaf(void)
{
    Scene scene = crowd_scene(CROWD_QUADS, 1, 17);
    KdTree tree = tree_of(&scene, 2);
    TEST_ASSERT_EQUAL_INT(1, tree.order_count);
    kdtree_free(&tree);
    kdtree_free(&tree);
    scene_free(&scene);
}

static void equal_faces_should_share_a_leaf(void)
{
    Scene scene = crowd_scene(CROWD_EQUAL, 20000, 17);
    KdTree tree = tree_of(&scene, 2);
    TEST_ASSERT_EQUAL_INT(20000, tree.order_count);
    TEST_ASSERT_LESS_THAN_INT(10, tree.node_count);
    kdtree_free(&tree);
    scene_free(&scene);
}

/* Quads as large as the whole scene: every cut meets most of them. */
static void large_faces_should_not_multiply_without_bound(void)
{
    Scene scene = crowd_scene(CROWD_QUADS, 6000, 31);
    uint64_t state = 5;
    for (int i = 0; i < scene.face_count; i++) {
        scene.faces[i] = parallelogram(random_point(&state, 1), random_point(&state, 6), random_point(&state, 5), 0);
        scene.planes[i] = face_plane(&scene.faces[i]);
    }
    KdTree tree = tree_of(&scene, 2);
    TEST_ASSERT_LESS_OR_EQUAL_INT(KDTREE_MAX_COPIES * 6000, tree.order_count);
    kdtree_free(&tree);
    scene_free(&scene);
}

static void the_tree_should_not_depend_on_the_threads(void)
{
    Scene scene = crowd_scene(CROWD_BOXES, 30000, 23);
    KdTree one = tree_of(&scene, 1), many = tree_of(&scene, 5);
    TEST_ASSERT_EQUAL_INT(one.node_count, many.node_count);
    TEST_ASSERT_EQUAL_INT(one.order_count, many.order_count);
    TEST_ASSERT_EQUAL_MEMORY(one.nodes, many.nodes, (size_t)one.node_count * sizeof *one.nodes);
    TEST_ASSERT_EQUAL_MEMORY(one.order, many.order, (size_t)one.order_count * sizeof *one.order);
    kdtree_free(&one);
    kdtree_free(&many);
    scene_free(&scene);
}

/* --- How good it is: what a random line through the root costs, a step a face test --- */

static double tree_cost(const KdTree *tree, int index, Box box)
{
    const KdNode *node = &tree->nodes[index];
    double area = box_half_area(box);
    if (node->axis == KDTREE_LEAF)
        return area * node->count;
    return area + tree_cost(tree, index + 1, low_side(node, box)) + tree_cost(tree, node->first, high_side(node, box));
}

/* The same cost for a tree of depth 14 that halves space across its longest axis while a leaf has more than 8 faces. */
static double halving_cost(const Box *boxes, int count, Box box, int depth)
{
    if (count <= 8 || depth == 14)
        return box_half_area(box) * count;
    KdNode node = {.axis = 0};
    for (int axis = 1; axis < 3; axis++)
        if (box.high[axis] - box.low[axis] > box.high[node.axis] - box.low[node.axis])
            node.axis = axis;
    node.split = (box.low[node.axis] + box.high[node.axis]) / 2;
    Box sides[] = {low_side(&node, box), high_side(&node, box)};
    double cost = box_half_area(box);
    Box *inside = malloc((size_t)count * sizeof *inside);
    TEST_ASSERT_NOT_NULL(inside);
    for (int side = 0; side < 2; side++) {
        int kept = 0;
        for (int i = 0; i < count; i++)
            if (boxes_touch(boxes[i], sides[side]))
                inside[kept++] = boxes[i];
        cost += halving_cost(inside, kept, sides[side], depth + 1);
    }
    free(inside);
    return cost;
}

static void the_heuristic_should_beat_halving(void)
{
    for (int kind = 0; kind < CROWD_EQUAL; kind++) {
        Scene scene = crowd_scene((Crowd)kind, FACES, 29);
        KdTree tree = tree_of(&scene, 1);
        static Box boxes[FACES];
        for (int i = 0; i < FACES; i++)
            boxes[i] = face_box(&scene.faces[i], &scene.planes[i]);
        TEST_ASSERT_TRUE(tree_cost(&tree, 0, tree.box) <= halving_cost(boxes, FACES, tree.box, 0));
        kdtree_free(&tree);
        scene_free(&scene);
    }
}

int main(void)
{
    UNITY_BEGIN();
    RUN_TEST(each_face_should_be_in_leaves_that_it_touches);
    RUN_TEST(a_face_should_be_found_all_over_its_box);
    RUN_TEST(one_face_should_be_one_leaf);
    RUN_TEST(equal_faces_should_share_a_leaf);
    RUN_TEST(large_faces_should_not_multiply_without_bound);
    RUN_TEST(the_tree_should_not_depend_on_the_threads);
    RUN_TEST(the_heuristic_should_beat_halving);
    return UNITY_END();
}

/* Which nodes of the binary hierarchy a wide node takes in: from the leaves upwards, the least cost for every number of
 * places. Threads take subtrees; what is above them is left for one. */
#include "opencl/wide_cut.h"

#include "base/parallel.h"

#include <assert.h>
#include <math.h>
#include <stdlib.h>

/* Fewer faces are cut sooner than a thread starts. */
enum { MIN_TASK = 1 << 15, TASKS = 32 };

/* 4 bits for each number of places. */
#define EACH_NUMBER 0x1111111111111111u

/* The least areas of the wide nodes in a subtree, by the places that it gets: fewer than the width,
 * and no more than it has leaves. With a place for each leaf there are no wide nodes below. */
typedef struct CutCosts {
    double area[WIDE_MAX]; /* from 1 on */
    int leaves;            /* up to the width */
} CutCosts;

/* A subtree over n faces owns 2n places in the array of nodes, so that the places tell the faces. */
static Subtree child_of(const Bvh *bvh, Subtree root, int side)
{
    int first = bvh->nodes[root.node].first, left = (first - root.node) / 2;
    return side == 0 ? (Subtree){root.node + 1, left} : (Subtree){first, root.faces - left};
}

/* Shares so many places, fewer than there are leaves, between two children. *first: what the first one gets. */
static double share(const CutCosts *left, const CutCosts *right, int places, int *first)
{
    double least = HUGE_VAL;
    for (int k = places > right->leaves ? places - right->leaves : 1; k < places && k <= left->leaves; k++) {
        double area = left->area[k] + right->area[places - k];
        if (area < least) {
            least = area;
            *first = k;
        }
    }
    return least;
}

/* What a leaf costs: nothing, in any number of places. */
static void cut_leaf(CutCosts *costs)
{
    costs->area[1] = 0;
    costs->leaves = 1;
}

/* The costs of an inner node, by those of its two children. */
static void cut_node(WideCut *cut, int node, const CutCosts sides[2], CutCosts *costs)
{
    const CutCosts *left = &sides[0], *right = &sides[1];
    int leaves = left->leaves + right->leaves, width = cut->width, first = 0;
    assert(left->leaves >= 1 && right->leaves >= 1 && width >= 2);
    double alone = box_half_area(cut->bvh->nodes[node].box);
    uint64_t shares;
    if (leaves <= width) {
        /* With a place for each leaf the first child gets as many as it has leaves, however many more there are. */
        shares = (uint64_t)left->leaves * EACH_NUMBER << 4 * (leaves - 1);
        if (leaves < width)
            costs->area[leaves] = 0;
    } else {
        alone += share(left, right, width, &first);
        shares = (uint64_t)first << 4 * (width - 1);
    }
    costs->area[1] = alone;
    for (int places = 2; places < width && places < leaves; places++) {
        double shared = share(left, right, places, &first);
        costs->area[places] = shared <= alone ? shared : alone;
        if (shared <= alone)
            shares |= (uint64_t)first << 4 * (places - 1);
    }
    costs->leaves = leaves < width ? leaves : width;
    cut->shares[node] = shares;
}

static void cut_subtree(WideCut *cut, int node, CutCosts *costs)
{
    const BvhNode *root = &cut->bvh->nodes[node];
    if (root->count > 0) {
        cut_leaf(costs);
        return;
    }
    CutCosts sides[2];
    cut_subtree(cut, node + 1, &sides[0]);
    cut_subtree(cut, root->first, &sides[1]);
    cut_node(cut, node, sides, costs);
}

/* --- Subtrees for the threads --- */

typedef struct Tasks {
    WideCut *cut;
    Subtree *roots; /* in the order of the tree */
    CutCosts *costs;
    int size, next; /* faces of a task; the next task that the top takes in */
} Tasks;

int wide_cut_task(const Bvh *bvh)
{
    return bvh->face_count / TASKS > MIN_TASK ? bvh->face_count / TASKS : MIN_TASK;
}

static bool is_task(const Tasks *tasks, Subtree root)
{
    return root.faces <= tasks->size || tasks->cut->bvh->nodes[root.node].count > 0;
}

/* Counts the tasks below a root, and lists them where there is a list. */
static int find_tasks(const Tasks *tasks, Subtree root, int count)
{
    if (!is_task(tasks, root)) {
        count = find_tasks(tasks, child_of(tasks->cut->bvh, root, 0), count);
        return find_tasks(tasks, child_of(tasks->cut->bvh, root, 1), count);
    }
    if (tasks->roots)
        tasks->roots[count] = root;
    return count + 1;
}

static void cut_task(void *data, int i, int thread)
{
    const Tasks *tasks = data;
    (void)thread;
    cut_subtree(tasks->cut, tasks->roots[i].node, &tasks->costs[i]);
}

static void cut_top(Tasks *tasks, Subtree root, CutCosts *costs)
{
    if (is_task(tasks, root)) {
        *costs = tasks->costs[tasks->next++];
        return;
    }
    CutCosts sides[2];
    for (int side = 0; side < 2; side++)
        cut_top(tasks, child_of(tasks->cut->bvh, root, side), &sides[side]);
    cut_node(tasks->cut, root.node, sides, costs);
}

bool wide_cut_find(WideCut *cut, const Bvh *bvh, int width, int threads, Error *error)
{
    Subtree root = {0, bvh->face_count};
    *cut = (WideCut){bvh, malloc(2 * (size_t)bvh->face_count * sizeof *cut->shares), width};
    Tasks tasks = {.cut = cut, .size = wide_cut_task(bvh)};
    int count = find_tasks(&tasks, root, 0);
    tasks.roots = malloc((size_t)count * sizeof *tasks.roots);
    tasks.costs = malloc((size_t)count * sizeof *tasks.costs);
    bool ok = cut->shares && tasks.roots && tasks.costs;
    if (ok) {
        CutCosts costs;
        find_tasks(&tasks, root, 0);
        parallel_for(threads, count, cut_task, &tasks);
        cut_top(&tasks, root, &costs);
    }
    free(tasks.roots);
    free(tasks.costs);
    return ok || error_memory(error, "the tree for the device");
}

void wide_cut_free(WideCut *cut)
{
    free(cut->shares);
    *cut = (WideCut){0};
}

static int first_share(const WideCut *cut, int node, int places)
{
    return (int)(cut->shares[node] >> 4 * (places - 1) & 15);
}

/* The wide nodes below a node that gets so many places. */
static int count_below(const WideCut *cut, int node, int places)
{
    const BvhNode *root = &cut->bvh->nodes[node];
    if (root->count > 0)
        return 0;
    int first = first_share(cut, node, places), own = first == 0;
    if (own)
        places = cut->width, first = first_share(cut, node, places);
    return own + count_below(cut, node + 1, first) + count_below(cut, root->first, places - first);
}

int wide_cut_count(const WideCut *cut, int node)
{
    return cut->bvh->nodes[node].count > 0 ? 1 : 1 + count_below(cut, node, cut->width);
}

/* Adds to the list the subtrees that fill so many places for this one; returns how many are in it. */
static int gather(const WideCut *cut, Subtree root, int places, Subtree *list, int count)
{
    bool leaf = cut->bvh->nodes[root.node].count > 0;
    int first = leaf ? 0 : first_share(cut, root.node, places);
    if (first == 0) {
        list[count] = root;
        return count + 1;
    }
    count = gather(cut, child_of(cut->bvh, root, 0), first, list, count);
    return gather(cut, child_of(cut->bvh, root, 1), places - first, list, count);
}

int wide_cut_children(const WideCut *cut, Subtree root, Subtree *children)
{
    return gather(cut, root, cut->width, children, 0);
}

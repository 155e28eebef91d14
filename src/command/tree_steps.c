/* How a tree is built, as text. */
#include "command/tree_steps.h"

#include "trace/tree_step.h"

#include <stdio.h>

/* Of the planes across an axis, at most so many are listed: the cheapest. Unless all are wanted. */
enum { PLANES_LISTED = 8 };

typedef struct Printer {
    const Scene *scene;
    const Accel *accel;
    bool all_planes;
} Printer;

static int count_across(const TreeStep *step, int axis)
{
    int count = 0;
    for (int i = 0; i < step->candidate_count; i++)
        count += step->candidates[i].axis == axis;
    return count;
}

/* How many planes across the same axis cost less; of equal ones the first is the cheaper. */
static int rank_of(const TreeStep *step, int index)
{
    int rank = 0;
    for (int i = 0; i < step->candidate_count; i++)
        if (step->candidates[i].axis == step->candidates[index].axis)
            rank += step->candidates[i].cost < step->candidates[index].cost ||
                    (step->candidates[i].cost == step->candidates[index].cost && i < index);
    return rank;
}

static void print_axis(const Printer *printer, const TreeStep *step, int axis)
{
    int count = count_across(step, axis);
    if (count == 0) {
        printf("    %c: no plane to try\n", "xyz"[axis]);
        return;
    }
    printf("    %c: %d plane%s", "xyz"[axis], count, count == 1 ? "" : "s");
    bool all = printer->all_planes || count <= PLANES_LISTED;
    printf(all ? ":\n" : ", the %d cheapest:\n", PLANES_LISTED);
    printf("      %12s %8s %8s %12s\n", "at", "low", "high", "cost");
    double centre = vec3_component(printer->scene->centre, axis);
    for (int i = 0; i < step->candidate_count; i++) {
        const TreeCandidate *candidate = &step->candidates[i];
        if (candidate->axis == axis && (all || rank_of(step, i) < PLANES_LISTED))
            printf("      %12.6g %8d %8d %12.6g%s\n", candidate->plane + centre, candidate->low, candidate->high,
                   candidate->cost, i == step->chosen ? "  cheapest" : "");
    }
}

static void print_choice(const Printer *printer, const TreeStep *step)
{
    const AccelNode *node = &step->shape;
    int in_both = step->low + step->high - step->faces;
    if (node->leaf) {
        printf("    Node %d becomes a leaf of %d face%s: no cut costs less than testing all of them.\n", step->node,
               step->faces, step->faces == 1 ? "" : "s");
        return;
    }
    if (node->axis >= 0)
        printf("    Cut by the plane %c = %.6g", "xyz"[node->axis],
               (double)node -> split + vec3_component(printer->scene->centre, node->axis));
    else if (step->set_apart > 0)
        printf("    %d face%s fill more than half of the box and would spoil all boxes below: set apart",
               step->set_apart, step->set_apart == 1 ? "" : "s");
    else
        printf("    Split there");
    printf(", into node %d (%d face%s) and node %d (%d face%s).\n", node->low, step->low, step->low == 1 ? "" : "s",
           node->high, step->high, step->high == 1 ? "" : "s");
    if (in_both > 0)
        printf("    %d face%s on both sides.\n", in_both, in_both == 1 ? " is" : "s are");
}

static void print_step(void *user, const TreeStep *step)
{
    const Printer *printer = user;
    const Box *box = &step->shape.box;
    Vec3 c = printer->scene->centre;
    printf("%sStep %d. Node %d, on level %d: %d face%s in (%.6g, %.6g, %.6g) to (%.6g, %.6g, %.6g)\n\n",
           step->number > 1 ? "\n" : "", step->number, step->node, step->level, step->faces,
           step->faces == 1 ? "" : "s", (double)box->low[0] + c.x, (double)box->low[1] + c.y, (double)box->low[2] + c.z,
           (double)box->high[0] + c.x, (double)box->high[1] + c.y, (double)box->high[2] + c.z);
    printf("    As a leaf it costs %d face test%s. With a cut:\n", step->faces, step->faces == 1 ? "" : "s");
    for (int axis = 0; axis < 3; axis++)
        print_axis(printer, step, axis);
    print_choice(printer, step);
}

bool tree_steps_print(const Scene *scene, const Accel *accel, int count, bool all_planes, Error *error)
{
    Printer printer = {scene, accel, all_planes};
    return tree_steps(scene, accel, count, print_step, &printer, error);
}

/* What a tree looks like as a whole. */
#include "trace/tree_survey.h"

#include "trace/bvh_split.h"
#include "trace/kdtree_voxel.h"

static void survey_node(const Accel *accel, int index, int level, double root_area, TreeSurvey *survey)
{
    AccelNode node = accel_node(accel, index);
    double chance = root_area > 0 ? box_half_area(node.box) / root_area : 1;
    double step = accel->kind == ACCEL_BVH ? BVH_NODE_COST : KDTREE_STEP_COST;
    survey->nodes++;
    survey->depth = level > survey->depth ? level : survey->depth;
    survey->expected_nodes += chance;
    if (!node.leaf) {
        survey->sah_cost += chance * step;
        survey_node(accel, node.low, level + 1, root_area, survey);
        survey_node(accel, node.high, level + 1, root_area, survey);
        return;
    }
    survey->leaves++;
    survey->entries += node.faces;
    survey->most = node.faces > survey->most ? node.faces : survey->most;
    survey->of_size[node.faces < TREE_LEAF_SIZES ? node.faces : TREE_LEAF_SIZES - 1]++;
    survey->expected_tests += chance * node.faces;
    survey->sah_cost += chance * node.faces;
}

TreeSurvey tree_survey(const Accel *accel)
{
    TreeSurvey survey = {.nodes = 0};
    survey_node(accel, 0, 0, box_half_area(accel_node(accel, 0).box), &survey);
    bool bvh = accel->kind == ACCEL_BVH;
    survey.bytes = (double)survey.nodes * (double)(bvh ? sizeof(BvhNode) : sizeof(KdNode)) +
                   (double)survey.entries * (double)sizeof(int);
    return survey;
}

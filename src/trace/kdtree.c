/* A k-d tree, built from the top: cut a voxel where that is cheapest, until no cut pays. The top of the tree is built
 * first and sets small voxels aside; threads then build their subtrees, and the parts are put together in the order in
 * which one thread would have made them. */
#include "trace/kdtree.h"

#include "base/array.h"
#include "base/parallel.h"
#include "trace/kdtree_voxel.h"

#include <limits.h>
#include <stdlib.h>
#include <string.h>

enum { SET_ASIDE = 4 }; /* the axis of a node in whose place a subtree belongs; `first` is the subtree's number */
enum { MIN_SUBTREE = 4096, SUBTREES = 32 };

/* A part of the tree under construction. Its nodes count from its own first one, as do its leaves' faces. */
typedef struct Part {
    KdNode *nodes;
    int node_count, node_capacity;
    int *order;
    int order_count, order_capacity;
    bool failed; /* memory ran short */
} Part;

/* A voxel to be built into a tree at a depth. What lies in its
 * leaves, a face counted once for each, is at most `budget`. */
typedef struct Job {
    Voxel voxel;
    int depth, budget;
    Part part;
} Job;

typedef struct Builder {
    Job *jobs; /* the subtrees set aside */
    int job_count, job_capacity;
    int job_size; /* the faces of a subtree small enough to be set aside; 0 while subtrees are built */
    int max_depth;
} Builder;

static int add_node(Part *part, KdNode node)
{
    if (part->node_count == part->node_capacity) {
        Error unused = {.kind = ERROR_NONE};
        KdNode *grown = array_grown(part->nodes, part->node_count, &part->node_capacity, sizeof *part->nodes,
                                    "the k-d tree", &unused);
        part->failed = part->failed || !grown;
        if (!grown)
            return 0;
        part->nodes = grown;
    }
    part->nodes[part->node_count] = node;
    return part->node_count++;
}

static void add_face(Part *part, int face)
{
    if (part->order_count == part->order_capacity) {
        Error unused = {.kind = ERROR_NONE};
        int *grown = array_grown(part->order, part->order_count, &part->order_capacity, sizeof *part->order,
                                 "the k-d tree", &unused);
        part->failed = part->failed || !grown;
        if (!grown)
            return;
        part->order = grown;
    }
    part->order[part->order_count++] = face;
}

static void add_leaf(Part *part, const int *faces, int count)
{
    add_node(part, (KdNode){0, KDTREE_LEAF, part->order_count, count});
    for (int i = 0; i < count && !part->failed; i++)
        add_face(part, faces[i]);
}

/* Whether cutting a voxel costs less than testing all of its faces: the automatic termination of Wald and Havran. */
static bool cut_pays(const Builder *builder, const Job *job, const VoxelCut *cut)
{
    return cut->cost < job->voxel.face_count && job->depth < builder->max_depth &&
           cut->low_count + cut->high_count <= job->budget;
}

static void set_aside(Builder *builder, const Job *job, Part *part)
{
    Job copy = *job;
    copy.part = (Part){.failed = false};
    Error unused = {.kind = ERROR_NONE};
    Job *jobs =
        array_grown(builder->jobs, builder->job_count, &builder->job_capacity, sizeof *jobs, "the k-d tree", &unused);
    if (jobs)
        builder->jobs = jobs;
    part->failed = part->failed || !jobs || !voxel_copy(&copy.voxel, &job->voxel);
    if (part->failed)
        return;
    add_node(part, (KdNode){.axis = SET_ASIDE, .first = builder->job_count});
    builder->jobs[builder->job_count++] = copy;
}

/* Builds the job's tree into `part` and uses up its voxel; `places` has room for each face of it. */
static void build(Builder *builder, Job *job, VoxelPlaces *places, Part *part)
{
    if (job->voxel.face_count > 0 && job->voxel.face_count <= builder->job_size) {
        set_aside(builder, job, part);
        return;
    }
    VoxelCut cut = voxel_best_cut(&job->voxel, NULL, NULL);
    if (!cut_pays(builder, job, &cut)) {
        add_leaf(part, job->voxel.faces, job->voxel.face_count);
        return;
    }
    Job low = {.depth = job->depth + 1};
    low.budget = (int)((int64_t)job->budget * cut.low_count / (cut.low_count + cut.high_count));
    if (part->failed || !voxel_cut(&job->voxel, &cut, places, &low.voxel)) {
        part->failed = true;
        return;
    }
    job->budget -= low.budget;
    job->depth++;
    int node = add_node(part, (KdNode){.axis = cut.axis, .split = cut.position});
    build(builder, &low, places, part);
    voxel_free(&low.voxel);
    if (part->failed)
        return;

    part->nodes[node].first = part->node_count;
    build(builder, job, places, part);
}

static void build_job(Builder *builder, Job *job, Part *part)
{
    VoxelPlaces *places = malloc((size_t)job->voxel.face_count * sizeof *places);
    if (places)
        build(builder, job, places, part);
    else
        part->failed = true;
    free(places);
    voxel_free(&job->voxel);
}

static void build_set_aside(void *data, int i, int thread)
{
    Builder *builder = data;
    (void)thread;
    build_job(builder, &builder->jobs[i], &builder->jobs[i].part);
}

/* Appends a part's nodes as they are, but for the places to which they point. */
static void append(KdTree *tree, const Part *part)
{
    for (int i = 0; i < part->node_count; i++) {
        KdNode node = part->nodes[i];
        node.first += node.axis == KDTREE_LEAF ? tree->order_count : tree->node_count;
        tree->nodes[tree->node_count + i] = node;
    }
    tree->node_count += part->node_count;
    if (part->order_count > 0)
        memcpy(tree->order + tree->order_count, part->order, (size_t)part->order_count * sizeof(int));
    tree->order_count += part->order_count;
}

/* Appends the top's subtree `index`, with the subtrees that were set aside in their places. */
static void assemble(KdTree *tree, const Builder *builder, const Part *top, int index)
{
    KdNode node = top->nodes[index];
    if (node.axis == SET_ASIDE) {
        append(tree, &builder->jobs[node.first].part);
    } else if (node.axis == KDTREE_LEAF) {
        append(tree, &(Part){.nodes = &(KdNode){.axis = KDTREE_LEAF, .count = node.count},
                             .node_count = 1,
                             .order = top->order + node.first,
                             .order_count = node.count});
    } else {
        int at = tree->node_count++;
        tree->nodes[at] = node;
        assemble(tree, builder, top, index + 1);
        tree->nodes[at].first = tree->node_count;
        assemble(tree, builder, top, node.first);
    }
}

static bool assemble_all(KdTree *tree, const Builder *builder, const Part *top)
{
    size_t nodes = (size_t)top->node_count, faces = (size_t)top->order_count;
    bool failed = top->failed;
    for (int i = 0; i < builder->job_count; i++) {
        nodes += (size_t)builder->jobs[i].part.node_count;
        faces += (size_t)builder->jobs[i].part.order_count;
        failed = failed || builder->jobs[i].part.failed;
    }
    if (failed || nodes > INT_MAX)
        return false;
    tree->nodes = malloc(nodes * sizeof *tree->nodes);
    tree->order = malloc(faces * sizeof *tree->order);
    if (!tree->nodes || !tree->order)
        return false;
    assemble(tree, builder, top, 0);
    return true;
}

static bool build_all(Builder *builder, KdTree *tree, const Scene *scene, int threads)
{
    Job root = {.budget = scene->face_count * KDTREE_MAX_COPIES};
    if (!voxel_of_scene(&root.voxel, scene))
        return false;
    tree->box = root.voxel.box;
    Part top = {.failed = false};
    build_job(builder, &root, &top);
    builder->job_size = 0;
    if (!top.failed)
        parallel_for(threads, builder->job_count, build_set_aside, builder);
    bool done = assemble_all(tree, builder, &top);
    free(top.nodes);
    free(top.order);
    return done;
}

bool kdtree_build(KdTree *tree, const Scene *scene, int threads, Error *error)
{
    *tree = (KdTree){.node_count = 0};
    int count = scene->face_count;
    int depth = (int)(8 + 1.3 * log2(count)); /* where the heuristic errs, no deeper than this (section 3.3) */
    Builder builder = {
        .job_size = count / SUBTREES > MIN_SUBTREE ? count / SUBTREES : MIN_SUBTREE,
        .max_depth = depth < KDTREE_MAX_DEPTH ? depth : KDTREE_MAX_DEPTH,
    };
    bool done = count <= INT_MAX / KDTREE_MAX_COPIES && build_all(&builder, tree, scene, threads);
    for (int i = 0; i < builder.job_count; i++) {
        voxel_free(&builder.jobs[i].voxel);
        free(builder.jobs[i].part.nodes);
        free(builder.jobs[i].part.order);
    }
    free(builder.jobs);
    if (done)
        return true;
    kdtree_free(tree);
    return error_memory(error, "the k-d tree");
}

void kdtree_free(KdTree *tree)
{
    free(tree->nodes);
    free(tree->order);
    *tree = (KdTree){.node_count = 0};
}

/* Which faces a beam meets on its way. A face is left out only for reasons of its own; a box of a tree is left out only
 * where each face inside it would be: so the answer does not depend on the tree. */
#include "trace/beam_query.h"

/* --- One face --- */

/* Is the face on that side of the plane, some of it off the plane? */
static bool is_on_side(const Face *face, const Face *of, const Plane *plane, int side)
{
    bool off = false;
    for (int k = 0; k < face->vertex_count; k++) {
        Vec3 x = vec3_sub(face_vertex(face, k), face_vertex(of, 0));
        double height = side * vec3_dot(plane->normal, x), slack = BEAM_SLACK * vec3_magnitudes(x);
        if (height < -slack)
            return false;
        off |= height > slack;
    }
    return off;
}

/* Is the face surely not in the stretch of the query? */
static bool is_elsewhere(const BeamQuery *query, const Face *face, const BeamPlane *seen)
{
    const Scene *scene = query->scene;
    const Beam *beam = &query->beam;
    int from = query->from, to = query->to;
    return (to >= 0 && is_on_side(face, &scene->faces[to], &scene->planes[to], -query->far.side)) ||
           (from >= 0 && is_on_side(face, &scene->faces[from], &scene->planes[from], query->near.side)) ||
           beam_is_farther(beam, &query->far, seen) || (from >= 0 && beam_is_farther(beam, seen, &query->near));
}

/* False: the query is answered. */
static bool query_face(BeamQuery *query, int i)
{
    const Face *face = &query->scene->faces[i];
    const Beam *beam = &query->beam;
    if (i == query->from || i == query->to)
        return true;
    query->face_tests++;
    BeamPlane seen = beam_plane(beam, face, &query->scene->planes[i]);
    int back = query->shadow ? 1 : -1; /* a shadow ray runs the other way, from the point to the light */
    bool invisible = (seen.side == 0 && !beam->mirrored) || (seen.side == back && face->one_sided);
    if (invisible || is_elsewhere(query, face, &seen))
        return true;

    BeamCover cover = beam_cover(beam, face, &seen);
    if (cover == BEAM_CLEAR)
        return true;
    if (query->crossed_by < 0)
        query->crossed_by = i;
    if (query->shadow && cover == BEAM_FILLED && beam_is_farther(beam, &seen, &query->far))
        query->filled_by = i;
    return query->shadow && query->filled_by < 0;
}

/* --- The faces of a tree --- */

/* The lowest value of w.x for the points x of the box, relative to the point o; and the largest |x - o|1. */
static double lowest_in_box(Box box, Vec3 o, Vec3 w, double *magnitude)
{
    const double origin[3] = {o.x, o.y, o.z}, weight[3] = {w.x, w.y, w.z};
    double sum = 0;
    *magnitude = 0;
    for (int axis = 0; axis < 3; axis++) {
        double low = (double)box.low[axis] - origin[axis], high = (double)box.high[axis] - origin[axis];
        sum += weight[axis] > 0 ? weight[axis] * low : weight[axis] * high;
        *magnitude += fmax(fabs(low), fabs(high));
    }
    return sum;
}

static bool box_is_on_side(Box box, const Face *of, const Plane *plane, int side)
{
    double magnitude, height = lowest_in_box(box, face_vertex(of, 0), vec3_scale(side, plane->normal), &magnitude);
    return height > 2 * BEAM_SLACK * magnitude;
}

/* Is the box on the other side of a plane that bounds the stretch? */
static bool box_is_elsewhere(const BeamQuery *query, Box box)
{
    const Scene *scene = query->scene;
    int from = query->from, to = query->to;
    return (to >= 0 && box_is_on_side(box, &scene->faces[to], &scene->planes[to], -query->far.side)) ||
           (from >= 0 && box_is_on_side(box, &scene->faces[from], &scene->planes[from], query->near.side));
}

/* Is the box beyond one side of the beam? */
static bool box_is_beside(BeamQuery *query, Box box)
{
    const Beam *beam = &query->beam;
    query->box_tests++;
    Vec3 uv = vec3_cross(beam->u, beam->v), cv = vec3_cross(beam->v, beam->c), cu = vec3_cross(beam->c, beam->u);
    double sign = vec3_dot(uv, beam->c) < 0 ? -1 : 1;
    const Vec3 beyond[4] = {vec3_sub(cv, uv), vec3_sub(vec3_negate(cv), uv), vec3_sub(cu, uv),
                            vec3_sub(vec3_negate(cu), uv)};
    for (int k = 0; k < 4; k++) {
        double magnitude, height = lowest_in_box(box, beam->apex, vec3_scale(sign, beyond[k]), &magnitude);
        if (height > 4 * BEAM_SLACK * beam->length * beam->width * (beam->size + magnitude))
            return true;
    }
    return false;
}

static bool query_bvh(BeamQuery *query, const Bvh *bvh, int index)
{
    const BvhNode *node = &bvh->nodes[index];
    if (box_is_elsewhere(query, node->box) || box_is_beside(query, node->box))
        return true;
    for (int i = 0; i < node->count; i++)
        if (!query_face(query, bvh->order[node->first + i]))
            return false;
    return node->count > 0 || (query_bvh(query, bvh, index + 1) && query_bvh(query, bvh, node->first));
}

/* A box here may hold but a part of a face, of which another part may be elsewhere: only the sides tell. */
static bool query_kdtree(BeamQuery *query, const KdTree *tree, int index, Box box)
{
    const KdNode *node = &tree->nodes[index];
    if (box_is_beside(query, box))
        return true;
    if (node->axis != KDTREE_LEAF) {
        Box below = box, above = box;
        below.high[node->axis] = above.low[node->axis] = node->split;
        return query_kdtree(query, tree, index + 1, below) && query_kdtree(query, tree, node->first, above);
    }
    for (int i = 0; i < node->count; i++)
        if (!query_face(query, tree->order[node->first + i]))
            return false;
    return true;
}

BeamQuery beam_query(const Scene *scene, const Beam *beam, int from, int to)
{
    BeamQuery query = {.scene = scene, .beam = *beam, .from = from, .to = to, .filled_by = -1, .crossed_by = -1};
    if (from >= 0)
        query.near = beam_plane(beam, &scene->faces[from], &scene->planes[from]);
    if (to >= 0)
        query.far = beam_plane(beam, &scene->faces[to], &scene->planes[to]);
    return query;
}

void beam_query_run(BeamQuery *query, const Accel *accel)
{
    if (accel_has_tree(accel) && accel->kind == ACCEL_BVH)
        query_bvh(query, &accel->bvh, 0);
    else if (accel_has_tree(accel))
        query_kdtree(query, &accel->kdtree, 0, accel->kdtree.box);
    else
        for (int i = 0; i < query->scene->face_count && query_face(query, i); i++)
            continue;
}

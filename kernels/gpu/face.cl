/* A face against a ray, in float: whether the ray passes inside its edges, and where it meets the plane. */
#include "shared/compiler.cl"
#include "shared/layout.h"
#include "shared/precision.cl"
#include "plain/scene.cl"
#include "gpu/ray.cl"

/* An answer that float gives. */
typedef enum Answer { NO, YES, UNSURE } Answer;

/* Where a ray meets a face. */
typedef struct Meeting {
    Answer inside;    /* its edges */
    float t, error;
    float low, high; /* what decides which face is nearest is between these */
    bool from_behind; /* N.R > 0 */
} Meeting;

typedef global const float4 *FaceRow; /* the x of the four vertices, the y, the z; the normal and FACE_BITS */

static FaceRow float_row(const Scene *scene, int face)
{
    return (FaceRow)(scene->face_rows + (size_t)face * FACE_REALS);
}

/* No edge is longer, in the sum of its components' magnitudes. */
static float longest_edge(uint bits) { return as_float(bits & 0x7fff0000u); }

/* No vertex is farther from the plane. */
static float warp(uint bits) { return as_float((bits & 0x7fffu) << 16); }

/* The same, where each area has a bound of its own. */
static Answer judge_edges(float4 area, float4 doubts)
{
    bool any_left = any(area > doubts), any_right = any(area < -doubts);
    if (any_left && any_right)
        return NO;
    return all(area > doubts) || all(area < -doubts) ? YES : UNSURE;
}

/* Step 4. Sheared along the ray, the ray is the point (0, 0), and an edge from a to b has it on its left where
 * a.x b.y - a.y b.x > 0. *left: of all edges. */
INLINE Answer inside_edges_of(const RaySetup *s, FaceRow row, uint bits, bool *left)
{
    float4 z = row[s->z] - s->origin_z;
    float4 off_x = row[s->x] - s->origin_x, off_y = row[s->y] - s->origin_y;
    float4 x = fma(-s->shear_x, z, off_x), y = fma(-s->shear_y, z, off_y);
    float4 area = fma(x, y.yzwx, -(y * x.yzwx));
    if (bits & FACE_TRIANGLE)
        area.w = area.x; /* its last edge has no length */
    float lowest = min(min(area.x, area.y), min(area.z, area.w));
    float highest = max(max(area.x, area.y), max(area.z, area.w));
    float edge = longest_edge(bits);
    float away = fabs(off_x.x) + fabs(off_y.x) + fabs(z.x) + 2 * edge;
    float error = fma(s->slope, away, s->error);
    float doubt = fma(2 * error, fabs(x.x) + fabs(y.x) + 3 * edge + error, REAL_FLOOR);
    *left = lowest > 0;
    if (lowest < -doubt && highest > doubt)
        return NO;
    if (lowest > doubt || highest < -doubt)
        return YES;
    float4 errors = fma(s->slope, fabs(off_x) + fabs(off_y) + fabs(z), s->error), sizes = fabs(x) + fabs(y) + errors;
    float4 doubts = 1.0625f * fma(errors, sizes.yzwx, errors.yzwx * sizes) + REAL_FLOOR;
    bool is_triangle = bits & FACE_TRIANGLE;
    return judge_edges(area, is_triangle ? doubts.xyzx : doubts);
}

/* Steps 3 and 4. */
INLINE Meeting meet_face(const Scene *scene, const RaySetup *s, int face)
{
    Meeting m;
    FaceRow row = float_row(scene, face);
    float4 last = row[3];
    uint bits = as_uint(last.w);
    bool left;
    m.inside = inside_edges_of(s, row, bits, &left);
    if (m.inside == NO)
        return m;
    float3 n = turned(last.xyz, s->z), vertex = (float3)(row[s->x].x, row[s->y].x, row[s->z].x);
    float3 heights = n * (vertex - (float3)(s->origin_x, s->origin_y, s->origin_z));
    float height = heights.x + heights.y + heights.z;
    float approach = s->along * fma(s->shear_x, n.x, fma(s->shear_y, n.y, n.z));
    float height_error = 5 * REAL_ROUNDING * sum_of_magnitudes(heights) + s->origin_error;
    float approach_error = s->approach_error;
    float per_approach = 1 / approach;
    m.t = height * per_approach;
    float steepness = 1 / (fabs(approach) - approach_error);
    m.error = (height_error + fabs(m.t) * approach_error) * steepness + 3 * REAL_ROUNDING * fabs(m.t);
    float margin = m.error + warp(bits) * steepness;
    if (!(fabs(approach) > 2 * approach_error) || !(margin < INFINITY)) {
        m.inside = UNSURE; /* it grazes the plane: the face is somewhere */
        m.low = -INFINITY;
        m.high = INFINITY;
        m.from_behind = false;
        return m;
    }
    m.low = m.t - margin;
    m.high = m.t + margin;
    m.from_behind = m.inside == YES ? left == (s->along > 0) : approach > 0;
    if (m.from_behind && (bits & FACE_ONE_SIDED))
        m.inside = NO;
    return m;
}

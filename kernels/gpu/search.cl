/* What a ray meets: steps 3 to 6 in float. Rays of the path and shadow rays are searched by the same code: a second
 * copy of it would take a quarter of the registers that a work-item may have. */
#include "shared/compiler.cl"
#include "shared/layout.h"
#include "shared/precision.cl"
#include "plain/scene.cl"
#include "gpu/ray.cl"
#include "gpu/face.cl"
#include GPU_TREE

/* What a search finds: of a ray of the path the nearest face, of a shadow ray any face that blocks it. */
typedef struct Found {
    Answer answer; /* UNSURE: the next two say nothing */
    int face;      /* -1: none */
    Meeting at;
} Found;

/* Searches the ray up to t = end, where a shadow ray ends; INFINITY: it is a ray of the path. */
static Found search(Scene *scene, const FloatRay *ray, float end, float end_error)
{
    bool is_shadow = end < INFINITY;
    float rival = INFINITY; /* the smallest t at which another face might be met */
    Found found = {YES, -1};
    RaySetup setup = set_up(scene, ray);
    uint stack[STACK_WORDS];
    Traversal way;
    int first, count;
    found.at.low = found.at.t = found.at.high = end + end_error;
    begin_traversal(&way, stack);
    while (next_leaf(scene, &setup, found.at.high, &way, &first, &count)) {
        scene->counts[COUNT_FACE_TESTS] += count;
        for (int i = first; i < first + count; i++) {
            int face = face_in_leaf(scene, i);
            if (face == ray->from || face == found.face)
                continue;
            Meeting at = meet_face(scene, &setup, face);
            if (at.inside == NO || at.high <= 0 || at.low > found.at.high)
                continue;
            bool is_sure = at.inside == YES && at.low > 0 && (!is_shadow || at.high < end - end_error);
            if (is_sure && at.t < found.at.t) {
                rival = is_shadow ? rival : min(rival, found.at.low);
                found.at = at;
                found.face = face;
                if (is_shadow)
                    return found;
            } else {
                rival = min(rival, at.low);
            }
        }
    }
    if (rival < INFINITY && rival <= found.at.high)
        found.answer = UNSURE;
    return found;
}

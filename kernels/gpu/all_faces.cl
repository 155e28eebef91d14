/* No tree: every face is tested. */
#include "shared/precision.cl"
#include "plain/scene.cl"
#include "gpu/ray.cl"

enum { STACK_WORDS = 1 };

typedef struct Traversal {
    bool done;
} Traversal;

static void begin_traversal(Traversal *way, uint *stack) { way->done = false; }

static bool next_leaf(Scene *scene, const RaySetup *s, float limit, Traversal *way, int *first,
                      int *count)
{
    bool more = !way->done;
    way->done = true;
    *first = 0;
    *count = scene->parameters->face_count;
    return more;
}

static int face_in_leaf(const Scene *scene, int i) { return i; }

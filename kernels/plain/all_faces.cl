/* No tree: every face is tested, in the order of the file. */
#include "shared/precision.cl"
#include "plain/scene.cl"

typedef struct Traversal {
    bool done;
} Traversal;

static void begin_traversal(Scene *scene, Ray ray, Traversal *way) { way->done = false; }

/* The next faces to test are first .. first + count - 1. False: there are none. */
static bool next_leaf(Scene *scene, Ray ray, wide limit, Traversal *way, int *first, int *count)
{
    bool more = !way->done;
    way->done = true;
    *first = 0;
    *count = scene->parameters->face_count;
    return more;
}

static int face_in_leaf(const Scene *scene, int i) { return i; }

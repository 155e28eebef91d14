/* Boxes: no ray escapes a closed one, and of nested ones the nearest is seen. Tests 4 and 5. */
#include "scenes.h"
#include "tests.h"

typedef struct Box3 {
    Vec3 corner, edges[3];
} Box3;

static Box3 random_box(Random *random, Vec3 centre, double size)
{
    Rotation rotation = random_rotation(random);
    Box3 box;
    box.edges[0] = vec3_scale(size * random_in(random, 0.5, 1.5), rotation.x);
    box.edges[1] = vec3_scale(size * random_in(random, 0.5, 1.5), rotation.y);
    box.edges[2] = vec3_scale(size * random_in(random, 0.5, 1.5), rotation.z);
    Vec3 half = vec3_scale(0.5, vec3_add(vec3_add(box.edges[0], box.edges[1]), box.edges[2]));
    box.corner = vec3_sub(centre, half);
    return box;
}

/* A point of the box: each coordinate along its edges from 0 to 1. The ends are rounded like the box's corners. */
static Vec3 box_point(const Box3 *box, const double *along)
{
    Vec3 p = box->corner;
    for (int i = 0; i < 3; i++)
        if (along[i] != 0)
            p = vec3_add(p, vec3_scale(along[i], box->edges[i]));
    return p;
}

/* Corners, edges and faces in turn. */
static Vec3 seam_point(const Box3 *box, Random *random)
{
    double along[3];
    int free = random_below(random, 3), fixed = 0;
    for (int i = 0; i < 3; i++)
        along[i] = random_below(random, 2);
    for (; fixed < free; fixed++)
        along[(random_below(random, 3) + fixed) % 3] = random_in(random, 0, 1);
    return vec3_rounded(box_point(box, along));
}

static void aim_from_inside(void *user, Random *random, double ray[6])
{
    const Box3 *box = user;
    const double along[3] = {random_in(random, 0.1, 0.9), random_in(random, 0.1, 0.9), random_in(random, 0.1, 0.9)};
    Vec3 origin = vec3_rounded(box_point(box, along));
    vec3_put(ray, origin);
    vec3_put(ray + 3, vec3_sub(seam_point(box, random), origin));
}

static const char *check_no_escape(void *user, const Scene *scene, Method method, const double ray[6], int truth,
                                   CastHit hit)
{
    (void)user, (void)scene, (void)method, (void)ray, (void)truth;
    return hit.face < 0 ? "an escape" : NULL;
}

void test_boxes(Suite *suite)
{
    suite_row(suite, "1000 boxes, sizes 1e-3 to 1e6, at corners, edges, faces");
    long boxes = suite_count(suite, 1000);
    for (long i = 0; i < boxes; i++) {
        double size = pow(10, random_in(&suite->random, -3, 6));
        Vec3 centre = vec3_scale(size * random_in(&suite->random, 0, 10), random_unit(&suite->random));
        Box3 box = random_box(&suite->random, centre, size);
        Scene scene = scene_empty();
        scene_add_box(&scene, box.corner, box.edges[0], box.edges[1], box.edges[2]);
        suite_load(suite, &scene);
        suite_cast(
            suite,
            &(Cast){.count = 10000 / suite->scale, .user = &box, .aim = aim_from_inside, .check = check_no_escape});
        scene_free(&scene);
    }
}

/* From outside at any seam of any of ten boxes, one within another. */
static void aim_at_nested(void *user, Random *random, double ray[6])
{
    const Box3 *boxes = user;
    Vec3 target = seam_point(&boxes[random_below(random, 10)], random);
    Vec3 origin = vec3_rounded(vec3_scale(random_in(random, 0.1, 30), random_unit(random)));
    vec3_put(ray, origin);
    vec3_put(ray + 3, vec3_sub(target, origin));
}

void test_nested(Suite *suite)
{
    suite_row(suite, "ten nested boxes, at corners, edges, faces");
    for (int round = 0; round < 10; round++) {
        Box3 boxes[10];
        Scene scene = scene_empty();
        for (int i = 0; i < 10; i++) {
            /* Every box but the first is the one outside it, shrunk towards its middle. */
            boxes[i] = i == 0 ? random_box(&suite->random, vec3(0, 0, 0), 10) : boxes[i - 1];
            for (int k = 0; i > 0 && k < 3; k++)
                boxes[i].edges[k] = vec3_scale(0.8, boxes[i].edges[k]);
            boxes[i].corner =
                vec3_scale(-0.5, vec3_add(vec3_add(boxes[i].edges[0], boxes[i].edges[1]), boxes[i].edges[2]));
            scene_add_box(&scene, boxes[i].corner, boxes[i].edges[0], boxes[i].edges[1], boxes[i].edges[2]);
        }
        suite_load(suite, &scene);
        suite_cast(
            suite,
            &(Cast){.count = 1e5, .user = boxes, .aim = aim_at_nested, .truth = true_nearest, .check = check_nearest});
        scene_free(&scene);
    }
}

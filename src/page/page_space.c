/* What the page draws in space, as lists of numbers. Without memory a list ends early: a drawing that lacks a line is
 * better than none. */
#include "page/page.h"

#include "scene/geometry.h"
#include "trace/reference.h"
#include "walkthrough/walkthrough_boxes.h"
#include "walkthrough/walkthrough_lines.h"
#include "walkthrough/walkthrough_text_node.h"

#include <stdlib.h>

void page_add_number(PageNumbers *numbers, double value)
{
    if (numbers->count == numbers->capacity) {
        int capacity = numbers->capacity ? 2 * numbers->capacity : 1024;
        float *values = realloc(numbers->values, (size_t)capacity * sizeof *values);
        if (!values)
            return;
        numbers->values = values;
        numbers->capacity = capacity;
    }
    numbers->values[numbers->count++] = (float)value;
}

void page_add_vector(PageNumbers *numbers, Vec3 v)
{
    page_add_number(numbers, v.x);
    page_add_number(numbers, v.y);
    page_add_number(numbers, v.z);
}

static void add_place(Page *page, Vec3 position)
{
    page_add_vector(&page->numbers, walkthrough_world(&page->scene, position));
}

void page_list_faces(Page *page)
{
    PageNumbers *numbers = &page->numbers;
    numbers->count = 0;
    for (int f = 0; f < page->scene.face_count; f++) {
        const Face *face = &page->scene.faces[f];
        const Material *material = &page->scene.materials[face->material];
        Vec3 colour = vec3_add(material->ambient, material->diffuse);
        page_add_number(numbers, face->vertex_count);
        page_add_number(numbers, face->object);
        page_add_number(numbers, face->one_sided);
        for (int k = 0; k < 4; k++)
            add_place(page, face_vertex(face, k));
        page_add_vector(numbers, vec3_scale(1 / fmax(vec3_largest(colour), 1), colour));
        page_add_vector(numbers, page->scene.planes[f].normal);
    }
}

void page_list_places(Page *page)
{
    const Scene *scene = &page->scene;
    View view = view_of(scene);
    page->numbers.count = 0;
    add_place(page, scene->camera.position);
    add_place(page, scene->camera.look_at);
    page_add_vector(&page->numbers, scene->camera.up);
    for (int k = 0; k < 4; k++) {
        double x = k == 0 || k == 3 ? -0.5 : 0.5, y = k < 2 ? 0.5 : -0.5;
        Vec3 in_plane = vec3_add(vec3_scale(x * view.width, view.right), vec3_scale(y * view.height, view.up));
        add_place(page, vec3_add(view.eye, vec3_add(view.forward, in_plane)));
    }
    for (int k = 0; k < scene->light_count; k++)
        add_place(page, scene->lights[k].position);
}

void page_list_seen(Page *page)
{
    enum { SIDE = 9 };
    RenderReport report = {0};
    Tracer tracer = {.scene = &page->scene, .accel = &page->accel, .report = &report};
    View view = view_of(&page->scene);
    view.columns = view.rows = SIDE;
    view.grid = 1;
    page->numbers.count = 0;
    for (int k = 0; k < SIDE * SIDE; k++) {
        Ray ray = {view.eye, view_direction(&view, k % SIDE, k / SIDE, 0, 0)};
        CastHit hit = reference_nearest(&tracer, ray, -1);
        if (hit.face >= 0)
            add_place(page, vec3_add(ray.origin, vec3_scale(hit.t, ray.direction)));
    }
}

/* --- One pixel --- */

static void add_line(void *user, const WalkthroughLine *line)
{
    PageNumbers *numbers = user;
    page_add_number(numbers, line->kind);
    page_add_vector(numbers, line->from);
    page_add_vector(numbers, line->to);
    page_add_vector(numbers, line->stop);
    page_add_number(numbers, line->hit);
    page_add_number(numbers, line->light);
    page_add_number(numbers, line->face);
    page_add_number(numbers, line->leaves);
}

static bool record(Page *page, Walkthrough *walk, const Accel *tree, WalkthroughRequest request)
{
    page->numbers.count = 0;
    return walkthrough_record(walk, &page->scene, tree, page->path, request, &page->error);
}

bool page_list_lines(Page *page, WalkthroughRequest request)
{
    Walkthrough walk = {0};
    bool done = record(page, &walk, NULL, request);
    if (done)
        walkthrough_lines(&walk, add_line, &page->numbers);
    walkthrough_free(&walk);
    return done;
}

/* Whether the place is in the search for hit `hit`, or with light >= 0 in that from there to the light. */
static bool is_in_search(const WalkthroughPlace *place, bool shadow, int hit, int light)
{
    int number = walkthrough_hit_number(place);
    if (!place->told)
        return false;
    return shadow ? light >= 0 && place->light->as.light.light == light && number == hit
                  : light < 0 && number + 1 == hit;
}

bool page_list_tested(Page *page, WalkthroughRequest request, int hit, int light)
{
    Walkthrough walk = {0};
    WalkthroughPlace place = {0};
    request.verbose = true;
    bool done = record(page, &walk, page->tree.kind == ACCEL_NONE ? NULL : &page->tree, request);
    for (long i = 0; done && i < walk.count; i++) {
        const Event *event = &walk.events[i];
        walkthrough_follow(&place, &walk, event);
        bool shadow = event->kind == EVENT_OCCLUDER;
        if ((!shadow && event->kind != EVENT_FACE) || !is_in_search(&place, shadow, hit, light))
            continue;
        page_add_number(&page->numbers, shadow ? event->as.occluder.face : event->as.face.face);
        page_add_number(&page->numbers, (shadow ? &event->as.occluder.test : &event->as.face.test)->verdict);
    }
    walkthrough_free(&walk);
    return done;
}

static void add_node(Page *page, const Event *event)
{
    PageNumbers *numbers = &page->numbers;
    WalkthroughBox box = walkthrough_box(&page->scene, &event->as.node.shape.box);
    page_add_number(numbers, event->as.node.visit.verdict);
    page_add_number(numbers, event->as.node.shape.leaf);
    page_add_number(numbers, event->as.node.visit.level);
    page_add_vector(numbers, box.corners[0]);
    page_add_vector(numbers, box.corners[7]);
}

static void list_nodes(Page *page, WalkthroughText *text, int hit, int light)
{
    const Walkthrough *walk = text->walk;
    for (long i = 0; i < walk->count; i++) {
        walkthrough_follow(&text->place, walk, &walk->events[i]);
        if (walk->events[i].kind != EVENT_NODE || !is_in_search(&text->place, text->place.shadow, hit, light))
            continue;
        add_node(page, &walk->events[i]);
        walkthrough_text_node(text, &walk->events[i]);
    }
}

bool page_list_nodes(Page *page, WalkthroughRequest request, int hit, int light)
{
    enum { ONE_LINE = 1000 };
    Walkthrough walk = {0};
    request.verbose = true;
    free(page->text);
    page->text = NULL;
    FILE *out = open_memstream(&page->text, &page->text_length);
    bool done = out && record(page, &walk, &page->tree, request);
    if (done) {
        WalkthroughText text = walkthrough_text_begin(out, &walk, (WalkthroughStyle){.columns = ONE_LINE}, INK_DIGITS);
        list_nodes(page, &text, hit, light);
    }
    walkthrough_free(&walk);
    return out && fclose(out) == 0 && done;
}

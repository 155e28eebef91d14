/* The walkthrough as lines in space. */
#include "walkthrough/walkthrough_lines.h"

#define NORMAL_LENGTH 0.15 /* of the ray that arrives */

typedef struct Drawing {
    const Walkthrough *walk;
    WalkthroughPlace place;
    double reach;   /* how far a ray that hits nothing is drawn: as far as the longest before, or the scene's size */
    double blocker; /* t of the face that the latest shadow ray met */
    void (*draw)(void *user, const WalkthroughLine *line);
    void *user;
} Drawing;

static void draw(const Drawing *drawing, WalkthroughLine line)
{
    const Scene *scene = drawing->walk->scene;
    line.from = walkthrough_world(scene, line.from);
    line.to = walkthrough_world(scene, line.to);
    line.stop = walkthrough_world(scene, line.stop);
    drawing->draw(drawing->user, &line);
}

/* Before the ray's own hit is taken into account. */
static WalkthroughLineKind ray_kind(const Drawing *drawing)
{
    return drawing->place.hit ? LINE_REFLECTED : LINE_PRIMARY;
}

static void draw_hit(Drawing *drawing, WalkthroughLineKind kind, const Event *event)
{
    const WalkthroughPlace *place = &drawing->place;
    Vec3 point = event->as.hit.point;
    double length = vec3_length(vec3_sub(point, place->ray.origin));
    int hit = event->as.hit.step + 1, face = event->as.hit.face;
    if (length > drawing->reach || hit == 1)
        drawing->reach = length;
    Vec3 tip = vec3_add(point, vec3_scale(NORMAL_LENGTH * length, event->as.hit.normal));
    draw(drawing, (WalkthroughLine){.kind = kind, .from = place->ray.origin, .to = point, .hit = hit, .face = face});
    draw(drawing, (WalkthroughLine){.kind = LINE_NORMAL, .from = point, .to = tip, .hit = hit, .face = face});
    draw(drawing,
         (WalkthroughLine){.kind = LINE_SHIFT, .from = point, .to = event->as.hit.shifted, .hit = hit, .face = face});
}

static void draw_miss(const Drawing *drawing, WalkthroughLineKind kind)
{
    Ray ray = drawing->place.ray;
    double reach = drawing->reach > 0 ? drawing->reach : 1;
    Vec3 to = vec3_add(ray.origin, vec3_scale(reach, vec3_unit(ray.direction)));
    draw(drawing, (WalkthroughLine){.kind = kind, .from = ray.origin, .to = to, .face = -1, .leaves = true});
}

static void draw_shadow(const Drawing *drawing, const Event *event)
{
    const Event *light = drawing->place.light;
    if (event->as.light_end.verdict == LIGHT_BEHIND_FACE)
        return; /* no ray */
    bool blocked = event->as.light_end.verdict == LIGHT_BLOCKED;
    Vec3 from = light->as.light.shadow_origin, to = light->as.light.position;
    draw(drawing, (WalkthroughLine){
                      .kind = blocked ? LINE_BLOCKED : LINE_SHADOW,
                      .from = from,
                      .to = to,
                      .stop = vec3_add(from, vec3_scale(drawing->blocker, vec3_sub(to, from))),
                      .hit = walkthrough_hit_number(&drawing->place),
                      .light = light->as.light.light,
                      .face = event->as.light_end.blocker,
                  });
}

void walkthrough_lines(const Walkthrough *walk, void (*draw_line)(void *user, const WalkthroughLine *line), void *user)
{
    Drawing drawing = {.walk = walk, .reach = walkthrough_scene_size(walk->scene), .draw = draw_line, .user = user};
    for (long i = 0; i < walk->count; i++) {
        const Event *event = &walk->events[i];
        WalkthroughLineKind kind = ray_kind(&drawing);
        walkthrough_follow(&drawing.place, walk, event);
        if (!drawing.place.told)
            continue;
        if (event->kind == EVENT_HIT)
            draw_hit(&drawing, kind, event);
        else if (event->kind == EVENT_MISS)
            draw_miss(&drawing, kind);
        else if (event->kind == EVENT_OCCLUDER && event->as.occluder.test.verdict == FACE_INSIDE)
            drawing.blocker = event->as.occluder.test.t;
        else if (event->kind == EVENT_LIGHT_END)
            draw_shadow(&drawing, event);
    }
}

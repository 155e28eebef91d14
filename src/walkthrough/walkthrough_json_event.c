/* The walkthrough as JSON: one object for each event, with every number that the text shows. A new member goes into
 * docs/walkthrough.schema.json, too. */
#include "walkthrough/walkthrough_json_event.h"

#include "walkthrough/walkthrough_json_light.h"
#include "walkthrough/walkthrough_json_node.h"

#include <math.h>

/* --- Faces --- */

static void put_face(JsonNode node, const Scene *scene, int face)
{
    json_node_number(node, "face", scene->faces[face].number);
    json_node_text(node, "object", scene->objects[scene->faces[face].object].name);
    if (scene_part_of(scene, face))
        json_node_text(node, "part", scene_part_of(scene, face));
    json_node_number(node, "face_in_object", walkthrough_face_in_object(scene, face));
    WalkthroughPiece piece = walkthrough_piece(scene, face);
    if (piece.count > 1) {
        json_node_number(node, "piece", piece.number);
        json_node_number(node, "pieces", piece.count);
    }
}

static void put_test(JsonNode node, const FaceTest *test)
{
    json_node_text(node, "verdict", walkthrough_face_verdicts[test->verdict]);
    if (test->verdict == FACE_LEFT)
        return;
    json_node_number(node, "n_dot_r", test->n_dot_r);
    json_node_number(node, "n_dot_o_plus_d", test->n_dot_o_plus_d);
    if (test->verdict == FACE_PARALLEL)
        return;
    json_node_number(node, "t", test->t);
    JsonNode values = json_node_array(node, "edge_values"), signs = json_node_array(node, "edge_signs");
    for (int k = 0; k < test->edges; k++) {
        json_node_append_number(values, test->edge_value[k]);
        json_node_append_number(signs, test->edge_sign[k]);
    }
    if (test->outside_edge >= 0)
        json_node_number(node, "outside_edge", test->outside_edge);
}

static void put_adaptive(JsonNode node, const Scene *scene, const AdaptiveVerdict *verdict)
{
    AdaptiveReason reason = verdict->reason;
    json_node_bool(node, "refined", reason != ADAPTIVE_SAME);
    json_node_text(node, "reason", walkthrough_adaptive_reasons[reason]);
    if (reason == ADAPTIVE_SAME)
        return;
    json_node_number(node, "step", verdict->hit + 1);
    if (reason == ADAPTIVE_SHADOW || reason == ADAPTIVE_HIGHLIGHT)
        json_node_number(node, "light", verdict->light);
    if (reason != ADAPTIVE_HIGHLIGHT)
        put_face(node, scene, verdict->face);
}

static void put_hit(JsonNode node, const Scene *scene, const WalkthroughPlace *place, const Event *event)
{
    int index = event->as.hit.face;
    const Face *face = &scene->faces[index];
    const Plane *plane = &scene->planes[index];
    json_node_number(node, "step", event->as.hit.step + 1);
    put_face(node, scene, index);
    json_node_text(node, "material", scene->materials[face->material].name);
    put_test(node, &event->as.hit.test);
    WalkthroughSides sides = walkthrough_sides(face);
    Vec3 product = vec3_cross(sides.a, sides.b);
    json_node_vector(node, "a", sides.a);
    json_node_vector(node, "b", sides.b);
    json_node_vector(node, "a_x_b", product);
    json_node_number(node, "a_x_b_length", vec3_length(product));
    json_node_vector(node, "plane_normal", plane->normal);
    json_node_vector(node, "o_minus_v0", vec3_sub(place->ray.origin, face_vertex(face, 0)));
    json_node_vector(node, "t_r", vec3_scale(event->as.hit.test.t, place->ray.direction));
    json_node_vector(node, "point", walkthrough_world(scene, event->as.hit.point));
    json_node_vector(node, "normal", event->as.hit.normal);
    json_node_vector(node, "shifted", walkthrough_world(scene, event->as.hit.shifted));
    json_node_number(node, "shift",
                     vec3_dot(event->as.hit.normal, vec3_sub(event->as.hit.shifted, event->as.hit.point)));
    JsonNode vertices = json_node_array(node, "vertices"), edges = json_node_array(node, "edges");
    for (int k = 0; k < face->vertex_count; k++) {
        WalkthroughEdge edge = walkthrough_edge(face, k, event->as.hit.point);
        json_node_append_vector(vertices, walkthrough_world(scene, face_vertex(face, k)));
        JsonNode at = json_node_append_object(edges);
        json_node_vector(at, "e", edge.e);
        json_node_vector(at, "c", edge.c);
        json_node_vector(at, "e_x_c", vec3_cross(edge.e, edge.c));
    }
}

/* --- The path --- */

static void put_sample(JsonNode node, const Scene *scene, const WalkthroughPlace *place, const Event *event)
{
    View view = view_of(scene);
    ScreenPoint at = event->as.sample.at;
    json_node_number(node, "i", event->as.sample.i);
    json_node_number(node, "j", event->as.sample.j);
    json_node_bool(node, "told", place->told);
    json_node_number(node, "x", at.x);
    json_node_number(node, "y", at.y);
    json_node_vector(node, "c", walkthrough_world(scene, event->as.sample.c));
    json_node_vector(node, "distance_f", view.forward);
    json_node_vector(node, "x_r", vec3_scale(at.x, view.right));
    json_node_vector(node, "y_u", vec3_scale(at.y, view.up));
    json_node_vector(node, "q", walkthrough_world(scene, event->as.sample.q));
    json_node_vector(node, "r", event->as.sample.r);
    json_node_number(node, "r_length", vec3_length(event->as.sample.r));
}

static void put_reflected(JsonNode node, const Scene *scene, const WalkthroughPlace *place, const Event *event)
{
    Vec3 r = event->as.reflected.r_unit, n = place->hit->as.hit.normal;
    double r_dot_n = vec3_dot(r, n);
    json_node_number(node, "bounce", event->as.reflected.bounce);
    json_node_number(node, "r_length", place->length);
    json_node_vector(node, "r_unit", r);
    json_node_number(node, "r_dot_n", r_dot_n);
    json_node_vector(node, "minus_2_r_dot_n_n", vec3_scale(-2 * r_dot_n, n));
    json_node_vector(node, "direction", event->as.reflected.direction);
    json_node_vector(node, "origin", walkthrough_world(scene, event->as.reflected.origin));
    json_node_number(node, "reflection", event->as.reflected.reflection);
    json_node_number(node, "weight", event->as.reflected.weight);
}

static void put_pixel(JsonNode node, const Event *event)
{
    Vec3 c = event->as.pixel.clamped;
    const unsigned char *rgb = event->as.pixel.rgb;
    json_node_number(node, "samples", event->as.pixel.samples);
    json_node_vector(node, "sum", event->as.pixel.sum);
    json_node_vector(node, "average", event->as.pixel.average);
    json_node_vector(node, "clamped", c);
    json_node_vector(node, "scaled", vec3(255 * c.x + 0.5, 255 * c.y + 0.5, 255 * c.z + 0.5));
    json_node_vector(node, "rgb", vec3(rgb[0], rgb[1], rgb[2]));
}

/* --- All of them --- */

static const char *const kinds[EVENT_KIND_COUNT] = {
    [EVENT_ADAPTIVE] = "adaptive", [EVENT_SAMPLE] = "sample",     [EVENT_FACE] = "face",
    [EVENT_NODE] = "node",         [EVENT_HIT] = "hit",           [EVENT_MISS] = "miss",
    [EVENT_LIGHT] = "light",       [EVENT_OCCLUDER] = "occluder", [EVENT_LIGHT_END] = "light end",
    [EVENT_TERMS] = "terms",       [EVENT_SHADED] = "shaded",     [EVENT_REFLECTED] = "reflected",
    [EVENT_PATH_END] = "path end", [EVENT_PIXEL] = "pixel",       [EVENT_TALLY] = "tally",
};

const char *walkthrough_event_name(EventKind kind)
{
    return kinds[kind];
}

cJSON *walkthrough_event_json(const Walkthrough *walk, const WalkthroughPlace *place, const Event *event, bool *failed)
{
    const Scene *scene = walk->scene;
    JsonNode node = json_node_new(failed);
    json_node_text(node, "event", kinds[event->kind]);
    switch (event->kind) {
    case EVENT_ADAPTIVE:
        put_adaptive(node, scene, &event->as.adaptive);
        break;
    case EVENT_SAMPLE:
        put_sample(node, scene, place, event);
        break;
    case EVENT_FACE:
        put_face(node, scene, event->as.face.face);
        put_test(node, &event->as.face.test);
        json_node_number(node, "nearest_t", event->as.face.nearest_t);
        break;
    case EVENT_OCCLUDER:
        put_face(node, scene, event->as.occluder.face);
        put_test(node, &event->as.occluder.test);
        break;
    case EVENT_TALLY:
        walkthrough_json_tally(node, event);
        break;
    case EVENT_HIT:
        put_hit(node, scene, place, event);
        break;
    case EVENT_MISS:
        json_node_number(node, "weight", event->as.miss.weight);
        json_node_vector(node, "background", event->as.miss.background);
        json_node_vector(node, "contribution", event->as.miss.weight_times_background);
        break;
    case EVENT_LIGHT:
        walkthrough_json_light(node, scene, place, event);
        break;
    case EVENT_LIGHT_END:
        json_node_number(node, "light", event->as.light_end.light);
        json_node_text(node, "verdict", walkthrough_light_verdicts[event->as.light_end.verdict]);
        if (event->as.light_end.blocker >= 0)
            put_face(node, scene, event->as.light_end.blocker);
        break;
    case EVENT_TERMS:
        walkthrough_json_terms(node, scene, place, event);
        break;
    case EVENT_SHADED:
        json_node_number(node, "lights_reaching", event->as.shaded.lights_reaching);
        json_node_number(node, "weight", event->as.shaded.weight);
        json_node_vector(node, "illumination", event->as.shaded.illumination);
        json_node_vector(node, "contribution", event->as.shaded.contribution);
        json_node_vector(node, "total", event->as.shaded.total);
        break;
    case EVENT_REFLECTED:
        put_reflected(node, scene, place, event);
        break;
    case EVENT_PATH_END:
        json_node_text(node, "reason", walkthrough_path_ends[event->as.path_end.reason]);
        json_node_number(node, "bounces", event->as.path_end.bounces);
        json_node_vector(node, "colour", event->as.path_end.colour);
        break;
    case EVENT_PIXEL:
        put_pixel(node, event);
        break;
    case EVENT_NODE:
        walkthrough_json_node(node, scene, place, event);
        break;
    case EVENT_KIND_COUNT:
        break;
    }
    return node.object;
}

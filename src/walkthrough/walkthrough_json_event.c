/* The walkthrough as JSON: one object for each event, with every number that the text shows. A new member goes into
 * docs/walkthrough.schema.json, too. */
#include "walkthrough/walkthrough_json.h"

#include <math.h>

/* --- Faces --- */

static void put_face(Node node, const Scene *scene, int face)
{
    node_number(node, "face", scene->faces[face].number);
    node_text(node, "object", scene->objects[scene->faces[face].object].name);
    node_number(node, "face_in_object", walk_face_in_object(scene, face));
}

static void put_test(Node node, const FaceTest *test)
{
    node_text(node, "verdict", walk_face_verdicts[test->verdict]);
    if (test->verdict == FACE_LEFT)
        return;
    node_number(node, "n_dot_r", test->n_dot_r);
    node_number(node, "n_dot_o_plus_d", test->n_dot_o_plus_d);
    if (test->verdict == FACE_PARALLEL)
        return;
    node_number(node, "t", test->t);
    Node values = node_array(node, "edge_values"), signs = node_array(node, "edge_signs");
    for (int k = 0; k < test->edges; k++) {
        node_append_number(values, test->edge_value[k]);
        node_append_number(signs, test->edge_sign[k]);
    }
    if (test->outside_edge >= 0)
        node_number(node, "outside_edge", test->outside_edge);
}

static void put_adaptive(Node node, const Scene *scene, const AdaptiveVerdict *verdict)
{
    AdaptiveReason reason = verdict->reason;
    node_bool(node, "refined", reason != ADAPTIVE_SAME);
    node_text(node, "reason", walk_adaptive_reasons[reason]);
    if (reason == ADAPTIVE_SAME)
        return;
    node_number(node, "step", verdict->hit + 1);
    if (reason == ADAPTIVE_SHADOW || reason == ADAPTIVE_HIGHLIGHT)
        node_number(node, "light", verdict->light);
    if (reason != ADAPTIVE_HIGHLIGHT)
        put_face(node, scene, verdict->face);
}

static void put_tally(Node node, const Event *event)
{
    node_text(node, "ray", event->as.tally.shadow ? "shadow" : "path");
    node_number(node, "tested", event->as.tally.tested);
    Node verdicts = node_object(node, "verdicts");
    for (int k = 0; k < FACE_VERDICT_COUNT; k++)
        node_number(verdicts, walk_face_verdicts[k], event->as.tally.verdicts[k]);
    if (event->as.tally.nodes_met == 0)
        return;
    Node nodes = node_object(node, "nodes");
    node_number(nodes, "met", event->as.tally.nodes_met);
    node_number(nodes, "entered", event->as.tally.nodes_entered);
    node_number(nodes, "leaves", event->as.tally.leaves);
}

static void put_hit(Node node, const Scene *scene, const WalkPlace *place, const Event *event)
{
    int index = event->as.hit.face;
    const Face *face = &scene->faces[index];
    const Plane *plane = &scene->planes[index];
    node_number(node, "step", event->as.hit.step + 1);
    put_face(node, scene, index);
    node_text(node, "material", scene->materials[face->material].name);
    put_test(node, &event->as.hit.test);
    node_vector(node, "plane_normal", plane->normal);
    node_vector(node, "o_minus_v0", vec3_sub(place->ray.origin, face_vertex(face, 0)));
    node_vector(node, "t_r", vec3_scale(event->as.hit.test.t, place->ray.direction));
    node_vector(node, "point", walk_world(scene, event->as.hit.point));
    node_vector(node, "normal", event->as.hit.normal);
    node_vector(node, "shifted", walk_world(scene, event->as.hit.shifted));
    node_number(node, "shift", vec3_dot(event->as.hit.normal, vec3_sub(event->as.hit.shifted, event->as.hit.point)));
    Node vertices = node_array(node, "vertices"), edges = node_array(node, "edges");
    for (int k = 0; k < face->vertex_count; k++) {
        WalkEdge edge = walk_edge(face, k, event->as.hit.point);
        node_append_vector(vertices, walk_world(scene, face_vertex(face, k)));
        Node at = node_append_object(edges);
        node_vector(at, "e", edge.e);
        node_vector(at, "c", edge.c);
    }
}

/* --- Lights --- */

static void put_light(Node node, const Scene *scene, const WalkPlace *place, const Event *event)
{
    const Face *face = &scene->faces[place->hit->as.hit.face];
    node_number(node, "light", event->as.light.light);
    node_vector(node, "position", walk_world(scene, event->as.light.position));
    node_vector(node, "to_light", event->as.light.to_light);
    node_number(node, "distance", event->as.light.distance);
    node_vector(node, "l", event->as.light.l);
    node_vector(node, "light_minus_v0", vec3_sub(event->as.light.position, face_vertex(face, 0)));
    node_number(node, "height", event->as.light.height);
    node_number(node, "side", event->as.light.side);
    node_number(node, "n_dot_l", event->as.light.side == 0 ? 0 : vec3_dot(place->hit->as.hit.normal, event->as.light.l));
    node_vector(node, "shadow_origin", walk_world(scene, event->as.light.shadow_origin));
}

static void put_terms(Node node, const Scene *scene, const WalkPlace *place, const Event *event)
{
    const Material *material = &scene->materials[scene->faces[place->hit->as.hit.face].material];
    const Light *light = &scene->lights[event->as.terms.light];
    const Illumination *terms = &event->as.terms.illumination;
    node_number(node, "light", event->as.terms.light);
    node_bool(node, "ambient_only", event->as.terms.ambient_only);
    node_vector(node, "ka", material->ambient);
    node_vector(node, "kd", material->diffuse);
    node_vector(node, "ks", material->specular);
    node_number(node, "shininess", material->shininess);
    node_vector(node, "ia", light->ambient);
    node_vector(node, "id", light->diffuse);
    node_vector(node, "is", light->specular);
    node_vector(node, "l", event->as.terms.l);
    node_vector(node, "v", event->as.terms.v);
    node_vector(node, "h", terms->h);
    node_number(node, "l_dot_n", terms->l_dot_n);
    node_number(node, "n_dot_h", terms->n_dot_h);
    node_number(node, "exponent", event->as.terms.exponent);
    node_number(node, "highlight", pow(terms->n_dot_h, event->as.terms.exponent));
    node_vector(node, "ambient", terms->ambient);
    node_vector(node, "diffuse", terms->diffuse);
    node_vector(node, "specular", terms->specular);
    node_vector(node, "sum", event->as.terms.sum);
}

/* --- The path --- */

static void put_sample(Node node, const Scene *scene, const WalkPlace *place, const Event *event)
{
    View view = view_of(scene);
    ScreenPoint at = event->as.sample.at;
    node_number(node, "i", event->as.sample.i);
    node_number(node, "j", event->as.sample.j);
    node_bool(node, "told", place->told);
    node_number(node, "x", at.x);
    node_number(node, "y", at.y);
    node_vector(node, "c", walk_world(scene, event->as.sample.c));
    node_vector(node, "distance_f", view.forward);
    node_vector(node, "x_r", vec3_scale(at.x, view.right));
    node_vector(node, "y_u", vec3_scale(at.y, view.up));
    node_vector(node, "q", walk_world(scene, event->as.sample.q));
    node_vector(node, "r", event->as.sample.r);
}

static void put_reflected(Node node, const Scene *scene, const WalkPlace *place, const Event *event)
{
    Vec3 r = event->as.reflected.r_unit, n = place->hit->as.hit.normal;
    double r_dot_n = vec3_dot(r, n);
    node_number(node, "bounce", event->as.reflected.bounce);
    node_vector(node, "r_unit", r);
    node_number(node, "r_dot_n", r_dot_n);
    node_vector(node, "minus_2_r_dot_n_n", vec3_scale(-2 * r_dot_n, n));
    node_vector(node, "direction", event->as.reflected.direction);
    node_vector(node, "origin", walk_world(scene, event->as.reflected.origin));
    node_number(node, "reflection", event->as.reflected.reflection);
    node_number(node, "weight", event->as.reflected.weight);
}

static void put_pixel(Node node, const Event *event)
{
    Vec3 c = event->as.pixel.clamped;
    const unsigned char *rgb = event->as.pixel.rgb;
    node_number(node, "samples", event->as.pixel.samples);
    node_vector(node, "sum", event->as.pixel.sum);
    node_vector(node, "average", event->as.pixel.average);
    node_vector(node, "clamped", c);
    node_vector(node, "scaled", vec3(255 * c.x + 0.5, 255 * c.y + 0.5, 255 * c.z + 0.5));
    node_vector(node, "rgb", vec3(rgb[0], rgb[1], rgb[2]));
}

/* --- All of them --- */

static const char *const kinds[EVENT_KIND_COUNT] = {"adaptive",  "sample",   "face",     "node",      "hit",   "miss",
                                                    "light",     "occluder", "light end", "terms", "shaded",
                                                    "reflected", "path end", "pixel",     "tally"};

cJSON *walk_event_json(const Walkthrough *walk, const WalkPlace *place, const Event *event, bool *failed)
{
    const Scene *scene = walk->scene;
    Node node = node_new(failed);
    node_text(node, "event", kinds[event->kind]);
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
        node_number(node, "nearest_t", event->as.face.nearest_t);
        break;
    case EVENT_OCCLUDER:
        put_face(node, scene, event->as.occluder.face);
        put_test(node, &event->as.occluder.test);
        break;
    case EVENT_TALLY:
        put_tally(node, event);
        break;
    case EVENT_HIT:
        put_hit(node, scene, place, event);
        break;
    case EVENT_MISS:
        node_number(node, "weight", event->as.miss.weight);
        node_vector(node, "background", event->as.miss.background);
        node_vector(node, "contribution", event->as.miss.weight_times_background);
        break;
    case EVENT_LIGHT:
        put_light(node, scene, place, event);
        break;
    case EVENT_LIGHT_END:
        node_number(node, "light", event->as.light_end.light);
        node_text(node, "verdict", walk_light_verdicts[event->as.light_end.verdict]);
        if (event->as.light_end.blocker >= 0)
            put_face(node, scene, event->as.light_end.blocker);
        break;
    case EVENT_TERMS:
        put_terms(node, scene, place, event);
        break;
    case EVENT_SHADED:
        node_number(node, "lights_reaching", event->as.shaded.lights_reaching);
        node_number(node, "weight", event->as.shaded.weight);
        node_vector(node, "illumination", event->as.shaded.illumination);
        node_vector(node, "contribution", event->as.shaded.contribution);
        node_vector(node, "total", event->as.shaded.total);
        break;
    case EVENT_REFLECTED:
        put_reflected(node, scene, place, event);
        break;
    case EVENT_PATH_END:
        node_text(node, "reason", walk_path_ends[event->as.path_end.reason]);
        node_number(node, "bounces", event->as.path_end.bounces);
        node_vector(node, "colour", event->as.path_end.colour);
        break;
    case EVENT_PIXEL:
        put_pixel(node, event);
        break;
    case EVENT_NODE:
        node_number(node, "node", event->as.node.node);
        node_number(node, "level", event->as.node.level);
        node_bool(node, "entered", event->as.node.entered);
        node_number(node, "faces", event->as.node.faces);
        break;
    case EVENT_KIND_COUNT:
        break;
    }
    return node.object;
}

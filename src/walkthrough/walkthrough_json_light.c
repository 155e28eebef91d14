/* What one light does at one point, as members of a JSON object. */
#include "walkthrough/walkthrough_json_light.h"

#include <math.h>

void walkthrough_json_light(JsonNode node, const Scene *scene, const WalkthroughPlace *place, const Event *event)
{
    const Face *face = &scene->faces[place->hit->as.hit.face];
    json_node_number(node, "light", event->as.light.light);
    json_node_vector(node, "position", walkthrough_world(scene, event->as.light.position));
    json_node_vector(node, "to_light", event->as.light.to_light);
    json_node_number(node, "distance", event->as.light.distance);
    json_node_vector(node, "l", event->as.light.l);
    json_node_vector(node, "light_minus_v0", vec3_sub(event->as.light.position, face_vertex(face, 0)));
    json_node_number(node, "height", event->as.light.height);
    json_node_number(node, "side", event->as.light.side);
    json_node_number(node, "n_dot_l",
                     event->as.light.side == 0 ? 0 : vec3_dot(place->hit->as.hit.normal, event->as.light.l));
    json_node_vector(node, "shadow_origin", walkthrough_world(scene, event->as.light.shadow_origin));
}

void walkthrough_json_terms(JsonNode node, const Scene *scene, const WalkthroughPlace *place, const Event *event)
{
    const Material *material = &scene->materials[scene->faces[place->hit->as.hit.face].material];
    const Light *light = &scene->lights[event->as.terms.light];
    const Illumination *terms = &event->as.terms.illumination;
    json_node_number(node, "light", event->as.terms.light);
    json_node_bool(node, "ambient_only", event->as.terms.ambient_only);
    json_node_vector(node, "ka", material->ambient);
    json_node_vector(node, "kd", material->diffuse);
    json_node_vector(node, "ks", material->specular);
    json_node_number(node, "shininess", material->shininess);
    json_node_vector(node, "ia", light->ambient);
    json_node_vector(node, "id", light->diffuse);
    json_node_vector(node, "is", light->specular);
    json_node_vector(node, "l", event->as.terms.l);
    Vec3 to_viewer = walkthrough_to_viewer(scene, place), l_plus_v = vec3_add(event->as.terms.l, event->as.terms.v);
    json_node_vector(node, "to_viewer", to_viewer);
    json_node_number(node, "to_viewer_length", vec3_length(to_viewer));
    json_node_vector(node, "v", event->as.terms.v);
    json_node_vector(node, "l_plus_v", l_plus_v);
    json_node_number(node, "l_plus_v_length", vec3_length(l_plus_v));
    json_node_vector(node, "h", terms->h);
    json_node_number(node, "l_dot_n", terms->l_dot_n);
    json_node_number(node, "n_dot_h", terms->n_dot_h);
    json_node_number(node, "exponent", event->as.terms.exponent);
    json_node_number(node, "highlight", pow(terms->n_dot_h, event->as.terms.exponent));
    json_node_vector(node, "ambient", terms->ambient);
    json_node_vector(node, "diffuse", terms->diffuse);
    json_node_vector(node, "specular", terms->specular);
    json_node_vector(node, "sum", event->as.terms.sum);
}

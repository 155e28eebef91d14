/* Writes a scene for POV-Ray: the same faces, view, lights and colours, as near as its shading comes to ours, so that
 * whole processes can be timed side by side. One-sided faces become two-sided ones: POV-Ray knows no others.
 * Usage: povray_export SCENE.json > SCENE.pov */
#include "reader/scene_json.h"
#include "scene/geometry.h"

#include <stdio.h>

static void print_vector(const char *before, Vec3 a, const char *after)
{
    printf("%s<%.9g, %.9g, %.9g>%s", before, a.x, a.y, a.z, after);
}

/* POV-Ray looks along `direction`; a picture is |right| wide and |up| high at its end. */
static void print_view(const Scene *scene)
{
    View view = view_of(scene);
    printf("#version 3.7;\nglobal_settings { assumed_gamma 1 max_trace_level %d }\n", scene->shading.max_bounces + 1);
    print_vector("background { rgb ", scene->shading.background, " }\n");
    print_vector("camera { perspective location ", view.eye, "\n");
    print_vector("  direction ", view.forward, "\n");
    print_vector("  right ", vec3_scale(view.width, view.right), "\n");
    print_vector("  up ", vec3_scale(view.height, view.up), " }\n");
    for (int i = 0; i < scene->light_count; i++) {
        print_vector("light_source { ", scene->lights[i].position, ", ");
        print_vector("rgb ", scene->lights[i].diffuse, " }\n");
    }
}

static double share(double part, double of)
{
    return of > 0 ? part / of : 0;
}

static double mean(Vec3 a)
{
    return (a.x + a.y + a.z) / 3;
}

/* Its terms are factors of the pigment's colour, so the ambient colour is divided by the diffuse one. */
static void print_texture(const Scene *scene, const Material *m)
{
    Vec3 light = {0, 0, 0};
    for (int i = 0; i < scene->light_count; i++)
        light = vec3_add(light, scene->lights[i].ambient);
    Vec3 ambient = vec3_multiply(m->ambient, light);
    print_vector("  texture { pigment { color rgb ", m->diffuse, " }\n");
    print_vector("    finish { diffuse 1 ambient rgb ",
                 vec3(share(ambient.x, m->diffuse.x), share(ambient.y, m->diffuse.y), share(ambient.z, m->diffuse.z)),
                 "");
    printf(" specular %.6g roughness %.6g reflection %.6g } }\n", mean(m->specular),
           m->shininess > 0 ? 4 / m->shininess : 1, m->reflection);
}

static void print_triangles(const Face *face, int vertex)
{
    printf("<%d, %d, %d>", vertex, vertex + 1, vertex + 2);
    if (face->vertex_count == 4)
        printf(", <%d, %d, %d>", vertex, vertex + 2, vertex + 3);
}

/* One mesh per material. */
static void print_mesh(const Scene *scene, int material)
{
    int faces = 0, triangles = 0;
    for (int i = 0; i < scene->face_count; i++)
        if (scene->faces[i].material == material) {
            faces++;
            triangles += scene->faces[i].vertex_count - 2;
        }
    if (faces == 0)
        return;
    printf("mesh2 {\n  vertex_vectors { %d", faces * 4);
    for (int i = 0; i < scene->face_count; i++)
        for (int k = 0; k < 4 && scene->faces[i].material == material; k++)
            print_vector(k == 0 ? ",\n    " : ", ", face_vertex(&scene->faces[i], k), "");
    printf(" }\n  face_indices { %d", triangles);
    for (int i = 0, vertex = 0; i < scene->face_count; i++)
        if (scene->faces[i].material == material) {
            printf(",\n    ");
            print_triangles(&scene->faces[i], vertex);
            vertex += 4;
        }
    printf(" }\n");
    print_texture(scene, &scene->materials[material]);
    printf("}\n");
}

int main(int argc, char **argv)
{
    Error error = {0};
    Scene scene;
    if (argc != 2) {
        fprintf(stderr, "usage: povray_export SCENE.json > SCENE.pov\n");
        return ERROR_USAGE;
    }
    if (!scene_load(&scene, argv[1], &error)) {
        fprintf(stderr, "%s\n", error.text);
        return (int)error.kind;
    }
    print_view(&scene);
    for (int i = 0; i < scene.material_count; i++)
        print_mesh(&scene, i);
    scene_free(&scene);
    return fflush(stdout) == 0 ? 0 : ERROR_SYSTEM;
}

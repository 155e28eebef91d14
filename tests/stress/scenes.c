/* Scenes made in memory. */
#include "scenes.h"

#include "scene/geometry.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

Vec3 vec3_at(const double *numbers)
{
    return vec3(numbers[0], numbers[1], numbers[2]);
}

void vec3_put(double *numbers, Vec3 a)
{
    numbers[0] = a.x;
    numbers[1] = a.y;
    numbers[2] = a.z;
}

Vec3 vec3_rounded(Vec3 a)
{
    return vec3((double)(float)a.x, (double)(float)a.y, (double)(float)a.z);
}

static void *checked(void *memory)
{
    if (memory)
        return memory;
    fprintf(stderr, "stress: out of memory\n");
    exit(3);
}

Scene scene_empty(void)
{
    Scene scene = {
        .camera = {.position = {0, 0, 1}, .up = {0, 1, 0}},
        .screen = {.columns = 1, .rows = 1, .distance = 1, .width = 2},
        .grid = 1,
    };
    scene.materials = checked(calloc(1, sizeof *scene.materials));
    scene.materials[0] = (Material){.diffuse = {1, 1, 1}};
    scene.material_count = 1;
    return scene;
}

/* Grown whenever the count is a power of two. */
static void *grown(void *array, int count, size_t size)
{
    if (count & (count - 1))
        return array;
    return checked(realloc(array, (count > 0 ? 2 * (size_t)count : 1) * size));
}

int scene_add(Scene *scene, const Vec3 *corners, int count)
{
    int i = scene->face_count;
    scene->faces = grown(scene->faces, i, sizeof *scene->faces);
    scene->planes = grown(scene->planes, i, sizeof *scene->planes);
    Face face = {.vertex_count = (unsigned short)count, .number = i};
    for (int k = 0; k < 4; k++) {
        Vec3 v = corners[k < count ? k : 0];
        face.vertices[k][0] = (float)v.x;
        face.vertices[k][1] = (float)v.y;
        face.vertices[k][2] = (float)v.z;
    }
    scene->faces[i] = face;
    scene->planes[i] = face_plane(&face);
    return scene->face_count++;
}

void scene_add_light(Scene *scene, Vec3 position)
{
    scene->lights = grown(scene->lights, scene->light_count, sizeof *scene->lights);
    scene->lights[scene->light_count++] = (Light){.position = position, .diffuse = {1, 1, 1}, .ambient = {1, 1, 1}};
}

void scene_add_box(Scene *scene, Vec3 corner, Vec3 a, Vec3 b, Vec3 c)
{
    const Vec3 edges[3] = {a, b, c};
    for (int i = 0; i < 3; i++) {
        for (int far = 0; far < 2; far++) {
            /* Every corner is the same sum, in the same order, for the three sides that meet there. */
            Vec3 quad[4];
            for (int k = 0; k < 4; k++) {
                int use[3] = {0, 0, 0};
                use[i] = far;
                use[(i + 1) % 3] = k == 1 || k == 2;
                use[(i + 2) % 3] = k >= 2;
                Vec3 p = corner;
                for (int e = 0; e < 3; e++)
                    if (use[e])
                        p = vec3_add(p, edges[e]);
                quad[k] = p;
            }
            scene_add(scene, quad, 4);
        }
    }
}

Vec3 sheet_vertex(const Sheet *sheet, int i, int j)
{
    Vec3 flat = vec3((i - sheet->cells / 2) * sheet->spacing, (j - sheet->cells / 2) * sheet->spacing, 0);
    return vec3_rounded(vec3_add(sheet->centre, rotate(&sheet->rotation, flat)));
}

Sheet sheet_make(Random *random, int cells, double spacing, Vec3 centre)
{
    Sheet sheet = {scene_empty(), cells, spacing, centre, random_rotation(random)};
    for (int j = 0; j < cells; j++)
        for (int i = 0; i < cells; i++) {
            const Vec3 corners[4] = {sheet_vertex(&sheet, i, j), sheet_vertex(&sheet, i + 1, j),
                                     sheet_vertex(&sheet, i + 1, j + 1), sheet_vertex(&sheet, i, j + 1)};
            scene_add(&sheet.scene, corners, 4);
        }
    return sheet;
}

static void write_faces(FILE *file, const Scene *scene)
{
    const char *comma = "";
    fputs("{\"material\": \"dull\", \"vertices\": [", file);
    for (int i = 0; i < scene->face_count; i++)
        for (int k = 0; k < scene->faces[i].vertex_count; k++, comma = ",") {
            const float *v = scene->faces[i].vertices[k];
            fprintf(file, "%s\n[%.9g, %.9g, %.9g]", comma, (double)v[0], (double)v[1], (double)v[2]);
        }
    fputs("], \"faces\": [", file);
    for (int i = 0, first = 0; i < scene->face_count; first += scene->faces[i++].vertex_count)
        if (scene->faces[i].vertex_count == 4)
            fprintf(file, "%s[%d, %d, %d, %d]", i ? ", " : "", first, first + 1, first + 2, first + 3);
        else
            fprintf(file, "%s[%d, %d, %d]", i ? ", " : "", first, first + 1, first + 2);
    fputs("]}", file);
}

/* Two small triangles in opposite corners of a cube keep the scene's centre at the origin. */
static void write_frame(FILE *file, double size)
{
    for (int sign = -1; sign <= 1; sign += 2) {
        double a = sign * size, b = a * (1 - 0x1p-10);
        fprintf(file,
                ",\n{\"material\": \"dull\", \"vertices\": [[%.17g, %.17g, %.17g], [%.17g, %.17g, %.17g], [%.17g, "
                "%.17g, %.17g]],"
                " \"faces\": [[0, 1, 2]]}",
                a, a, a, b, a, a, a, b, a);
    }
}

void scene_write(const Scene *scene, const char *path)
{
    FILE *file = fopen(path, "w");
    if (!file)
        return;
    double size = 1;
    for (int i = 0; i < scene->face_count; i++)
        for (int k = 0; k < 12; k++)
            size = fmax(size, fabs((double)scene->faces[i].vertices[k / 3][k % 3]));
    int exponent;
    frexp(size, &exponent);
    fputs(
        "{\"camera\": {\"position\": [0, 0, 1], \"look_at\": [0, 0, 0]}, \"screen\": {\"columns\": 64, \"rows\": 64},\n"
        "\"materials\": {\"dull\": {\"diffuse\": [1, 1, 1]}},\n\"objects\": [",
        file);
    write_faces(file, scene);
    write_frame(file, ldexp(1, exponent + 2));
    fputs("]}\n", file);
    fclose(file);
}

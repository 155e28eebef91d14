/* The walkthrough as a Wavefront OBJ file: each ray, normal and shifted point a line element in a group of its own, in
 * the coordinates of the scene file, so that Blender or MeshLab shows them beside the scene, or, with the scene's faces
 * in the same file, in it. */
#include "walkthrough/ink.h"
#include "walkthrough/walkthrough_boxes.h"
#include "walkthrough/walkthrough_formats.h"
#include "walkthrough/walkthrough_lines.h"
#include "walkthrough/walkthrough_words.h"

typedef struct ObjFile {
    FILE *out;
    long vertices; /* written so far; OBJ counts them from 1 */
} ObjFile;

static void write_vertex(ObjFile *file, Vec3 p)
{
    fprintf(file->out, "v %.17g %.17g %.17g\n", p.x, p.y, p.z);
    file->vertices++;
}

static void write_group(const ObjFile *file, const WalkthroughLine *line)
{
    FILE *out = file->out;
    switch (line->kind) {
    case LINE_PRIMARY:
        fprintf(out, "g primary%s\n", line->leaves ? "_leaves" : "");
        break;
    case LINE_REFLECTED:
        fprintf(out, line->leaves ? "g reflected_leaves\n" : "g reflected_to_P%d\n", line->hit);
        break;
    case LINE_SHADOW:
        fprintf(out, "g shadow_P%d_light_%d\n", line->hit, line->light);
        break;
    case LINE_BLOCKED:
        fprintf(out, "g shadow_P%d_light_%d_blocked\n", line->hit, line->light);
        break;
    case LINE_NORMAL:
        fprintf(out, "g normal_P%d\n", line->hit);
        break;
    case LINE_SHIFT:
        fprintf(out, "g shifted_P%d\n", line->hit);
        break;
    }
}

static void write_line(void *user, const WalkthroughLine *line)
{
    ObjFile *file = user;
    write_group(file, line);
    write_vertex(file, line->from);
    write_vertex(file, line->to);
    fprintf(file->out, "l %ld %ld\n", file->vertices - 1, file->vertices);
}

static void write_box(void *user, const WalkthroughBox *box)
{
    ObjFile *file = user;
    fprintf(file->out, "g node_%s\n# node %d, level %d%s\n", box->entered ? "entered" : "passed", box->node, box->level,
            box->leaf ? ", a leaf" : "");
    for (int k = 0; k < 8; k++)
        write_vertex(file, box->corners[k]);
    for (int k = 0; k < BOX_EDGES; k++)
        fprintf(file->out, "l %ld %ld\n", file->vertices - 7 + walkthrough_box_edges[k][0],
                file->vertices - 7 + walkthrough_box_edges[k][1]);
}

/* A name as groups have it: one word. */
static InkText word_of(const char *name)
{
    InkText word = ink_name(name, 80);
    for (char *c = word.text; *c; c++)
        *c = *c == ' ' ? '_' : *c;
    return word;
}

static void write_face(ObjFile *file, const Scene *scene, const Face *face)
{
    for (int k = 0; k < face->vertex_count; k++)
        write_vertex(file, walkthrough_world(scene, face_vertex(face, k)));
    fprintf(file->out, "f");
    for (int k = face->vertex_count; k > 0; k--)
        fprintf(file->out, " %ld", file->vertices - k + 1);
    fprintf(file->out, "\n");
}

static void write_scene(ObjFile *file, const Scene *scene)
{
    int object = -1, material = -1;
    const char *part = NULL;
    for (int i = 0; i < scene->face_count; i++) {
        const Face *face = &scene->faces[i];
        if (face->object != object || scene_part_of(scene, i) != part)
            fprintf(file->out, "g scene_%s\n", word_of(walkthrough_owner_words(scene, i, 80).text).text);
        part = scene_part_of(scene, i);
        if (face->material != material)
            fprintf(file->out, "usemtl %s\n", ink_name(scene->materials[face->material].name, 80).text);
        object = face->object;
        material = face->material;
        write_face(file, scene, face);
    }
}

bool walkthrough_write_obj(FILE *out, const Walkthrough *walk, WalkthroughStyle style, Error *error)
{
    ObjFile file = {.out = out};
    fprintf(out, "# The path of pixel (%d, %d) of %s, in the coordinates of that file.\n", walk->request.column,
            walk->request.row, ink_name(walk->scene_name, 60).text);
    fprintf(out, "# The shifted points are so near to their hits that no viewer can tell them apart.\n");
    walkthrough_lines(walk, write_line, &file);
    if (style.with_scene)
        write_scene(&file, walk->scene);
    return walkthrough_boxes(walk, write_box, &file, error);
}

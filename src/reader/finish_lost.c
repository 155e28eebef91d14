/* Faces that lose their area. */
#include "reader/finish_lost.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

const char finish_lost_reason[] = "the face is too small for its distance from the centre of the scene: rounded to "
                                  "float32 it loses its area or its shape";

/* Are the faces at `index` and after it pieces of one? */
static bool is_with_next(const SceneBuild *build, int index)
{
    return index + 1 < build->face_count && build->faces[index].number == build->faces[index + 1].number;
}

bool finish_lost_may_be(const SceneBuild *build, int index)
{
    return build->faces[index].skip || is_with_next(build, index) || (index > 0 && is_with_next(build, index - 1));
}

void finish_lost_point(Face *face, int vertex)
{
    for (int k = vertex; k < 3; k++)
        memcpy(face->vertices[k], face->vertices[k + 1], sizeof face->vertices[k]);
    memcpy(face->vertices[3], face->vertices[0], sizeof face->vertices[3]);
    face->vertex_count = 3;
}

/* All pieces of the face are lost. */
static bool lose(SceneBuild *build, const SceneBuildFace *face)
{
    if (face->skip)
        return scene_build_note_face(build, NOTE_TOO_SMALL, face->object, face->place);
    build->fault = face;
    snprintf(build->reason, sizeof build->reason, "%s", finish_lost_reason);
    return false;
}

/* --- Objects and parts --- */

/* Which of them begin where, while faces before them go. */
typedef struct Owners {
    Scene *scene;
    int object, part; /* the next ones */
    int parts;        /* kept so far */
    int open;         /* the object of the last part, while its faces are passed; -1: none */
} Owners;

/* The last part ends before face `kept`. It goes if it has no face. */
static void end_part(Owners *owners, int kept)
{
    ScenePart *last = owners->open >= 0 ? &owners->scene->parts[owners->parts - 1] : NULL;
    if (last && last->first_face == kept) {
        free(last->name);
        owners->parts--;
    }
    owners->open = -1;
}

/* Passes face `index`, which will be number `kept`, of `object`; -1: the end of all faces. */
static void pass(Owners *owners, int index, int object, int kept)
{
    Scene *scene = owners->scene;
    for (; owners->object < scene->object_count && scene->objects[owners->object].first_face == index; owners->object++)
        scene->objects[owners->object].first_face = kept;
    bool begins = owners->part < scene->part_count && scene->parts[owners->part].first_face == index;
    if (begins || object != owners->open)
        end_part(owners, kept);
    if (begins) {
        scene->parts[owners->parts] = scene->parts[owners->part++];
        scene->parts[owners->parts++].first_face = kept;
        owners->open = object;
    }
}

bool finish_lost_drop(SceneBuild *build)
{
    Scene *scene = build->scene;
    Owners owners = {.scene = scene, .open = -1};
    int kept = 0, pieces = 0;
    for (int i = 0; i < build->face_count; i++) {
        pass(&owners, i, build->faces[i].object, kept);
        if (scene->faces[i].vertex_count > 0) {
            scene->faces[kept] = scene->faces[i];
            scene->planes[kept++] = scene->planes[i];
            pieces++;
        }
        if (is_with_next(build, i))
            continue;
        if (pieces == 0 && !lose(build, &build->faces[i]))
            return false;
        pieces = 0;
    }
    pass(&owners, build->face_count, -1, kept);
    scene->part_count = owners.parts;
    scene->face_count = kept;
    return true;
}

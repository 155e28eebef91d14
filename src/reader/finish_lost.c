/* Faces that lose their area. */
#include "reader/finish_lost.h"

#include <stdio.h>
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

void finish_lost_point(Face *face, int second)
{
    for (int k = second; k < 3; k++)
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

bool finish_lost_drop(SceneBuild *build)
{
    Scene *scene = build->scene;
    int kept = 0, pieces = 0, object = 0, part = 0;
    for (int i = 0; i <= build->face_count; i++) {
        for (; object < scene->object_count && scene->objects[object].first_face == i; object++)
            scene->objects[object].first_face = kept;
        for (; part < scene->part_count && scene->parts[part].first_face == i; part++)
            scene->parts[part].first_face = kept;
        if (i == build->face_count)
            break;
        if (scene->faces[i].vertex_count > 0) {
            scene->faces[kept] = scene->faces[i];
            scene->planes[kept++] = scene->planes[i];
            pieces++;
        }
        if (!is_with_next(build, i)) {
            if (pieces == 0 && !lose(build, &build->faces[i]))
                return false;
            pieces = 0;
        }
    }
    scene->face_count = kept;
    return true;
}

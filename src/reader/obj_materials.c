/* The materials of a model's faces. */
#include "reader/obj_materials.h"

#include "base/array.h"
#include "base/text.h"
#include "reader/model_library.h"
#include "reader/scene_mtl.h"

#include <stdlib.h>
#include <string.h>

static bool fail(const ObjMaterials *materials, long line, const char *what, const char *name)
{
    return error_set(materials->build->error, ERROR_INPUT, "%s:%ld: %s%s", materials->path, line, what, name);
}

static bool note(ObjMaterials *materials, NoteName name, long line, char *detail)
{
    return scene_build_note(materials->build, name, materials->path, (NotePlace){.line = line, .detail = detail});
}

/* A Ka of 1 under a light whose ambient colour is 1: the ambient term alone is white. */
static bool is_white(const SceneBuild *build, Vec3 ka)
{
    bool white = false;
    for (int i = 0; i < build->scene->light_count; i++) {
        Vec3 ia = build->scene->lights[i].ambient;
        white = white || (ka.x * ia.x >= 1 && ka.y * ia.y >= 1 && ka.z * ia.z >= 1);
    }
    return white;
}

/* The scene's copy of a library's material, which is made where it is first used. -1 without memory. */
static int use_library_material(ObjMaterials *materials, MtlMaterial *found)
{
    SceneBuild *build = materials->build;
    Notes *notes = &build->scene->notes;
    if (found->used_as >= 0)
        return found->used_as;
    if (found->fault) {
        error_set(build->error, ERROR_INPUT, "%s:%ld: mtllib: %s:%ld: %s", materials->path, found->named_at,
                  found->path, found->fault_line, found->fault);
        return -1;
    }
    if (!mtl_library_tell(&materials->library, found, notes, build->error))
        return -1;
    Quoted name = text_quote(found->material.name);
    NotePlace ambient = {.line = found->ambient_line, .detail = name.text};
    if (is_white(build, found->material.ambient) &&
        !notes_add(notes, &note_kinds[NOTE_AMBIENT_WHITE], found->path, ambient, build->error))
        return -1;
    return found->used_as = scene_build_material(build, found->material);
}

/* The material of a name in *material: -1 where there is none. False without memory. */
static bool find(ObjMaterials *materials, const char *name, int *material)
{
    *material = names_find(&materials->build->materials, name);
    int own = *material < 0 ? names_find(&materials->library.names, name) : -1;
    if (own < 0)
        return true;
    *material = use_library_material(materials, &materials->library.items[own]);
    return *material >= 0;
}

bool obj_materials_use(ObjMaterials *materials, const char *name, long line)
{
    Error *error = materials->build->error;
    materials->current = -1;
    if (!*name)
        return true;
    if (!find(materials, name, &materials->current) || materials->current >= 0)
        return materials->current >= 0;
    ObjLate *grown =
        array_grown(materials->late, materials->late_count, &materials->late_capacity, sizeof *grown, "names", error);
    if (!grown)
        return false;
    materials->late = grown;
    char *copy = text_copy(name, error);
    if (!copy)
        return false;
    materials->current = OBJ_LATE + materials->late_count;
    grown[materials->late_count++] = (ObjLate){copy, line, -1};
    return true;
}

/* Reads the library, or notes that it is missing. */
static bool add_library(ObjMaterials *materials, LibraryName *name, long line)
{
    Error *error = materials->build->error, reason = {.kind = ERROR_NONE};
    if (!name->path) {
        if (!materials->missing_library.text[0]) {
            materials->missing_library = text_quote(name->name);
            materials->missing_line = line;
        }
        return note(materials, NOTE_LIBRARY_MISSING, line, text_quote(name->name).text);
    }
    if (!name->as_written && !note(materials, NOTE_LIBRARY_RENAMED, line, text_quote(name->path).text))
        return false;
    int before = materials->library.count;
    bool good = scene_mtl_read(&materials->library, name->path, &materials->build->scene->notes, &reason);
    name->path = NULL;
    for (int i = before; i < materials->library.count; i++)
        materials->library.items[i].named_at = line;
    if (good)
        return true;
    return reason.kind == ERROR_INPUT ? fail(materials, line, "mtllib: ", reason.text)
                                      : error_set(error, reason.kind, "%s", reason.text);
}

bool obj_materials_add(ObjMaterials *materials, char *names, long line)
{
    Error *error = materials->build->error;
    LibraryName name;
    if (!*names)
        return note(materials, NOTE_LIBRARY_MISSING, line, "mtllib without a file");
    bool good = true;
    while (good && library_name_next(&name, materials->path, &names, error)) {
        good = add_library(materials, &name, line);
        library_name_free(&name);
    }
    return good && error->kind == ERROR_NONE;
}

/* Tells what cannot be read of materials that no face has. */
static bool tell_faults(ObjMaterials *materials)
{
    SceneBuild *build = materials->build;
    for (int i = 0; i < materials->library.count; i++) {
        const MtlMaterial *material = &materials->library.items[i];
        NotePlace place = {.line = material->fault_line, .detail = material->fault};
        if (material->fault && material->used_as < 0 &&
            !scene_build_note(build, NOTE_MATERIAL_UNREAD, material->path, place))
            return false;
    }
    return true;
}

bool obj_materials_find_late(ObjMaterials *materials)
{
    for (int i = 0; i < materials->late_count; i++) {
        ObjLate *late = &materials->late[i];
        if (!find(materials, late->name, &late->material))
            return false;
        if (late->material < 0 && materials->build->object.material >= 0 &&
            !note(materials, NOTE_MATERIAL_MISSING, late->line, text_quote(late->name).text))
            return false;
    }
    return tell_faults(materials);
}

int obj_materials_of_face(const ObjMaterials *materials, int material, long line)
{
    const ObjLate *late = material >= OBJ_LATE ? &materials->late[material - OBJ_LATE] : NULL;
    int own = materials->build->object.material, found = late ? late->material : material;
    found = found < 0 ? own : found;
    if (found >= 0)
        return found;
    char library[160] = "";
    if (materials->missing_library.text[0])
        snprintf(library, sizeof library, "; the library %s of line %ld is not there", materials->missing_library.text,
                 materials->missing_line);
    if (!late)
        fail(materials, line, "the face has no material: neither it nor its object names one", library);
    else
        error_set(materials->build->error, ERROR_INPUT,
                  "%s:%ld: the face has no material: %s is not in the scene nor in a library, and the object names "
                  "none%s",
                  materials->path, line, text_quote(late->name).text, library);
    return -1;
}

void obj_materials_free(ObjMaterials *materials)
{
    for (int i = 0; i < materials->late_count; i++)
        free(materials->late[i].name);
    free(materials->late);
    mtl_library_free(&materials->library);
    *materials = (ObjMaterials){0};
}

/* The materials of the libraries that one model names. */
#include "reader/mtl_library.h"

#include "base/array.h"
#include "base/text.h"

#include <stdlib.h>

MtlMaterial *mtl_library_add(MtlLibrary *library, const char *name, const char *path, Error *error)
{
    MtlMaterial *grown =
        array_grown(library->items, library->count, &library->capacity, sizeof *grown, "materials", error);
    if (!grown)
        return NULL;
    library->items = grown;
    char *copy = text_copy(name, error);
    if (!copy)
        return NULL;
    MtlMaterial *material = &grown[library->count++];
    *material =
        (MtlMaterial){.material = {.name = copy}, .used_as = -1, .path = path, .first_remark = library->remark_count};
    return names_add(&library->names, copy, library->count - 1, error) ? material : NULL;
}

bool mtl_library_remark(MtlLibrary *library, MtlRemark remark, Error *error)
{
    MtlRemark *grown = array_grown(library->remarks, library->remark_count, &library->remark_capacity, sizeof *grown,
                                   "remarks", error);
    if (!grown)
        return false;
    library->remarks = grown;
    if (remark.detail && !(remark.detail = text_copy(remark.detail, error)))
        return false;
    grown[library->remark_count++] = remark;
    library->items[library->count - 1].remark_count++;
    return true;
}

bool mtl_library_tell(const MtlLibrary *library, const MtlMaterial *material, Notes *notes, Error *error)
{
    for (int i = 0; i < material->remark_count; i++) {
        const MtlRemark *remark = &library->remarks[material->first_remark + i];
        NotePlace place = {.line = remark->line, .detail = remark->detail};
        if (!notes_add(notes, &note_kinds[remark->note], material->path, place, error))
            return false;
    }
    return true;
}

void mtl_library_free(MtlLibrary *library)
{
    for (int i = 0; i < library->count; i++) {
        free(library->items[i].material.name);
        free(library->items[i].fault);
    }
    for (int i = 0; i < library->remark_count; i++)
        free(library->remarks[i].detail);
    for (int i = 0; i < library->file_count; i++)
        free(library->files[i]);
    free(library->items);
    free(library->remarks);
    free(library->files);
    names_free(&library->names);
    *library = (MtlLibrary){0};
}

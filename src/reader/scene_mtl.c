/* Material libraries (MTL) of Wavefront OBJ models. */
#include "reader/scene_mtl.h"

#include "base/array.h"
#include "base/words.h"

#include <stdlib.h>
#include <string.h>

static bool add_material(MtlLibrary *library, const TextLines *lines, const char *name, Error *error)
{
    if (!*name)
        return word_fail(lines, error, "newmtl without a name");
    if (names_find(&library->names, name) >= 0)
        return word_fail(lines, error, "the material %s is defined twice", text_quote(name).text);
    Material *materials =
        array_grown(library->materials, library->count, &library->capacity, sizeof *materials, "materials", error);
    if (!materials)
        return false;
    library->materials = materials;
    int *used_as =
        array_grown(library->used_as, library->count, &library->used_capacity, sizeof *used_as, "materials", error);
    if (!used_as)
        return false;
    library->used_as = used_as;
    char *copy = text_copy(name, error);
    if (!copy)
        return false;
    library->used_as[library->count] = -1;
    library->materials[library->count++] = (Material){.name = copy};
    return names_add(&library->names, copy, library->count - 1, error);
}

static bool read_colour(const TextLines *lines, const char *key, char *rest, Vec3 *colour, Error *error)
{
    double c[3];
    int count;
    if (!word_numbers(lines, rest, c, 3, &count, error))
        return false;
    if (count != 3)
        return word_fail(lines, error, "%s needs three numbers, not %d", key, count);
    for (int i = 0; i < 3; i++)
        if (!(c[i] >= 0 && c[i] <= SCENE_MAX_COLOUR))
            return word_fail(lines, error, "%s: %g is not from 0 to %g", key, c[i], SCENE_MAX_COLOUR);
    *colour = vec3(c[0], c[1], c[2]);
    return true;
}

static bool read_shininess(const TextLines *lines, char *rest, double *shininess, Error *error)
{
    int count;
    if (!word_numbers(lines, rest, shininess, 1, &count, error))
        return false;
    if (count != 1 || !(*shininess >= 0 && *shininess <= SCENE_MAX_SHININESS))
        return word_fail(lines, error, "Ns needs a number from 0 to %g", SCENE_MAX_SHININESS);
    return true;
}

static bool read_line(MtlLibrary *library, const TextLines *lines, char *line, bool *inside, Error *error)
{
    char *rest = line;
    const char *key = word_next(&rest);
    if (strcmp(key, "newmtl") == 0) {
        *inside = true;
        return add_material(library, lines, word_rest(&rest), error);
    }
    static const char *const keys[] = {"Ka", "Kd", "Ks", "Ns"};
    int k = 0;
    while (k < 4 && strcmp(key, keys[k]) != 0)
        k++;
    if (k == 4)
        return true;
    if (!*inside)
        return word_fail(lines, error, "%s before the first newmtl", key);
    Material *material = &library->materials[library->count - 1];
    switch (k) {
    case 0:
        return read_colour(lines, key, rest, &material->ambient, error);
    case 1:
        return read_colour(lines, key, rest, &material->diffuse, error);
    case 2:
        return read_colour(lines, key, rest, &material->specular, error);
    default:
        return read_shininess(lines, rest, &material->shininess, error);
    }
}

static bool read_file(MtlLibrary *library, const char *path, Error *error)
{
    TextLines lines;
    bool good = text_open_lines(&lines, path, error), inside = false;
    for (char *line; good && (line = text_next_line(&lines, error));)
        good = read_line(library, &lines, line, &inside, error);
    text_close_lines(&lines);
    return good && error->kind == ERROR_NONE;
}

bool scene_mtl_read(MtlLibrary *library, char *path, Error *error)
{
    for (int i = 0; i < library->file_count; i++)
        if (strcmp(library->files[i], path) == 0) {
            free(path);
            return true;
        }
    char **files =
        array_grown(library->files, library->file_count, &library->file_capacity, sizeof *files, "paths", error);
    if (!files) {
        free(path);
        return false;
    }
    library->files = files;
    library->files[library->file_count++] = path;
    return read_file(library, path, error);
}

void scene_mtl_free(MtlLibrary *library)
{
    for (int i = 0; i < library->count; i++)
        free(library->materials[i].name);
    for (int i = 0; i < library->file_count; i++)
        free(library->files[i]);
    free(library->materials);
    free(library->used_as);
    free(library->files);
    names_free(&library->names);
    *library = (MtlLibrary){0};
}

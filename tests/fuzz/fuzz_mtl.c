/* Target: the reader of material libraries. */
#include "fuzz.h"

#include "reader/scene_mtl.h"

#include <stdlib.h>
#include <string.h>

static bool is_colour(Vec3 c)
{
    return c.x >= 0 && c.y >= 0 && c.z >= 0 && fmax(c.x, fmax(c.y, c.z)) <= SCENE_MAX_COLOUR;
}

int fuzz_mtl(const uint8_t *data, size_t size)
{
    static Error error;
    error.kind = ERROR_NONE;
    error.text[0] = '\0';
    const char *path = fuzz_file(FUZZ_LIBRARY, data, size);
    char *copy = strdup(path);
    REQUIRE(copy);
    MtlLibrary library = {0};
    Notes notes = {0};
    if (scene_mtl_read(&library, copy, &notes, &error)) {
        REQUIRE(error.kind == ERROR_NONE);
        for (int i = 0; i < library.count; i++) {
            const Material *material = &library.items[i].material;
            REQUIRE(names_find(&library.names, material->name) == i && library.items[i].used_as == -1);
            REQUIRE(is_colour(material->ambient) && is_colour(material->diffuse) && is_colour(material->specular));
            REQUIRE(material->shininess >= 0 && material->shininess <= SCENE_MAX_SHININESS);
        }
        int before = library.count;
        copy = strdup(path);
        REQUIRE(copy && scene_mtl_read(&library, copy, &notes, &error) && library.count == before); /* read once only */
    } else
        fuzz_check_error(&error);
    mtl_library_free(&library);
    notes_free(&notes);
    return 0;
}

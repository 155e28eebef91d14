/* Reads a scene, and tells its notes. */
#include "command/scene_open.h"

#include "reader/scene_json.h"

bool scene_open_tell(const Notes *notes, const Options *options, bool every, Error *error)
{
    if (options->strict)
        return notes_refuse(notes, error);
    if (!options->quiet)
        notes_print(notes, stderr, every);
    return true;
}

bool scene_open(Scene *scene, const Options *options, Error *error)
{
    if (!scene_load(scene, options->operands[0], error))
        return false;
    bool good = scene_open_tell(&scene->notes, options, false, error);
    if (!good)
        scene_free(scene);
    return good;
}

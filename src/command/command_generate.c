/* rectray generate: writes a seeded scene of a given size, as text that goes out while it is made. */
#include "base/output.h"
#include "command/command.h"
#include "reader/generate.h"

#include <string.h>

static bool write_file(const GenerateKind *kind, const Options *options, Error *error)
{
    Output output;
    if (!output_open(&output, options->output, "the scene", error))
        return false;
    if (generate_scene(kind, output.file, options->scene_size, (uint64_t)options->seed, error))
        return output_commit(&output, error);
    output_abort(&output);
    return false;
}

bool command_generate(const Options *options, Error *error)
{
    const GenerateKind *kind = generate_find_kind(options->operands[0], error);
    if (!kind)
        return false;
    if (options->scene_size < 1)
        return error_set(error, ERROR_USAGE, "generate %s needs --size N: %s", kind->name, kind->size_means);
    if (options->scene_size > kind->max_size)
        return error_set(error, ERROR_USAGE, "--size '%d': generate %s expects %s", options->scene_size, kind->name,
                         kind->size_means);
    if (options->output && strcmp(options->output, "-") != 0)
        return write_file(kind, options, error);
    return generate_scene(kind, stdout, options->scene_size, (uint64_t)options->seed, error);
}

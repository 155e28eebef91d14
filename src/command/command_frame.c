/* rectray frame: one frame of a scene that moves, as the scene that a file of its own would hold. */
#include "base/output.h"
#include "command/command.h"
#include "command/option_values.h"
#include "command/scene_open.h"

#include <stdlib.h>
#include <string.h>

static bool write_file(const Options *options, const char *text, Error *error)
{
    Output output;
    if (output_replaces(options->output, options->operands[0]))
        return error_set(error, ERROR_USAGE, "the frame %s would replace the scene itself; choose another -o",
                         options->output);
    if (!output_open(&output, options->output, "the frame", error))
        return false;
    fputs(text, output.file);
    return output_commit(&output, error);
}

bool command_frame(const Options *options, Error *error)
{
    Options own = *options;
    if (!option_set_frame(&own, options->operands[1]))
        return error_set(error, ERROR_USAGE, "frame '%s': expected a whole number from 0 to 999999",
                         options->operands[1]);
    char *text = scene_open_frame(&own, error);
    bool done = text != NULL;
    if (done && options->output && strcmp(options->output, "-") != 0)
        done = write_file(options, text, error);
    else if (done)
        fputs(text, stdout);
    free(text);
    return done;
}

/* Target: the command line. */
#include "fuzz.h"

#include "command/options.h"

#include <stdlib.h>
#include <string.h>

enum { MAX_WORDS = 64 };

static const Command COMMANDS[] = {
    {.name = "render", .operands = "SCENE", .operands_min = 1, .operands_max = 1},
    {.name = "trace", .operands = "SCENE", .operands_min = 1, .operands_max = 1},
    {.name = "cast", .operands = "SCENE", .operands_min = 1, .operands_max = 1},
    {.name = "check", .operands = "SCENE", .operands_min = 1, .operands_max = 1},
    {.name = "compare", .operands = "A.png B.png", .operands_min = 2, .operands_max = 2},
    {.name = "grade", .operands = "SCENE [WALKTHROUGH]", .operands_min = 1, .operands_max = 2},
    {.name = "bench", .operands = "[SCENE...]", .operands_min = 0, .operands_max = MAX_OPERANDS},
    {.name = "generate", .operands = "KIND", .operands_min = 1, .operands_max = 1},
    {.name = "join", .operands = "PART...", .operands_min = 1, .operands_max = MAX_PARTS},
    {.name = "kernels", .operands = ""},
    {.name = "help", .operands = "[COMMAND]", .operands_max = 1},
    {.name = "devices", .operands = "[N]", .operands_min = 0, .operands_max = 1},
    {0},
};

static void check_options(const Options *o, const Command *command)
{
    REQUIRE(o->columns >= 0 && o->columns <= SCENE_MAX_PIXELS && o->rows >= 0 && o->rows <= SCENE_MAX_PIXELS);
    REQUIRE((o->columns == 0) == (o->rows == 0));
    REQUIRE(o->grid >= 0 && o->grid <= SCENE_MAX_GRID);
    REQUIRE(o->bounces >= -1 && o->bounces <= SCENE_MAX_BOUNCES);
    REQUIRE(o->tolerance >= 0 && o->tolerance <= 255);
    REQUIRE(o->settings.threads >= 0 && o->settings.device >= -1 && o->settings.lanes <= 16);
    REQUIRE(o->settings.accel >= ACCEL_AUTO && o->settings.accel <= ACCEL_LBVH);
    REQUIRE(o->part.number >= 0 && o->part.number <= o->part.count && o->part.count <= MAX_PARTS);
    REQUIRE((o->settings.region.columns > 0) == (o->settings.region.rows > 0));
    REQUIRE(o->backend == BACKEND_OPENCL || o->backend == BACKEND_REFERENCE);
    REQUIRE(o->pixel_column >= 0 && o->pixel_column < SCENE_MAX_PIXELS);
    REQUIRE(o->sample_i >= 0 && o->sample_i < SCENE_MAX_GRID && o->sample_j >= 0 && o->sample_j < SCENE_MAX_GRID);
    if (o->help || o->version)
        return;
    REQUIRE(o->operand_count >= command->operands_min && o->operand_count <= command->operands_max);
    for (int i = 0; i < o->operand_count; i++)
        REQUIRE(o->operands[i]);
}

int fuzz_options(const uint8_t *data, size_t size)
{
    static Error error;
    char *text = malloc(size + 1), *argv[MAX_WORDS + 1];
    REQUIRE(text);
    memcpy(text, data, size);
    text[size] = '\0';
    int argc = 0;
    for (char *word = text; word && argc < MAX_WORDS;) {
        char *end = strchr(word, '\n');
        argv[argc++] = word;
        if (end)
            *end++ = '\0';
        word = end;
    }
    argv[argc] = NULL;

    Options options;
    error.kind = ERROR_NONE;
    error.text[0] = '\0';
    const Command *command = options_find_command(COMMANDS, argv[0], &error);
    if (command && options_parse(&options, command, argc, argv, &error)) {
        REQUIRE(error.kind == ERROR_NONE);
        check_options(&options, command);
    } else {
        REQUIRE(error.kind == ERROR_USAGE);
        fuzz_check_error(&error);
    }
    free(text);
    return 0;
}

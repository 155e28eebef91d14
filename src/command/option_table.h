/* Every option there is, in one table from which parsing, messages and help are made. */
#ifndef RECTRAY_OPTION_TABLE_H
#define RECTRAY_OPTION_TABLE_H

#include "command/progress.h"
#include "trace/render.h"
#include "command/stats.h"

enum { MAX_OPERANDS = 16 };

/* What a walkthrough can be printed as; the words are in option_table.c. */
typedef enum WalkthroughFormat { WALKTHROUGH_TEXT, WALKTHROUGH_JSON, WALKTHROUGH_OBJ, WALKTHROUGH_SVG } WalkthroughFormat;

/* Whether each pixel gets the whole grid, or only where it needs it. */
typedef enum SamplingChoice { SAMPLING_OF_SCENE, SAMPLING_UNIFORM, SAMPLING_ADAPTIVE } SamplingChoice;

/* What the user asked for. The strings are those of argv. */
typedef struct Options {
    const char *operands[MAX_OPERANDS]; /* scenes, the pictures to compare, a kind of scene */
    int operand_count;
    const char *output; /* NULL: not given; "-": stdout */
    const char *rays;   /* NULL or "-": stdin */
    const char *folder;  /* for the files of a measurement; NULL: not given */
    const char *heatmap; /* NULL: not given; "-": stdout */
    Backend backend;
    RenderSettings settings;
    int columns, rows; /* 0: as the scene says, as is grid */
    int grid;
    SamplingChoice sampling;
    const char *second_value; /* of an option that takes two, while it is read */
    const char *map_file;     /* NULL: no map */
    MapKind map;
    int bounces;          /* -1: as the scene says */
    int tolerance;        /* of 255 */
    int repeats;          /* of a measurement; 0: not given */
    int scene_size, seed; /* of a generated scene; size 0: not given */
    int pixel_column, pixel_row, sample_i, sample_j; /* of the walkthrough */
    WalkthroughFormat format;
    StatsFormat stats;
    ProgressMode progress;
    bool precision_given, pixel_given;
    bool quiet, geometry, verbose, with_scene, ladder, json, help, version;
} Options;

typedef struct Option {
    const char *name;     /* without the "--" */
    char letter;          /* 0: none */
    const char *argument; /* as help shows it; NULL: none; "[=NAME]": may be left out; "KIND FILE": two words */
    const char *commands; /* the commands that take it, separated by blanks; "": all */
    bool (*set)(Options *options,
                const char *value); /* false: not a proper value; the value is NULL where none was given */
    const char *expects;            /* completes "expected ..." in the message about a wrong value */
    const char *help;
} Option;

extern const Option option_table[]; /* ends in a NULL name */

/* Whether the command takes the option. */
bool option_belongs(const Option *option, const char *command);

#endif

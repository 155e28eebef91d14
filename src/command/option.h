/* What a user may ask for: the values of all options, and what an option is. */
#ifndef RECTRAY_OPTION_H
#define RECTRAY_OPTION_H

#include "command/progress.h"
#include "command/stats.h"
#include "picture/image_format.h"
#include "trace/render.h"
#include "walkthrough/walkthrough_formats.h"

/* Of commands that take several; `join` takes as many parts as a picture has rows. */
enum { MAX_OPERANDS = 16, MAX_PARTS = 16384 };

/* Whether each pixel gets the whole grid, or only where it needs it. */
typedef enum SamplingChoice { SAMPLING_OF_SCENE, SAMPLING_UNIFORM, SAMPLING_ADAPTIVE } SamplingChoice;

/* Colours in text: on a terminal that wants them, or not asking. */
typedef enum ColourChoice { COLOUR_AUTO, COLOUR_ALWAYS, COLOUR_NEVER } ColourChoice;

/* What `help` prints: text for people, a manual page, or a script for a shell. */
typedef enum HelpFormat { HELP_TEXT, HELP_MAN, HELP_BASH, HELP_ZSH, HELP_FISH } HelpFormat;

enum { TRACE_PIXELS_MAX = 16, MAPS_MAX = 16, EDITS_MAX = 64 };

/* A change of the scene file's text. */
typedef struct OptionEdit {
    const char *option; /* its name */
    const char *value;  /* as the user wrote it */
} OptionEdit;

typedef struct OptionMap {
    MapKind kind;
    const char *file;
} OptionMap;

/* Part `number` of `count`, from 1. */
typedef struct OptionPart {
    int number, count;
} OptionPart;

typedef struct TracePixel {
    int column, row;
} TracePixel;

/* What the user asked for. The strings are those of argv. */
typedef struct Options {
    const char *const *operands; /* scenes, the pictures to compare, a kind of scene */
    int operand_count;
    const char *output;        /* NULL: not given; "-": stdout */
    const char *rays;          /* NULL or "-": stdin */
    const char *export_folder; /* for the kernel files; NULL: not given */
    const char *folder;        /* for the files of a measurement; NULL: not given */
    const char *heatmap;       /* NULL: not given; "-": stdout */
    const char *picture;       /* to grade; NULL: not given */
    Backend backend;
    RenderSettings settings;
    int columns, rows; /* 0: as the scene says, as is grid */
    int grid;
    SamplingChoice sampling;
    const char *second_value; /* of an option that takes two, while it is read */
    OptionEdit edits[EDITS_MAX];
    int edit_count;
    int frame;                   /* of the scene's animation */
    int first_frame, last_frame; /* to render; last -1: to the end */
    OptionPart part;             /* count 0: not given */
    OptionMap maps[MAPS_MAX];
    int map_count;
    bool mark_given;
    int mark_column, mark_row;
    double map_low, map_high;                        /* of its colours; 0: not given */
    int bounces;                                     /* -1: as the scene says */
    int tolerance;                                   /* of 255 */
    double tolerance_absolute, tolerance_relative;   /* of grading */
    int repeats;                                     /* of a measurement; 0: not given */
    int scene_size, seed;                            /* of a generated scene; size 0: not given */
    int pixel_column, pixel_row, sample_i, sample_j; /* of the walkthrough */
    TracePixel pixels[TRACE_PIXELS_MAX];             /* all that were given, the last of them above, too */
    int pixel_count;
    const char *face;  /* a pixel that shows it is looked for; NULL: not given */
    int blocked_light; /* and where this light is blocked; -1: not given */
    int mirrors;       /* and whose path has so many mirrors; 0: not given */
    WalkthroughFormat format;
    ColourChoice colour;
    int width; /* of lines of text; 0: not given */
    int steps; /* of the building of a tree; 0: not given */
    StatsFormat stats;
    int picture_format; /* an ImageFormat; -1: as the ending of the file says */
    int depth;          /* place in 8, 16: bits a channel of a picture */
    ProgressMode progress;
    HelpFormat help_format;
    bool precision_given, pixel_given, shift_given, tolerance_given, frame_given, frames_given;
    bool quiet, resume, stage, watch, geometry, verbose, with_scene, summary, diff, darkest, no_pager, ladder, json,
        check, open, strict, help, version;
} Options;

/* How an option's value is read. */
typedef enum OptionKind {
    OPTION_FLAG,   /* none: a bool becomes true */
    OPTION_TEXT,   /* any word that is not empty */
    OPTION_NUMBER, /* a whole number from low to high, into an int */
    OPTION_WORD,   /* one of the words; its place in their list, into an int or an enum */
    OPTION_OWN,    /* by a function of its own */
} OptionKind;

typedef struct Option {
    const char *name;     /* without the "--" */
    char letter;          /* 0: none */
    const char *argument; /* as help shows it; NULL: none; "[=NAME]": may be left out; "KIND FILE": two words */
    const char *commands; /* the commands that take it, separated by blanks; "": all */
    const char *help;
    OptionKind kind;
    int field; /* the byte of Options where it begins, of all kinds but the last */
    int low, high;
    const char *const *words;                         /* ends in a NULL */
    bool (*set)(Options *options, const char *value); /* false: not a proper value; NULL: none was given */
    const char *expects; /* completes "expected ..." in the message about a wrong value; NULL: the kind says it */
} Option;

/* Whether the command takes the option. */
bool option_belongs(const Option *option, const char *command);

/* Reads the value, which is NULL where none was given. After false, which says that it is not a proper one, the field
 * may hold anything. */
bool option_set(const Option *option, Options *options, const char *value);

/* A piece of text, passed by value. */
typedef struct OptionText {
    char text[160];
} OptionText;

/* What the option expects: "a whole number from 1 to 16", "text or json". */
OptionText option_expects(const Option *option);

/* Reads a whole number in [low, high] that ends at the character `end`: digits, nothing before or after. Returns where
 * it ended, or NULL. */
const char *option_read_int(const char *text, int low, int high, char end, int *value);

/* The place of a word in a list that ends in NULL; -1 where it is not there. */
int option_word(const char *word, const char *const *words);

#endif

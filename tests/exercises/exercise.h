/* What the tests of an exercise are written in. A test states its input, asks the student's function and ours, and
 * compares the two outcomes. At the first difference the program ends; `run` reads its report and tells the student.
 * How to add an exercise: README.md. */
#ifndef EXERCISE_H
#define EXERCISE_H

#include "trace/textbook.h"

enum {
    EXERCISE_VALUES = 24, /* of an outcome */
    EXERCISE_TEXT = 400,  /* bytes of a text */
    EXERCISE_PASSED = 0,  /* exit statuses */
    EXERCISE_FAILED = 1,
    EXERCISE_BROKEN = 3, /* the exercise itself: a scene that cannot be read */
};

typedef struct ExerciseTest {
    const char *name, *title; /* for scripts, and for the student */
    void (*run)(void);
} ExerciseTest;

/* As textbook_pixel, with the student's function in it. */
typedef Vec3 ExercisePixel(const Textbook *textbook, int column, int row, unsigned char rgb[3]);

typedef struct Exercise {
    const ExerciseTest *tests; /* in order; the last has a NULL for a name */
    ExercisePixel *pixel;      /* NULL: there is no picture */
    const char *scene;         /* of the picture */
    int columns, rows;         /* of the picture; 0: the scene's */
    ExercisePixel *ours;       /* what the picture is compared with; NULL: textbook_pixel */
} Exercise;

/* Runs the tests, then compares the pictures and writes both. argv: the report's path, the picture's path. */
int exercise_main(int argc, char **argv, const Exercise *exercise);

/* --- Before the student's function is called: a crash then tells the input --- */

/* A line of the input. */
void given(const char *name, const char *format, ...) __attribute__((format(printf, 2, 3)));

/* The pixel that shows what is tested. */
void shown_at(const char *scene, int column, int row);

/* The same, with further options of the command that traces it. */
void shown_with(const char *scene, int column, int row, const char *options);

/* --- What came out --- */

typedef enum ValueKind { VALUE_NUMBER, VALUE_INTEGER, VALUE_TRUTH } ValueKind;

typedef struct Value {
    char name[60];
    ValueKind kind;
    double value;
    char formula[EXERCISE_TEXT]; /* with the numbers in it; "" for none */
} Value;

/* All that a function gave back, in the order in which it is to be compared. */
typedef struct Outcome {
    int count;
    Value values[EXERCISE_VALUES];
} Outcome;

void add_number(Outcome *outcome, const char *name, double value);
void add_integer(Outcome *outcome, const char *name, int value);
void add_truth(Outcome *outcome, const char *name, bool value);
void add_vector(Outcome *outcome, const char *name, Vec3 value); /* three numbers: NAME.x, NAME.y, NAME.z */

/* The formula of the value that was added last; a vector's three values share it. */
void add_formula(Outcome *outcome, const char *format, ...) __attribute__((format(printf, 2, 3)));

/* What comes out when a likely slip is made. It is told where all that was returned equals it. Where several slips
 * explain it, the inputs before and after tell them apart. Give the same texts for each input. */
void slip(const Outcome *outcome, const char *format, ...) __attribute__((format(printf, 2, 3)));

/* The test fails where they differ: relative 1e-9, absolute 1e-12. Forgets the slips and the input. */
void compare(const Outcome *returned, const Outcome *expected);

/* --- Texts: they live until 32 more have been made --- */

const char *number_text(double value);
const char *exact_text(double value);
const char *vector_text(Vec3 value);

/* --- Scenes --- */

/* Loaded at the first call, and kept. A scene that cannot be read ends the program. */
const Scene *scene_of(const char *path);

#endif

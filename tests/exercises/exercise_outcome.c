/* Outcomes of functions, their differences, and the slips that explain them. */
#include "exercises/exercise.h"

#include "exercises/exercise_report.h"

#include <math.h>
#include <stdarg.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/resource.h>
#include <time.h>

enum { SLIPS = 24, SECONDS = 2 };

typedef struct Slip {
    Outcome outcome;
    char text[EXERCISE_TEXT];
} Slip;

static Slip slips[SLIPS];
static int slip_count;

typedef struct Texts {
    int count;
    char text[SLIPS][EXERCISE_TEXT];
} Texts;

/* Slips that were not made: an earlier input would have shown them. And, after a failure, those that may have been made
 * while the other inputs are tried in silence. */
static Texts refuted, suspected;

/* --- Outcomes --- */

static void add(Outcome *outcome, const char *name, ValueKind kind, double value)
{
    if (outcome->count == EXERCISE_VALUES)
        report_broken("too many values in an outcome");
    Value *added = &outcome->values[outcome->count++];
    *added = (Value){.kind = kind, .value = value};
    snprintf(added->name, sizeof added->name, "%s", name);
}

void add_number(Outcome *outcome, const char *name, double value)
{
    add(outcome, name, VALUE_NUMBER, value);
}

void add_integer(Outcome *outcome, const char *name, int value)
{
    add(outcome, name, VALUE_INTEGER, value);
}

void add_truth(Outcome *outcome, const char *name, bool value)
{
    add(outcome, name, VALUE_TRUTH, value);
}

void add_vector(Outcome *outcome, const char *name, Vec3 value)
{
    char component[60];
    for (int axis = 0; axis < 3; axis++) {
        snprintf(component, sizeof component, "%s.%c", name, "xyz"[axis]);
        add(outcome, component, VALUE_NUMBER, vec3_component(value, axis));
    }
}

/* A vector's name without its axis: how many bytes. */
static size_t stem_of(const Value *value)
{
    size_t length = strlen(value->name);
    return length > 2 && value->name[length - 2] == '.' && strchr("xyz", value->name[length - 1]) ? length - 2 : length;
}

void add_formula(Outcome *outcome, const char *format, ...)
{
    va_list values;
    va_start(values, format);
    Value *last = &outcome->values[outcome->count - 1];
    vsnprintf(last->formula, sizeof last->formula, format, values);
    va_end(values);
    size_t stem = stem_of(last);
    for (Value *other = last - 1; stem < strlen(last->name) && other >= outcome->values && last - other < 3; other--)
        if (stem_of(other) == stem && strncmp(other->name, last->name, stem) == 0)
            memcpy(other->formula, last->formula, sizeof other->formula);
}

void slip(const Outcome *outcome, const char *format, ...)
{
    if (slip_count == SLIPS)
        report_broken("too many slips");
    Slip *added = &slips[slip_count++];
    added->outcome = *outcome;
    va_list values;
    va_start(values, format);
    vsnprintf(added->text, sizeof added->text, format, values);
    va_end(values);
}

static bool same_value(const Value *a, const Value *b)
{
    if (isnan(a->value) || isnan(b->value))
        return isnan(a->value) && isnan(b->value);
    if (isinf(a->value) || isinf(b->value)) /* or its distance would be within any part of it */
        return a->value == b->value;
    return fabs(a->value - b->value) <= 1e-12 + 1e-9 * fmax(fabs(a->value), fabs(b->value));
}

/* The first value that differs; -1: none does. */
static int first_difference(const Outcome *a, const Outcome *b)
{
    for (int k = 0; k < a->count; k++)
        if (!same_value(&a->values[k], &b->values[k]))
            return k;
    return -1;
}

static bool has_text(const Texts *texts, const char *text)
{
    for (int k = 0; k < texts->count; k++)
        if (strcmp(texts->text[k], text) == 0)
            return true;
    return false;
}

static void add_text(Texts *texts, const char *text)
{
    if (texts->count < SLIPS && !has_text(texts, text))
        strcpy(texts->text[texts->count++], text);
}

/* Does a slip of that text, made with this input, give this outcome? */
static bool slip_gives(const char *text, const Outcome *outcome)
{
    for (int s = 0; s < slip_count; s++)
        if (strcmp(slips[s].text, text) == 0 && first_difference(outcome, &slips[s].outcome) < 0)
            return true;
    return false;
}

/* The student was right: the slips that would have shown were not made. */
static void refute_slips(const Outcome *right)
{
    for (int s = 0; s < slip_count; s++)
        if (!slip_gives(slips[s].text, right))
            add_text(&refuted, slips[s].text);
}

/* Which slips explain the outcome of the failure? */
static void suspect_slips(const Outcome *returned)
{
    for (int s = 0; s < slip_count; s++)
        if (slip_gives(slips[s].text, returned) && !has_text(&refuted, slips[s].text))
            add_text(&suspected, slips[s].text);
}

/* Of those, the ones that explain this outcome, too. All stay where none does. */
static void narrow_slips(const Outcome *returned)
{
    Texts left = {0};
    for (int k = 0; k < suspected.count; k++)
        if (slip_gives(suspected.text[k], returned))
            add_text(&left, suspected.text[k]);
    if (left.count > 0)
        suspected = left;
}

void exercise_tell_slips(const char *key)
{
    for (int k = 0; k < suspected.count; k++)
        report_line(key, "%s", suspected.text[k]);
}

static const char *value_text(const Value *value, const char *nothing)
{
    if (value->kind == VALUE_TRUTH)
        return value->value != 0 ? "true" : "false";
    return isnan(value->value) ? nothing : number_text(value->value);
}

static void tell_difference(const Outcome *returned, const Outcome *expected, int k)
{
    report_line("value", "%s", expected->values[k].name);
    const char *came = value_text(&returned->values[k], "nothing: it was not filled in");
    const char *wanted = value_text(&expected->values[k], "nothing: it is not to be filled in");
    bool alike = strcmp(came, wanted) == 0;
    report_line("returned", "%s", alike ? exact_text(returned->values[k].value) : came);
    report_line("expected", "%s", alike ? exact_text(expected->values[k].value) : wanted);
    if (expected->values[k].formula[0])
        report_line("formula", "%s", expected->values[k].formula);
}

void compare(const Outcome *returned, const Outcome *expected)
{
    int k = first_difference(returned, expected);
    if (report_failed)
        narrow_slips(returned);
    else if (k < 0) {
        refute_slips(expected);
        report_line("forget", "input");
    } else {
        tell_difference(returned, expected, k);
        suspect_slips(returned);
        exercise_tell_slips("slip");
        if (suspected.count < 2)
            exit(EXERCISE_FAILED);
        report_failed = true; /* more inputs tell the slips apart, but not for long */
        rlim_t used = (rlim_t)(clock() / CLOCKS_PER_SEC);
        setrlimit(RLIMIT_CPU, &(struct rlimit){used + SECONDS, used + SECONDS + 1});
    }
    slip_count = 0;
}

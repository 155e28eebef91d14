/* Setting numbers, vectors and lines of text the way a textbook does: six significant digits, columns that align,
 * lines that end before the last column, and colour where a terminal shows it. */
#ifndef RECTRAY_INK_H
#define RECTRAY_INK_H

#include "base/vec3.h"

#include <stdbool.h>
#include <stdio.h>

enum { INK_COLUMNS = 100, INK_LEAST_COLUMNS = 80, INK_MOST_COLUMNS = 160, INK_DIGITS = 6 };

/* Colours as ANSI escape sequences: none; of the 256 that every terminal knows; all. */
typedef enum InkColour { INK_PLAIN, INK_256, INK_TRUE } InkColour;

typedef struct Ink {
    FILE *out;
    InkColour colour;
    int columns; /* of a line, INK_LEAST_COLUMNS to INK_MOST_COLUMNS */
} Ink;

/* A piece of text, passed by value. */
typedef struct InkText {
    char text[224];
} InkText;

/* Whether the stream is a terminal on which colour is welcome: NO_COLOR is unset or empty, TERM is not "dumb". */
bool ink_wants_colour(FILE *out);

/* The colours of the terminal: all where COLORTERM says "truecolor" or "24bit". */
InkColour ink_terminal_colour(void);

/* printf into an InkText; what does not fit is cut off. */
InkText ink_text(const char *format, ...)
#ifdef __GNUC__
    __attribute__((format(printf, 1, 2)))
#endif
    ;

/* "0.5", never "-0"; digits is the number of significant ones. */
InkText ink_number(double x, int digits);

/* "(1, 0.5, -2)". */
InkText ink_vector(Vec3 v, int digits);

/* A name for a text or a terminal: at most `columns` characters, none of them for control, in UTF-8. */
InkText ink_name(const char *name, int columns);

/* Prints a line, printf-like. Where it would pass the last column it is broken at a tab, and goes on under the first
 * " = " before all tabs, or a little indented where there is none; other tabs are blanks. What is too long between two
 * tabs is broken at a blank. */
void ink_line(const Ink *ink, const char *format, ...)
#ifdef __GNUC__
    __attribute__((format(printf, 2, 3)))
#endif
    ;

/* Prints a paragraph, printf-like, broken at blanks; every line is indented like the first. */
void ink_paragraph(const Ink *ink, const char *format, ...)
#ifdef __GNUC__
    __attribute__((format(printf, 2, 3)))
#endif
    ;

/* Prints a paragraph whose lines after the first are indented by so many columns. */
void ink_hanging(const Ink *ink, int columns, const char *format, ...)
#ifdef __GNUC__
    __attribute__((format(printf, 3, 4)))
#endif
    ;

/* An empty line, then a line in bold, then an empty line. */
void ink_heading(const Ink *ink, const char *format, ...)
#ifdef __GNUC__
    __attribute__((format(printf, 2, 3)))
#endif
    ;

/* A line of a table of vectors. */
typedef struct InkRow {
    InkText label, note; /* before and after the vector */
    Vec3 v;
    int digits;
} InkRow;

InkRow ink_row(InkText label, Vec3 v);

/* Prints vectors below one another, their components in columns. */
void ink_rows(const Ink *ink, const InkRow *rows, int count);

/* The sequence that begins a colour, "" where there are none: '+' is green, '-' red, 'b' bold, any other ends them. */
const char *ink_colour(const Ink *ink, char which);

/* "+", "-" or "0", in its colour. */
InkText ink_sign(const Ink *ink, int sign);

/* So many blanks on the colour of three bytes; "" where there are no colours. */
InkText ink_swatch(const Ink *ink, const unsigned char *rgb, int columns);

/* Characters on the paper: neither bytes that continue one of UTF-8 nor escape sequences. */
int ink_width(const char *text);
int ink_columns(const char *text, size_t length); /* of the first bytes */

#endif

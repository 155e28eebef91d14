/* Lines, paragraphs and tables of vectors, set the way a textbook does. */
#include "walkthrough/ink.h"

#include <stdarg.h>
#include <string.h>

/* A line that is being printed. */
typedef struct Line {
    const Ink *ink;
    int hang; /* where it goes on when it is broken */
    int used; /* columns, 0 at the beginning */
    int held; /* blanks among them that are not printed yet: none may end a line */
} Line;

/* Prints a part that is not broken, after a blank or, without its own blanks, on a line of its own. */
static void print_part(Line *line, const char *part, size_t length, bool blank)
{
    if (line->used > 0 && line->used + blank + ink_columns(part, length) > line->ink->columns) {
        fputc('\n', line->ink->out);
        line->used = line->held = line->hang;
        blank = false;
        for (; length > 1 && part[0] == ' '; length--)
            part++;
    }
    line->used += blank + ink_columns(part, length);
    line->held += blank;
    size_t end = length;
    while (end > 0 && part[end - 1] == ' ')
        end--;
    if (end > 0)
        fprintf(line->ink->out, "%*s%.*s", line->held, "", (int)end, part);
    line->held = (int)(length - end) + (end > 0 ? 0 : line->held);
}

/* Prints what stands between two tabs; where it is too long for a line of its own, word by word. */
static void print_piece(Line *line, const char *piece, size_t length)
{
    bool blank = line->used > 0;
    if ((blank ? line->hang : 0) + ink_columns(piece, length) <= line->ink->columns) {
        print_part(line, piece, length, blank);
        return;
    }
    for (const char *at = piece, *end = piece + length; at < end;) {
        size_t indent = strspn(at, " "), word = indent + strcspn(at + indent, " \t");
        word = word < (size_t)(end - at) ? word : (size_t)(end - at);
        print_part(line, at, word, blank);
        blank = false;
        at += word;
    }
}

void ink_line(const Ink *ink, const char *format, ...)
{
    char text[1024];
    va_list arguments;
    va_start(arguments, format);
    vsnprintf(text, sizeof text, format, arguments);
    va_end(arguments);

    while (text[0] == '\n') {
        fputc('\n', ink->out);
        memmove(text, text + 1, strlen(text));
    }
    const char *equals = strstr(text, " = "), *tab = strchr(text, '\t');
    if (tab && equals > tab)
        equals = NULL;
    int indent = (int)strspn(text, " ");
    Line line = {.ink = ink, .hang = equals ? ink_columns(text, (size_t)(equals - text)) + 1 : indent + 3};
    if (line.hang > ink->columns / 2)
        line.hang = indent + 5;
    for (const char *at = text; *at;) {
        size_t length = strcspn(at, "\t");
        print_piece(&line, at, length);
        at += length + (at[length] == '\t');
    }
    fputc('\n', ink->out);
}

/* Prints words, the first line indented as they begin, the others by `hang`; -1: the same. What stands before that
 * column stays as it is. */
static void print_words(const Ink *ink, const char *text, int hang)
{
    int indent = (int)strspn(text, " ");
    Line line = {.ink = ink, .hang = hang < 0 ? indent : hang};
    const char *word = text + (hang < 0 ? indent : hang);
    line.used = fprintf(ink->out, "%.*s", (int)(word - text), text);
    for (bool blank = false; *word; blank = true) {
        size_t length = strcspn(word, " ");
        print_part(&line, word, length, blank);
        word += length + strspn(word + length, " ");
    }
    fputc('\n', ink->out);
}

void ink_paragraph(const Ink *ink, const char *format, ...)
{
    char text[1024];
    va_list arguments;
    va_start(arguments, format);
    vsnprintf(text, sizeof text, format, arguments);
    va_end(arguments);
    print_words(ink, text, -1);
}

void ink_hanging(const Ink *ink, int columns, const char *format, ...)
{
    char text[1024];
    va_list arguments;
    va_start(arguments, format);
    vsnprintf(text, sizeof text, format, arguments);
    va_end(arguments);
    print_words(ink, text, columns);
}

void ink_heading(const Ink *ink, const char *format, ...)
{
    fprintf(ink->out, "\n%s", ink_colour(ink, 'b'));
    va_list arguments;
    va_start(arguments, format);
    vfprintf(ink->out, format, arguments);
    va_end(arguments);
    fprintf(ink->out, "%s\n\n", ink_colour(ink, '0'));
}

/* --- Tables of vectors --- */

typedef struct RowTexts {
    InkText component[3];
} RowTexts;

static RowTexts texts_of(const InkRow *row)
{
    return (RowTexts){
        {ink_number(row->v.x, row->digits), ink_number(row->v.y, row->digits), ink_number(row->v.z, row->digits)}};
}

static int wider(int width, const char *text)
{
    int columns = ink_width(text);
    return columns > width ? columns : width;
}

InkRow ink_row(InkText label, Vec3 v)
{
    return (InkRow){.label = label, .v = v, .digits = INK_DIGITS};
}

void ink_rows(const Ink *ink, const InkRow *rows, int count)
{
    int label = 0, component[3] = {0};
    for (int i = 0; i < count; i++) {
        RowTexts texts = texts_of(&rows[i]);
        label = wider(label, rows[i].label.text);
        for (int k = 0; k < 3; k++)
            component[k] = wider(component[k], texts.component[k].text);
    }
    for (int i = 0; i < count; i++) {
        RowTexts texts = texts_of(&rows[i]);
        int pad = label - ink_width(rows[i].label.text);
        const char *note = rows[i].note.text;
        ink_line(ink, "    %s%*s  (%*s, %*s, %*s)%s%s", rows[i].label.text, pad, "", component[0],
                 texts.component[0].text, component[1], texts.component[1].text, component[2], texts.component[2].text,
                 note[0] ? "\t " : "", note);
    }
}

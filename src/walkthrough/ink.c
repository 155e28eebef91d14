/* Setting numbers, vectors and lines of text the way a textbook does. */
#include "walkthrough/ink.h"

#include "base/text.h"

#include <stdarg.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

bool ink_wants_colour(FILE *out)
{
    const char *no_color = getenv("NO_COLOR"), *term = getenv("TERM");
    return !(no_color && no_color[0]) && !(term && strcmp(term, "dumb") == 0) && isatty(fileno(out));
}

const char *ink_colour(const Ink *ink, char which)
{
    if (!ink->colour)
        return "";
    switch (which) {
    case '+':
        return "\033[32m";
    case '-':
        return "\033[31m";
    case 'b':
        return "\033[1m";
    default:
        return "\033[0m";
    }
}

InkText ink_text(const char *format, ...)
{
    InkText text;
    va_list arguments;
    va_start(arguments, format);
    vsnprintf(text.text, sizeof text.text, format, arguments);
    va_end(arguments);
    return text;
}

InkText ink_number(double x, int digits)
{
    return ink_text("%.*g", digits, x == 0 ? 0.0 : x);
}

InkText ink_vector(Vec3 v, int digits)
{
    return ink_text("(%s, %s, %s)", ink_number(v.x, digits).text, ink_number(v.y, digits).text,
                    ink_number(v.z, digits).text);
}

/* The bytes of the first `columns` characters of UTF-8. */
static size_t prefix_of(const char *text, int columns)
{
    size_t length = 0;
    while (text[length] && (columns > 0 || ((unsigned char)text[length] & 0xC0) == 0x80))
        columns -= ((unsigned char)text[length++] & 0xC0) != 0x80;
    while (((unsigned char)text[length] & 0xC0) == 0x80)
        length++;
    return length;
}

InkText ink_name(const char *name, int columns)
{
    size_t length = prefix_of(name, columns);
    InkText text = name[length] ? ink_text("%.*s...", (int)prefix_of(name, columns - 3), name) : ink_text("%s", name);
    text_make_utf8(text.text);
    for (char *c = text.text; *c; c++)
        if ((unsigned char)*c < 0x20 || *c == 0x7F)
            *c = '?';
    return text;
}

/* --- Lines --- */

/* Characters on the paper: bytes that neither continue one of UTF-8 nor belong to an escape sequence. */
static int columns_of(const char *text, size_t length)
{
    int columns = 0;
    for (size_t i = 0; i < length; i++) {
        if (text[i] == '\033')
            while (i < length && text[i] != 'm')
                i++;
        else
            columns += ((unsigned char)text[i] & 0xC0) != 0x80;
    }
    return columns;
}

void ink_line(const Ink *ink, const char *format, ...)
{
    char line[1024];
    va_list arguments;
    va_start(arguments, format);
    vsnprintf(line, sizeof line, format, arguments);
    va_end(arguments);

    const char *equals = strstr(line, " = "), *tab = strchr(line, '\t');
    if (tab && equals > tab)
        equals = NULL;
    int indent = (int)strspn(line, " ");
    int hang = equals ? columns_of(line, (size_t)(equals - line)) : indent + 2;
    if (hang > INK_COLUMNS / 2)
        hang = indent + 4;
    int used = 0;
    for (const char *at = line; *at;) {
        size_t length = strcspn(at, "\t");
        int columns = columns_of(at, length);
        if (used > 0 && used + 1 + columns > INK_COLUMNS) {
            fputc('\n', ink->out);
            used = 0;
        }
        /* A continuation that begins with a blank brings its own. */
        used += used > 0 ? fprintf(ink->out, " ") : at > line ? fprintf(ink->out, "%*s", hang + 1, "") : 0;
        fprintf(ink->out, "%.*s", (int)length, at);
        used += columns;
        at += length + (at[length] == '\t');
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

    int indent = (int)strspn(text, " "), used = 0;
    for (const char *word = text + indent; *word;) {
        size_t length = strcspn(word, " ");
        int columns = columns_of(word, length);
        if (used > 0 && used + 1 + columns > INK_COLUMNS) {
            fputc('\n', ink->out);
            used = 0;
        }
        used += columns + (used > 0 ? fprintf(ink->out, " ") : fprintf(ink->out, "%*s", indent, ""));
        fprintf(ink->out, "%.*s", (int)length, word);
        word += length + strspn(word + length, " ");
    }
    fputc('\n', ink->out);
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
    int columns = columns_of(text, strlen(text));
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
        int pad = label - columns_of(rows[i].label.text, strlen(rows[i].label.text));
        const char *note = rows[i].note.text;
        ink_line(ink, "    %s%*s  (%*s, %*s, %*s)%s%s", rows[i].label.text, pad, "", component[0],
                 texts.component[0].text, component[1], texts.component[1].text, component[2], texts.component[2].text,
                 note[0] ? "\t " : "", note);
    }
}

InkText ink_sign(const Ink *ink, int sign)
{
    const char *signs[] = {"-", "0", "+"};
    return ink_text("%s%s%s", ink_colour(ink, signs[sign + 1][0]), signs[sign + 1], ink_colour(ink, '.'));
}

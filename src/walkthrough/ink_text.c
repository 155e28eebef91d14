/* Numbers, vectors and names as pieces of text. */
#include "walkthrough/ink.h"

#include "base/text.h"

#include <stdarg.h>
#include <string.h>

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

int ink_columns(const char *text, size_t length)
{
    int columns = 0;
    for (size_t i = 0; i < length; i++) {
        if (text[i] == '\033')
            while (i < length && text[i] != 'm')
                i++;
        else
            columns += text[i] != '\n' && ((unsigned char)text[i] & 0xC0) != 0x80;
    }
    return columns;
}

int ink_width(const char *text)
{
    return ink_columns(text, strlen(text));
}

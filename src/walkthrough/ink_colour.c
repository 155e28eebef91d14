/* Colours in text: which a terminal shows, and the sequences that begin and end them. */
#include "walkthrough/ink.h"

#include <stdlib.h>
#include <string.h>
#include <unistd.h>

bool ink_wants_colour(FILE *out)
{
    const char *no_color = getenv("NO_COLOR"), *term = getenv("TERM");
    return !(no_color && no_color[0]) && !(term && strcmp(term, "dumb") == 0) && isatty(fileno(out));
}

InkColour ink_terminal_colour(void)
{
    const char *known = getenv("COLORTERM");
    bool all = known && (strcmp(known, "truecolor") == 0 || strcmp(known, "24bit") == 0);
    return all ? INK_TRUE : INK_256;
}

const char *ink_colour(const Ink *ink, char which)
{
    if (ink->colour == INK_PLAIN)
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

InkText ink_sign(const Ink *ink, int sign)
{
    const char *signs[] = {"-", "0", "+"};
    return ink_text("%s%s%s", ink_colour(ink, signs[sign + 1][0]), signs[sign + 1], ink_colour(ink, '.'));
}

/* A step of the 6 x 6 x 6 colours that begin at number 16. */
static int cube_step(unsigned char byte)
{
    return byte < 48 ? 0 : byte < 115 ? 1 : (byte - 35) / 40;
}

InkText ink_swatch(const Ink *ink, const unsigned char *rgb, int columns)
{
    if (ink->colour == INK_TRUE)
        return ink_text("\033[48;2;%d;%d;%dm%*s\033[0m", rgb[0], rgb[1], rgb[2], columns, "");
    if (ink->colour == INK_256)
        return ink_text("\033[48;5;%dm%*s\033[0m",
                        16 + 36 * cube_step(rgb[0]) + 6 * cube_step(rgb[1]) + cube_step(rgb[2]), columns, "");
    return ink_text("%s", "");
}

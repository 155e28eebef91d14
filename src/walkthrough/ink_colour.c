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

/* A step of the 6 x 6 x 6 colours that begin at number 16, and its byte: 0, 95, 135, ..., 255. */
static int cube_step(unsigned char byte)
{
    return byte < 48 ? 0 : byte < 115 ? 1 : (byte - 35) / 40;
}

static int cube_byte(int step)
{
    return step == 0 ? 0 : 55 + 40 * step;
}

static int square(int x)
{
    return x * x;
}

/* The nearest of the 256 colours: of the cube, or of the greys 8, 18, ..., 238 that begin at number 232. */
static int nearest_of_256(const unsigned char *rgb)
{
    int step[3], cube = 0, greys = 0, grey = ((rgb[0] + rgb[1] + rgb[2]) / 3 - 3) / 10;
    grey = grey < 0 ? 0 : grey > 23 ? 23 : grey;
    for (int k = 0; k < 3; k++) {
        step[k] = cube_step(rgb[k]);
        cube += square(cube_byte(step[k]) - rgb[k]);
        greys += square(8 + 10 * grey - rgb[k]);
    }
    return greys < cube ? 232 + grey : 16 + 36 * step[0] + 6 * step[1] + step[2];
}

InkText ink_swatch(const Ink *ink, const unsigned char *rgb, int columns)
{
    if (ink->colour == INK_TRUE)
        return ink_text("\033[48;2;%d;%d;%dm%*s\033[0m", rgb[0], rgb[1], rgb[2], columns, "");
    if (ink->colour == INK_256)
        return ink_text("\033[48;5;%dm%*s\033[0m", nearest_of_256(rgb), columns, "");
    return ink_text("%s", "");
}

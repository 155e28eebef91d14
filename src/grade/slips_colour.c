/* Slips of step 10: from a colour to three bytes. */
#include "grade/slip.h"

#include <stddef.h>

static void each(Vec3 colour, unsigned char rgb[3], unsigned char (*byte)(double c))
{
    rgb[0] = byte(colour.x);
    rgb[1] = byte(colour.y);
    rgb[2] = byte(colour.z);
}

/* As C makes a byte of a whole number that is too large. */
static unsigned char wrapped(double c)
{
    double whole = floor(255 * c + 0.5);
    return (unsigned char)(whole - 256 * floor(whole / 256));
}

static unsigned char cut_off(double c)
{
    return (unsigned char)floor(255 * fmin(fmax(c, 0), 1));
}

static unsigned char times_256(double c)
{
    return (unsigned char)fmin(255, floor(256 * fmin(fmax(c, 0), 1)));
}

static unsigned char gamma_applied(double c)
{
    return colour_to_byte(pow(fmin(fmax(c, 0), 1), 1 / 2.2));
}

static unsigned char root(double c)
{
    return colour_to_byte(sqrt(fmin(fmax(c, 0), 1)));
}

static unsigned char srgb(double c)
{
    c = fmin(fmax(c, 0), 1);
    return colour_to_byte(c <= 0.0031308 ? 12.92 * c : 1.055 * pow(c, 1 / 2.4) - 0.055);
}

static unsigned char tone_mapped(double c)
{
    return colour_to_byte(c / (1 + c));
}

static void bytes_wrapped(Vec3 colour, unsigned char rgb[3])
{
    each(colour, rgb, wrapped);
}

static void bytes_cut_off(Vec3 colour, unsigned char rgb[3])
{
    each(colour, rgb, cut_off);
}

static void bytes_times_256(Vec3 colour, unsigned char rgb[3])
{
    each(colour, rgb, times_256);
}

static void bytes_with_gamma(Vec3 colour, unsigned char rgb[3])
{
    each(colour, rgb, gamma_applied);
}

static void bytes_with_root(Vec3 colour, unsigned char rgb[3])
{
    each(colour, rgb, root);
}

static void bytes_in_srgb(Vec3 colour, unsigned char rgb[3])
{
    each(colour, rgb, srgb);
}

static void bytes_tone_mapped(Vec3 colour, unsigned char rgb[3])
{
    each(colour, rgb, tone_mapped);
}

static void blue_first(Vec3 colour, unsigned char rgb[3])
{
    each(vec3(colour.z, colour.y, colour.x), rgb, colour_to_byte);
}

/* As if the colour had been divided by the largest of its parts. */
static void hue_kept(Vec3 colour, unsigned char rgb[3])
{
    double largest = fmax(1, fmax(colour.x, fmax(colour.y, colour.z)));
    each(vec3_scale(1 / largest, colour), rgb, colour_to_byte);
}

static Vec3 sum_for_mean(Vec3 sum, int samples)
{
    (void)samples;
    return sum;
}

#define READ "algorithm.md#10-colour"
#define BYTE "floor(255 c + 0.5), c clamped to [0, 1]"

const Slip slip_colour[] = {
    {"not-clamped", "Colours above 1 are not clamped: the byte runs over and begins again at 0.", BYTE,
     "floor(255 c + 0.5) modulo 256", READ, .steps = {.bytes = bytes_wrapped}},
    {"gamma", "The bytes have a gamma of 2.2; in the text the numbers are stored as they are.", BYTE, "c^(1/2.2) first",
     READ, .steps = {.bytes = bytes_with_gamma}},
    {"gamma-root", "The bytes have a gamma of 2; in the text the numbers are stored as they are.", BYTE,
     "sqrt(c) first", READ, .steps = {.bytes = bytes_with_root}},
    {"srgb", "The bytes have the curve of sRGB; in the text the numbers are stored as they are.", BYTE,
     "the curve of sRGB first", READ, .steps = {.bytes = bytes_in_srgb}},
    {"tone-mapped", "The colours are compressed to c/(1 + c); in the text they are clamped.", BYTE, "c/(1 + c) first",
     READ, .steps = {.bytes = bytes_tone_mapped}},
    {"hue-kept", "A colour above 1 is divided by its largest part; in the text each part is clamped.", BYTE,
     "c over the largest part first", READ, .steps = {.bytes = hue_kept}},
    {"bytes-cut-off", "The bytes are cut off, not rounded.", BYTE, "floor(255 c)", READ,
     .steps = {.bytes = bytes_cut_off}},
    {"times-256", "The colour is multiplied by 256.", BYTE, "floor(256 c), at most 255", READ,
     .steps = {.bytes = bytes_times_256}},
    {"blue-first", "Red and blue are exchanged.", "red, green, blue", "blue, green, red", READ,
     .steps = {.bytes = blue_first}},
    {"sum-for-mean", "The samples of a pixel are added up, but not divided by their number.", "the mean of the samples",
     "their sum", READ, .steps = {.average = sum_for_mean}},
    {"colours-to-255", "Colours are given from 0 to 255 instead of 0 to 1.", "1 is full strength",
     "255 is full strength", READ, .unit = 255},
    {"bytes-to-1", "The bytes are given from 0 to 1 instead of 0 to 255.", BYTE, "c", READ, .byte_unit = 1 / 255.0},
    {0},
};

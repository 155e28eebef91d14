/* Numbers as colours. On the helix, brightness runs along the grey diagonal of the colour cube while the hue turns
 * about it; red, green and blue weigh in brightness as 0.30, 0.59 and 0.11, and the turn keeps that sum. */
#include "picture/heat.h"

#include <math.h>

#define START 2.6     /* the hue at black: 1 red, 2 green, 3 blue */
#define ROTATIONS 0.7 /* turns from black to white */
#define HUE 1.4       /* saturation */

static const double LEAST_HEAT = 0.25;

static unsigned char to_byte(double c)
{
    c = fmin(fmax(c, 0), 1);
    return (unsigned char)floor(255 * c + 0.5);
}

void heat_colour(double heat, unsigned char *rgb)
{
    const double pi = 3.14159265358979323846;
    double angle = 2 * pi * (START / 3 + 1 + ROTATIONS * heat), amplitude = HUE * heat * (1 - heat) / 2;
    double c = amplitude * cos(angle), s = amplitude * sin(angle);
    rgb[0] = to_byte(heat - 0.14861 * c + 1.78277 * s);
    rgb[1] = to_byte(heat - 0.29227 * c - 0.90649 * s);
    rgb[2] = to_byte(heat + 1.97294 * c);
}

double heat_of_difference(int difference)
{
    return difference <= 0 ? 0 : LEAST_HEAT + (1 - LEAST_HEAT) * log(difference) / log(255);
}

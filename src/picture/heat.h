/* Numbers as colours, for pictures that show where something is large. */
#ifndef RECTRAY_HEAT_H
#define RECTRAY_HEAT_H

/* From black (0) through violet, pink and orange to white (1), each as bright as its
 * number: the "cubehelix" of Green, "A colour scheme for the display of astronomical
 * intensity images" (2011). `heat` in [0, 1]; rgb receives three bytes. */
void heat_colour(double heat, unsigned char *rgb);

/* The heat of a difference of 0 to 255: 0 for none, and 1/4 to 1 by its logarithm, so that the least shows. */
double heat_of_difference(int difference);

#endif

/* Illumination: what one light adds at one point, after Blinn (1977) with the project's alpha/4. */
#ifndef RECTRAY_LIGHT_H
#define RECTRAY_LIGHT_H

#include "scene/scene.h"

/* The three terms and the factors they were made of. */
typedef struct Illumination {
    Vec3 ambient;            /* ka ia */
    Vec3 diffuse;            /* kd id (L.N) */
    Vec3 specular;           /* ks is (N.H)^(alpha/4) */
    Vec3 h;                  /* H = (L + V) / |L + V|; zero where L = -V */
    double l_dot_n, n_dot_h; /* clamped at 0 */
} Illumination;

/* What the light adds at a point. n: its unit normal on the viewer's side; l, v: the unit vectors from it to the light
 * and to the viewer. */
Illumination illuminate(const Material *material, const Light *light, Vec3 n, Vec3 l, Vec3 v);

bool colour_is_black(Vec3 colour);

/* Clamps to [0, 1] and gives floor(255 c + 0.5). */
unsigned char colour_to_byte(double c);

#endif

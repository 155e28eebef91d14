/* What happens between the queries: surfaces, light, mirrors, sixteen lanes at a time. The loops over lanes are plain
 * enough for the compiler to make vectors of them; nothing in them branches. */
#ifndef RECTRAY_PEER_SHADE_H
#define RECTRAY_PEER_SHADE_H

#include "peer_query.h"

typedef struct Vec16 {
    float x[WIDTH], y[WIDTH], z[WIDTH];
} __attribute__((aligned(64))) Vec16;

/* Three floats, uniform over the lanes. */
typedef struct Vec1 {
    float x, y, z;
} Vec1;

typedef struct Surface {
    Vec16 point, normal, shifted, viewer, unit; /* unit: of the ray that arrived */
    int material[WIDTH];
} __attribute__((aligned(64))) Surface;

typedef struct LightRow {
    Vec1 position, ambient, diffuse, specular;
} LightRow;

Vec1 vec1(Vec3 a);

/* Fills the surface under each lane's hit; lanes without a hit get something finite. */
void surface_fill(const PeerScene *peer, Vec1 eye, const struct RTCRayHit16 *ray, const int *hit, Surface *surface);

/* Makes the shadow rays of the lanes that face the light: facing = on & N.L > 0. Returns how many. */
int shadow_rays(const Surface *surface, Vec1 light, bool from_light, const int *on, int *facing, struct RTCRay16 *rays);

/* Adds weight * illumination; reaching = where the light arrives; ambient_too = where its ambient term counts. */
void illuminate16(const PeerScene *peer, const Surface *surface, const LightRow *light, const int *reaching,
                  const int *ambient_too, const float *weight, Vec16 *colour);

/* Turns the rays into reflected ones on those lanes that go on, and scales their weights. Returns how many. */
int reflect16(const PeerScene *peer, const Surface *surface, int *on, float *weight, struct RTCRayHit16 *ray);

#endif

/* A scene as Embree wants it, beside ours: the peer that our speed is measured against (embree.c). The faces are ours
 * to the bit: quads from the float32 vertices, a triangle as a quad whose last two vertices are one. */
#ifndef RECTRAY_PEER_SCENE_H
#define RECTRAY_PEER_SCENE_H

#include "scene/scene.h"

#include <embree3/rtcore.h>

/* One value per material, so that sixteen lanes gather it at once. */
typedef struct MaterialTable {
    float *ambient[3], *diffuse[3], *specular[3], *exponent, *reflection;
    int *shiny;  /* -1: the material has a highlight */
    bool shines; /* some material has one */
    bool mirrors;
} MaterialTable;

typedef struct PeerScene {
    const Scene *scene; /* borrowed */
    RTCDevice device;
    RTCScene rtc;
    unsigned both_sided; /* faces of geometry 0; those of geometry 1 are seen from the front only */
    int *material_of;    /* by face: geometry 0's, then geometry 1's */
    float *table;        /* owns the rows of `materials` */
    MaterialTable materials;
    double build_ms; /* Embree's, high quality */
    long long bytes; /* that Embree holds */
} PeerScene;

/* What a ray query tells the filter of one-sided faces: the sign is -1 where rays run from the light to the point. */
typedef struct QueryContext {
    struct RTCIntersectContext rtc; /* the first member: Embree hands on a pointer to it */
    float sign;
} QueryContext;

bool peer_scene_build(PeerScene *peer, const Scene *scene, Error *error);
void peer_scene_free(PeerScene *peer);

#endif

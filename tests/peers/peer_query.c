/* Rays lie in memory as Embree's structs of sixteen, which are arrays of floats, field after field; the smaller modes
 * copy lanes out of them and back by place. */
#include "peer_query.h"

#include <math.h>
#include <stddef.h>
#include <string.h>

const QueryMode query_modes[] = {
    {"packets of 16, coherent", 16, true},
    {"packets of 16", 16, false},
    {"packets of 8, coherent", 8, true},
    {"packets of 8", 8, false},
    {"stream of 64, coherent", 64, true},
    {"stream of 64", 64, false},
    {"single rays", 1, false},
    {0},
};

enum {
    RAY_WORDS = sizeof(struct RTCRay16) / sizeof(float) / WIDTH,     /* fields of a ray */
    BOTH_WORDS = sizeof(struct RTCRayHit16) / sizeof(float) / WIDTH, /* and of its hit */
};

static QueryContext context_of(const QueryMode *mode, float sign)
{
    QueryContext context;
    rtcInitIntersectContext(&context.rtc);
    context.rtc.flags = mode->coherent ? RTC_INTERSECT_CONTEXT_FLAG_COHERENT : RTC_INTERSECT_CONTEXT_FLAG_INCOHERENT;
    context.sign = sign;
    return context;
}

static bool any(const int *on)
{
    int sum = 0;
    for (int i = 0; i < WIDTH; i++)
        sum |= on[i];
    return sum != 0;
}

/* Copies `width` lanes from place `first` of `words` fields of sixteen, or back. */
static void take_lanes(float *narrow, const float *wide, int words, int width, int first)
{
    for (int k = 0; k < words; k++)
        memcpy(narrow + k * width, wide + k * WIDTH + first, (size_t)width * sizeof(float));
}

static void put_lanes(const float *narrow, float *wide, int words, int width, int first)
{
    for (int k = 0; k < words; k++)
        memcpy(wide + k * WIDTH + first, narrow + k * width, (size_t)width * sizeof(float));
}

/* A stream has no list of lanes: a ray with tfar < tnear asks nothing. */
static void retire(const int *on, float *tfar)
{
    for (int i = 0; i < WIDTH; i++)
        tfar[i] = on[i] ? tfar[i] : -1.0f;
}

static struct RTCRay single_ray(const struct RTCRay16 *r, int i)
{
    return (struct RTCRay){.org_x = r->org_x[i],
                           .org_y = r->org_y[i],
                           .org_z = r->org_z[i],
                           .tnear = r->tnear[i],
                           .dir_x = r->dir_x[i],
                           .dir_y = r->dir_y[i],
                           .dir_z = r->dir_z[i],
                           .tfar = r->tfar[i],
                           .mask = r->mask[i]};
}

/* --- Nearest --- */

static void nearest_single(RTCScene scene, QueryContext *context, const int *on, struct RTCRayHit16 *rays)
{
    for (int i = 0; i < WIDTH; i++) {
        if (!on[i])
            continue;
        struct RTCRayHit one = {.ray = single_ray(&rays->ray, i)};
        one.hit.geomID = one.hit.instID[0] = RTC_INVALID_GEOMETRY_ID;
        rtcIntersect1(scene, &context->rtc, &one);
        rays->ray.tfar[i] = one.ray.tfar;
        rays->hit.Ng_x[i] = one.hit.Ng_x, rays->hit.Ng_y[i] = one.hit.Ng_y, rays->hit.Ng_z[i] = one.hit.Ng_z;
        rays->hit.primID[i] = one.hit.primID, rays->hit.geomID[i] = one.hit.geomID;
    }
}

static void nearest_eights(RTCScene scene, QueryContext *context, const int *on, struct RTCRayHit16 *rays)
{
    for (int first = 0; first < WIDTH; first += 8) {
        struct RTCRayHit8 half;
        take_lanes((float *)&half, (const float *)rays, BOTH_WORDS, 8, first);
        rtcIntersect8(on + first, scene, &context->rtc, &half);
        put_lanes((const float *)&half, (float *)rays, BOTH_WORDS, 8, first);
    }
}

void query_nearest(const PeerScene *peer, const QueryMode *mode, const Lanes *lanes, struct RTCRayHit16 *rays)
{
    QueryContext context = context_of(mode, 1);
    if (mode->width == 64) {
        for (int p = 0; p < PACKETS; p++)
            retire(lanes->on[p], rays[p].ray.tfar);
        rtcIntersectNM(peer->rtc, &context.rtc, (struct RTCRayHitN *)rays, WIDTH, PACKETS, sizeof *rays);
        return;
    }
    for (int p = 0; p < PACKETS; p++) {
        const int *on = lanes->on[p];
        if (!any(on))
            continue;
        if (mode->width == 16)
            rtcIntersect16(on, peer->rtc, &context.rtc, &rays[p]);
        else if (mode->width == 8)
            nearest_eights(peer->rtc, &context, on, &rays[p]);
        else
            nearest_single(peer->rtc, &context, on, &rays[p]);
    }
}

/* --- Occluded --- */

static void occluded_single(RTCScene scene, QueryContext *context, const int *on, struct RTCRay16 *rays)
{
    for (int i = 0; i < WIDTH; i++) {
        if (!on[i])
            continue;
        struct RTCRay ray = single_ray(rays, i);
        rtcOccluded1(scene, &context->rtc, &ray);
        rays->tfar[i] = ray.tfar;
    }
}

static void occluded_eights(RTCScene scene, QueryContext *context, const int *on, struct RTCRay16 *rays)
{
    for (int first = 0; first < WIDTH; first += 8) {
        struct RTCRay8 half;
        take_lanes((float *)&half, (const float *)rays, RAY_WORDS, 8, first);
        rtcOccluded8(on + first, scene, &context->rtc, &half);
        memcpy(rays->tfar + first, half.tfar, sizeof half.tfar);
    }
}

void query_occluded(const PeerScene *peer, const QueryMode *mode, float sign, const Lanes *lanes, struct RTCRay16 *rays)
{
    QueryContext context = context_of(mode, sign);
    if (mode->width == 64) {
        for (int p = 0; p < PACKETS; p++)
            retire(lanes->on[p], rays[p].tfar);
        rtcOccludedNM(peer->rtc, &context.rtc, (struct RTCRayN *)rays, WIDTH, PACKETS, sizeof *rays);
        return;
    }
    for (int p = 0; p < PACKETS; p++) {
        const int *on = lanes->on[p];
        if (!any(on))
            continue;
        if (mode->width == 16)
            rtcOccluded16(on, peer->rtc, &context.rtc, &rays[p]);
        else if (mode->width == 8)
            occluded_eights(peer->rtc, &context, on, &rays[p]);
        else
            occluded_single(peer->rtc, &context, on, &rays[p]);
    }
}

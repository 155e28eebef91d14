/* Curves through keys, by Lagrange's formula for parabolas. */
#include "reader/scene_curve.h"

#include <assert.h>

/* Adds `part` of the parabola through keys i, i + 1, i + 2. */
static void add_parabola(CurveShares *shares, const CurveKey *keys, int i, double frame, double part)
{
    for (int k = i; k < i + 3; k++) {
        double share = part;
        for (int other = i; other < i + 3; other++)
            if (other != k)
                share *= (frame - keys[other].frame) / (keys[k].frame - keys[other].frame);
        shares->share[k - shares->first] += share;
    }
}

/* The stretch from key i to the next one. */
static CurveShares smooth_shares(const CurveKey *keys, int count, int i, double frame)
{
    double part = (frame - keys[i].frame) / (keys[i + 1].frame - keys[i].frame);
    int before = i > 0 ? i - 1 : i, after = i + 2 < count ? i : i - 1;
    CurveShares shares = {.first = before, .count = after + 3 - before};
    add_parabola(&shares, keys, before, frame, 1 - part);
    add_parabola(&shares, keys, after, frame, part);
    return shares;
}

CurveShares scene_curve_shares(const CurveKey *keys, int count, double frame)
{
    int i = 0;
    assert(count >= 1);
    while (i < count && keys[i].frame <= frame)
        i++;
    i--; /* the last key that is reached */
    if (i < 0 || i == count - 1 || keys[i].frame == frame)
        return (CurveShares){i < 0 ? 0 : i, 1, {1}};
    if (keys[i].smooth && count > 2)
        return smooth_shares(keys, count, i, frame);
    double part = (frame - keys[i].frame) / (keys[i + 1].frame - keys[i].frame);
    return (CurveShares){i, 2, {1 - part, part}};
}

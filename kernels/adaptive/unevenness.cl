/* How unevenly a light shines within a pixel: a bound of how far the mean of the pixel may be from the value at its
 * centre. docs/bounds.md, section 12, derives it. */
#include "shared/compiler.cl"
#include "shared/precision.cl"
#include "packet/lanes.cl"
#include "packet/vectors.cl"
#include "adaptive/beam.cl"
#include "adaptive/point.cl"

#define WIDEST ((real)0.25f) /* a direction that turns by more than this within a pixel is not followed */

INLINE Lanes curved(Lanes square) { return REAL(0.35) * square; }

INLINE Lanes power_bound(Lanes x, real power)
{
    Lanes y = power * (1 - x);
    Lanes sum = 1 + y * (1 + y * ((real)0.5f + y * ((real)1 / 6 + y * ((real)1 / 24))));
    return y > (Lanes)0 ? 1 / sum : (Lanes)1;
}

static Lanes power_uneven(Lanes x, real k, Lanes off, Lanes change)
{
    Lanes high = x + change < (Lanes)1 ? x + change : (Lanes)1, low = x - change;
    if (k == 0)
        return (Lanes)0;
    Lanes uneven;
    if (k >= 2)
        uneven = power_bound(high, k - 2) * k * (off + REAL(0.2) * (k - 1) * change * change);
    else
        uneven = low > (Lanes)0 ? (2 * off + (real)0.5f * change * change / low) / low : (Lanes)1;
    return high <= (Lanes)0 ? (Lanes)0 : uneven;
}

INLINE Vec vec_point(Point p) { return vec((Lanes)(real)p.x, (Lanes)(real)p.y, (Lanes)(real)p.z); }

INLINE real point_length(Point p) { return (real)sqrt(point_dot(p, p)); }

INLINE real beam_square(const Beam *b) { return (real)(point_dot(b->u, b->u) + point_dot(b->v, b->v)); }

static Lanes unevenness(real diffuse, real specular, real exponent, Vec normal, const Beam *to_light,
                        const Beam *to_viewer, int packet)
{
    Vec l = to_light->lanes[packet].real_c, v = to_viewer->lanes[packet].real_c;
    Lanes l_length = sqrt(vec_dot(l, l)), v_length = sqrt(vec_dot(v, v));
    Lanes l_turn = (point_length(to_light->u) + point_length(to_light->v)) / l_length;
    Lanes v_turn = (point_length(to_viewer->u) + point_length(to_viewer->v)) / v_length;
    Mask follow = IS(l_turn <= (Lanes)WIDEST) & IS(v_turn <= (Lanes)WIDEST);
    Lanes l_square = beam_square(to_light) / (l_length * l_length),
          v_square = beam_square(to_viewer) / (v_length * v_length);
    Lanes uneven = diffuse * curved(l_square);
    if (specular == 0)
        return follow ? uneven : (Lanes)(diffuse + specular);

    Vec sum = vec_add(vec_scale(1 / l_length, l), vec_scale(1 / v_length, v));
    Lanes length = sqrt(vec_dot(sum, sum)), h_turn = (l_turn / (1 - l_turn) + v_turn / (1 - v_turn)) / length;
    Mask follow_h = IS(h_turn <= (Lanes)WIDEST);
    Lanes n_dot_h = -vec_dot(normal, sum) / length, square = 1 - n_dot_h * n_dot_h,
          angle = REAL(1.1) * h_turn / (1 - h_turn);
    Lanes change = sqrt(square > (Lanes)0 ? square : (Lanes)0) * angle + (real)0.5f * angle * angle;
    Lanes off = (real)4 / 3 * (curved(l_square) + curved(v_square)) / length +
                (real)1.25f * (l_square + v_square) / (length * length);
    Lanes highlight = uneven + specular * power_uneven(n_dot_h, exponent, off, change);
    highlight = follow_h ? highlight : uneven + specular;
    return follow ? highlight : (Lanes)(diffuse + specular);
}

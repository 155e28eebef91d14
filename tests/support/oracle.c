/* The exact oracle. Numbers become integers by one common power of two for all points and one for the direction; both
 * are positive factors, which no sign depends on. */
#include "oracle.h"

#include <float.h>
#include <gmp.h>
#include <limits.h>
#include <math.h>

bool oracle_integers_only = false;

typedef mpz_t Integers[3]; /* a vector */

/* One query: origin, direction and the vertices of up to two faces, as integers, and room to work in. */
static struct {
    Integers origin, direction, vertices[2][4];
    Integers corners[4], diagonals[2], from_vertex;
    mpz_t product, sum, first, second, numerator[2], denominator[2];
    int point_exponent, direction_exponent; /* number = integer 2^exponent */
    bool ready;
} work;

static void vector_each(void (*act)(mpz_t), Integers vector)
{
    for (int i = 0; i < 3; i++)
        act(vector[i]);
}

static void init_one(mpz_t x)
{
    mpz_init(x);
}
static void clear_one(mpz_t x)
{
    mpz_clear(x);
}

static void work_each(void (*act)(mpz_t))
{
    vector_each(act, work.origin);
    vector_each(act, work.direction);
    vector_each(act, work.from_vertex);
    for (int k = 0; k < 4; k++) {
        vector_each(act, work.vertices[0][k]);
        vector_each(act, work.vertices[1][k]);
        vector_each(act, work.corners[k]);
    }
    for (int i = 0; i < 2; i++) {
        vector_each(act, work.diagonals[i]);
        act(work.numerator[i]);
        act(work.denominator[i]);
    }
    act(work.product);
    act(work.sum);
    act(work.first);
    act(work.second);
}

void oracle_free(void)
{
    if (work.ready)
        work_each(clear_one);
    work.ready = false;
}

/* --- Doubles as integers --- */

static int lowest_exponent(int lowest, const double *numbers, int count)
{
    for (int i = 0; i < count; i++) {
        int exponent;
        frexp(numbers[i], &exponent);
        if (numbers[i] != 0 && exponent - 53 < lowest)
            lowest = exponent - 53;
    }
    return lowest;
}

static void set_integers(Integers out, const double numbers[3], int unit)
{
    for (int i = 0; i < 3; i++) {
        int exponent;
        double fraction = frexp(numbers[i], &exponent);
        mpz_set_d(out[i], ldexp(fraction, 53));
        if (fraction != 0)
            mpz_mul_2exp(out[i], out[i], (mp_bitcnt_t)(exponent - 53 - unit));
    }
}

/* direction: NULL where the query has none. */
static void load(const float a[4][3], const float b[4][3], const double origin[3], const double *direction)
{
    if (!work.ready)
        work_each(init_one);
    work.ready = true;
    double points[2][4][3];
    for (int k = 0; k < 4; k++)
        for (int i = 0; i < 3; i++) {
            points[0][k][i] = (double)a[k][i];
            points[1][k][i] = (double)b[k][i];
        }
    int unit = lowest_exponent(lowest_exponent(INT_MAX, &points[0][0][0], 24), origin, 3);
    work.point_exponent = unit == INT_MAX ? 0 : unit;
    set_integers(work.origin, origin, unit);
    for (int k = 0; k < 4; k++) {
        set_integers(work.vertices[0][k], points[0][k], unit);
        set_integers(work.vertices[1][k], points[1][k], unit);
    }
    if (direction) {
        unit = lowest_exponent(INT_MAX, direction, 3);
        work.direction_exponent = unit == INT_MAX ? 0 : unit;
        set_integers(work.direction, direction, unit);
    }
}

/* --- Determinants of integers --- */

static void subtract(Integers out, Integers a, Integers b)
{
    for (int i = 0; i < 3; i++)
        mpz_sub(out[i], a[i], b[i]);
}

/* a . (b x c), by the first row. */
static void determinant(mpz_t out, Integers a, Integers b, Integers c)
{
    mpz_set_ui(work.sum, 0);
    for (int i = 0; i < 3; i++) {
        int j = (i + 1) % 3, k = (i + 2) % 3;
        mpz_mul(work.product, b[j], c[k]);
        mpz_submul(work.product, b[k], c[j]);
        mpz_addmul(work.sum, a[i], work.product);
    }
    mpz_set(out, work.sum);
}

/* With the face's normal M = (v2 - v0) x (v3 - v1): numerator M.(O - v0), denominator M.R, t = -numerator /
 * denominator. */
static void plane_terms(int face)
{
    Integers *v = work.vertices[face];
    subtract(work.diagonals[0], v[2], v[0]);
    subtract(work.diagonals[1], v[3], v[1]);
    subtract(work.from_vertex, work.origin, v[0]);
    determinant(work.numerator[face], work.from_vertex, work.diagonals[0], work.diagonals[1]);
    determinant(work.denominator[face], work.direction, work.diagonals[0], work.diagonals[1]);
}

/* +1, -1: the ray passes all edges on that side; 0: it does not. */
static int side_of_edges(void)
{
    int lowest = 1, highest = -1;
    for (int k = 0; k < 4; k++)
        subtract(work.corners[k], work.vertices[0][k], work.origin);
    for (int k = 0; k < 4; k++) {
        determinant(work.first, work.direction, work.corners[k], work.corners[(k + 1) % 4]);
        int sign = mpz_sgn(work.first);
        lowest = sign < lowest ? sign : lowest;
        highest = sign > highest ? sign : highest;
    }
    return lowest >= 0 ? highest : highest <= 0 ? lowest : 0;
}

/* --- The short cut --- */

enum { UNSURE = 2 };

/* The sign of det(a, b, c) where it is plain. Each entry carries at most one rounding, each product of three at most
 * 7. */
static int plain_sign(const long double a[3], const long double b[3], const long double c[3])
{
    long double value = 0, magnitude = 0;
    for (int i = 0; i < 3; i++) {
        int j = (i + 1) % 3, k = (i + 2) % 3;
        value += a[i] * (b[j] * c[k] - b[k] * c[j]);
        magnitude += fabsl(a[i]) * (fabsl(b[j] * c[k]) + fabsl(b[k] * c[j]));
    }
    if (oracle_integers_only || !(fabsl(value) > 32 * LDBL_EPSILON * magnitude))
        return UNSURE;
    return value > 0 ? 1 : -1;
}

static void corner_from(long double out[3], const float vertex[3], const double origin[3])
{
    for (int i = 0; i < 3; i++)
        out[i] = (long double)vertex[i] - (long double)origin[i];
}

/* The side on which the ray passes all edges, 0 where two edges see it on different sides, or UNSURE. A triangle's
 * fourth edge has no length and no side. */
static int plain_side_of_edges(const float face[4][3], const double origin[3], const long double direction[3])
{
    long double corners[4][3];
    int left = 0, right = 0, edges = 0;
    for (int k = 0; k < 4; k++)
        corner_from(corners[k], face[k], origin);
    for (int k = 0; k < 4; k++) {
        const float *a = face[k], *b = face[(k + 1) % 4];
        if (a[0] == b[0] && a[1] == b[1] && a[2] == b[2])
            continue;
        int sign = plain_sign(direction, corners[k], corners[(k + 1) % 4]);
        left += sign == 1;
        right += sign == -1;
        edges++;
    }
    if (left && right)
        return 0;
    return left == edges ? 1 : right == edges ? -1 : UNSURE;
}

/* --- Answers --- */

bool oracle_hits(const float face[4][3], const double ray[6])
{
    const long double direction[3] = {(long double)ray[3], (long double)ray[4], (long double)ray[5]};
    int heading = plain_side_of_edges(face, ray, direction);
    if (heading == UNSURE) {
        load(face, face, ray, ray + 3);
        heading = side_of_edges();
    }
    /* The four volumes add up to M.R, so that the edges know its sign. */
    return heading != 0 && oracle_side(face, ray) * heading < 0;
}

int oracle_order(const float a[4][3], const float b[4][3], const double ray[6])
{
    load(a, b, ray, ray + 3);
    plane_terms(0);
    plane_terms(1);
    mpz_mul(work.first, work.numerator[1], work.denominator[0]);
    mpz_submul(work.first, work.numerator[0], work.denominator[1]);
    return mpz_sgn(work.first) * mpz_sgn(work.denominator[0]) * mpz_sgn(work.denominator[1]);
}

int oracle_side(const float face[4][3], const double point[3])
{
    long double x[3], a[3], b[3];
    corner_from(x, face[0], point);
    for (int i = 0; i < 3; i++) {
        x[i] = -x[i];
        a[i] = (long double)face[2][i] - (long double)face[0][i];
        b[i] = (long double)face[3][i] - (long double)face[1][i];
    }
    int sign = plain_sign(x, a, b);
    if (sign != UNSURE)
        return sign;
    load(face, face, point, NULL);
    for (int i = 0; i < 3; i++)
        mpz_set_ui(work.direction[i], 0);
    plane_terms(0);
    return mpz_sgn(work.numerator[0]);
}

int oracle_heading(const float face[4][3], const double ray[6])
{
    load(face, face, ray, ray + 3);
    plane_terms(0);
    return mpz_sgn(work.denominator[0]);
}

bool oracle_blocks(const float face[4][3], const double from[3], const double to[3])
{
    long double direction[3];
    for (int i = 0; i < 3; i++)
        direction[i] = (long double)to[i] - (long double)from[i];
    int heading = plain_side_of_edges(face, from, direction);
    if (heading == 0 || oracle_side(face, from) * oracle_side(face, to) >= 0)
        return false;
    if (heading != UNSURE)
        return true;
    /* The difference of two doubles need not be one: it is taken of the integers. */
    load(face, face, from, to);
    int unit = work.point_exponent < work.direction_exponent ? work.point_exponent : work.direction_exponent;
    for (int i = 0; i < 3; i++) {
        mpz_mul_2exp(work.direction[i], work.direction[i], (mp_bitcnt_t)(work.direction_exponent - unit));
        mpz_mul_2exp(work.first, work.origin[i], (mp_bitcnt_t)(work.point_exponent - unit));
        mpz_sub(work.direction[i], work.direction[i], work.first);
    }
    return side_of_edges() != 0;
}

static void exact_t(mpq_t out, const float face[4][3], const double ray[6])
{
    load(face, face, ray, ray + 3);
    plane_terms(0);
    mpq_set_num(out, work.numerator[0]);
    mpq_set_den(out, work.denominator[0]);
    mpq_canonicalize(out);
    mpq_neg(out, out);
    int exponent = work.point_exponent - work.direction_exponent;
    if (exponent >= 0)
        mpq_mul_2exp(out, out, (mp_bitcnt_t)exponent);
    else
        mpq_div_2exp(out, out, (mp_bitcnt_t)-exponent);
}

double oracle_t(const float face[4][3], const double ray[6])
{
    mpq_t exact;
    mpq_init(exact);
    exact_t(exact, face, ray);
    double t = mpq_get_d(exact);
    mpq_clear(exact);
    return t;
}

double oracle_t_error(const float face[4][3], const double ray[6], double t)
{
    mpq_t exact, given;
    mpq_inits(exact, given, NULL);
    exact_t(exact, face, ray);
    mpq_set_d(given, t);
    mpq_sub(given, given, exact);
    double error = mpq_get_d(given);
    mpq_clears(exact, given, NULL);
    return error;
}

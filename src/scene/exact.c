/* Arithmetic without rounding, by pairs and by expansions. An expansion is kept as doubles of growing magnitude that do
 * not overlap, so that its sign is the last one's. */
#include "scene/exact.h"

/* 6 products of three pairs, each product of three doubles being 4 doubles long. */
enum { MAX_TERMS = 6 * 8 * 4 };

typedef struct Expansion {
    double terms[MAX_TERMS]; /* increasing magnitude, none zero */
    int count;
} Expansion;

/* Adds one double (Shewchuk 1997, GROW-EXPANSION, theorem 10), leaving out zero terms. */
static void expansion_add(Expansion *e, double value)
{
    int kept = 0;
    for (int i = 0; i < e->count; i++) {
        Pair s = exact_sum(value, e->terms[i]);
        value = s.high;
        if (s.low != 0)
            e->terms[kept++] = s.low;
    }
    if (value != 0)
        e->terms[kept++] = value;
    e->count = kept;
}

static void expansion_add_product(Expansion *e, double a, double b, double c)
{
    if (a == 0 || b == 0 || c == 0)
        return;
    Pair ab = exact_product(a, b);
    Pair low = exact_product(ab.low, c), high = exact_product(ab.high, c);
    expansion_add(e, low.low);
    expansion_add(e, low.high);
    expansion_add(e, high.low);
    expansion_add(e, high.high);
}

/* Adds sign * a b c, each factor a pair. */
static void expansion_add_pairs(Expansion *e, double sign, Pair a, Pair b, Pair c)
{
    for (int i = 0; i < 8; i++)
        expansion_add_product(e, sign * (i & 1 ? a.high : a.low), i & 2 ? b.high : b.low, i & 4 ? c.high : c.low);
}

double exact_determinant(ExactVec3 a, ExactVec3 b, ExactVec3 c)
{
    Pair ax = {a.high.x, a.low.x}, ay = {a.high.y, a.low.y}, az = {a.high.z, a.low.z};
    Pair bx = {b.high.x, b.low.x}, by = {b.high.y, b.low.y}, bz = {b.high.z, b.low.z};
    Pair cx = {c.high.x, c.low.x}, cy = {c.high.y, c.low.y}, cz = {c.high.z, c.low.z};
    Expansion e = {.count = 0};
    expansion_add_pairs(&e, +1, ax, by, cz);
    expansion_add_pairs(&e, -1, ax, bz, cy);
    expansion_add_pairs(&e, +1, ay, bz, cx);
    expansion_add_pairs(&e, -1, ay, bx, cz);
    expansion_add_pairs(&e, +1, az, bx, cy);
    expansion_add_pairs(&e, -1, az, by, cx);
    double value = 0;
    for (int i = 0; i < e.count; i++)
        value += e.terms[i];
    return value;
}

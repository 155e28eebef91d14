/* The Menger sponge: each step cuts a cube into 27 and takes away the middle one and the six beside it. What is
 * written are the unit squares between a cell that stands and one that does not, one object for the hull and one
 * for the tunnels of each step, so that every step has its colour. */
#include "reader/generate.h"

#include <stdlib.h>
#include <string.h>

enum { SOLID = 255, PER_LINE = 8 };

typedef struct Sponge {
    int level, side;      /* side = 3^level cells */
    unsigned char *cells; /* (side + 2)^3, a layer of air around: the step that took the cell, 0 for the air */
    int *numbers;         /* (side + 1)^3, of the corners, within the object that is being written */
    int written;          /* faces of that object */
} Sponge;

/* The step that takes a cell away: the first in which two of its three ternary digits are 1. */
static unsigned char taken_by(int level, int side, int x, int y, int z)
{
    for (int step = 1; step <= level; step++) {
        side /= 3;
        if ((x / side % 3 == 1) + (y / side % 3 == 1) + (z / side % 3 == 1) >= 2)
            return (unsigned char)step;
    }
    return SOLID;
}

static unsigned char *cell(const Sponge *s, int x, int y, int z)
{
    size_t row = (size_t)s->side + 2;
    return s->cells + ((size_t)(z + 1) * row + (size_t)(y + 1)) * row + (size_t)(x + 1);
}

static int *number(const Sponge *s, const int corner[3])
{
    size_t row = (size_t)s->side + 1;
    return s->numbers + ((size_t)corner[2] * row + (size_t)corner[1]) * row + (size_t)corner[0];
}

static bool sponge_make(Sponge *s, int level, Error *error)
{
    *s = (Sponge){.level = level, .side = 1};
    for (int i = 0; i < level; i++)
        s->side *= 3;
    size_t cells = (size_t)s->side + 2, corners = (size_t)s->side + 1;
    s->cells = calloc(cells * cells * cells, 1);
    s->numbers = malloc(corners * corners * corners * sizeof *s->numbers);
    if (!s->cells || !s->numbers)
        return error_memory(error, "the sponge's cells");
    for (int z = 0; z < s->side; z++)
        for (int y = 0; y < s->side; y++)
            for (int x = 0; x < s->side; x++)
                *cell(s, x, y, z) = taken_by(level, s->side, x, y, z);
    return true;
}

typedef void (*CornersVisitor)(Sponge *s, int corners[4][3], FILE *out);

/* Visits the square on the side `direction` of `axis`, its corners wound outward. */
static void visit_square(Sponge *s, const int at[3], int axis, int direction, CornersVisitor visit, FILE *out)
{
    int u = (axis + 1) % 3, v = (axis + 2) % 3, corners[4][3];
    for (int k = 0; k < 4; k++) {
        int turn = direction > 0 ? k : 3 - k;
        memcpy(corners[k], at, sizeof corners[k]);
        corners[k][axis] += direction > 0;
        corners[k][u] += turn == 1 || turn == 2;
        corners[k][v] += turn == 2 || turn == 3;
    }
    visit(s, corners, out);
}

/* Visits all squares that a step's cutting laid bare; step 0 is the hull. */
static void visit_squares(Sponge *s, int step, CornersVisitor visit, FILE *out)
{
    for (int z = 0; z < s->side; z++)
        for (int y = 0; y < s->side; y++)
            for (int x = 0; x < s->side; x++) {
                if (*cell(s, x, y, z) != SOLID)
                    continue;
                for (int i = 0; i < 6; i++) {
                    int at[3] = {x, y, z}, beside[3] = {x, y, z}, direction = i % 2 ? 1 : -1;
                    beside[i / 2] += direction;
                    if (*cell(s, beside[0], beside[1], beside[2]) == step)
                        visit_square(s, at, i / 2, direction, visit, out);
                }
            }
}

static void mark_corners(Sponge *s, int corners[4][3], FILE *out)
{
    (void)out;
    for (int k = 0; k < 4; k++)
        *number(s, corners[k]) = 0;
}

static void write_square(Sponge *s, int corners[4][3], FILE *out)
{
    const char *before = s->written == 0 ? "" : s->written % PER_LINE ? ", " : ",\n        ";
    s->written++;
    fprintf(out, "%s[%d,%d,%d,%d]", before, *number(s, corners[0]), *number(s, corners[1]), *number(s, corners[2]),
            *number(s, corners[3]));
}

/* Numbers and writes the corners that mark_corners found. */
static void write_corners(Sponge *s, FILE *out)
{
    int count = 0, at[3];
    for (at[2] = 0; at[2] <= s->side; at[2]++)
        for (at[1] = 0; at[1] <= s->side; at[1]++)
            for (at[0] = 0; at[0] <= s->side; at[0]++) {
                int *mark = number(s, at);
                if (*mark < 0)
                    continue;
                const char *before = count == 0 ? "" : count % PER_LINE ? ", " : ",\n        ";
                fprintf(out, "%s[%d,%d,%d]", before, at[0], at[1], at[2]);
                *mark = count++;
            }
}

static void write_step(Sponge *s, int step, FILE *out)
{
    size_t corners = (size_t)s->side + 1;
    memset(s->numbers, -1, corners * corners * corners * sizeof *s->numbers);
    fprintf(out,
            "    {\n      \"name\": \"step %d\", \"material\": \"step%d\",\n"
            "      \"transform\": [ { \"translate\": [%.1f, %.1f, %.1f] }, { \"scale\": %.17g } ],\n"
            "      \"vertices\": [\n        ",
            step, step, -0.5 * s->side, -0.5 * s->side, -0.5 * s->side, 2.0 / s->side);
    visit_squares(s, step, mark_corners, out);
    write_corners(s, out);
    fputs("\n      ],\n      \"faces\": [\n        ", out);
    s->written = 0;
    visit_squares(s, step, write_square, out);
    fprintf(out, "\n      ]\n    }%s\n", step < s->level ? "," : "");
}

bool generate_menger(FILE *out, int level, uint64_t seed, Error *error)
{
    (void)seed; /* there is nothing left to chance in it */
    Sponge sponge;
    bool made = sponge_make(&sponge, level, error);
    if (made) {
        fputs("  \"camera\": { \"position\": [2.3, 1.75, 3.1], \"look_at\": [0, -0.14, 0] },\n"
              "  \"screen\": { \"columns\": 1920, \"rows\": 1080, \"distance\": 1.4 },\n"
              "  \"lights\": [ { \"position\": [2.5, 5.5, 6] } ],\n"
              "  \"shading\": { \"shadow\": \"ambient\", \"background\": [0.1, 0.12, 0.16] },\n"
              "  \"materials\": {\n"
              "    \"step0\": { \"ambient\": [0.19, 0.17, 0.15], \"diffuse\": [0.75, 0.7, 0.62] },\n"
              "    \"step1\": { \"ambient\": [0.24, 0.1, 0.03], \"diffuse\": [0.85, 0.42, 0.14] },\n"
              "    \"step2\": { \"ambient\": [0.22, 0.14, 0.04], \"diffuse\": [0.85, 0.62, 0.2] },\n"
              "    \"step3\": { \"ambient\": [0.08, 0.14, 0.16], \"diffuse\": [0.3, 0.55, 0.6] },\n"
              "    \"step4\": { \"ambient\": [0.1, 0.1, 0.17], \"diffuse\": [0.4, 0.4, 0.65] },\n"
              "    \"step5\": { \"ambient\": [0.12, 0.15, 0.1], \"diffuse\": [0.45, 0.55, 0.4] }\n"
              "  },\n  \"objects\": [\n",
              out);
        for (int step = 0; step <= level; step++)
            write_step(&sponge, step, out);
        fputs("  ]\n}\n", out);
    }
    free(sponge.cells);
    free(sponge.numbers);
    return made;
}

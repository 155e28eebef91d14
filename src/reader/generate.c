/* The kinds of scenes that can be generated, and two of their writers: a city of boxes and a sheet of quads. Both
 * are lists of short lines that go out as they are made, so that no size needs memory. */
#include "reader/generate.h"

#include "base/suggest.h"

#include <math.h>
#include <string.h>

const GenerateKind scene_kinds[] = {
    {"menger", 5, "steps of the Menger sponge, 1 to 5", generate_menger},
    {"city", 2000000, "boxes, 1 to 2000000", generate_city},
    {"grid", 1000, "quads along a side, 1 to 1000", generate_grid},
    {0},
};

const GenerateKind *generate_find_kind(const char *name, Error *error)
{
    const char *names[sizeof scene_kinds / sizeof *scene_kinds] = {0};
    for (int i = 0; scene_kinds[i].name; i++) {
        if (strcmp(scene_kinds[i].name, name) == 0)
            return &scene_kinds[i];
        names[i] = scene_kinds[i].name;
    }
    const char *nearest = suggest_word(name, names);
    if (nearest)
        error_set(error, ERROR_USAGE, "there is no kind of scene '%s'; did you mean '%s'?", name, nearest);
    else
        error_set(error, ERROR_USAGE, "there is no kind of scene '%s': menger, city and grid are known", name);
    return NULL;
}

bool generate_scene(const GenerateKind *kind, FILE *out, int size, uint64_t seed, Error *error)
{
    fprintf(out, "{\n  \"//\": \"rectray generate %s --size %d --seed %llu\",\n", kind->name, size,
            (unsigned long long)seed);
    return kind->write(out, size, seed, error);
}

/* SplitMix64 (Steele, Lea, Flood 2014): small, and good from any seed on. */
static uint64_t next_random(uint64_t *state)
{
    uint64_t z = *state += 0x9e3779b97f4a7c15u;
    z = (z ^ (z >> 30)) * 0xbf58476d1ce4e5b9u;
    z = (z ^ (z >> 27)) * 0x94d049bb133111ebu;
    return z ^ (z >> 31);
}

/* Uniform in [0, 1). */
static double next_unit(uint64_t *state)
{
    return (double)(next_random(state) >> 11) * 0x1p-53;
}

/* --- The city --- */

enum { HILLS = 4, WALLS = 6, DISTRICT = 8 };

typedef struct City {
    int side;      /* plots along a side */
    double extent; /* of the whole, streets included; a plot is 1 wide */
    double hill[HILLS][2];
    uint64_t random, seed;
} City;

/* Where a plot begins: a street runs after every fourth. */
static double plot_start(int index)
{
    int streets = index / 4;
    return index + 0.7 * streets;
}

static void write_city_head(FILE *out, const City *city)
{
    double e = city->extent;
    fprintf(out,
            "  \"camera\": { \"position\": [%.4f, %.4f, %.4f], \"look_at\": [%.4f, 0, %.4f] },\n"
            "  \"screen\": { \"columns\": 1920, \"rows\": 1080, \"distance\": 1.6 },\n"
            "  \"lights\": [ { \"position\": [%.4f, %.4f, %.4f] } ],\n",
            -0.42 * e, 0.42 * e, 0.95 * e, 0.02 * e, 0.08 * e, -1.1 * e, 0.9 * e, -0.1 * e);
    fputs("  \"shading\": { \"shadow\": \"ambient\", \"background\": [0.62, 0.74, 0.88] },\n"
          "  \"materials\": {\n"
          "    \"ground\": { \"ambient\": [0.17, 0.18, 0.2], \"diffuse\": [0.4, 0.41, 0.42] },\n"
          "    \"wall0\": { \"ambient\": [0.26, 0.22, 0.2], \"diffuse\": [0.68, 0.6, 0.5] },\n"
          "    \"wall1\": { \"ambient\": [0.24, 0.16, 0.14], \"diffuse\": [0.66, 0.37, 0.27] },\n"
          "    \"wall2\": { \"ambient\": [0.27, 0.27, 0.28], \"diffuse\": [0.68, 0.68, 0.66] },\n"
          "    \"wall3\": { \"ambient\": [0.25, 0.23, 0.17], \"diffuse\": [0.72, 0.62, 0.4] },\n"
          "    \"wall4\": { \"ambient\": [0.16, 0.2, 0.26], \"diffuse\": [0.3, 0.42, 0.55], \"specular\": [0.4, 0.4, "
          "0.4],"
          " \"shininess\": 80 },\n"
          "    \"wall5\": { \"ambient\": [0.2, 0.24, 0.22], \"diffuse\": [0.45, 0.56, 0.5] }\n"
          "  },\n",
          out);
    fprintf(out,
            "  \"objects\": [\n    { \"name\": \"floor\", \"material\": \"ground\", \"box\": "
            "{ \"min\": [%.4f, -0.5, %.4f], \"max\": [%.4f, 0, %.4f] } }",
            -9 * e, -9 * e, 9 * e, 9 * e);
}

/* Houses are low nearly everywhere, and a few towers stand where the hills are. */
static double house_height(City *city, double x, double z)
{
    double centre = 0, tall = next_unit(&city->random);
    for (int i = 0; i < HILLS; i++) {
        double dx = (x - city->hill[i][0]) / city->extent, dz = (z - city->hill[i][1]) / city->extent;
        double near = 1 / (1 + 120 * (dx * dx + dz * dz));
        centre = near > centre ? near : centre;
    }
    return 0.4 + 0.8 * tall + 1.3 * sqrt(city->extent) * centre * centre * tall * tall * tall;
}

/* Three houses of four wear the colour of their district. */
static int house_wall(City *city, int column, int row)
{
    uint64_t district = city->seed + (uint64_t)(row / DISTRICT) * 1000 + (uint64_t)(column / DISTRICT);
    uint64_t own = next_random(&city->random), shared = next_random(&district);
    return (int)((own % 4 == 0 ? own / 4 : shared) % WALLS);
}

static void write_house(FILE *out, City *city, int index)
{
    double width = 0.55 + 0.35 * next_unit(&city->random), depth = 0.55 + 0.35 * next_unit(&city->random);
    double x = plot_start(index % city->side) - city->extent / 2 + (1 - width) * next_unit(&city->random);
    double z = plot_start(index / city->side) - city->extent / 2 + (1 - depth) * next_unit(&city->random);
    double height = house_height(city, x, z);
    int wall = house_wall(city, index % city->side, index / city->side);
    fprintf(out,
            ",\n    { \"material\": \"wall%d\", \"box\": { \"min\": [%.4f, 0, %.4f], \"max\": [%.4f, %.4f, %.4f] } }",
            wall, x, z, x + width, height, z + depth);
}

bool generate_city(FILE *out, int boxes, uint64_t seed, Error *error)
{
    (void)error;
    City city = {.side = (int)ceil(sqrt(boxes)), .random = seed, .seed = seed};
    city.extent = plot_start(city.side - 1) + 1;
    for (int i = 0; i < HILLS; i++)
        for (int k = 0; k < 2; k++)
            city.hill[i][k] = (next_unit(&city.random) - 0.5) * 0.7 * city.extent;
    write_city_head(out, &city);
    for (int i = 0; i < boxes; i++)
        write_house(out, &city, i);
    fputs("\n  ]\n}\n", out);
    return true;
}

/* --- The sheet --- */

static void write_grid_head(FILE *out)
{
    fputs(
        "  \"camera\": { \"position\": [0, 0.1, 2.9], \"look_at\": [0, -0.02, 0] },\n"
        "  \"screen\": { \"columns\": 1920, \"rows\": 1080, \"distance\": 2 },\n"
        "  \"lights\": [ { \"position\": [-0.9, 1.5, 0.4] } ],\n"
        "  \"shading\": { \"background\": [0.06, 0.07, 0.1] },\n"
        "  \"materials\": {\n"
        "    \"tile0\": { \"ambient\": [0.03, 0.08, 0.14], \"diffuse\": [0.1, 0.3, 0.5], \"specular\": [0.4, 0.4, 0.4],"
        " \"shininess\": 120 },\n"
        "    \"tile1\": { \"ambient\": [0.04, 0.13, 0.15], \"diffuse\": [0.15, 0.5, 0.55], \"specular\": [0.4, 0.4, "
        "0.4],"
        " \"shininess\": 120 },\n"
        "    \"tile2\": { \"ambient\": [0.15, 0.15, 0.13], \"diffuse\": [0.7, 0.7, 0.6], \"specular\": [0.4, 0.4, 0.4],"
        " \"shininess\": 120 },\n"
        "    \"tile3\": { \"ambient\": [0.16, 0.1, 0.03], \"diffuse\": [0.75, 0.48, 0.15], \"specular\": [0.4, 0.4, "
        "0.4],"
        " \"shininess\": 120 }\n"
        "  },\n",
        out);
}

static void write_tile(FILE *out, int side, int i, int j, int tile)
{
    int corner = j * (side + 1) + i;
    fprintf(out, "%s\n        { \"vertices\": [%d, %d, %d, %d], \"material\": \"tile%d\" }", i + j > 0 ? "," : "",
            corner, corner + 1, corner + side + 2, corner + side + 1, tile);
}

bool generate_grid(FILE *out, int side, uint64_t seed, Error *error)
{
    (void)error;
    write_grid_head(out);
    fprintf(out,
            "  \"objects\": [\n    {\n      \"name\": \"sheet\", \"material\": \"tile0\",\n"
            "      \"transform\": [ { \"translate\": [%.1f, %.1f, 0] }, { \"scale\": %.17g },\n"
            "        { \"rotate\": { \"axis\": [0, 0, 1], \"degrees\": 21 } },"
            " { \"rotate\": { \"axis\": [1, 0.1, 0], \"degrees\": -52 } } ],\n      \"vertices\": [",
            -0.5 * side, -0.5 * side, 2.0 / side);
    for (int j = 0; j <= side; j++)
        for (int i = 0; i <= side; i++)
            fprintf(out, "%s[%d,%d,0]", i > 0 ? ", " : j > 0 ? ",\n        " : "\n        ", i, j);
    fputs("\n      ],\n      \"faces\": [", out);
    for (int j = 0; j < side; j++)
        for (int i = 0; i < side; i++) {
            int draw = (int)(next_random(&seed) % 8);
            write_tile(out, side, i, j, draw < 3 ? (i + j) % 2 : draw < 5 ? 1 - (i + j) % 2 : draw < 7 ? 2 : 3);
        }
    fputs("\n      ]\n    }\n  ]\n}\n", out);
    return true;
}

/* Exercise 6, the light of Blinn and Phong: `illumination_terms` of the student beside ours. Each test is a pixel of
 * the scene and one of its lights. */
#include "exercises/textbook.h"

/* Ours, under another name. */
#define illumination_terms our_illumination_terms
#undef RECTRAY_TEXTBOOK_LIGHT_H
#include "src/trace/textbook_light.h"
#undef illumination_terms

#define SCENE "docs/exercises/06-light/scene.json"

enum { LAMP, SIDE_LIGHT, RED_LIGHT };

typedef enum SlipKind {
    SLIP_NONE,
    SLIP_NOT_UNIT,
    SLIP_MINUS,
    SLIP_FULL_ALPHA,
    SLIP_DIFFUSE_BELOW_ZERO,
    SLIP_HIGHLIGHT_BELOW_ZERO,
    SLIP_AMBIENT_COSINE,
    SLIP_DIFFUSE_HALFWAY,
    SLIP_MIRRORED,
    SLIP_HIGHLIGHT_COSINE,
    SLIP_NO_LIGHT_COLOUR,
    SLIP_ONE_LIGHT_COLOUR,
    SLIP_NO_HIGHLIGHT_BEHIND,
    SLIP_TIMES_ALPHA,
    SLIP_DIFFUSE_VIEWER,
    SLIP_COUNT
} SlipKind;

static const char *const SLIPS[SLIP_COUNT] = {
    [SLIP_NOT_UNIT] = "H is L + V, not made a unit vector",
    [SLIP_MINUS] = "H is made of L - V, not of L + V",
    [SLIP_FULL_ALPHA] = "the exponent is alpha, not alpha/4",
    [SLIP_DIFFUSE_BELOW_ZERO] = "L.N may be less than 0: light from behind takes light away",
    [SLIP_HIGHLIGHT_BELOW_ZERO] = "N.H may be less than 0",
    [SLIP_AMBIENT_COSINE] = "the ambient term is multiplied by L.N; it has no direction",
    [SLIP_DIFFUSE_HALFWAY] = "the diffuse term has N.H where L.N belongs",
    [SLIP_MIRRORED] = "the highlight is Phong's older one, with the mirrored ray: V.R for N.H",
    [SLIP_HIGHLIGHT_COSINE] = "the specular term is multiplied by L.N, too",
    [SLIP_NO_LIGHT_COLOUR] = "the colours of the light, ia, id and is, are left out",
    [SLIP_ONE_LIGHT_COLOUR] = "the light's diffuse colour is taken for all three terms",
    [SLIP_NO_HIGHLIGHT_BEHIND] = "there is no highlight where L.N is not above 0; the formula has one there",
    [SLIP_TIMES_ALPHA] = "N.H is multiplied by alpha/4, not raised to that power",
    [SLIP_DIFFUSE_VIEWER] = "the diffuse term has V.N where L.N belongs",
};

/* As ours, with a slip in it. */
static Terms slipped(SlipKind kind, const Material *material, const Light *light, Real3 n, Real3 l, Real3 v)
{
    Real3 between = kind == SLIP_MINUS ? subtract(l, v) : add(l, v);
    Terms terms = {.l = l, .v = v, .h = kind == SLIP_NOT_UNIT ? between : unit(between)};
    Real l_dot_n = dot(kind == SLIP_DIFFUSE_VIEWER ? v : l, n), n_dot_h = dot(n, terms.h);
    if (kind == SLIP_MIRRORED)
        n_dot_h = dot(v, subtract(scale(2 * l_dot_n, n), l));
    terms.l_dot_n = kind == SLIP_DIFFUSE_BELOW_ZERO ? l_dot_n : at_least_zero(l_dot_n);
    terms.n_dot_h = kind == SLIP_HIGHLIGHT_BELOW_ZERO ? n_dot_h : at_least_zero(n_dot_h);
    Real exponent = kind == SLIP_FULL_ALPHA ? material->shininess : material->shininess / 4;
    Real highlight = kind == SLIP_TIMES_ALPHA ? exponent * terms.n_dot_h : pow(terms.n_dot_h, exponent);
    if (kind == SLIP_HIGHLIGHT_COSINE)
        highlight *= terms.l_dot_n;
    if (kind == SLIP_NO_HIGHLIGHT_BEHIND && l_dot_n <= 0)
        highlight = 0;
    Vec3 ia = light->ambient, id = light->diffuse, is = light->specular;
    if (kind == SLIP_ONE_LIGHT_COLOUR)
        ia = is = id;
    if (kind == SLIP_NO_LIGHT_COLOUR)
        ia = id = is = vec3(1, 1, 1);
    terms.ambient = multiply(rounded(material->ambient), rounded(ia));
    if (kind == SLIP_AMBIENT_COSINE)
        terms.ambient = scale(terms.l_dot_n, terms.ambient);
    Real cosine = kind == SLIP_DIFFUSE_HALFWAY ? terms.n_dot_h : terms.l_dot_n;
    terms.diffuse = scale(cosine, multiply(rounded(material->diffuse), rounded(id)));
    terms.specular = scale(highlight, multiply(rounded(material->specular), rounded(is)));
    return terms;
}

static Outcome outcome_of(const Terms *terms)
{
    Outcome outcome = {0};
    add_vector(&outcome, "terms.l", doubles(terms->l));
    add_vector(&outcome, "terms.v", doubles(terms->v));
    add_vector(&outcome, "terms.h", doubles(terms->h));
    add_number(&outcome, "terms.l_dot_n", terms->l_dot_n);
    add_number(&outcome, "terms.n_dot_h", terms->n_dot_h);
    add_vector(&outcome, "terms.ambient", doubles(terms->ambient));
    add_vector(&outcome, "terms.diffuse", doubles(terms->diffuse));
    add_vector(&outcome, "terms.specular", doubles(terms->specular));
    return outcome;
}

/* Ours, with the formulas. */
static Outcome expected_of(const Material *material, const Light *light, Real3 n, const Terms *terms)
{
    Outcome outcome = {0};
    add_vector(&outcome, "terms.l", doubles(terms->l));
    add_formula(&outcome, "as given");
    add_vector(&outcome, "terms.v", doubles(terms->v));
    add_formula(&outcome, "as given");
    add_vector(&outcome, "terms.h", doubles(terms->h));
    add_formula(&outcome, "H = unit(L + V) = unit(%s) = %s", text_of(add(terms->l, terms->v)), text_of(terms->h));
    add_number(&outcome, "terms.l_dot_n", terms->l_dot_n);
    add_formula(&outcome, "L.N = %s.%s = %s%s", text_of(terms->l), text_of(n), number_text(dot(terms->l, n)),
                dot(terms->l, n) < 0 ? ", which counts as 0" : "");
    add_number(&outcome, "terms.n_dot_h", terms->n_dot_h);
    add_formula(&outcome, "N.H = %s.%s = %s%s", text_of(n), text_of(terms->h), number_text(dot(n, terms->h)),
                dot(n, terms->h) < 0 ? ", which counts as 0" : "");
    add_vector(&outcome, "terms.ambient", doubles(terms->ambient));
    add_formula(&outcome, "ka ia = %s x %s = %s", vector_text(material->ambient), vector_text(light->ambient),
                text_of(terms->ambient));
    add_vector(&outcome, "terms.diffuse", doubles(terms->diffuse));
    add_formula(&outcome, "kd id (L.N) = %s x %s x %s = %s", vector_text(material->diffuse),
                vector_text(light->diffuse), number_text(terms->l_dot_n), text_of(terms->diffuse));
    add_vector(&outcome, "terms.specular", doubles(terms->specular));
    add_formula(&outcome, "ks is (N.H)^(alpha/4) = %s x %s x %s^(%s/4) = %s", vector_text(material->specular),
                vector_text(light->specular), number_text(terms->n_dot_h), number_text(material->shininess),
                text_of(terms->specular));
    return outcome;
}

static void given_colours(const Material *material, const Light *light)
{
    given("ka, kd", "%s, %s", vector_text(material->ambient), vector_text(material->diffuse));
    given("ks", "%s", vector_text(material->specular));
    given("alpha", "%s", number_text(material->shininess));
    given("ia, id", "%s, %s", vector_text(light->ambient), vector_text(light->diffuse));
    given("is", "%s", vector_text(light->specular));
}

static void try_light(int column, int row, int index)
{
    const Scene *scene = scene_of(SCENE);
    Textbook textbook = textbook_of(scene);
    RealRay ray = ray_of(scene, column, row);
    Hit hit = nearest_hit(&textbook, ray);
    place_hit(&textbook, &hit);
    const Material *material = &scene->materials[scene->faces[hit.face].material];
    const Light *light = &scene->lights[index];
    Real3 l = unit(subtract(rounded(light->position), hit.p)), v = unit(subtract(ray.o, hit.p));
    shown_at(SCENE, column, row);
    given("point", "%s of face %d, %s", text_of(hit.p), hit.face, scene->objects[scene->faces[hit.face].object].name);
    given("light", "%d", index);
    given("n", "%s", text_of(hit.n));
    given("l", "%s", text_of(l));
    given("v", "%s", text_of(v));
    given_colours(material, light);

    Terms returned = illumination_terms(material, light, hit.n, l, v);
    Terms expected = our_illumination_terms(material, light, hit.n, l, v);
    for (SlipKind kind = SLIP_NONE + 1; kind < SLIP_COUNT; kind++) {
        Terms terms = slipped(kind, material, light, hit.n, l, v);
        Outcome outcome = outcome_of(&terms);
        slip(&outcome, "%s", SLIPS[kind]);
    }
    Outcome theirs = outcome_of(&returned), ours = expected_of(material, light, hit.n, &expected);
    compare(&theirs, &ours);
}

static void head_on(void)
{
    try_light(4, 3, LAMP);
}

static void from_the_side(void)
{
    try_light(4, 3, RED_LIGHT);
}

static void from_both_sides(void)
{
    try_light(5, 2, LAMP);
    try_light(3, 4, RED_LIGHT);
}

static void light_behind(void)
{
    try_light(7, 1, LAMP);
}

static void highlight_behind(void)
{
    try_light(2, 3, SIDE_LIGHT);
}

static void no_shininess(void)
{
    try_light(7, 5, RED_LIGHT);
}

static void every_pixel(void)
{
    const Scene *scene = scene_of(SCENE);
    for (int row = 0; row < scene->screen.rows; row++)
        for (int column = 0; column < scene->screen.columns; column++)
            for (int light = 0; light < scene->light_count; light++)
                try_light(column, row, light);
}

static const ExerciseTest TESTS[] = {
    {"head_on", "A light straight ahead of the plate, and us behind it", head_on},
    {"from_the_side", "A light from the side", from_the_side},
    {"from_both_sides", "A light and a viewer to either side", from_both_sides},
    {"light_behind", "A light behind the face", light_behind},
    {"highlight_behind", "A light so far behind that N.H is negative", highlight_behind},
    {"no_shininess", "A material with alpha = 0", no_shininess},
    {"every_pixel", "Every pixel, and all lights", every_pixel},
    {NULL, NULL, NULL},
};

int main(int argc, char **argv)
{
    Exercise exercise = {.tests = TESTS, .pixel = student_pixel, .scene = SCENE, .columns = 135, .rows = 105};
    return exercise_main(argc, argv, &exercise);
}

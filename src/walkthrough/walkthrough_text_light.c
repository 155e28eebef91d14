/* The walkthrough as text: what one light does at one point. */
#include "walkthrough/walkthrough_text_light.h"

#include <math.h>
#include <string.h>

/* --- Is it seen? --- */

void walkthrough_text_light(WalkthroughText *text, const Event *event)
{
    const Ink *ink = &text->ink;
    const Scene *scene = text->walk->scene;
    int number = walkthrough_hit_number(&text->place), index = event->as.light.light, side = event->as.light.side;
    const Event *hit = text->place.hit;
    walkthrough_text_step(text, STEP_LIGHT, ink_text("Light %d at P%d", index, number).text);
    InkRow rows[] = {
        walkthrough_text_place_row(text, ink_text("light %d", index), event->as.light.position),
        ink_row(ink_text("light - P%d", number), event->as.light.to_light),
        ink_row(ink_text("L = unit(light - P%d)", number), event->as.light.l),
    };
    rows[1].note = ink_text("distance %s", ink_number(event->as.light.distance, 6).text);
    ink_rows(ink, rows, sizeof rows / sizeof *rows);
    fputc('\n', ink->out);
    Vec3 from_vertex = vec3_sub(event->as.light.position, face_vertex(&scene->faces[hit->as.hit.face], 0));
    const char *relation = side > 0 ? " > 0" : side < 0 ? " < 0" : "";
    if (text->rounding)
        ink_line(ink, "    N.(light - P%d) = %s.%s\t= %s%s", number, ink_vector(hit->as.hit.normal, 6).text,
                 ink_vector(event->as.light.to_light, 6).text, ink_number(event->as.light.height, 6).text, relation);
    else
        ink_line(ink, "    N.(light - v0) = %s.%s\t= %s%s", ink_vector(hit->as.hit.normal, 6).text,
                 ink_vector(from_vertex, 6).text, ink_number(event->as.light.height, 6).text, relation);
    double n_dot_l = side == 0 ? 0 : vec3_dot(hit->as.hit.normal, event->as.light.l);
    ink_line(ink, "    N.L            = %s.%s\t= %s%s", ink_vector(hit->as.hit.normal, 6).text,
             ink_vector(event->as.light.l, 6).text, ink_number(n_dot_l, 6).text, relation);
    if (side > 0)
        ink_paragraph(ink,
                      "    The light is in front of the face. The ray from P%d' (t = 0) to the light (t = 1):", number),
            fputc('\n', ink->out);
    text->rows_told = false;
}

void walkthrough_text_light_end(WalkthroughText *text, const Event *event)
{
    const Ink *ink = &text->ink;
    const Scene *scene = text->walk->scene;
    LightVerdict verdict = event->as.light_end.verdict;
    if (verdict == LIGHT_BLOCKED)
        fputc('\n', ink->out);
    ink_paragraph(ink, "    %s", walkthrough_light_words(text->walk, &text->place, event).text);
    if (verdict == LIGHT_REACHES)
        fputc('\n', ink->out);
    if (verdict != LIGHT_REACHES && scene->shading.shadow == SHADOW_BLACK)
        ink_line(ink, "    Light %d adds nothing: \"shadow\" is \"black\".", event->as.light_end.light);
}

/* --- What does it add? --- */

typedef struct Term {
    const char *formula;
    Vec3 k, i, value;
    double factor; /* -1: none */
} Term;

/* Widths of columns, and places after the point. */
typedef struct Columns {
    int k, i, factor, places;
} Columns;

static int wider(int width, InkText text)
{
    int length = (int)strlen(text.text);
    return length > width ? length : width;
}

/* Colours matter to a few places after the point, not to so many digits. */
static InkText decimal(double x, int places)
{
    InkText text = ink_text("%.*f", places, x);
    for (size_t end = strlen(text.text); end > 1 && (text.text[end - 1] == '0' || text.text[end - 1] == '.'); end--) {
        bool point = text.text[end - 1] == '.';
        text.text[end - 1] = '\0';
        if (point)
            break;
    }
    return fabs(x) < 1e4 ? text : ink_number(x, INK_DIGITS);
}

static InkText decimals(Vec3 v, int places)
{
    return ink_text("(%s, %s, %s)", decimal(v.x, places).text, decimal(v.y, places).text, decimal(v.z, places).text);
}

typedef struct TermTexts {
    InkText k, i, factor, value;
} TermTexts;

static TermTexts texts_of(const Term *term, int places)
{
    return (TermTexts){ink_vector(term->k, INK_DIGITS), ink_vector(term->i, INK_DIGITS),
                       term->factor < 0 ? ink_text("%s", "") : ink_text("x %s", ink_number(term->factor, places).text),
                       decimals(term->value, places)};
}

/* A term on two lines, where one has no room for its factors and its value. */
static void print_broken_terms(const Ink *ink, const Term *terms, int count, Vec3 sum)
{
    for (int n = 0; n < count; n++) {
        TermTexts texts = texts_of(&terms[n], INK_DIGITS);
        ink_line(ink, "    %-11s = %s x %s%s%s\t= %s", terms[n].formula, texts.k.text, texts.i.text,
                 texts.factor.text[0] ? " " : "", texts.factor.text, texts.value.text);
    }
    ink_line(ink, "    %-11s = %s", "I", decimals(sum, INK_DIGITS).text);
}

/* "kd id (L.N) = (0.78, 0.78, 0.78) x (1, 1, 1) x 0.38434 = (0.29979, 0.29979, 0.29979)", in columns, with as many
 * places after the point, at most six, as a line has room for. */
static void print_terms(const Ink *ink, const Term *terms, int count, Vec3 sum)
{
    TermTexts texts[3];
    Columns wide = {0};
    int room = -1;
    for (int places = 6; room < 0 && places >= 4; places--) {
        int value = wider(0, decimals(sum, places));
        wide = (Columns){0};
        for (int n = 0; n < count; n++) {
            texts[n] = texts_of(&terms[n], places);
            wide.k = wider(wide.k, texts[n].k);
            wide.i = wider(wide.i, texts[n].i);
            wide.factor = wider(wide.factor, texts[n].factor);
            value = wider(value, texts[n].value);
        }
        wide.places = places;
        room = ink->columns - (18 + wide.k + 3 + wide.i + 1 + wide.factor + 3 + value);
    }
    if (room < 0) {
        print_broken_terms(ink, terms, count, sum);
        return;
    }
    for (int n = 0; n < count; n++)
        ink_line(ink, "    %-11s = %-*s x %-*s %-*s\t= %s", terms[n].formula, wide.k, texts[n].k.text, wide.i,
                 texts[n].i.text, wide.factor, texts[n].factor.text, texts[n].value.text);
    ink_line(ink, "    I%*s\t= %s", 13 + wide.k + 3 + wide.i + 1 + wide.factor, "", decimals(sum, wide.places).text);
}

/* L.N, N.H and its power; a dot product below 0 counts as 0. */
static void print_highlight(const Ink *ink, Vec3 n, const Illumination *terms, double shininess)
{
    double n_dot_h = vec3_dot(n, terms->h);
    InkText clamped = n_dot_h < 0 ? ink_text("max(0, %s) = ", ink_number(n_dot_h, 6).text) : ink_text("%s", "");
    InkText power = ink_text("%s^(%s/4)", ink_number(terms->n_dot_h, 6).text, ink_number(shininess, 6).text);
    ink_line(ink, "\n    L.N = %s,\tN.H = %s%s,\ts = (N.H)^(alpha/4) = %s = %s", ink_number(terms->l_dot_n, 6).text,
             clamped.text, ink_number(terms->n_dot_h, 6).text, power.text,
             ink_number(pow(terms->n_dot_h, shininess / 4), 6).text);
}

/* V, and H between L and V, with what they are the unit vectors of. */
static void print_halfway(const WalkthroughText *text, const Event *event)
{
    int number = walkthrough_hit_number(&text->place);
    bool to_camera = text->walk->scene->shading.viewer == VIEWER_CAMERA;
    Vec3 to_viewer = walkthrough_to_viewer(text->walk->scene, &text->place);
    Vec3 l_plus_v = vec3_add(event->as.terms.l, event->as.terms.v);
    InkRow rows[] = {
        ink_row(to_camera ? ink_text("C - P%d", number) : ink_text("-R"), to_viewer),
        ink_row(to_camera ? ink_text("V = unit(C - P%d)", number) : ink_text("V = -R / |R|"), event->as.terms.v),
        ink_row(ink_text("L + V"), l_plus_v),
        ink_row(ink_text("H = unit(L + V)"), event->as.terms.illumination.h),
    };
    rows[0].note = ink_text("length %s", ink_number(vec3_length(to_viewer), 6).text);
    rows[2].note = ink_text("length %s", ink_number(vec3_length(l_plus_v), 6).text);
    ink_rows(&text->ink, rows, sizeof rows / sizeof *rows);
}

void walkthrough_text_terms(WalkthroughText *text, const Event *event)
{
    const Ink *ink = &text->ink;
    const Scene *scene = text->walk->scene;
    int number = walkthrough_hit_number(&text->place);
    const Material *material = &scene->materials[scene->faces[text->place.hit->as.hit.face].material];
    const Light *light = &scene->lights[event->as.terms.light];
    const Illumination *terms = &event->as.terms.illumination;
    double highlight = pow(terms->n_dot_h, event->as.terms.exponent);
    if (event->as.terms.ambient_only) {
        ink_paragraph(ink,
                      "    But \"shadow\" is \"ambient\": the ambient term of light %d counts although it does not "
                      "reach P%d.",
                      event->as.terms.light, number);
    } else {
        print_halfway(text, event);
        print_highlight(ink, text->place.hit->as.hit.normal, terms, material->shininess);
    }
    ink_line(ink, event->as.terms.ambient_only ? "    I = ka ia:\n" : "    I = ka ia + kd id (L.N) + ks is s:\n");
    const Term all[] = {
        {"ka ia", material->ambient, light->ambient, terms->ambient, -1},
        {"kd id (L.N)", material->diffuse, light->diffuse, terms->diffuse, terms->l_dot_n},
        {"ks is s", material->specular, light->specular, terms->specular, highlight},
    };
    print_terms(ink, all, event->as.terms.ambient_only ? 1 : 3, event->as.terms.sum);
}

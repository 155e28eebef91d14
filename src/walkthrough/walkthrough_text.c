/* The walkthrough as text: a worked example, step by step: the formula, the formula with the numbers in it, the result.
 * Here is its frame: the primary ray, the mirrors, the sum. The events come in the order in which things happened,
 * so each case prints one step, or a part of one. */
#include "walkthrough/walkthrough_text.h"

#include "walkthrough/walkthrough_summary.h"
#include "walkthrough/walkthrough_text_head.h"
#include "walkthrough/walkthrough_text_hit.h"
#include "walkthrough/walkthrough_text_light.h"
#include "walkthrough/walkthrough_text_node.h"
#include "walkthrough/walkthrough_text_search.h"
#include "walkthrough/walkthrough_text_sum.h"

static void print_sample(WalkthroughText *text, const Event *event)
{
    const Scene *scene = text->walk->scene;
    View view = view_of(scene);
    int i = event->as.sample.i, j = event->as.sample.j, n = text->walk->grid;
    ScreenPoint at = event->as.sample.at;
    InkText half = n == 1 ? ink_text("0.5") : ink_text("(i + 0.5)/%d", n);
    InkText half_row = n == 1 ? half : ink_text("(j + 0.5)/%d", n);
    InkText value = n == 1 ? half : ink_text("%d.5/%d", i, n), value_row = n == 1 ? half : ink_text("%d.5/%d", j, n);

    walkthrough_text_step(text, STEP_PRIMARY, "The primary ray, from the camera C through the point Q of the screen");
    ink_line(&text->ink, "    x = ((column + %s)/columns - 0.5) width\t= ((%d + %s)/%d - 0.5) %s\t= %s", half.text,
             event->as.sample.column, value.text, view.columns, ink_number(view.width, 6).text,
             ink_number(at.x, 6).text);
    ink_line(&text->ink, "    y = (0.5 - (row + %s)/rows) height     \t= (0.5 - (%d + %s)/%d) %s\t= %s", half_row.text,
             event->as.sample.row, value_row.text, view.rows, ink_number(view.height, 6).text,
             ink_number(at.y, 6).text);
    ink_line(&text->ink, "    r = %s points right, u = %s\tup.\n", ink_vector(view.right, 6).text,
             ink_vector(view.up, 6).text);
    InkRow rows[] = {
        walkthrough_text_place_row(text, ink_text("C"), event->as.sample.c),
        ink_row(ink_text("distance f"), view.forward),
        ink_row(ink_text("x r"), vec3_scale(at.x, view.right)),
        ink_row(ink_text("y u"), vec3_scale(at.y, view.up)),
        walkthrough_text_place_row(text, ink_text("Q = C + distance f + x r + y u"), event->as.sample.q),
        ink_row(ink_text("R = Q - C"), event->as.sample.r),
    };
    rows[0].note = ink_text("the camera");
    rows[1].note = ink_text("forward");
    ink_rows(&text->ink, rows, sizeof rows / sizeof *rows);
    ink_line(&text->ink, "\n    The ray: P(t) = O + t R with O = C;\tt = 1 is the screen, and |R| = %s.",
             ink_number(vec3_length(event->as.sample.r), 6).text);
}

/* --- The mirror --- */

static void print_shaded(WalkthroughText *text, const Event *event)
{
    int number = walkthrough_hit_number(&text->place);
    text->weight = event->as.shaded.weight;
    walkthrough_text_step(text, STEP_ADDS, ink_text("What P%d adds to the pixel", number).text);
    if (event->as.shaded.lights_reaching == 0)
        ink_line(&text->ink, "    No light reaches P%d.", number);
    if (text->walk->scene->light_count > 1)
        ink_line(&text->ink, "    illumination          = the sum of I over the lights");
    ink_line(&text->ink, "    weight x illumination = %s x %s\t= %s", ink_number(event->as.shaded.weight, 6).text,
             ink_vector(event->as.shaded.illumination, 6).text, ink_vector(event->as.shaded.contribution, 6).text);
    if (number > 1)
        ink_line(&text->ink, "    sum so far            = %s", ink_vector(event->as.shaded.total, 6).text);
}

static void print_reflected(WalkthroughText *text, const Event *event)
{
    int number = walkthrough_hit_number(&text->place);
    Vec3 r = event->as.reflected.r_unit, normal = text->place.hit->as.hit.normal;
    double r_dot_n = vec3_dot(r, normal);
    walkthrough_text_step(text, STEP_MIRROR, ink_text("The mirror at P%d", number).text);
    ink_line(&text->ink, "    r = R / |R| with |R| = %s,\tand N, turned to the side that the ray came from:",
             ink_number(text->place.length, 6).text);
    ink_line(&text->ink, "    r.N = %s.%s\t= %s", ink_vector(r, 6).text, ink_vector(normal, 6).text,
             ink_number(r_dot_n, 6).text);
    fputc('\n', text->ink.out);
    InkRow rows[] = {
        ink_row(ink_text("r"), r),
        ink_row(ink_text("-2 (r.N) N"), vec3_scale(-2 * r_dot_n, normal)),
        ink_row(ink_text("R' = r - 2 (r.N) N"), event->as.reflected.direction),
    };
    ink_rows(&text->ink, rows, sizeof rows / sizeof *rows);
    ink_line(&text->ink, "\n    The path goes on from P%d' along R'. What it meets counts with the", number);
    ink_line(&text->ink, "    new weight = weight x reflection = %s x %s = %s", ink_number(text->weight, 6).text,
             ink_number(event->as.reflected.reflection, 6).text, ink_number(event->as.reflected.weight, 6).text);
}

static void print_miss(WalkthroughText *text, const Event *event)
{
    ink_paragraph(&text->ink, "    No face is hit: the ray leaves the scene, and the background shines in.");
    ink_line(&text->ink, "    weight x background = %s x %s\t= %s", ink_number(event->as.miss.weight, 6).text,
             ink_vector(event->as.miss.background, 6).text, ink_vector(event->as.miss.weight_times_background, 6).text);
}

static void print_next_face(WalkthroughText *text)
{
    int number = walkthrough_hit_number(&text->place) + 1;
    InkText title = number == 1 ? ink_text("The nearest face along the ray")
                                : ink_text("The nearest face in the mirror at P%d", number - 1);
    walkthrough_text_step(text, STEP_NEAREST, title.text);
    if (number > 1)
        return;
    ink_paragraph(&text->ink,
                  "    The plane of a face is N.P + D = 0, and the ray meets it at t = -(N.O + D) / (N.R). There the "
                  "signs of N.(e x c) tell on which side of each edge it passes. Of all hits the smallest t "
                  "counts.");
    fputc('\n', text->ink.out);
}

/* --- The list --- */

void walkthrough_text_event(WalkthroughText *text, const Event *event)
{
    switch (event->kind) {
    case EVENT_ADAPTIVE: /* told at the head */
        break;
    case EVENT_SAMPLE:
        print_sample(text, event);
        break;
    case EVENT_TALLY:
        walkthrough_text_tally(text, event);
        break;
    case EVENT_FACE:
        walkthrough_text_face_tested(text, event);
        break;
    case EVENT_OCCLUDER:
        walkthrough_text_occluder_tested(text, event);
        break;
    case EVENT_HIT:
        walkthrough_text_hit(text, event);
        break;
    case EVENT_MISS:
        print_miss(text, event);
        break;
    case EVENT_LIGHT:
        walkthrough_text_light(text, event);
        break;
    case EVENT_LIGHT_END:
        walkthrough_text_light_end(text, event);
        break;
    case EVENT_TERMS:
        walkthrough_text_terms(text, event);
        break;
    case EVENT_SHADED:
        print_shaded(text, event);
        break;
    case EVENT_REFLECTED:
        print_reflected(text, event);
        break;
    case EVENT_PATH_END:
        walkthrough_text_path_end(text, event);
        break;
    case EVENT_PIXEL:
        walkthrough_text_pixel(text, event);
        break;
    case EVENT_NODE:
        walkthrough_text_node(text, event);
        break;
    case EVENT_KIND_COUNT:
        break;
    }
}

void walkthrough_text_search_begin(WalkthroughText *text, const Event *event)
{
    if (event->kind == EVENT_SAMPLE || event->kind == EVENT_REFLECTED)
        print_next_face(text);
}

static void print_title(const Ink *ink, const Walkthrough *walk)
{
    fprintf(ink->out, "%sPixel (%d, %d) of %s%s\n", ink_colour(ink, 'b'), walk->request.column, walk->request.row,
            ink_name(walk->scene_name, 60).text, ink_colour(ink, '0'));
}

static bool print_summary(const Ink *ink, const Walkthrough *walk, Error *error)
{
    Summary summary;
    if (!summary_make(&summary, walk, error))
        return false;
    summary_write_text(ink, &summary);
    summary_free(&summary);
    return true;
}

bool walkthrough_write_text(FILE *out, const Walkthrough *walk, WalkthroughStyle style, Error *error)
{
    WalkthroughText text = walkthrough_text_begin(out, walk, style, INK_DIGITS);
    print_title(&text.ink, walk);
    if (style.parts != WALKTHROUGH_STEPS && !print_summary(&text.ink, walk, error))
        return false;
    if (style.parts == WALKTHROUGH_SUMMARY)
        return true;
    walkthrough_text_head(&text);
    for (long i = 0; i < walk->count; i++) {
        walkthrough_follow(&text.place, walk, &walk->events[i]);
        if (text.place.told || walk->events[i].kind == EVENT_PIXEL)
            walkthrough_text_event(&text, &walk->events[i]);
        if (text.place.told)
            walkthrough_text_search_begin(&text, &walk->events[i]);
    }
    return true;
}

/* The walkthrough as text: why the path ended, the sum of what it gathered, and the pixel's three bytes. */
#include "walkthrough/walkthrough_text_sum.h"

static void print_reason(WalkthroughText *text, const Event *event)
{
    walkthrough_text_step(text, STEP_SUM, "The sum");
    ink_paragraph(&text->ink, "    %s", walkthrough_end_words(text->walk, &text->place, event).text);
    fputc('\n', text->ink.out);
}

/* The told sample's contributions, one a line, and their sum. */
static void print_sum(const WalkthroughText *text, const Event *path_end)
{
    InkRow rows[SCENE_MAX_BOUNCES + 3];
    int count = 0;
    for (const Event *event = text->place.sample; event != path_end; event++) {
        if (event->kind == EVENT_SHADED) {
            InkText label = ink_text("P%d", count + 1);
            rows[count++] =
                ink_row(ink_text("%-10s  weight %-10s", label.text, ink_number(event->as.shaded.weight, 6).text),
                        event->as.shaded.contribution);
        } else if (event->kind == EVENT_MISS) {
            rows[count++] = ink_row(ink_text("background  weight %-10s", ink_number(event->as.miss.weight, 6).text),
                                    event->as.miss.weight_times_background);
        }
    }
    rows[count++] = ink_row(ink_text("sum"), path_end->as.path_end.colour);
    ink_rows(&text->ink, rows, count);
}

void walkthrough_text_path_end(WalkthroughText *text, const Event *event)
{
    print_reason(text, event);
    print_sum(text, event);
}

static void print_samples(const WalkthroughText *text, int samples)
{
    enum { SHORT_LIST = 16 };
    const Walkthrough *walk = text->walk;
    int count = 0;
    bool list = samples <= SHORT_LIST || walk->request.verbose;
    ink_line(&text->ink, "\n    That is sample (%d, %d).\t%s", walk->request.i, walk->request.j,
             list ? "All samples, each found in the same way:\n"
                  : "--verbose lists the others, found in the same way.");
    InkRow rows[SCENE_MAX_GRID * SCENE_MAX_GRID];
    const Event *sample = walk->events; /* the first event is one */
    for (long k = 0; k < walk->count; k++) {
        const Event *event = &walk->events[k];
        if (event->kind == EVENT_SAMPLE)
            sample = event;
        else if (event->kind == EVENT_PATH_END)
            rows[count++] = ink_row(ink_text("sample (%d, %d)", sample->as.sample.i, sample->as.sample.j),
                                    event->as.path_end.colour);
    }
    if (list)
        ink_rows(&text->ink, rows, count);
}

void walkthrough_text_pixel(WalkthroughText *text, const Event *event)
{
    const Ink *ink = &text->ink;
    const unsigned char *rgb = event->as.pixel.rgb;
    if (event->as.pixel.samples > 1) {
        print_samples(text, event->as.pixel.samples);
        ink_line(ink, "\n    average = sum / %d = %s / %d\t= %s", event->as.pixel.samples,
                 ink_vector(event->as.pixel.sum, 6).text, event->as.pixel.samples,
                 ink_vector(event->as.pixel.average, 6).text);
    } else {
        fputc('\n', ink->out);
    }
    Vec3 c = event->as.pixel.clamped;
    ink_line(ink, "    clamped to [0, 1]: c = %s", ink_vector(c, 6).text);
    const char *names[] = {"red", "green", "blue"};
    const double values[] = {c.x, c.y, c.z};
    for (int k = 0; k < 3; k++)
        ink_line(ink, "    %-5s = floor(255 c + 0.5) = floor(255 x %s + 0.5)\t= floor(%s) = %d", names[k],
                 ink_number(values[k], 6).text, ink_number(255 * values[k] + 0.5, 6).text, rgb[k]);
    fprintf(ink->out, "\n%s%s%s", ink_colour(ink, 'b'), walkthrough_pixel_words(text->walk, event).text,
            ink_colour(ink, '0'));
    fprintf(ink->out, "%s%s\n", ink->colour ? "  " : "", ink_swatch(ink, rgb, 6).text);
}

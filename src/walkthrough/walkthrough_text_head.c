/* The walkthrough as text: what a reader needs to know before the steps. */
#include "walkthrough/walkthrough_text_head.h"

/* Why adaptive sampling gives the pixel one sample, or many. */
static void print_verdict(const WalkthroughText *text, const AdaptiveVerdict *verdict)
{
    const Scene *scene = text->walk->scene;
    InkText face = verdict->reason == ADAPTIVE_SAME || verdict->reason == ADAPTIVE_HIGHLIGHT
                       ? ink_text("%s", "")
                       : walkthrough_face_words(scene, verdict->face, 40);
    InkText why;
    int hit = verdict->hit + 1, light = verdict->light;
    switch (verdict->reason) {
    case ADAPTIVE_SAME:
        ink_paragraph(&text->ink,
                      "Sampling is adaptive: all rays of this pixel meet the same faces and the same lights as "
                      "the one through its centre, which alone makes the pixel.");
        return;
    case ADAPTIVE_EDGE:
        why = ink_text("an edge of the face %s, which the centre meets at P%d, may cross it", face.text, hit);
        break;
    case ADAPTIVE_FACE:
        why = ink_text("another face, %s, may show in it, which the centre passes before P%d", face.text, hit);
        break;
    case ADAPTIVE_SHADOW:
        why = ink_text("at P%d the shadow of %s in light %d may end in it", hit, face.text, light);
        break;
    default:
        why = ink_text("at P%d the brightness by light %d changes unevenly over it", hit, light);
    }
    ink_paragraph(&text->ink, "Sampling is adaptive, and this pixel needs more than the ray through its centre: %s.",
                  why.text);
}

/* The symbols of the formulas, once. */
static void print_legend(const Ink *ink)
{
    static const char *const lines[][2] = {
        {"C, Q, R", "the camera, a point of the screen, and the direction from the one to the other"},
        {"O, t, P", "where a ray starts, how many R it has gone, where it is then: P = O + t R"},
        {"v0, v1, ...", "the vertices of a face; N is its unit normal, and N.P + D = 0 its plane"},
        {"L, V, H", "unit vectors at a hit: to the light, to the viewer, and halfway between the two"},
        {"ka, kd, ks", "the material's ambient, diffuse and specular colour; alpha is its shininess"},
        {"ia, id, is", "the light's ambient, diffuse and specular colour"},
        {"alpha/4", "the exponent of the highlight; the text that this program teaches defines shininess so"},
    };
    fputc('\n', ink->out);
    for (size_t i = 0; i < sizeof lines / sizeof *lines; i++)
        ink_hanging(ink, 17, "    %-11s  %s", lines[i][0], lines[i][1]);
}

void walkthrough_text_head(const WalkthroughText *text)
{
    const Walkthrough *walk = text->walk;
    const Scene *scene = walk->scene;
    const WalkthroughRequest *request = &walk->request;
    const Ink *ink = &text->ink;
    ink_heading(ink, "Step by step");
    ink_paragraph(
        ink,
        "The picture has %d x %d pixels. This one is in column %d from the left and row %d from the top, both "
        "counted from 0. The scene holds %d face%s and %d light%s.",
        scene->screen.columns, scene->screen.rows, request->column, request->row, scene->face_count,
        scene->face_count == 1 ? "" : "s", scene->light_count, scene->light_count == 1 ? "" : "s");
    if (walk->count > 0 && walk->events[0].kind == EVENT_ADAPTIVE)
        print_verdict(text, &walk->events[0].as.adaptive);
    int n = walk->grid;
    InkText samples = scene->adaptive
                          ? ink_text("%d samples, one in each column and each row of a grid of %d x %d", n, n, n)
                          : ink_text("%d x %d samples", n, n);
    if (n > 1)
        ink_paragraph(ink,
                      "The pixel is the average of %s. Told in full is sample (%d, %d), in column %d and "
                      "row %d of the grid inside the pixel; --sample I,J tells another.",
                      samples.text, request->i, request->j, request->i, request->j);
    print_legend(ink);
}

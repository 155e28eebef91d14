/* The walkthrough as text: the nearest face, the point where the ray hits it, and the inside test. */
#include "walkthrough/walkthrough_text_hit.h"

#include <math.h>
#include <string.h>

static void print_plane_hit(const WalkthroughText *text, const Event *event)
{
    const Ink *ink = &text->ink;
    const Scene *scene = text->walk->scene;
    const FaceTest *test = &event->as.hit.test;
    const Face *face = &scene->faces[event->as.hit.face];
    Vec3 normal = scene->planes[event->as.hit.face].normal;
    InkText n = ink_vector(normal, 6);
    InkRow rows[4];
    for (int k = 0; k < face->vertex_count; k++)
        rows[k] = walkthrough_text_place_row(text, ink_text("v%d", k), face_vertex(face, k));
    ink_rows(ink, rows, face->vertex_count);
    fputc('\n', ink->out);
    const char *formula = face->vertex_count == 4 ? "unit((v2 - v0) x (v3 - v1))" : "unit((v1 - v0) x (v2 - v0))";
    ink_line(ink, "    N       = %s = %s", formula, n.text);
    ink_line(ink, "    N.R     = %s.%s\t= %s", n.text, ink_vector(text->place.ray.direction, 6).text,
             ink_number(test->n_dot_r, 6).text);
    ink_line(ink, "    N.O + D = N.(O - v0) = %s.%s\t= %s", n.text,
             ink_vector(vec3_sub(text->place.ray.origin, face_vertex(face, 0)), 6).text,
             ink_number(test->n_dot_o_plus_d, 6).text);
    ink_line(ink, "    t       = -(N.O + D) / (N.R) = -(%s) / (%s) = %s", ink_number(test->n_dot_o_plus_d, 6).text,
             ink_number(test->n_dot_r, 6).text, ink_number(test->t, 6).text);
    fputc('\n', ink->out);
}

static void print_inside_test(const WalkthroughText *text, const Event *event)
{
    const Ink *ink = &text->ink;
    const Face *face = &text->walk->scene->faces[event->as.hit.face];
    const FaceTest *test = &event->as.hit.test;
    int number = event->as.hit.step + 1;
    ink_line(ink,
             "\n    Inside? For each edge e = v[k+1] - v[k] and c = P%d - v[k], the sign of dot(N, cross(e, c)):\n",
             number);
    InkText e[4], c[4];
    int wide_e = 0, wide_c = 0;
    for (int k = 0; k < test->edges; k++) {
        WalkthroughEdge edge = walkthrough_edge(face, k, event->as.hit.point);
        e[k] = ink_vector(edge.e, 5);
        c[k] = ink_vector(edge.c, 5);
        wide_e = (int)fmax(wide_e, (double)strlen(e[k].text));
        wide_c = (int)fmax(wide_c, (double)strlen(c[k].text));
    }
    ink_line(ink, "    edge      %-*s  %-*s  dot(N, cross(e, c))", wide_e, "e", wide_c, "c");
    bool zero = false;
    for (int k = 0; k < test->edges; k++) {
        zero = zero || test->edge_sign[k] == 0;
        ink_line(ink, "    v%d -> v%d  %-*s  %-*s  %12s   %s", k, (k + 1) % test->edges, wide_e, e[k].text, wide_c,
                 c[k].text, ink_number(test->edge_value[k], 6).text, ink_sign(ink, test->edge_sign[k]).text);
    }
    ink_line(ink,
             zero ? "\n    No sign is -, and 0 is on the edge's own line, which counts as inside: P%d is on the face."
                  : "\n    No sign is -: P%d is on the face.",
             number);
}

static void print_shift(const WalkthroughText *text, const Event *event)
{
    const Ink *ink = &text->ink;
    int number = event->as.hit.step + 1;
    Vec3 normal = event->as.hit.normal;
    double shift = vec3_dot(normal, vec3_sub(event->as.hit.shifted, event->as.hit.point));
    if (event->as.hit.test.n_dot_r > 0)
        ink_line(ink, "    N.R > 0, the ray came from behind: from here N is turned to its side, N = %s.",
                 ink_vector(normal, 6).text);
    ink_line(ink, "    Rays that leave start at P%d' = P%d %c %s N, which rounding cannot put behind the face.", number,
             number, shift < 0 ? '-' : '+', ink_number(fabs(shift), 3).text);
}

void walkthrough_text_hit(WalkthroughText *text, const Event *event)
{
    const Scene *scene = text->walk->scene;
    int number = event->as.hit.step + 1;
    const Face *face = &scene->faces[event->as.hit.face];
    ink_line(&text->ink, "\n    The nearest is face %d, %s, material %s:\n", face->number,
             walkthrough_face_words(scene, event->as.hit.face, 40).text,
             ink_name(scene->materials[face->material].name, 24).text);
    print_plane_hit(text, event);
    InkRow rows[] = {
        walkthrough_text_place_row(text, ink_text("O"), text->place.ray.origin),
        ink_row(ink_text("t R"), vec3_scale(event->as.hit.test.t, text->place.ray.direction)),
        walkthrough_text_place_row(text, ink_text("P%d = O + t R", number), event->as.hit.point),
    };
    ink_rows(&text->ink, rows, sizeof rows / sizeof *rows);
    print_inside_test(text, event);
    print_shift(text, event);
}

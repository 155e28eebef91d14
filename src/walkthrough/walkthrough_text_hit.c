/* The walkthrough as text: the nearest face, the point where the ray hits it, and the inside test. */
#include "walkthrough/walkthrough_text_hit.h"

#include <math.h>
#include <string.h>

/* The vertices, and the normal that their diagonals give. */
static void print_normal(const WalkthroughText *text, const Event *event)
{
    const Ink *ink = &text->ink;
    const Scene *scene = text->walk->scene;
    const Face *face = &scene->faces[event->as.hit.face];
    bool triangle = face->vertex_count == 3;
    InkRow rows[4];
    for (int k = 0; k < face->vertex_count; k++)
        rows[k] = walkthrough_text_place_row(text, ink_text("v%d", k), face_vertex(face, k));
    ink_rows(ink, rows, face->vertex_count);
    fputc('\n', ink->out);
    Vec3 c = scene->centre;
    if (event->as.hit.step == 0 && (c.x != 0 || c.y != 0 || c.z != 0)) {
        ink_paragraph(
            ink,
            "    Positions are in the scene file's coordinates, here as everywhere. The scene is traced as seen "
            "from its own centre %s: its vertices are moved there and then rounded to float32.",
            ink_vector(c, text->digits).text);
        fputc('\n', ink->out);
    }
    WalkthroughSides sides = walkthrough_sides(face);
    Vec3 cross = vec3_cross(sides.a, sides.b);
    InkRow products[] = {
        ink_row(ink_text(triangle ? "a = v1 - v0" : "a = v2 - v0"), sides.a),
        ink_row(ink_text(triangle ? "b = v2 - v0" : "b = v3 - v1"), sides.b),
        ink_row(ink_text("a x b"), cross),
        ink_row(ink_text("N = unit(a x b)"), scene->planes[event->as.hit.face].normal),
    };
    products[2].note = ink_text("length %s", ink_number(vec3_length(cross), 6).text);
    ink_rows(ink, products, sizeof products / sizeof *products);
    fputc('\n', ink->out);
}

/* N.O + D as it is computed: exactly, or with the D of the textbook. */
static void print_distance(const WalkthroughText *text, const Event *event, InkText n)
{
    const Ink *ink = &text->ink;
    const Face *face = &text->walk->scene->faces[event->as.hit.face];
    Vec3 o = text->place.ray.origin, v0 = face_vertex(face, 0);
    double value = event->as.hit.test.n_dot_o_plus_d;
    if (!text->rounding) {
        ink_line(ink, "    N.O + D = N.(O - v0)\t= %s.%s\t= %s", n.text, ink_vector(vec3_sub(o, v0), 6).text,
                 ink_number(value, 6).text);
        return;
    }
    Vec3 c = text->walk->scene->centre;
    if (c.x != 0 || c.y != 0 || c.z != 0)
        ink_line(ink, "    The next two with O and v0 as seen from the scene's centre:");
    InkText d = ink_number(rounding_textbook_d(text->rounding, event->as.hit.face), text->digits);
    ink_line(ink, "    D       = -N.v0\t= -%s.%s\t= %s", n.text, ink_vector(v0, 6).text, d.text);
    ink_line(ink, "    N.O + D = %s.%s + (%s)\t= %s", n.text, ink_vector(o, 6).text, d.text,
             ink_number(value, text->digits).text);
}

static void print_plane_hit(const WalkthroughText *text, const Event *event)
{
    const Ink *ink = &text->ink;
    const Scene *scene = text->walk->scene;
    const FaceTest *test = &event->as.hit.test;
    InkText n = ink_vector(scene->planes[event->as.hit.face].normal, 6);
    ink_line(ink, "    N.R     = %s.%s\t= %s", n.text, ink_vector(text->place.ray.direction, 6).text,
             ink_number(test->n_dot_r, 6).text);
    print_distance(text, event, n);
    ink_line(ink, "    t       = -(N.O + D) / (N.R) = -(%s) / (%s) = %s", ink_number(test->n_dot_o_plus_d, 6).text,
             ink_number(test->n_dot_r, 6).text, ink_number(test->t, 6).text);
    fputc('\n', ink->out);
}

/* --- The inside test --- */

enum { EDGE_CELLS = 3 }; /* e, c and e x c */

typedef struct EdgeTexts {
    InkText cells[EDGE_CELLS];
} EdgeTexts;

static EdgeTexts edge_texts(const Face *face, int k, Vec3 point, int digits)
{
    WalkthroughEdge edge = walkthrough_edge(face, k, point);
    return (EdgeTexts){
        {ink_vector(edge.e, digits), ink_vector(edge.c, digits), ink_vector(vec3_cross(edge.e, edge.c), digits)}};
}

/* An edge a line, or two where one is too short. */
static void print_edges(const Ink *ink, const Face *face, const FaceTest *test, Vec3 point)
{
    EdgeTexts texts[4];
    int wide[EDGE_CELLS];
    for (int digits = 5, room = -1; room < 0 && digits >= 3; digits--) {
        wide[0] = wide[1] = 1, wide[2] = 5;
        for (int k = 0; k < test->edges; k++) {
            texts[k] = edge_texts(face, k, point, digits);
            for (int i = 0; i < EDGE_CELLS; i++)
                wide[i] = (int)fmax(wide[i], (double)strlen(texts[k].cells[i].text));
        }
        room =
            ink->columns - (14 + wide[0] + 2 + (wide[1] > wide[2] + 18 - wide[0] ? wide[1] : wide[2] + 18 - wide[0]));
    }
    bool one_line = 14 + wide[0] + 2 + wide[1] + 2 + wide[2] + 2 + 12 + 4 <= ink->columns;
    InkText new_line = one_line ? ink_text("  ") : ink_text("\n%*s", 14, "");
    fprintf(ink->out, "    edge      %-*s  %-*s%s%-*s  N.(e x c)\n", wide[0], "e", one_line ? wide[1] : 1, "c",
            new_line.text, wide[2], "e x c");
    for (int k = 0; k < test->edges; k++)
        fprintf(ink->out, "    v%d -> v%d  %-*s  %-*s%s%-*s  %12s   %s\n", k, (k + 1) % test->edges, wide[0],
                texts[k].cells[0].text, one_line ? wide[1] : 1, texts[k].cells[1].text, new_line.text, wide[2],
                texts[k].cells[2].text, ink_number(test->edge_value[k], 6).text,
                ink_sign(ink, test->edge_sign[k]).text);
}

static void print_inside_test(const WalkthroughText *text, const Event *event)
{
    const Ink *ink = &text->ink;
    const FaceTest *test = &event->as.hit.test;
    int number = event->as.hit.step + 1;
    ink_line(ink, "\n    Inside? For each edge e = v[k+1] - v[k] and c = P%d - v[k],\tthe sign of N.(e x c):\n",
             number);
    print_edges(ink, &text->walk->scene->faces[event->as.hit.face], test, event->as.hit.point);
    bool zero = false;
    for (int k = 0; k < test->edges; k++)
        zero = zero || test->edge_sign[k] == 0;
    fputc('\n', ink->out);
    ink_paragraph(ink,
                  zero
                      ? "    No sign is -, and 0 is on the edge's own line, which counts as inside: P%d is on the face."
                      : "    No sign is -: P%d is on the face.",
                  number);
}

static void print_shift(const WalkthroughText *text, const Event *event)
{
    const Ink *ink = &text->ink;
    int number = event->as.hit.step + 1;
    Vec3 normal = event->as.hit.normal;
    double shift = vec3_dot(normal, vec3_sub(event->as.hit.shifted, event->as.hit.point));
    if (event->as.hit.test.n_dot_r > 0)
        ink_paragraph(ink, "    N.R > 0, the ray came from behind: from here N is turned to its side, N = %s.",
                      ink_vector(normal, 6).text);
    if (text->rounding)
        ink_paragraph(ink, "    Rays that leave start at P%d' = P%d + %s N.", number, number,
                      ink_number((double)text->rounding->shift, 6).text);
    else
        ink_paragraph(ink,
                      "    Rays that leave start at P%d' = P%d %c %s N, which rounding cannot put behind the face.",
                      number, number, shift < 0 ? '-' : '+', ink_number(fabs(shift), 3).text);
}

void walkthrough_text_hit(WalkthroughText *text, const Event *event)
{
    const Scene *scene = text->walk->scene;
    int number = event->as.hit.step + 1;
    const Face *face = &scene->faces[event->as.hit.face];
    fputc('\n', text->ink.out);
    WalkthroughPiece piece = walkthrough_piece(scene, event->as.hit.face);
    InkText of = {""};
    if (piece.count > 1)
        of = ink_text("piece %d of %d of ", piece.number, piece.count);
    ink_paragraph(&text->ink, "    The nearest is %sface %d, %s, material %s:", of.text, face->number,
                  walkthrough_face_words(scene, event->as.hit.face, 40).text,
                  ink_name(scene->materials[face->material].name, 24).text);
    fputc('\n', text->ink.out);
    print_normal(text, event);
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

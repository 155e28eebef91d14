/* What textbook arithmetic finds and what is exactly so, below each other. */
#include "walkthrough/rounding_rows.h"

#include <math.h>

/* As many digits as the precision tells apart. */
static int digits_of(const RoundingRows *rows)
{
    return rows->rounding->precision == PRECISION_FLOAT ? 9 : 17;
}

static InkText apart(double difference)
{
    return difference == 0 ? ink_text("the same") : ink_text("%s apart", rounding_size(difference).text);
}

static void print_two(const RoundingRows *rows, const char *name, InkText textbook, InkText exact, double difference)
{
    ink_line(&rows->ink, "    %-4s textbook  %s", name, textbook.text);
    ink_line(&rows->ink, "         exact     %s,\t%s", exact.text, apart(difference).text);
}

void rounding_vector_rows(const RoundingRows *rows, const char *name, Vec3 textbook, Vec3 exact)
{
    print_two(rows, name, ink_vector(textbook, digits_of(rows)), ink_vector(exact, digits_of(rows)),
              vec3_length(vec3_sub(textbook, exact)));
}

/* --- A hit --- */

static InkText world(const RoundingRows *rows, Vec3 point)
{
    return ink_vector(walkthrough_world(rows->rounding->walk->scene, point), digits_of(rows));
}

static InkText above_words(double above)
{
    if (above == 0)
        return ink_text("in its face's plane");
    return ink_text("%s %s its face", rounding_size(above).text, above < 0 ? "below" : "above");
}

static InkText face_at(const RoundingRows *rows, const RoundingHit *hit)
{
    if (hit->face < 0)
        return ink_text("no face: the background shines in");
    return ink_text("%s at t = %s", rounding_face(rows->rounding, hit->face).text,
                    ink_number(hit->t, digits_of(rows)).text);
}

static void print_points(const RoundingRows *rows, const RoundingHit *found, const RoundingHit *right, int number)
{
    print_two(rows, ink_text("P%d", number).text, world(rows, found->point), world(rows, right->point),
              vec3_length(vec3_sub(found->point, right->point)));
    ink_line(&rows->ink, "    %-4s textbook  %s,\t%s", ink_text("P%d'", number).text, world(rows, found->shifted).text,
             above_words(found->above).text);
    ink_line(&rows->ink, "         exact     %s,\t%s", world(rows, right->shifted).text,
             above_words(right->above).text);
}

void rounding_hit_rows(const RoundingRows *rows, int k, bool with_face)
{
    const RoundingHit *found = &rows->rounding->textbook.hits[k], *right = &rows->rounding->exact.hits[k];
    bool points = rounding_same_face(rows->rounding, k) && found->face >= 0;
    if (with_face && points) {
        print_two(rows, "face", face_at(rows, found), face_at(rows, right), found->t - right->t);
    } else if (with_face) {
        ink_line(&rows->ink, "    face textbook  %s", face_at(rows, found).text);
        ink_line(&rows->ink, "         exact     %s", face_at(rows, right).text);
    } else if (points) {
        print_two(rows, "t", ink_number(found->t, digits_of(rows)), ink_number(right->t, digits_of(rows)),
                  found->t - right->t);
    }
    if (points)
        print_points(rows, found, right, k + 1);
}

/* --- A light --- */

static InkText verdict_at(const RoundingRows *rows, const RoundingHit *hit, int light)
{
    const RoundingLight *found = &hit->lights[light];
    InkText blocker = rounding_face(rows->rounding, found->blocker);
    if (found->verdict == LIGHT_REACHES)
        return ink_text("nothing is in the way");
    if (found->verdict == LIGHT_BEHIND_FACE)
        return found->height == 0 ? ink_text("in the face's plane") : ink_text("behind the face");
    return ink_text("%s is in the way%s", blocker.text, found->blocker == hit->face ? ", the point's own face" : "");
}

void rounding_light_rows(const RoundingRows *rows, int k, int light)
{
    const RoundingHit *found = &rows->rounding->textbook.hits[k], *right = &rows->rounding->exact.hits[k];
    ink_line(&rows->ink, "    %-4s textbook  N.(light - P%d) = %s:\t%s", ink_text("L%d", light).text, k + 1,
             ink_number(found->lights[light].height, digits_of(rows)).text, verdict_at(rows, found, light).text);
    ink_line(&rows->ink, "         exact     N.(light - v0) = %s:\t%s",
             ink_number(right->lights[light].height, digits_of(rows)).text, verdict_at(rows, right, light).text);
}

/* --- Sentences --- */

void rounding_part_rows(const RoundingRows *rows, RoundingPart part)
{
    ink_hanging(&rows->ink, 4, "    textbook: %s;", rounding_textbook_words(rows->rounding, part).text);
    ink_hanging(&rows->ink, 4, "    exactly: %s.", rounding_exact_words(rows->rounding, part).text);
}

static InkText bytes(const unsigned char *rgb)
{
    return ink_text("(%d, %d, %d)", rgb[0], rgb[1], rgb[2]);
}

void rounding_pixel_row(const RoundingRows *rows)
{
    const Rounding *rounding = rows->rounding;
    ink_line(&rows->ink, "Pixel (%d, %d) = %s in textbook arithmetic, %s exactly", rounding->walk->request.column,
             rounding->walk->request.row, bytes(rounding->textbook.rgb).text, bytes(rounding->exact.rgb).text);
}

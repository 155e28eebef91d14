/* Polygons cut into convex pieces: closed forms, then random polygons against their exact coverage.
 * RECTRAY_SOAK=1 tries 10000 of them. */
#include "scene/polygon_cut.h"

#include "support/polygon.h"
#include "support/random_polygon.h"
#include "support/xorshift.h"

#include "unity.h"

#include <stdlib.h>

static PolygonCut cut;
static Error error;

void setUp(void)
{
    error = (Error){.kind = ERROR_NONE};
}

void tearDown(void)
{
    polygon_cut_free(&cut);
}

/* --- Closed forms --- */

/* x, y pairs in the plane z = 0. */
static void cut_flat(const double *xy, int count)
{
    Vec3 points[16];
    for (int i = 0; i < count; i++)
        points[i] = vec3(xy[2 * i], xy[2 * i + 1], 0);
    TEST_ASSERT_TRUE(polygon_cut(&cut, points, count, false, &error));
}

static void assert_piece(int piece, int count, const int *corners)
{
    TEST_ASSERT_TRUE(piece < cut.ring.piece_count);
    TEST_ASSERT_EQUAL(count, cut.ring.pieces[piece].count);
    TEST_ASSERT_EQUAL_INT_ARRAY(corners, cut.ring.pieces[piece].corners, count);
}

static void assert_good(int pieces)
{
    TEST_ASSERT_EQUAL(POLYGON_GOOD, cut.verdict);
    TEST_ASSERT_EQUAL(pieces, cut.ring.piece_count);
}

static void convex_polygons_should_make_half_as_many_pieces(void)
{
    double circle[32];
    for (int count = 3; count <= 16; count++) {
        for (int i = 0; i < count; i++) {
            circle[2 * i] = cos(6.283185307179586 * i / count);
            circle[2 * i + 1] = sin(6.283185307179586 * i / count);
        }
        cut_flat(circle, count);
        assert_good((count - 1) / 2);
    }
}

static void good_faces_should_stay_whole(void)
{
    cut_flat((const double[]){0, 0, 1, 0, 1, 1, 0, 1}, 4);
    assert_good(1);
    assert_piece(0, 4, (const int[]){0, 1, 2, 3});
    cut_flat((const double[]){0, 0, 1, 0, 1, 1}, 3);
    assert_good(1);
    assert_piece(0, 3, (const int[]){0, 1, 2});
}

static void an_inward_corner_should_be_an_end_of_the_cut(void)
{
    cut_flat((const double[]){-1, 0, 0, 0.9, 1, 0, 0, 2}, 4); /* inward at vertex 1 */
    assert_good(2);
    assert_piece(0, 3, (const int[]){0, 1, 3});
    assert_piece(1, 3, (const int[]){1, 2, 3});
    cut_flat((const double[]){0, 2, -1, 0, 0, 0.9, 1, 0}, 4); /* at vertex 2 */
    assert_good(2);
    assert_piece(0, 3, (const int[]){0, 1, 2});
    assert_piece(1, 3, (const int[]){0, 2, 3});
}

static void a_bent_quad_should_be_cut_from_0_to_2_where_that_is_inside(void)
{
    const Vec3 points[4] = {{0, 0, 0}, {2, 0, 0}, {2, 3, 1}, {0, 2, 0}};
    TEST_ASSERT_TRUE(polygon_cut(&cut, points, 4, false, &error));
    TEST_ASSERT_EQUAL(POLYGON_NOT_PLANAR, cut.verdict);
    TEST_ASSERT_TRUE(polygon_cut(&cut, points, 4, true, &error));
    assert_good(2);
    assert_piece(0, 3, (const int[]){0, 1, 2});
    assert_piece(1, 3, (const int[]){0, 2, 3});
}

static void letters_should_be_cut_into_few_quads(void)
{
    cut_flat((const double[]){0, 0, 2, 0, 2, 1, 1, 1, 1, 2, 0, 2}, 6); /* L */
    assert_good(2);
    cut_flat((const double[]){0, 0, 3, 0, 3, 1, 2, 1, 2, 3, 1, 3, 1, 1, 0, 1}, 8); /* T */
    TEST_ASSERT_EQUAL(POLYGON_GOOD, cut.verdict);
    TEST_ASSERT_TRUE(cut.ring.piece_count <= 4);
    cut_flat((const double[]){0, 0, 3, 0, 3, 1, 1, 1, 1, 2, 3, 2, 3, 3, 0, 3}, 8); /* U */
    TEST_ASSERT_EQUAL(POLYGON_GOOD, cut.verdict);
    TEST_ASSERT_TRUE(cut.ring.piece_count <= 4);
}

static double area_of_pieces(const double *xy)
{
    double sum = 0;
    for (int i = 0; i < cut.ring.piece_count; i++)
        for (int k = 0; k < cut.ring.pieces[i].count; k++) {
            int a = cut.ring.pieces[i].corners[k], b = cut.ring.pieces[i].corners[(k + 1) % cut.ring.pieces[i].count];
            sum += (xy[2 * a] * xy[2 * b + 1] - xy[2 * b] * xy[2 * a + 1]) / 2;
        }
    return sum;
}

static void a_hole_should_be_cut_out_along_its_bridge(void)
{
    static const double frame[] = {0, 0, 4, 0, 4, 4, 0, 4, 0, 0, 1, 1, 1, 3, 3, 3, 3, 1, 1, 1};
    cut_flat(frame, 10);
    TEST_ASSERT_EQUAL(POLYGON_GOOD, cut.verdict);
    TEST_ASSERT_TRUE(area_of_pieces(frame) == 12);
    TEST_ASSERT_EQUAL(-1, cut.ring.fold);
}

static void crossing_edges_should_be_named(void)
{
    static const double star[] = {0, 3, 2, -3, -3, 1, 3, 1, -2, -3}, bow[] = {0, 0, 1, 1, 1, 0, 0, 1};
    static const double bow_of_six[] = {0, 0, 4, 4, 4, 2, 4, 0, 0, 4, 0, 2};
    cut_flat(star, 5); /* goes round twice */
    TEST_ASSERT_EQUAL(POLYGON_CROSSED, cut.verdict);
    TEST_ASSERT_EQUAL(0, cut.first);
    TEST_ASSERT_EQUAL(2, cut.second);
    cut_flat(bow, 4);
    TEST_ASSERT_EQUAL(POLYGON_CROSSED, cut.verdict);
    TEST_ASSERT_EQUAL(0, cut.first);
    TEST_ASSERT_EQUAL(2, cut.second);
    cut_flat(bow_of_six, 6);
    TEST_ASSERT_EQUAL(POLYGON_CROSSED, cut.verdict);
    TEST_ASSERT_EQUAL(0, cut.first);
    TEST_ASSERT_EQUAL(3, cut.second);
}

static void crossing_at_a_vertex_should_be_found(void)
{
    static const double eight[] = {0, 0, 2, 2, 4, 0, 4, 4, 2, 2, 0, 4}, twice[] = {0, 0, 1, 0, 0, 1, 0, 0, 1, 0, 0, 1};
    cut_flat(eight, 6);
    TEST_ASSERT_EQUAL(POLYGON_GOOD, cut.verdict); /* the two halves only meet */
    cut_flat((const double[]){0, 0, 2, 2, 4, 4, 4, 0, 2, 2, 0, 4}, 6);
    TEST_ASSERT_EQUAL(POLYGON_CROSSED, cut.verdict);
    cut_flat(twice, 6);
    TEST_ASSERT_EQUAL(POLYGON_CROSSED, cut.verdict);
}

static void folds_should_be_left_out_and_told(void)
{
    static const double spike[] = {0, 0, 2, 0, 2, 2, 2, 5, 2, 2, 0, 2};
    cut_flat(spike, 6);
    TEST_ASSERT_EQUAL(POLYGON_GOOD, cut.verdict);
    TEST_ASSERT_TRUE(area_of_pieces(spike) == 4);
    TEST_ASSERT_EQUAL(3, cut.ring.fold);
    cut_flat((const double[]){0, 0, 2, 0, 1, 0, 1, 1}, 4);
    assert_good(1);
    TEST_ASSERT_EQUAL(1, cut.ring.fold);
}

static void faces_without_area_should_be_told(void)
{
    cut_flat((const double[]){0, 0, 1, 1, 3, 3, 2, 2, 7, 7}, 5);
    TEST_ASSERT_EQUAL(POLYGON_NO_AREA, cut.verdict);
    cut_flat((const double[]){0, 0, 1, 0, 0, 0, 0, 1}, 4); /* there and back, twice */
    TEST_ASSERT_EQUAL(POLYGON_NO_AREA, cut.verdict);
    cut_flat((const double[]){0.1, 0.1, 0.2, 0.2, 0.3, 0.3}, 3);
    TEST_ASSERT_EQUAL(POLYGON_NO_AREA, cut.verdict);
}

static void any_size_should_be_cut_alike(void)
{
    static const double frame[] = {0, 0, 4, 0, 4, 4, 3, 4, 2, 1, 1, 4, 0, 4};
    for (int exponent = -400; exponent <= 500; exponent += 100) {
        Vec3 points[7];
        for (int i = 0; i < 7; i++)
            points[i] = vec3_ldexp(vec3(frame[2 * i], frame[2 * i + 1], 1), exponent);
        TEST_ASSERT_TRUE(polygon_cut(&cut, points, 7, false, &error));
        assert_good(3);
    }
}

static void repeats_should_be_dropped_around_the_polygon(void)
{
    const Vec3 a = {1, 2, 3}, b = {1, 2, 4}, c = {0, 2, 3};
    const Vec3 points[7] = {a, a, b, b, b, c, a};
    int numbers[7] = {0, 1, 2, 3, 4, 5, 6};
    TEST_ASSERT_EQUAL(3, polygon_drop_repeats(points, numbers, 7));
    TEST_ASSERT_EQUAL_INT_ARRAY(((const int[]){0, 2, 5}), numbers, 3);
    int same[3] = {0, 1, 6};
    TEST_ASSERT_EQUAL(1, polygon_drop_repeats(points, same, 3));
}

/* --- Exact coverage --- */

/* A square of the grid, which is given to polygon.h as its pixel. */
typedef struct Window {
    int64_t x, y, size;
} Window;

/* The left side of the line from a to b, in the window. */
static void set_line(Line *line, const GridPolygon *p, int a, int b, const Window *window)
{
    int64_t dx = p->x[b] - p->x[a], dy = p->y[b] - p->y[a];
    mpq_set_si(line->at[0], dx * (window->y - p->y[a]) - dy * (window->x - p->x[a]), 1);
    mpq_set_si(line->at[1], -dy * window->size, 1);
    mpq_set_si(line->at[2], dx * window->size, 1);
}

/* Changes the pieces to what of them is left of all edges, or to the rest. */
static void divide(Pieces *pieces, const GridPolygon *p, const PolygonPiece *piece, const Window *window, bool keep)
{
    Line lines[4];
    const Line *edges[4];
    for (int i = 0; i < piece->count; i++) {
        line_init(&lines[i]);
        set_line(&lines[i], p, piece->corners[i], piece->corners[(i + 1) % piece->count], window);
        edges[i] = &lines[i];
    }
    if (keep)
        pieces_keep(pieces, edges, piece->count);
    else
        pieces_subtract(pieces, edges, piece->count);
    for (int i = 0; i < piece->count; i++)
        line_clear(&lines[i]);
}

/* The share of the window that the piece covers. */
static double covered_by(const GridPolygon *p, PolygonPiece piece, const Window *window)
{
    Pieces pieces = pieces_pixel();
    divide(&pieces, p, &piece, window, true);
    double area = pieces_area(&pieces);
    pieces_free(&pieces);
    return area;
}

static int64_t area2_of(const GridPolygon *p, int a, int b, int c)
{
    return (p->x[b] - p->x[a]) * (p->y[c] - p->y[a]) - (p->y[b] - p->y[a]) * (p->x[c] - p->x[a]);
}

/* How often the boundary goes round a point, on average over the window: triangles at vertex 0, each with its sense. */
static double winding_in(const GridPolygon *p, const Window *window)
{
    double sum = 0;
    for (int i = 2; i < p->count; i++) {
        int64_t area = area2_of(p, 0, i - 1, i);
        if (area > 0)
            sum += covered_by(p, (PolygonPiece){{0, i - 1, i}, 3}, window);
        else if (area < 0)
            sum -= covered_by(p, (PolygonPiece){{0, i, i - 1}, 3}, window);
    }
    return sum;
}

static double pieces_in(const GridPolygon *p, const Window *window)
{
    double sum = 0;
    for (int i = 0; i < cut.ring.piece_count; i++)
        sum += covered_by(p, cut.ring.pieces[i], window);
    return sum;
}

/* The share of the window that no piece covers. */
static double free_in(const GridPolygon *p, const Window *window)
{
    Pieces pieces = pieces_pixel();
    for (int i = 0; i < cut.ring.piece_count; i++)
        divide(&pieces, p, &cut.ring.pieces[i], window, false);
    double area = pieces_area(&pieces);
    pieces_free(&pieces);
    return area;
}

static int64_t area2_of_piece(const GridPolygon *p, const PolygonPiece *piece)
{
    const int *c = piece->corners;
    return area2_of(p, c[0], c[1], c[2]) + (piece->count == 4 ? area2_of(p, c[0], c[2], c[3]) : 0);
}

/* All pieces turn as the polygon does, have its area together, and cover in each window what it covers, once. */
static void assert_covers(const GridPolygon *p, uint64_t *random)
{
    static const int64_t shares[] = {1, 7, 31};
    int64_t area = 0;
    for (int i = 0; i < cut.ring.piece_count; i++) {
        int64_t piece = area2_of_piece(p, &cut.ring.pieces[i]);
        TEST_ASSERT_TRUE(piece > 0);
        area += piece;
    }
    TEST_ASSERT_TRUE(area == grid_polygon_area2(p));
    for (int i = 0; i < 3; i++) {
        int64_t size = GRID_POLYGON_SIZE / shares[i];
        uint64_t room = (uint64_t)(GRID_POLYGON_SIZE - size + 1);
        Window window = {(int64_t)(random_next(random) % room), (int64_t)(random_next(random) % room), size};
        TEST_ASSERT_DOUBLE_WITHIN(1e-13, winding_in(p, &window), pieces_in(p, &window));
        if (p->count < 16)
            TEST_ASSERT_DOUBLE_WITHIN(1e-13, 1 - winding_in(p, &window), free_in(p, &window));
    }
}

/* In space, exactly: the axes are whole numbers, and the grid is 2^-20 of them. */
static void cut_in_space(GridPolygon *p, uint64_t *random)
{
    if (grid_polygon_area2(p) < 0) /* the normal is on the other side */
        for (int i = 0; i < p->count; i++) {
            int64_t x = p->x[i];
            p->x[i] = p->y[i];
            p->y[i] = x;
        }
    double c[9];
    for (int i = 0; i < 9; i++)
        c[i] = (double)random_integer(random, 9);
    Vec3 across = vec3(c[0], c[1], 10), up = vec3(c[3], 10, c[5]), corner = vec3(c[6], c[7], c[8]), points[64];
    for (int i = 0; i < p->count; i++)
        points[i] = vec3_add(corner, vec3_add(vec3_scale((double)p->x[i] / GRID_POLYGON_SIZE, across),
                                              vec3_scale((double)p->y[i] / GRID_POLYGON_SIZE, up)));
    TEST_ASSERT_TRUE(polygon_cut(&cut, points, p->count, false, &error));
}

/* What the verdict on the polygon may be. A boundary that touches itself may cross itself there. */
static void assert_verdict(const GridPolygon *p)
{
    if (grid_polygon_crosses(p)) {
        TEST_ASSERT_EQUAL(POLYGON_CROSSED, cut.verdict);
        TEST_ASSERT_TRUE(grid_edges_cross(p, cut.first, cut.second));
    } else if (!grid_polygon_touches(p)) {
        TEST_ASSERT_EQUAL(POLYGON_GOOD, cut.verdict);
        TEST_ASSERT_TRUE(cut.ring.piece_count <= p->count - 2);
    }
}

static void random_polygons_should_be_covered_exactly(void)
{
    uint64_t random = 21;
    int cases = getenv("RECTRAY_SOAK") ? 10000 : 150, good[GRID_POLYGON_KINDS] = {0};
    for (int i = 0; i < cases; i++) {
        int kind = i % GRID_POLYGON_KINDS;
        GridPolygon p = grid_polygon((GridPolygonKind)kind, &random);
        cut_in_space(&p, &random);
        assert_verdict(&p);
        if (cut.verdict == POLYGON_GOOD) {
            assert_covers(&p, &random);
            good[kind]++;
        }
    }
    for (int kind = 0; kind < GRID_WILD; kind++)
        TEST_ASSERT_TRUE(2 * good[kind] > cases / GRID_POLYGON_KINDS);
}

int main(void)
{
    UNITY_BEGIN();
    RUN_TEST(convex_polygons_should_make_half_as_many_pieces);
    RUN_TEST(good_faces_should_stay_whole);
    RUN_TEST(an_inward_corner_should_be_an_end_of_the_cut);
    RUN_TEST(a_bent_quad_should_be_cut_from_0_to_2_where_that_is_inside);
    RUN_TEST(letters_should_be_cut_into_few_quads);
    RUN_TEST(a_hole_should_be_cut_out_along_its_bridge);
    RUN_TEST(crossing_edges_should_be_named);
    RUN_TEST(crossing_at_a_vertex_should_be_found);
    RUN_TEST(folds_should_be_left_out_and_told);
    RUN_TEST(faces_without_area_should_be_told);
    RUN_TEST(any_size_should_be_cut_alike);
    RUN_TEST(repeats_should_be_dropped_around_the_polygon);
    RUN_TEST(random_polygons_should_be_covered_exactly);
    return UNITY_END();
}

/* Which pixels of a tile there are, and how their colours come into the picture. */
#include "shared/compiler.cl"
#include "shared/layout.h"
#include "shared/precision.cl"
#include "packet/bytes.cl"
#include "packet/camera.cl"
#include "packet/lanes.cl"
#include "packet/vectors.cl"

/* Which pixels of packet k of the tile are in the band. */
INLINE Mask pixels_inside(constant const Parameters *p, int first_column, int first_row, int k)
{
    if (first_column + TILE_COLUMNS <= p->columns && first_row + TILE_ROWS <= p->band_rows)
        return (Mask)-1;
    Mask number = lane_numbers();
    Mask column = first_column + PACKET_COLUMN(k) + number % PACKET_COLUMNS;
    Mask row = first_row + PACKET_ROW(k) + number / PACKET_COLUMNS;
    return IS(column < (Mask)p->columns) & IS(row < (Mask)p->band_rows);
}

#ifdef LINEAR
/* Puts a colour at that place of the picture. */
static void store_pixel(global uchar *picture, int place, real red, real green, real blue)
{
    global real *out = (global real *)picture + (size_t)place * 3;
    out[0] = red;
    out[1] = green;
    out[2] = blue;
}

/* With this build option the picture is three reals a pixel, as they are, instead of three bytes. */
INLINE void store_packet(global uchar *picture, constant const Parameters *p, int first_column, int first_row, Vec colour)
{
    real red[LANES], green[LANES], blue[LANES];
    STORE(colour.x, red);
    STORE(colour.y, green);
    STORE(colour.z, blue);
    for (int lane = 0; lane < LANES; lane++) {
        int column = first_column + lane % PACKET_COLUMNS, row = first_row + lane / PACKET_COLUMNS;
        if (column >= p->columns || row >= p->band_rows)
            continue;
        global real *out = (global real *)picture + ((size_t)row * (size_t)p->columns + (size_t)column) * 3;
        out[0] = red[lane];
        out[1] = green[lane];
        out[2] = blue[lane];
    }
}
#else
static void store_pixel(global uchar *rgb, int place, real red, real green, real blue)
{
    global uchar *out = rgb + (size_t)place * 3;
    out[0] = value_to_byte(red);
    out[1] = value_to_byte(green);
    out[2] = value_to_byte(blue);
}

/* Numbers that lie at any address: vstore8 of bytes stores them one by one. */
typedef struct __attribute__((packed)) Bytes8 {
    ulong value;
} Bytes8;

typedef struct __attribute__((packed)) Bytes4 {
    uint value;
} Bytes4;

/* Four pixels side by side. */
INLINE void store_four(int4 packed, global uchar *out)
{
    uchar16 bytes = as_uchar16(packed);
    ulong2 rows = as_ulong2(bytes.s01245689acdeffff);
    ((global Bytes8 *)out)->value = rows.x;
    ((global Bytes4 *)(out + 8))->value = (uint)rows.y;
}

INLINE void store_packet(global uchar *rgb, constant const Parameters *p, int first_column, int first_row, Vec colour)
{
    /* Red is the lowest byte of a pixel's number. */
    IntLanes packed = colour_to_byte(colour.x) | colour_to_byte(colour.y) << 8 | colour_to_byte(colour.z) << 16;
    int columns = min(PACKET_COLUMNS, p->columns - first_column), rows = min(PACKET_ROWS, p->band_rows - first_row);
#if LANES == 16 && defined(__ENDIAN_LITTLE__)
    if (columns == 4 && rows == 4) {
        global uchar *out = rgb + ((size_t)first_row * (size_t)p->columns + (size_t)first_column) * 3;
        size_t stride = (size_t)p->columns * 3;
        store_four(packed.s0123, out);
        store_four(packed.s4567, out + stride);
        store_four(packed.s89ab, out + 2 * stride);
        store_four(packed.scdef, out + 3 * stride);
        return;
    }
#endif
    int pixels[LANES];
    STORE(packed, pixels);
    for (int row = 0; row < rows; row++) {
        global uchar *out = rgb + ((size_t)(first_row + row) * (size_t)p->columns + (size_t)first_column) * 3;
        const int *in = pixels + row * PACKET_COLUMNS;
        for (int column = 0; column < columns; column++) {
            out[3 * column] = (uchar)in[column];
            out[3 * column + 1] = (uchar)(in[column] >> 8);
            out[3 * column + 2] = (uchar)(in[column] >> 16);
        }
    }
}
#endif

/* The means of the samples' sums. */
INLINE void store_tile(constant const Parameters *p, int first_column, int first_row, const Vec *sum, global uchar *rgb)
{
    real samples = (real)p->grid * (real)p->grid;
    EACH_PACKET(k) {
        Vec mean = samples > 1 ? vec(sum[k].x / samples, sum[k].y / samples, sum[k].z / samples) : sum[k];
        store_packet(rgb, p, first_column + PACKET_COLUMN(k), first_row + PACKET_ROW(k), mean);
    }
}

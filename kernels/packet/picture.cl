/* How colours come into the picture. A packet of 16 pixels is stored in four rows of twelve bytes. */
#include "shared/compiler.cl"
#include "shared/layout.h"
#include "shared/precision.cl"
#include "packet/bytes.cl"
#include "packet/lanes.cl"
#include "packet/tiles.cl"
#include "packet/vectors.cl"

/* A channel of a pixel: a byte. With the build option LINEAR it is the colour itself, a real. */
#if LINEAR
typedef real Channel;
typedef real Level;
#define TO_LEVEL(c) (c)
#define TO_LEVELS(c) (c)
#else
typedef uchar Channel;
typedef int Level;
#define TO_LEVEL(c) value_to_byte(c)
#define TO_LEVELS(c) colour_to_byte(c)
#endif

/* Puts a colour at that place of the picture. */
static void store_pixel(global uchar *picture, int place, real red, real green, real blue)
{
    global Channel *out = (global Channel *)picture + (size_t)place * 3;
    out[0] = TO_LEVEL(red);
    out[1] = TO_LEVEL(green);
    out[2] = TO_LEVEL(blue);
}

/* Numbers that lie at any address: vstore8 of bytes stores them one by one. */
typedef struct __attribute__((packed)) Bytes8 {
    ulong value;
} Bytes8;

typedef struct __attribute__((packed)) Bytes4 {
    uint value;
} Bytes4;

/* Stores four pixels side by side. Red is the lowest byte of a pixel's number. */
INLINE void store_four(int4 pixels, global uchar *out)
{
    uchar16 bytes = as_uchar16(pixels);
    ulong2 rows = as_ulong2(bytes.s01245689acdeffff);
    ((global Bytes8 *)out)->value = rows.x;
    ((global Bytes4 *)(out + 8))->value = (uint)rows.y;
}

/* Puts the colours of a packet into the picture, as far as its pixels are in the band. */
INLINE void store_packet(global uchar *picture, constant const Parameters *p, int first_column, int first_row,
                         Vec colour)
{
    int columns = min(PACKET_COLUMNS, p->band_columns - first_column);
    int rows = min(PACKET_ROWS, p->band_rows - first_row);
    size_t place = (size_t)first_row * (size_t)p->band_columns + (size_t)first_column;
#if LANES == 16 && defined(__ENDIAN_LITTLE__) && !LINEAR
    if (columns == 4 && rows == 4) {
        int16 pixels = colour_to_byte(colour.x) | colour_to_byte(colour.y) << 8 | colour_to_byte(colour.z) << 16;
        global uchar *out = picture + place * 3;
        size_t stride = (size_t)p->band_columns * 3;
        store_four(pixels.s0123, out);
        store_four(pixels.s4567, out + stride);
        store_four(pixels.s89ab, out + 2 * stride);
        store_four(pixels.scdef, out + 3 * stride);
        return;
    }
#endif
    Level red[LANES], green[LANES], blue[LANES];
    STORE(TO_LEVELS(colour.x), red);
    STORE(TO_LEVELS(colour.y), green);
    STORE(TO_LEVELS(colour.z), blue);
    for (int row = 0; row < rows; row++)
        for (int column = 0; column < columns; column++) {
            int lane = row * PACKET_COLUMNS + column;
            global Channel *out =
                (global Channel *)picture + (place + (size_t)row * (size_t)p->band_columns + (size_t)column) * 3;
            out[0] = (Channel)red[lane];
            out[1] = (Channel)green[lane];
            out[2] = (Channel)blue[lane];
        }
}

/* Stores the means of the pixels' samples. sum: of all samples of a pixel. */
INLINE void store_tile(constant const Parameters *p, int first_column, int first_row, const Vec *sum, global uchar *rgb)
{
    real samples = (real)p->grid * (real)p->grid;
    EACH_PACKET(k) {
        Vec mean = samples > 1 ? vec(sum[k].x / samples, sum[k].y / samples, sum[k].z / samples) : sum[k];
        store_packet(rgb, p, first_column + PACKET_COLUMN(k), first_row + PACKET_ROW(k), mean);
    }
}

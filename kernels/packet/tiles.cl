/* How the picture is cut: pixels make packets, packets make tiles, tiles make blocks.
 *
 *     packet  PACKET_COLUMNS x PACKET_ROWS = LANES pixels: the lanes of a vector
 *     tile    PACKETS packets, PACKETS_ACROSS of them side by side: their rays are searched together
 *     block   BLOCK_ACROSS x BLOCK_ACROSS tiles: one work-item renders it
 *
 * All these are build options. With 8 x 8 pixels, the ladder of scenes takes 19.7 ms in the mean, with 8 x 4 pixels
 * 20.8, with 16 x 8 pixels 20.0. */
#include "shared/compiler.cl"
#include "shared/layout.h"
#include "packet/lanes.cl"

enum { TILE_COLUMNS = PACKETS_ACROSS * PACKET_COLUMNS, TILE_ROWS = PACKETS / PACKETS_ACROSS * PACKET_ROWS };

/* Where packet k begins in its tile. */
#define PACKET_COLUMN(k) ((k) % PACKETS_ACROSS * PACKET_COLUMNS)
#define PACKET_ROW(k) ((k) / PACKETS_ACROSS * PACKET_ROWS)

/* The pixels of packet k of the tile that are in the band. */
INLINE Mask pixels_inside(constant const Parameters *p, int first_column, int first_row, int k)
{
    if (first_column + TILE_COLUMNS <= p->band_columns && first_row + TILE_ROWS <= p->band_rows)
        return (Mask)-1;
    Mask number = lane_numbers();
    Mask column = first_column + PACKET_COLUMN(k) + number % PACKET_COLUMNS;
    Mask row = first_row + PACKET_ROW(k) + number / PACKET_COLUMNS;
    return IS(column < (Mask)p->band_columns) & IS(row < (Mask)p->band_rows);
}

enum { BLOCK_COLUMNS = BLOCK_ACROSS * TILE_COLUMNS, BLOCK_ROWS = BLOCK_ACROSS * TILE_ROWS };

#define BLOCKS_ACROSS(p) (((p)->band_columns + BLOCK_COLUMNS - 1) / BLOCK_COLUMNS)

/* A rectangle of pixels of the band. */
typedef struct Area {
    int column, row;
    int columns, rows; /* 0 or less: it is empty */
} Area;

/* Area 0 of a block is all of it. Areas 1 to 4 are its quarters, where it has several tiles. */
enum { BLOCK_AREAS = BLOCK_ACROSS > 1 ? 5 : 1 };

/* Area k of a block, as far as it is in the band. */
INLINE Area area_of_block(constant const Parameters *p, int block, int k)
{
    int share = k == 0 ? 1 : 2, columns = BLOCK_COLUMNS / share, rows = BLOCK_ROWS / share;
    Area area;
    area.column = block % BLOCKS_ACROSS(p) * BLOCK_COLUMNS + (k > 0 ? (k - 1) % 2 * columns : 0);
    area.row = block / BLOCKS_ACROSS(p) * BLOCK_ROWS + (k > 0 ? (k - 1) / 2 * rows : 0);
    area.columns = min(columns, p->band_columns - area.column);
    area.rows = min(rows, p->band_rows - area.row);
    return area;
}

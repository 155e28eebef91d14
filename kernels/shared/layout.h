/* The data that the host and the kernels share: one header, compiled by both languages.
 * Structs hold 4-byte scalars only, so that no compiler pads them. Their sizes are checked when a kernel is built.
 * Everything real-valued travels as rows of `real`, float or double as a build option says. The enums name the columns.
 * A value that needs more than a float is split in the float kernel: value = NAME + NAME_LOW. */
#include "skips.h"
#ifndef RECTRAY_LAYOUT_H
#define RECTRAY_LAYOUT_H

/* What a ray needs of a face only once it has hit it: half of a cache line. */
typedef struct FaceRecord {
    int material; /* its number, and FACE_FLAT */
    int index;    /* the face's place in the scene; on the device, faces stand in the order of the tree's leaves */
    float box[6]; /* of face_box: low x, high x, low y, ... */
} FaceRecord;

/* The face is across an axis, so that every hit is in its box. */
#define FACE_FLAT 0x40000000

/* The most hits that a path has. */
enum { PATH_MAX = 65 };

/* The numbers that a launch is for. Only the band changes from one launch to the next. A band is a rectangle of the
 * picture's pixels; a row and a column of the band are counted from its top left corner. */
typedef struct Parameters {
    int columns, rows;              /* of the whole picture */
    int first_column, band_columns; /* the columns that this launch renders, */
    int first_row, band_rows;       /* and the rows */
    int grid;           /* columns and rows of cells in a pixel; of refined pixels, the number of samples */
    int face_count, light_count;
    int max_bounces;
    int shadow_ambient; /* 1: a light's ambient term counts in its shadow, too, and the path goes on */
    int viewer_ray;     /* 1: V points back along the ray */
    int ray_count;      /* cast only */
    int refine_first;   /* render_adaptive only: this launch refines the pixels of its list from here on, */
    int refine_count;   /* so many; 0: it renders the pixels' centres */
    int no_skip;        /* bit SKIP_...: that work is done although the scene does not need it */
    int generator;      /* adaptive sampling only, else 0: sample k of a refined pixel is in row k generator mod grid */
    float shift;        /* textbook arithmetic only: how far off its face a point is shifted */
} Parameters;

/* What each ray that comes near a face needs of it. In float it is one cache line. */
enum {
    FACE_VERTICES = 0, /* 4 x, 4 y, 4 z: exactly the float32 vertices of the scene; a triangle repeats its first */
    FACE_NORMAL = 12,  /* 3, unit */
    FACE_BITS = 15,    /* 32 bits: two bounds and three flags */
    FACE_REALS = 16
};

/* The upper half of FACE_BITS is the upper half of a float: no edge has a larger |x|+|y|+|z|.
 * The lower half is the upper half of another float: no vertex is farther from the plane.
 * The flags share these words: the sign bits, and the lowest bit. They can only enlarge the bound. */
#define FACE_TRIANGLE 0x80000000u
#define FACE_ONE_SIDED 0x8000u /* rays that come from behind the normal pass through */
#define FACE_BACK_INSIDE 1u    /* behind it is the inside of a closed box: rays from outside meet a front first */

/* Planes are rows of `wide`: double wherever the device has it. */
enum {
    PLANE_NORMAL = 0, /* 3, unit */
    PLANE_NORMAL_LOW = 3,
    PLANE_ERROR = 6,  /* each component of NORMAL + NORMAL_LOW is at most so far from the exact one */
    PLANE_LENGTH = 7, /* of the cross product of the diagonals */
    PLANE_REALS = 8
};

enum {
    LIGHT_POSITION = 0, /* 3 */
    LIGHT_POSITION_LOW = 3,
    LIGHT_AMBIENT = 6, /* 3, RGB, as the next two */
    LIGHT_DIFFUSE = 9,
    LIGHT_SPECULAR = 12,
    LIGHT_REALS = 16
};

enum {
    MATERIAL_AMBIENT = 0, /* 3, RGB, as the next two */
    MATERIAL_DIFFUSE = 3,
    MATERIAL_SPECULAR = 6,
    MATERIAL_EXPONENT = 9, /* alpha / 4 */
    MATERIAL_REFLECTION = 10,
    MATERIAL_REALS = 12
};

/* Value i is the sum of two numbers: row[i], which is rounded, and row[VIEW_REALS + i], what rounding took away. */
enum {
    VIEW_EYE = 0,
    VIEW_FORWARD = 3, /* times the screen's distance */
    VIEW_RIGHT = 6,
    VIEW_UP = 9,
    VIEW_WIDTH = 12,
    VIEW_HEIGHT = 13,
    VIEW_BACKGROUND = 14, /* 3, RGB */
    VIEW_BRIGHTEST = 17,  /* the most that a hit can add, with all that its mirror shows */
    VIEW_LENGTH = 18,     /* no primary ray's direction is longer */
    VIEW_FARTHEST = 19,   /* no vertex has larger |x|+|y|+|z| */
    VIEW_REALS = 20
};

/* A child of a tree's node is the number of another node, a leaf, or NO_CHILD. A leaf has up to LEAF_MAX faces, or it
 * is one side of a closed box: side 2 axis is the low one, 2 axis + 1 the high one. The key of such a leaf is
 * the same for all leaves of that side. */
enum { NO_CHILD = -2147483647 - 1, LEAF_BITS = 4, LEAF_MASK = (1 << LEAF_BITS) - 1, LEAF_MAX = 8, NO_SIDE_KEY = -1 };
#define LEAF(first, count) (~(((first) << LEAF_BITS) | (count)))
#define SIDE_LEAF(first, side) LEAF(first, LEAF_MAX + 1 + (side))
#define LEAF_FIRST(child) (~(child) >> LEAF_BITS)
#define LEAF_COUNT(child) ((~(child) & LEAF_MASK) <= LEAF_MAX ? ~(child) & LEAF_MASK : 1)
#define LEAF_KEY(child) ((child) & (NO_CHILD | LEAF_MASK))
#define SIDE_KEY(side) LEAF_KEY(SIDE_LEAF(0, side))

/* A node of a k-d tree. The low child of an inner node is the node after it. */
enum {
    KD_AXIS = 0,  /* 0, 1, 2, or KD_LEAF */
    KD_FIRST = 1, /* inner node: the high child; leaf: its first place in the list of faces */
    KD_COUNT = 2, /* leaf: how many faces */
    KD_INTS = 3,
    KD_LEAF = 3
};

/* An entry in the list of the pixels that gpu.cl leaves to gpu_exact.cl, in words of 4 bytes. The samples of a pixel
 * are divided into at most DOUBT_SHARES shares. */
enum {
    DOUBT_PIXEL = 0,      /* its place in the band */
    DOUBT_SHARE_BITS = 1, /* 2 words: a bit for each share that is in doubt */
    DOUBT_SUM = 3,        /* 3 floats: the sum of the other shares' colours */
    DOUBT_WORDS = 6,
    DOUBT_SHARES = 64
};

/* What gpu_adaptive.cl tells gpu_judge.cl of the path through a pixel's centre, in words of 4 bytes: how many hits it
 * has, and their faces, in order. A last one of -1 says that it left the scene. Word k of all pixels of a band stands
 * before word k + 1 of all of them. */
enum { TRAIL_COUNT = 0, TRAIL_FACES = 1 };

/* Counters. There are COUNTER_STRIPES copies, so that work-items seldom wait for one another. The host adds them up. */
enum {
    COUNT_PRIMARY,
    COUNT_SHADOW,
    COUNT_REFLECTION,
    COUNT_FACE_TESTS, /* rays times faces */
    COUNT_BOX_TESTS,  /* bundles of rays times boxes */
    COUNT_SKIPPED,    /* the first of SKIPS_COUNTED kinds */
    COUNTER_KINDS = COUNT_SKIPPED + SKIPS_COUNTED,
    COUNTER_STRIPES = 64,
    COUNTER_STRIDE = 16 /* 4-byte counters from one copy to the next: a cache line */
};

#endif

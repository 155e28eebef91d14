/* The kinds of work that may be left out, in the order of the table in src/trace/skip.c. The host and the kernels
 * compile this. */
#ifndef RECTRAY_SKIPS_H
#define RECTRAY_SKIPS_H

/* The kernels count the first SKIPS_COUNTED. */
enum {
    SKIP_LIGHT_BEHIND,  /* shadow rays: the light is behind the face or in its plane, N.L <= 0 */
    SKIP_LIGHT_AMBIENT, /* shadow rays: the light has an ambient colour only, which counts in its shadow, too */
    SKIP_HIGHLIGHT,     /* specular terms: the material or the light has no specular colour */
    SKIP_WEAK_BOUNCE,   /* reflected rays: all that they could add would not change a byte */
    SKIP_EMPTY_TILE,    /* primary rays: all those of the tile, or of its block, miss all faces */
    SKIP_WHOLE_TILE,    /* searches of rays: all those of the tile meet the same face, or none */
    SKIP_BACK_FACE,     /* face tests: the back of a closed box */
    SKIPS_COUNTED,
    SKIP_LIGHT_BLACK = SKIPS_COUNTED, /* lights without a colour */
    SKIP_UNREACHABLE_FACE,            /* faces that no ray can hit */
    SKIP_MIRRORS,                     /* the look for reflections, where nothing reflects: 1 */
    SKIP_TREE,                        /* the tree, where there are few faces: 1 */
    SKIP_KINDS
};

/* Is that work left out where a scene does not need it? */
#define MAY_SKIP(parameters, skip) (!((parameters)->no_skip >> (skip) & 1))

#endif

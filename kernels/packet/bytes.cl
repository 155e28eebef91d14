/* Colours as bytes: the nearest of 256 levels. */
#include "shared/compiler.cl"
#include "shared/precision.cl"
#include "packet/lanes.cl"

/* floor(255 c + 0.5) of the clamped colour, as in src/scene/light.c. */
INLINE IntLanes colour_to_byte(Lanes c)
{
    c = c > (Lanes)0 ? c : (Lanes)0;
    c = c < (Lanes)1 ? c : (Lanes)1;
    return TO_INT((real)255 * c + (real)0.5f); /* at least 0: cutting off is floor */
}

/* The same for one number. */
INLINE uchar value_to_byte(real c)
{
    c = c > 0 ? c : 0;
    c = c < 1 ? c : 1;
    return (uchar)((real)255 * c + (real)0.5f);
}

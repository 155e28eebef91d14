/* All slips, list behind list. */
#include "grade/slip.h"

#include <stddef.h>

const Slip *slip_number(int number)
{
    const Slip *const lists[] = {slip_camera, slip_face,    slip_edge,   slip_light,
                                 slip_term,   slip_shading, slip_mirror, slip_colour};
    for (size_t i = 0; i < sizeof lists / sizeof *lists; i++)
        for (const Slip *slip = lists[i]; slip->name; slip++)
            if (number-- == 0)
                return slip;
    return NULL;
}

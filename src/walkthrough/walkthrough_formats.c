/* The formats of a walkthrough: their words and their writers. */
#include "walkthrough/walkthrough_formats.h"

const char *const walkthrough_format_words[] = {
    [WALKTHROUGH_TEXT] = "text",
    [WALKTHROUGH_JSON] = "json",
    [WALKTHROUGH_OBJ] = "obj",
    [WALKTHROUGH_SVG] = "svg",
    NULL,
};

WalkthroughWriter *walkthrough_writer(WalkthroughFormat format)
{
    static WalkthroughWriter *const writers[] = {
        [WALKTHROUGH_TEXT] = walkthrough_write_text,
        [WALKTHROUGH_JSON] = walkthrough_write_json,
        [WALKTHROUGH_OBJ] = walkthrough_write_obj,
        [WALKTHROUGH_SVG] = walkthrough_write_svg,
    };
    return writers[format];
}

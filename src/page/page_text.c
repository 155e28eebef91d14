/* What the page says of a pixel: the texts of rectray trace, and their steps as data. */
#include "page/page.h"

#include "walkthrough/rounding.h"
#include "walkthrough/walkthrough_diff.h"

#include <stdlib.h>

/* The stream for the next text; NULL without memory. */
static FILE *open_text(Page *page)
{
    free(page->text);
    page->text = NULL;
    page->error = (Error){.kind = ERROR_NONE};
    return open_memstream(&page->text, &page->text_length);
}

static bool close_text(Page *page, FILE *out, bool written)
{
    written = out && fclose(out) == 0 && written;
    if (!written && page->error.kind == ERROR_NONE)
        error_memory(&page->error, "the walkthrough");
    return written;
}

static bool write_rounding(FILE *out, const Page *page, PageFormat format, const Walkthrough *walk,
                           WalkthroughStyle style, Error *error)
{
    RenderSettings settings = {.shift = SCENE_SHIFT,
                               .precision =
                                   page->arithmetic == PAGE_TEXTBOOK_FLOAT ? PRECISION_FLOAT : PRECISION_DOUBLE};
    Rounding rounding;
    bool done = rounding_make(&rounding, walk, &settings, error);
    if (done && format == PAGE_TEXTBOOK_TEXT)
        rounding_write_text(out, &rounding, style);
    else if (done)
        done = rounding_write_steps(out, &rounding, style, error);
    rounding_free(&rounding);
    return done;
}

static bool write_format(FILE *out, const Page *page, PageFormat format, Walkthrough *walk, WalkthroughStyle style,
                         Error *error)
{
    if (format >= PAGE_TEXTBOOK_TEXT)
        return write_rounding(out, page, format, walk, style, error);
    if (format == PAGE_STEPS)
        return walkthrough_write_steps(out, walk, style, error);
    if (format <= PAGE_JSON && !walkthrough_look_around(walk, error)) /* the others do not tell it */
        return false;
    return walkthrough_writer((WalkthroughFormat)format)(out, walk, style, error);
}

static const Accel *tree_of(const Page *page, PageFormat format)
{
    return page->tree.kind == ACCEL_NONE || format >= PAGE_TEXTBOOK_TEXT ? NULL : &page->tree;
}

bool page_write_walk(Page *page, PageFormat format, WalkthroughRequest request, WalkthroughStyle style)
{
    Walkthrough walk = {0};
    FILE *out = open_text(page);
    bool done = out &&
                walkthrough_record(&walk, &page->scene, tree_of(page, format), page->path, request, &page->error) &&
                write_format(out, page, format, &walk, style, &page->error);
    walkthrough_free(&walk);
    return close_text(page, out, done);
}

bool page_write_diff(Page *page, WalkthroughRequest one, WalkthroughRequest other, WalkthroughStyle style)
{
    Walkthrough walks[2] = {{0}, {0}};
    FILE *out = open_text(page);
    bool done = out && walkthrough_record(&walks[0], &page->scene, NULL, page->path, one, &page->error) &&
                walkthrough_record(&walks[1], &page->scene, NULL, page->path, other, &page->error) &&
                walkthrough_diff(out, walks, 2, style, &page->error);
    walkthrough_free(&walks[0]);
    walkthrough_free(&walks[1]);
    return close_text(page, out, done);
}

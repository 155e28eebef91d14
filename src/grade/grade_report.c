/* What grading has found, as text. */
#include "grade/grade_report.h"

#include "grade/grade_words.h"

enum { CAUSES_TOLD = 3 };

static Ink ink_of(const GradeReport *report)
{
    return (Ink){report->out, INK_PLAIN, INK_COLUMNS};
}

static void print_pair(const Ink *ink, const char *label, const char *text)
{
    ink_hanging(ink, 13, "    %-9s%s", label, text);
}

static void print_slip(const Ink *ink, const Slip *slip, const char *explains)
{
    ink_hanging(ink, 4, "    %s", slip->title);
    print_pair(ink, slip->rounding ? "ours" : "right", slip->right);
    print_pair(ink, slip->rounding ? "given" : "slip", slip->wrong);
    print_pair(ink, "", explains);
    print_pair(ink, "read", ink_text("docs/%s", slip->read).text);
    print_pair(ink, "name", slip->name);
}

static const char *head_of(int causes)
{
    return causes == 0   ? "What it looks like: none of the slips that are known."
           : causes == 1 ? "What it looks like:"
                         : "What it looks like: one of these, which cannot be told apart here.";
}

static InkText explains(const GradeCause *cause, int given)
{
    if (cause->rest == DIFFERENCE_NONE)
        return ink_text("With it, all that is given comes out as it is given.");
    return ink_text("With it, the first %d of the %d events given come out as they are given; then something else "
                    "differs, too.",
                    cause->events, given);
}

static void print_trace(const Ink *ink, const GradeReport *report, int column, int row)
{
    fprintf(ink->out, "\nOurs, with every number: rectray trace %s --pixel %d,%d\n", report->scene, column, row);
}

void grade_report_text(const GradeReport *report, const Grade *grade)
{
    Ink ink = ink_of(report);
    const Difference *difference = &grade->difference;
    const WalkthroughRequest *pixel = &grade->walk.request;
    InkText where = ink_text("pixel (%d, %d) of %s", pixel->column, pixel->row, report->scene);
    if (difference->kind == DIFFERENCE_NONE) {
        fprintf(ink.out, "The same: all %d events given, %s, within %g + %g times ours.\n", difference->events,
                where.text, report->tolerance.absolute, report->tolerance.relative);
        return;
    }
    if (grade->same)
        fprintf(ink.out, "The same but for rounding: %s.\n\n", where.text);
    else
        fprintf(ink.out, "They differ: %s and %s.\n\n", report->given, where.text);
    fprintf(ink.out, "The first difference, after %d event%s that %s the same:\n", difference->events,
            difference->events == 1 ? "" : "s", difference->events == 1 ? "is" : "are");
    print_pair(&ink, "at", grade_words_place(difference).text);
    print_pair(&ink, "expected", grade_words_expected(difference).text);
    print_pair(&ink, "given", grade_words_given(difference).text);
    int told = grade->cause_count < CAUSES_TOLD ? grade->cause_count : CAUSES_TOLD;
    int more = grade->cause_count - told + grade->more_causes;
    InkText ratio = grade_words_ratio(difference);
    if (ratio.text[0])
        print_pair(&ink, "", ratio.text);
    fprintf(ink.out, "\n%s\n", head_of(grade->cause_count));
    for (int i = 0; i < told; i++)
        print_slip(&ink, grade->causes[i].slip, explains(&grade->causes[i], grade->given->count).text);
    if (grade->cause_count == 0)
        print_pair(&ink, "read", ink_text("docs/%s", grade_words_read(difference)).text);
    if (more > 0)
        fprintf(ink.out, "    And %d more. Another pixel may tell.\n", more);
    print_trace(&ink, report, pixel->column, pixel->row);
}

static void print_rounded(const Ink *ink, const GradePicture *grade)
{
    if (grade->rounded > 0)
        ink_paragraph(ink, "%ld pixel%s not counted: there rounding decides, and yours rounds otherwise.",
                      grade->rounded, grade->rounded == 1 ? " is" : "s are");
}

static InkText bytes_words(const unsigned char rgb[3])
{
    return ink_text("(%d, %d, %d)", rgb[0], rgb[1], rgb[2]);
}

void grade_report_picture_text(const GradeReport *report, const GradePicture *grade)
{
    Ink ink = ink_of(report);
    if (grade->differing == 0) {
        fprintf(ink.out, "The same: every pixel of %s is that of %s, within %g of 255.\n", report->given, report->scene,
                report->tolerance.absolute);
        print_rounded(&ink, grade);
        return;
    }
    int left = grade->column - grade->column % GRADE_TILE, top = grade->row - grade->row % GRADE_TILE;
    fprintf(ink.out, "They differ: %s and the picture of %s, in %ld pixel%s.\n", report->given, report->scene,
            grade->differing, grade->differing == 1 ? "" : "s");
    print_rounded(&ink, grade);
    fprintf(ink.out, "\nThe first, in the tile of %d x %d pixels at (%d, %d):\n", GRADE_TILE, GRADE_TILE, left, top);
    print_pair(&ink, "pixel", ink_text("(%d, %d)", grade->column, grade->row).text);
    print_pair(&ink, "expected", bytes_words(grade->expected).text);
    print_pair(&ink, "given", bytes_words(grade->given).text);
    fprintf(ink.out, "\n%s\n", head_of(grade->cause_count));
    for (int i = 0; i < grade->cause_count && i < CAUSES_TOLD; i++)
        print_slip(&ink, grade->causes[i].slip,
                   ink_text("With it, %d of %d differing pixels that were tried have your colour, and %d of %d equal "
                            "ones stay.",
                            grade->causes[i].explained, grade->tried, grade->causes[i].kept, grade->equal_tried)
                       .text);
    print_trace(&ink, report, grade->column, grade->row);
}

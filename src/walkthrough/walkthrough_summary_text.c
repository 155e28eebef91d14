/* A walkthrough in short, as text. A table has a row for each hit, and what is said of its lights stands beside it, or
 * below it where the row is full. All of it has at most SUMMARY_LINES lines. Of a long path some hits in the middle
 * share a row; where lines are wanting, the lights of the hits between the first and the last are only counted. */
#include "walkthrough/walkthrough_summary.h"
#include "walkthrough/walkthrough_summary_lights.h"
#include "walkthrough/walkthrough_words.h"

#include <string.h>

enum { HITS_TOLD = 5, LIGHTS_INDENT = 6, DIGITS = 4, CELLS = 4, WORD_MOST = 44 };

enum { NAME_MOST = 40, NAME_LEAST = 14 }; /* columns of a face's name */

static const char ADDS[] = "adds (red, green, blue)";

/* --- The table of hits --- */

/* Its cells, and their widths. */
typedef struct Row {
    InkText name, cells[CELLS]; /* face, distance, weight, what it adds */
} Row;

static Row row_of(const Summary *summary, int index, int name_columns)
{
    const SummaryHit *hit = &summary->hits[index];
    return (Row){ink_text("P%d", index + 1),
                 {walkthrough_face_words(summary->walk->scene, hit->face, name_columns),
                  ink_number(hit->distance, DIGITS), ink_number(hit->weight, DIGITS),
                  ink_vector(hit->contribution, DIGITS)}};
}

/* The hits from `first` to `last` in one row. */
static Row row_of_several(const Summary *summary, int first, int last)
{
    Vec3 sum = {0, 0, 0};
    for (int i = first; i <= last; i++)
        sum = vec3_add(sum, summary->hits[i].contribution);
    return (Row){
        ink_text("..."),
        {ink_text("P%d to P%d", first + 1, last + 1), ink_text("%s", ""), ink_text("%s", ""), ink_vector(sum, DIGITS)}};
}

static Row row_of_background(const Summary *summary)
{
    return (Row){ink_text("%s", ""),
                 {ink_text("background"), ink_text("%s", ""), ink_number(summary->background_weight, DIGITS),
                  ink_vector(summary->background, DIGITS)}};
}

/* The rows, and the hit of each: -1 where it is none alone. */
typedef struct Table {
    Row rows[HITS_TOLD + 1];
    int hits[HITS_TOLD + 1];
    int count;
    int width[CELLS];
} Table;

static void add_row(Table *table, Row row, int hit)
{
    for (int k = 0; k < CELLS; k++) {
        int width = ink_width(row.cells[k].text);
        table->width[k] = width > table->width[k] ? width : table->width[k];
    }
    table->rows[table->count] = row;
    table->hits[table->count++] = hit;
}

static Table table_of(const Summary *summary, int name_columns)
{
    int count = summary->hit_count, alone = count > HITS_TOLD ? HITS_TOLD - 2 : count;
    Table table = {.width = {4, 8, 6, 4}};
    for (int i = 0; i < alone; i++)
        add_row(&table, row_of(summary, i, name_columns), i);
    if (alone < count) {
        add_row(&table, row_of_several(summary, alone, count - 2), -1);
        add_row(&table, row_of(summary, count - 1, name_columns), count - 1);
    }
    if (summary->missed)
        add_row(&table, row_of_background(summary), -1);
    return table;
}

/* Of its widest line, which may be the heading. */
static int table_columns(const Table *table)
{
    int last = table->width[CELLS - 1], heading = (int)strlen(ADDS);
    int columns = 4 + 2 * (CELLS - 1) + (last > heading ? last : heading);
    for (int k = 0; k < CELLS - 1; k++)
        columns += table->width[k];
    return columns;
}

/* Names are cut only where the table would be too wide. */
static Table table_within(const Summary *summary, int columns)
{
    int name_columns = NAME_MOST;
    Table table = table_of(summary, name_columns);
    while (name_columns > NAME_LEAST && table_columns(&table) > columns)
        table = table_of(summary, --name_columns);
    return table;
}

static InkText line_of(const Table *table, int index)
{
    const Row *row = &table->rows[index];
    InkText line = ink_text("%-4s", row->name.text);
    for (int k = 0; k < CELLS; k++)
        line = ink_text("%s%s%*s%s", line.text, row->cells[k].text, table->width[k] - ink_width(row->cells[k].text), "",
                        k < CELLS - 1 ? "  " : "");
    return line;
}

/* The blanks at its end belong to the column. */
static void print_line(const Ink *ink, const InkText *line)
{
    fprintf(ink->out, "%.*s\n", (int)(strrchr(line->text, ')') + 1 - line->text), line->text);
}

/* The rows of hits after this one. */
static int hits_after(const Table *table, int index)
{
    int count = 0;
    for (int i = index + 1; i < table->count; i++)
        count += table->hits[i] >= 0;
    return count;
}

/* Prints a row. What does not fit beside it takes one of the *room lines, of which `kept` are for others; or two, where
 * each hit after it still has its own. */
static void print_row(const Ink *ink, const Summary *summary, const Table *table, int index, int kept, int *room)
{
    InkText line = line_of(table, index);
    if (table->hits[index] < 0) {
        print_line(ink, &line);
        return;
    }
    const SummaryHit *hit = &summary->hits[table->hits[index]];
    int beside = ink->columns - ink_width(line.text) - 2;
    int width = ink->columns - LIGHTS_INDENT;
    bool two_lines = *room >= 2 + hits_after(table, index);
    InkText words = walkthrough_summary_lights(summary, hit, two_lines ? 2 * width - WORD_MOST : width);
    bool below = ink_width(words.text) > beside;
    if (below && *room <= kept) {
        words = walkthrough_summary_light_count(summary, hit);
        if (ink_width(words.text) > beside)
            words.text[0] = '\0';
        below = false;
    }
    if (!below && words.text[0])
        fprintf(ink->out, "%s  %s\n", line.text, words.text);
    else
        print_line(ink, &line);
    if (below) {
        ink_hanging(ink, LIGHTS_INDENT, "%*s%s", LIGHTS_INDENT, "", words.text);
        *room -= ink_width(words.text) > width ? 2 : 1;
    }
}

/* Prints the table in at most so many lines. */
static void print_table(const Ink *ink, const Summary *summary, int lines)
{
    Table table = table_within(summary, ink->columns);
    int room = lines - 1 - table.count, last = summary->hit_count - 1;
    fprintf(ink->out, "    %-*s  %-*s  %-*s  %s\n", table.width[0], "face", table.width[1], "distance", table.width[2],
            "weight", ADDS);
    for (int i = 0; i < table.count; i++)
        print_row(ink, summary, &table, i, i > 0 && table.hits[i] < last, &room);
}

/* --- All of it --- */

/* A neighbour's bytes beside their colour, which takes the place of two blanks; only blanks where the picture ends. */
static InkText cell_of(const Ink *ink, const WalkthroughAround *around, int k)
{
    enum { BYTES = 17, SWATCH = 2 };
    const unsigned char *rgb = around->rgb[k];
    bool self = k == AROUND_SELF;
    if (!around->there[k])
        return ink_text("%*s", 4 + BYTES, "");
    InkText bytes = ink_text("(%d, %d, %d)%s", rgb[0], rgb[1], rgb[2], self ? " <" : "");
    InkText swatch = ink->colour ? ink_swatch(ink, rgb, SWATCH) : ink_text("%*s", SWATCH, "");
    return ink_text("%s%s%-*s", swatch.text, self ? "> " : "  ", BYTES, bytes.text);
}

/* The bytes of the pixel between those of its neighbours. */
static void print_around(const Ink *ink, const WalkthroughAround *around)
{
    for (int row = 0; row < 3; row++) {
        InkText line = {""};
        for (int column = 0; column < 3; column++)
            line = ink_text("%s%s", line.text, cell_of(ink, around, 3 * row + column).text);
        size_t length = strlen(line.text);
        while (length > 0 && line.text[length - 1] == ' ')
            length--;
        if (length > 0)
            fprintf(ink->out, "%.*s\n", (int)length, line.text);
    }
}

/* "camera -> P1 floor/0 -> P2 box/3 -> out of the scene", names with at most so many columns. */
static void write_path(char *line, size_t size, const Summary *summary, int name_columns)
{
    int count = summary->hit_count;
    size_t used = (size_t)snprintf(line, size, "camera");
    for (int i = 0; i < count; i++) {
        bool told = count <= HITS_TOLD || i < HITS_TOLD - 2 || i == count - 1;
        if (told)
            used += (size_t)snprintf(
                line + used, size - used, " -> P%d %s", i + 1,
                walkthrough_face_words(summary->walk->scene, summary->hits[i].face, name_columns).text);
        else if (i == HITS_TOLD - 2)
            used += (size_t)snprintf(line + used, size - used, " -> %d more", count - HITS_TOLD + 1);
    }
    snprintf(line + used, size - used, "%s", summary->missed ? " -> out of the scene" : "");
}

/* Names are cut only where the path would take more than two lines. No word is longer than a name. */
static void write_path_in_two_lines(char *line, size_t size, const Summary *summary, int columns)
{
    int name_columns = NAME_MOST;
    write_path(line, size, summary, name_columns);
    while (name_columns > NAME_LEAST && ink_width(line) > 2 * columns - name_columns)
        write_path(line, size, summary, --name_columns);
}

static bool is_black(const Summary *summary)
{
    return summary->rgb[0] == 0 && summary->rgb[1] == 0 && summary->rgb[2] == 0;
}

void summary_write_text(const Ink *ink, const Summary *summary)
{
    const WalkthroughRequest *request = &summary->walk->request;
    bool around = summary->walk->around.there[AROUND_SELF], several = summary->samples > 1;
    char path[1024];
    write_path_in_two_lines(path, sizeof path, summary, ink->columns);
    InkText end = ink_text("The path ends: %s.%s", summary->end.text,
                           is_black(summary) ? " Nothing on it adds light: the pixel is black." : "");
    InkText pixel = walkthrough_pixel_words(summary->walk, &summary->walk->events[summary->walk->count - 1]);
    InkText sample = {""};
    if (several)
        sample = ink_text("Sample (%d, %d) = %s, one of %d; the pixel is their average.", request->i, request->j,
                          ink_vector(summary->colour, DIGITS).text, summary->samples);
    /* Besides the table: the title, a blank line and the last line; what is too long takes two. */
    int others = 3 + (around ? 3 : 0) + several + (ink_width(sample.text) > ink->columns) +
                 (ink_width(path) > ink->columns ? 2 : 1) + (ink_width(end.text) > ink->columns ? 2 : 1);
    if (around)
        print_around(ink, &summary->walk->around);
    fputc('\n', ink->out);
    ink_paragraph(ink, "%s", path);
    print_table(ink, summary, SUMMARY_LINES - others);
    ink_paragraph(ink, "%s", end.text);
    if (several)
        ink_paragraph(ink, "%s", sample.text);
    fprintf(ink->out, "%s%s%s\n", ink_colour(ink, 'b'), pixel.text, ink_colour(ink, '.'));
}

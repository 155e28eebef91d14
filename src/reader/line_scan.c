/* Words, numbers and names of the lines of a text file. */
#include "reader/line_scan.h"

#include "base/number.h"
#include "base/text_blocks.h"

#include <ctype.h>
#include <math.h>
#include <stdarg.h>
#include <stdlib.h>
#include <string.h>
#include <strings.h>

/* Whether a comment begins between two places of a line. A backslash at the end of a comment continues nothing. */
static bool holds_comment(const char *begin, const char *end)
{
    for (const char *c = begin; c < end; c++)
        if (*c == '#' && (c == begin || scan_is_blank(c[-1])))
            return true;
    return false;
}

/* The end of the line. Goes there over the lines that continue it. */
static char *find_line_end(LineScan *scan)
{
    for (char *begin = scan->at;;) {
        char *end = strchr(begin, '\n'); /* a block ends with one */
        if (end == begin || end[-1] != '\\' || holds_comment(begin, end))
            return end;
        scan->line++;
        begin = end + 1;
    }
}

bool scan_next_line(LineScan *scan)
{
    scan->at = find_line_end(scan) + 1;
    scan->line++;
    return true;
}

char *scan_rest(LineScan *scan)
{
    char *name = scan->at, *end = find_line_end(scan), *last = name;
    scan->at = end + 1;
    scan->line++;
    for (char *c = name; c < end; c++) {
        if (c[0] == '\\' && c[1] == '\n')
            c[0] = c[1] = ' ';
        if (*c == '#' && (c == name || scan_is_blank(c[-1])))
            break;
        if (!scan_is_blank(*c))
            last = c + 1;
    }
    *last = '\0';
    return name;
}

ScanWord scan_word(LineScan *scan)
{
    const char *begin = scan->at;
    if (scan_line_ends(scan))
        return (ScanWord){begin, 0};
    while (!scan_word_ends(scan->at))
        scan->at++;
    ScanWord word = {begin, (int)(scan->at - begin)};
    scan_blanks(scan);
    return word;
}

bool scan_word_is(ScanWord word, const char *text)
{
    return strlen(text) == (size_t)word.length && strncasecmp(word.text, text, (size_t)word.length) == 0;
}

Quoted scan_quote(ScanWord word)
{
    char text[sizeof((Quoted *)0)->text];
    snprintf(text, sizeof text, "%.*s", word.length, word.text);
    return text_quote(text);
}

bool scan_file(LineScan *scan, bool (*read_line)(void *user), void *user)
{
    TextBlocks blocks;
    bool good = text_blocks_open(&blocks, scan->path, scan->error);
    number_prepare();
    while (good) {
        TextBlock block = text_blocks_next(&blocks, scan->error);
        if (!block.at)
            break;
        scan->at = block.at;
        while (good && scan->at < block.end)
            good = read_line(user);
        blocks.line = scan->line - 1;
    }
    text_blocks_close(&blocks);
    return good && scan->error->kind == ERROR_NONE;
}

bool scan_fail(const LineScan *scan, long line, const char *format, ...)
{
    char reason[1024];
    va_list arguments;
    va_start(arguments, format);
    vsnprintf(reason, sizeof reason, format, arguments);
    va_end(arguments);
    return scan->bare ? error_set(scan->error, ERROR_INPUT, "%s", reason)
                      : error_set(scan->error, ERROR_INPUT, "%s:%ld: %s", scan->path, line, reason);
}

/* nan, NaN, -nan(ind), inf, Infinity, 1.#IND, -1.#QNAN, 1.#INF00 */
static bool is_no_number(ScanWord word)
{
    char text[16] = "";
    for (int i = 0; i < word.length && i < (int)sizeof text - 1; i++)
        text[i] = (char)tolower((unsigned char)word.text[i]);
    const char *name = text + (text[0] == '-' || text[0] == '+');
    return strcmp(name, "nan") == 0 || strncmp(name, "nan(", 4) == 0 || strcmp(name, "inf") == 0 ||
           strcmp(name, "infinity") == 0 || strncmp(name, "1.#ind", 6) == 0 || strncmp(name, "1.#qnan", 7) == 0 ||
           strncmp(name, "1.#inf", 6) == 0;
}

/* Reads what number_read does not take. */
static bool read_odd_number(LineScan *scan, double *value)
{
    long line = scan->line;
    ScanWord word = scan_word(scan);
    bool odd = is_no_number(word);
    if (!odd && strspn(word.text, "+-.0123456789eE") >= (size_t)word.length) {
        char *end;
        odd = isinf(strtod(word.text, &end)) && end == word.text + word.length;
    }
    *value = (double)NAN;
    return odd || scan_fail(scan, line, "%s is not a finite number%s", scan_quote(word).text,
                            memchr(word.text, ',', (size_t)word.length) ? "; write a point, not a comma" : "");
}

bool scan_number(LineScan *scan, double *value)
{
    const char *end = number_read(scan->at, NUMBER_C, value);
    if (!end || !scan_word_ends(end))
        return read_odd_number(scan, value);
    scan->at += end - scan->at;
    scan_blanks(scan);
    return true;
}

bool scan_numbers(LineScan *scan, double *numbers, int room, int *count)
{
    for (*count = 0; !scan_line_ends(scan); ++*count) {
        if (*count == room)
            return scan_fail(scan, scan->line, "more than %d numbers", room);
        if (!scan_number(scan, &numbers[*count]))
            return false;
    }
    return true;
}

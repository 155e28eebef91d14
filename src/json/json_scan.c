/* The grammar of JSON (RFC 8259), a function for each kind of token and a stack of open brackets. */
#include "json/json_scan.h"

#include "base/number.h"
#include "base/text.h"

#include <ctype.h>
#include <stdarg.h>
#include <stdio.h>
#include <string.h>

/* The text ends in a NUL, which no token accepts: no look-ahead needs a comparison with the end. */
typedef struct Scan {
    const char *start, *at, *end;
    const char *open[JSON_MAX_DEPTH]; /* the brackets that are open */
    int depth;
    JsonFault fault;
} Scan;

static bool fault(Scan *scan, const char *place, const char *format, ...)
{
    va_list arguments;
    va_start(arguments, format);
    vsnprintf(scan->fault.reason, sizeof scan->fault.reason, format, arguments);
    va_end(arguments);
    scan->fault.place = place;
    return false;
}

/* The cure for what often stands where it may not. `start` is where the text begins. */
static const char *cure_for(const char *start, const char *at)
{
    static const char *const curly[] = {"\xE2\x80\x9C", "\xE2\x80\x9D", "\xE2\x80\x9E", "\xE2\x80\x98", "\xE2\x80\x99"};
    if (*at == '/')
        return "; a comment is a string under the key \"//\"";
    if (*at == '\'')
        return "; JSON has double quotes only";
    for (int i = 0; i < 5; i++)
        if (strncmp(at, curly[i], 3) == 0)
            return "; a word processor made that of a plain \"";
    const char *before = at;
    while (before > start && strchr(" \t\r\n", before[-1]))
        before--;
    return (*at == '}' || *at == ']') && before > start && before[-1] == ',' ? "; leave out the comma before it" : "";
}

/* "expected WHAT", and what stands there instead. */
static bool fault_expected(Scan *scan, const char *what)
{
    unsigned char c = (unsigned char)*scan->at;
    int length = text_utf8_length(scan->at);
    if (scan->at == scan->end)
        return fault(scan, scan->at, "expected %s, but the file ends", what);
    if (c == 0)
        return fault(scan, scan->at, "a NUL byte; this is not a text file");
    if (c > 0x20 && c != 0x7F && length > 0)
        return fault(scan, scan->at, "expected %s, not '%.*s'%s", what, length, scan->at,
                     cure_for(scan->start, scan->at));
    return fault(scan, scan->at, "expected %s", what);
}

static const char *skip_blanks(const char *at)
{
    while (*at == ' ' || *at == '\t' || *at == '\n' || *at == '\r')
        at++;
    return at;
}

/* The four hexadecimal digits after \u, or -1. */
static int hex4(const char *c)
{
    int value = 0;
    for (int i = 0; i < 4; i++) {
        if (!isxdigit((unsigned char)c[i]))
            return -1;
        value = 16 * value + (isdigit((unsigned char)c[i]) ? c[i] - '0' : tolower((unsigned char)c[i]) - 'a' + 10);
    }
    return value;
}

static bool scan_escape(Scan *scan)
{
    const char *start = scan->at++;
    if (*scan->at && strchr("\"\\/bfnrt", *scan->at)) {
        scan->at++;
        return true;
    }
    int code = *scan->at == 'u' ? hex4(scan->at + 1) : -1;
    if (code < 0)
        return fault(scan, start, "not an escape of JSON; write \\\\ for a backslash, and / in a path");
    scan->at += 5;
    if (code == 0)
        return fault(scan, start, "the character U+0000 may not stand in a string");
    if (code >= 0xD800 && code <= 0xDBFF) {
        int low = scan->at[0] == '\\' && scan->at[1] == 'u' ? hex4(scan->at + 2) : -1;
        if (low < 0xDC00 || low > 0xDFFF)
            return fault(scan, start,
                         "half a surrogate pair; write the character itself, or both halves (\\ud83d\\ude00)");
        scan->at += 6;
    } else if (code >= 0xDC00 && code <= 0xDFFF)
        return fault(scan, start, "half a surrogate pair; write the character itself, or both halves (\\ud83d\\ude00)");
    return true;
}

static bool scan_string(Scan *scan)
{
    const char *start = scan->at++;
    while (*scan->at != '"') {
        int length = text_utf8_length(scan->at);
        if (scan->at == scan->end || *scan->at == '\n' || *scan->at == '\r')
            return fault(scan, start, "the string has no closing '\"' on its line");
        if (length == 0)
            return fault(scan, scan->at, "not UTF-8; save the file as UTF-8");
        if ((unsigned char)*scan->at < 0x20)
            return fault(scan, scan->at, "a control character in a string; write it as an escape");
        if (*scan->at == '\\') {
            if (!scan_escape(scan))
                return false;
        } else
            scan->at += length;
    }
    scan->at++;
    return true;
}

static bool scan_number(Scan *scan)
{
    const char *start = scan->at;
    const char *at = start + (*start == '-');
    const char *digits = at;
    while (isdigit((unsigned char)*at))
        at++;
    bool good = at > digits && (*digits != '0' || at == digits + 1);
    if (*at == '.') {
        digits = ++at;
        while (isdigit((unsigned char)*at))
            at++;
        good = good && at > digits;
    }
    if (*at == 'e' || *at == 'E') {
        at++;
        at += *at == '+' || *at == '-';
        digits = at;
        while (isdigit((unsigned char)*at))
            at++;
        good = good && at > digits;
    }
    if (!good || isalnum((unsigned char)*at) || (*at && strchr("_.+-", *at)))
        return fault(scan, start, "not a number of JSON (like 0, -1.5 or 2e-3)");
    if (at - start > JSON_MAX_NUMBER)
        return fault(scan, start, "a number of more than %d characters", JSON_MAX_NUMBER);
    double value;
    if (!number_read(start, NUMBER_JSON, &value))
        return fault(scan, start, "the number is too large (1.8e308 is the largest)");
    scan->at = at;
    return true;
}

static bool scan_literal(Scan *scan)
{
    static const char *const words[] = {"true", "false", "null"};
    for (int i = 0; i < 3; i++) {
        size_t length = strlen(words[i]);
        if (strncmp(scan->at, words[i], length) == 0 && !isalnum((unsigned char)scan->at[length])) {
            scan->at += length;
            return true;
        }
    }
    return fault_expected(scan, "a value (a number, a string in double quotes, a list, an object)");
}

static bool scan_scalar(Scan *scan)
{
    if (*scan->at == '"')
        return scan_string(scan);
    if (isdigit((unsigned char)*scan->at) || (*scan->at && strchr("+-.", *scan->at)))
        return scan_number(scan);
    return scan_literal(scan);
}

static bool scan_key(Scan *scan)
{
    scan->at = skip_blanks(scan->at);
    if (*scan->at != '"')
        return fault_expected(scan, "a key in double quotes");
    if (!scan_string(scan))
        return false;
    scan->at = skip_blanks(scan->at);
    if (*scan->at != ':')
        return fault_expected(scan, "':' after the key");
    scan->at++;
    return true;
}

static bool in_object(const Scan *scan)
{
    return *scan->open[scan->depth - 1] == '{';
}

/* The end of a list of numbers alone, in which nothing is wrong; NULL: it is another list. */
static const char *numbers_end(const char *at)
{
    double value;
    do {
        const char *start = skip_blanks(at + 1);
        const char *end = number_read(start, NUMBER_JSON, &value);
        if (!end || end - start > JSON_MAX_NUMBER)
            return NULL;
        at = skip_blanks(end);
    } while (*at == ',');
    return *at == ']' ? at + 1 : NULL;
}

/* An opening bracket up to its first member; an empty list or object, and a list of numbers,
 * is scanned whole and is not left open. */
static bool scan_open(Scan *scan)
{
    if (scan->depth == JSON_MAX_DEPTH)
        return fault(scan, scan->at, "lists and objects are nested more than %d deep", JSON_MAX_DEPTH);
    const char *end = *scan->at == '[' ? numbers_end(scan->at) : NULL;
    if (end) {
        scan->at = end;
        return true;
    }
    scan->open[scan->depth++] = scan->at;
    scan->at = skip_blanks(scan->at + 1);
    if (*scan->at == (in_object(scan) ? '}' : ']')) {
        scan->at++;
        scan->depth--;
        return true;
    }
    return !in_object(scan) || scan_key(scan);
}

/* What follows a value: closing brackets, then a comma (and a key), or the end. *more says that a value follows. */
static bool scan_after_value(Scan *scan, bool *more)
{
    for (;; scan->at++, scan->depth--) {
        scan->at = skip_blanks(scan->at);
        if (scan->depth == 0) {
            *more = false;
            return scan->at == scan->end || fault_expected(scan, "nothing after the end of the scene");
        }
        if (*scan->at != (in_object(scan) ? '}' : ']'))
            break;
    }
    if (*scan->at != ',')
        return fault_expected(scan, in_object(scan) ? "',' or '}'" : "',' or ']'");
    scan->at++;
    *more = true;
    return !in_object(scan) || scan_key(scan);
}

JsonFault json_scan(const char *text, long length)
{
    Scan scan = {.start = text, .at = text, .end = text + length};
    if (strncmp(text, "\xEF\xBB\xBF", 3) == 0) {
        fault(&scan, text, "starts with a byte order mark; save it as UTF-8 without one");
        return scan.fault;
    }
    if (text_is_utf16(text)) {
        fault(&scan, text, "is UTF-16; save it as UTF-8");
        return scan.fault;
    }
    for (bool more = true; more && !scan.fault.place;) {
        scan.at = skip_blanks(scan.at);
        int depth = scan.depth;
        bool opens = *scan.at == '{' || *scan.at == '[';
        bool good = opens ? scan_open(&scan) : scan_scalar(&scan);
        if (good && scan.depth == depth) /* the value is complete */
            scan_after_value(&scan, &more);
    }
    return scan.fault;
}

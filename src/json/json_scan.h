/* The grammar of JSON (RFC 8259), checked without building anything and without recursion. */
#ifndef RECTRAY_JSON_SCAN_H
#define RECTRAY_JSON_SCAN_H

enum {
    JSON_MAX_DEPTH = 64,  /* lists and objects inside each other */
    JSON_MAX_NUMBER = 63, /* characters of a number, cJSON's limit */
};

/* Where and why a text is not JSON; `place` is NULL where it is. */
typedef struct JsonFault {
    const char *place;
    char reason[160];
} JsonFault;

/* The whole text (NUL after `length` bytes) must be one value: strict in numbers, strings, escapes, UTF-8 and what may
 * stand after the end. Stricter than the RFC in four things: no NUL character (also not as \u0000), no number
 * beyond a double's range or longer than JSON_MAX_NUMBER, no nesting deeper than JSON_MAX_DEPTH. */
JsonFault json_scan(const char *text, long length);

#endif

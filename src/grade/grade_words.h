/* What grading says of a difference, in words that text and JSON share. */
#ifndef RECTRAY_GRADE_WORDS_H
#define RECTRAY_GRADE_WORDS_H

#include "grade/grade.h"
#include "walkthrough/ink.h"

/* A value of JSON: "0.5", "(1, 0, 0)", "reaches", "true". */
InkText grade_words_value(const cJSON *value);

/* An event: "a hit of floor/5, t = 2.18077", "light 0, blocked", or its kind; "nothing more" for EVENT_KIND_COUNT. */
InkText grade_words_event(EventKind kind, const cJSON *event);

/* "P2, reflected: weight". */
InkText grade_words_place(const Difference *difference);

/* What is expected there, and what is given. */
InkText grade_words_expected(const Difference *difference);
InkText grade_words_given(const Difference *difference);

/* How the two numbers are related, where it is simple: "given is -1 times what is expected"; "" where it is not. */
InkText grade_words_ratio(const Difference *difference);

/* Where the member of an event is explained: a file of docs/ and a heading in it. */
const char *grade_words_read(const Difference *difference);

#endif

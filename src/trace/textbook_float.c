/* The textbook tracer in float: the same text, with another `Real`. */
#define TEXTBOOK_IN_FLOAT 1
#include "trace/textbook.c" /* NOLINT(bugprone-suspicious-include): it is meant to be compiled twice */

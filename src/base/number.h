/* Decimal numbers out of a text, to the nearest double, all digits honoured: what strtod gives, several times sooner.
 * The digits are taken as one integer w and a power of ten q. Where both are exact in a double, w 10^q is one rounded
 * operation (Clinger, "How to Read Floating Point Numbers Accurately", 1990); that is done here, and is all that most
 * files need. number.c decides the rest. */
#ifndef RECTRAY_NUMBER_H
#define RECTRAY_NUMBER_H

#include <float.h>
#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

typedef enum NumberGrammar {
    NUMBER_JSON, /* 0, -1.5, 2e-3 */
    NUMBER_C,    /* also +1, 007, .5 and 1. */
} NumberGrammar;

/* The parts of a number that has been read. */
typedef struct Decimal {
    const char *start, *point_or_digits, *end; /* from its sign; from its first digit or point; past it */
    uint64_t digits;                           /* as an integer, modulo 2^64 */
    int digit_count;                           /* leading zeros included */
    int exponent;                              /* of ten */
    bool negative;
} Decimal;

/* Makes the table of powers that number_convert needs to be fast: some 200 microseconds, once. It must not run on two
 * threads at once. Without it every value is the same, since strtod then decides. */
void number_prepare(void);

/* The value of a number whose digits or power of ten are no doubles: by the product with 128 bits of the power
 * (Lemire, "Number parsing at a gigabyte per second", 2021), else by strtod. False where it is infinite. */
bool number_convert(const Decimal *decimal, double *value);

static inline bool number_is_digit(char c)
{
    return (unsigned char)(c - '0') < 10;
}

/* Reads the digits at `at`, adds them to the decimal and returns the end. */
static inline const char *number_digits(const char *at, Decimal *decimal)
{
    const char *first = at;
    for (; number_is_digit(*at); at++)
        decimal->digits = 10 * decimal->digits + (uint64_t)(*at - '0');
    decimal->digit_count += (int)(at - first);
    return at;
}

/* Reads what follows the e of a power of ten. NULL where no digit follows. */
static inline const char *number_exponent(const char *at, Decimal *decimal)
{
    enum { BEYOND_ALL = 100000 }; /* far beyond any double, and far from overflow */
    bool negative = *at == '-';
    int exponent = 0;
    at += *at == '-' || *at == '+';
    const char *first = at;
    for (; number_is_digit(*at); at++)
        exponent = exponent < BEYOND_ALL ? 10 * exponent + (*at - '0') : exponent;
    decimal->exponent += negative ? -exponent : exponent;
    return at > first ? at : NULL;
}

/* Reads the number that begins at `at`, in a text of less than 2 GiB that ends in a NUL. Returns its end; NULL where
 * there is none, or none that a double holds. What follows the end is the caller's to judge. */
static inline const char *number_read(const char *at, NumberGrammar grammar, double *value)
{
    static const double powers[] = {1e0,  1e1,  1e2,  1e3,  1e4,  1e5,  1e6,  1e7,  1e8,  1e9,  1e10, 1e11,
                                    1e12, 1e13, 1e14, 1e15, 1e16, 1e17, 1e18, 1e19, 1e20, 1e21, 1e22};
    Decimal decimal = {.start = at, .negative = *at == '-'};
    at += decimal.negative || (grammar == NUMBER_C && *at == '+');
    decimal.point_or_digits = at;
    at = number_digits(at, &decimal);
    int before = decimal.digit_count;
    if (grammar == NUMBER_JSON && (before == 0 || (before > 1 && *decimal.point_or_digits == '0')))
        return NULL;
    if (*at == '.') {
        at = number_digits(at + 1, &decimal);
        decimal.exponent = before - decimal.digit_count;
        if (grammar == NUMBER_JSON && decimal.exponent == 0)
            return NULL;
    }
    if (decimal.digit_count == 0 || ((*at == 'e' || *at == 'E') && !(at = number_exponent(at + 1, &decimal))))
        return NULL;
    decimal.end = at;
    /* 19 digits fit into 64 bits, 2^53 and 10^22 into a double; FLT_EVAL_METHOD 0: a double is no wider than that. */
    if (FLT_EVAL_METHOD == 0 && decimal.digit_count <= 19 && decimal.digits <= (uint64_t)1 << 53 &&
        decimal.exponent >= -22 && decimal.exponent <= 22) {
        double w = (double)decimal.digits;
        w = decimal.exponent < 0 ? w / powers[-decimal.exponent] : w * powers[decimal.exponent];
        *value = decimal.negative ? -w : w;
        return at;
    }
    return number_convert(&decimal, value) ? at : NULL;
}

#endif

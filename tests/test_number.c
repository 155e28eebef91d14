/* Numbers out of text: which texts are numbers, and that every value is strtod's to the last bit. */
#include "base/number.h"

#include "support/xorshift.h"
#include "unity.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

void setUp(void)
{
    number_prepare();
}

void tearDown(void) {}

/* Reads all of the text, and compares the bits. */
static void assert_is_strtod(const char *text)
{
    double value = 0, expected = strtod(text, NULL);
    const char *end = number_read(text, NUMBER_C, &value);
    if (!isfinite(expected)) {
        TEST_ASSERT_NULL_MESSAGE(end, text);
        return;
    }
    TEST_ASSERT_NOT_NULL_MESSAGE(end, text);
    TEST_ASSERT_TRUE_MESSAGE(*end == '\0', text);
    TEST_ASSERT_TRUE_MESSAGE(memcmp(&value, &expected, sizeof value) == 0, text);
}

static bool takes(const char *text, NumberGrammar grammar)
{
    double value;
    const char *end = number_read(text, grammar, &value);
    return end && !*end;
}

static void number_read_should_know_both_grammars(void)
{
    static const char *const both[] = {"0",    "-0",      "10",    "-1.5",   "0.5",   "2e3",
                                       "2E+3", "1.25e-3", "1e308", "1e-400", "0e9999"};
    static const char *const only_c[] = {"+1", "007", "-01", ".5", "1.", "1.e3", "00"};
    static const char *const none[] = {"",    "-",     "+",   ".",   "-.",    "e5",     "1e",
                                       "1e+", "1.5e-", "--1", "+-1", "1.2.3", "1_0",    "0x10",
                                       "inf", "nan",   " 1",  "1 ",  "1e999", "-1e999", "1e1.5"};
    for (size_t i = 0; i < sizeof both / sizeof *both; i++)
        TEST_ASSERT_TRUE_MESSAGE(takes(both[i], NUMBER_JSON) && takes(both[i], NUMBER_C), both[i]);
    for (size_t i = 0; i < sizeof only_c / sizeof *only_c; i++)
        TEST_ASSERT_TRUE_MESSAGE(!takes(only_c[i], NUMBER_JSON) && takes(only_c[i], NUMBER_C), only_c[i]);
    for (size_t i = 0; i < sizeof none / sizeof *none; i++)
        TEST_ASSERT_FALSE_MESSAGE(takes(none[i], NUMBER_JSON) || takes(none[i], NUMBER_C), none[i]);
}

static void number_read_should_stop_behind_the_number(void)
{
    static const char *const texts[] = {"1.5,2", "1.5]", "1.5 e3", "1.5-2", "1.5x"};
    double value = 0;
    for (size_t i = 0; i < sizeof texts / sizeof *texts; i++) {
        TEST_ASSERT_EQUAL_PTR(texts[i] + 3, number_read(texts[i], NUMBER_JSON, &value));
        TEST_ASSERT_TRUE(value == 1.5);
    }
}

static void number_read_should_keep_the_sign_of_zero(void)
{
    double value = 1;
    TEST_ASSERT_NOT_NULL(number_read("-0", NUMBER_JSON, &value));
    TEST_ASSERT_TRUE(value == 0 && signbit(value));
    TEST_ASSERT_NOT_NULL(number_read("-0.0000000000000000000000000e-500", NUMBER_JSON, &value));
    TEST_ASSERT_TRUE(value == 0 && signbit(value));
}

/* Known to have gone wrong in one reader or another, and the ends of every range. */
static void number_read_should_round_hard_cases_to_nearest(void)
{
    static const char *const texts[] = {
        /* half-way between two doubles, and a little beside */
        "9007199254740993",
        "9007199254740992.999999999999999999999999999",
        "9007199254740993.000000000000000000000001",
        "9007199254740995",
        "18014398509481986",
        "4503599627370496.5",
        "4503599627370497.5",
        "4503599627370497.50000001",
        "1.00000000000000011102230246251565404236316680908203125",
        "1.00000000000000011102230246251565404236316680908203124",
        "1.00000000000000011102230246251565404236316680908203126",
        "9007199254740993e22",
        "9007199254740993e-4",
        "6929495644600919.5",
        "3.5844466002796428e298",
        "7.3177701707893310e15",
        "1e23",
        "8.5e22",
        "9.5e-23",
        /* 2^53, 10^22 and 19 digits: where the exact operation ends */
        "9007199254740992e22",
        "9007199254740993e22",
        "9007199254740992e23",
        "9007199254740991e-22",
        "9007199254740991e-23",
        "9999999999999999999",
        "18446744073709551615",
        "18446744073709551616",
        "0.000000000000000000000012345678901234567",
        "00000000000000000000000000000000000000012.5",
        /* the normal numbers' ends */
        "1.7976931348623157e308",
        "1.7976931348623158e308",
        "1.7976931348623159e308",
        "1.8e308",
        "17976931348623157e292",
        "2.2250738585072014e-308",
        "2.2250738585072011e-308",
        "2.2250738585072012e-308",
        "2."
        "22507385850720113605740979670913197593481954635164564802342610972482222202107694551652952390813508791414915891"
        "3"
        "03962110687008643869459464552765720740782062174337998814106326732925355228688137214901298112245145188984905722"
        "2"
        "30728525513315575501591439747639798341180199932396254828901710708185069063066665599493827577257201576306269066"
        "3"
        "33264756530000924588831643303777979186961204949739037782970490505108060994073026293712895895000358379996720725"
        "4"
        "30436028407889577179615094551674824347103070260914462157228988025818254518032570701886087211312807951223342628"
        "8"
        "36862232150377566662250398253433597456888442390026549819838548794829220689472168983109969836584681402285424333"
        "0"
        "66033985088644580400103493397042756718644338377048603786162277173854562306587467901408672332763671875123456789"
        "0"
        "123456789012345678901e-308",
        /* subnormal, and zero in the end */
        "4.9406564584124654e-324",
        "4.94e-324",
        "2.4703282292062327e-324",
        "2.4703282292062328e-324",
        "2.47e-324",
        "1e-323",
        "1.5e-323",
        "8.41e-321",
        "9.5e-310",
        "1e-400",
        "123456789e-340",
        "1e-2147483648",
        "0.1e-99999999999",
    };
    for (size_t i = 0; i < sizeof texts / sizeof *texts; i++)
        assert_is_strtod(texts[i]);
}

/* Digits far behind the point decide a half-way case: none may be dropped. */
static void number_read_should_honour_800_digits(void)
{
    char text[1024] = "4503599627370496.5";
    size_t length = strlen(text);
    double value = 0;
    memset(text + length, '0', 800);
    text[length + 800] = '\0';
    TEST_ASSERT_NOT_NULL(number_read(text, NUMBER_JSON, &value));
    TEST_ASSERT_TRUE(value == 4503599627370496.0);
    text[length + 799] = '1';
    TEST_ASSERT_NOT_NULL(number_read(text, NUMBER_JSON, &value));
    TEST_ASSERT_TRUE(value == 4503599627370497.0);
    memset(text, '7', 800);
    text[800] = '\0';
    assert_is_strtod(text); /* infinite */
    text[200] = '\0';
    assert_is_strtod(text);
}

/* Every power of ten once with one digit and with many: each entry of the table. */
static void number_read_should_know_every_power_of_ten(void)
{
    char text[64];
    for (int q = -360; q <= 320; q++) {
        static const char *const digits[] = {"1", "7", "9999999999999999999", "12345678901234567", "9007199254740993"};
        for (size_t i = 0; i < sizeof digits / sizeof *digits; i++) {
            snprintf(text, sizeof text, "-%se%d", digits[i], q);
            assert_is_strtod(text);
        }
    }
}

static double random_double(uint64_t *state)
{
    double value;
    do {
        uint64_t bits = random_next(state);
        memcpy(&value, &bits, sizeof value);
    } while (!isfinite(value));
    return value;
}

static void number_read_should_equal_strtod_on_random_texts(void)
{
    enum { COUNT = 60000 };
    uint64_t state = 7;
    char text[512];
    for (int i = 0; i < COUNT; i++) {
        double any = random_double(&state), unit = random_unit(&state);
        snprintf(text, sizeof text, "%.*e", (int)(random_next(&state) % 25), any);
        assert_is_strtod(text);
        snprintf(text, sizeof text, "%.17g", unit / 3);
        assert_is_strtod(text);
        snprintf(text, sizeof text, "%.*f", (int)(random_next(&state) % 30), 1e6 * unit);
        assert_is_strtod(text);
        /* An odd integer of 54 bits is half-way between two doubles. */
        uint64_t between = (random_next(&state) >> 10) | (uint64_t)1 << 53 | 1;
        snprintf(text, sizeof text, "%llu%se%d", (unsigned long long)between,
                 i % 3   ? ""
                 : i % 2 ? ".001"
                         : ".000",
                 (int)(random_next(&state) % 40) - 12);
        assert_is_strtod(text);
    }
}

int main(void)
{
    UNITY_BEGIN();
    RUN_TEST(number_read_should_know_both_grammars);
    RUN_TEST(number_read_should_stop_behind_the_number);
    RUN_TEST(number_read_should_keep_the_sign_of_zero);
    RUN_TEST(number_read_should_round_hard_cases_to_nearest);
    RUN_TEST(number_read_should_honour_800_digits);
    RUN_TEST(number_read_should_know_every_power_of_ten);
    RUN_TEST(number_read_should_equal_strtod_on_random_texts);
    return UNITY_END();
}

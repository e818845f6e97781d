/* Doubles as text: exact, and the same as the C library prints. */
#include "api/number_text.h"
#include "core/num.h"
#include "core/random.h"

#include "tests/support/unit.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

static uint64_t half_of_the_bits(uint64_t *seed)
{
    return (uint64_t)(random_uniform(seed) * 0x1p32);
}

static void check(double value)
{
    char text[NUMBER_TEXT_SIZE], plain[NUMBER_TEXT_SIZE];
    const size_t n = number_text(value, text);
    (void)number_text_plain(value, plain);
    char digits[NUMBER_TEXT_SIZE];
    (void)snprintf(digits, sizeof digits, "%.*g", number_digits(value), value);
    if (n != strlen(text) || strcmp(text, plain) != 0 || strcmp(text, digits) != 0) {
        fail_msg("%a is printed as %s instead of %s", value, text, plain);
    }
    if (!num_same_bits(strtod(text, NULL), value)) {
        fail_msg("%a printed as %s does not read back", value, text);
    }
}

/* All doubles alike: mostly very large and very small ones. */
static void any_bits(void **state)
{
    uint64_t seed = 20240131;
    (void)state;
    for (int i = 0; i < 300000; i++) {
        const uint64_t bits = half_of_the_bits(&seed) << 32 | half_of_the_bits(&seed);
        double value = 0.0;
        memcpy(&value, &bits, sizeof value);
        if (isfinite(value)) {
            check(value);
        }
    }
}

/* Numbers as results have them, of every size. */
static void usual_sizes(void **state)
{
    uint64_t seed = 20240201;
    (void)state;
    for (int i = 0; i < 1000000; i++) {
        const double fraction = random_uniform(&seed), size = random_uniform(&seed);
        check((2.0 * fraction - 1.0) * pow(10.0, 60.0 * size - 40.0));
    }
}

/* Few digits, and what lies beside them: where one digit less or more decides. */
static void short_numbers_and_their_neighbours(void **state)
{
    uint64_t seed = 20240202;
    (void)state;
    for (int i = 0; i < 200000; i++) {
        const double few = floor(1e5 * random_uniform(&seed));
        const double value = few * pow(10.0, floor(30.0 * random_uniform(&seed)) - 20.0);
        check(value);
        check(nextafter(value, INFINITY));
        check(nextafter(value, -INFINITY));
    }
}

static void powers_and_their_neighbours(void **state)
{
    (void)state;
    for (int e = -1074; e < 1024; e++) {
        const double two = ldexp(1.0, e);
        check(two);
        check(nextafter(two, INFINITY));
        check(nextafter(two, 0.0));
    }
    for (int e = -323; e <= 308; e++) {
        const double ten = pow(10.0, e);
        check(ten);
        check(nextafter(ten, INFINITY));
        check(-nextafter(ten, 0.0));
    }
}

static void known_texts(void **state)
{
    static const struct {
        double value;
        const char *text;
    } known[] = {
        {0.1, "0.1"},     {0.1 + 0.2, "0.30000000000000004"},       {1.0, "1"},
        {-0.0, "-0"},     {5e-324, "4.94065645841247e-324"},        {1e300, "1e+300"},
        {2e-4, "0.0002"}, {1.0 / 3.0, "0.3333333333333333"},        {1e15, "1e+15"},
        {2e-5, "2e-05"},  {123456789012345, "123456789012345"},     {-2.5e-5, "-2.5e-05"},
        {100.0, "100"},   {9007199254740993.0, "9007199254740992"},
    };
    char text[NUMBER_TEXT_SIZE];
    (void)state;
    for (size_t i = 0; i < sizeof known / sizeof known[0]; i++) {
        (void)number_text(known[i].value, text);
        assert_string_equal(text, known[i].text);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(any_bits),
        cmocka_unit_test(usual_sizes),
        cmocka_unit_test(short_numbers_and_their_neighbours),
        cmocka_unit_test(powers_and_their_neighbours),
        cmocka_unit_test(known_texts),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}

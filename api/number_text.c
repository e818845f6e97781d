#include "api/number_text.h"

#include "core/num.h"

#include <assert.h>
#include <math.h>
#include <stdbool.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

__extension__ typedef unsigned __int128 wide;

enum {
    DIGITS_MIN = 15,
    DIGITS_MAX = 17,     /* always enough */
    FIVE_MAX = 27,       /* largest power of five in 64 bits */
    SCALE_MAX = 54,      /* 5^54 fits into 128 bits, */
    FRACTION_MAX = 119,  /* and so do twice what 15 digits drop and so many bits behind the point */
    EXPONENT_FIXED = -4, /* %g: smaller numbers have an exponent */
};

/* A number as (whole + below * 2^-fraction)/10^scale, exactly, whole having 17 digits. */
struct scaled {
    uint64_t whole;
    wide below;
    wide half_gap; /* half of the distance to the neighbouring doubles, in 2^-(fraction + 1) */
    int scale, fraction;
    bool even; /* a tie with a neighbour reads back as this number */
};

static wide power_of_five(int n)
{
    static const uint64_t five[FIVE_MAX + 1] = {
        UINT64_C(1),
        UINT64_C(5),
        UINT64_C(25),
        UINT64_C(125),
        UINT64_C(625),
        UINT64_C(3125),
        UINT64_C(15625),
        UINT64_C(78125),
        UINT64_C(390625),
        UINT64_C(1953125),
        UINT64_C(9765625),
        UINT64_C(48828125),
        UINT64_C(244140625),
        UINT64_C(1220703125),
        UINT64_C(6103515625),
        UINT64_C(30517578125),
        UINT64_C(152587890625),
        UINT64_C(762939453125),
        UINT64_C(3814697265625),
        UINT64_C(19073486328125),
        UINT64_C(95367431640625),
        UINT64_C(476837158203125),
        UINT64_C(2384185791015625),
        UINT64_C(11920928955078125),
        UINT64_C(59604644775390625),
        UINT64_C(298023223876953125),
        UINT64_C(1490116119384765625),
        UINT64_C(7450580596923828125),
    };
    return n <= FIVE_MAX ? (wide)five[n] : (wide)five[FIVE_MAX] * five[n - FIVE_MAX];
}

static uint64_t power_of_ten(int n)
{
    return (uint64_t)power_of_five(n) << n;
}

/* The bits of m five, 53 times 128, above so many: at most 64. */
static uint64_t product_above(uint64_t m, wide five, int below)
{
    const wide low = (wide)m * (uint64_t)five;
    const wide high = m * (five >> 64) + (low >> 64); /* counts 2^64 */
    return below >= 64 ? (uint64_t)(high >> (below - 64))
                       : (uint64_t)(high << (64 - below)) | (uint64_t)low >> below;
}

/* False for numbers, mostly very large and very small ones, that do not fit. */
static bool scale(double magnitude, struct scaled *out)
{
    int exponent = 0;
    const uint64_t m = (uint64_t)ldexp(frexp(magnitude, &exponent), 53);
    exponent -= 53; /* magnitude = m 2^exponent, 2^52 <= m */
    int k = DIGITS_MAX - 1 - (int)floor(log10(magnitude));
    for (int turn = 0; turn < 2; turn++) {
        const int fraction = -(exponent + k);
        if (k < 0 || k > SCALE_MAX || fraction < 1 || fraction > FRACTION_MAX) {
            return false;
        }
        const wide five = power_of_five(k);
        const uint64_t whole = product_above(m, five, fraction);
        if (whole >= power_of_ten(DIGITS_MAX - 1) && whole < power_of_ten(DIGITS_MAX)) {
            *out = (struct scaled){.whole = whole,
                                   .below = m * five - ((wide)whole << fraction), /* of 128 bits */
                                   .half_gap = five,
                                   .scale = k,
                                   .fraction = fraction,
                                   .even = (m & 1) == 0};
            return m != UINT64_C(1) << 52; /* below a power of two the gap is half as wide */
        }
        k += whole < power_of_ten(DIGITS_MAX - 1) ? 1 : -1; /* the logarithm was rounded */
    }
    return false;
}

/* The number rounded to so many digits, ties to even as printf; false when another double is
 * nearer.
 */
static bool round_to(const struct scaled *s, int digits, uint64_t *out)
{
    const uint64_t dropped = power_of_ten(DIGITS_MAX - digits);
    const wide unit = (wide)dropped << s->fraction;
    const wide rest = ((wide)(s->whole % dropped) << s->fraction) + s->below;
    uint64_t d = s->whole / dropped;
    const bool up = rest + rest > unit || (rest + rest == unit && (d & 1) == 1);
    d += up;
    const wide off = up ? unit - rest : rest;
    *out = d;
    return off + off < s->half_gap || (off + off == s->half_gap && s->even);
}

/* d, of `digits` digits before its point, times 10^-scale, as %.{digits}g. */
static size_t print(bool negative, uint64_t d, int digits, int scale_10, char *text)
{
    char digit[DIGITS_MAX + 4];
    if (d == power_of_ten(digits)) { /* rounded up to one digit more */
        d /= 10;
        scale_10--;
    }
    for (int i = digits - 1; i >= 0; i--, d /= 10) {
        digit[i] = (char)('0' + d % 10);
    }
    const int exponent = digits - 1 - scale_10;
    int kept = digits;
    while (kept > 1 && digit[kept - 1] == '0') {
        kept--;
    }
    char *p = text;
    if (negative) {
        *p++ = '-';
    }
    const bool fixed = exponent >= EXPONENT_FIXED && exponent < digits;
    const int point = fixed ? exponent + 1 : 1; /* digits before the point */
    if (point <= 0) {
        *p++ = '0';
        *p++ = '.';
        memset(p, '0', (size_t)-point);
        p += -point;
    }
    for (int i = 0; i < kept || i < point; i++) {
        if (i == point && point > 0) {
            *p++ = '.';
        }
        *p++ = i < kept ? digit[i] : '0';
    }
    if (!fixed) {
        const int size = exponent < 0 ? -exponent : exponent;
        *p++ = 'e';
        *p++ = exponent < 0 ? '-' : '+';
        *p++ = (char)('0' + size / 10); /* what can be scaled has two digits */
        *p++ = (char)('0' + size % 10);
    }
    *p = '\0';
    return (size_t)(p - text);
}

/* The text by the C library; its digits, DIGITS_MIN of them when fewer would do. */
static int print_plain(double value, char text[NUMBER_TEXT_SIZE])
{
    int digits = DIGITS_MIN;
    for (;; digits++) {
        (void)snprintf(text, NUMBER_TEXT_SIZE, "%.*g", digits, value);
        if (digits == DIGITS_MAX || num_same_bits(strtod(text, NULL), value)) {
            return digits;
        }
    }
}

size_t number_text_plain(double value, char text[NUMBER_TEXT_SIZE])
{
    assert(isfinite(value));
    (void)print_plain(value, text);
    return strlen(text);
}

/* The same digits as a number; 0 where it cannot be scaled. */
static int shortest(double value, struct scaled *s, uint64_t *d)
{
    int digits = DIGITS_MIN;
    if (value == 0.0 || !scale(fabs(value), s)) {
        return 0;
    }
    while (!round_to(s, digits, d) && digits < DIGITS_MAX) {
        digits++;
    }
    return digits;
}

size_t number_text(double value, char text[NUMBER_TEXT_SIZE])
{
    struct scaled s;
    uint64_t d = 0;
    assert(isfinite(value));
    if (value == 0.0) {
        return (size_t)snprintf(text, NUMBER_TEXT_SIZE, signbit(value) ? "-0" : "0");
    }
    const int digits = shortest(value, &s, &d);
    if (digits == 0) {
        return number_text_plain(value, text);
    }
    return print(value < 0.0, d, digits, s.scale - (DIGITS_MAX - digits), text);
}

int number_digits(double value)
{
    struct scaled s;
    uint64_t d = 0;
    char text[NUMBER_TEXT_SIZE];
    assert(isfinite(value));
    const int digits = shortest(value, &s, &d);
    return digits > 0 ? digits : print_plain(value, text);
}

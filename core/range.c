#include "core/range.h"

#include <math.h>
#include <stdio.h>

static void check_one(const struct range *r, struct failure_list *out)
{
    const bool low = r->open_lo ? r->value > r->lo : r->value >= r->lo;
    const bool high = r->open_hi ? r->value < r->hi : r->value <= r->hi;
    if (isfinite(r->value) && low && high) {
        return;
    }
    char expected[96], got[64];
    if (isfinite(r->lo) && isfinite(r->hi)) {
        (void)snprintf(expected, sizeof expected, "a number %s %.10g and %s %.10g",
                       r->open_lo ? ">" : ">=", r->lo, r->open_hi ? "<" : "<=", r->hi);
    } else if (isfinite(r->lo)) {
        (void)snprintf(expected, sizeof expected, "a finite number %s %.10g",
                       r->open_lo ? ">" : ">=", r->lo);
    } else {
        (void)snprintf(expected, sizeof expected, "a finite number");
    }
    (void)snprintf(got, sizeof got, "%.10g", r->value);
    failure_set(failure_add(out), ST_INVALID, r->pointer, "out_of_range", expected, got,
                "the value is outside its range");
}

void range_check(size_t n, const struct range *r, struct failure_list *out)
{
    for (size_t i = 0; i < n; i++) {
        check_one(&r[i], out);
    }
}

#include "core/range.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

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

void range_check_table(int n, const double *time, const double *value, const char *pointer,
                       const char *value_key, struct failure_list *out)
{
    for (int i = 0; i < n; i++) {
        char at[160], of[160];
        const double low = i > 0 ? time[i - 1] : 0.0;
        (void)snprintf(at, sizeof at, "%.110s/time_s/%d", pointer, i);
        (void)snprintf(of, sizeof of, "%.110s/%s/%d", pointer, value_key, i);
        const struct range rule[] = {{at, time[i], low, HUGE_VAL, i > 0, false},
                                     {of, value[i], -HUGE_VAL, HUGE_VAL, true, true}};
        RANGE_CHECK(rule, out);
    }
}

void range_refuse(struct failure_list *out, const char *pointer, const char *expected, double got)
{
    const char *slash = strrchr(pointer, '/');
    char text[32];
    (void)snprintf(text, sizeof text, "%g", got);
    failure_set(failure_add(out), ST_INVALID, pointer, "out_of_range", expected, text,
                "%s is out of range", slash != NULL ? slash + 1 : pointer);
}

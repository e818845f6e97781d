/* core/range.h
 * Checks of numbers against an interval, as findings with a JSON pointer. Plain values. */
#ifndef AEROM_CORE_RANGE_H
#define AEROM_CORE_RANGE_H

#include "core/status.h"

#include <stdbool.h>
#include <stddef.h>

/* One rule over a number: lo < or <= value < or <= hi. */
struct range {
    const char *pointer;
    double value;
    double lo, hi;         /* -+HUGE_VAL where there is no limit; the value must be finite anyway */
    bool open_lo, open_hi; /* the bound itself is not allowed */
};

/* Appends a finding for each of n numbers outside its range. */
void range_check(size_t n, const struct range *r, struct failure_list *out);

#define RANGE_CHECK(table, out) range_check(sizeof(table) / sizeof((table)[0]), table, out)

#endif

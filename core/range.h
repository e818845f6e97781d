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

/* The same for a table over time of n rows: times that ascend from 0 on, and finite values. Their
 * pointers are POINTER/time_s/I and POINTER/VALUE_KEY/I. */
void range_check_table(int n, const double *time, const double *value, const char *pointer,
                       const char *value_key, struct failure_list *out);

/* Appends the finding for a number outside a range that `expected` puts in words. */
void range_refuse(struct failure_list *out, const char *pointer, const char *expected, double got);

#endif

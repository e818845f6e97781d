#include "tests/verify/check.h"

#include <assert.h>
#include <math.h>
#include <stdarg.h>
#include <stdlib.h>

void check_add(struct check_list *list, enum check_kind kind, const char *unit, double value,
               double reference, double tolerance, const char *source, const char *what, ...)
{
    assert(list->n < CHECK_MAX);
    struct check *c = &list->item[list->n++];
    *c = (struct check){.unit = unit,
                        .kind = kind,
                        .value = value,
                        .reference = reference,
                        .tolerance = tolerance,
                        .source = source};
    va_list args;
    va_start(args, what);
    (void)vsnprintf(c->what, sizeof c->what, what, args);
    va_end(args);
}

double check_error(const struct check *c)
{
    return c->kind == CHECK_RELATIVE ? c->value / c->reference - 1.0 : c->value - c->reference;
}

bool check_passes(const struct check *c)
{
    switch (c->kind) {
    case CHECK_AT_MOST:
        return c->value <= c->tolerance;
    case CHECK_AT_LEAST:
        return c->value >= c->tolerance;
    case CHECK_RELATIVE:
    case CHECK_ABSOLUTE:
        break;
    }
    return fabs(check_error(c)) <= c->tolerance;
}

/* Errors at the level of rounding differ from machine to machine: they print as 0. */
static double shown(double error)
{
    return fabs(error) < 1e-9 ? 0.0 : error;
}

static void print_row(const struct check *c, FILE *out)
{
    const bool bound = c->kind == CHECK_AT_MOST || c->kind == CHECK_AT_LEAST;
    (void)fprintf(out, "| %s | %.*g%s%s | ", c->what, bound ? 2 : 6, c->value,
                  c->unit[0] != '\0' ? " " : "", c->unit);
    switch (c->kind) {
    case CHECK_RELATIVE:
        (void)fprintf(out, "%.6g | %+.2g %% | %.3g %% |", c->reference,
                      shown(100.0 * check_error(c)), 100.0 * c->tolerance);
        break;
    case CHECK_ABSOLUTE:
        (void)fprintf(out, "%.6g | %+.2g | %.2g |", c->reference, shown(check_error(c)),
                      c->tolerance);
        break;
    case CHECK_AT_MOST:
        (void)fprintf(out, " | | at most %.3g |", c->tolerance);
        break;
    case CHECK_AT_LEAST:
        (void)fprintf(out, " | | at least %.3g |", c->tolerance);
        break;
    }
    (void)fprintf(out, " %s%s |\n", check_passes(c) ? "" : "**missed** ", c->source);
}

void check_print_markdown(const struct check_group *group, FILE *out)
{
    struct check_list *list = calloc(1, sizeof *list);
    assert(list != NULL);
    group->fill(list);
    (void)fprintf(out, "\n## %s\n\n%s\n\n", group->title, group->text);
    (void)fprintf(out, "| quantity | value | reference | error | tolerance | source |\n");
    (void)fprintf(out, "|---|---|---|---|---|---|\n");
    for (int i = 0; i < list->n; i++) {
        print_row(&list->item[i], out);
    }
    free(list);
}

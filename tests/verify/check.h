/* tests/verify/check.h
 * One verified number: value, reference, tolerance, source. The groups of tests/verify fill lists
 * of them; the test programs assert each, and aerom_validate prints the same lists as Markdown. */
#ifndef AEROM_TESTS_VERIFY_CHECK_H
#define AEROM_TESTS_VERIFY_CHECK_H

#include <stdbool.h>
#include <stdio.h>

enum check_kind {
    CHECK_RELATIVE, /* |value/reference - 1| <= tolerance */
    CHECK_ABSOLUTE, /* |value - reference| <= tolerance */
    CHECK_AT_MOST,  /* value <= tolerance */
    CHECK_AT_LEAST  /* value >= tolerance */
};

struct check {
    char what[112];
    const char *unit;
    enum check_kind kind;
    double value, reference, tolerance;
    const char *source; /* where the reference comes from */
};

enum { CHECK_MAX = 512 };

struct check_list {
    int n;
    struct check item[CHECK_MAX];
};

/* Appends one check; `what` is a printf format. More than CHECK_MAX is an assertion. */
void check_add(struct check_list *list, enum check_kind kind, const char *unit, double value,
               double reference, double tolerance, const char *source, const char *what, ...)
    __attribute__((format(printf, 8, 9)));

bool check_passes(const struct check *c);
/* value - reference in the measure of the tolerance: relative or absolute, signed. */
double check_error(const struct check *c);

/* A chapter of the validation page. */
struct check_group {
    const char *name;
    const char *title;
    const char *text; /* what is compared with what, and what is known about it */
    void (*fill)(struct check_list *list);
};

/* X(name): every group is `const struct check_group group_<name>` in tests/verify/<name>.c. */
#define CHECK_GROUPS(X)                                                                            \
    X(beams)                                                                                       \
    X(sections)                                                                                    \
    X(strips)                                                                                      \
    X(stations)                                                                                    \
    X(loads)                                                                                       \
    X(shear)                                                                                       \
    X(boxes)                                                                                       \
    X(open_sections)                                                                               \
    X(convergence)                                                                                 \
    X(properties)                                                                                  \
    X(reference_3d)                                                                                \
    X(flat)                                                                                        \
    X(lifting_line)                                                                                \
    X(stalled_line)                                                                                \
    X(unsteady)                                                                                    \
    X(dynamic_stall)                                                                               \
    X(stability)                                                                                   \
    X(integrators)                                                                                 \
    X(examples)                                                                                    \
    X(damping)                                                                                     \
    X(gusts)                                                                                       \
    X(axes)                                                                                        \
    X(static_aero)                                                                                 \
    X(coupling)

#define CHECK_DECLARE(name) extern const struct check_group group_##name;
CHECK_GROUPS(CHECK_DECLARE)
#undef CHECK_DECLARE

void check_print_markdown(const struct check_group *group, FILE *out);

#endif

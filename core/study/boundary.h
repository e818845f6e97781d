/* core/study/boundary.h
 * Where one field of a case changes the side of an answer: the sign of a damping, the class of a
 * verdict. A few points bracket the change, then the bracket is narrowed to a tolerance.
 *
 * Plain values; the caller's function evaluates. The same answers give the same points, bit for
 * bit, so a search that was interrupted is repeated with the answers known and goes on. */
#ifndef AEROM_CORE_STUDY_BOUNDARY_H
#define AEROM_CORE_STUDY_BOUNDARY_H

#include "core/status.h"

#include <stdbool.h>

enum {
    BOUNDARY_SCAN_MAX = 65,    /* points of the scan */
    BOUNDARY_SAMPLES_MAX = 128 /* evaluations of one search */
};
/* The finest tolerance, in parts of the range. */
#define BOUNDARY_TOLERANCE_LEAST 1e-9

/* How a search goes over the range: each point for itself; or with growing or falling field, each
 * point from where the one before it ended, which shows hysteresis. */
enum boundary_sweep { BOUNDARY_ALONE, BOUNDARY_UP, BOUNDARY_DOWN, BOUNDARY_SWEEPS };
const char *boundary_sweep_name(enum boundary_sweep s); /* "alone" "up" "down" */

struct boundary_def {
    double from, to;     /* of the field, from < to */
    double tolerance;    /* width of the last bracket, in the unit of the field */
    int scan;            /* equidistant points first, both ends included: default 5 */
    int evaluations_max; /* of one search, the scan included: default 64 */
};

/* One evaluation. */
struct boundary_sample {
    double x;
    enum status status; /* other than ST_OK: the evaluation failed and nothing is known there */
    int side;           /* -1 or 1; 0 where it failed */
    double value;       /* has the sign of the side; NaN where a class alone tells the side */
};

/* Asks for the sample at x. `before` is the sample of this search to go on from in a sweep, -1 for
 * the first and for BOUNDARY_ALONE. Fills status, side and value. A status other than ST_OK ends
 * the search (cancelled, out of memory). */
typedef enum status (*boundary_evaluate)(void *context, double x, enum boundary_sweep sweep,
                                         int before, struct boundary_sample *out);

enum boundary_outcome {
    BOUNDARY_FOUND,
    BOUNDARY_NOT_BRACKETED, /* one side over the whole scan */
    BOUNDARY_FAILED,        /* the points that would decide cannot be evaluated */
    BOUNDARY_EXHAUSTED,     /* no evaluations left; the bracket is wider than the tolerance */
    BOUNDARY_OUTCOMES
};
const char *boundary_outcome_name(enum boundary_outcome o); /* "found" "not_bracketed" ... */

struct boundary_result {
    enum boundary_outcome outcome;
    double x;            /* BOUNDARY_FOUND, inside the bracket; else NaN */
    double lower, upper; /* last bracket; the range where there is none */
    int side_below;      /* below the boundary; without a bracket that of all, 0 when all failed */
    int changes;         /* of side between neighbours of the scan; the one found is the first met:
                            the lowest, in a sweep down the highest */
    int n;               /* evaluations, in order; the scan comes first */
    int n_failed;
    struct boundary_sample sample[BOUNDARY_SAMPLES_MAX];
};

void boundary_def_defaults(struct boundary_def *def);
/* Appends what is out of range; pointers are those of the definition of a study. */
void boundary_def_check(const struct boundary_def *def, struct failure_list *out);

/* Searches a definition that passed the check. A change that happens and is undone between two
 * points of the scan is not seen. *out is filled also when an evaluation ended the search. */
MUST_CHECK enum status boundary_search(const struct boundary_def *def, enum boundary_sweep sweep,
                                       boundary_evaluate evaluate, void *context,
                                       struct boundary_result *out);

#endif

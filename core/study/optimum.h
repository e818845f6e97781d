/* core/study/optimum.h
 * Least value of an answer over some fields of a case, within bounds and under constraints, without
 * derivatives. The one file that sees NLopt.
 *
 * The caller's function evaluates. One thread a search; searches from different starts share
 * nothing. The same answers give the same points, bit for bit, so a search that was interrupted is
 * repeated with the answers known and goes on. */
#ifndef AEROM_CORE_STUDY_OPTIMUM_H
#define AEROM_CORE_STUDY_OPTIMUM_H

#include "core/status.h"

#include <stdbool.h>

enum {
    OPTIMUM_VARIABLES_MAX = 16,
    OPTIMUM_CONSTRAINTS_MAX = 16,
    OPTIMUM_STARTS_MAX = 64,
    OPTIMUM_EVALUATIONS_MAX = 10000 /* of one search */
};

/* Linear models in a shrinking region, from each start (COBYLA: Powell 1994); or division of the
 * whole box (DIRECT-L: Gablonsky and Kelley, J. Global Optim. 21, 2001) for half the evaluations,
 * then linear models about the best point. */
enum optimum_method { OPTIMUM_COBYLA, OPTIMUM_DIRECT, OPTIMUM_METHODS };
const char *optimum_method_name(enum optimum_method m); /* "cobyla" "direct" */
/* OPTIMUM_METHODS for another name. */
enum optimum_method optimum_method_of(const char *name);

struct optimum_def {
    enum optimum_method method; /* default OPTIMUM_COBYLA */
    int n;
    double lower[OPTIMUM_VARIABLES_MAX], upper[OPTIMUM_VARIABLES_MAX]; /* lower < upper */
    double start[OPTIMUM_VARIABLES_MAX]; /* of the first search with COBYLA; default the middle */
    bool has_start;
    int n_constraint;
    double scale[OPTIMUM_CONSTRAINTS_MAX]; /* an excess that matters, > 0: its unit */
    int starts;                            /* searches, 1 with OPTIMUM_DIRECT; default 3 */
    int evaluations_max;                   /* of one search; default 100 */
    double tolerance;  /* of the variables, in parts of their ranges; default 1e-3 */
    double excess_max; /* of a feasible point, in parts of `scale`; default 1e-6 */
};

/* One evaluation. */
struct optimum_point {
    double x[OPTIMUM_VARIABLES_MAX];
    enum status status; /* other than ST_OK: the evaluation failed and nothing is known there */
    double objective;   /* to be small */
    double excess[OPTIMUM_CONSTRAINTS_MAX]; /* over the limit of a constraint; negative: met */
    double violation; /* largest excess/scale, at least 0; filled by the search */
    bool feasible;    /* likewise */
};

/* Fills status, objective and excess at x. A status other than ST_OK ends the search. */
typedef enum status (*optimum_evaluate)(void *context, struct optimum_point *point);

enum optimum_outcome {
    OPTIMUM_FOUND,      /* to the tolerance */
    OPTIMUM_EXHAUSTED,  /* no evaluations left; best is the best so far */
    OPTIMUM_INFEASIBLE, /* no point met the constraints; best has the least violation */
    OPTIMUM_FAILED,     /* no point could be evaluated, or not that of the start */
    OPTIMUM_OUTCOMES
};
const char *optimum_outcome_name(enum optimum_outcome o); /* "found" "exhausted" ... */

struct optimum_result {
    enum optimum_outcome outcome;
    int best;                    /* place of the best point; -1 when all failed */
    int n, n_failed;             /* evaluations */
    struct optimum_point *point; /* (n), in order; owned */
};

void optimum_def_defaults(struct optimum_def *def);
/* Appends what is out of range; pointers are those of the definition of a study. */
void optimum_def_check(const struct optimum_def *def, struct failure_list *out);

/* Where search `index` begins: the start given or the middle, then points of the Sobol sequence. */
void optimum_start(const struct optimum_def *def, int index, double *x);

/* Is a the better of the two: feasible, of smaller objective; among infeasible ones of smaller
 * violation; any before a failed one. */
bool optimum_is_better(const struct optimum_point *a, const struct optimum_point *b);

/* One search of a definition that passed the check. *out is owned by the caller (optimum_done),
 * also when an evaluation ended the search with its status. */
MUST_CHECK enum status optimum_search(const struct optimum_def *def, int index,
                                      optimum_evaluate evaluate, void *context,
                                      struct optimum_result *out);
/* Accepts a zeroed struct. */
void optimum_done(struct optimum_result *r);

#endif

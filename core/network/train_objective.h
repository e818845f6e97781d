/* core/network/train_objective.h
 * What a training makes small. The samples of a record are not independent, and a record past
 * stall keeps a misfit that no network of these inputs removes: the sum of squares is almost all
 * its own, and small motions would hardly be learnt. So the errors are counted record by record,
 *   objective = sum over groups of n phi(m)/sum of n,  phi(m) = t log(1 + m/t),
 * with m the weighted mean square error of the n samples of a group and t the tolerance: m while
 * that is small beside t, and beyond only its logarithm (the likelihood of records whose noise is
 * not known, Student's t). t = 0: phi(m) = m, the mean square.
 *
 * phi is concave: the squares with the weights phi'(m) = 1/(1 + m/t) of the last step lie above it
 * and touch it there, so that a step which makes them smaller makes the objective smaller.
 *
 * Free of state; nothing allocates. */
#ifndef AEROM_CORE_NETWORK_TRAIN_OBJECTIVE_H
#define AEROM_CORE_NETWORK_TRAIN_OBJECTIVE_H

#include "core/network/perceptron.h"

/* Scaled samples in groups that follow one another: records, and the anchors. Borrowed. */
struct train_part {
    int n;           /* samples */
    const double *x; /* (n_in x n) */
    const double *t; /* (n_out x n) */
    const double *w; /* weights of a mean of one (n); NULL: all alike */
    int n_group;
    const int *end; /* first sample behind each group (n_group), the last one n */
};

/* Mean square errors m of the groups first..last - 1 into error (n_group). */
void train_group_errors(const struct perceptron *s, const double *p, const struct train_part *part,
                        int first, int last, double *error);
/* From the m of all groups. */
double train_objective(const struct train_part *part, double tolerance, const double *error);
/* The objective at p, without keeping the m. */
double train_objective_at(const struct perceptron *s, const double *p,
                          const struct train_part *part, double tolerance);
/* Weights of the samples times the phi'(m) of their group: w (n). */
void train_weights(const struct train_part *part, double tolerance, const double *error, double *w);

#endif

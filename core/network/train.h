/* core/network/train.h
 * Training of a network on a dataset (App. B): scaling, random start, one of two optimisers, early
 * stopping on the records held out.
 *
 * The caller's thread, and with Levenberg-Marquardt a second one where the control lends it. The
 * same dataset and definition give the same bits, as far as the Cholesky factors of the BLAS do. */
#ifndef AEROM_CORE_NETWORK_TRAIN_H
#define AEROM_CORE_NETWORK_TRAIN_H

#include "core/control.h"
#include "core/network/dataset.h"
#include "core/network/train_objective.h"

/* Levenberg-Marquardt on all samples; Adam on small batches, as networks are mostly trained. */
enum train_optimiser { TRAIN_LM, TRAIN_ADAM, TRAIN_OPTIMISERS };
/* "lm" "adam"; TRAIN_OPTIMISERS for another name. */
const char *train_optimiser_name(enum train_optimiser o);
enum train_optimiser train_optimiser_of(const char *name);

struct train_def {
    enum train_optimiser optimiser;
    int epochs;    /* at most, 1..TRAIN_EPOCHS_MAX */
    int patience;  /* ends after so many without a smaller error of the records held out */
    double decay;  /* weight of the mean square of the parameters beside the error, >= 0 */
    double rate;   /* Adam: step length, > 0 */
    int batch;     /* Adam: samples a step */
    uint64_t seed; /* of the start, and of the order of the samples */
    /* The network is odd by construction (perceptron.h): half as many samples and parameters for as
     * many neurons, which must be even; for outputs c_l and c_m alone. */
    bool symmetric;
    /* Misfit from which on a record counts only by its logarithm (train_objective.h), as a share of
     * its range; where no balance weighs the records (dataset.h), of the ranges of all. 0: plain
     * squares. */
    double tolerance;
};
enum { TRAIN_EPOCHS_MAX = 100000 };

/* 300 epochs with a patience of 30 for LM, 2000 and 200 for Adam; decay 1e-4, rate 1e-3, batches of
 * 64, seed 1. */
void train_def_defaults(enum train_optimiser optimiser, struct train_def *def);
/* Appends what is out of range; pointers are those of the command line's options. */
void train_def_check(const struct train_def *def, int n_hidden, struct failure_list *out);

/* Objectives (train_objective.h) of the scaled outputs after each epoch; entry 0 is the start. */
struct train_curve {
    int n;    /* 1..epochs + 1 */
    int best; /* entry with the least error of the records held out: the network that is kept */
    double *trained, *held; /* owned (epochs + 1) */
};
/* Room for so many epochs and the start. */
MUST_CHECK enum status train_curve_init(int epochs, struct train_curve *c);
void train_curve_done(struct train_curve *c);
/* Notes the errors after an epoch: c->best is c->n - 1 where that was the best so far. True when
 * the patience has run out. */
bool train_curve_add(struct train_curve *c, int patience, double trained, double held);

/* What an optimiser works on. */
struct train_problem {
    struct perceptron shape;
    struct train_part trained, held;
    double tolerance; /* a mean square of scaled outputs, weighed */
    double *block;    /* holds the samples when train_problem_init has made them, owned */
    int *end;         /* and the ends of their groups */
};
/* From a dataset and a network whose inputs, outputs, n_hidden and scaling are set. ST_NO_MEMORY.
 */
MUST_CHECK enum status train_problem_init(const struct dataset *data, const struct network_def *net,
                                          const struct train_def *def, struct train_problem *p);
/* Accepts a zeroed struct. */
void train_problem_done(struct train_problem *p);

/* Trains a network whose inputs, outputs and n_hidden are set; fills scaling, hull and weights,
 * which the caller frees with network_def_done. ST_INVALID with *problems filled where an input is
 * constant; ST_CANCELLED; ST_NOT_FINITE. On failure *curve is unchanged. */
MUST_CHECK enum status train_network(const struct dataset *data, const struct train_def *def,
                                     const struct sim_control *control, struct network_def *net,
                                     struct train_curve *curve, struct failure_list *problems);

/* For the optimisers: true when the caller wants to stop; tells him how far it is. */
bool train_is_cancelled(const struct sim_control *control, int epoch, int epochs);
/* Notes the errors of p after an epoch and keeps p in best when it is better than all before. True
 * when the patience has run out. */
bool train_note(const struct train_problem *problem, const struct train_def *def, double trained,
                const double *p, double *best, struct train_curve *curve);

#endif

/* core/network/train_lm.h
 * Levenberg-Marquardt training: damped Gauss-Newton steps on all samples, the normal equations
 * summed block by block and solved by Cholesky (Hagan & Menhaj 1994). The samples are summed in two
 * halves, on two threads where the control lends one; memory of the normal equations and one block
 * of each half is taken once. */
#ifndef AEROM_CORE_NETWORK_TRAIN_LM_H
#define AEROM_CORE_NETWORK_TRAIN_LM_H

#include "core/network/train.h"

/* p (count) holds the start and receives the last step, best (count) the parameters with the least
 * error of the records held out. The curve has room for all epochs and receives them. Ends when
 * epochs or patience are used up, or when no damping gives a smaller error. ST_CANCELLED,
 * ST_NO_MEMORY, ST_NOT_FINITE. */
MUST_CHECK enum status train_lm(const struct train_problem *problem, const struct train_def *def,
                                const struct sim_control *control, double *p, double *best,
                                struct train_curve *curve);

#endif

/* core/network/train_adam.h
 * Training by Adam (Kingma & Ba 2015): first-order steps on small batches drawn anew each epoch.
 * One thread; memory is taken once. */
#ifndef AEROM_CORE_NETWORK_TRAIN_ADAM_H
#define AEROM_CORE_NETWORK_TRAIN_ADAM_H

#include "core/network/train.h"

/* As train_lm; the error of an epoch is that of its end. */
MUST_CHECK enum status train_adam(const struct train_problem *problem, const struct train_def *def,
                                  const struct sim_control *control, double *p, double *best,
                                  struct train_curve *curve);

#endif

/* core/network/adam.h
 * One step of Adam (Kingma & Ba 2015) on a vector of parameters, with the decay of the weights in
 * the objective. One thread; memory is taken once. */
#ifndef AEROM_CORE_NETWORK_ADAM_H
#define AEROM_CORE_NETWORK_ADAM_H

#include "core/status.h"

struct adam {
    int count;
    double rate, weight; /* step length; of the square of each parameter in the objective */
    double *mean;        /* (count), owned */
    double *square;      /* (count) */
    double power_mean, power_square;
};

/* `decay` weighs the mean square of the parameters in the objective. */
MUST_CHECK enum status adam_init(int count, double rate, double decay, struct adam *s);
/* Accepts a zeroed struct. */
void adam_done(struct adam *s);

/* Moves p (count) against the gradient g (count) of the error, to which that of the decay is added.
 */
void adam_step(struct adam *s, const double *g, double *p);

#endif

/* core/coupling/network_increment.h
 * The dynamic increment of a network at the stations of a march (section 2.3): what it sees, and
 * what it adds to the coefficients of the model it stands on. */
#ifndef AEROM_CORE_COUPLING_NETWORK_INCREMENT_H
#define AEROM_CORE_COUPLING_NETWORK_INCREMENT_H

#include "core/coupling/workspace.h"

/* Adds to w->cl, cd, cm; needs the kinematics and the induced angle of this evaluation. Advances
 * the sliding mean and the lags by one time step, or, with `steady`, sets them to the present
 * state. Nothing without a network. */
void network_increment(const struct model *m, struct workspace *w, bool steady);

#endif

/* core/network/assess.h
 * How good a network is on one record of a moving section: errors of the coefficients and of the
 * energy the flow feeds into the motion, beside those of the steady polar alone.
 *
 * Free of state. */
#ifndef AEROM_CORE_NETWORK_ASSESS_H
#define AEROM_CORE_NETWORK_ASSESS_H

#include "core/network/dataset.h"

/* Work by rho V^2 c^2/2 over the record behind its start, or over its last whole periods: the
 * integrals of c_m d(theta) and c_l d(w/c), per period where there is one. */
struct assess_work {
    double pitch, plunge;
};

struct assessment {
    double range_cl, range_cm; /* of the record: largest less least */
    /* Root mean square of the difference to the record. */
    double network_cl, network_cm, steady_cl, steady_cm;
    struct assess_work record, network, steady;
    double outside_hull; /* share of the samples */
};

/* (work of the model - work of the record)/work of the record, Eq. (B.1), with the power
 * c_p = c_m alpha_dot c/V that its misprint stands for and that of the plunge beside it. */
double assess_energy_error(const struct assess_work *model, const struct assess_work *record);

/* Everything but outside_hull, of coefficients that any model gives: steady and model
 * (NET_OUT_COUNT x n) at every sample. ST_INVALID: no sample behind the start. */
MUST_CHECK enum status assess_coefficients(const struct flow_record *r, const double *steady,
                                           const double *model, struct assessment *out);
/* ST_NO_MEMORY, or the record has no sample behind its start: ST_INVALID. */
MUST_CHECK enum status assess_record(const struct flow_record *r, double window,
                                     const struct polar *polar, const struct network *net,
                                     struct assessment *out);

#endif

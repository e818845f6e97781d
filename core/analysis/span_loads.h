/* core/analysis/span_loads.h
 * Loads along the span, averaged over the window of the means (Fig. 7). */
#ifndef AEROM_CORE_ANALYSIS_SPAN_LOADS_H
#define AEROM_CORE_ANALYSIS_SPAN_LOADS_H

#include "core/coupling/record.h"

/* Means at the aerodynamic stations, in the middle of the elements. SI, radians. The drag is NaN if
 * the polar has none. */
struct span_loads {
    double window_from, window_to; /* [s] */
    int n_station;
    double z[LIMIT_ELEMENTS], chord[LIMIT_ELEMENTS];                           /* [m] */
    double cl[LIMIT_ELEMENTS], cd[LIMIT_ELEMENTS], cm[LIMIT_ELEMENTS];         /* about mid-chord */
    double lift[LIMIT_ELEMENTS], drag[LIMIT_ELEMENTS], moment[LIMIT_ELEMENTS]; /* per length */
    double induced[LIMIT_ELEMENTS];                                            /* w_i/V */
    double alpha[LIMIT_ELEMENTS]; /* effective angle of attack */
};

/* Of a march that recorded at least its initial state. */
void span_loads_report(const struct model *m, const struct record *r, struct span_loads *out);

#endif

/* core/coupling/loads.h
 * One evaluation of the aerodynamics: modal state in, modal loads and station values out. */
#ifndef AEROM_CORE_COUPLING_LOADS_H
#define AEROM_CORE_COUPLING_LOADS_H

#include "core/coupling/workspace.h"

/* Reads w->q, qd, qdd, qdd_previous; writes the station arrays and w->load. Advances the sliding
 * mean by one step, or, with `steady`, sets it to the present angle (equilibrium, start). */
void loads_evaluate(const struct model *m, struct workspace *w, bool steady);

/* Totals over the span of the last evaluation. */
struct load_totals {
    double lift, drag, moment; /* [N], [N], [N m] */
    double cl, cd, cm;         /* on the planform area; c_m also on the mean chord */
};
struct load_totals loads_total(const struct model *m, const struct workspace *w);

#endif

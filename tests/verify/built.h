/* tests/verify/built.h
 * Shortcuts of the verification: a model that must build, modes by family, static deflection, and a
 * finished simulation. Failures end the program with the reason: there is nothing to verify then.
 */
#ifndef AEROM_TESTS_VERIFY_BUILT_H
#define AEROM_TESTS_VERIFY_BUILT_H

#include "core/sim.h"

/* model_build that must succeed; free with model_done. */
void built_model(const struct case_def *def, struct model *out);

/* Frequency [Hz] of the number-th (0 first) mode whose largest energy share is `share` (order of
 * modes.h: bending, lag, torsion, axial); NaN when there is none. */
double built_frequency(const struct model *m, int share, int number);

/* Displacements (n_dof), malloc'ed, under a load vector f (n_dof). */
double *built_static(const struct model *m, const double *f);

/* A simulation that must run; destroy with sim_destroy. */
struct sim *built_run(const struct case_def *def);

#endif

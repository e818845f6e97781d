/* tests/verify/built.h
 * Shortcuts of the verification: a model that must build, modes by family, static deflection, and a
 * finished simulation. Failures end the program with the reason: there is nothing to verify then.
 */
#ifndef AEROM_TESTS_VERIFY_BUILT_H
#define AEROM_TESTS_VERIFY_BUILT_H

#include "core/analysis/statics.h"
#include "core/sim.h"

/* model_build that must succeed; free with model_done. */
void built_model(const struct case_def *def, struct model *out);

/* Frequency [Hz] of the number-th (0 first) mode whose largest energy share is `share` (order of
 * modes.h: bending, lag, torsion, axial); NaN when there is none. */
double built_frequency(const struct model *m, int share, int number);

/* Displacements (n_dof), malloc'ed, under a load vector f (n_dof). */
double *built_static(const struct model *m, const double *f);

/* Model (CASE_SECTION) of a shape alone; free with model_done. */
void built_section(const struct shape *shape, struct model *out);

/* Static answer of a model of CASE_STATIC; free with statics_done. */
void built_answer(const struct model *m, struct static_result *out);

/* Tip motion of a static case. */
struct beam_motion built_tip(const struct case_def *def);

/* Frequency [Hz] of mode number j (0 first). */
double built_hz(const struct model *m, int j);

/* A shipped case by the name of its file, without ending. Its definition borrows from it. */
struct built_case;
struct built_case *built_shipped(const char *name);
const struct case_def *built_case_def(const struct built_case *c);
void built_release(struct built_case *c);

/* A simulation that must run; destroy with sim_destroy. */
struct sim *built_run(const struct case_def *def);

#endif

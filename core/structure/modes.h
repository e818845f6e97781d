/* core/structure/modes.h
 * Natural modes of the clamped beam: mass-normalised, signed, labelled.
 * The struct owns its arrays; modes_done accepts a zeroed struct. */
#ifndef AEROM_CORE_STRUCTURE_MODES_H
#define AEROM_CORE_STRUCTURE_MODES_H

#include "core/structure/beam.h"

enum { MODE_SHARES = 4 }; /* bending (v), lag (u), torsion (theta), axial (w) */

struct modes {
    int n_mode;
    int n_dof;
    double *omega; /* natural angular frequency, ascending [rad/s] (n_mode) */
    /* Modal mass one, that of the elements' internal freedoms (beam_inner_inertia) included; the
     * largest of tip v, u, theta * chord is positive (n_dof x n_mode). */
    double *shape;
    double *share; /* of the kinetic energy (MODE_SHARES x n_mode) */
};

/* chord [m] weighs twist against displacement where the sign is fixed. */
MUST_CHECK enum status modes_solve(const struct beam *b, double chord, int n_mode,
                                   struct modes *out);
void modes_done(struct modes *m);

/* Tip motion of a mode. */
struct beam_motion modes_tip(const struct beam *b, const struct modes *m, int mode);

#endif

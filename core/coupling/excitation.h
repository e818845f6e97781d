/* core/coupling/excitation.h
 * What drives a simulation from outside: a gust, and a prescribed pitch and plunge of the clamp.
 *
 * The modes are those of the beam in the frame of its clamp. The clamp's motion adds to what the
 * stream sees of the stations, its acceleration loads the modes with the inertia of the beam (and
 * of the air that moves with it), and the beam's axes turn with the pitch. Small motions: no
 * centrifugal or Coriolis loads, and gravity keeps its direction in the beam's axes.
 *
 * Built once with the model, then only read. */
#ifndef AEROM_CORE_COUPLING_EXCITATION_H
#define AEROM_CORE_COUPLING_EXCITATION_H

#include "core/coupling/workspace.h"

/* Room, zeroed, in m->excitation of a model whose n_mode and n_station are set: nothing drives it.
 */
MUST_CHECK enum status excitation_allocate(struct model *m);
/* Fills m->excitation of a model that is complete but for it. */
MUST_CHECK enum status excitation_build(struct model *m);

/* Brings what is imposed on the stations and modes to time t [s]: the imposed arrays of w, its root
 * and gust. Once per time step, before the loads; nothing to do in a case that nothing drives. */
void excitation_set(const struct model *m, double t, struct workspace *w);

/* Flap bending moment of the clamp on the beam [N m], positive under an upward load: the sum of the
 * forces of air, weight and inertia of the last evaluation. */
double excitation_root_bending(const struct model *m, const struct workspace *w);

#endif

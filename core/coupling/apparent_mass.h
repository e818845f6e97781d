/* core/coupling/apparent_mass.h
 * Apparent mass of the air in the modal equations.
 *
 * The pressure of thin-aerofoil theory that follows the accelerations is a mass of the beam, not a
 * load: taken as a load it would come one step late, and with light beams that march blows up. The
 * equations (I + M_a) q'' + D q' + Omega^2 q = load are therefore written in the natural modes of
 * the beam with the air at rest around it, in which mass and stiffness are diagonal again. */
#ifndef AEROM_CORE_COUPLING_APPARENT_MASS_H
#define AEROM_CORE_COUPLING_APPARENT_MASS_H

#include "core/coupling/model.h"

/* Turns the transfer matrices, frequencies and damping of a model from the modes in vacuo to those
 * in still air; sets to_vacuo and damping_coupling. The model must have its transfer. */
MUST_CHECK enum status apparent_mass_apply(struct model *m);

/* Amplitudes or velocities of the modes in vacuo (n_mode) of those the model marches in, and back.
 * Plain copies in a model without apparent mass. */
void apparent_mass_to_vacuo(const struct model *m, const double *q, double *vacuo);
void apparent_mass_from_vacuo(const struct model *m, const double *vacuo, double *q);

#endif

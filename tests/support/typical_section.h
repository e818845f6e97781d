/* tests/support/typical_section.h
 * A rigid section in plunge and pitch as a model of one station and two modes: what the text books
 * of aeroelasticity solve in closed form, through the code that flies beams. */
#ifndef AEROM_TESTS_SUPPORT_TYPICAL_SECTION_H
#define AEROM_TESTS_SUPPORT_TYPICAL_SECTION_H

#include "core/coupling/model.h"

/* Per unit span, about the elastic axis, which is a half-chords behind mid-chord; plunge up and
 * pitch nose-up positive. */
struct typical_section {
    double chord, a;
    double mass, x_theta; /* mass centre x_theta half-chords behind the elastic axis */
    double inertia;       /* about the elastic axis */
    double k_plunge, k_pitch;
    double density;
};

/* The section of Hodges & Pierce that validation data 3.2 solves: b = 1, omega_theta = 1. */
struct typical_section typical_section_hodges(void);

/* Builds a model (no walls, no lifting line) at a speed and a time step. The polar is borrowed by
 * the case and must outlive the model; model_done frees the model. */
void typical_section_model(const struct typical_section *s, const struct polar_def *polar,
                           enum dynamic_type dynamic, double speed, double time_step,
                           struct model *out);

/* The same with the degrees of freedom themselves as "modes" (v of mid-chord, theta; unit mass,
 * no stiffness, no apparent mass in the equations): for prescribed motion through w->q, qd, qdd. */
void typical_section_driven(double chord, double density, const struct polar_def *polar,
                            enum dynamic_type dynamic, double speed, double time_step,
                            struct model *out);

#endif

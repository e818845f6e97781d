/* tests/support/driven_section.h
 * A rigid section as a model of one station whose plunge v of mid-chord and pitch theta are the
 * "modes" themselves (unit mass, no stiffness, no apparent mass in the equations): for prescribed
 * motion through w->q, qd, qdd. Plunge up and pitch nose-up positive. */
#ifndef AEROM_TESTS_SUPPORT_DRIVEN_SECTION_H
#define AEROM_TESTS_SUPPORT_DRIVEN_SECTION_H

#include "core/coupling/model.h"

/* No walls, no lifting line. The polar is borrowed by the case and must outlive the model;
 * model_done frees the model. */
void driven_section_model(double chord, double density, const struct polar_def *polar,
                          enum dynamic_type dynamic, double speed, double time_step,
                          struct model *out);

#endif

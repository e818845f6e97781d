/* core/structure/beam_element.h
 * One element of the beam: rows that turn its freedoms into strains and motions, and its condensed
 * matrices. For core/structure/beam.c and its recovery only. */
#ifndef AEROM_CORE_STRUCTURE_BEAM_ELEMENT_H
#define AEROM_CORE_STRUCTURE_BEAM_ELEMENT_H

#include "core/structure/beam.h"

enum { ELEMENT_ALL = BEAM_OUTER + BEAM_INNER };

/* Internal freedoms: two modes of w, constant and linear part of gamma_xz, gamma_yz and of eta, the
 * twist without warping, and two modes of sigma, the surplus of the warping (warping.h), of
 * lambda, tau and kappa of a flat section (camber.h). */
enum beam_inner {
    IN_W_EVEN,
    IN_W_ODD,
    IN_GX_MEAN,
    IN_GX_SLOPE,
    IN_GY_MEAN,
    IN_GY_SLOPE,
    IN_ETA_MEAN,
    IN_ETA_SLOPE,
    IN_SURPLUS_EVEN,
    IN_SURPLUS_ODD,
    IN_LAG_EVEN,
    IN_LAG_ODD,
    IN_TURN_EVEN,
    IN_TURN_ODD,
    IN_CAMBER_EVEN,
    IN_CAMBER_ODD
};

/* Have the nodes of a beam of this section the freedom? */
bool element_has(const struct section *s, enum shear_model shear, enum beam_freedom freedom);

/* Rows at t in [0, 1] of an element of length h, all freedoms: node 1, node 2, inner. */
struct element_rows {
    double strain[SECTION_WIDE_COUNT * ELEMENT_ALL];
    double motion[SECTION_WIDE_MOTION * ELEMENT_ALL];
};
void element_rows(double t, double h, struct element_rows *out);

/* Stiffness, mass (BEAM_OUTER x BEAM_OUTER) and the recovery of the internal freedoms
 * (BEAM_INNER x BEAM_OUTER) of an element with one section a Gauss point. */
struct element {
    double k[BEAM_OUTER * BEAM_OUTER];
    double m[BEAM_OUTER * BEAM_OUTER];
    double inner[BEAM_INNER * BEAM_OUTER];
    struct inner_inertia inertia; /* with retained shear only */
};
MUST_CHECK enum status element_build(const struct section *const section[BEAM_GAUSS], double h,
                                     enum shear_model shear, struct element *out);

#endif

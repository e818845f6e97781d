/* core/structure/centres.h
 * What a designer reads off the section: centres, principal axes, warping constant, couplings.
 * Plain values; thread-safe. All in the section's frame: x towards the leading edge, y up, origin
 * at mid-chord. */
#ifndef AEROM_CORE_STRUCTURE_CENTRES_H
#define AEROM_CORE_STRUCTURE_CENTRES_H

#include "core/structure/section.h"

struct centres {
    double ea;                   /* axial stiffness at the tension centre, twist free [N] */
    double tension_x, tension_y; /* an axial force there bends the beam in no plane [m] */
    double shear_x, shear_y;     /* a transverse force there does not twist the section [m] */
    double mass_x, mass_y;       /* centre of mass [m] */
    double mass;                 /* [kg/m] */
    double inertia_polar;        /* about the centre of mass [kg m] */
    /* Principal bending stiffnesses about the tension centre, twist and axial force free; the major
     * one resists motion in the direction at `principal_angle` from x, nose-up positive. */
    double ei_major, ei_minor; /* [N m^2] */
    double principal_angle;    /* [rad] in (-pi/2, pi/2] */
    double gj;                 /* torsion about the shear centre, all else free [N m^2] */
    double ei_warping;         /* against theta'', about the shear centre [N m^4] */
    /* Couplings in the classic matrix referred to tension and shear centre. */
    double extension_twist;       /* [N m] */
    double flap_twist, lag_twist; /* moments about -v'' and u'' per unit theta' [N m^2] */
    double flap_lag;              /* [N m^2] */
    double extension_shear_x, extension_shear_y; /* [N], retained set; NaN when not known */
};

MUST_CHECK enum status centres_find(const struct section *s, struct centres *out);

#endif

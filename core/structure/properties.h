/* core/structure/properties.h
 * A section given by its stiffness and mass instead of its walls, as published wings are.
 *
 * The origin is the elastic axis: there the section bends without twist unless bend_twist couples
 * them, and there is the tension centre. Shear deformation is not known; the section only serves
 * beams with condensed shear. Plain values; thread-safe. */
#ifndef AEROM_CORE_STRUCTURE_PROPERTIES_H
#define AEROM_CORE_STRUCTURE_PROPERTIES_H

#include "core/structure/section.h"

/* The axis a torsional inertia is about. */
enum inertia_axis { INERTIA_ELASTIC_AXIS, INERTIA_MASS_CENTRE, INERTIA_MID_CHORD };

struct properties {
    double chord;           /* [m] */
    double ei_flap;         /* against -v'' with theta' held [N m^2] */
    double ei_lag;          /* against u'' [N m^2] */
    double gj;              /* against theta' with the flap curvature held [N m^2] */
    double ea;              /* [N] */
    double bend_twist;      /* moment about -v'' per unit theta', positive washes in [N m^2] */
    double ei_warping;      /* against theta'' [N m^4], 0: the section is free to warp */
    double mass;            /* [kg/m] */
    double torsion_inertia; /* of the mass about an axis along the span [kg m] */
    enum inertia_axis inertia_axis; /* that axis */
    double elastic_axis;            /* place on the chord: 0 leading edge, 1 trailing edge */
    double mass_axis;               /* of the mass centre, likewise */
};

/* NaN for what may be left open (ei_lag, ea, mass_axis), the other defaults, zeros elsewhere. */
void properties_defaults(struct properties *out);

/* Replaces what is still NaN. EI_lag is PROPERTIES_LAG_RATIO EI_flap, so that the lowest lag mode
 * of a uniform beam lies a hundred times above its lowest flap mode; EA is that of a solid
 * rectangle with this EI_lag, 12 EI_lag/c^2; the mass centre lies on the elastic axis. */
#define PROPERTIES_LAG_RATIO 1e4
void properties_complete(struct properties *p);

/* Appends what is physically wrong; `pointer` is the JSON pointer of the section. */
void properties_check(const struct properties *p, const char *pointer, struct failure_list *out);

/* Mid-chord, and the mass centre, from the elastic axis towards the leading edge [m]. */
double properties_mid_chord(const struct properties *p);
double properties_mass_centre(const struct properties *p);

/* Torsional inertia about the mass centre [kg m]. */
double properties_central_inertia(const struct properties *p);

/* Linear blend (1 - t) a + t b of every number; of the inertia that about the mass centre, so that
 * the blend of two admissible sections is one. */
void properties_blend(const struct properties *a, const struct properties *b, double t,
                      struct properties *out);

/* Section of checked properties: diagonal stiffness but for bend_twist; the mass sits on the line
 * of the mass centres, with its torsional inertia and, of its own, no rotary inertia in bending.
 * The rows of the shears in `stiffness` are NaN. */
void properties_build(const struct properties *p, struct section *out);

#endif

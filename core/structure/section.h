/* core/structure/section.h
 * Stiffness and mass of a thin-walled laminated section (App. A of the paper, rebuilt).
 *
 * DEVIATION from (A.33): the paper keeps five strains and holds the in-plane shear of an open wall
 * at zero, which makes a one-sided laminate many times too stiff in torsion. Here the axial warping
 * g(s) of the wall is the one that minimises the strain energy, by finite elements along s, so that
 * open, closed and multi-cell sections are one code path.
 *
 * Strain order: w', psi', phi', theta', theta'', gamma_xz, gamma_yz; without shear psi = u',
 * phi = -v' (A.8, A.9). The section result is a plain value. */
#ifndef AEROM_CORE_STRUCTURE_SECTION_H
#define AEROM_CORE_STRUCTURE_SECTION_H

#include "core/structure/warping.h"

#include <stdbool.h>

enum section_motion { M_U, M_V, M_W, M_DV, M_DU, M_THETA, M_DTHETA, SECTION_MOTION_COUNT };
enum { M_SURPLUS = SECTION_MOTION_COUNT, M_TURN, M_CAMBER, SECTION_WIDE_MOTION };

/* A flat section whose clamp holds its shape, for one set of section strains: stiffness of all
 * strains as warping_wide_strains has them, and the mean curvature across that a free wall takes
 * per unit of each (core/structure/camber.h). */
struct section_flat {
    double stiffness[SECTION_WIDE_COUNT * SECTION_WIDE_COUNT];
    double natural[SECTION_WIDE_COUNT];
    double mass[SECTION_WIDE_MOTION * SECTION_WIDE_MOTION];
};

struct section {
    double
        stiffness[SECTION_STRAIN_COUNT * SECTION_STRAIN_COUNT]; /* column-major, retained shear */
    double classic[SECTION_CLASSIC * SECTION_CLASSIC];          /* shear forces zero */
    double mass[SECTION_MOTION_COUNT * SECTION_MOTION_COUNT];   /* (A.35), order of U there */
    /* The same with v', u' read as -phi, psi. */
    double mass_retained[SECTION_MOTION_COUNT * SECTION_MOTION_COUNT];
    /* Flexible walls and retained shears: the warping has amplitudes of its own. Stiffness of the
     * strains SECTION_WIDE_COUNT, and mass with sigma last but kappa; else not used. */
    bool wide;
    double wide_stiffness[SECTION_WIDE_COUNT * SECTION_WIDE_COUNT];
    double wide_mass[SECTION_WIDE_MOTION * SECTION_WIDE_MOTION];
    /* CHORDWISE_CLAMPED; else not used. */
    struct camber_line camber;
    struct section_flat flat_classic, flat_retained;
    bool shear_unknown; /* rows of the shears in `stiffness` are NaN: core/structure/properties.h */
};

/* Integrates the walls. laminate[] is indexed by contour_element.laminate. */
MUST_CHECK enum status section_build(const struct contour *c, const struct laminate *laminate,
                                     struct section *out);

/* Classic stiffness of the kept strains (n_keep x n_keep) with the others of w', psi', phi', theta'
 * free. theta'' is zero: it is, far from the ends of a beam. */
MUST_CHECK enum status section_condense(const struct section *s, int n_keep, const int *keep,
                                        double *out);

/* What designers read off the classic matrix: each stiffness with axial force and the curvature
 * in the other plane free, theta'' zero. [N m^2] */
struct section_summary {
    double ei_flap;    /* against -v'', theta' held at zero */
    double ei_lag;     /* against u'', theta' held at zero */
    double gj;         /* against theta', flap curvature held at zero */
    double bend_twist; /* moment about -v'' per unit theta' */
};
MUST_CHECK enum status section_summarise(const struct section *s, struct section_summary *out);

#endif

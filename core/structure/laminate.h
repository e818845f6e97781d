/* core/structure/laminate.h
 * Classical lamination theory of one wall: plies -> stiffness and inertia per unit of contour.
 * Plain value types; nothing is owned; thread-safe.
 *
 * Wall axes: z along the span, s along the contour, n across the wall; (s, n, z) as in App. A of
 * the paper, n = (dy/ds, -dx/ds). Plies are listed from the face of lowest n to that of highest n;
 * n = 0 is the middle of the wall. The ply angle is measured from z, positive towards +s. */
#ifndef AEROM_CORE_STRUCTURE_LAMINATE_H
#define AEROM_CORE_STRUCTURE_LAMINATE_H

#include "core/structure/material.h"

struct ply {
    struct material material;
    double angle;     /* from the span axis, positive towards +s [rad] */
    double thickness; /* [m] */
};

enum chordwise_curvature {
    CHORDWISE_FREE,  /* the stress couple L_ss vanishes: the wall may bend across (default) */
    CHORDWISE_RIGID, /* the curvature k_ss vanishes (the paper, A.23) */
    /* One straight wall only: free but for its mean over the wall, which is a field along the span
     * that the clamp of the beam holds (core/structure/camber.h). */
    CHORDWISE_CLAMPED
};

enum { WALL_STRAINS = 4 }; /* order: eps_zz, gamma_sz, kappa_zz, kappa_sz */

struct laminate {
    double thickness; /* [m] */
    double lower;     /* n of its lowest face [m] */
    /* Full plane-stress stiffness, index 0 = z, 1 = s, 2 = sz (column-major, symmetric):
     * (A.21) with the exact integral through each ply. [N/m], [N], [N m], [N m^2], [N m^3] */
    double a[9], b[9], d[9], f[9], h[9];
    /* Reduced stiffness after N_ss = 0 and (free, clamped) L_ss = 0 or (rigid) k_ss = 0, relating
     * (N_zz, N_sz, L_zz, L_sz) to (eps_zz, gamma_sz, kappa_zz, kappa_sz), where
     * eps_zz(n) = eps_zz + n kappa_zz and gamma_sz(n) = gamma_sz + n kappa_sz. Eq. (A.26). */
    double reduced[WALL_STRAINS * WALL_STRAINS];
    /* Transverse shear resultants: N_zn, N_sn from gamma_zn, gamma_sn (A.24, A.25), plain. */
    double a44, a45, a55;
    /* Energetic transverse shear stiffness for N_zn (parabolic profile for one homogeneous ply:
     * 5/6 G h), N_sn condensed. [N/m] */
    double shear_zn;
    double shear_sn; /* the same across: N_sn, N_zn condensed */
    /* Mass moments about n = 0: [kg/m^2], [kg/m], [kg]. */
    double m0, m1, m2;
};

/* Strain of the wall across it, eps_ss(n) = eps_ss + n kappa_ss, that the elimination leaves for
 * wall strains e (WALL_STRAINS, order above). */
struct laminate_cross {
    double eps_ss, kappa_ss;
};
struct laminate_cross laminate_cross_strain(const struct laminate *lam,
                                            enum chordwise_curvature chordwise,
                                            const double e[WALL_STRAINS]);

/* Stress of a ply in its own axes for strains (eps_zz, eps_ss, gamma_sz) at a point. [Pa] */
struct ply_stress {
    double l, t, lt;
};
struct ply_stress ply_stress_of(const struct ply *ply, const double strain[3]);

/* Builds the laminate. Fails with ST_INVALID when a ply is inadmissible, ST_SINGULAR when the
 * elimination of N_ss, L_ss has no solution. */
MUST_CHECK enum status laminate_build(int n_ply, const struct ply *ply,
                                      enum chordwise_curvature chordwise, struct laminate *out);

/* The same with the middle of the ply stack at n = offset [m]. */
MUST_CHECK enum status laminate_build_at(int n_ply, const struct ply *ply, double offset,
                                         enum chordwise_curvature chordwise, struct laminate *out);

#endif

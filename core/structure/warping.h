/* core/structure/warping.h
 * Axial warping of the walls per unit of each beam strain: the g(s) that minimises the strain
 * energy of the section, by quadratic finite elements along the contour.
 *
 * Two sets are solved: `classic`, where the warping is free but for its mean, so that the two
 * transverse shears are condensed; and `retained`, where it does no work on the axial flows of w',
 * psi', phi', which makes these the energetic means of the section's motion. The struct owns one
 * allocation; warping_done accepts a zeroed struct. */
#ifndef AEROM_CORE_STRUCTURE_WARPING_H
#define AEROM_CORE_STRUCTURE_WARPING_H

#include "core/structure/contour.h"

/* Without shear psi = u', phi = -v' (A.8, A.9). */
enum section_strain { S_W, S_PSI, S_PHI, S_THETA, S_THETA2, S_GXZ, S_GYZ, SECTION_STRAIN_COUNT };
enum { SECTION_CLASSIC = S_THETA2 + 1 };
enum wall_strain { W_EPS, W_GAMMA, W_KAPPA, W_TWIST }; /* order of laminate.reduced */

/* Strains of a beam beyond those of its section.
 *
 * With flexible walls and retained shears the warping has amplitudes of its own along the span,
 * which a clamp holds: chi, which stands in the place of theta' in the section strains, and chi +
 * sigma. The section twists by theta' = chi + eta, and where its walls' normals turn freely sigma
 * is what bending asks for, warping.follow.
 *
 * A flat section whose clamp holds its shape (core/structure/camber.h) has more: kappa, its
 * curvature across; tau, the turn of its normals across; lambda, the amplitude of the warping that
 * bending in its plane asks for. */
enum {
    S_CAMBER_RATE = SECTION_STRAIN_COUNT,
    S_ETA,
    S_SURPLUS,
    S_SURPLUS_RATE,
    S_LAG,
    S_LAG_RATE,
    S_TURN_RATE,
    S_TURN,
    S_CAMBER,
    SECTION_WIDE_COUNT
};
enum { SECTION_WARPED = S_CAMBER_RATE + 1 }; /* strains that warp the walls */

/* Columns of the warping that theta'' stretches, and of that of a flat section which bending in its
 * plane asks for beyond it. */
enum { WARPING_VLASOV = SECTION_WARPED, WARPING_LAG, WARPING_COLUMNS };

struct warping {
    int n_node;
    int n_value; /* n_node, or 2 n_node + 2 with WALL_SHEAR_FLEXIBLE */
    /* g at the nodes, then, with flexible walls, the turn beta of their normals and the turns rho
     * of all normals as one, per unit of each strain; last the warping that theta'' stretches: that
     * of theta' with the shears it brings along (n_value x WARPING_COLUMNS). A wall point at n
     * moves along z by g + n (beta - rho_x dy/ds + rho_y dx/ds): at a corner beta is the same in
     * both walls, and only rho lets the normals turn as the section does. */
    double *g;
    /* gamma_xz, gamma_yz per unit theta' without shear force: the twist is about the shear centre.
     * Zero in the classic set, whose curvatures follow the displacements themselves. */
    double twist_shear[2];
    /* Flexible walls, retained set: part of the warping of w', psi', phi' that has the form of the
     * warping theta'' stretches, as its amplitude per unit of each [1/m per strain]. */
    double follow[3];
    /* Flat section: part of the warping of each strain that has the form of WARPING_LAG [1/m per
     * strain]. */
    double lag[SECTION_STRAIN_COUNT];
    /* Energy of the transverse shear gamma_nz of the walls per unit of each pair of strains, as far
     * as it is not in warping_normal_shear; zero in the classic set. */
    double wall_shear[SECTION_WARPED * SECTION_WARPED];
    struct camber_line camber; /* of the contour */
};

/* How many strains warp the walls: that of S_CAMBER_RATE, the last, only where the curvature across
 * is an amplitude. */
int warping_strain_count(const struct warping *w);

/* Both sets from one factorisation. ST_SINGULAR when a wall has no shear stiffness or the walls do
 * not hang together. */
MUST_CHECK enum status warping_solve(const struct contour *c, const struct laminate *laminate,
                                     struct warping *classic, struct warping *retained);
void warping_done(struct warping *w);

/* What the values of a warping do at a point of an element: the values that count there, and g and
 * the turn of the normal, with their slopes along s, per unit of each. */
enum { WARPING_LOCAL = 8 };
struct warping_basis {
    int n; /* 3 with rigid walls, else WARPING_LOCAL */
    int value[WARPING_LOCAL];
    double g[WARPING_LOCAL], g_slope[WARPING_LOCAL], turn[WARPING_LOCAL], turn_slope[WARPING_LOCAL];
};
struct warping_basis warping_basis_at(const struct warping *w, const struct contour_element *el,
                                      const struct contour_point *p);

/* Warping of unit strain k (or WARPING_VLASOV) at a point of an element, with its slopes along s;
 * the turn is zero with rigid walls. */
struct warping_field {
    double g, g_slope, turn, turn_slope;
};
struct warping_field warping_field_at(const struct warping *w, const struct contour_element *el,
                                      const struct contour_point *p, int k);

/* Its g alone. */
double warping_at(const struct warping *w, const struct contour_element *el,
                  const struct contour_point *p, int k);

/* Slope of the same warping across the wall: n times this is added to the axial displacement. */
double warping_across(const struct warping *w, const struct contour_element *el,
                      const struct contour_point *p);

/* Transverse shear gamma_nz at a point per unit of strain k, Eq. (A.7) and the turn of the normal;
 * zero with rigid walls, whose shear energy is wall_shear. */
double warping_normal_shear(const struct warping *w, const struct contour_element *el,
                            const struct contour_point *p, int k);

/* Wall strains at a point of an element per unit of every beam strain that warps the walls:
 * e (WALL_STRAINS x SECTION_WARPED), column-major; that of S_CAMBER_RATE is zero where the
 * curvature across is no amplitude. Eqs. (A.5)-(A.12). */
void warping_strains(const struct warping *w, const struct contour_element *el,
                     const struct contour_point *p, double *e);

/* The same per unit of every strain of a beam (WALL_STRAINS x SECTION_WIDE_COUNT), with gamma_nz
 * (SECTION_WIDE_COUNT). The columns of w', psi', phi' are without their part of the warping that
 * sigma and lambda carry. */
void warping_wide_strains(const struct warping *w, const struct contour_element *el,
                          const struct contour_point *p, double *e, double *normal);

/* Is there a warping WARPING_LAG? Not where plies do not couple. */
bool warping_has_lag(const struct warping *w);

/* Either of them, by the number of strains: wall strains and gamma_nz of the first n_strain. */
void warping_unit_strains(const struct warping *w, const struct contour_element *el,
                          const struct contour_point *p, int n_strain, double *e, double *normal);

/* What the minimisation itself starts from: the wall strains of unit strain k without the warping's
 * own slope, and gamma_nz of the section's shears alone, Eq. (A.7).
 * DEVIATION (A.6): gamma_sz contains theta', the print has phi'. `stretched` is the warping that
 * theta'' stretches at the point, `across` its slope across the wall. */
void warping_bare_strain(const struct warping *w, const struct contour_point *p, int k,
                         double stretched, double across, double e[WALL_STRAINS]);
double warping_bare_normal_shear(const struct contour_point *p, int k);

/* Entry `row` of reduced (WALL_STRAINS x WALL_STRAINS) times e. */
double warping_flow(const double *reduced, int row, const double e[WALL_STRAINS]);

/* Stiffness of the section for the first n_strain strains (n_strain x n_strain), column-major:
 * (A.33) with the warping at its minimum; for SECTION_WIDE_COUNT that of warping_wide_strains. */
void warping_stiffness(const struct contour *c, const struct laminate *laminate,
                       const struct warping *w, int n_strain, double *out);

/* Three-point Gauss rule of the contour elements. */
enum { CONTOUR_GAUSS = 3 };
extern const double contour_gauss_point[CONTOUR_GAUSS];
extern const double contour_gauss_weight[CONTOUR_GAUSS];

#endif

#include "core/structure/section.h"

#include "core/la.h"
#include "core/num.h"
#include "core/structure/camber.h"

#include <assert.h>
#include <stdlib.h>
#include <string.h>

enum { N = SECTION_STRAIN_COUNT };

/* (A.35): velocities of a wall point at n are linear in (u v w v' u' theta theta'), (A.1)-(A.3). */
static void integrate_mass(const struct contour *c, const struct laminate *lam,
                           const struct warping *w, int n, double *out)
{
    enum { U = SECTION_WIDE_MOTION };
    memset(out, 0, (size_t)(n * n) * sizeof *out);
    for (int i = 0; i < c->n_element; i++) {
        const struct contour_element *el = &c->element[i];
        const struct laminate *l = &lam[el->laminate];
        for (int q = 0; q < CONTOUR_GAUSS; q++) {
            const struct contour_point p = contour_at(el, contour_gauss_point[q]);
            const double weight = contour_gauss_weight[q] * p.jacobian;
            const struct warping_field f = warping_field_at(w, el, &p, WARPING_VLASOV);
            /* Displacement component a at n is mid[a] + n slope[a]. */
            struct camber_motion flat = {{0}, {0}, {0}, {0}};
            if (w->camber.on) {
                camber_motion(&w->camber, &p, &flat);
            }
            const double mid[3][U] = {
                {[M_U] = 1.0, [M_THETA] = -p.y, [M_TURN] = flat.turn[0], [M_CAMBER] = flat.bend[0]},
                {[M_V] = 1.0, [M_THETA] = p.x, [M_TURN] = flat.turn[1], [M_CAMBER] = flat.bend[1]},
                {[M_W] = 1.0, [M_DU] = -p.x, [M_DV] = -p.y, [M_DTHETA] = f.g, [M_SURPLUS] = f.g}};
            const double slope[3][U] = {
                {[M_THETA] = p.dx, [M_TURN] = flat.turn_slope[0], [M_CAMBER] = flat.bend_slope[0]},
                {[M_THETA] = p.dy, [M_TURN] = flat.turn_slope[1], [M_CAMBER] = flat.bend_slope[1]},
                {[M_DU] = -p.dy,
                 [M_DV] = p.dx,
                 [M_DTHETA] = warping_across(w, el, &p),
                 [M_SURPLUS] = f.turn}};
            for (int a = 0; a < n; a++) {
                for (int b = 0; b < n; b++) {
                    double sum = 0.0;
                    for (int d = 0; d < 3; d++) {
                        sum += l->m0 * mid[d][a] * mid[d][b] + l->m2 * slope[d][a] * slope[d][b] +
                               l->m1 * (mid[d][a] * slope[d][b] + slope[d][a] * mid[d][b]);
                    }
                    out[a + n * b] += weight * sum;
                }
            }
        }
    }
}

/* Where a section does not warp (round tube), its surplus has no energy: a millionth of the torsion
 * stiffness keeps it determined. */
static void build_wide(const struct contour *c, const struct laminate *laminate,
                       const struct warping *w, struct section *out)
{
    enum { WIDE = SECTION_WIDE_COUNT };
    warping_stiffness(c, laminate, w, WIDE, out->wide_stiffness);
    out->wide_stiffness[num_at(S_SURPLUS, S_SURPLUS, WIDE)] +=
        1e-6 * out->stiffness[num_at(S_THETA, S_THETA, N)];
    integrate_mass(c, laminate, w, SECTION_WIDE_MOTION, out->wide_mass);
}

/* Where a wall does not warp in its plane (no coupling), lambda has no energy: any will do. */
static void build_flat(const struct contour *c, const struct laminate *laminate,
                       const struct warping *w, struct section_flat *out)
{
    enum { WIDE = SECTION_WIDE_COUNT };
    warping_stiffness(c, laminate, w, WIDE, out->stiffness);
    if (!warping_has_lag(w)) {
        out->stiffness[num_at(S_LAG, S_LAG, WIDE)] = out->stiffness[num_at(S_PSI, S_PSI, WIDE)];
    }
    out->stiffness[num_at(S_SURPLUS, S_SURPLUS, WIDE)] +=
        1e-6 * out->stiffness[num_at(S_THETA, S_THETA, WIDE)];
    out->stiffness[num_at(S_TURN, S_TURN, WIDE)] = c->camber.shear;
    camber_natural(c, laminate, w, WIDE, out->natural);
    integrate_mass(c, laminate, w, SECTION_WIDE_MOTION, out->mass);
}

enum status section_build(const struct contour *c, const struct laminate *laminate,
                          struct section *out)
{
    assert(c->n_element >= 1);
    struct section s = {.shear_unknown = false};
    struct warping classic = {0}, retained = {0};
    enum status st = warping_solve(c, laminate, &classic, &retained);
    if (st != ST_OK) {
        return st;
    }
    warping_stiffness(c, laminate, &classic, SECTION_CLASSIC, s.classic);
    warping_stiffness(c, laminate, &retained, N, s.stiffness);
    integrate_mass(c, laminate, &classic, SECTION_MOTION_COUNT, s.mass);
    integrate_mass(c, laminate, &retained, SECTION_MOTION_COUNT, s.mass_retained);
    s.wide = c->shear == WALL_SHEAR_FLEXIBLE;
    if (s.wide) {
        build_wide(c, laminate, &retained, &s);
    }
    s.camber = c->camber;
    if (s.camber.on) {
        build_flat(c, laminate, &classic, &s.flat_classic);
        build_flat(c, laminate, &retained, &s.flat_retained);
    }
    if (!num_all_finite(SECTION_CLASSIC * SECTION_CLASSIC, s.classic) ||
        !num_all_finite(N * N, s.stiffness)) {
        st = ST_NOT_FINITE;
        goto out;
    }
    *out = s;
out:
    warping_done(&retained);
    warping_done(&classic);
    return st;
}

enum status section_condense(const struct section *s, int n_keep, const int *keep, double *out)
{
    enum { C = SECTION_CLASSIC };
    const double *full = s->classic;
    int drop[C], n_drop = 0;
    for (int i = 0; i < S_THETA2; i++) {
        bool kept = false;
        for (int k = 0; k < n_keep; k++) {
            kept = kept || keep[k] == i;
        }
        if (!kept) {
            drop[n_drop++] = i;
        }
    }
    double a[C * C], b[C * C];
    for (int i = 0; i < n_drop; i++) {
        for (int j = 0; j < n_drop; j++) {
            a[i + n_drop * j] = full[drop[i] + C * drop[j]];
        }
        for (int k = 0; k < n_keep; k++) {
            b[i + n_drop * k] = full[drop[i] + C * keep[k]];
        }
    }
    const enum status st = la_solve_symmetric(n_drop, a, n_keep, b);
    for (int i = 0; i < n_keep && st == ST_OK; i++) {
        for (int j = 0; j < n_keep; j++) {
            double sum = full[keep[i] + C * keep[j]];
            for (int d = 0; d < n_drop; d++) {
                sum -= full[keep[i] + C * drop[d]] * b[d + n_drop * j];
            }
            out[i + n_keep * j] = sum;
        }
    }
    return st;
}

enum status section_summarise(const struct section *s, struct section_summary *out)
{
    static const int flap_torsion[2] = {S_PHI, S_THETA};
    static const int lag_torsion[2] = {S_PSI, S_THETA};
    double flap[4], lag[4];
    enum status st = section_condense(s, 2, flap_torsion, flap);
    if (st == ST_OK) {
        st = section_condense(s, 2, lag_torsion, lag);
    }
    if (st == ST_OK) {
        *out = (struct section_summary){
            .ei_flap = flap[0], .ei_lag = lag[0], .gj = flap[3], .bend_twist = flap[2]};
    }
    return st;
}

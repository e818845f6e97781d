#include "core/structure/centres.h"

#include "core/la.h"
#include "core/num.h"

#include <string.h>

enum { C = SECTION_CLASSIC, R = SECTION_STRAIN_COUNT, M = SECTION_MOTION_COUNT, FLEX = 6 };

/* Strains of the retained matrix without theta'': what a beam far from its ends can do. */
static const int flexible[FLEX] = {S_W, S_PSI, S_PHI, S_THETA, S_GXZ, S_GYZ};
enum { F_W, F_PSI, F_PHI, F_THETA, F_GXZ, F_GYZ };

/* Flexibility (FLEX x FLEX): strains per unit of section force. */
static enum status flexibility(const struct section *s, double f[FLEX * FLEX])
{
    double k[FLEX * FLEX];
    memset(f, 0, (size_t)(FLEX * FLEX) * sizeof *f);
    for (int i = 0; i < FLEX; i++) {
        f[num_at(i, i, FLEX)] = 1.0;
        for (int j = 0; j < FLEX; j++) {
            k[num_at(i, j, FLEX)] = s->stiffness[num_at(flexible[i], flexible[j], R)];
        }
    }
    return la_solve_symmetric(FLEX, k, FLEX, f);
}

/* A force Q_y at x adds the torque x Q_y, Q_x at y the torque -y Q_x. Properties are about it. */
static enum status shear_centre(const struct section *s, struct centres *out)
{
    double f[FLEX * FLEX];
    if (s->shear_unknown) {
        out->shear_x = out->shear_y = 0.0;
        return ST_OK;
    }
    const enum status st = flexibility(s, f);
    if (st == ST_OK) {
        out->shear_x = -f[num_at(F_THETA, F_GYZ, FLEX)] / f[num_at(F_THETA, F_THETA, FLEX)];
        out->shear_y = f[num_at(F_THETA, F_GXZ, FLEX)] / f[num_at(F_THETA, F_THETA, FLEX)];
    }
    return st;
}

/* Moves the classic matrix to other axes: w' is taken at the tension centre, the rotation theta
 * about the shear centre. Strains of the old axes per unit of the new ones. */
static void refer(const struct section *s, double xt, double yt, double xs, double ys,
                  double out[C * C])
{
    double t[C * C] = {0};
    for (int i = 0; i < C; i++) {
        t[num_at(i, i, C)] = 1.0;
    }
    /* w0' = w_t' + xt psi' - yt phi' */
    t[num_at(S_W, S_PSI, C)] = xt;
    t[num_at(S_W, S_PHI, C)] = -yt;
    /* u0 = u_s + ys theta, v0 = v_s - xs theta, so psi' and phi' gain ys theta'' and xs theta''. */
    t[num_at(S_PSI, S_THETA2, C)] = ys;
    t[num_at(S_PHI, S_THETA2, C)] = xs;
    t[num_at(S_W, S_THETA2, C)] = xt * ys - yt * xs;
    for (int i = 0; i < C; i++) {
        for (int j = 0; j < C; j++) {
            double sum = 0.0;
            for (int p = 0; p < C; p++) {
                for (int q = 0; q < C; q++) {
                    sum += t[num_at(p, i, C)] * s->classic[num_at(p, q, C)] * t[num_at(q, j, C)];
                }
            }
            out[num_at(i, j, C)] = sum;
        }
    }
}

static void mass_properties(const struct section *s, struct centres *out)
{
    out->mass = s->mass[num_at(M_U, M_U, M)];
    out->mass_x = s->mass[num_at(M_V, M_THETA, M)] / out->mass;
    out->mass_y = -s->mass[num_at(M_U, M_THETA, M)] / out->mass;
    out->inertia_polar = s->mass[num_at(M_THETA, M_THETA, M)] -
                         out->mass * (num_sq(out->mass_x) + num_sq(out->mass_y));
}

/* Principal axes of the two curvatures psi', phi' (2 x 2). A motion along the direction (cos a, sin
 * a) bends with u'' = cos a, v'' = sin a, that is psi' = cos a, phi' = -sin a. */
static void principal(const double ei[4], struct centres *out)
{
    const double xx = ei[0], yy = ei[3], xy = -ei[1];
    const double mean = 0.5 * (xx + yy), half = 0.5 * (xx - yy), radius = hypot(half, xy);
    out->ei_major = mean + radius;
    out->ei_minor = mean - radius;
    out->principal_angle = radius > 1e-12 * mean ? 0.5 * atan2(xy, half) : 0.0;
}

enum status centres_find(const struct section *s, struct centres *out)
{
    static const int axial_bending[3] = {S_W, S_PSI, S_PHI}, bending[2] = {S_PSI, S_PHI};
    static const int torsion[1] = {S_THETA};
    struct centres c = {0};
    double ab[9], ei[4], referred[C * C];
    enum status st = shear_centre(s, &c);
    if (st == ST_OK) {
        st = section_condense(s, 3, axial_bending, ab);
    }
    if (st != ST_OK) {
        return st;
    }
    c.ea = ab[0];
    /* Unit w' makes moments -x N about psi' and y N about phi'. */
    c.tension_x = -ab[1] / ab[0];
    c.tension_y = ab[2] / ab[0];
    refer(s, c.tension_x, c.tension_y, c.shear_x, c.shear_y, referred);
    st = section_condense(s, 2, bending, ei);
    if (st == ST_OK) {
        st = section_condense(s, 1, torsion, &c.gj);
    }
    if (st != ST_OK) {
        return st;
    }
    mass_properties(s, &c);
    principal(ei, &c);
    c.ei_warping = referred[num_at(S_THETA2, S_THETA2, C)];
    c.extension_twist = referred[num_at(S_W, S_THETA, C)];
    c.flap_twist = referred[num_at(S_PHI, S_THETA, C)];
    c.lag_twist = referred[num_at(S_PSI, S_THETA, C)];
    c.flap_lag = referred[num_at(S_PSI, S_PHI, C)];
    c.extension_shear_x = s->stiffness[num_at(S_W, S_GXZ, R)];
    c.extension_shear_y = s->stiffness[num_at(S_W, S_GYZ, R)];
    *out = c;
    return ST_OK;
}

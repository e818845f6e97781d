#include "core/structure/laminate.h"

#include "core/num.h"

#include <assert.h>
#include <string.h>

/* Indices of the six wall strains before the elimination. */
enum { E_ZZ, E_SS, G_SZ, K_ZZ, K_SS, K_SZ, WALL_ALL };

/* Plane-stress stiffness of a ply turned by its angle, index 0 = z, 1 = s, 2 = sz. Eq. (A.14).
 * DEVIATION from the print: the diagonal is (E_l, E_t)/(1 - nu_lt nu_tl); the print has E_t twice.
 */
static void ply_stiffness(const struct ply *ply, double q[9])
{
    const struct material *m = &ply->material;
    const double nu_tl = m->nu_lt * m->e_t / m->e_l;
    const double den = 1.0 - m->nu_lt * nu_tl;
    const double q11 = m->e_l / den;
    const double q22 = m->e_t / den;
    const double q12 = m->nu_lt * m->e_t / den;
    const double q66 = m->g_lt;
    const double c = cos(ply->angle), s = sin(ply->angle);
    const double c2 = c * c, s2 = s * s, cs = c * s;

    const double zz = q11 * c2 * c2 + 2.0 * (q12 + 2.0 * q66) * c2 * s2 + q22 * s2 * s2;
    const double ss = q11 * s2 * s2 + 2.0 * (q12 + 2.0 * q66) * c2 * s2 + q22 * c2 * c2;
    const double zs = (q11 + q22 - 4.0 * q66) * c2 * s2 + q12 * (c2 * c2 + s2 * s2);
    const double g = (q11 + q22 - 2.0 * q12 - 2.0 * q66) * c2 * s2 + q66 * (c2 * c2 + s2 * s2);
    const double zg = cs * (c2 * (q11 - q12 - 2.0 * q66) + s2 * (q12 - q22 + 2.0 * q66));
    const double sg = cs * (s2 * (q11 - q12 - 2.0 * q66) + c2 * (q12 - q22 + 2.0 * q66));
    const double full[9] = {zz, zs, zg, zs, ss, sg, zg, sg, g};
    memcpy(q, full, sizeof full);
}

/* Eliminates strain `e` of the 6 x 6 stiffness: its stress resultant vanishes. */
static enum status eliminate(double k[WALL_ALL * WALL_ALL], int e)
{
    const double pivot = k[e + WALL_ALL * e];
    if (!(pivot > 0.0)) {
        return ST_SINGULAR;
    }
    double row[WALL_ALL];
    for (int j = 0; j < WALL_ALL; j++) {
        row[j] = k[e + WALL_ALL * j];
    }
    for (int i = 0; i < WALL_ALL; i++) {
        for (int j = 0; j < WALL_ALL; j++) {
            k[i + WALL_ALL * j] -= row[i] * row[j] / pivot;
        }
    }
    return ST_OK;
}

/* Eq. (A.26) without its misprints: the Schur complement on (eps_zz, gamma_sz, kappa_zz, kappa_sz).
 */
static enum status reduce(struct laminate *lam, enum chordwise_curvature chordwise)
{
    double k[WALL_ALL * WALL_ALL];
    for (int i = 0; i < 3; i++) {
        for (int j = 0; j < 3; j++) {
            k[i + WALL_ALL * j] = lam->a[i + 3 * j];
            k[i + WALL_ALL * (j + 3)] = lam->b[i + 3 * j];
            k[(i + 3) + WALL_ALL * j] = lam->b[i + 3 * j];
            k[(i + 3) + WALL_ALL * (j + 3)] = lam->d[i + 3 * j];
        }
    }
    enum status st = eliminate(k, E_SS);
    if (st == ST_OK && chordwise != CHORDWISE_RIGID) {
        st = eliminate(k, K_SS);
    }
    if (st != ST_OK) {
        return st;
    }
    static const int keep[WALL_STRAINS] = {E_ZZ, G_SZ, K_ZZ, K_SZ};
    for (int i = 0; i < WALL_STRAINS; i++) {
        for (int j = 0; j < WALL_STRAINS; j++) {
            lam->reduced[i + WALL_STRAINS * j] = k[keep[i] + WALL_ALL * keep[j]];
        }
    }
    return ST_OK;
}

/* Modulus of a ply along z (axis 0) or s (1), the stress across and gamma_sz zero: the profile of
 * the bending stress. */
static double axial_modulus(const double q[9], int axis)
{
    return q[4 * axis] - q[3] * q[3] / q[4 - 4 * axis];
}

static double shear_modulus_n(const struct ply *ply, int axis)
{
    const double c2 = num_sq(axis == 0 ? cos(ply->angle) : sin(ply->angle));
    return ply->material.g_lt * c2 + ply->material.g_tt * (1.0 - c2);
}

/* Energetic shear stiffness: the shear stress that balances the bending stress of the ply stack,
 * tau(n) = f(n) N_zn with f = -1/D int E (n - n0) dn, gives 1/K = int f^2/G dn. */
static double energetic_shear(int n_ply, const struct ply *ply, int axis)
{
    static const double point[3] = {-0.774596669241483377, 0.0, 0.774596669241483377};
    static const double weight[3] = {5.0 / 9.0, 8.0 / 9.0, 5.0 / 9.0};
    double total = 0.0, ea = 0.0, es = 0.0, ei = 0.0;
    for (int i = 0; i < n_ply; i++) {
        total += ply[i].thickness;
    }
    double lower = -0.5 * total;
    for (int i = 0; i < n_ply; i++) {
        double q[9];
        ply_stiffness(&ply[i], q);
        const double upper = lower + ply[i].thickness, e = axial_modulus(q, axis);
        ea += e * (upper - lower);
        es += e * (upper * upper - lower * lower) / 2.0;
        ei += e * (upper * upper * upper - lower * lower * lower) / 3.0;
        lower = upper;
    }
    const double n0 = es / ea, d = ei - es * n0;
    double moment = 0.0, compliance = 0.0; /* moment = int E (n - n0) dn up to the ply */
    lower = -0.5 * total;
    for (int i = 0; i < n_ply; i++) {
        double q[9];
        ply_stiffness(&ply[i], q);
        const double e = axial_modulus(q, axis), half = 0.5 * ply[i].thickness;
        for (int g = 0; g < 3; g++) {
            const double n = lower + half * (1.0 + point[g]);
            const double f =
                -(moment + e * (n * n - lower * lower) / 2.0 - e * n0 * (n - lower)) / d;
            compliance += weight[g] * half * f * f / shear_modulus_n(&ply[i], axis);
        }
        const double upper = lower + ply[i].thickness;
        moment += e * ((upper * upper - lower * lower) / 2.0 - n0 * (upper - lower));
        lower = upper;
    }
    return 1.0 / compliance;
}

static void add_ply(struct laminate *lam, const struct ply *ply, double lower)
{
    double q[9];
    ply_stiffness(ply, q);
    const double upper = lower + ply->thickness;
    double moment[5]; /* int n^k dn over the ply, Eq. (A.21) */
    double lo = lower, hi = upper;
    for (int k = 0; k < 5; k++) {
        moment[k] = (hi - lo) / (k + 1);
        lo *= lower;
        hi *= upper;
    }
    for (int i = 0; i < 9; i++) {
        lam->a[i] += q[i] * moment[0];
        lam->b[i] += q[i] * moment[1];
        lam->d[i] += q[i] * moment[2];
        lam->f[i] += q[i] * moment[3];
        lam->h[i] += q[i] * moment[4];
    }
    const struct material *m = &ply->material;
    const double c = cos(ply->angle), s = sin(ply->angle);
    lam->a44 += (m->g_lt * c * c + m->g_tt * s * s) * ply->thickness;
    lam->a55 += (m->g_lt * s * s + m->g_tt * c * c) * ply->thickness;
    lam->a45 += (m->g_lt - m->g_tt) * c * s * ply->thickness;
    lam->m0 += m->density * moment[0];
    lam->m1 += m->density * moment[1];
    lam->m2 += m->density * moment[2];
}

struct laminate_cross laminate_cross_strain(const struct laminate *lam,
                                            enum chordwise_curvature chordwise,
                                            const double e[WALL_STRAINS])
{
    /* Resultants N_ss, L_ss of the given strains alone; index 1 = s, 0 = z, 2 = sz. */
    const double n = lam->a[1] * e[0] + lam->a[7] * e[1] + lam->b[1] * e[2] + lam->b[7] * e[3];
    const double l = lam->b[1] * e[0] + lam->b[7] * e[1] + lam->d[1] * e[2] + lam->d[7] * e[3];
    const double a = lam->a[4], b = lam->b[4], d = lam->d[4];
    if (chordwise == CHORDWISE_RIGID) {
        return (struct laminate_cross){.eps_ss = -n / a};
    }
    const double det = a * d - b * b;
    return (struct laminate_cross){.eps_ss = (-n * d + l * b) / det,
                                   .kappa_ss = (-l * a + n * b) / det};
}

struct ply_stress ply_stress_of(const struct ply *ply, const double strain[3])
{
    double q[9], global[3];
    ply_stiffness(ply, q);
    for (int i = 0; i < 3; i++) {
        global[i] = q[i] * strain[0] + q[i + 3] * strain[1] + q[i + 6] * strain[2];
    }
    const double c = cos(ply->angle), s = sin(ply->angle);
    return (struct ply_stress){
        .l = c * c * global[0] + s * s * global[1] + 2.0 * c * s * global[2],
        .t = s * s * global[0] + c * c * global[1] - 2.0 * c * s * global[2],
        .lt = c * s * (global[1] - global[0]) + (c * c - s * s) * global[2],
    };
}

enum status laminate_build(int n_ply, const struct ply *ply, enum chordwise_curvature chordwise,
                           struct laminate *out)
{
    return laminate_build_at(n_ply, ply, 0.0, chordwise, out);
}

enum status laminate_build_at(int n_ply, const struct ply *ply, double offset,
                              enum chordwise_curvature chordwise, struct laminate *out)
{
    assert(n_ply >= 1);
    assert(n_ply <= LIMIT_PLIES);
    struct laminate lam = {0};
    for (int i = 0; i < n_ply; i++) {
        const struct material *m = &ply[i].material;
        const bool sound = ply[i].thickness > 0.0 && m->e_l > 0.0 && m->e_t > 0.0 &&
                           m->g_lt > 0.0 && m->g_tt > 0.0 && m->nu_lt * m->nu_lt * m->e_t < m->e_l;
        if (!sound) {
            return ST_INVALID;
        }
        lam.thickness += ply[i].thickness;
    }
    double lower = lam.lower = offset - 0.5 * lam.thickness;
    for (int i = 0; i < n_ply; i++) {
        add_ply(&lam, &ply[i], lower);
        lower += ply[i].thickness;
    }
    lam.shear_zn = energetic_shear(n_ply, ply, 0);
    lam.shear_sn = energetic_shear(n_ply, ply, 1);
    const enum status st = reduce(&lam, chordwise);
    if (st == ST_OK) {
        *out = lam;
    }
    return st;
}

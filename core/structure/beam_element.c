#include "core/structure/beam_element.h"

#include "core/la.h"
#include "core/num.h"

#include <string.h>

enum {
    NODE = BEAM_NODE_MOST,
    OUTER = BEAM_OUTER,
    ALL = ELEMENT_ALL,
    STRAIN = SECTION_WIDE_COUNT,
    MOTION = SECTION_WIDE_MOTION
};

/* Exact to degree 7: the mass of cubics is of degree 6. */
static const double gauss_point[BEAM_GAUSS] = {-0.861136311594052575, -0.339981043584856265,
                                               0.339981043584856265, 0.861136311594052575};
static const double gauss_weight[BEAM_GAUSS] = {0.347854845137453857, 0.652145154862546143,
                                                0.652145154862546143, 0.347854845137453857};

/* Cubic Hermite functions of (value, slope) at both ends and their first two derivatives in z. */
struct hermite {
    double value[4], first[4], second[4];
};

static struct hermite hermite_at(double t, double h)
{
    const double t2 = t * t, t3 = t2 * t;
    return (struct hermite){
        .value = {1.0 - 3.0 * t2 + 2.0 * t3, h * (t - 2.0 * t2 + t3), 3.0 * t2 - 2.0 * t3,
                  h * (t3 - t2)},
        .first = {(6.0 * t2 - 6.0 * t) / h, 1.0 - 4.0 * t + 3.0 * t2, (6.0 * t - 6.0 * t2) / h,
                  3.0 * t2 - 2.0 * t},
        .second = {(12.0 * t - 6.0) / (h * h), (6.0 * t - 4.0) / h, (6.0 - 12.0 * t) / (h * h),
                   (6.0 * t - 2.0) / h},
    };
}

enum { NONE = -1 };

/* One motion across the beam or about it: its rate is a freedom of the nodes, the rotation of the
 * section or the amplitude of its warping, and a shear (gamma, eta) inside the element:
 * v' = rotation + gamma. `sign` turns the rate of the rotation into the strain: phi = -(v' -
 * gamma).
 */
struct direction {
    int freedom;          /* first node freedom: displacement, then rotation */
    int inner;            /* its first internal freedom */
    int motion, rotation; /* rows of motion */
    int amplitude;        /* row of strain that is the rotation itself */
    int curvature, shear; /* rows of strain */
    double sign;
};

static const struct direction directions[3] = {
    {D_U, IN_GX_MEAN, M_U, M_DU, NONE, S_PSI, S_GXZ, 1.0},
    {D_V, IN_GY_MEAN, M_V, M_DV, NONE, S_PHI, S_GYZ, -1.0},
    {D_THETA, IN_ETA_MEAN, M_THETA, M_DTHETA, S_THETA, S_THETA2, S_ETA, 1.0},
};

static void put_column(const struct direction *d, int column, double value, double rotation,
                       double curvature, struct element_rows *out)
{
    out->motion[d->motion + MOTION * column] = value;
    out->motion[d->rotation + MOTION * column] = rotation;
    out->strain[d->curvature + STRAIN * column] = d->sign * curvature;
    if (d->amplitude != NONE) {
        out->strain[d->amplitude + STRAIN * column] = rotation;
    }
}

static void put_direction(const struct direction *d, const struct hermite *f, double t, double h,
                          struct element_rows *out)
{
    for (int j = 0; j < 4; j++) { /* value and slope at both ends */
        const int column = NODE * (j / 2) + d->freedom + j % 2;
        put_column(d, column, f->value[j], f->first[j], f->second[j], out);
    }
    for (int part = 0; part < 2; part++) { /* gamma = mean + slope (2t - 1) */
        const int column = OUTER + d->inner + part;
        const double at_start = part == 0 ? 1.0 : -1.0;
        const double gamma = part == 0 ? 1.0 : 2.0 * t - 1.0, rate = part == 0 ? 0.0 : 2.0 / h;
        put_column(d, column, at_start * f->value[1] + f->value[3],
                   at_start * f->first[1] + f->first[3] - gamma,
                   at_start * f->second[1] + f->second[3] - rate, out);
        out->strain[d->shear + STRAIN * column] = gamma;
    }
}

/* What is linear between the nodes with two internal modes that vanish there. */
struct along {
    int freedom, inner; /* node freedom, first internal freedom */
    int motion;         /* row of motion */
    int value, rate;    /* rows of strain: it and its derivative */
};

static const struct along alongs[2] = {
    {D_W, IN_W_EVEN, M_W, NONE, S_W},
    {D_SURPLUS, IN_SURPLUS_EVEN, M_SURPLUS, S_SURPLUS, S_SURPLUS_RATE},
};

static void put_along(const struct along *d, double t, double h, struct element_rows *out)
{
    const int column[4] = {d->freedom, NODE + d->freedom, OUTER + d->inner, OUTER + d->inner + 1};
    const double value[4] = {1.0 - t, t, t * (1.0 - t), t * (1.0 - t) * (2.0 * t - 1.0)};
    const double rate[4] = {-1.0, 1.0, 1.0 - 2.0 * t, -6.0 * t * t + 6.0 * t - 1.0};
    for (int j = 0; j < 4; j++) {
        out->motion[d->motion + MOTION * column[j]] = value[j];
        out->strain[d->rate + STRAIN * column[j]] = rate[j] / h;
        if (d->value != NONE) {
            out->strain[d->value + STRAIN * column[j]] = value[j];
        }
    }
}

void element_rows(double t, double h, struct element_rows *out)
{
    const struct hermite f = hermite_at(t, h);
    memset(out, 0, sizeof *out);
    for (int i = 0; i < 3; i++) {
        put_direction(&directions[i], &f, t, h, out);
    }
    for (int i = 0; i < 2; i++) {
        put_along(&alongs[i], t, h, out);
    }
}

/* out (ALL x ALL) += weight * rows' * middle * rows; rows (stride x ALL), of which the first n rows
 * count, middle (n x n). */
static void add_product(int n, int stride, const double *rows, const double *middle, double weight,
                        double *out)
{
    for (int b = 0; b < ALL; b++) {
        double product[STRAIN]; /* as many strains as motions */
        for (int r = 0; r < n; r++) {
            double sum = 0.0;
            for (int s = 0; s < n; s++) {
                sum += middle[r + n * s] * rows[s + stride * b];
            }
            product[r] = weight * sum;
        }
        for (int a = 0; a < ALL; a++) {
            double sum = 0.0;
            for (int r = 0; r < n; r++) {
                sum += rows[r + stride * a] * product[r];
            }
            out[a + ALL * b] += sum;
        }
    }
}

/* Blocks of a full matrix: inner by inner (n_inner x n_inner), inner by outer (n_inner x OUTER). */
static void split(const double full[ALL * ALL], int n_inner, double *ii, double *io)
{
    for (int p = 0; p < n_inner; p++) {
        for (int q = 0; q < n_inner; q++) {
            ii[p + n_inner * q] = full[num_at(OUTER + p, OUTER + q, ALL)];
        }
        for (int j = 0; j < OUTER; j++) {
            io[p + n_inner * j] = full[num_at(OUTER + p, j, ALL)];
        }
    }
}

/* out (OUTER x OUTER) = a' b, both (n x OUTER). */
static void square(int n, const double *a, const double *b, double *out)
{
    for (int j = 0; j < OUTER; j++) {
        for (int i = 0; i < OUTER; i++) {
            double sum = 0.0;
            for (int p = 0; p < n; p++) {
                sum += a[p + n * i] * b[p + n * j];
            }
            out[num_at(i, j, OUTER)] = sum;
        }
    }
}

/* Adds a (n x n) b (n x OUTER) to out (n x OUTER). */
static void multiply_add(int n, const double *a, const double *b, double *out)
{
    for (int j = 0; j < OUTER; j++) {
        for (int p = 0; p < n; p++) {
            for (int q = 0; q < n; q++) {
                out[p + n * j] += a[p + n * q] * b[q + n * j];
            }
        }
    }
}

/* Condenses the first n_inner internal freedoms: inner = t outer with t = -K_ii^-1 K_io (n_inner x
 * OUTER); factor (n_inner x n_inner) is that of K_ii. */
static enum status solve_inner(const double k[ALL * ALL], int n_inner, double *factor, double *t)
{
    split(k, n_inner, factor, t);
    const enum status st = la_cholesky(n_inner, factor);
    if (st == ST_OK) {
        for (int i = 0; i < n_inner * OUTER; i++) {
            t[i] = -t[i];
        }
        la_cholesky_solve(n_inner, factor, OUTER, t);
    }
    return st;
}

/* What the inertia of the internal freedoms adds to their static place t. */
static void add_inertia(const double m[ALL * ALL], int n_inner, const double *factor,
                        const double *t, struct inner_inertia *out)
{
    double mii[BEAM_INNER * BEAM_INNER], force[BEAM_INNER * OUTER], r[BEAM_INNER * OUTER];
    split(m, n_inner, mii, force);
    multiply_add(n_inner, mii, t, force);
    memcpy(r, force, sizeof r);
    la_cholesky_solve(n_inner, factor, OUTER, r);
    square(n_inner, force, r, out->stiffness);
    memset(force, 0, sizeof force);
    multiply_add(n_inner, mii, r, force);
    square(n_inner, r, force, out->mass);
}

/* [I; t]' x [I; t], x (ALL x ALL), t (n_inner x OUTER) -> out (OUTER x OUTER). */
static void reduce(const double *x, int n_inner, const double *t, double *out)
{
    double xt[ALL * OUTER]; /* x [I; t] */
    for (int j = 0; j < OUTER; j++) {
        for (int i = 0; i < ALL; i++) {
            double sum = x[num_at(i, j, ALL)];
            for (int p = 0; p < n_inner; p++) {
                sum += x[num_at(i, OUTER + p, ALL)] * t[num_at(p, j, n_inner)];
            }
            xt[num_at(i, j, ALL)] = sum;
        }
    }
    for (int j = 0; j < OUTER; j++) {
        for (int i = 0; i < OUTER; i++) {
            double sum = xt[num_at(i, j, ALL)];
            for (int p = 0; p < n_inner; p++) {
                sum += t[num_at(p, i, n_inner)] * xt[num_at(OUTER + p, j, ALL)];
            }
            out[num_at(i, j, OUTER)] = sum;
        }
    }
}

enum status element_build(const struct section *const section[BEAM_GAUSS], double h,
                          enum shear_model shear, struct element *out)
{
    _Static_assert((int)STRAIN >= (int)MOTION, "the scratch of add_product holds either");
    const bool retained = shear == SHEAR_RETAINED;
    const bool wide = retained && section[0]->wide;
    const int n_inner = wide ? (int)BEAM_INNER : (int)(retained ? IN_ETA_MEAN : IN_GX_MEAN);
    double k[ALL * ALL] = {0}, m[ALL * ALL] = {0};
    for (int q = 0; q < BEAM_GAUSS; q++) {
        struct element_rows rows;
        element_rows(0.5 * (1.0 + gauss_point[q]), h, &rows);
        const double weight = 0.5 * h * gauss_weight[q];
        const struct section *s = section[q];
        if (wide) {
            add_product(STRAIN, STRAIN, rows.strain, s->wide_stiffness, weight, k);
            add_product(MOTION, MOTION, rows.motion, s->wide_mass, weight, m);
        } else {
            add_product(retained ? SECTION_STRAIN_COUNT : SECTION_CLASSIC, STRAIN, rows.strain,
                        retained ? s->stiffness : s->classic, weight, k);
            add_product(SECTION_MOTION_COUNT, MOTION, rows.motion,
                        retained ? s->mass_retained : s->mass, weight, m);
        }
    }
    double factor[BEAM_INNER * BEAM_INNER], t[BEAM_INNER * OUTER];
    const enum status st = solve_inner(k, n_inner, factor, t);
    if (st != ST_OK) {
        return st;
    }
    reduce(k, n_inner, t, out->k);
    reduce(m, n_inner, t, out->m);
    if (retained) {
        add_inertia(m, n_inner, factor, t, &out->inertia);
    }
    memset(out->inner, 0, sizeof out->inner);
    for (int j = 0; j < OUTER; j++) {
        for (int p = 0; p < n_inner; p++) {
            out->inner[num_at(p, j, BEAM_INNER)] = t[p + n_inner * j];
        }
    }
    return ST_OK;
}

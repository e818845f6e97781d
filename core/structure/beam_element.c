#include "core/structure/beam_element.h"

#include "core/la.h"
#include "core/num.h"

#include <string.h>

enum {
    NODE = BEAM_NODE_FREEDOMS,
    OUTER = BEAM_OUTER,
    ALL = ELEMENT_ALL,
    STRAIN = SECTION_STRAIN_COUNT,
    MOTION = SECTION_MOTION_COUNT
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

/* One transverse direction: displacement, rotation, curvature and shear rows. The rotation freedom
 * r is that of the section, so the slope of the displacement at the ends is r + gamma. `sign` turns
 * the curvature into the strain: psi' = u'' - gamma', phi' = -(v'' - gamma'). */
struct direction {
    int freedom;          /* first node freedom: displacement, then rotation */
    int inner;            /* its first internal freedom */
    int motion, rotation; /* rows of motion */
    int curvature, shear; /* rows of strain */
    double sign;
};

static const struct direction directions[2] = {
    {D_U, IN_GX_MEAN, M_U, M_DU, S_PSI, S_GXZ, 1.0},
    {D_V, IN_GY_MEAN, M_V, M_DV, S_PHI, S_GYZ, -1.0},
};

static void put_direction(const struct direction *d, const struct hermite *f, double t, double h,
                          struct element_rows *out)
{
    for (int j = 0; j < 4; j++) { /* value and slope at both ends */
        const int column = NODE * (j / 2) + d->freedom + j % 2;
        out->motion[d->motion + MOTION * column] = f->value[j];
        out->motion[d->rotation + MOTION * column] = f->first[j];
        out->strain[d->curvature + STRAIN * column] = d->sign * f->second[j];
    }
    for (int part = 0; part < 2; part++) { /* gamma = mean + slope (2t - 1) */
        const int column = OUTER + d->inner + part;
        const double at_start = part == 0 ? 1.0 : -1.0;
        const double gamma = part == 0 ? 1.0 : 2.0 * t - 1.0, rate = part == 0 ? 0.0 : 2.0 / h;
        out->motion[d->motion + MOTION * column] = at_start * f->value[1] + f->value[3];
        out->motion[d->rotation + MOTION * column] = at_start * f->first[1] + f->first[3] - gamma;
        out->strain[d->curvature + STRAIN * column] =
            d->sign * (at_start * f->second[1] + f->second[3] - rate);
        out->strain[d->shear + STRAIN * column] = gamma;
    }
}

/* Twist: theta' = chi + eta, where the node's freedom chi is the amplitude of the warping. Without
 * eta chi is theta'. */
static void put_twist(const struct hermite *f, double t, double h, struct element_rows *out)
{
    for (int j = 0; j < 4; j++) {
        const int column = NODE * (j / 2) + D_THETA + j % 2;
        out->motion[M_THETA + MOTION * column] = f->value[j];
        out->motion[M_DTHETA + MOTION * column] = f->first[j];
        out->strain[S_THETA + STRAIN * column] = f->first[j];
        out->strain[S_THETA2 + STRAIN * column] = f->second[j];
    }
    for (int part = 0; part < 2; part++) { /* eta = mean + slope (2t - 1) */
        const int column = OUTER + IN_ETA_MEAN + part;
        const double at_start = part == 0 ? 1.0 : -1.0;
        const double eta = part == 0 ? 1.0 : 2.0 * t - 1.0, rate = part == 0 ? 0.0 : 2.0 / h;
        const double chi = at_start * f->first[1] + f->first[3] - eta;
        out->motion[M_THETA + MOTION * column] = at_start * f->value[1] + f->value[3];
        out->motion[M_DTHETA + MOTION * column] = chi;
        out->strain[S_THETA + STRAIN * column] = chi;
        out->strain[S_THETA2 + STRAIN * column] = at_start * f->second[1] + f->second[3] - rate;
        out->eta[column] = eta;
    }
}

void element_rows(double t, double h, struct element_rows *out)
{
    const struct hermite f = hermite_at(t, h);
    memset(out, 0, sizeof *out);
    put_direction(&directions[0], &f, t, h, out);
    put_direction(&directions[1], &f, t, h, out);
    put_twist(&f, t, h, out);
    out->strain[S_W + STRAIN * D_W] = -1.0 / h;
    out->strain[S_W + STRAIN * (NODE + D_W)] = 1.0 / h;
    out->motion[M_W + MOTION * D_W] = 1.0 - t;
    out->motion[M_W + MOTION * (NODE + D_W)] = t;
    /* Internal modes of w vanish at the ends: t(1-t) and t(1-t)(2t-1). */
    out->motion[M_W + MOTION * (OUTER + IN_W_EVEN)] = t * (1.0 - t);
    out->strain[S_W + STRAIN * (OUTER + IN_W_EVEN)] = (1.0 - 2.0 * t) / h;
    out->motion[M_W + MOTION * (OUTER + IN_W_ODD)] = t * (1.0 - t) * (2.0 * t - 1.0);
    out->strain[S_W + STRAIN * (OUTER + IN_W_ODD)] = (-6.0 * t * t + 6.0 * t - 1.0) / h;
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

/* Adds the energy of eta: twice with each strain and once with itself. */
static void add_eta(const struct element_rows *rows, const double *stiffness, double weight,
                    double *out)
{
    for (int b = 0; b < ALL; b++) {
        double with_b = 0.0; /* force on eta from freedom b's strains */
        for (int r = 0; r < STRAIN; r++) {
            with_b += stiffness[r] * rows->strain[r + STRAIN * b];
        }
        for (int a = 0; a < ALL; a++) {
            const double both = rows->eta[a] * with_b;
            out[a + ALL * b] += weight * (both + stiffness[STRAIN] * rows->eta[a] * rows->eta[b]);
            out[b + ALL * a] += weight * both;
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
    const int n_strain = retained ? STRAIN : SECTION_CLASSIC;
    const bool eta = retained && section[0]->has_warping_shear;
    const int n_inner = eta ? BEAM_INNER : (retained ? IN_ETA_MEAN : IN_GX_MEAN);
    double k[ALL * ALL] = {0}, m[ALL * ALL] = {0};
    for (int q = 0; q < BEAM_GAUSS; q++) {
        struct element_rows rows;
        element_rows(0.5 * (1.0 + gauss_point[q]), h, &rows);
        const double weight = 0.5 * h * gauss_weight[q];
        const struct section *s = section[q];
        add_product(n_strain, STRAIN, rows.strain, retained ? s->stiffness : s->classic, weight, k);
        if (eta) {
            add_eta(&rows, s->warping_shear, weight, k);
        }
        add_product(MOTION, MOTION, rows.motion, retained ? s->mass_retained : s->mass, weight, m);
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

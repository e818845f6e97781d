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

enum { ALONGS = 5 };
static const struct along alongs[ALONGS] = {
    {D_W, IN_W_EVEN, M_W, NONE, S_W},
    {D_SURPLUS, IN_SURPLUS_EVEN, M_SURPLUS, S_SURPLUS, S_SURPLUS_RATE},
    {D_LAG, IN_LAG_EVEN, NONE, S_LAG, S_LAG_RATE},
    {D_TURN, IN_TURN_EVEN, M_TURN, S_TURN, S_TURN_RATE},
    {D_CAMBER, IN_CAMBER_EVEN, M_CAMBER, S_CAMBER, S_CAMBER_RATE},
};

static void put_along(const struct along *d, double t, double h, struct element_rows *out)
{
    const int column[4] = {d->freedom, NODE + d->freedom, OUTER + d->inner, OUTER + d->inner + 1};
    const double value[4] = {1.0 - t, t, t * (1.0 - t), t * (1.0 - t) * (2.0 * t - 1.0)};
    const double rate[4] = {-1.0, 1.0, 1.0 - 2.0 * t, -6.0 * t * t + 6.0 * t - 1.0};
    for (int j = 0; j < 4; j++) {
        if (d->motion != NONE) {
            out->motion[d->motion + MOTION * column[j]] = value[j];
        }
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
    for (int i = 0; i < ALONGS; i++) {
        put_along(&alongs[i], t, h, out);
    }
}

/* What counts in an element: strains and motions with their stiffness and mass (n_strain x
 * n_strain, n_motion x n_motion) at a point, and columns of element_rows, the internal freedoms
 * last. */
struct law {
    int n_strain, n_motion, n_column, n_inner;
    int strain[STRAIN], motion[MOTION], column[ALL];
    double stiffness[STRAIN * STRAIN], mass[MOTION * MOTION];
};

/* What a beam must have for some of the freedoms, strains and motions: retained shears; amplitudes
 * of the warping (flexible walls and retained shears); a flat section whose shape the clamp holds.
 */
enum { RETAINED = 1, WIDE = 2, FLAT = 4 };

static const int freedom_needs[NODE] = {
    [D_SURPLUS] = WIDE, [D_LAG] = FLAT, [D_TURN] = WIDE | FLAT, [D_CAMBER] = FLAT};
static const int inner_needs[BEAM_INNER] = {
    [IN_GX_MEAN] = RETAINED,  [IN_GX_SLOPE] = RETAINED,     [IN_GY_MEAN] = RETAINED,
    [IN_GY_SLOPE] = RETAINED, [IN_ETA_MEAN] = WIDE,         [IN_ETA_SLOPE] = WIDE,
    [IN_SURPLUS_EVEN] = WIDE, [IN_SURPLUS_ODD] = WIDE,      [IN_LAG_EVEN] = FLAT,
    [IN_LAG_ODD] = FLAT,      [IN_TURN_EVEN] = WIDE | FLAT, [IN_TURN_ODD] = WIDE | FLAT,
    [IN_CAMBER_EVEN] = FLAT,  [IN_CAMBER_ODD] = FLAT};
static const int strain_needs[STRAIN] = {
    [S_GXZ] = RETAINED,     [S_GYZ] = RETAINED,  [S_CAMBER_RATE] = FLAT,
    [S_ETA] = WIDE,         [S_SURPLUS] = WIDE,  [S_SURPLUS_RATE] = WIDE,
    [S_LAG] = FLAT,         [S_LAG_RATE] = FLAT, [S_TURN_RATE] = WIDE | FLAT,
    [S_TURN] = WIDE | FLAT, [S_CAMBER] = FLAT};
static const int motion_needs[MOTION] = {
    [M_SURPLUS] = WIDE, [M_TURN] = WIDE | FLAT, [M_CAMBER] = FLAT};

/* What a beam of this section and shear has of them. */
static int kind_of(const struct section *s, enum shear_model shear)
{
    const int retained = shear == SHEAR_RETAINED ? (s->wide ? RETAINED | WIDE : RETAINED) : 0;
    return retained | (s->camber.on ? FLAT : 0);
}

static bool has(int kind, int needs)
{
    return (needs & ~kind) == 0;
}

bool element_has(const struct section *s, enum shear_model shear, enum beam_freedom freedom)
{
    return has(kind_of(s, shear), freedom_needs[freedom]);
}

/* Numbers from 0 to n - 1 whose needs are met. */
static int choose(int kind, int n, const int *needs, int *out)
{
    int count = 0;
    for (int i = 0; i < n; i++) {
        if (has(kind, needs[i])) {
            out[count++] = i;
        }
    }
    return count;
}

static void choose_rows(int kind, struct law *out)
{
    out->n_column = choose(kind, NODE, freedom_needs, out->column);
    for (int i = 0; i < out->n_column; i++) {
        out->column[out->n_column + i] = NODE + out->column[i];
    }
    out->n_column *= 2;
    out->n_inner = choose(kind, BEAM_INNER, inner_needs, out->column + out->n_column);
    for (int p = 0; p < out->n_inner; p++) {
        out->column[out->n_column++] += OUTER;
    }
    out->n_strain = choose(kind, STRAIN, strain_needs, out->strain);
    out->n_motion = choose(kind, MOTION, motion_needs, out->motion);
}

/* The given rows of a matrix (stride x stride). */
static void copy_rows(int stride, const double *from, int n, const int *row, double *out)
{
    for (int j = 0; j < n; j++) {
        for (int i = 0; i < n; i++) {
            out[num_at(i, j, n)] = from[num_at(row[i], row[j], stride)];
        }
    }
}

/* Adds D (kappa - natural . strains)^2. */
static void add_camber(const struct section *s, const struct section_flat *flat, struct law *law)
{
    const int n = law->n_strain;
    for (int k = 0; k < n * n; k++) {
        const int i = law->strain[k % n], j = law->strain[k / n];
        const double a = flat->natural[i] - (i == S_CAMBER), b = flat->natural[j] - (j == S_CAMBER);
        law->stiffness[k] += s->camber.stiffness * a * b;
    }
}

/* Stiffness and mass at a point. */
static void fill_law(const struct section *s, int kind, struct law *out)
{
    const bool retained = has(kind, RETAINED);
    if (has(kind, FLAT)) {
        const struct section_flat *flat = retained ? &s->flat_retained : &s->flat_classic;
        copy_rows(SECTION_WIDE_COUNT, flat->stiffness, out->n_strain, out->strain, out->stiffness);
        copy_rows(SECTION_WIDE_MOTION, flat->mass, out->n_motion, out->motion, out->mass);
        add_camber(s, flat, out);
    } else if (has(kind, WIDE)) {
        copy_rows(SECTION_WIDE_COUNT, s->wide_stiffness, out->n_strain, out->strain,
                  out->stiffness);
        copy_rows(SECTION_WIDE_MOTION, s->wide_mass, out->n_motion, out->motion, out->mass);
    } else {
        copy_rows(retained ? (int)SECTION_STRAIN_COUNT : (int)SECTION_CLASSIC,
                  retained ? s->stiffness : s->classic, out->n_strain, out->strain, out->stiffness);
        copy_rows(SECTION_MOTION_COUNT, retained ? s->mass_retained : s->mass, out->n_motion,
                  out->motion, out->mass);
    }
}

/* out (ALL x ALL) += weight * rows' * middle * rows over the columns that count; of rows (stride x
 * ALL) the n given ones count, middle (n x n). */
static void add_product(const struct law *law, int n, const int *row, int stride,
                        const double *rows, const double *middle, double weight, double *out)
{
    double part[STRAIN * ALL]; /* the rows that count, as many strains as motions */
    for (int b = 0; b < law->n_column; b++) {
        for (int r = 0; r < n; r++) {
            part[r + n * b] = rows[row[r] + stride * law->column[b]];
        }
    }
    for (int b = 0; b < law->n_column; b++) {
        double product[STRAIN];
        for (int r = 0; r < n; r++) {
            double sum = 0.0;
            for (int s = 0; s < n; s++) {
                sum += middle[r + n * s] * part[s + n * b];
            }
            product[r] = weight * sum;
        }
        for (int a = 0; a < law->n_column; a++) {
            double sum = 0.0;
            for (int r = 0; r < n; r++) {
                sum += part[r + n * a] * product[r];
            }
            out[law->column[a] + ALL * law->column[b]] += sum;
        }
    }
}

/* Blocks of a full matrix: inner by inner (n_inner x n_inner), inner by outer (n_inner x OUTER). */
static void split(const double full[ALL * ALL], const struct law *law, double *ii, double *io)
{
    const int n = law->n_inner, *inner = law->column + law->n_column - n;
    for (int p = 0; p < n; p++) {
        for (int q = 0; q < n; q++) {
            ii[p + n * q] = full[num_at(inner[p], inner[q], ALL)];
        }
        for (int j = 0; j < OUTER; j++) {
            io[p + n * j] = full[num_at(inner[p], j, ALL)];
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

/* Condenses the internal freedoms: inner = t outer with t = -K_ii^-1 K_io (n_inner x
 * OUTER); factor (n_inner x n_inner) is that of K_ii. */
static enum status solve_inner(const double k[ALL * ALL], const struct law *law, double *factor,
                               double *t)
{
    const int n_inner = law->n_inner;
    split(k, law, factor, t);
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
static void add_inertia(const double m[ALL * ALL], const struct law *law, const double *factor,
                        const double *t, struct inner_inertia *out)
{
    const int n_inner = law->n_inner;
    double mii[BEAM_INNER * BEAM_INNER], force[BEAM_INNER * OUTER], r[BEAM_INNER * OUTER];
    split(m, law, mii, force);
    multiply_add(n_inner, mii, t, force);
    memcpy(r, force, sizeof r);
    la_cholesky_solve(n_inner, factor, OUTER, r);
    square(n_inner, force, r, out->stiffness);
    memset(force, 0, sizeof force);
    multiply_add(n_inner, mii, r, force);
    square(n_inner, r, force, out->mass);
}

/* [I; t]' x [I; t], x (ALL x ALL), t (n_inner x OUTER) -> out (OUTER x OUTER). */
static void reduce(const double *x, const struct law *law, const double *t, double *out)
{
    const int n_inner = law->n_inner, *inner = law->column + law->n_column - n_inner;
    double xt[ALL * OUTER]; /* x [I; t] */
    for (int j = 0; j < OUTER; j++) {
        for (int i = 0; i < ALL; i++) {
            double sum = x[num_at(i, j, ALL)];
            for (int p = 0; p < n_inner; p++) {
                sum += x[num_at(i, inner[p], ALL)] * t[num_at(p, j, n_inner)];
            }
            xt[num_at(i, j, ALL)] = sum;
        }
    }
    for (int j = 0; j < OUTER; j++) {
        for (int i = 0; i < OUTER; i++) {
            double sum = xt[num_at(i, j, ALL)];
            for (int p = 0; p < n_inner; p++) {
                sum += t[num_at(p, i, n_inner)] * xt[num_at(inner[p], j, ALL)];
            }
            out[num_at(i, j, OUTER)] = sum;
        }
    }
}

enum status element_build(const struct section *const section[BEAM_GAUSS], double h,
                          enum shear_model shear, struct element *out)
{
    _Static_assert((int)STRAIN >= (int)MOTION, "the scratch of add_product holds either");
    struct law law;
    double k[ALL * ALL] = {0}, m[ALL * ALL] = {0};
    const int kind = kind_of(section[0], shear);
    choose_rows(kind, &law);
    for (int q = 0; q < BEAM_GAUSS; q++) {
        struct element_rows rows;
        element_rows(0.5 * (1.0 + gauss_point[q]), h, &rows);
        const double weight = 0.5 * h * gauss_weight[q];
        fill_law(section[q], kind, &law);
        add_product(&law, law.n_strain, law.strain, STRAIN, rows.strain, law.stiffness, weight, k);
        add_product(&law, law.n_motion, law.motion, MOTION, rows.motion, law.mass, weight, m);
    }
    double factor[BEAM_INNER * BEAM_INNER], t[BEAM_INNER * OUTER];
    const enum status st = solve_inner(k, &law, factor, t);
    if (st != ST_OK) {
        return st;
    }
    reduce(k, &law, t, out->k);
    reduce(m, &law, t, out->m);
    if (shear == SHEAR_RETAINED) {
        add_inertia(m, &law, factor, t, &out->inertia);
    }
    memset(out->inner, 0, sizeof out->inner);
    for (int j = 0; j < OUTER; j++) {
        for (int p = 0; p < law.n_inner; p++) {
            const int inner = law.column[law.n_column - law.n_inner + p] - OUTER;
            out->inner[num_at(inner, j, BEAM_INNER)] = t[p + law.n_inner * j];
        }
    }
    return ST_OK;
}

#include "core/structure/beam.h"

#include "core/num.h"

#include <assert.h>
#include <stdbool.h>
#include <stdlib.h>
#include <string.h>

enum {
    NODE = BEAM_NODE_FREEDOMS,
    OUTER = 2 * NODE, /* freedoms of the two nodes */
    INNER = 2,        /* internal modes of w */
    ALL = OUTER + INNER,
    GAUSS = 4, /* exact to degree 7: the mass of cubics is of degree 6 */
    STRAIN = SECTION_CLASSIC,
    MOTION = SECTION_MOTION_COUNT
};

static const double gauss_point[GAUSS] = {-0.861136311594052575, -0.339981043584856265,
                                          0.339981043584856265, 0.861136311594052575};
static const double gauss_weight[GAUSS] = {0.347854845137453857, 0.652145154862546143,
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

/* Rows of strains (STRAIN x ALL) and motions (MOTION x ALL) at t in [0, 1] of an element of length
 * h. Strain order of section.h with psi = u', phi = -v' (classical set, A.34). */
static void element_rows(double t, double h, double strain[STRAIN * ALL],
                         double motion[MOTION * ALL])
{
    static const int value_dof[3] = {D_U, D_V, D_THETA};
    static const int motion_row[3] = {M_U, M_V, M_THETA};
    static const int slope_row[3] = {M_DU, M_DV, M_DTHETA};
    const struct hermite f = hermite_at(t, h);
    memset(strain, 0, (size_t)(STRAIN * ALL) * sizeof *strain);
    memset(motion, 0, (size_t)(MOTION * ALL) * sizeof *motion);
    for (int end = 0; end < 2; end++) {
        const double sign = end == 0 ? -1.0 : 1.0;
        strain[S_W + STRAIN * (NODE * end + D_W)] = sign / h;
        motion[M_W + MOTION * (NODE * end + D_W)] = end == 0 ? 1.0 - t : t;
        for (int d = 0; d < 2; d++) { /* value, then slope */
            const int j = 2 * end + d;
            for (int k = 0; k < 3; k++) {
                const int column = NODE * end + value_dof[k] + d;
                motion[motion_row[k] + MOTION * column] = f.value[j];
                motion[slope_row[k] + MOTION * column] = f.first[j];
            }
            strain[S_PSI + STRAIN * (NODE * end + D_U + d)] = f.second[j];
            strain[S_PHI + STRAIN * (NODE * end + D_V + d)] = -f.second[j];
            strain[S_THETA + STRAIN * (NODE * end + D_THETA + d)] = f.first[j];
            strain[S_THETA2 + STRAIN * (NODE * end + D_THETA + d)] = f.second[j];
        }
    }
    /* Internal modes of w vanish at the ends: t(1-t) and t(1-t)(2t-1). */
    motion[M_W + MOTION * OUTER] = t * (1.0 - t);
    strain[S_W + STRAIN * OUTER] = (1.0 - 2.0 * t) / h;
    motion[M_W + MOTION * (OUTER + 1)] = t * (1.0 - t) * (2.0 * t - 1.0);
    strain[S_W + STRAIN * (OUTER + 1)] = (-6.0 * t * t + 6.0 * t - 1.0) / h;
}

/* out (ALL x ALL) += weight * rows' * middle * rows, rows (n x ALL), middle (n x n). */
static void add_product(int n, const double *rows, const double *middle, double weight, double *out)
{
    for (int b = 0; b < ALL; b++) {
        double mb[MOTION]; /* the longer of the two row counts */
        for (int r = 0; r < n; r++) {
            double sum = 0.0;
            for (int s = 0; s < n; s++) {
                sum += middle[r + n * s] * rows[s + n * b];
            }
            mb[r] = weight * sum;
        }
        for (int a = 0; a < ALL; a++) {
            double sum = 0.0;
            for (int r = 0; r < n; r++) {
                sum += rows[r + n * a] * mb[r];
            }
            out[a + ALL * b] += sum;
        }
    }
}

/* Condenses the internal modes: w_inner = t w_outer with t = -K_ii^-1 K_io, used for stiffness and
 * mass alike. k and m (ALL x ALL) -> leading (OUTER x OUTER) blocks hold the result. */
static enum status condense_inner(double *k, double *m)
{
    const double a = k[OUTER + ALL * OUTER], b = k[OUTER + ALL * (OUTER + 1)];
    const double d = k[OUTER + 1 + ALL * (OUTER + 1)];
    const double det = a * d - b * b;
    if (!(det > 0.0)) {
        return ST_SINGULAR;
    }
    double t[INNER * OUTER];
    for (int j = 0; j < OUTER; j++) {
        const double k0 = k[OUTER + ALL * j], k1 = k[OUTER + 1 + ALL * j];
        t[INNER * j] = -(d * k0 - b * k1) / det;
        t[INNER * j + 1] = -(a * k1 - b * k0) / det;
    }
    double *matrix[2] = {k, m};
    for (int which = 0; which < 2; which++) {
        double *x = matrix[which];
        double full[OUTER * OUTER];
        for (int i = 0; i < OUTER; i++) {
            for (int j = 0; j < OUTER; j++) {
                double sum = x[i + ALL * j];
                for (int p = 0; p < INNER; p++) {
                    sum += x[i + ALL * (OUTER + p)] * t[p + INNER * j] +
                           t[p + INNER * i] * x[OUTER + p + ALL * j];
                    for (int q = 0; q < INNER; q++) {
                        sum +=
                            t[p + INNER * i] * x[OUTER + p + ALL * (OUTER + q)] * t[q + INNER * j];
                    }
                }
                full[i + OUTER * j] = sum;
            }
        }
        for (int j = 0; j < OUTER; j++) {
            memcpy(x + (size_t)(ALL * j), full + (size_t)(OUTER * j), OUTER * sizeof *x);
        }
    }
    return ST_OK;
}

static enum status element_matrices(const struct section *s, double h, double k[ALL * ALL],
                                    double m[ALL * ALL])
{
    double strain[STRAIN * ALL], motion[MOTION * ALL];
    memset(k, 0, (size_t)(ALL * ALL) * sizeof *k);
    memset(m, 0, (size_t)(ALL * ALL) * sizeof *m);
    for (int q = 0; q < GAUSS; q++) {
        element_rows(0.5 * (1.0 + gauss_point[q]), h, strain, motion);
        const double weight = 0.5 * h * gauss_weight[q];
        add_product(STRAIN, strain, s->classic, weight, k);
        add_product(MOTION, motion, s->mass, weight, m);
    }
    return condense_inner(k, m);
}

int beam_index(const struct beam *b, int node, enum beam_freedom freedom)
{
    if (node > 0) {
        return NODE * (node - 1) + (int)freedom;
    }
    const bool is_free = b->root_warping == ROOT_WARPING_FREE && freedom == D_DTHETA;
    return is_free ? NODE * b->n_element : -1;
}

enum beam_freedom beam_freedom_at(const struct beam *b, int index)
{
    return index < NODE * b->n_element ? (enum beam_freedom)(index % NODE) : D_DTHETA;
}

/* Index of local freedom i of element e. */
static int element_index(const struct beam *b, int e, int i)
{
    return beam_index(b, e + i / NODE, (enum beam_freedom)(i % NODE));
}

enum status beam_build(const struct section *section, double length, int n_element,
                       enum root_warping root_warping, struct beam *out)
{
    assert(length > 0.0);
    assert(n_element >= 1);
    const int n = NODE * n_element + (root_warping == ROOT_WARPING_FREE ? 1 : 0);
    const size_t size = (size_t)n * (size_t)n;
    struct beam b = {
        .length = length, .n_element = n_element, .n_dof = n, .root_warping = root_warping};
    double k[ALL * ALL], m[ALL * ALL];
    enum status st = element_matrices(section, length / n_element, k, m);
    if (st != ST_OK) {
        return st;
    }
    b.k = calloc(2 * size, sizeof *b.k);
    if (b.k == NULL) {
        return ST_NO_MEMORY;
    }
    b.m = b.k + size;
    for (int e = 0; e < n_element; e++) {
        for (int i = 0; i < OUTER; i++) {
            for (int j = 0; j < OUTER; j++) {
                const int row = element_index(&b, e, i), column = element_index(&b, e, j);
                if (row >= 0 && column >= 0) {
                    b.k[num_at(row, column, n)] += k[i + ALL * j];
                    b.m[num_at(row, column, n)] += m[i + ALL * j];
                }
            }
        }
    }
    *out = b;
    return ST_OK;
}

void beam_done(struct beam *b)
{
    free(b->k);
    *b = (struct beam){0};
}

/* Interpolates the displacement whose value is freedom `dof` and whose slope is the next one. */
static double hermite_sum(const struct beam *b, const struct hermite *f, const double *x, int e,
                          enum beam_freedom dof)
{
    double sum = 0.0;
    for (int i = 0; i < 4; i++) {
        const int index = beam_index(b, e + i / 2, (enum beam_freedom)((int)dof + i % 2));
        sum += index >= 0 ? f->value[i] * x[index] : 0.0;
    }
    return sum;
}

struct beam_motion beam_motion_at(const struct beam *b, const double *x, double z)
{
    const double h = b->length / b->n_element;
    int e = (int)(z / h);
    e = e < 0 ? 0 : (e >= b->n_element ? b->n_element - 1 : e);
    const struct hermite f = hermite_at(z / h - e, h);
    return (struct beam_motion){.u = hermite_sum(b, &f, x, e, D_U),
                                .v = hermite_sum(b, &f, x, e, D_V),
                                .theta = hermite_sum(b, &f, x, e, D_THETA)};
}

void beam_add_uniform_load(const struct beam *b, int e, double fx, double fy, double moment,
                           double *f)
{
    assert(e >= 0);
    assert(e < b->n_element);
    const double h = b->length / b->n_element;
    const double shape[4] = {h / 2.0, h * h / 12.0, h / 2.0, -h * h / 12.0}; /* int of Hermite */
    const double load[3] = {fx, fy, moment};
    static const int dof[3] = {D_U, D_V, D_THETA};
    for (int k = 0; k < 3; k++) {
        for (int i = 0; i < 4; i++) {
            const int index = beam_index(b, e + i / 2, (enum beam_freedom)(dof[k] + i % 2));
            if (index >= 0) {
                f[index] += shape[i] * load[k];
            }
        }
    }
}

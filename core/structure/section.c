#include "core/structure/section.h"

#include "core/la.h"
#include "core/num.h"

#include <assert.h>
#include <stdlib.h>
#include <string.h>

enum { N = SECTION_STRAIN_COUNT, GAUSS = 3 };
enum { W_EPS, W_GAMMA, W_KAPPA, W_TWIST }; /* wall strains, order of laminate.reduced */

static const double gauss_point[GAUSS] = {-0.774596669241483377, 0.0, 0.774596669241483377};
static const double gauss_weight[GAUSS] = {5.0 / 9.0, 8.0 / 9.0, 5.0 / 9.0};

/* Warping g(s) per unit of each strain, at the nodes: (n_node x N), with the load vectors and the
 * system they come from. One allocation. */
struct warping {
    int n_node;
    int n_constraint;
    double *g;      /* (n_node x N) */
    double *system; /* (n x n), n = n_node + n_constraint */
    double *rhs;    /* (n x N) */
};

/* Wall strains at a point per unit of beam strain k, the warping g included: Eqs. (A.5)-(A.12).
 * DEVIATION (A.6): gamma_sz contains theta', the print has phi'. g_of_k and slope_of_k are the
 * warping of strain k and its derivative at the point, g_theta the warping of unit theta'. */
static void wall_strain(const struct contour_point *p, int k, double slope_of_k, double g_theta,
                        double e[WALL_STRAINS])
{
    memset(e, 0, WALL_STRAINS * sizeof *e);
    switch ((enum section_strain)k) {
    case S_W:
        e[W_EPS] = 1.0;
        break;
    case S_PSI:
        e[W_EPS] = -p->x;
        e[W_KAPPA] = -p->dy;
        break;
    case S_PHI:
        e[W_EPS] = p->y;
        e[W_KAPPA] = -p->dx;
        break;
    case S_THETA:
        e[W_GAMMA] = p->r_n;
        e[W_TWIST] = 2.0;
        break;
    case S_THETA2: /* the warping of theta' stretched by theta'' */
        e[W_EPS] = g_theta;
        e[W_KAPPA] = p->r_t;
        break;
    case S_GXZ:
        e[W_GAMMA] = p->dx;
        break;
    case S_GYZ:
        e[W_GAMMA] = p->dy;
        break;
    case SECTION_STRAIN_COUNT:
        assert(false);
    }
    e[W_GAMMA] += slope_of_k;
}

static double at_nodes(const struct contour_element *el, const double value[3],
                       const double *column)
{
    return value[0] * column[el->node[0]] + value[1] * column[el->node[1]] +
           value[2] * column[el->node[2]];
}

static double dot_row(const double *reduced, int row, const double e[WALL_STRAINS])
{
    double sum = 0.0;
    for (int j = 0; j < WALL_STRAINS; j++) {
        sum += reduced[row + WALL_STRAINS * j] * e[j];
    }
    return sum;
}

/* Adds the energy of the free warping, int g' R22 g' ds, to the system. */
static void add_energy(const struct contour *c, const struct laminate *lam, struct warping *w)
{
    const int n = w->n_node + w->n_constraint;
    for (int i = 0; i < c->n_element; i++) {
        const struct contour_element *el = &c->element[i];
        const double r22 = lam[el->laminate].reduced[W_GAMMA + WALL_STRAINS * W_GAMMA];
        for (int q = 0; q < GAUSS; q++) {
            const struct contour_point p = contour_at(el, gauss_point[q]);
            const double weight = gauss_weight[q] * p.jacobian * r22;
            for (int a = 0; a < 3; a++) {
                for (int b = 0; b < 3; b++) {
                    w->system[num_at(el->node[a], el->node[b], n)] +=
                        weight * p.slope[a] * p.slope[b];
                }
            }
        }
    }
}

/* Load of strain k on the warping: -int N' (R_gamma . e_k) ds. */
static void add_load(const struct contour *c, const struct laminate *lam, int k, struct warping *w)
{
    double *rhs = w->rhs + (size_t)k * (size_t)(w->n_node + w->n_constraint);
    const double *g_theta = w->g + (size_t)S_THETA * (size_t)w->n_node;
    for (int i = 0; i < c->n_element; i++) {
        const struct contour_element *el = &c->element[i];
        for (int q = 0; q < GAUSS; q++) {
            const struct contour_point p = contour_at(el, gauss_point[q]);
            double e[WALL_STRAINS];
            wall_strain(&p, k, 0.0, at_nodes(el, p.shape, g_theta), e);
            const double flow = dot_row(lam[el->laminate].reduced, W_GAMMA, e);
            for (int a = 0; a < 3; a++) {
                rhs[el->node[a]] -= gauss_weight[q] * p.jacobian * p.slope[a] * flow;
            }
        }
    }
}

/* Constraint row j: the virtual work of the axial flow of unit strain `source` on the warping is
 * zero, which makes w0, psi, phi the energetic averages of the section's motion; with it the
 * in-plane shear of a strip gets its factor 5/6 by itself. The out-of-plane part n r_t of the
 * warping of theta' enters through the right-hand side. */
static void add_constraint(const struct contour *c, const struct laminate *lam,
                           const struct warping *flow_of, int source, int j, struct warping *w)
{
    const int n = w->n_node + w->n_constraint, row = w->n_node + j;
    for (int i = 0; i < c->n_element; i++) {
        const struct contour_element *el = &c->element[i];
        const double *r = lam[el->laminate].reduced;
        for (int q = 0; q < GAUSS; q++) {
            const struct contour_point p = contour_at(el, gauss_point[q]);
            const double *column = flow_of->g + (size_t)source * (size_t)flow_of->n_node;
            const double *g_theta = flow_of->g + (size_t)S_THETA * (size_t)flow_of->n_node;
            double e[WALL_STRAINS];
            wall_strain(&p, source, at_nodes(el, p.slope, column), at_nodes(el, p.shape, g_theta),
                        e);
            const double weight = gauss_weight[q] * p.jacobian;
            const double force = dot_row(r, W_EPS, e), couple = dot_row(r, W_KAPPA, e);
            for (int a = 0; a < 3; a++) {
                w->system[num_at(row, el->node[a], n)] += weight * force * p.shape[a];
                w->system[num_at(el->node[a], row, n)] += weight * force * p.shape[a];
            }
            w->rhs[num_at(row, S_THETA, n)] -= weight * couple * p.r_t;
        }
    }
}

static enum status warping_init(int n_node, int n_constraint, struct warping *w)
{
    const size_t n = (size_t)(n_node + n_constraint);
    *w = (struct warping){.n_node = n_node, .n_constraint = n_constraint};
    w->g = calloc((size_t)n_node * N + n * n + n * N, sizeof *w->g);
    if (w->g == NULL) {
        return ST_NO_MEMORY;
    }
    w->system = w->g + (size_t)n_node * N;
    w->rhs = w->system + n * n;
    return ST_OK;
}

static void warping_done(struct warping *w)
{
    free(w->g);
}

/* Rows and columns of the constraints are scaled to the energy so that pivoting sees like sizes. */
static void scale_constraints(struct warping *w)
{
    const int n = w->n_node + w->n_constraint;
    double energy = 0.0;
    for (int i = 0; i < w->n_node; i++) {
        energy = fmax(energy, w->system[num_at(i, i, n)]);
    }
    for (int row = w->n_node; row < n; row++) {
        double largest = 0.0;
        for (int i = 0; i < w->n_node; i++) {
            largest = fmax(largest, fabs(w->system[num_at(row, i, n)]));
        }
        const double factor = largest > 0.0 ? energy / largest : 1.0;
        for (int i = 0; i < w->n_node; i++) {
            w->system[num_at(row, i, n)] *= factor;
            w->system[num_at(i, row, n)] *= factor;
        }
        for (int k = 0; k < N; k++) {
            w->rhs[num_at(row, k, n)] *= factor;
        }
    }
}

/* Solves for all strains but theta'', whose load needs the warping of theta', then for theta''. */
static enum status warping_solve(const struct contour *c, const struct laminate *lam,
                                 const struct warping *flow_of, struct warping *w)
{
    const int n = w->n_node + w->n_constraint;
    const size_t size = (size_t)n * (size_t)n;
    static const int source[3] = {S_W, S_PSI, S_PHI};
    add_energy(c, lam, w);
    for (int j = 0; j < w->n_constraint; j++) {
        add_constraint(c, lam, flow_of, source[j], j, w);
    }
    for (int k = 0; k < N; k++) {
        if (k != S_THETA2) {
            add_load(c, lam, k, w);
        }
    }
    scale_constraints(w);
    double *copy = malloc((size + (size_t)n) * sizeof *copy);
    if (copy == NULL) {
        return ST_NO_MEMORY;
    }
    memcpy(copy, w->system, size * sizeof *copy);
    enum status st = la_solve_symmetric(n, copy, N, w->rhs);
    for (int k = 0; k < N && st == ST_OK; k++) {
        memcpy(w->g + (size_t)k * (size_t)w->n_node, w->rhs + (size_t)k * (size_t)n,
               (size_t)w->n_node * sizeof *w->g);
    }
    if (st == ST_OK) {
        double *second = w->rhs + (size_t)S_THETA2 * (size_t)n;
        memset(second, 0, (size_t)n * sizeof *second);
        add_load(c, lam, S_THETA2, w);
        st = la_solve_symmetric(n, w->system, 1, second);
        memcpy(w->g + (size_t)S_THETA2 * (size_t)w->n_node, second,
               (size_t)w->n_node * sizeof *w->g);
    }
    free(copy);
    return st;
}

/* Wall strains of every beam strain at one point: (WALL_STRAINS x N). */
static void all_strains(const struct contour_element *el, const struct contour_point *p,
                        const struct warping *w, double *e)
{
    const double g_theta = at_nodes(el, p->shape, w->g + (size_t)S_THETA * (size_t)w->n_node);
    for (int k = 0; k < N; k++) {
        const double *column = w->g + (size_t)k * (size_t)w->n_node;
        wall_strain(p, k, at_nodes(el, p->slope, column), g_theta, e + (size_t)(WALL_STRAINS * k));
    }
}

/* Stiffness of the first n_strain strains, (A.33) with the warping at its minimum. */
static void integrate_stiffness(const struct contour *c, const struct laminate *lam,
                                const struct warping *w, int n_strain, double *out)
{
    memset(out, 0, (size_t)(n_strain * n_strain) * sizeof *out);
    for (int i = 0; i < c->n_element; i++) {
        const struct contour_element *el = &c->element[i];
        const struct laminate *l = &lam[el->laminate];
        for (int q = 0; q < GAUSS; q++) {
            const struct contour_point p = contour_at(el, gauss_point[q]);
            const double weight = gauss_weight[q] * p.jacobian;
            double e[WALL_STRAINS * N];
            all_strains(el, &p, w, e);
            for (int a = 0; a < n_strain; a++) {
                for (int b = 0; b < n_strain; b++) {
                    double sum = 0.0;
                    for (int r = 0; r < WALL_STRAINS; r++) {
                        sum += e[WALL_STRAINS * a + r] *
                               dot_row(l->reduced, r, e + (size_t)(WALL_STRAINS * b));
                    }
                    /* Transverse shear of the wall, gamma_nz of Eq. (A.7). */
                    const double na = a == S_GXZ ? p.dy : (a == S_GYZ ? -p.dx : 0.0);
                    const double nb = b == S_GXZ ? p.dy : (b == S_GYZ ? -p.dx : 0.0);
                    out[a + n_strain * b] += weight * (sum + na * nb * l->shear_zn);
                }
            }
        }
    }
}

/* (A.35): velocities of a wall point at n are linear in (u v w v' u' theta theta'), (A.1)-(A.3). */
static void integrate_mass(const struct contour *c, const struct laminate *lam,
                           const struct warping *w, double *out)
{
    enum { U = SECTION_MOTION_COUNT };
    memset(out, 0, (size_t)(U * U) * sizeof *out);
    for (int i = 0; i < c->n_element; i++) {
        const struct contour_element *el = &c->element[i];
        const struct laminate *l = &lam[el->laminate];
        for (int q = 0; q < GAUSS; q++) {
            const struct contour_point p = contour_at(el, gauss_point[q]);
            const double weight = gauss_weight[q] * p.jacobian;
            const double g = at_nodes(el, p.shape, w->g + (size_t)S_THETA * (size_t)w->n_node);
            /* Displacement component a at n is mid[a] + n slope[a]. */
            const double mid[3][U] = {{[M_U] = 1.0, [M_THETA] = -p.y},
                                      {[M_V] = 1.0, [M_THETA] = p.x},
                                      {[M_W] = 1.0, [M_DU] = -p.x, [M_DV] = -p.y, [M_DTHETA] = g}};
            const double slope[3][U] = {{[M_THETA] = p.dx},
                                        {[M_THETA] = p.dy},
                                        {[M_DU] = -p.dy, [M_DV] = p.dx, [M_DTHETA] = p.r_t}};
            for (int a = 0; a < U; a++) {
                for (int b = 0; b < U; b++) {
                    double sum = 0.0;
                    for (int d = 0; d < 3; d++) {
                        sum += l->m0 * mid[d][a] * mid[d][b] + l->m2 * slope[d][a] * slope[d][b] +
                               l->m1 * (mid[d][a] * slope[d][b] + slope[d][a] * mid[d][b]);
                    }
                    out[a + U * b] += weight * sum;
                }
            }
        }
    }
}

enum status section_build(const struct contour *c, const struct laminate *laminate,
                          struct section *out)
{
    assert(c->n_element >= 1);
    struct section s;
    struct warping classic = {0}, retained = {0};
    enum status st = warping_init(c->n_node, 1, &classic);
    if (st == ST_OK) {
        st = warping_init(c->n_node, 3, &retained);
    }
    if (st != ST_OK) {
        goto out;
    }
    /* Classical set: the warping is free but for its mean, so no shear flow is left on an open wall
     * and the two shear strains are condensed. The mean is weighted with the axial flow of w'. */
    st = warping_solve(c, laminate, &classic, &classic);
    if (st != ST_OK) {
        goto out;
    }
    /* Retained shears: the warping carries no mean stretch and no mean rotation. */
    st = warping_solve(c, laminate, &classic, &retained);
    if (st != ST_OK) {
        goto out;
    }
    integrate_stiffness(c, laminate, &classic, SECTION_CLASSIC, s.classic);
    integrate_stiffness(c, laminate, &retained, N, s.stiffness);
    integrate_mass(c, laminate, &classic, s.mass);
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

/* Schur complement of the classic matrix on the kept strains. */
static enum status condense(const double *full, int n_keep, const int *keep, double *out)
{
    enum { C = SECTION_CLASSIC };
    int drop[C], n_drop = 0;
    for (int i = 0; i < C; i++) {
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
    enum status st = condense(s->classic, 2, flap_torsion, flap);
    if (st == ST_OK) {
        st = condense(s->classic, 2, lag_torsion, lag);
    }
    if (st == ST_OK) {
        *out = (struct section_summary){
            .ei_flap = flap[0], .ei_lag = lag[0], .gj = flap[3], .bend_twist = flap[2]};
    }
    return st;
}

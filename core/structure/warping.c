#include "core/structure/warping.h"

#include "core/la.h"
#include "core/num.h"

#include <assert.h>
#include <stdbool.h>
#include <stdlib.h>
#include <string.h>

enum { N = SECTION_STRAIN_COUNT, CONSTRAINTS = 3 };

const double contour_gauss_point[CONTOUR_GAUSS] = {-0.774596669241483377, 0.0,
                                                   0.774596669241483377};
const double contour_gauss_weight[CONTOUR_GAUSS] = {5.0 / 9.0, 8.0 / 9.0, 5.0 / 9.0};

/* The system K g = f with node 0 held: K is singular for g = const and regular otherwise. */
struct system {
    int n;              /* nodes less one */
    double *factor;     /* Cholesky factor of K (n x n) */
    double *constraint; /* axial flows of w', psi', phi' on the nodes ((n + 1) x CONSTRAINTS) */
    double *response;   /* K^-1 of them, node 0 zero                 ((n + 1) x CONSTRAINTS) */
};

static double at_nodes(const struct contour_element *el, const double value[3],
                       const double *column)
{
    return value[0] * column[el->node[0]] + value[1] * column[el->node[1]] +
           value[2] * column[el->node[2]];
}

double warping_at(const struct warping *w, const struct contour_element *el,
                  const struct contour_point *p, int k)
{
    return at_nodes(el, p->shape, w->g + num_at(0, k, w->n_node));
}

double warping_across(const struct warping *w, const struct contour_point *p)
{
    /* The normal turns with the wall: r_t theta' less the shear gamma_nz of Eq. (A.7). */
    return p->r_t - w->twist_shear[0] * p->dy + w->twist_shear[1] * p->dx;
}

double warping_flow(const double *reduced, int row, const double e[WALL_STRAINS])
{
    double sum = 0.0;
    for (int j = 0; j < WALL_STRAINS; j++) {
        sum += reduced[row + WALL_STRAINS * j] * e[j];
    }
    return sum;
}

/* Wall strains at a point per unit of beam strain k, without the slope of its warping.
 * DEVIATION (A.6): gamma_sz contains theta', the print has phi'. `stretched` is the warping that
 * theta'' stretches there, `across` its slope across the wall. */
static void bare_strain(const struct contour_point *p, int k, double stretched, double across,
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
    case S_THETA2:
        e[W_EPS] = stretched;
        e[W_KAPPA] = across;
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
}

void warping_strains(const struct warping *w, const struct contour_element *el,
                     const struct contour_point *p, double *e)
{
    const double stretched = warping_at(w, el, p, WARPING_VLASOV), across = warping_across(w, p);
    for (int k = 0; k < N; k++) {
        bare_strain(p, k, stretched, across, e + WALL_STRAINS * (ptrdiff_t)k);
        e[W_GAMMA + WALL_STRAINS * k] += at_nodes(el, p->slope, w->g + num_at(0, k, w->n_node));
    }
}

/* Energy of the free warping, int g' R_gamma,gamma g' ds, factored with node 0 held. */
static enum status factor(const struct contour *c, const struct laminate *lam, struct system *s)
{
    for (int i = 0; i < c->n_element; i++) {
        const struct contour_element *el = &c->element[i];
        const double shear = lam[el->laminate].reduced[W_GAMMA + WALL_STRAINS * W_GAMMA];
        for (int q = 0; q < CONTOUR_GAUSS; q++) {
            const struct contour_point p = contour_at(el, contour_gauss_point[q]);
            const double weight = contour_gauss_weight[q] * p.jacobian * shear;
            for (int a = 0; a < 3; a++) {
                for (int b = 0; b < 3; b++) {
                    if (el->node[a] > 0 && el->node[b] > 0) {
                        s->factor[num_at(el->node[a] - 1, el->node[b] - 1, s->n)] +=
                            weight * p.slope[a] * p.slope[b];
                    }
                }
            }
        }
    }
    return la_cholesky(s->n, s->factor);
}

/* Load of strain k on the warping w: -int N' (R_gamma . e_k) ds. */
static void add_load(const struct contour *c, const struct laminate *lam, const struct warping *w,
                     int k, double *rhs)
{
    for (int i = 0; i < c->n_element; i++) {
        const struct contour_element *el = &c->element[i];
        for (int q = 0; q < CONTOUR_GAUSS; q++) {
            const struct contour_point p = contour_at(el, contour_gauss_point[q]);
            double e[WALL_STRAINS];
            bare_strain(&p, k, warping_at(w, el, &p, WARPING_VLASOV), warping_across(w, &p), e);
            const double flow = warping_flow(lam[el->laminate].reduced, W_GAMMA, e);
            for (int a = 0; a < 3; a++) {
                rhs[el->node[a]] -= contour_gauss_weight[q] * p.jacobian * p.slope[a] * flow;
            }
        }
    }
}

/* Solves K x = rhs in place, node 0 held at zero. */
static void solve_held(const struct system *s, double *rhs)
{
    rhs[0] = 0.0;
    la_cholesky_solve(s->n, s->factor, 1, rhs + 1);
}

/* Axial force N_zz of unit strain k on the nodes (n_node). */
static void axial_flow(const struct contour *c, const struct laminate *lam, const struct warping *w,
                       int k, double *force)
{
    for (int i = 0; i < c->n_element; i++) {
        const struct contour_element *el = &c->element[i];
        for (int q = 0; q < CONTOUR_GAUSS; q++) {
            const struct contour_point p = contour_at(el, contour_gauss_point[q]);
            double e[WALL_STRAINS * N];
            warping_strains(w, el, &p, e);
            const double flow =
                warping_flow(lam[el->laminate].reduced, W_EPS, e + WALL_STRAINS * (ptrdiff_t)k);
            for (int a = 0; a < 3; a++) {
                force[el->node[a]] += contour_gauss_weight[q] * p.jacobian * p.shape[a] * flow;
            }
        }
    }
}

/* What the stress couples of the constraining strains do: on the out-of-plane warping n r_t of
 * theta', on the transverse shear gamma_nz of Eq. (A.7), and on each other through the shear
 * compliance of the wall. Against the shear the couple counts about n_s =
 * R_gamma,twist/R_gamma,gamma, where the shear flow of the wall acts: only what that flow leaves of
 * it goes through N_zn. */
struct couples {
    double warping[CONSTRAINTS];                  /* int L_j r_t ds */
    double shear[CONSTRAINTS * N];                /* int L_j gamma_nz(k) ds (CONSTRAINTS x N) */
    double compliance[CONSTRAINTS * CONSTRAINTS]; /* int L_i L_j / K_zn ds */
};

static const int constraint_source[CONSTRAINTS] = {S_W, S_PSI, S_PHI};

static void integrate_couples(const struct contour *c, const struct laminate *lam,
                              const struct warping *w, struct couples *out)
{
    *out = (struct couples){{0}, {0}, {0}};
    for (int i = 0; i < c->n_element; i++) {
        const struct contour_element *el = &c->element[i];
        const struct laminate *l = &lam[el->laminate];
        for (int q = 0; q < CONTOUR_GAUSS; q++) {
            const struct contour_point p = contour_at(el, contour_gauss_point[q]);
            const double n_s = l->reduced[W_TWIST + WALL_STRAINS * W_GAMMA] /
                               l->reduced[W_GAMMA + WALL_STRAINS * W_GAMMA];
            const double weight = contour_gauss_weight[q] * p.jacobian;
            double e[WALL_STRAINS * N], couple[CONSTRAINTS];
            warping_strains(w, el, &p, e);
            for (int j = 0; j < CONSTRAINTS; j++) {
                const double *unit = e + WALL_STRAINS * (ptrdiff_t)constraint_source[j];
                const double full = warping_flow(l->reduced, W_KAPPA, unit);
                out->warping[j] += weight * full * p.r_t;
                couple[j] = full - n_s * warping_flow(l->reduced, W_EPS, unit);
            }
            for (int j = 0; j < CONSTRAINTS; j++) {
                out->shear[num_at(j, S_GXZ, CONSTRAINTS)] += weight * couple[j] * p.dy;
                out->shear[num_at(j, S_GYZ, CONSTRAINTS)] -= weight * couple[j] * p.dx;
                for (int k = 0; k < CONSTRAINTS; k++) {
                    out->compliance[num_at(j, k, CONSTRAINTS)] +=
                        weight * couple[j] * couple[k] / l->shear_zn;
                }
            }
        }
    }
}

static double dot(int n, const double *a, const double *b)
{
    double sum = 0.0;
    for (int i = 0; i < n; i++) {
        sum += a[i] * b[i];
    }
    return sum;
}

/* Classic set: subtracts the constant that does work on the flow of w'. */
static void remove_mean(int n_node, const double *flow, double couple, double *g)
{
    double total = 0.0;
    for (int i = 0; i < n_node; i++) {
        total += flow[i];
    }
    const double mean = (dot(n_node, flow, g) + couple) / total;
    for (int i = 0; i < n_node; i++) {
        g[i] -= mean;
    }
}

/* Retained set, strain k: g += constant - response lambda such that warping does no work on the
 * three axial flows and the forces lambda balance (they sum to none, or the held node would carry
 * them).
 *
 * The normal of a wall may turn by beta(s) against the section, w = ... + n beta: gamma_nz + beta =
 * -L lambda/K_zn minimises the energy, so a wall of a box hands the shear of its normal on to the
 * walls that stand upright, and a lone strip, whose rotation is carried by L alone, keeps it. */
static enum status constrain(const struct system *s, const struct couples *couples, int k,
                             double *g, double lambda[CONSTRAINTS])
{
    enum { UNKNOWN = CONSTRAINTS + 1 };
    const int n = s->n + 1;
    double a[UNKNOWN * UNKNOWN] = {0}, b[UNKNOWN] = {0}, scale[UNKNOWN], largest = 0.0;
    for (int i = 0; i < CONSTRAINTS; i++) {
        const double *flow = s->constraint + num_at(0, i, n);
        for (int j = 0; j < CONSTRAINTS; j++) {
            a[num_at(i, j, UNKNOWN)] = -dot(n, flow, s->response + num_at(0, j, n)) -
                                       couples->compliance[num_at(i, j, CONSTRAINTS)];
        }
        for (int q = 0; q < n; q++) {
            a[num_at(i, CONSTRAINTS, UNKNOWN)] += flow[q];
        }
        a[num_at(CONSTRAINTS, i, UNKNOWN)] = a[num_at(i, CONSTRAINTS, UNKNOWN)];
        b[i] = couples->shear[num_at(i, k, CONSTRAINTS)] - dot(n, flow, g) -
               (k == S_THETA ? couples->warping[i] : 0.0);
        scale[i] = 1.0 / sqrt(fmax(-a[num_at(i, i, UNKNOWN)], 1e-300));
        largest = fmax(largest, scale[i] * fabs(a[num_at(i, CONSTRAINTS, UNKNOWN)]));
    }
    scale[CONSTRAINTS] = 1.0 / largest;
    for (int i = 0; i < UNKNOWN; i++) {
        b[i] *= scale[i];
        for (int j = 0; j < UNKNOWN; j++) {
            a[num_at(i, j, UNKNOWN)] *= scale[i] * scale[j];
        }
    }
    const enum status st = la_solve_least_size(UNKNOWN, a, 1e-10, b);
    for (int j = 0; j < CONSTRAINTS && st == ST_OK; j++) {
        lambda[j] = scale[j] * b[j];
        const double *response = s->response + num_at(0, j, n);
        for (int q = 0; q < n; q++) {
            g[q] -= response[q] * lambda[j];
        }
    }
    for (int q = 0; q < n && st == ST_OK; q++) {
        g[q] += scale[CONSTRAINTS] * b[CONSTRAINTS];
    }
    return st;
}

static void solve_classic(const struct contour *c, const struct laminate *lam,
                          const struct system *s, struct warping *w, struct couples *couples)
{
    const int n = w->n_node;
    double *flow = s->constraint; /* scratch until the retained set is solved */
    for (int k = 0; k < N; k++) {
        if (k != S_THETA2) {
            add_load(c, lam, w, k, w->g + num_at(0, k, n));
            solve_held(s, w->g + num_at(0, k, n));
        }
    }
    memset(flow, 0, (size_t)n * sizeof *flow);
    axial_flow(c, lam, w, S_W, flow);
    integrate_couples(c, lam, w, couples);
    for (int k = 0; k < N; k++) {
        if (k != S_THETA2) {
            remove_mean(n, flow, k == S_THETA ? couples->warping[0] : 0.0, w->g + num_at(0, k, n));
        }
    }
    double *second = w->g + num_at(0, S_THETA2, n);
    memcpy(w->g + num_at(0, WARPING_VLASOV, n), w->g + num_at(0, S_THETA, n),
           (size_t)n * sizeof *second);
    add_load(c, lam, w, S_THETA2, second);
    solve_held(s, second);
    remove_mean(n, flow, 0.0, second);
}

/* Energy of the transverse shear of the walls for unit strains i and j. */
static double wall_shear_energy(const struct couples *couples, const double *lambda, int i, int j)
{
    double sum = 0.0;
    for (int a = 0; a < CONSTRAINTS; a++) {
        for (int b = 0; b < CONSTRAINTS; b++) {
            sum += lambda[num_at(a, i, CONSTRAINTS)] *
                   couples->compliance[num_at(a, b, CONSTRAINTS)] *
                   lambda[num_at(b, j, CONSTRAINTS)];
        }
    }
    return sum;
}

/* Stiffness of unit strains i and j in the walls, without wall_shear. */
static double membrane_energy(const struct contour *c, const struct laminate *lam,
                              const struct warping *w, int i, int j)
{
    double sum = 0.0;
    for (int q = 0; q < c->n_element * CONTOUR_GAUSS; q++) {
        const struct contour_element *el = &c->element[q / CONTOUR_GAUSS];
        const double *reduced = lam[el->laminate].reduced;
        const struct contour_point p = contour_at(el, contour_gauss_point[q % CONTOUR_GAUSS]);
        double e[WALL_STRAINS * N];
        warping_strains(w, el, &p, e);
        for (int r = 0; r < WALL_STRAINS; r++) {
            sum += contour_gauss_weight[q % CONTOUR_GAUSS] * p.jacobian * e[r + WALL_STRAINS * i] *
                   warping_flow(reduced, r, e + WALL_STRAINS * (ptrdiff_t)j);
        }
    }
    return sum;
}

/* Twist without shear force brings shear strains along, as it is about the shear centre, and their
 * warping with it. Both are held where the warping is held, so theta'' stretches the sum: the
 * warping of theta' alone would be that of a twist about the origin. */
static enum status find_vlasov(const struct contour *c, const struct laminate *lam,
                               const double *lambda, const struct couples *couples,
                               struct warping *w)
{
    static const int shear[2] = {S_GXZ, S_GYZ};
    const int n = w->n_node;
    double a[4], b[2];
    for (int i = 0; i < 2; i++) {
        for (int j = 0; j < 2; j++) {
            a[i + 2 * j] = membrane_energy(c, lam, w, shear[i], shear[j]) +
                           wall_shear_energy(couples, lambda, shear[i], shear[j]);
        }
        b[i] = -membrane_energy(c, lam, w, shear[i], S_THETA) -
               wall_shear_energy(couples, lambda, shear[i], S_THETA);
    }
    const enum status st = la_solve_symmetric(2, a, 1, b);
    if (st != ST_OK) {
        return st;
    }
    memcpy(w->twist_shear, b, sizeof b);
    for (int q = 0; q < n; q++) {
        w->g[num_at(q, WARPING_VLASOV, n)] = w->g[num_at(q, S_THETA, n)] +
                                             b[0] * w->g[num_at(q, S_GXZ, n)] +
                                             b[1] * w->g[num_at(q, S_GYZ, n)];
    }
    return ST_OK;
}

static enum status solve_retained(const struct contour *c, const struct laminate *lam,
                                  const struct warping *classic, const struct couples *couples,
                                  struct system *s, struct warping *w)
{
    const int n = w->n_node;
    double lambda[CONSTRAINTS * N];
    memset(s->constraint, 0, (size_t)n * CONSTRAINTS * sizeof *s->constraint);
    for (int i = 0; i < CONSTRAINTS; i++) {
        double *flow = s->constraint + num_at(0, i, n), *response = s->response + num_at(0, i, n);
        axial_flow(c, lam, classic, constraint_source[i], flow);
        memcpy(response, flow, (size_t)n * sizeof *flow);
        solve_held(s, response);
    }
    enum status st = ST_OK;
    for (int k = 0; k < N && st == ST_OK; k++) {
        double *g = w->g + num_at(0, k, n);
        if (k != S_THETA2) { /* without the constraints it is the classic warping */
            memcpy(g, classic->g + num_at(0, k, n), (size_t)n * sizeof *g);
            st = constrain(s, couples, k, g, lambda + num_at(0, k, CONSTRAINTS));
        }
    }
    if (st == ST_OK) {
        st = find_vlasov(c, lam, lambda, couples, w);
    }
    if (st == ST_OK) { /* needs the final warping of the twist */
        double *g = w->g + num_at(0, S_THETA2, n);
        add_load(c, lam, w, S_THETA2, g);
        solve_held(s, g);
        st = constrain(s, couples, S_THETA2, g, lambda + num_at(0, S_THETA2, CONSTRAINTS));
    }
    for (int i = 0; i < N && st == ST_OK; i++) {
        for (int j = 0; j < N; j++) {
            w->wall_shear[num_at(i, j, N)] = wall_shear_energy(couples, lambda, i, j);
        }
    }
    return st;
}

static enum status system_init(int n_node, struct system *out)
{
    const size_t n = (size_t)n_node - 1, nodes = (size_t)n_node;
    struct system s = {.n = n_node - 1};
    s.factor = calloc(n * n + nodes * (2 * CONSTRAINTS), sizeof *s.factor);
    if (s.factor == NULL) {
        return ST_NO_MEMORY;
    }
    s.constraint = s.factor + n * n;
    s.response = s.constraint + nodes * CONSTRAINTS;
    *out = s;
    return ST_OK;
}

static enum status warping_init(int n_node, struct warping *out)
{
    double *g = calloc((size_t)n_node * WARPING_COLUMNS, sizeof *g);
    if (g == NULL) {
        return ST_NO_MEMORY;
    }
    *out = (struct warping){.n_node = n_node, .g = g};
    return ST_OK;
}

enum status warping_solve(const struct contour *c, const struct laminate *laminate,
                          struct warping *classic, struct warping *retained)
{
    assert(c->n_element >= 1);
    struct warping a = {0}, b = {0};
    struct system s = {0};
    enum status st = system_init(c->n_node, &s);
    if (st == ST_OK) {
        st = warping_init(c->n_node, &a);
    }
    if (st == ST_OK) {
        st = warping_init(c->n_node, &b);
    }
    if (st == ST_OK) {
        st = factor(c, laminate, &s);
    }
    if (st == ST_OK) {
        struct couples couples;
        solve_classic(c, laminate, &s, &a, &couples);
        st = solve_retained(c, laminate, &a, &couples, &s, &b);
    }
    free(s.factor);
    if (st != ST_OK) {
        warping_done(&a);
        warping_done(&b);
        return st;
    }
    *classic = a;
    *retained = b;
    return ST_OK;
}

void warping_done(struct warping *w)
{
    free(w->g);
    *w = (struct warping){0};
}

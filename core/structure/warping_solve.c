/* The minimisation behind core/structure/warping.h. */
#include "core/la.h"
#include "core/num.h"
#include "core/structure/warping.h"

#include <assert.h>
#include <stdbool.h>
#include <stdlib.h>
#include <string.h>

enum { N = SECTION_WARPED, CONSTRAINTS = 3 };

/* The system K z = f with g of node 0 held: K is singular for g = const and regular otherwise. The
 * values z are those of struct warping. */
struct system {
    int n; /* values less one */
    int n_node;
    bool turns;         /* are beta and rho among the values? */
    double *factor;     /* Cholesky factor of K (n x n) */
    double *constraint; /* axial flows of w', psi', phi' on the values ((n + 1) x CONSTRAINTS) */
    double *response;   /* K^-1 of them, node 0 zero                 ((n + 1) x CONSTRAINTS) */
};

/* Adds to the entry of values a and b unless one is the held one. */
static void add_entry(struct system *s, int a, int b, double value)
{
    if (a > 0 && b > 0) {
        s->factor[num_at(a - 1, b - 1, s->n)] += value;
    }
}

/* Energy of the free warping, int R (g', turn') + K_zn turn^2 ds, factored with g of node 0 held.
 * The same turn may be made of beta and of rho (straight walls): a little energy of rho alone
 * decides. */
static enum status factor(const struct contour *c, const struct laminate *lam,
                          const struct warping *w, struct system *s)
{
    for (int i = 0; i < c->n_element * CONTOUR_GAUSS; i++) {
        const struct contour_element *el = &c->element[i / CONTOUR_GAUSS];
        const double *r = lam[el->laminate].reduced;
        const double gg = r[W_GAMMA + WALL_STRAINS * W_GAMMA];
        const double gt = r[W_GAMMA + WALL_STRAINS * W_TWIST];
        const double tt = r[W_TWIST + WALL_STRAINS * W_TWIST];
        const double shear_zn = lam[el->laminate].shear_zn;
        const struct contour_point p = contour_at(el, contour_gauss_point[i % CONTOUR_GAUSS]);
        const double weight = contour_gauss_weight[i % CONTOUR_GAUSS] * p.jacobian;
        const struct warping_basis f = warping_basis_at(w, el, &p);
        for (int k = 0; k < f.n * f.n; k++) {
            const int a = k % f.n, b = k / f.n;
            const double sum = f.g_slope[a] * (gg * f.g_slope[b] + gt * f.turn_slope[b]) +
                               f.turn_slope[a] * (gt * f.g_slope[b] + tt * f.turn_slope[b]) +
                               shear_zn * f.turn[a] * f.turn[b];
            add_entry(s, f.value[a], f.value[b], weight * sum);
        }
    }
    for (int a = 2 * s->n_node; s->turns && a < 2 * s->n_node + 2; a++) {
        add_entry(s, a, a, 1e-8 * s->factor[num_at(s->n_node, s->n_node, s->n)]);
    }
    return la_cholesky(s->n, s->factor);
}

/* Load of strain k on the values of w: -int g' (R_gamma . e_k) + turn' (R_twist . e_k) +
 * turn K_zn gamma_nz ds. */
static void add_load(const struct contour *c, const struct laminate *lam, const struct warping *w,
                     int k, double *rhs)
{
    for (int i = 0; i < c->n_element * CONTOUR_GAUSS; i++) {
        const struct contour_element *el = &c->element[i / CONTOUR_GAUSS];
        const struct laminate *l = &lam[el->laminate];
        const struct contour_point p = contour_at(el, contour_gauss_point[i % CONTOUR_GAUSS]);
        const double weight = contour_gauss_weight[i % CONTOUR_GAUSS] * p.jacobian;
        const struct warping_basis f = warping_basis_at(w, el, &p);
        double e[WALL_STRAINS], stretched = 0.0, across = 0.0;
        if (k == S_THETA2) {
            stretched = warping_at(w, el, &p, WARPING_VLASOV);
            across = warping_across(w, el, &p);
        }
        warping_bare_strain(w, &p, k, stretched, across, e);
        const double flow = warping_flow(l->reduced, W_GAMMA, e);
        const double twist = warping_flow(l->reduced, W_TWIST, e);
        const double normal = l->shear_zn * warping_bare_normal_shear(&p, k);
        for (int a = 0; a < f.n; a++) {
            rhs[f.value[a]] -=
                weight * (f.g_slope[a] * flow + f.turn_slope[a] * twist + f.turn[a] * normal);
        }
    }
}

/* Solves K z = rhs in place, g of node 0 held at zero. */
static void solve_held(const struct system *s, double *rhs)
{
    rhs[0] = 0.0;
    la_cholesky_solve(s->n, s->factor, 1, rhs + 1);
}

/* Work of the axial force N_zz and its couple L_zz of unit strain k on the values (n_value). */
static void axial_flow(const struct contour *c, const struct laminate *lam, const struct warping *w,
                       int k, double *force)
{
    for (int i = 0; i < c->n_element * CONTOUR_GAUSS; i++) {
        const struct contour_element *el = &c->element[i / CONTOUR_GAUSS];
        const struct contour_point p = contour_at(el, contour_gauss_point[i % CONTOUR_GAUSS]);
        const double weight = contour_gauss_weight[i % CONTOUR_GAUSS] * p.jacobian;
        const double *r = lam[el->laminate].reduced;
        const struct warping_basis f = warping_basis_at(w, el, &p);
        double e[WALL_STRAINS * N];
        warping_strains(w, el, &p, e);
        const double *unit = e + WALL_STRAINS * (ptrdiff_t)k;
        const double axial = warping_flow(r, W_EPS, unit), couple = warping_flow(r, W_KAPPA, unit);
        for (int a = 0; a < f.n; a++) {
            force[f.value[a]] += weight * (f.g[a] * axial + f.turn[a] * couple);
        }
    }
}

/* What the stress couples of the constraining strains do: on the out-of-plane warping n r_t of
 * theta', on the transverse shear gamma_nz of Eq. (A.7), and on each other through the shear
 * compliance of the wall. Against the shear the couple counts about n_s =
 * R_gamma,twist/R_gamma,gamma, where the shear flow of the wall acts: only what that flow leaves of
 * it goes through N_zn. With flexible walls the turns are values of the system and carry the shear
 * themselves. */
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
            for (int j = 0; j < CONSTRAINTS && w->n_value == w->n_node; j++) {
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
static void remove_mean(int n_node, int n_value, const double *flow, double couple, double *g)
{
    double total = 0.0;
    for (int i = 0; i < n_node; i++) {
        total += flow[i];
    }
    const double mean = (dot(n_value, flow, g) + couple) / total;
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
        for (int q = 0; q < s->n_node; q++) {
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
    for (int q = 0; q < s->n_node && st == ST_OK; q++) {
        g[q] += scale[CONSTRAINTS] * b[CONSTRAINTS];
    }
    return st;
}

static void solve_classic(const struct contour *c, const struct laminate *lam,
                          const struct system *s, struct warping *w, struct couples *couples)
{
    const int n = w->n_value;
    double *flow = s->constraint; /* scratch until the retained set is solved */
    for (int k = 0; k < warping_strain_count(w); k++) {
        if (k != S_THETA2) {
            add_load(c, lam, w, k, w->g + num_at(0, k, n));
            solve_held(s, w->g + num_at(0, k, n));
        }
    }
    memset(flow, 0, (size_t)n * sizeof *flow);
    axial_flow(c, lam, w, S_W, flow);
    integrate_couples(c, lam, w, couples);
    for (int k = 0; k < warping_strain_count(w); k++) {
        if (k != S_THETA2) {
            remove_mean(w->n_node, n, flow, k == S_THETA ? couples->warping[0] : 0.0,
                        w->g + num_at(0, k, n));
        }
    }
    double *second = w->g + num_at(0, S_THETA2, n);
    memcpy(w->g + num_at(0, WARPING_VLASOV, n), w->g + num_at(0, S_THETA, n),
           (size_t)n * sizeof *second);
    add_load(c, lam, w, S_THETA2, second);
    solve_held(s, second);
    remove_mean(w->n_node, n, flow, 0.0, second);
}

/* Energy of the transverse shear of the walls that the constraints' forces lambda mean. */
static void set_wall_shear(const struct couples *couples, const double *lambda, struct warping *w)
{
    for (int i = 0; i < N; i++) {
        for (int j = 0; j < N; j++) {
            double sum = 0.0;
            for (int a = 0; a < CONSTRAINTS; a++) {
                for (int b = 0; b < CONSTRAINTS; b++) {
                    sum += lambda[num_at(a, i, CONSTRAINTS)] *
                           couples->compliance[num_at(a, b, CONSTRAINTS)] *
                           lambda[num_at(b, j, CONSTRAINTS)];
                }
            }
            w->wall_shear[num_at(i, j, N)] = sum;
        }
    }
}

/* Energy of the walls between the warpings of columns a and b alone. */
static double warping_energy(const struct contour *c, const struct laminate *lam,
                             const struct warping *w, int a, int b)
{
    double energy = 0.0;
    for (int i = 0; i < c->n_element * CONTOUR_GAUSS; i++) {
        const struct contour_element *el = &c->element[i / CONTOUR_GAUSS];
        const struct laminate *l = &lam[el->laminate];
        const struct contour_point p = contour_at(el, contour_gauss_point[i % CONTOUR_GAUSS]);
        const struct warping_field fa = warping_field_at(w, el, &p, a),
                                   fb = warping_field_at(w, el, &p, b);
        const double e[WALL_STRAINS] = {[W_GAMMA] = fb.g_slope, [W_TWIST] = fb.turn_slope};
        energy += contour_gauss_weight[i % CONTOUR_GAUSS] * p.jacobian *
                  (fa.g_slope * warping_flow(l->reduced, W_GAMMA, e) +
                   fa.turn_slope * warping_flow(l->reduced, W_TWIST, e) +
                   l->shear_zn * fa.turn * fb.turn);
    }
    return energy;
}

/* The part of the warping of w', psi', phi' that has the form of what theta'' stretches, by
 * projection in the energy of the warping; none where a twist of stiffness gj does not warp. */
static void find_follow(const struct contour *c, const struct laminate *lam, double gj,
                        struct warping *w)
{
    const double own = warping_energy(c, lam, w, WARPING_VLASOV, WARPING_VLASOV);
    for (int k = S_W; k <= S_PHI && own > 1e-9 * gj; k++) {
        w->follow[k] = warping_energy(c, lam, w, WARPING_VLASOV, k) / own;
    }
}

/* Bending of a flat section in its plane is psi' = dx/ds, phi' = -dy/ds, and w' that leaves its
 * middle unstrained. What is left of its warping is a column of its own, and the part of the other
 * warpings in that form is found like the one above; chi is an amplitude by itself. None where
 * plies do not couple and the wall keeps plane in its plane. */
static void find_lag(const struct contour *c, const struct laminate *lam, struct warping *w)
{
    static const int strain[] = {S_W, S_PSI, S_PHI, S_THETA2};
    const struct camber_line *line = &c->camber;
    const double share[3] = {line->x * line->dx + line->y * line->dy, line->dx, -line->dy};
    const int n = w->n_value;
    double *lag = w->g + num_at(0, WARPING_LAG, n), k[9], ei = 0.0;
    warping_stiffness(c, lam, w, 3, k);
    for (int i = 0; i < 3; i++) {
        for (int q = 0; q < n; q++) {
            lag[q] += share[i] *
                      (w->g[num_at(q, i, n)] - w->follow[i] * w->g[num_at(q, WARPING_VLASOV, n)]);
        }
        for (int j = 0; j < 3; j++) {
            ei += share[i] * k[num_at(i, j, 3)] * share[j];
        }
    }
    const double own = warping_energy(c, lam, w, WARPING_LAG, WARPING_LAG);
    for (size_t i = 0; i < sizeof strain / sizeof strain[0] && own > 1e-6 * ei; i++) {
        w->lag[strain[i]] = warping_energy(c, lam, w, WARPING_LAG, strain[i]) / own;
    }
}

/* Twist without shear force brings shear strains along, as it is about the shear centre, and their
 * warping with it. Both are held where the warping is held, so theta'' stretches the sum: the
 * warping of theta' alone would be that of a twist about the origin. */
static enum status find_vlasov(const struct contour *c, const struct laminate *lam,
                               struct warping *w)
{
    static const int shear[2] = {S_GXZ, S_GYZ};
    enum { ALL = SECTION_STRAIN_COUNT };
    const int n = w->n_value;
    double k[ALL * ALL], a[4], b[2];
    warping_stiffness(c, lam, w, ALL, k);
    for (int i = 0; i < 2; i++) {
        for (int j = 0; j < 2; j++) {
            a[i + 2 * j] = k[num_at(shear[i], shear[j], ALL)];
        }
        b[i] = -k[num_at(shear[i], S_THETA, ALL)];
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
    if (c->shear == WALL_SHEAR_FLEXIBLE) {
        find_follow(c, lam, k[num_at(S_THETA, S_THETA, ALL)], w);
    }
    return ST_OK;
}

static enum status solve_retained(const struct contour *c, const struct laminate *lam,
                                  const struct warping *classic, const struct couples *couples,
                                  struct system *s, struct warping *w)
{
    const int n = w->n_value;
    double lambda[CONSTRAINTS * N] = {0};
    memset(s->constraint, 0, (size_t)n * CONSTRAINTS * sizeof *s->constraint);
    for (int i = 0; i < CONSTRAINTS; i++) {
        double *flow = s->constraint + num_at(0, i, n), *response = s->response + num_at(0, i, n);
        axial_flow(c, lam, classic, constraint_source[i], flow);
        memcpy(response, flow, (size_t)n * sizeof *flow);
        solve_held(s, response);
    }
    enum status st = ST_OK;
    for (int k = 0; k < warping_strain_count(w) && st == ST_OK; k++) {
        double *g = w->g + num_at(0, k, n);
        if (k != S_THETA2) { /* without the constraints it is the classic warping */
            memcpy(g, classic->g + num_at(0, k, n), (size_t)n * sizeof *g);
            st = constrain(s, couples, k, g, lambda + num_at(0, k, CONSTRAINTS));
        }
    }
    if (st == ST_OK) {
        set_wall_shear(couples, lambda, w);
        st = find_vlasov(c, lam, w);
    }
    if (st == ST_OK) { /* needs the final warping of the twist */
        double *g = w->g + num_at(0, S_THETA2, n);
        add_load(c, lam, w, S_THETA2, g);
        solve_held(s, g);
        st = constrain(s, couples, S_THETA2, g, lambda + num_at(0, S_THETA2, CONSTRAINTS));
    }
    set_wall_shear(couples, lambda, w);
    return st;
}

static enum status system_init(const struct contour *c, struct system *out)
{
    const bool turns = c->shear == WALL_SHEAR_FLEXIBLE;
    const size_t nodes = (size_t)c->n_node, values = turns ? 2 * nodes + 2 : nodes, n = values - 1;
    struct system s = {.n = (int)n, .n_node = c->n_node, .turns = turns};
    s.factor = calloc(n * n + values * (size_t)(2 * CONSTRAINTS), sizeof *s.factor);
    if (s.factor == NULL) {
        return ST_NO_MEMORY;
    }
    s.constraint = s.factor + n * n;
    s.response = s.constraint + values * CONSTRAINTS;
    *out = s;
    return ST_OK;
}

static enum status warping_init(const struct contour *c, const struct system *s,
                                struct warping *out)
{
    const int n_value = s->n + 1;
    double *g = calloc((size_t)n_value * WARPING_COLUMNS, sizeof *g);
    if (g == NULL) {
        return ST_NO_MEMORY;
    }
    *out = (struct warping){.n_node = s->n_node, .n_value = n_value, .g = g, .camber = c->camber};
    return ST_OK;
}

enum status warping_solve(const struct contour *c, const struct laminate *laminate,
                          struct warping *classic, struct warping *retained)
{
    assert(c->n_element >= 1);
    struct warping a = {0}, b = {0};
    struct system s = {0};
    enum status st = system_init(c, &s);
    if (st == ST_OK) {
        st = warping_init(c, &s, &a);
    }
    if (st == ST_OK) {
        st = warping_init(c, &s, &b);
    }
    if (st == ST_OK) {
        st = factor(c, laminate, &a, &s);
    }
    if (st == ST_OK) {
        struct couples couples;
        solve_classic(c, laminate, &s, &a, &couples);
        st = solve_retained(c, laminate, &a, &couples, &s, &b);
    }
    if (st == ST_OK && c->camber.on) {
        find_lag(c, laminate, &a);
        find_lag(c, laminate, &b);
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

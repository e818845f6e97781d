#include "core/aero/lifting_line.h"

#include "core/aero/lifting_line_kernel.h"
#include "core/la.h"
#include "core/num.h"

#include <assert.h>
#include <stdlib.h>
#include <string.h>

/* Zeroed and aligned for the kernels; n a multiple of LANES. */
static double *aligned_zeros(size_t n)
{
    double *x = aligned_alloc(64, n * sizeof *x);
    if (x != NULL) {
        memset(x, 0, n * sizeof *x);
    }
    return x;
}

/* B~ B and the sums of the rows of B. */
static void fill_smooth(struct lifting_line *ll)
{
    const int n = ll->n;
    for (int j = 0; j < n; j++) {
        for (int i = 0; i < n; i++) {
            ll->row_sum[i] += ll->induced[num_at(i, j, ll->rows)];
        }
    }
    for (int j = 0; j < n; j++) {
        const double *column = ll->induced + num_at(0, j, ll->rows);
        double *out = ll->smooth + num_at(0, j, ll->rows);
        ll->multiply(ll->rows, n, ll->induced, column, out);
        for (int i = 0; i < n; i++) {
            out[i] -= ll->row_sum[i] * column[i];
        }
    }
}

enum status lifting_line_init(const struct wing *wing, double tolerance, int iterations_max,
                              struct lifting_line *out)
{
    assert(wing->n >= 1);
    assert(wing->walls != WALLS_ROOT_AND_FAR || wing->width > wing->length);
    struct lifting_line ll = {.n = wing->n,
                              .tolerance = tolerance,
                              .iterations_max = iterations_max,
                              .rows = simd_padded(wing->n),
                              .multiply = simd_gemv(simd_level_of_machine()),
                              .evaluate = lifting_line_kernel(simd_level_of_machine())};
    const size_t rows = (size_t)ll.rows, matrix = rows * (size_t)ll.n;
    ll.block = aligned_zeros(2 * matrix + rows);
    if (ll.block == NULL) {
        return ST_NO_MEMORY;
    }
    ll.induced = ll.block;
    ll.smooth = ll.induced + matrix;
    ll.row_sum = ll.smooth + matrix;
    downwash_matrix(wing, ll.rows, ll.induced);
    fill_smooth(&ll);
    *out = ll;
    return ST_OK;
}

void lifting_line_done(struct lifting_line *ll)
{
    free(ll->block);
    *ll = (struct lifting_line){0};
}

enum status lifting_line_state_init(int n, struct lifting_line_state *out)
{
    enum { VECTORS = 19 };
    const size_t rows = (size_t)simd_padded(n), dense = (size_t)n * (size_t)n;
    const size_t total = (VECTORS + (size_t)n) * rows + 2 * dense;
    struct lifting_line_state s = {.n = n};
    s.block = aligned_zeros((total + LANES - 1) / LANES * LANES);
    s.pivot = calloc((size_t)n, sizeof *s.pivot);
    if (s.block == NULL || s.pivot == NULL) {
        free(s.block);
        free(s.pivot);
        return ST_NO_MEMORY;
    }
    double **const array[VECTORS] = {
        &s.cl,     &s.alpha,   &s.induced,  &s.rough,   &s.previous, &s.older,      &s.trial,
        &s.table,  &s.slope,   &s.residual, &s.step,    &s.alpha_g,  &s.piece_from, &s.piece_to,
        &s.origin, &s.lift[0], &s.lift[1],  &s.lift[2], &s.lift[3]};
    for (int i = 0; i < VECTORS; i++) {
        *array[i] = s.block + (size_t)i * rows;
    }
    s.inverse = s.block + VECTORS * rows;
    s.dense = s.inverse + rows * (size_t)n;
    s.work = s.dense + dense;
    for (size_t i = (size_t)n; i < rows; i++) { /* the idle lanes are always on their piece */
        s.piece_from[i] = -HUGE_VAL;
        s.piece_to[i] = HUGE_VAL;
    }
    *out = s;
    return ST_OK;
}

void lifting_line_state_done(struct lifting_line_state *s)
{
    free(s->block);
    free(s->pivot);
    *s = (struct lifting_line_state){0};
}

/* What a solver call works on. */
struct problem {
    const struct lifting_line *ll;
    const struct polar *polar;
    const double *alpha_g, *plunge;
    struct lifting_line_state *s;
    int iterations; /* spent so far */
};

static void take_piece(const struct problem *p, int i, double alpha)
{
    struct lifting_line_state *s = p->s;
    const struct polar_piece piece = polar_piece_at(p->polar, alpha, p->plunge[i]);
    s->piece_from[i] = piece.from;
    s->piece_to[i] = piece.to;
    s->origin[i] = piece.origin;
    for (int k = 0; k < 4; k++) {
        s->lift[k][i] = piece.lift[k];
    }
}

/* Lift and slope of a station from the polar, which becomes its piece. The offset of an angle that
 * is not finite is of no use: there the piece is constant. */
static void ask_polar(const struct problem *p, int i, double alpha)
{
    struct lifting_line_state *s = p->s;
    take_piece(p, i, alpha);
    const double t = isfinite(alpha) ? alpha - s->origin[i] : 0.0;
    const double a1 = s->lift[1][i], a2 = s->lift[2][i], a3 = s->lift[3][i];
    s->table[i] = s->lift[0][i] + t * (a1 + t * (a2 + t * a3));
    s->slope[i] = a1 + t * (2.0 * a2 + t * (3.0 * a3));
}

/* Residual c_l - C_l(alpha) - eps B~ alpha of s->cl, alpha = alpha_g - B c_l; fills induced, alpha,
 * table, slope, rough, residual. Returns the largest. */
static double evaluate(const struct problem *p)
{
    const struct lifting_line *ll = p->ll;
    struct lifting_line_state *s = p->s;
    double largest;
    const bool inside = ll->evaluate(ll, s, &largest);
    if (inside && !(s->epsilon > 0.0)) {
        return largest;
    }
    for (int i = 0; i < s->n; i++) {
        if (!(s->alpha[i] >= s->piece_from[i] && s->alpha[i] < s->piece_to[i])) {
            ask_polar(p, i, s->alpha[i]);
            s->residual[i] = s->cl[i] - s->table[i];
        }
    }
    if (s->epsilon > 0.0) {
        ll->multiply(ll->rows, s->n, ll->induced, s->alpha, s->rough);
        for (int i = 0; i < s->n; i++) {
            s->rough[i] -= ll->row_sum[i] * s->alpha[i];
            s->residual[i] -= s->epsilon * s->rough[i];
        }
    }
    return lifting_line_largest(s->n, s->residual);
}

/* Inverse of the Jacobian I + diag(C_l') B + eps B~ B at the present iterate. */
static bool factor(const struct lifting_line *ll, struct lifting_line_state *s)
{
    const int n = s->n;
    for (int j = 0; j < n; j++) {
        for (int i = 0; i < n; i++) {
            const ptrdiff_t at = num_at(i, j, ll->rows);
            s->dense[num_at(i, j, n)] =
                (i == j ? 1.0 : 0.0) + s->slope[i] * ll->induced[at] + s->epsilon * ll->smooth[at];
        }
    }
    s->factored = la_inverse_work(n, s->dense, s->pivot, s->work) == ST_OK;
    for (int j = 0; j < n && s->factored; j++) {
        memcpy(s->inverse + num_at(0, j, ll->rows), s->dense + num_at(0, j, n),
               (size_t)n * sizeof *s->inverse);
    }
    return s->factored;
}

/* One damped Newton step from an iterate of residual `before`: halves until the residual falls.
 * Returns the new residual; s->cl is the new iterate, or the old one if nothing helped. */
static double damped_step(const struct problem *p, double before)
{
    enum { HALVINGS = 8 };
    struct lifting_line_state *s = p->s;
    const size_t bytes = (size_t)s->n * sizeof *s->cl;
    p->ll->multiply(p->ll->rows, s->n, s->inverse, s->residual, s->step);
    memcpy(s->trial, s->cl, bytes);
    double scale = 1.0;
    for (int k = 0; k <= HALVINGS; k++, scale *= 0.5) {
        for (int i = 0; i < s->n; i++) {
            s->cl[i] = s->trial[i] - scale * s->step[i];
        }
        const double after = evaluate(p);
        if (after < before) {
            return after;
        }
    }
    memcpy(s->cl, s->trial, bytes);
    return evaluate(p);
}

/* First iterate: the table at the geometric angle, or the earlier solutions continued in a
 * constant, a line or a parabola, as many as there are. */
static void start_values(const struct problem *p)
{
    static const double weight[4][3] = {{0}, {1.0}, {2.0, -1.0}, {3.0, -3.0, 1.0}};
    struct lifting_line_state *s = p->s;
    if (s->known == 0) {
        for (int i = 0; i < s->n; i++) {
            ask_polar(p, i, p->alpha_g[i]);
            s->cl[i] = s->table[i];
        }
        return;
    }
    const double *a = weight[s->known];
    for (int i = 0; i < s->n; i++) {
        const double last = s->cl[i];
        s->cl[i] = a[0] * last + a[1] * s->previous[i] + a[2] * s->older[i];
        s->older[i] = s->previous[i];
        s->previous[i] = last;
    }
}

/* Newton from s->cl with the viscosity s->epsilon. Returns the largest residual left. */
static double newton(struct problem *p)
{
    struct lifting_line_state *s = p->s;
    double residual = evaluate(p);
    bool fresh = false; /* is the inverse that of this iterate? */
    while (residual > p->ll->tolerance && p->iterations < p->ll->iterations_max) {
        if (!s->factored) {
            if (!factor(p->ll, s)) {
                break;
            }
            fresh = true;
        }
        const double before = residual;
        residual = damped_step(p, before);
        p->iterations++;
        /* An old inverse is kept as long as it cuts the residual to a third; a fresh one that does
         * not help at all has met a fold: give up and say so. */
        if (residual >= before && fresh) {
            break;
        }
        s->factored = residual <= 0.3 * before;
        fresh = false;
    }
    return residual;
}

/* Twice the least that makes the solution one; a table that falls more steeply than lift ever rises
 * (a jump, or scatter between close points) counts as that steep. */
static double full_viscosity(double fall)
{
    const double m = fmin(fall, 2.0 * NUM_PI);
    return 2.0 * m * m / 4.0;
}

double lifting_line_viscosity(const struct polar *p, int n, const double *slope)
{
    const double steepest = polar_steepest_fall(p);
    double fall = 0.0;
    for (int i = 0; i < n; i++) {
        fall = fmax(fall, -slope[i]);
    }
    return fall > 0.0 ? full_viscosity(steepest) * fmin(1.0, fall / (0.1 * steepest)) : 0.0;
}

/* Newton again with another viscosity. */
static double newton_with(struct problem *p, double epsilon)
{
    p->s->epsilon = epsilon;
    p->s->factored = false;
    return newton(p);
}

/* The same from the present iterate, from the table, from no lift, until one converges. */
static double newton_from_anywhere(struct problem *p, double epsilon)
{
    struct lifting_line_state *s = p->s;
    double residual = newton_with(p, epsilon);
    for (int start = 0; start < 2 && !(residual <= p->ll->tolerance); start++) {
        s->known = 0;
        start_values(p);
        if (start == 1) {
            memset(s->cl, 0, (size_t)s->n * sizeof *s->cl);
        }
        residual = newton_with(p, epsilon);
    }
    return residual;
}

/* Viscosity asked for by the solution at hand less the one it was computed with. */
static double shortfall(const struct problem *p)
{
    return lifting_line_viscosity(p->polar, p->s->n, p->s->slope) - p->s->epsilon;
}

/* A solution with as much viscosity as its own slopes ask for: full in all but the first moments of
 * a stall, where it is searched for between none and full (regula falsi, Illinois) and rounded up.
 * Returns the largest residual. */
static double regularise(struct problem *p)
{
    enum { SEARCH_MAX = 20 };
    static const double close = 1e-3; /* relative to the full viscosity */
    const double full = full_viscosity(polar_steepest_fall(p->polar));
    const double tolerance = p->ll->tolerance;
    double residual = newton_from_anywhere(p, full);
    double high = full, g_high = shortfall(p);
    if (!(residual <= tolerance) || g_high >= 0.0) {
        return residual;
    }
    residual = newton_with(p, 0.0);
    double low = 0.0, g_low = residual <= tolerance ? shortfall(p) : full;
    if (g_low <= 0.0) {
        return residual;
    }
    int side = 0;
    double g = g_high;
    /* Half of the iterations at most, so that some are left for the rounding up. */
    for (int k = 0; k < SEARCH_MAX && !(g <= 0.0 && g >= -close * full) &&
                    2 * p->iterations < p->ll->iterations_max;
         k++) {
        const double middle = (low * g_high - high * g_low) / (g_high - g_low);
        residual = newton_with(p, middle);
        g = residual <= tolerance ? shortfall(p) : full;
        const int next = g > 0.0 ? 1 : -1;
        double *const moved = g > 0.0 ? &g_low : &g_high;
        double *const kept = g > 0.0 ? &g_high : &g_low;
        *(g > 0.0 ? &low : &high) = middle;
        *moved = g;
        *kept *= next == side ? 0.5 : 1.0;
        side = next;
    }
    if (p->s->epsilon < high) {
        residual = newton_with(p, high);
        /* The way there may have led to another solution, with a steeper fall. */
        residual = shortfall(p) > 0.0 ? newton_with(p, full) : residual;
    }
    return residual;
}

struct lifting_line_report lifting_line_solve(const struct lifting_line *ll, const struct polar *p,
                                              const double *alpha_geometric, const double *plunge,
                                              struct lifting_line_state *s)
{
    assert(s->n == ll->n);
    struct problem problem = {
        .ll = ll, .polar = p, .alpha_g = alpha_geometric, .plunge = plunge, .s = s};
    const int known = s->known;
    memcpy(s->alpha_g, alpha_geometric, (size_t)s->n * sizeof *s->alpha_g);
    for (int i = 0; i < s->n && known > 0; i++) {
        take_piece(&problem, i, s->alpha[i]); /* at the new plunge */
    }
    start_values(&problem);
    double residual = known > 0 ? newton(&problem) : newton_with(&problem, 0.0);
    if (!(residual <= ll->tolerance) && known > 0) {
        /* The earlier solutions may have led astray. */
        s->known = 0;
        start_values(&problem);
        residual = newton_with(&problem, 0.0);
    }
    if (polar_steepest_fall(p) > 0.0 &&
        !(residual <= ll->tolerance && shortfall(&problem) == 0.0)) {
        s->known = 0;
        residual = regularise(&problem);
    }
    const bool converged = residual <= ll->tolerance;
    /* A failed solution is no start for the next. */
    s->known = converged ? (s->known < 3 ? s->known + 1 : 3) : 0;
    const double smoothing =
        s->epsilon > 0.0 ? s->epsilon * lifting_line_largest(s->n, s->rough) : 0.0;
    return (struct lifting_line_report){.converged = converged,
                                        .iterations = problem.iterations,
                                        .residual = residual,
                                        .smoothing = smoothing};
}

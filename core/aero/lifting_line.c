#include "core/aero/lifting_line.h"

#include "core/la.h"
#include "core/num.h"

#include <assert.h>
#include <stdlib.h>
#include <string.h>

/* Downwash at y of a semi-infinite trailing vortex at y0, with all the images of one sign the walls
 * give it, times 4 pi. A vortex row of period p sums to (pi/p) cot(pi (y - y0)/p). */
static double trailing(double y, double y0, double period)
{
    if (period > 0.0) {
        return NUM_PI / period / tan(NUM_PI * (y - y0) / period);
    }
    return 1.0 / (y - y0);
}

/* Zeroed and aligned for the kernels; n a multiple of LANES. */
static double *aligned_zeros(size_t n)
{
    double *x = aligned_alloc(64, n * sizeof *x);
    if (x != NULL) {
        memset(x, 0, n * sizeof *x);
    }
    return x;
}

enum status lifting_line_init(int n, double length, const double *chord, enum wall_images walls,
                              double width, double tolerance, int iterations_max,
                              struct lifting_line *out)
{
    assert(n >= 1);
    assert(walls != WALLS_ROOT_AND_FAR || width > length);
    struct lifting_line ll = {.n = n,
                              .tolerance = tolerance,
                              .iterations_max = iterations_max,
                              .rows = simd_padded(n),
                              .multiply = simd_gemv(simd_level_of_machine())};
    ll.induced = aligned_zeros((size_t)ll.rows * (size_t)n);
    if (ll.induced == NULL) {
        return ST_NO_MEMORY;
    }
    const double h = length / n;
    /* Two mirrors at distance W repeat the wing and its root image with the period 2 W. */
    const double period = walls == WALLS_ROOT_AND_FAR ? 2.0 * width : 0.0;
    for (int j = 0; j < n; j++) {
        for (int i = 0; i < n; i++) {
            const double y = (i + 0.5) * h, left = j * h, right = (j + 1) * h;
            double sum = trailing(y, left, period) - trailing(y, right, period);
            if (walls != WALLS_NONE) {
                sum += trailing(y, -right, period) - trailing(y, -left, period);
            }
            /* w/V = Gamma/(4 pi V) sum with Gamma = V c c_l / 2 of element j. */
            ll.induced[num_at(i, j, ll.rows)] = chord[j] * sum / (8.0 * NUM_PI);
        }
    }
    *out = ll;
    return ST_OK;
}

void lifting_line_done(struct lifting_line *ll)
{
    free(ll->induced);
    *ll = (struct lifting_line){0};
}

enum status lifting_line_state_init(int n, struct lifting_line_state *out)
{
    enum { VECTORS = 10 };
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
    double **const array[VECTORS] = {&s.cl,    &s.alpha, &s.induced, &s.previous, &s.older,
                                     &s.trial, &s.table, &s.slope,   &s.residual, &s.step};
    for (int i = 0; i < VECTORS; i++) {
        *array[i] = s.block + (size_t)i * rows;
    }
    s.inverse = s.block + VECTORS * rows;
    s.dense = s.inverse + rows * (size_t)n;
    s.work = s.dense + dense;
    *out = s;
    return ST_OK;
}

void lifting_line_state_done(struct lifting_line_state *s)
{
    free(s->block);
    free(s->pivot);
    *s = (struct lifting_line_state){0};
}

/* Residual c_l - C_l(alpha_g - B c_l) of s->cl; fills induced, alpha, table, slope, residual. */
static double evaluate(const struct lifting_line *ll, const struct polar *p, const double *alpha_g,
                       const double *plunge, struct lifting_line_state *s)
{
    ll->multiply(ll->rows, s->n, ll->induced, s->cl, s->induced);
    for (int i = 0; i < s->n; i++) {
        s->alpha[i] = alpha_g[i] - s->induced[i];
    }
    polar_lift(p, s->n, s->alpha, plunge, s->table, s->slope);
    double largest = 0.0;
    for (int i = 0; i < s->n; i++) {
        s->residual[i] = s->cl[i] - s->table[i];
        const double size = fabs(s->residual[i]);
        /* A NaN must win, whatever the order of the comparison. */
        largest = size > largest || isnan(size) ? size : largest;
    }
    return largest;
}

/* Inverse of the Jacobian I + diag(C_l') B at the present iterate. */
static bool factor(const struct lifting_line *ll, struct lifting_line_state *s)
{
    const int n = s->n;
    for (int j = 0; j < n; j++) {
        for (int i = 0; i < n; i++) {
            s->dense[num_at(i, j, n)] =
                (i == j ? 1.0 : 0.0) + s->slope[i] * ll->induced[num_at(i, j, ll->rows)];
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
static double damped_step(const struct lifting_line *ll, const struct polar *p,
                          const double *alpha_g, const double *plunge, double before,
                          struct lifting_line_state *s)
{
    enum { HALVINGS = 6 };
    const size_t bytes = (size_t)s->n * sizeof *s->cl;
    ll->multiply(ll->rows, s->n, s->inverse, s->residual, s->step);
    memcpy(s->trial, s->cl, bytes);
    double scale = 1.0;
    for (int k = 0; k <= HALVINGS; k++, scale *= 0.5) {
        for (int i = 0; i < s->n; i++) {
            s->cl[i] = s->trial[i] - scale * s->step[i];
        }
        const double after = evaluate(ll, p, alpha_g, plunge, s);
        if (after < before) {
            return after;
        }
    }
    memcpy(s->cl, s->trial, bytes);
    return evaluate(ll, p, alpha_g, plunge, s);
}

/* First iterate: the table at the geometric angle, or the earlier solutions continued in a
 * constant, a line or a parabola, as many as there are. */
static void start_values(const struct polar *p, const double *alpha_g, const double *plunge,
                         struct lifting_line_state *s)
{
    static const double weight[4][3] = {{0}, {1.0}, {2.0, -1.0}, {3.0, -3.0, 1.0}};
    if (s->known == 0) {
        polar_lift(p, s->n, alpha_g, plunge, s->cl, s->slope);
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

/* Newton from the values start_values gives. */
static struct lifting_line_report iterate(const struct lifting_line *ll, const struct polar *p,
                                          const double *alpha_geometric, const double *plunge,
                                          struct lifting_line_state *s)
{
    start_values(p, alpha_geometric, plunge, s);
    struct lifting_line_report r = {.residual = evaluate(ll, p, alpha_geometric, plunge, s)};
    bool fresh = false; /* is the inverse that of this iterate? */
    while (r.residual > ll->tolerance && r.iterations < ll->iterations_max) {
        if (!s->factored) {
            if (!factor(ll, s)) {
                break;
            }
            fresh = true;
        }
        const double before = r.residual;
        r.residual = damped_step(ll, p, alpha_geometric, plunge, before, s);
        r.iterations++;
        /* An old inverse is kept as long as it cuts the residual to a third; a fresh one that does
         * not help at all has met a fold: give up and say so. */
        if (r.residual >= before && fresh) {
            break;
        }
        s->factored = r.residual <= 0.3 * before;
        fresh = false;
    }
    r.converged = r.residual <= ll->tolerance;
    /* A failed solution is no start for the next. */
    s->known = r.converged ? (s->known < 3 ? s->known + 1 : 3) : 0;
    return r;
}

struct lifting_line_report lifting_line_solve(const struct lifting_line *ll, const struct polar *p,
                                              const double *alpha_geometric, const double *plunge,
                                              struct lifting_line_state *s)
{
    assert(s->n == ll->n);
    const bool warm = s->known > 0;
    struct lifting_line_report r = iterate(ll, p, alpha_geometric, plunge, s);
    if (!r.converged && warm) {
        /* The earlier solutions may have led astray; known is 0 now, so this one starts cold. */
        const int spent = r.iterations;
        s->factored = false;
        r = iterate(ll, p, alpha_geometric, plunge, s);
        r.iterations += spent;
    }
    return r;
}

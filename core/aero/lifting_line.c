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

enum status lifting_line_init(int n, double length, const double *chord, enum wall_images walls,
                              double width, double tolerance, int iterations_max,
                              struct lifting_line *out)
{
    assert(n >= 1);
    assert(walls != WALLS_ROOT_AND_FAR || width > length);
    struct lifting_line ll = {.n = n, .tolerance = tolerance, .iterations_max = iterations_max};
    ll.induced = malloc((size_t)n * (size_t)n * sizeof *ll.induced);
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
            ll.induced[num_at(i, j, n)] = chord[j] * sum / (8.0 * NUM_PI);
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
    enum { VECTORS = 9 };
    const size_t vector = (size_t)n, matrix = vector * vector;
    struct lifting_line_state s = {.n = n};
    s.block = calloc(VECTORS * vector + 2 * matrix, sizeof *s.block);
    s.pivot = calloc(vector, sizeof *s.pivot);
    if (s.block == NULL || s.pivot == NULL) {
        free(s.block);
        free(s.pivot);
        return ST_NO_MEMORY;
    }
    double **const array[VECTORS] = {&s.cl,    &s.alpha, &s.induced, &s.previous, &s.older,
                                     &s.trial, &s.table, &s.slope,   &s.residual};
    for (int i = 0; i < VECTORS; i++) {
        *array[i] = s.block + (size_t)i * vector;
    }
    s.inverse = s.block + VECTORS * vector;
    s.work = s.inverse + matrix;
    *out = s;
    return ST_OK;
}

void lifting_line_state_done(struct lifting_line_state *s)
{
    free(s->block);
    free(s->pivot);
    *s = (struct lifting_line_state){0};
}

/* y = a x, column by column: the compiler vectorises over the rows. */
static void multiply(int n, const double *restrict a, const double *restrict x, double *restrict y)
{
    for (int i = 0; i < n; i++) {
        y[i] = a[i] * x[0];
    }
    for (int j = 1; j < n; j++) {
        const double *restrict column = a + (size_t)n * (size_t)j;
        for (int i = 0; i < n; i++) {
            y[i] += column[i] * x[j];
        }
    }
}

/* Residual c_l - C_l(alpha_g - B c_l) of s->cl; fills induced, alpha, table, slope, residual. */
static double evaluate(const struct lifting_line *ll, const struct polar *p, const double *alpha_g,
                       const double *plunge, struct lifting_line_state *s)
{
    multiply(s->n, ll->induced, s->cl, s->induced);
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
            const ptrdiff_t k = num_at(i, j, n);
            s->inverse[k] = (i == j ? 1.0 : 0.0) + s->slope[i] * ll->induced[k];
        }
    }
    s->factored = la_inverse_work(n, s->inverse, s->pivot, s->work) == ST_OK;
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
    double *const step = s->work; /* free between factorisations */
    multiply(s->n, s->inverse, s->residual, step);
    memcpy(s->trial, s->cl, bytes);
    double scale = 1.0;
    for (int k = 0; k <= HALVINGS; k++, scale *= 0.5) {
        for (int i = 0; i < s->n; i++) {
            s->cl[i] = s->trial[i] - scale * step[i];
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

struct lifting_line_report lifting_line_solve(const struct lifting_line *ll, const struct polar *p,
                                              const double *alpha_geometric, const double *plunge,
                                              struct lifting_line_state *s)
{
    assert(s->n == ll->n);
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

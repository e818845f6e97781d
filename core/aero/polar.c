#include "core/aero/polar.h"

#include "core/num.h"

#include <assert.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

enum { QUANTITIES = 3, PADDED = 4, CUBIC = 4 }; /* c_l, c_d, c_m, and nothing */

/* On [alpha_i, alpha_i+1]: c = a0 + t (a1 + t (a2 + t a3)), t = alpha - alpha_i. */
struct cubic {
    double a[CUBIC][PADDED]; /* coefficient, quantity: the quantities are computed side by side */
};

struct polar {
    int n_alpha, n_plunge;
    double linear_from, linear_to;
    struct stall_def stall;
    double steepest_fall; /* [1/rad] */
    double *alpha;        /* (n_alpha) */
    double *plunge;       /* (n_plunge) */
    double beyond;        /* the first angle behind the table */
    struct cubic *cubic;  /* ((n_alpha - 1) x n_plunge) */
    /* Buckets of equal width over the angles give the first interval to look at in O(1). */
    int n_bucket;
    double bucket_per_rad;
    int *bucket; /* (n_bucket) */
};

struct stall_def stall_def_default(void)
{
    return (struct stall_def){.lift_slope = 2.0 * NUM_PI,
                              .lift_centre = 0.25,
                              .pressure_lag = 1.7,
                              .boundary_layer_lag = 3.0,
                              .vortex_lag = 6.0};
}

bool polar_def_has_drag(const struct polar_def *def)
{
    return def->cd != NULL;
}

void polar_def_done(struct polar_def *def)
{
    free(def->alpha);
    free(def->plunge);
    free(def->cl);
    free(def->cd);
    free(def->cm);
    def->alpha = def->plunge = def->cl = def->cd = def->cm = NULL;
}

static void check_axis(int n, const double *x, int least, const char *pointer, const char *field,
                       struct failure_list *out)
{
    char where[160], got[96];
    (void)snprintf(where, sizeof where, "%s/%s", pointer, field);
    if (n < least) {
        (void)snprintf(got, sizeof got, "%d values", n);
        failure_set(failure_add(out), ST_INVALID, where, "too_short", NULL, got,
                    "%s needs at least %d value%s", field, least, least == 1 ? "" : "s");
        return;
    }
    for (int i = 0; i < n; i++) {
        if (!isfinite(x[i]) || (i > 0 && !(x[i] > x[i - 1]))) {
            (void)snprintf(where, sizeof where, "%s/%s/%d", pointer, field, i);
            failure_set(failure_add(out), ST_INVALID, where, "not_increasing",
                        "finite, strictly increasing values", NULL,
                        "value %d of %s does not increase", i, field);
            return;
        }
    }
}

void polar_def_check(const struct polar_def *def, const char *pointer, struct failure_list *out)
{
    check_axis(def->n_alpha, def->alpha, 2, pointer, "alpha_deg", out);
    check_axis(def->n_plunge, def->plunge, 1, pointer, "plunge_c", out);
    static const char *const field[QUANTITIES] = {"cl", "cd", "cm"};
    const double *table[QUANTITIES] = {def->cl, def->cd, def->cm};
    for (int k = 0; k < QUANTITIES; k++) {
        for (int i = 0; table[k] != NULL && i < def->n_alpha * def->n_plunge; i++) {
            if (!isfinite(table[k][i])) {
                char where[160];
                (void)snprintf(where, sizeof where, "%s/%s/%d/%d", pointer, field[k],
                               i / def->n_alpha, i % def->n_alpha);
                failure_set(failure_add(out), ST_INVALID, where, "not_finite", "a finite number",
                            NULL, "a coefficient of the polar is not finite");
                break;
            }
        }
    }
    if (!(def->linear_from < def->linear_to)) {
        char where[160];
        (void)snprintf(where, sizeof where, "%s/linear_to_deg", pointer);
        failure_set(failure_add(out), ST_INVALID, where, "out_of_range", "> linear_from_deg", NULL,
                    "the linear range of the polar is empty");
    }
}

/* One-sided slope at the border of a Fritsch-Carlson curve, three points, limited in sign and size.
 */
static double border_slope(double h0, double h1, double d0, double d1)
{
    const double s = ((2.0 * h0 + h1) * d0 - h0 * d1) / (h0 + h1);
    if (s * d0 <= 0.0) {
        return 0.0;
    }
    return d0 * d1 <= 0.0 && fabs(s) > 3.0 * fabs(d0) ? 3.0 * d0 : s;
}

/* Slopes that keep the shape of the data: Fritsch & Carlson 1980, weighted harmonic mean of
 * Fritsch & Butland inside. */
static double interior_slope(double h0, double h1, double d0, double d1)
{
    if (d0 * d1 <= 0.0) {
        return 0.0;
    }
    const double w0 = 2.0 * h1 + h0, w1 = h1 + 2.0 * h0;
    return (w0 + w1) / (w0 / d0 + w1 / d1);
}

static double node_slope(int n, const double *x, const double *y, int i)
{
    if (n == 2) {
        return (y[1] - y[0]) / (x[1] - x[0]);
    }
    const int k = i == 0 ? 0 : (i == n - 1 ? n - 3 : i - 1);
    const double h0 = x[k + 1] - x[k], h1 = x[k + 2] - x[k + 1];
    const double d0 = (y[k + 1] - y[k]) / h0, d1 = (y[k + 2] - y[k + 1]) / h1;
    if (i == 0) {
        return border_slope(h0, h1, d0, d1);
    }
    return i == n - 1 ? border_slope(h1, h0, d1, d0) : interior_slope(h0, h1, d0, d1);
}

static struct cubic *cubic_of(const struct polar *p, int plunge, int interval)
{
    return p->cubic + ((ptrdiff_t)plunge * (p->n_alpha - 1) + interval);
}

static void fill_cubics(struct polar *p, int plunge, int quantity, const double *y)
{
    for (int i = 0; i + 1 < p->n_alpha; i++) {
        const double h = p->alpha[i + 1] - p->alpha[i];
        const double s0 = node_slope(p->n_alpha, p->alpha, y, i);
        const double s1 = node_slope(p->n_alpha, p->alpha, y, i + 1);
        const double d = (y[i + 1] - y[i]) / h;
        struct cubic *c = cubic_of(p, plunge, i);
        c->a[0][quantity] = y[i];
        c->a[1][quantity] = s0;
        c->a[2][quantity] = (3.0 * d - 2.0 * s0 - s1) / h;
        c->a[3][quantity] = (s0 + s1 - 2.0 * d) / (h * h);
    }
}

/* Steepest fall of the lift over [0, h]: at an end, or at the vertex of its slope. */
static double fall_of(const struct cubic *c, double h)
{
    const double a1 = c->a[1][0], a2 = c->a[2][0], a3 = c->a[3][0];
    const double vertex = a3 > 0.0 ? num_clamp(-a2 / (3.0 * a3), 0.0, h) : 0.0;
    const double t[] = {0.0, vertex, h};
    double fall = 0.0;
    for (size_t k = 0; k < sizeof t / sizeof t[0]; k++) {
        fall = fmax(fall, -(a1 + t[k] * (2.0 * a2 + t[k] * 3.0 * a3)));
    }
    return fall;
}

static double steepest_fall(const struct polar *p)
{
    double fall = 0.0;
    for (int r = 0; r < p->n_plunge; r++) {
        for (int i = 0; i + 1 < p->n_alpha; i++) {
            fall = fmax(fall, fall_of(cubic_of(p, r, i), p->alpha[i + 1] - p->alpha[i]));
        }
    }
    return fall;
}

enum status polar_create(const struct polar_def *def, struct polar **out)
{
    assert(def->n_alpha >= 2);
    assert(def->n_plunge >= 1);
    const size_t na = (size_t)def->n_alpha, np = (size_t)def->n_plunge;
    struct polar *p = calloc(1, sizeof *p);
    if (p == NULL) {
        return ST_NO_MEMORY;
    }
    *p = (struct polar){.n_alpha = def->n_alpha,
                        .n_plunge = def->n_plunge,
                        .linear_from = def->linear_from,
                        .stall = def->stall,
                        .linear_to = def->linear_to,
                        .n_bucket = 4 * def->n_alpha};
    p->alpha = calloc(na + np, sizeof *p->alpha);
    p->cubic = calloc((na - 1) * np, sizeof *p->cubic);
    p->bucket = malloc((size_t)p->n_bucket * sizeof *p->bucket);
    if (p->alpha == NULL || p->cubic == NULL || p->bucket == NULL) {
        polar_destroy(p);
        return ST_NO_MEMORY;
    }
    p->plunge = p->alpha + na;
    memcpy(p->alpha, def->alpha, na * sizeof *p->alpha);
    memcpy(p->plunge, def->plunge, np * sizeof *p->plunge);
    for (int r = 0; r < def->n_plunge; r++) {
        fill_cubics(p, r, 0, def->cl + (size_t)r * na);
        if (polar_def_has_drag(def)) {
            fill_cubics(p, r, 1, def->cd + (size_t)r * na);
        }
        fill_cubics(p, r, 2, def->cm + (size_t)r * na);
    }
    p->steepest_fall = steepest_fall(p);
    p->beyond = nextafter(p->alpha[na - 1], HUGE_VAL);
    const double range = p->alpha[na - 1] - p->alpha[0];
    p->bucket_per_rad = p->n_bucket / range;
    int interval = 0;
    for (int b = 0; b < p->n_bucket; b++) {
        const double from = p->alpha[0] + range * b / p->n_bucket;
        while (interval + 2 < p->n_alpha && p->alpha[interval + 1] <= from) {
            interval++;
        }
        p->bucket[b] = interval;
    }
    *out = p;
    return ST_OK;
}

void polar_destroy(struct polar *p)
{
    if (p != NULL) {
        free(p->alpha);
        free(p->cubic);
        free(p->bucket);
        free(p);
    }
}

/* Interval of the angle and the offset in it; held at the borders. */
static inline int locate(const struct polar *p, double alpha, double *t, bool *outside)
{
    const double first = p->alpha[0], last = p->alpha[p->n_alpha - 1];
    /* Written so that a NaN is outside and does not index. */
    *outside = !(alpha >= first && alpha <= last);
    const double a = alpha > first ? (alpha < last ? alpha : last) : first;
    int b = (int)((a - first) * p->bucket_per_rad);
    b = b >= p->n_bucket ? p->n_bucket - 1 : b;
    int i = p->bucket[b];
    while (i + 2 < p->n_alpha && a >= p->alpha[i + 1]) {
        i++;
    }
    *t = a - p->alpha[i];
    return i;
}

/* Rows of the plunge that enclose the value and the weight of the upper one. */
static inline int locate_plunge(const struct polar *p, double plunge, double *weight, bool *outside)
{
    const int last = p->n_plunge - 1;
    *weight = 0.0;
    if (last == 0) {
        return 0; /* one row: the polar does not depend on the plunge */
    }
    if (!(plunge >= p->plunge[0] && plunge <= p->plunge[last])) {
        *outside = true;
        return plunge > p->plunge[last] ? last : 0;
    }
    int r = 0;
    while (r + 2 <= last && plunge >= p->plunge[r + 1]) {
        r++;
    }
    *weight = (plunge - p->plunge[r]) / (p->plunge[r + 1] - p->plunge[r]);
    return r;
}

/* Where a state is in the table: its interval with the offset in it, the cubics of the two rows
 * that enclose the plunge, twice the same where there is one, and the weight of the second. */
struct place {
    int interval;
    double t, weight;
    const struct cubic *row[2];
    bool outside_alpha, outside;
};

static inline struct place place_of(const struct polar *p, double alpha, double plunge)
{
    struct place at;
    at.interval = locate(p, alpha, &at.t, &at.outside_alpha);
    at.outside = at.outside_alpha;
    const int row = locate_plunge(p, plunge, &at.weight, &at.outside);
    at.row[0] = cubic_of(p, row, at.interval);
    at.row[1] = at.weight > 0.0 ? cubic_of(p, row + 1, at.interval) : at.row[0];
    return at;
}

/* Coefficient k of a quantity between the rows. */
static inline double blended(const struct place *at, int k, int quantity)
{
    const double a = at->row[0]->a[k][quantity];
    return a + at->weight * (at->row[1]->a[k][quantity] - a);
}

struct polar_value polar_at(const struct polar *p, double alpha, double plunge)
{
    const struct place at = place_of(p, alpha, plunge);
    const double hold = at.outside_alpha ? 0.0 : 1.0, t = at.t;
    double value[PADDED], slope[PADDED];
    for (int q = 0; q < PADDED; q++) {
        const double a1 = blended(&at, 1, q), a2 = blended(&at, 2, q), a3 = blended(&at, 3, q);
        value[q] = blended(&at, 0, q) + t * (a1 + t * (a2 + t * a3));
        slope[q] = a1 + t * (2.0 * a2 + t * (3.0 * a3));
    }
    return (struct polar_value){.cl = value[0],
                                .cd = value[1],
                                .cm = value[2],
                                .cl_slope = hold * slope[0],
                                .cm_slope = hold * slope[2],
                                .outside = at.outside,
                                .outside_alpha = at.outside_alpha};
}

struct polar_piece polar_piece_at(const struct polar *p, double alpha, double plunge)
{
    const struct place at = place_of(p, alpha, plunge);
    const double a0 = blended(&at, 0, 0), a1 = blended(&at, 1, 0);
    const double a2 = blended(&at, 2, 0), a3 = blended(&at, 3, 0), t = at.t;
    if (at.outside_alpha) {
        const bool above = alpha > p->alpha[0];
        return (struct polar_piece){.from = above ? p->beyond : -HUGE_VAL,
                                    .to = above ? HUGE_VAL : p->alpha[0],
                                    .origin = above ? p->beyond : p->alpha[0],
                                    .lift = {a0 + t * (a1 + t * (a2 + t * a3))}};
    }
    const int i = at.interval;
    return (struct polar_piece){.from = p->alpha[i],
                                .to = i + 2 < p->n_alpha ? p->alpha[i + 1] : p->beyond,
                                .origin = p->alpha[i],
                                .lift = {a0, a1, a2, a3}};
}

struct polar_range polar_linear_range(const struct polar *p)
{
    return (struct polar_range){.from = p->linear_from, .to = p->linear_to};
}

double polar_steepest_fall(const struct polar *p)
{
    return p->steepest_fall;
}

bool polar_is_stalled(const struct polar *p, double alpha)
{
    return !(alpha >= p->linear_from && alpha <= p->linear_to);
}

const struct stall_def *polar_stall(const struct polar *p)
{
    return &p->stall;
}

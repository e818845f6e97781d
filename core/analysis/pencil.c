#include "core/analysis/pencil.h"

#include "core/la.h"
#include "core/num.h"

#include <assert.h>
#include <complex.h>
#include <stdlib.h>
#include <string.h>

/* Scratch of one identification; one allocation. */
struct scratch {
    double *block;
    double *hankel;  /* (n - l) x (l + 1) */
    double *s;       /* singular values */
    double *vt;      /* right singular vectors, one a row */
    double *v1, *v2; /* (l x order): the vectors without their last and first entry */
    double *basis;   /* (n x order): the exponentials at the samples */
    double *rhs;     /* (n) */
};

static enum status scratch_init(int n, int l, int order, struct scratch *out)
{
    const size_t rows = (size_t)(n - l), columns = (size_t)(l + 1);
    const size_t rank = rows < columns ? rows : columns;
    const size_t half = (size_t)l * (size_t)order, full = (size_t)n * (size_t)order;
    struct scratch w;
    w.block = malloc((rows * columns + rank + rank * columns + 2 * half + full + (size_t)n) *
                     sizeof *w.block);
    if (w.block == NULL) {
        return ST_NO_MEMORY;
    }
    w.hankel = w.block;
    w.s = w.hankel + rows * columns;
    w.vt = w.s + rank;
    w.v1 = w.vt + rank * columns;
    w.v2 = w.v1 + half;
    w.basis = w.v2 + half;
    w.rhs = w.basis + full;
    *out = w;
    return ST_OK;
}

/* Singular vectors of the Hankel matrix; *order is how many matter. */
static enum status signal_space(int n, int l, const double *y, double threshold, int order_max,
                                struct scratch *w, int *order)
{
    const int rows = n - l, columns = l + 1, rank = rows < columns ? rows : columns;
    for (int j = 0; j < columns; j++) {
        memcpy(w->hankel + num_at(0, j, rows), y + j, (size_t)rows * sizeof *y);
    }
    const enum status st = la_svd_right(rows, columns, w->hankel, w->s, w->vt);
    if (st != ST_OK) {
        return st;
    }
    int kept = 0;
    while (kept < rank && kept < order_max && w->s[kept] > threshold * w->s[0]) {
        kept++;
    }
    *order = kept;
    for (int k = 0; k < kept; k++) {
        for (int i = 0; i < l; i++) {
            w->v1[num_at(i, k, l)] = w->vt[num_at(k, i, rank)];
            w->v2[num_at(i, k, l)] = w->vt[num_at(k, i + 1, rank)];
        }
    }
    return ST_OK;
}

/* A real root and one at the Nyquist frequency have no sine at the samples. */
static bool has_sine(const struct pencil_root *r, double dt)
{
    return r->omega > 0.0 && r->omega * dt < NUM_PI * (1.0 - 1e-9);
}

/* Amplitudes by least squares on e^{sigma t} (cos, sin) of each root; sets residual. */
static enum status fit_amplitudes(int n, const double *y, double dt, struct scratch *w,
                                  struct pencil_fit *fit)
{
    int column = 0;
    for (int k = 0; k < fit->n; k++) {
        const struct pencil_root *r = &fit->root[k];
        for (int i = 0; i < n; i++) {
            const double envelope = exp(r->sigma * dt * i);
            w->basis[num_at(i, column, n)] = envelope * cos(r->omega * dt * i);
            if (has_sine(r, dt)) {
                w->basis[num_at(i, column + 1, n)] = -envelope * sin(r->omega * dt * i);
            }
        }
        column += has_sine(r, dt) ? 2 : 1;
    }
    memcpy(w->rhs, y, (size_t)n * sizeof *y);
    const enum status st = la_least_squares(n, column, w->basis, 1, w->rhs);
    if (st != ST_OK) {
        return st;
    }
    /* dgels leaves the residual of the fit in the entries after the solution. */
    double left = 0.0, size = 0.0;
    for (int i = 0; i < n; i++) {
        left += i >= column ? num_sq(w->rhs[i]) : 0.0;
        size += num_sq(y[i]);
    }
    fit->residual = size > 0.0 ? sqrt(left / size) : 0.0;
    column = 0;
    for (int k = 0; k < fit->n; k++) {
        struct pencil_root *r = &fit->root[k];
        const double a = w->rhs[column], b = has_sine(r, dt) ? w->rhs[column + 1] : 0.0;
        r->amplitude = hypot(a, b);
        r->phase = atan2(b, a);
        column += has_sine(r, dt) ? 2 : 1;
    }
    return ST_OK;
}

static int by_amplitude(const void *a, const void *b)
{
    const double x = ((const struct pencil_root *)a)->amplitude;
    const double y = ((const struct pencil_root *)b)->amplitude;
    return (x < y) - (x > y);
}

enum status pencil_identify(int n, const double *y, double dt, double threshold, int order_max,
                            struct pencil_fit *out)
{
    assert(n >= 8);
    assert(dt > 0.0);
    assert(order_max >= 1);
    struct pencil_fit fit = {0};
    const int l = n / 2;
    const int limit = order_max < PENCIL_ORDER_MAX ? order_max : PENCIL_ORDER_MAX;
    const int wanted = limit < n / 4 ? limit : n / 4;
    struct scratch w;
    double z[PENCIL_ORDER_MAX * PENCIL_ORDER_MAX], re[PENCIL_ORDER_MAX], im[PENCIL_ORDER_MAX];
    enum status st = scratch_init(n, l, wanted, &w);
    if (st != ST_OK) {
        return st;
    }
    st = signal_space(n, l, y, threshold, wanted, &w, &fit.order);
    if (st != ST_OK || fit.order == 0) {
        goto out;
    }
    st = la_least_squares(l, fit.order, w.v1, fit.order, w.v2); /* v1 z = v2 */
    if (st != ST_OK) {
        goto out;
    }
    for (int j = 0; j < fit.order; j++) {
        memcpy(z + (ptrdiff_t)fit.order * j, w.v2 + num_at(0, j, l), (size_t)fit.order * sizeof *z);
    }
    st = la_eigenvalues(fit.order, z, re, im);
    if (st != ST_OK) {
        goto out;
    }
    for (int k = 0; k < fit.order; k++) {
        const double size = hypot(re[k], im[k]);
        /* One of each pair; a root at zero has died within a sample and cannot be told. */
        if (im[k] >= 0.0 && size > 1e-12) {
            fit.root[fit.n++] =
                (struct pencil_root){.sigma = log(size) / dt, .omega = atan2(im[k], re[k]) / dt};
        }
    }
    if (fit.n > 0) {
        st = fit_amplitudes(n, y, dt, &w, &fit);
    }
    qsort(fit.root, (size_t)fit.n, sizeof fit.root[0], by_amplitude);
out:
    free(w.block);
    if (st == ST_OK) {
        *out = fit;
    }
    return st;
}

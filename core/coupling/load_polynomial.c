#include "core/coupling/load_polynomial.h"

#include <assert.h>
#include <string.h>

/* Newton backward basis tau (tau+1) ... (tau+j-1) / j! as monomials: row j, power of tau. */
static const double basis[LOAD_COEFFICIENTS][LOAD_COEFFICIENTS] = {
    {1.0},
    {0.0, 1.0},
    {0.0, 1.0 / 2.0, 1.0 / 2.0},
    {0.0, 1.0 / 3.0, 1.0 / 2.0, 1.0 / 6.0},
    {0.0, 1.0 / 4.0, 11.0 / 24.0, 1.0 / 4.0, 1.0 / 24.0},
};

void load_polynomial_init(int n_mode, int order, struct load_polynomial *p)
{
    assert(n_mode >= 1);
    assert(n_mode <= LIMIT_MODES);
    assert(order >= 0);
    assert(order <= LIMIT_LOAD_ORDER);
    memset(p, 0, sizeof *p);
    p->n_mode = n_mode;
    p->order = order;
}

void load_polynomial_push(struct load_polynomial *p, const double *load)
{
    const size_t bytes = (size_t)p->n_mode * sizeof *load;
    for (int k = p->order; k > 0; k--) {
        memcpy(p->history[k], p->history[k - 1], bytes);
    }
    memcpy(p->history[0], load, bytes);
    p->n_known += p->n_known <= p->order;
    p->degree = p->n_known - 1;

    double difference[LOAD_COEFFICIENTS][LIMIT_MODES]; /* backward differences, in place */
    for (int k = 0; k < p->n_known; k++) {
        memcpy(difference[k], p->history[k], bytes);
    }
    for (int level = 1; level < p->n_known; level++) {
        for (int k = p->n_known - 1; k >= level; k--) {
            for (int j = 0; j < p->n_mode; j++) {
                difference[k][j] = difference[k - 1][j] - difference[k][j];
            }
        }
    }
    for (int k = 0; k <= p->degree; k++) {
        for (int j = 0; j < p->n_mode; j++) {
            double sum = 0.0;
            for (int d = k; d <= p->degree; d++) {
                sum += basis[d][k] * difference[d][j];
            }
            p->c[k][j] = sum;
        }
    }
}

double load_polynomial_at(const struct load_polynomial *p, int mode, double tau)
{
    double sum = p->c[p->degree][mode];
    for (int k = p->degree - 1; k >= 0; k--) {
        sum = sum * tau + p->c[k][mode];
    }
    return sum;
}

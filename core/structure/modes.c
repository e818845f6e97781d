#include "core/structure/modes.h"

#include "core/la.h"
#include "core/num.h"

#include <assert.h>
#include <stdlib.h>
#include <string.h>

/* Family of each node freedom in the kinetic energy: a slope belongs to its displacement. */
static const int family[BEAM_NODE_MOST] = {
    [D_W] = 3,      [D_U] = 1,       [D_DU] = 1,  [D_V] = 0,    [D_DV] = 0,    [D_THETA] = 2,
    [D_DTHETA] = 2, [D_SURPLUS] = 2, [D_LAG] = 1, [D_TURN] = 2, [D_CAMBER] = 0};

/* Kinetic energy of each family alone; coupling terms between families are left out and the rest
 * scaled to one, so that a share is never negative. */
static void kinetic_shares(const struct beam *b, const double *x, double share[MODE_SHARES])
{
    const int n = b->n_dof;
    double total = 0.0;
    memset(share, 0, MODE_SHARES * sizeof *share);
    for (int j = 0; j < n; j++) {
        const int f = family[beam_freedom_at(b, j)];
        for (int i = 0; i < n; i++) {
            if (family[beam_freedom_at(b, i)] == f) {
                share[f] += x[i] * b->m[num_at(i, j, n)] * x[j];
            }
        }
    }
    for (int f = 0; f < MODE_SHARES; f++) {
        total += share[f];
    }
    for (int f = 0; f < MODE_SHARES; f++) {
        share[f] /= total;
    }
}

struct beam_motion modes_tip(const struct beam *b, const struct modes *m, int mode)
{
    return beam_motion_at(b, m->shape + (size_t)mode * (size_t)m->n_dof, b->length);
}

static void fix_sign(const struct beam *b, double chord, const struct modes *m, int mode)
{
    const struct beam_motion tip = modes_tip(b, m, mode);
    const double part[3] = {tip.v, tip.u, tip.theta * chord};
    double largest = 0.0;
    for (int i = 0; i < 3; i++) {
        largest = fabs(part[i]) > fabs(largest) ? part[i] : largest;
    }
    double *x = m->shape + (size_t)mode * (size_t)m->n_dof;
    for (int i = 0; i < m->n_dof && largest < 0.0; i++) {
        x[i] = -x[i];
    }
}

/* Gives the internal freedoms of the elements their own inertia: lambda becomes the Rayleigh
 * quotient of the mode in which they stand at inner x + lambda r x. Their static place alone leaves
 * an error of second order in the length of the elements: the shear strain inside would not know
 * that the transverse inertia changes the shear force along the element. */
static void refine(const struct beam *b, double *lambda, double *x)
{
    double stiffness, mass;
    beam_inner_inertia(b, x, &stiffness, &mass);
    const double modal_mass = 1.0 + *lambda * (2.0 * stiffness + *lambda * mass);
    *lambda *= (1.0 + *lambda * stiffness) / modal_mass;
    for (int i = 0; i < b->n_dof; i++) {
        x[i] /= sqrt(modal_mass);
    }
}

static void swap(int n, double *a, double *b)
{
    for (int i = 0; i < n; i++) {
        const double kept = a[i];
        a[i] = b[i];
        b[i] = kept;
    }
}

/* Refined frequencies of close modes may change places. */
static void sort_modes(struct modes *m)
{
    const size_t n = (size_t)m->n_dof;
    for (int i = 1; i < m->n_mode; i++) {
        for (int j = i; j > 0 && m->omega[j] < m->omega[j - 1]; j--) {
            double *a = m->shape + (size_t)(j - 1) * n, *b = a + n;
            swap(1, m->omega + j - 1, m->omega + j);
            swap(m->n_dof, a, b);
        }
    }
}

enum status modes_solve(const struct beam *b, double chord, int n_mode, struct modes *out)
{
    assert(n_mode >= 1);
    assert(n_mode <= b->n_dof);
    const size_t n = (size_t)b->n_dof, size = n * n;
    struct modes m = {.n_mode = n_mode, .n_dof = b->n_dof};
    double *copy = malloc(2 * size * sizeof *copy);
    m.omega = malloc((n * (size_t)n_mode + (size_t)n_mode * (1 + MODE_SHARES)) * sizeof *m.omega);
    enum status st = ST_NO_MEMORY;
    if (copy == NULL || m.omega == NULL) {
        goto out;
    }
    m.share = m.omega + n_mode;
    m.shape = m.share + (size_t)n_mode * MODE_SHARES;
    memcpy(copy, b->k, size * sizeof *copy);
    memcpy(copy + size, b->m, size * sizeof *copy);
    st = la_smallest_modes(b->n_dof, copy, copy + size, n_mode, m.omega, m.shape);
    if (st != ST_OK) {
        goto out;
    }
    for (int j = 0; j < n_mode; j++) {
        refine(b, m.omega + j, m.shape + (size_t)j * n);
    }
    sort_modes(&m);
    for (int j = 0; j < n_mode; j++) {
        m.omega[j] = sqrt(m.omega[j]);
        kinetic_shares(b, m.shape + (size_t)j * n, m.share + (size_t)j * MODE_SHARES);
        fix_sign(b, chord, &m, j);
    }
    *out = m;
out:
    free(copy);
    if (st != ST_OK) {
        free(m.omega);
    }
    return st;
}

void modes_done(struct modes *m)
{
    free(m->omega);
    *m = (struct modes){0};
}

/* The mesh of core/structure/beam.h. */
#include "core/structure/beam.h"

#include <assert.h>
#include <math.h>
#include <stdlib.h>

static const double point[BEAM_GAUSS] = {-0.861136311594052575, -0.339981043584856265,
                                         0.339981043584856265, 0.861136311594052575};

static int ascending(const void *a, const void *b)
{
    const double x = *(const double *)a, y = *(const double *)b;
    return (x > y) - (x < y);
}

enum status beam_mesh_build(double length, int n_uniform, int n_extra, const double *extra,
                            struct beam_mesh *out)
{
    assert(length > 0.0);
    assert(n_uniform >= 1);
    double *z = malloc((size_t)(n_uniform + 1 + n_extra) * sizeof *z);
    if (z == NULL) {
        return ST_NO_MEMORY;
    }
    int n = 0;
    for (int i = 0; i <= n_uniform; i++) {
        z[n++] = length * i / n_uniform;
    }
    for (int i = 0; i < n_extra; i++) {
        const double cell = length / n_uniform;
        const double nearest = cell * floor(extra[i] / cell + 0.5);
        bool known = fabs(extra[i] - nearest) <= 1e-6 * length;
        for (int k = n_uniform + 1; k < n; k++) {
            known = known || fabs(extra[i] - z[k]) <= 1e-6 * length;
        }
        if (!known) {
            z[n++] = extra[i];
        }
    }
    qsort(z, (size_t)n, sizeof *z, ascending);
    *out = (struct beam_mesh){.n_element = n - 1, .z = z};
    return ST_OK;
}

void beam_mesh_done(struct beam_mesh *m)
{
    free(m->z);
    *m = (struct beam_mesh){0};
}

double beam_mesh_gauss(const struct beam_mesh *m, int e, int g)
{
    assert(e < m->n_element);
    assert(g < BEAM_GAUSS);
    return m->z[e] + 0.5 * (1.0 + point[g]) * (m->z[e + 1] - m->z[e]);
}

#include "core/structure/contour.h"

#include <assert.h>
#include <math.h>
#include <stdlib.h>

enum status contour_strip(double chord, int elements, struct contour *out)
{
    assert(chord > 0.0);
    assert(elements >= 1);
    struct contour_element *e = calloc((size_t)elements, sizeof *e);
    if (e == NULL) {
        return ST_NO_MEMORY;
    }
    for (int i = 0; i < elements; i++) {
        for (int k = 0; k < 3; k++) {
            e[i].node[k] = 2 * i + k;
        }
        e[i].x[0] = chord * (0.5 - (double)i / elements);
        e[i].x[1] = chord * (0.5 - (double)(i + 1) / elements);
    }
    *out = (struct contour){.n_node = 2 * elements + 1, .n_element = elements, .element = e};
    return ST_OK;
}

void contour_done(struct contour *c)
{
    free(c->element);
    *c = (struct contour){0};
}

struct contour_point contour_at(const struct contour_element *e, double xi)
{
    const double lx = e->x[1] - e->x[0], ly = e->y[1] - e->y[0];
    const double length = hypot(lx, ly);
    struct contour_point p = {
        .x = e->x[0] + 0.5 * (1.0 + xi) * lx,
        .y = e->y[0] + 0.5 * (1.0 + xi) * ly,
        .dx = lx / length,
        .dy = ly / length,
        .jacobian = 0.5 * length,
        .shape = {0.5 * xi * (xi - 1.0), 1.0 - xi * xi, 0.5 * xi * (xi + 1.0)},
        .slope = {(xi - 0.5) * 2.0 / length, -4.0 * xi / length, (xi + 0.5) * 2.0 / length},
    };
    p.r_n = p.x * p.dy - p.y * p.dx;
    p.r_t = p.x * p.dx + p.y * p.dy;
    return p;
}

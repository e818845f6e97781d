#include "core/structure/contour.h"

#include <math.h>
#include <stdlib.h>

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

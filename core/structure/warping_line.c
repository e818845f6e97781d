#include "core/structure/warping_line.h"

#include "core/structure/warping.h"

#include <math.h>
#include <stdlib.h>

/* Points of each wall: the nodes of its mesh, or fewer where there is no room for all. */
static int points_of_wall(int walls, int elements)
{
    const int room = WARPING_POINTS / walls, nodes = 2 * elements + 1;
    return room < nodes ? room : nodes;
}

static struct warping_point point_at(const struct contour *c, const struct warping *w, int wall,
                                     int elements, double t)
{
    const double place = t * elements;
    const int local = place < elements ? (int)place : elements - 1;
    const struct contour_element *el = &c->element[wall * elements + local];
    const struct contour_point p = contour_at(el, 2.0 * (place - local) - 1.0);
    return (struct warping_point){
        .wall = wall, .x = p.x, .y = p.y, .omega = warping_at(w, el, &p, S_THETA)};
}

enum status warping_line(const struct shape *shape, struct warping_point out[WARPING_POINTS],
                         int *n)
{
    struct contour contour = {0};
    struct warping classic = {0}, retained = {0};
    struct laminate *laminate = malloc(LIMIT_WALLS * sizeof *laminate);
    if (laminate == NULL) {
        return ST_NO_MEMORY;
    }
    enum status st = shape_build(shape, &contour, laminate);
    if (st == ST_OK) {
        st = warping_solve(&contour, laminate, &classic, &retained);
    }
    if (st == ST_OK) {
        const int elements = shape->contour_elements, walls = contour.n_element / elements;
        const int per_wall = points_of_wall(walls, elements);
        for (int i = 0; i < walls * per_wall; i++) {
            const double t = (double)(i % per_wall) / (per_wall - 1);
            out[i] = point_at(&contour, &classic, i / per_wall, elements, t);
        }
        *n = walls * per_wall;
    }
    warping_done(&classic);
    warping_done(&retained);
    contour_done(&contour);
    free(laminate);
    return st;
}

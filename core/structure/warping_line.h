/* core/structure/warping_line.h
 * The warping function of a section along its walls, for people and plots.
 * Plain values; thread-safe. */
#ifndef AEROM_CORE_STRUCTURE_WARPING_LINE_H
#define AEROM_CORE_STRUCTURE_WARPING_LINE_H

#include "core/structure/shape.h"

enum { WARPING_POINTS = 256 };

struct warping_point {
    int wall;     /* of the shape */
    double x, y;  /* on the middle line of the walls, the section turned [m] */
    double omega; /* axial displacement per unit twist rate, shear forces zero [m^2] */
};

/* Equidistant points of each wall, its ends included, wall after wall; *n are filled. */
MUST_CHECK enum status warping_line(const struct shape *shape,
                                    struct warping_point out[WARPING_POINTS], int *n);

#endif

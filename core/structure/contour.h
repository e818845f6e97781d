/* core/structure/contour.h
 * The middle line of the walls of a section as a mesh of straight quadratic elements along s.
 *
 * Any graph of walls is allowed: open, closed, branching. Nodes shared by walls are shared numbers.
 * The struct owns its two arrays; contour_done frees them and accepts a zeroed struct. */
#ifndef AEROM_CORE_STRUCTURE_CONTOUR_H
#define AEROM_CORE_STRUCTURE_CONTOUR_H

#include "core/structure/laminate.h"

#include <stdbool.h>

struct contour_element {
    int node[3];  /* first end, middle, second end: warping freedoms */
    double x[2];  /* chordwise position of the ends, towards the leading edge [m] */
    double y[2];  /* vertical position of the ends [m] */
    int laminate; /* index into the caller's laminates */
};

/* May the normal of a wall turn against the wall (transverse shear gamma_nz of its ply stack)?
 * Rigid: Kirchhoff, gamma_nz = 0 in torsion (default). Flexible: Reissner-Mindlin, what a soft core
 * asks for; it frees the edges of an open wall over a length of their thickness. */
enum wall_shear { WALL_SHEAR_RIGID, WALL_SHEAR_FLEXIBLE };

/* The one straight wall of a section that bends across with an amplitude of its own: the curvature
 * kappa_ss in the mean over the wall (core/structure/camber.h). */
struct camber_line {
    bool on;          /* else the rest is not used */
    double x, y;      /* middle of the wall [m] */
    double dx, dy;    /* along the wall */
    double width;     /* [m] */
    double axis;      /* n that keeps its length across when the wall bends across [m] */
    double stiffness; /* couple L_ss per kappa_ss, N_ss = 0, times the width [N m^2] */
    double shear;     /* force N_sn per gamma_sn, times the width [N] */
};

struct contour {
    int n_node;
    enum wall_shear shear;
    int n_element;
    struct contour_element *element; /* (n_element) */
    struct camber_line camber;
};

void contour_done(struct contour *c);

/* Geometry of the wall at a point of an element, xi in [-1, 1]. */
struct contour_point {
    double x, y;     /* [m] */
    double dx, dy;   /* dx/ds, dy/ds */
    double r_n;      /* x dy/ds - y dx/ds: normal distance of the origin, as in (A.4) [m] */
    double r_t;      /* x dx/ds + y dy/ds: tangential distance, sign of DEVIATION (A.3) [m] */
    double jacobian; /* ds/dxi [m] */
    double shape[3]; /* quadratic shape functions */
    double slope[3]; /* their derivatives to s [1/m] */
};

struct contour_point contour_at(const struct contour_element *e, double xi);

#endif

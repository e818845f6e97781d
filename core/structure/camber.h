/* core/structure/camber.h
 * Bending of a flat section across the span as a motion of the beam: the wall moves by
 *
 *   w(s, z) = -kappa(z) (s^2 - b^2/12)/2 along n,   u_s(s, n, z) = kappa(z) s (n - n0) along s,
 *
 * s from the middle of the wall, n0 the height that keeps its length across. kappa is the mean of
 * the curvature kappa_ss over the wall; what varies over the wall stays free, as CHORDWISE_FREE has
 * it. So the energy of a section is that of the free wall and D (kappa - natural . strains)^2/2,
 * where `natural` is the mean curvature that a free wall takes by itself, and what the rate kappa'
 * brings: it twists the wall and shears it. A clamp holds kappa; far from it kappa is the natural
 * one.
 *
 * The same clamp holds tau, by which the normals turn across against the section (flexible walls
 * and retained shears: u_s = tau (n - n0), gamma_sn = tau), and lambda, the amplitude of the
 * warping that bending in the plane of the wall asks for (warping.lag). Plain functions; nothing is
 * owned. */
#ifndef AEROM_CORE_STRUCTURE_CAMBER_H
#define AEROM_CORE_STRUCTURE_CAMBER_H

#include "core/structure/warping.h"

/* The line of a straight wall from (x0, y0) to (x1, y1). */
struct camber_line camber_line_of(const struct laminate *lam, double x0, double y0, double x1,
                                  double y1);

/* Wall strains of unit kappa' before the warping it brings: gamma_sz = s (n - n0) of u_s, and s n
 * of the normals, which follow the wall. */
void camber_rate_strain(const struct camber_line *line, const struct contour_point *p,
                        double e[WALL_STRAINS]);

/* The same of unit tau'. */
void camber_turn_rate_strain(const struct camber_line *line, double e[WALL_STRAINS]);

/* Displacement along x, y of a point at n per unit kappa (bend) and tau: the first plus n times the
 * second of each. */
struct camber_motion {
    double bend[2], bend_slope[2], turn[2], turn_slope[2];
};
void camber_motion(const struct camber_line *line, const struct contour_point *p,
                   struct camber_motion *out);

/* Mean curvature of the free wall per unit of the first n_strain strains of struct warping. */
void camber_natural(const struct contour *c, const struct laminate *lam, const struct warping *w,
                    int n_strain, double natural[SECTION_WIDE_COUNT]);

#endif

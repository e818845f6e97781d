/* core/structure/static.h
 * Linear static deflection of the beam and the stresses of its plies. */
#ifndef AEROM_CORE_STRUCTURE_STATIC_H
#define AEROM_CORE_STRUCTURE_STATIC_H

#include "core/structure/beam.h"
#include "core/structure/shape.h"

/* Solves k x = f; x (n_dof), f is kept. */
MUST_CHECK enum status static_solve(const struct beam *b, const double *f, double *x);

/* The most strained point of one ply of one wall. */
struct ply_state {
    int layup, ply; /* of the shape */
    int wall;       /* of the shape */
    double x, y;    /* place on the wall's line, in the frame of the beam [m] */
    double n;       /* across the wall [m] */
    struct ply_stress stress;
    double strain_l, strain_t, strain_lt; /* in the ply's axes; shear as an angle */
    /* Tsai-Wu: 1 is failure. The load may grow by `reserve` until first-ply failure in this point.
     * Both are NaN where the material has no strengths. */
    double index, reserve;
};

/* Ply states at section strains (those of beam_strain_at): for each layup and ply the point of
 * the largest index, or, without strengths, of the largest strain energy. `out` holds
 * LIMIT_LAYUPS * LIMIT_PLIES states, *n are filled. */
MUST_CHECK enum status static_ply_states(const struct shape *shape, enum shear_model shear,
                                         const double strain[SECTION_WIDE_COUNT],
                                         struct ply_state *out, int *n);

/* Tsai-Wu index of a stress, with F12 = -sqrt(F11 F22)/2, and the factor on the stress that makes
 * it one. False when the material has no strengths. */
bool static_tsai_wu(const struct material *m, const struct ply_stress *s, double *index,
                    double *reserve);

#endif

/* core/aero/lifting_line.h
 * Prandtl's lifting line over uniform elements with horseshoe vortices at the element borders
 * (model section 4): c_l(i) = C_l(alpha_i - induced_i), induced = B c_l.
 *
 * A struct lifting_line is immutable; a struct lifting_line_state is one thread's scratch and warm
 * start. Solving allocates nothing. */
#ifndef AEROM_CORE_AERO_LIFTING_LINE_H
#define AEROM_CORE_AERO_LIFTING_LINE_H

#include "core/aero/polar.h"
#include "core/simd.h"

/* Which walls act as mirrors: none (a free wing tip at the root), the clamped root, or the root and
 * the far side wall of a channel. */
enum wall_images { WALLS_NONE, WALLS_ROOT, WALLS_ROOT_AND_FAR };

struct lifting_line {
    int n;            /* stations = elements */
    double tolerance; /* largest |residual| in c_l */
    int iterations_max;
    int rows;        /* n padded to whole lanes */
    double *induced; /* B: induced angle w_i/V [rad] per unit c_l (rows x n), column-major */
    simd_gemv_fn multiply;
};

/* length [m]; chord [m] of each element (n); width [m] is the distance of the far wall from the
 * root, > length, only used with WALLS_ROOT_AND_FAR. */
MUST_CHECK enum status lifting_line_init(int n, double length, const double *chord,
                                         enum wall_images walls, double width, double tolerance,
                                         int iterations_max, struct lifting_line *out);
void lifting_line_done(struct lifting_line *ll);

struct lifting_line_state {
    int n;
    int known;                                /* earlier solutions at hand for the start, 0..3 */
    bool factored;                            /* inverse is that of an earlier Jacobian */
    double *block;                            /* owned: one allocation, holds the arrays below */
    double *cl;                               /* solution, steady c_l at the effective angle (n) */
    double *alpha;                            /* effective angle of attack [rad]             (n) */
    double *induced;                          /* induced angle w_i/V [rad]                   (n) */
    double *previous, *older;                 /* solutions one and two calls earlier     (n each) */
    double *trial, *table, *slope, *residual; /* scratch                 (n each) */
    double *step;                             /* Newton step                         (rows) */
    double *inverse;                          /* inverse Jacobian, rows padded as B  (rows x n) */
    double *dense, *work;                     /* inversion                           (n x n each) */
    int *pivot;                               /* (n) */
};

/* The vectors above are padded to whole lanes. */
MUST_CHECK enum status lifting_line_state_init(int n, struct lifting_line_state *out);
void lifting_line_state_done(struct lifting_line_state *s);

struct lifting_line_report {
    bool converged;
    int iterations;
    double residual; /* largest |c_l - C_l(alpha)| */
};

/* Solves for geometric angles [rad] (n) and plunge v/c (n); results are in s->cl, s->alpha,
 * s->induced. Without convergence they hold the iterate of the smallest residual. */
struct lifting_line_report lifting_line_solve(const struct lifting_line *ll, const struct polar *p,
                                              const double *alpha_geometric, const double *plunge,
                                              struct lifting_line_state *s);

#endif

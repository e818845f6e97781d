/* core/aero/lifting_line.h
 * Prandtl's lifting line over uniform elements with horseshoe vortices at the element borders
 * (model section 4): c_l(i) = C_l(alpha_i) + eps (B~ alpha)_i, alpha = alpha_g - B c_l.
 *
 * Where the lift falls with the angle the equation without eps has many solutions, which zigzag
 * from element to element. B acts on a wave of wave number k like c k/8, so B~ (B with the sum of
 * each row taken off its diagonal) smooths the angle along the span like an artificial viscosity;
 * with 4 eps > m^2, m the steepest fall of the polar, 1 - m B + eps B B~ is positive for every
 * wave, and the solution is one, whatever the mesh. Where all slopes are positive, eps is exactly
 * zero.
 *
 * A struct lifting_line is immutable; a struct lifting_line_state is one thread's scratch and warm
 * start. Solving allocates nothing. */
#ifndef AEROM_CORE_AERO_LIFTING_LINE_H
#define AEROM_CORE_AERO_LIFTING_LINE_H

#include "core/aero/downwash.h"
#include "core/aero/polar.h"
#include "core/simd.h"

struct lifting_line;
struct lifting_line_state;
/* Residual of the equation without eps at s->cl: fills induced, alpha, table, slope and residual
 * from the pieces of the polar, and the largest residual. False when an angle has left its piece.
 */
typedef bool (*lifting_line_kernel_fn)(const struct lifting_line *ll, struct lifting_line_state *s,
                                       double *largest);

struct lifting_line {
    int n;              /* stations = elements */
    double tolerance;   /* largest |residual| in c_l */
    int iterations_max; /* of one solution */
    int rows;           /* n padded to whole lanes */
    double *block;      /* owned: one allocation, holds the arrays below */
    double *induced;    /* B: induced angle w_i/V [rad] per unit c_l (rows x n), column-major */
    double *smooth;     /* B~ B                                      (rows x n) */
    double *row_sum;    /* of B                                          (rows) */
    simd_gemv_fn multiply;
    lifting_line_kernel_fn evaluate;
};

MUST_CHECK enum status lifting_line_init(const struct wing *wing, double tolerance,
                                         int iterations_max, struct lifting_line *out);
void lifting_line_done(struct lifting_line *ll);

struct lifting_line_state {
    int n;
    int known;                                /* earlier solutions at hand for the start, 0..3 */
    bool factored;                            /* inverse is that of an earlier Jacobian */
    double epsilon;                           /* viscosity of the solution, 0: none */
    double *block;                            /* owned: one allocation, holds the arrays below */
    double *cl;                               /* circulation as c_l = 2 Gamma/(V c)          (n) */
    double *alpha;                            /* effective angle of attack [rad]             (n) */
    double *induced;                          /* induced angle w_i/V [rad]                   (n) */
    double *rough;                            /* B~ alpha, only with epsilon > 0             (n) */
    double *previous, *older;                 /* solutions one and two calls earlier     (n each) */
    double *trial, *table, *slope, *residual; /* scratch                 (n each) */
    double *alpha_g;                          /* geometric angle [rad]                       (n) */
    double *piece_from, *piece_to, *origin;   /* struct polar_piece of each station      (n each) */
    double *lift[4];                          /* its coefficients                        (n each) */
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
    double residual;  /* largest |c_l - C_l(alpha) - eps (B~ alpha)| */
    double smoothing; /* largest |eps (B~ alpha)|: what the viscosity adds to a c_l */
};

/* Solves for geometric angles [rad] (n) and plunge v/c (n); results are in s->cl, s->alpha,
 * s->induced. Without convergence they hold the iterate of the smallest residual. */
struct lifting_line_report lifting_line_solve(const struct lifting_line *ll, const struct polar *p,
                                              const double *alpha_geometric, const double *plunge,
                                              struct lifting_line_state *s);

/* Viscosity that the slopes of a solution ask for: full where one of them falls by more than a
 * tenth of the steepest fall of the polar, in proportion below that, zero where none falls. What
 * the solver uses is at least that. */
double lifting_line_viscosity(const struct polar *p, int n, const double *slope);

#endif

/* core/aero/oscillator.h
 * One time step of a damped oscillator driven to its input, x'' + 2 zeta w x' + w^2 (x - u) = 0,
 * whose input runs linearly from its old to its new value: exact. Its state is x and y = x'/w, both
 * in the unit of u. The factors of n stations stand one kind after the other, stations fastest, for
 * each oscillator. Stateless.
 *
 * On a ramp u = a + b t it follows at x = u - 2 zeta b/w, y = b/w; what is left of the difference
 * swings out as exp(-zeta w t) times a turn of the plane (x, y). */
#ifndef AEROM_CORE_AERO_OSCILLATOR_H
#define AEROM_CORE_AERO_OSCILLATOR_H

#include "core/num.h"

#include <math.h>

/* Of x from x, of x from y and (negative) of y from x, of y from y; 1/(w dt), 2 zeta/(w dt). */
enum {
    OSCILLATOR_XX,
    OSCILLATOR_XY,
    OSCILLATOR_YY,
    OSCILLATOR_RATE,
    OSCILLATOR_LAG,
    OSCILLATOR_FACTORS
};

/* The factors of an oscillator (n x OSCILLATOR_FACTORS) among those of several. */
static inline double *oscillator_factors(double *step, int n, int oscillator)
{
    return step + (ptrdiff_t)n * (oscillator * OSCILLATOR_FACTORS);
}

/* Fills the factors of station i for z = w dt > 0 and a damping ratio in (0, 1). */
static inline void oscillator_fill(double *factor, int n, int i, double z, double damping)
{
    const double root = sqrt(1.0 - damping * damping);
    const double decay = exp(-damping * z);
    const double in = decay * cos(root * z), across = decay * sin(root * z) / root;
    factor[num_at(i, OSCILLATOR_XX, n)] = in + damping * across;
    factor[num_at(i, OSCILLATOR_XY, n)] = across;
    factor[num_at(i, OSCILLATOR_YY, n)] = in - damping * across;
    factor[num_at(i, OSCILLATOR_RATE, n)] = 1.0 / z;
    factor[num_at(i, OSCILLATOR_LAG, n)] = 2.0 * damping / z;
}

/* Takes x and y of station i over a step in which the input goes from `old` to `new`. */
static inline void oscillator_next(const double *factor, int n, int i, double old, double new,
                                   double *x, double *y)
{
    const double rate = factor[num_at(i, OSCILLATOR_RATE, n)] * (new - old);
    const double lag = factor[num_at(i, OSCILLATOR_LAG, n)] * (new - old);
    const double off_x = *x - (old - lag), off_y = *y - rate;
    const double across = factor[num_at(i, OSCILLATOR_XY, n)];
    *x = new - lag + factor[num_at(i, OSCILLATOR_XX, n)] * off_x + across *off_y;
    *y = rate - across * off_x + factor[num_at(i, OSCILLATOR_YY, n)] * off_y;
}

#endif

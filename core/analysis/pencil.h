/* core/analysis/pencil.h
 * Matrix pencil: the complex exponentials in an equally spaced signal.
 *
 * y(t) = sum of c_k e^{lambda_k t}. Hankel matrix with pencil parameter N/2, order from the
 * singular values, eigenvalues of the shifted pencil, amplitudes by least squares (validation page,
 * section 6; Jacobson et al. 2019). */
#ifndef AEROM_CORE_ANALYSIS_PENCIL_H
#define AEROM_CORE_ANALYSIS_PENCIL_H

#include "core/status.h"

enum { PENCIL_ORDER_MAX = 40 };

/* One real root (omega = 0) or one conjugate pair (omega > 0). */
struct pencil_root {
    double sigma;     /* real part [1/s], growth */
    double omega;     /* imaginary part [rad/s], >= 0 */
    double amplitude; /* at the first sample, unit of the signal */
    double phase;     /* at the first sample: amplitude e^{sigma t} cos(omega t + phase) [rad] */
};

struct pencil_fit {
    int n; /* roots, by falling amplitude */
    struct pencil_root root[PENCIL_ORDER_MAX];
    int order;       /* exponentials used: pairs count twice */
    double residual; /* rms of signal - fit over rms of the signal */
};

/* n samples at distance dt [s], n >= 8. Singular values below threshold times the largest are
 * dropped; at most order_max exponentials are kept. A signal that is zero gives no roots. */
MUST_CHECK enum status pencil_identify(int n, const double *y, double dt, double threshold,
                                       int order_max, struct pencil_fit *out);

#endif

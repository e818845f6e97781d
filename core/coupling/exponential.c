#include "core/coupling/exponential.h"

#include "core/num.h"

#include <assert.h>
#include <complex.h>
#include <math.h>

/* phi_k(z) = int_0^1 e^{z (1 - s)} s^{k-1}/(k-1)! ds, k = 1..count. The series serves small z,
 * where the recurrence phi_{k+1} = (phi_k - 1/k!)/z loses all digits; beyond |z| = 1 it is the
 * other way round. */
static void phi_functions(double complex z, int count, double complex *phi)
{
    if (cabs(z) > 1.0) {
        double factorial = 1.0;
        double complex value = cexp(z);
        for (int k = 1; k <= count; k++) {
            value = (value - 1.0 / factorial) / z;
            phi[k - 1] = value;
            factorial *= k;
        }
        return;
    }
    double factorial = 1.0;
    for (int k = 1; k <= count; k++) {
        factorial *= k;
        double complex term = 1.0 / factorial, sum = term;
        for (int j = 1; j < 25; j++) {
            term *= z / (k + j);
            sum += term;
        }
        phi[k - 1] = sum;
    }
}

void exponential_init(int n_mode, const double *omega2, const double *damping, double dt,
                      struct exponential *out)
{
    assert(n_mode <= LIMIT_MODES);
    out->n_mode = n_mode;
    for (int j = 0; j < n_mode; j++) {
        const double sigma = -0.5 * damping[j];
        const double omega_d =
            sqrt(omega2[j] - sigma * sigma); /* zeta < 1 is checked in the case */
        assert(omega_d > 0.0);
        const double complex lambda = NUM_COMPLEX(sigma, omega_d);
        const double complex e = cexp(lambda * dt);
        const double c = creal(e), s = cimag(e) / omega_d; /* s: unit impulse response at dt */
        out->p[0][j] = c - sigma * s;
        out->p[1][j] = s;
        out->p[2][j] = -omega2[j] * s;
        out->p[3][j] = c + sigma * s;
        /* q(dt) = int h(dt - t) tau^k dt with h(t) = Im e^{lambda t}/omega_d. */
        double complex phi[LOAD_COEFFICIENTS];
        phi_functions(lambda * dt, LOAD_COEFFICIENTS, phi);
        double factorial = 1.0;
        for (int k = 0; k < LOAD_COEFFICIENTS; k++) {
            factorial *= k > 0 ? k : 1;
            const double complex moment = dt * factorial * phi[k];
            out->w[k][0][j] = cimag(moment) / omega_d;
            out->w[k][1][j] = cimag(lambda * moment) / omega_d;
        }
    }
}

void exponential_step(const struct exponential *e, const struct load_polynomial *load, double *q,
                      double *qd)
{
    for (int j = 0; j < e->n_mode; j++) {
        double a = e->p[0][j] * q[j] + e->p[1][j] * qd[j];
        double b = e->p[2][j] * q[j] + e->p[3][j] * qd[j];
        for (int k = 0; k <= load->degree; k++) {
            a += e->w[k][0][j] * load->c[k][j];
            b += e->w[k][1][j] * load->c[k][j];
        }
        q[j] = a;
        qd[j] = b;
    }
}

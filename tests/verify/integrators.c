/* Integrators of the modal equations: order, exactness, energy, load extrapolation. */
#include "core/coupling/exponential.h"
#include "core/coupling/rk4.h"
#include "core/num.h"
#include "tests/verify/check.h"

#include <math.h>
#include <stdlib.h>

/* A polynomial in tau = t/dt as the load of one mode. */
static struct load_polynomial polynomial(int degree, const double *c)
{
    struct load_polynomial p;
    load_polynomial_init(1, LIMIT_LOAD_ORDER, &p);
    p.degree = degree;
    for (int k = 0; k <= degree; k++) {
        p.c[k][0] = c[k];
    }
    return p;
}

/* Error of an undamped mode after one second of steps of h, in the energy norm. */
static double oscillation_error(double h)
{
    const double omega2 = 1.0, damping = 0.0;
    const struct rk4 rk = {.n_mode = 1, .omega2 = &omega2, .damping = &damping, .dt = h};
    const struct load_polynomial none = polynomial(0, (double[]){0.0});
    double x[2] = {1.0, 0.0};
    const int steps = (int)(1.0 / h + 0.5);
    for (int i = 0; i < steps; i++) {
        rk4_step(&rk, &none, 0.0, 1.0, x);
    }
    return hypot(x[0] - cos(1.0), x[1] + sin(1.0));
}

static void order(struct check_list *list)
{
    static const double expected[3] = {8.33e-7, 5.21e-8, 3.26e-9};
    const double error[3] = {oscillation_error(0.1), oscillation_error(0.05),
                             oscillation_error(0.025)};
    for (int i = 0; i < 3; i++) {
        check_add(list, CHECK_RELATIVE, "", error[i], expected[i], 0.01, "[C], validation data 0.1",
                  "Runge-Kutta, undamped mode to t = 1: error, h = %g", 0.1 / (1 << i));
    }
    for (int i = 0; i < 2; i++) {
        check_add(list, CHECK_ABSOLUTE, "", log2(error[i] / error[i + 1]), 4.0, 0.1,
                  "property: order 4", "Runge-Kutta, undamped mode: observed order, h = %g to %g",
                  0.1 / (1 << i), 0.05 / (1 << i));
    }
}

/* Particular solution of q'' + d q' + w2 q = sum c_k (t/h)^k as a polynomial in tau, by matching
 * powers downwards, and then the exact state at tau = 1 from (q0, v0). */
struct mode {
    double omega, zeta, h;
};

static void exact_state(const struct mode *m, int degree, const double *c, double q0, double v0,
                        double out[2])
{
    const double w2 = m->omega * m->omega, d = 2.0 * m->zeta * m->omega, h = m->h;
    double a[LOAD_COEFFICIENTS + 2] = {0};
    for (int k = degree; k >= 0; k--) {
        a[k] = (c[k] - d * (k + 1) * a[k + 1] / h - (k + 2) * (k + 1) * a[k + 2] / (h * h)) / w2;
    }
    double p1 = 0.0, dp1 = 0.0;
    for (int k = 0; k <= degree; k++) {
        p1 += a[k];
        dp1 += k * a[k] / h;
    }
    const double wd = m->omega * sqrt(1.0 - m->zeta * m->zeta), s = m->zeta * m->omega;
    const double b = q0 - a[0], e = (v0 - a[1] / h + s * b) / wd;
    const double decay = exp(-s * h), co = cos(wd * h), si = sin(wd * h);
    out[0] = decay * (b * co + e * si) + p1;
    out[1] = decay * ((-s * b + wd * e) * co - (s * e + wd * b) * si) + dp1;
}

static double energy_distance(double omega, const double a[2], const double b[2])
{
    return hypot(omega * (a[0] - b[0]), a[1] - b[1]) / hypot(omega * b[0], b[1]);
}

static double exponential_error(const struct mode *m, int degree, const double *c)
{
    const double w2 = m->omega * m->omega, d = 2.0 * m->zeta * m->omega;
    const struct load_polynomial load = polynomial(degree, c);
    struct exponential e;
    double exact[2], state[2] = {0.3, -0.2};
    exact_state(m, degree, c, state[0], state[1], exact);
    exponential_init(1, &w2, &d, m->h, &e);
    exponential_step(&e, &load, &state[0], &state[1]);
    return energy_distance(m->omega, state, exact);
}

/* Against the closed form where that is well conditioned (omega h of order one), against many
 * Runge-Kutta steps where the matching of powers loses digits (omega h = 1e-3). */
static void exactness(struct check_list *list)
{
    static const double c[LOAD_COEFFICIENTS] = {0.7, -1.3, 0.4, 2.1, -0.9};
    static const double product[] = {0.6, 1.1, 3.0, 40.0};
    for (size_t i = 0; i < sizeof product / sizeof product[0]; i++) {
        const struct mode m = {.omega = product[i] / 0.25, .zeta = 0.05, .h = 0.25};
        double largest = 0.0;
        for (int degree = 0; degree < LOAD_COEFFICIENTS; degree++) {
            largest = fmax(largest, exponential_error(&m, degree, c));
        }
        check_add(list, CHECK_AT_MOST, "", largest, 0.0, 5e-13, "closed form",
                  "exponential step, loads of degree 0 to 4, omega dt = %g: error", product[i]);
    }
    const double omega = 4.0, w2 = omega * omega, zero = 0.02, h = 1e-3 / omega;
    const struct rk4 rk = {.n_mode = 1, .omega2 = &w2, .damping = &zero, .dt = h};
    double largest = 0.0;
    for (int degree = 0; degree < LOAD_COEFFICIENTS; degree++) {
        const struct load_polynomial load = polynomial(degree, c);
        struct exponential e;
        double x[2] = {0.3, -0.2}, y[2] = {0.3, -0.2};
        for (int k = 0; k < 512; k++) {
            rk4_step(&rk, &load, k / 512.0, 1.0 / 512.0, x);
        }
        exponential_init(1, &w2, &zero, h, &e);
        exponential_step(&e, &load, &y[0], &y[1]);
        largest = fmax(largest, energy_distance(omega, y, x));
    }
    check_add(list, CHECK_AT_MOST, "", largest, 0.0, 1e-14, "512 Runge-Kutta steps",
              "exponential step, loads of degree 0 to 4, omega dt = 0.001: error");
}

/* One coarse Runge-Kutta solution against the exact one, with a load: the order holds for it too.
 */
static void forced_order(struct check_list *list)
{
    static const double c[LOAD_COEFFICIENTS] = {0.7, -1.3, 0.4, 2.1, -0.9};
    const struct mode m = {.omega = 4.0, .zeta = 0.05, .h = 0.25};
    const double w2 = m.omega * m.omega, d = 2.0 * m.zeta * m.omega;
    const struct rk4 rk = {.n_mode = 1, .omega2 = &w2, .damping = &d, .dt = m.h};
    const struct load_polynomial load = polynomial(LIMIT_LOAD_ORDER, c);
    double exact[2], error[2];
    exact_state(&m, LIMIT_LOAD_ORDER, c, 0.3, -0.2, exact);
    for (int i = 0; i < 2; i++) {
        const int steps = 16 << i;
        double x[2] = {0.3, -0.2};
        for (int k = 0; k < steps; k++) {
            rk4_step(&rk, &load, (double)k / steps, 1.0 / steps, x);
        }
        error[i] = energy_distance(m.omega, x, exact);
    }
    check_add(list, CHECK_ABSOLUTE, "", log2(error[0] / error[1]), 4.0, 0.1, "property: order 4",
              "Runge-Kutta, damped mode under a load of degree 4: observed order");
}

/* Energy of an undamped mode after a thousand periods, relative change. */
static void long_run(struct check_list *list)
{
    enum { PERIODS = 1000, PER_PERIOD = 37 };
    const double omega = 26.0, w2 = omega * omega, none = 0.0;
    const double h = 2.0 * NUM_PI / omega / PER_PERIOD, tolerance = 1e-12;
    const struct load_polynomial load = polynomial(0, (double[]){0.0});
    struct exponential e;
    struct rk4 rk = {.n_mode = 1, .omega2 = &w2, .damping = &none, .dt = h, .tolerance = tolerance};
    double q = 1.0, v = 0.0, x = 1.0, y = 0.0;
    enum status st = ST_OK;
    exponential_init(1, &w2, &none, h, &e);
    for (int i = 0; i < PERIODS * PER_PERIOD && st == ST_OK; i++) {
        exponential_step(&e, &load, &q, &v);
        st = rk4_advance(&rk, &load, &x, &y);
    }
    const double energy = (w2 * q * q + v * v) / w2 - 1.0;
    const double energy_rk = st == ST_OK ? (w2 * x * x + y * y) / w2 - 1.0 : (double)NAN;
    check_add(list, CHECK_AT_MOST, "", fabs(energy), 0.0, 1e-9, "property",
              "exponential, undamped mode, 1000 periods: relative change of energy");
    /* The tolerance is an error per step; at worst all steps err the same way. */
    check_add(list, CHECK_AT_MOST, "", fabs(energy_rk), 0.0, 2.0 * tolerance * PERIODS * PER_PERIOD,
              "steps times tolerance 1e-12",
              "adaptive Runge-Kutta, undamped mode, 1000 periods: relative change of energy");
}

/* Extrapolation of a history t^p to tau = 1, and of alternating noise. */
static void extrapolation(struct check_list *list)
{
    static const double gain[LOAD_COEFFICIENTS] = {1.0, 3.0, 7.0, 15.0, 31.0};
    for (int wanted = 0; wanted <= LIMIT_LOAD_ORDER; wanted++) {
        struct load_polynomial p, noise;
        load_polynomial_init(1, wanted, &p);
        load_polynomial_init(1, wanted, &noise);
        for (int i = 0; i <= LIMIT_LOAD_ORDER + 2; i++) {
            const double value = pow(0.5 + 0.25 * i, wanted), sign = i % 2 == 0 ? 1.0 : -1.0;
            load_polynomial_push(&p, &value);
            load_polynomial_push(&noise, &sign);
        }
        double largest = 0.0;
        for (int k = 0; k <= 4; k++) {
            const double t = 0.5 + 0.25 * (LIMIT_LOAD_ORDER + 2 + 0.25 * k);
            largest = fmax(largest, fabs(load_polynomial_at(&p, 0, 0.25 * k) / pow(t, wanted) - 1));
        }
        check_add(list, CHECK_AT_MOST, "", largest, 0.0, 1e-13, "property",
                  "load extrapolation of order %d: error on t^%d", wanted, wanted);
        check_add(list, CHECK_RELATIVE, "", fabs(load_polynomial_at(&noise, 0, 1.0)), gain[wanted],
                  1e-12, "closed form, 2^(order+1) - 1",
                  "load extrapolation of order %d: gain on alternating noise", wanted);
    }
}

static void fill(struct check_list *list)
{
    order(list);
    forced_order(list);
    exactness(list);
    long_run(list);
    extrapolation(list);
}

const struct check_group group_integrators = {
    .name = "integrators",
    .title = "Integrators and load extrapolation",
    .text = "Errors are relative, in the energy norm. The classical scheme uses f3 in its fourth "
            "stage; as printed in the paper it would be of third order. Orders of the load "
            "extrapolation are exact for polynomials of their degree and amplify alternating noise "
            "by 2^(order+1) - 1: the default is 1.",
    .fill = fill,
};

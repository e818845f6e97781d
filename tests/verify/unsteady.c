/* Attached unsteady flow against Theodorsen: the wake's function, and pitch and plunge about
 * mid-chord driven through the evaluation of loads of the time march. */
#include "core/coupling/loads.h"
#include "core/num.h"
#include "tests/support/driven_section.h"
#include "tests/support/fixture.h"
#include "tests/verify/check.h"

#include <complex.h>
#include <math.h>
#include <stdlib.h>

/* C(k) from Bessel functions: H1/(H1 + i H0), Hankel functions of the second kind. */
static double complex theodorsen(double k)
{
    const double complex h0 = NUM_COMPLEX(j0(k), -y0(k)), h1 = NUM_COMPLEX(j1(k), -y1(k));
    return h1 / (h1 + NUM_COMPLEX(0.0, 1.0) * h0);
}

static double complex lagged(double k)
{
    double complex sum = 0.5;
    for (int i = 0; i < ATTACHED_LAGS; i++) {
        sum += attached_share(i) * attached_rate(i) / NUM_COMPLEX(attached_rate(i), k);
    }
    return sum;
}

static void wake_function(struct check_list *list)
{
    enum { SAMPLES = 400 };
    double worst = 0.0;
    for (int i = 0; i < SAMPLES; i++) {
        const double k = pow(10.0, -3.0 + 5.0 * i / (SAMPLES - 1));
        worst = fmax(worst, cabs(lagged(k) / theodorsen(k) - 1.0));
    }
    check_add(list, CHECK_AT_MOST, "", worst, 0.0, 0.0016, "closed form: Bessel functions",
              "|C(k) of the lag states / Theodorsen - 1|, largest for k = 0.001 to 100");
    check_add(list, CHECK_RELATIVE, "", creal(lagged(0.0)), 1.0, 1e-15, "property",
              "C(0): steady flow is the polar's");
}

struct response {
    double complex cl, cm;
};

/* Complex amplitudes of c_l and c_m per unit of a freedom (0: plunge v of mid-chord, 1: pitch) that
 * moves as cos(omega t), once the start has died away. Chord 2, speed 1, so omega = k. */
static struct response driven(int freedom, double k)
{
    enum { PER_CYCLE = 400, SETTLE = 40 };
    const double size = 0.01, dt = 2.0 * NUM_PI / k / PER_CYCLE;
    const int settle = (int)fmax(SETTLE, 400.0 * k / (2.0 * NUM_PI)); /* in cycles */
    struct polar_def polar = fixture_linear_polar(2.0 * NUM_PI, 0.5 * NUM_PI, 0.0, 1.0);
    struct model m;
    struct workspace w;
    driven_section_model(2.0, 1.0, &polar, DYNAMIC_ATTACHED, 1.0, dt, &m);
    if (workspace_init(&m, &w) != ST_OK) {
        abort();
    }
    struct response r = {0};
    for (int i = 0; i < (settle + 1) * PER_CYCLE; i++) {
        const double phase = 2.0 * NUM_PI * (i % PER_CYCLE) / PER_CYCLE;
        w.q[freedom] = size * cos(phase);
        w.qd[freedom] = -size * k * sin(phase);
        w.qdd[freedom] = -size * k * k * cos(phase);
        loads_evaluate(&m, &w, i == 0);
        if (i >= settle * PER_CYCLE) {
            const double complex turn = cexp(NUM_COMPLEX(0.0, -phase)) * 2.0 / PER_CYCLE / size;
            r.cl += w.cl[0] * turn;
            r.cm += w.cm[0] * turn;
        }
    }
    workspace_done(&w);
    model_done(&m);
    polar_def_done(&polar);
    return r;
}

static void check_complex(struct check_list *list, double complex value, double complex reference,
                          const char *source, const char *what, double k)
{
    check_add(list, CHECK_AT_MOST, "", cabs(value / reference - 1.0), 0.0, 0.005, source,
              "%s, k = %g: |ours / Theodorsen - 1|", what, k);
}

static void forced(struct check_list *list)
{
    static const struct {
        double k;
        double cl[2], cm[2];
    } row[] = {
        {0.05, {5.7320, -0.5210}, {1.4335, -0.2088}}, {0.10, {5.2813, -0.5071}, {1.3223, -0.2839}},
        {0.20, {4.6900, -0.0997}, {1.1804, -0.3391}}, {0.3927, {4.1468, 0.9643}, {1.0670, -0.3758}},
        {0.50, {3.9937, 1.5631}, {1.0475, -0.3946}},  {0.7854, {3.7813, 3.0975}, {1.0664, -0.4593}},
        {1.00, {3.7044, 4.2062}, {1.1224, -0.5192}},
    };
    static const char *const source = "[C], validation data 4.4";
    for (size_t i = 0; i < sizeof row / sizeof row[0]; i++) {
        const double k = row[i].k;
        const struct response pitch = driven(1, k);
        check_complex(list, pitch.cl, NUM_COMPLEX(row[i].cl[0], row[i].cl[1]), source,
                      "pitch about mid-chord, c_l", k);
        check_complex(list, pitch.cm, NUM_COMPLEX(row[i].cm[0], row[i].cm[1]), source,
                      "pitch about mid-chord, c_m", k);
        /* Plunge h = -v down, per half chord: circulation of i k h/b, apparent mass of h''. */
        const struct response plunge = driven(0, k);
        const double complex circulation = theodorsen(k) * NUM_COMPLEX(0.0, k);
        check_complex(list, -plunge.cl, 2.0 * NUM_PI * circulation - NUM_PI * k * k,
                      "closed form: Theodorsen", "plunge, c_l", k);
        check_complex(list, -plunge.cm, 0.5 * NUM_PI * circulation, "closed form: Theodorsen",
                      "plunge, c_m", k);
    }
    const struct response at = driven(0, 0.3927);
    check_complex(list, -at.cl, NUM_COMPLEX(-0.0747, 1.5480), source, "plunge, c_l", 0.3927);
    check_complex(list, -at.cm, NUM_COMPLEX(0.1024, 0.3870), source, "plunge, c_m", 0.3927);
}

static void fill(struct check_list *list)
{
    wake_function(list);
    forced(list);
}

const struct check_group group_unsteady = {
    .name = "unsteady",
    .title = "Unsteady attached flow",
    .text =
        "The dynamic model `attached`: four lag states a station and apparent mass. A section with "
        "the polar of thin-aerofoil theory is driven in pitch and in plunge through the load "
        "evaluation of the time march, 400 steps a cycle; complex amplitudes after the start has "
        "died away. What is left is the error of the rational function for C(k).",
    .fill = fill,
};

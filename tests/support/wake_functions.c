#include "tests/support/wake_functions.h"

#include "core/num.h"

enum { POINTS = 300, ANGLES = 200, TIMES = 600, PATH = 200 };

/* I_0, I_1 times exp(-x) and K_0, K_1 times exp(x), by their integrals. */
static void bessel(double x, double i[2], double k[2])
{
    const double end = acosh(1.0 + 40.0 / x), h = end / TIMES;
    i[0] = i[1] = k[0] = k[1] = 0.0;
    for (int n = 0; n < ANGLES; n++) {
        const double c = cos(NUM_PI * (n + 0.5) / ANGLES), e = exp(x * (c - 1.0)) / ANGLES;
        i[0] += e;
        i[1] += e * c;
    }
    for (int n = 0; n < TIMES; n++) {
        const double c = cosh((n + 0.5) * h), e = exp(-x * (c - 1.0)) * h;
        k[0] += e;
        k[1] += e * c;
    }
}

/* Garrick: 1 - integral of exp(-x s)/(x^2 ((K_0 - K_1)^2 + pi^2 (I_0 + I_1)^2)), over ln x: the
 * places x and what each takes off at s = 0. */
struct garrick {
    double x[POINTS], weight[POINTS];
};

static void garrick_fill(struct garrick *g)
{
    static const double from = -14.0, to = 5.0;
    for (int n = 0; n < POINTS; n++) {
        const double x = exp(from + (to - from) * (n + 0.5) / POINTS);
        double i[2], k[2];
        bessel(x, i, k);
        const double down = num_sq(k[0] - k[1]) * exp(-2.0 * x);
        const double up = num_sq(NUM_PI * (i[0] + i[1])) * exp(2.0 * x);
        g->x[n] = x;
        g->weight[n] = (to - from) / (POINTS * x * (down + up));
    }
}

static double wagner(const struct garrick *g, double s)
{
    double sum = 1.0;
    for (int n = 0; n < POINTS; n++) {
        sum -= g->weight[n] * exp(-g->x[n] * s);
    }
    return sum;
}

double wake_wagner(double s)
{
    struct garrick g;
    garrick_fill(&g);
    return wagner(&g, s);
}

/* The front at x = s - 1 = -cos(theta) adds circulation theta - sin(theta), which Wagner's function
 * lets act, and, while it is on the plate, the pressure of apparent mass, sin(theta)/pi. */
double wake_kuessner(double s)
{
    const double end = s < 2.0 ? acos(1.0 - s) : NUM_PI;
    struct garrick g;
    double sum = 0.0;
    garrick_fill(&g);
    for (int n = 0; n < PATH; n++) {
        const double theta = end * (n + 0.5) / PATH, passed = 1.0 - cos(theta);
        sum += passed * wagner(&g, s - passed) * end / PATH;
    }
    return (sum + (s < 2.0 ? sin(end) : 0.0)) / NUM_PI;
}

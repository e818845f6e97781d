/* Lifting line with a linear polar: lift slope against Glauert's series, with and without the far
 * wall, spanwise distribution, independence of the start. */
#include "core/aero/lifting_line.h"
#include "core/num.h"
#include "core/random.h"
#include "tests/support/fixture.h"
#include "tests/verify/check.h"

#include <assert.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

enum { STATIONS_MAX = 256 };
static const double angle = 0.05;
static const char *const source = "[C], validation data 7.1";

struct rectangle {
    double length, chord; /* half span and chord */
    enum wall_images walls;
    double width;
    enum tip_correction tip;
};

/* c_l / alpha at the stations for uniform incidence, and induced drag over squared lift,
 * C_Di/C_L^2; returns the mean, C_L / alpha. */
static double solve(const struct rectangle *g, int n, double *cl, double *drag)
{
    struct polar_def def = fixture_linear_polar(2.0 * NUM_PI, 0.0, 0.0, 1.0);
    struct polar *polar = NULL;
    struct lifting_line ll;
    struct lifting_line_state state;
    double alpha[STATIONS_MAX], chord[STATIONS_MAX], plunge[STATIONS_MAX] = {0};
    assert(n <= STATIONS_MAX);
    for (int i = 0; i < n; i++) {
        alpha[i] = angle;
        chord[i] = g->chord;
    }
    const struct wing wing = {.n = n,
                              .length = g->length,
                              .chord = chord,
                              .walls = g->walls,
                              .width = g->width,
                              .tip = g->tip};
    if (polar_create(&def, &polar) != ST_OK || lifting_line_init(&wing, 1e-12, 50, &ll) != ST_OK ||
        lifting_line_state_init(n, &state) != ST_OK) {
        abort();
    }
    const struct lifting_line_report r = lifting_line_solve(&ll, polar, alpha, plunge, &state);
    double sum = r.converged ? 0.0 : (double)NAN, induced = 0.0;
    for (int i = 0; i < n; i++) {
        cl[i] = state.cl[i] / angle;
        sum += cl[i];
        induced += cl[i] * state.induced[i] / angle;
    }
    *drag = induced * n / (sum * sum);
    lifting_line_state_done(&state);
    lifting_line_done(&ll);
    polar_destroy(polar);
    polar_def_done(&def);
    return sum / n;
}

static double lift_slope(const struct rectangle *g, int n, double *cl)
{
    double drag = 0.0;
    return solve(g, n, cl, &drag);
}

/* The border of a uniform element stands off the root of the circulation at the tip: the error
 * falls as 1/n. Limit of a + b/n + c/n^2 through n, 2n, 4n stations. */
static double extrapolated(const struct rectangle *g, int n)
{
    double cl[STATIONS_MAX];
    const double a = lift_slope(g, n, cl), b = lift_slope(g, 2 * n, cl);
    const double c = lift_slope(g, 4 * n, cl);
    const double ab = 2.0 * b - a, bc = 2.0 * c - b;
    return (4.0 * bc - ab) / 3.0;
}

static const struct {
    double ratio, slope, delta; /* of the whole span to the chord; C_L alpha; excess induced drag */
} glauert[] = {{4.0, 4.0284, 0.0285}, {6.0, 4.5304, 0.0483},  {7.4, 4.7586, 0.0619},
               {8.0, 4.8377, 0.0676}, {10.0, 5.0468, 0.0859}, {20.0, 5.5443, 0.1617}};
enum { RATIOS = sizeof glauert / sizeof glauert[0] };

static void slopes(struct check_list *list)
{
    const struct rectangle paper = {0.37, 0.1, WALLS_ROOT, 0.0, TIP_NONE};
    double cl[STATIONS_MAX];
    for (int i = 0; i < RATIOS; i++) {
        const struct rectangle g = {0.5 * glauert[i].ratio, 1.0, WALLS_ROOT, 0.0, TIP_NONE};
        const double expected = glauert[i].slope;
        check_add(list, CHECK_RELATIVE, "1/rad", lift_slope(&g, 16, cl), expected, 0.02, source,
                  "C_L alpha, AR %g, 16 elements, no correction", glauert[i].ratio);
        check_add(list, CHECK_RELATIVE, "1/rad", lift_slope(&g, 64, cl), expected, 0.006, source,
                  "C_L alpha, AR %g, 64 elements, no correction", glauert[i].ratio);
        check_add(list, CHECK_RELATIVE, "1/rad", extrapolated(&g, 64), expected, 0.001, source,
                  "C_L alpha, AR %g, extrapolated from 64, 128, 256", glauert[i].ratio);
    }
    /* Half a wing with a mirror is the whole wing without: exactly, element by element. */
    const struct rectangle whole = {0.74, 0.1, WALLS_NONE, 0.0, TIP_NONE};
    const double half = lift_slope(&paper, 16, cl);
    check_add(list, CHECK_RELATIVE, "1/rad", lift_slope(&whole, 32, cl), half, 1e-12, "property",
              "C_L alpha of the whole wing, 32 elements, no mirror");
}

/* Wings with the vortex of the tip inset, and how the error falls with the number of elements. */
static void tip_inset(struct check_list *list)
{
    static const int elements[] = {8, 16, 32, 64};
    static const double tolerance[] = {0.01, 0.005, 0.002, 0.001};
    double cl[STATIONS_MAX];
    for (int i = 0; i < RATIOS; i++) {
        const struct rectangle g = {0.5 * glauert[i].ratio, 1.0, WALLS_ROOT, 0.0, TIP_INSET};
        for (size_t k = 0; k < sizeof elements / sizeof elements[0]; k++) {
            check_add(list, CHECK_RELATIVE, "1/rad", lift_slope(&g, elements[k], cl),
                      glauert[i].slope, tolerance[k], source,
                      "C_L alpha, AR %g, %d elements, tip inset", glauert[i].ratio, elements[k]);
        }
    }
    const struct rectangle paper = {0.37, 0.1, WALLS_ROOT, 0.0, TIP_INSET};
    const struct rectangle whole = {0.74, 0.1, WALLS_NONE, 0.0, TIP_INSET};
    check_add(list, CHECK_RELATIVE, "1/rad", lift_slope(&whole, 32, cl), lift_slope(&paper, 16, cl),
              1e-12, "property", "C_L alpha of the whole wing, 32 elements, both tips inset");
    const double coarse = lift_slope(&paper, 32, cl) - 4.7586;
    const double fine = lift_slope(&paper, 128, cl) - 4.7586;
    check_add(list, CHECK_AT_LEAST, "", log(coarse / fine) / log(4.0), 0.0, 1.4,
              "property: order 3/2", "AR 7.4, tip inset: observed order from 32 to 128 elements");
    for (double gap = 0.003; gap < 0.2; gap *= 10.0) {
        const struct rectangle g = {0.37, 0.1, WALLS_ROOT_AND_FAR, 0.37 + gap, TIP_INSET};
        struct rectangle plain = g;
        plain.tip = TIP_NONE;
        const double limit = extrapolated(&plain, 64);
        check_add(list, CHECK_AT_MOST, "",
                  fabs(lift_slope(&g, 16, cl) - limit) / fabs(lift_slope(&plain, 16, cl) - limit),
                  0.0, gap < 0.01 ? 0.35 : 0.25, "extrapolated",
                  "far wall %g m beyond the tip, 16 elements: error with inset over without", gap);
    }
}

/* C_Di = C_L^2 (1 + delta)/(pi AR). */
static void induced_drag(struct check_list *list)
{
    static const int elements[] = {16, 64};
    double cl[STATIONS_MAX];
    for (int i = 0; i < RATIOS; i++) {
        const double expected = (1.0 + glauert[i].delta) / (NUM_PI * glauert[i].ratio);
        for (int k = 0; k < 2; k++) {
            const struct rectangle g = {0.5 * glauert[i].ratio, 1.0, WALLS_ROOT, 0.0, TIP_INSET};
            double drag = 0.0;
            (void)solve(&g, elements[k], cl, &drag);
            check_add(list, CHECK_RELATIVE, "", drag, expected, 0.005, source,
                      "C_Di/C_L^2, AR %g, %d elements, tip inset", glauert[i].ratio, elements[k]);
        }
    }
}

/* c_l / alpha at a share of the half span, linear between mid-points. */
static double at_span(int n, const double *cl, double share)
{
    const double x = share * n - 0.5;
    const int i = x < 0.0 ? 0 : (x > n - 2 ? n - 2 : (int)x);
    return cl[i] + (x - i) * (cl[i + 1] - cl[i]);
}

/* The same for c_l / alpha at a place. */
static double extrapolated_at(const struct rectangle *g, double share)
{
    double cl[STATIONS_MAX];
    (void)lift_slope(g, STATIONS_MAX / 2, cl);
    const double coarse = at_span(STATIONS_MAX / 2, cl, share);
    (void)lift_slope(g, STATIONS_MAX, cl);
    return 2.0 * at_span(STATIONS_MAX, cl, share) - coarse;
}

static void distribution(struct check_list *list)
{
    static const double share[] = {0.0, 0.25, 0.5, 0.75, 0.9, 0.95};
    static const double expected[] = {5.380, 5.326, 5.126, 4.563, 3.572, 2.801};
    const struct rectangle paper = {0.37, 0.1, WALLS_ROOT, 0.0, TIP_NONE};
    for (size_t i = 0; i < sizeof share / sizeof share[0]; i++) {
        check_add(list, CHECK_RELATIVE, "1/rad", extrapolated_at(&paper, share[i]), expected[i],
                  0.003, source, "AR 7.4, extrapolated: c_l/alpha at 2y/b = %g", share[i]);
    }
}

static void far_wall(struct check_list *list)
{
    const struct rectangle g = {0.37, 0.1, WALLS_ROOT_AND_FAR, 0.4, TIP_NONE};
    double cl[STATIONS_MAX];
    check_add(list, CHECK_RELATIVE, "1/rad", lift_slope(&g, 64, cl), 5.357, 0.007, source,
              "C_L alpha, far wall at 0.4 m, 64 elements, no correction");
    check_add(list, CHECK_RELATIVE, "1/rad", extrapolated(&g, 64), 5.357, 0.001, source,
              "C_L alpha, far wall at 0.4 m, extrapolated");
    const struct rectangle inset = {0.37, 0.1, WALLS_ROOT_AND_FAR, 0.4, TIP_INSET};
    check_add(list, CHECK_RELATIVE, "1/rad", lift_slope(&inset, 16, cl), 5.357, 0.005, source,
              "C_L alpha, far wall at 0.4 m, 16 elements, tip inset");
    check_add(list, CHECK_RELATIVE, "1/rad", lift_slope(&inset, 64, cl), 5.357, 0.002, source,
              "C_L alpha, far wall at 0.4 m, 64 elements, tip inset");
    check_add(list, CHECK_RELATIVE, "1/rad", extrapolated_at(&g, 0.5), 5.732, 0.003, source,
              "far wall at 0.4 m: c_l/alpha at mid-span");
    check_add(list, CHECK_RELATIVE, "1/rad", extrapolated_at(&g, 0.9), 4.239, 0.003, source,
              "far wall at 0.4 m: c_l/alpha at 90 %%");
    /* Both mirrors close on the wing: it becomes two-dimensional. */
    const struct rectangle closed = {0.37, 0.1, WALLS_ROOT_AND_FAR, 0.37 * (1.0 + 1e-9), TIP_NONE};
    check_add(list, CHECK_RELATIVE, "1/rad", lift_slope(&closed, 16, cl), 2.0 * NUM_PI, 1e-6,
              "property", "far wall at the tip: no induced angle");
}

/* The same incidence reached cold, and warm after three quite different incidences. */
static void independence(struct check_list *list)
{
    enum { N = 16, STATES = 3 };
    const double tolerance = 1e-11;
    struct polar_def def = fixture_linear_polar(2.0 * NUM_PI, 0.0, 0.0, 1.0);
    struct polar *polar = NULL;
    struct lifting_line ll;
    struct lifting_line_state cold, warm;
    double alpha[N], other[N], chord[N], plunge[N] = {0};
    for (int i = 0; i < N; i++) {
        chord[i] = 0.1;
    }
    const struct wing wing = {.n = N, .length = 0.37, .chord = chord, .walls = WALLS_ROOT};
    if (polar_create(&def, &polar) != ST_OK ||
        lifting_line_init(&wing, tolerance, 50, &ll) != ST_OK ||
        lifting_line_state_init(N, &cold) != ST_OK || lifting_line_state_init(N, &warm) != ST_OK) {
        abort();
    }
    uint64_t seed = 7;
    for (int s = 0; s < STATES; s++) {
        for (int i = 0; i < N; i++) {
            alpha[i] = 0.05 + 0.01 * i;
            other[i] = 0.6 * random_uniform(&seed) - 0.3;
        }
        (void)lifting_line_solve(&ll, polar, other, plunge, &warm);
    }
    const struct lifting_line_report a = lifting_line_solve(&ll, polar, alpha, plunge, &cold);
    const struct lifting_line_report b = lifting_line_solve(&ll, polar, alpha, plunge, &warm);
    double largest = a.converged && b.converged ? 0.0 : (double)NAN;
    for (int i = 0; i < N; i++) {
        largest = fmax(largest, fabs(cold.cl[i] - warm.cl[i]));
    }
    check_add(list, CHECK_AT_MOST, "", largest, 0.0, 1e-9, "property",
              "linear polar: c_l from a cold start less c_l from another state");
    lifting_line_state_done(&warm);
    lifting_line_state_done(&cold);
    lifting_line_done(&ll);
    polar_destroy(polar);
    polar_def_done(&def);
}

static void fill(struct check_list *list)
{
    slopes(list);
    tip_inset(list);
    induced_drag(list);
    distribution(list);
    far_wall(list);
    independence(list);
}

const struct check_group group_lifting_line = {
    .name = "lifting_line",
    .title = "Lifting line",
    .text = "Rectangular wing, section slope 2 pi, half of it behind a mirror at the root. The "
            "reference is Glauert's series with 200 terms; uniform elements approach it as 1/n, so "
            "the limit is extrapolated. With the vortex of a free tip inset by an eighth of an "
            "element, the default, the error falls as n^(-3/2) and is below 0.5 % at 16 elements.",
    .fill = fill,
};

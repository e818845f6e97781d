/* Lifting line through stall: convergence, independence of the start and of the mesh, and that the
 * solver says so when it has no solution. */
#include "core/aero/lifting_line.h"
#include "core/num.h"
#include "tests/support/fixture.h"
#include "tests/verify/check.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

enum { STATIONS_MAX = 64, MESHES = 4, ANGLES = 17 };
static const int mesh[MESHES] = {8, 16, 32, 64};
static const double wanted = 1e-6; /* residual */
static const double stall_deg = 8.0;

/* c_l = 2 pi alpha to 8 degrees, then falling by 1.7 per rad to 24, then nearly flat. */
static struct polar *stalled_polar(void)
{
    double alpha[2 * ANGLES - 1], cl[2 * ANGLES - 1], zero[2 * ANGLES - 1] = {0}, plunge[1] = {0.0};
    for (int i = 0; i < ANGLES; i++) {
        const double a = num_rad(2.0 * i), stall = num_rad(stall_deg), end = num_rad(24.0);
        double c = 2.0 * NUM_PI * fmin(a, stall);
        c -= 1.7 * (num_clamp(a, stall, end) - stall);
        c += 0.05 * (fmax(a, end) - end);
        alpha[ANGLES - 1 + i] = a;
        alpha[ANGLES - 1 - i] = -a;
        cl[ANGLES - 1 + i] = c;
        cl[ANGLES - 1 - i] = -c;
    }
    const struct polar_def def = {.n_alpha = 2 * ANGLES - 1,
                                  .n_plunge = 1,
                                  .alpha = alpha,
                                  .plunge = plunge,
                                  .cl = cl,
                                  .cd = zero,
                                  .cm = zero,
                                  .linear_from = -num_rad(stall_deg),
                                  .linear_to = num_rad(stall_deg)};
    struct polar *polar = NULL;
    if (polar_create(&def, &polar) != ST_OK) {
        abort();
    }
    return polar;
}

struct rig {
    int n;
    struct polar *polar;
    struct lifting_line ll;
    struct lifting_line_state state;
    double alpha[STATIONS_MAX], plunge[STATIONS_MAX];
};

static void rig_init(int n, struct rig *r)
{
    double chord[STATIONS_MAX];
    *r = (struct rig){.n = n, .polar = stalled_polar()};
    for (int i = 0; i < n; i++) {
        chord[i] = 0.1;
    }
    const struct wing wing = {.n = n, .length = 0.37, .chord = chord, .walls = WALLS_ROOT};
    if (lifting_line_init(&wing, 1e-9, 50, &r->ll) != ST_OK ||
        lifting_line_state_init(n, &r->state) != ST_OK) {
        abort();
    }
}

static void rig_done(struct rig *r)
{
    lifting_line_state_done(&r->state);
    lifting_line_done(&r->ll);
    polar_destroy(r->polar);
}

/* Solves for one angle of the whole wing from a start: 0 the table, 1 no lift, 2 twice the lift of
 * the solution at hand. */
static struct lifting_line_report solve(struct rig *r, double degrees, int start)
{
    for (int i = 0; i < r->n; i++) {
        r->alpha[i] = num_rad(degrees);
        r->state.cl[i] *= start;
    }
    if (start == 1) {
        memset(r->state.cl, 0, (size_t)r->n * sizeof *r->state.cl);
    }
    r->state.known = start > 0;
    r->state.factored = false;
    return lifting_line_solve(&r->ll, r->polar, r->alpha, r->plunge, &r->state);
}

/* Lift coefficient of the wing: the polar at the effective angles. */
static double lift(const struct rig *r)
{
    double sum = 0.0;
    for (int i = 0; i < r->n; i++) {
        sum += polar_at(r->polar, r->state.alpha[i], 0.0).cl;
    }
    return sum / r->n;
}

/* Largest residual computed from outside, with the viscosity the slopes ask for at least. */
static double residual(const struct rig *r)
{
    const struct lifting_line_state *s = &r->state;
    double slope[STATIONS_MAX], largest = 0.0;
    for (int i = 0; i < r->n; i++) {
        double induced = 0.0, rough = 0.0;
        for (int j = 0; j < r->n; j++) {
            const double b = r->ll.induced[num_at(i, j, r->ll.rows)];
            induced += b * s->cl[j];
            rough += b * (s->alpha[j] - s->alpha[i]);
        }
        const struct polar_value v = polar_at(r->polar, r->alpha[i] - induced, 0.0);
        slope[i] = v.cl_slope;
        largest = fmax(largest, fabs(s->cl[i] - v.cl - s->epsilon * rough));
    }
    const double least = lifting_line_viscosity(r->polar, r->n, slope);
    return s->epsilon >= least * (1.0 - 1e-9) ? largest : (double)INFINITY;
}

/* Every angle to 32 degrees from three starts. */
static void convergence(struct check_list *list)
{
    for (int k = 0; k < MESHES; k++) {
        struct rig r;
        int missed = 0, silent = 0;
        double apart = 0.0, most = 0.0;
        rig_init(mesh[k], &r);
        for (double degrees = 0.0; degrees <= 32.0; degrees += 0.5) {
            double first[STATIONS_MAX];
            for (int start = 0; start < 3; start++) {
                const struct lifting_line_report report = solve(&r, degrees, start);
                missed += !report.converged;
                silent += report.converged && !(residual(&r) <= wanted);
                most = fmax(most, report.iterations);
                for (int i = 0; i < r.n; i++) {
                    first[i] = start == 0 ? r.state.cl[i] : first[i];
                    const double d = fabs(r.state.cl[i] - first[i]);
                    apart = degrees < stall_deg ? fmax(apart, d) : apart;
                }
            }
        }
        check_add(list, CHECK_AT_MOST, "", missed, 0.0, 0.0, "property",
                  "%d elements: not converged of 195 angles and starts", mesh[k]);
        check_add(list, CHECK_AT_MOST, "", silent, 0.0, 0.0, "property",
                  "%d elements: called converged with a residual above 1e-6", mesh[k]);
        check_add(list, CHECK_AT_MOST, "", apart, 0.0, 1e-8, "property",
                  "%d elements, below stall: c_l from three starts apart", mesh[k]);
        check_add(list, CHECK_AT_MOST, "", most, 0.0, 50.0, "property",
                  "%d elements: most Newton iterations of a solution", mesh[k]);
        rig_done(&r);
    }
}

/* The lift of the wing does not depend on the mesh. */
static void meshes(struct check_list *list)
{
    static const double degrees[] = {6.0, 9.0, 10.0, 12.0, 14.0, 18.0, 22.0, 26.0, 30.0};
    for (size_t a = 0; a < sizeof degrees / sizeof degrees[0]; a++) {
        double fine = 0.0;
        for (int k = MESHES - 1; k >= 0; k--) {
            struct rig r;
            rig_init(mesh[k], &r);
            const struct lifting_line_report report = solve(&r, degrees[a], 0);
            const double cl = report.converged ? lift(&r) : (double)NAN;
            rig_done(&r);
            if (k == MESHES - 1) {
                fine = cl;
                continue;
            }
            check_add(list, CHECK_RELATIVE, "", cl, fine, 0.4 / mesh[k],
                      "the same with 64 elements", "C_L at %g deg, %d elements", degrees[a],
                      mesh[k]);
        }
    }
}

/* A wing turned slowly up to 32 degrees and back, each solution the start of the next, as in a
 * march. */
static void sweep(struct check_list *list)
{
    static const double step = 0.02;
    for (int k = 0; k < MESHES; k++) {
        struct rig r;
        int missed = 0, silent = 0;
        long iterations = 0, solved = 0;
        rig_init(mesh[k], &r);
        for (double t = 0.0; t <= 64.0; t += step) {
            for (int i = 0; i < r.n; i++) {
                r.alpha[i] = num_rad(t < 32.0 ? t : 64.0 - t) * (1.0 - 0.1 * i / r.n);
            }
            const struct lifting_line_report report =
                lifting_line_solve(&r.ll, r.polar, r.alpha, r.plunge, &r.state);
            missed += !report.converged;
            silent += report.converged && !(residual(&r) <= wanted);
            iterations += report.iterations;
            solved++;
        }
        check_add(list, CHECK_AT_MOST, "", missed, 0.0, 0.0, "property",
                  "%d elements, sweep to 32 deg and back in 3200 steps: not converged", mesh[k]);
        check_add(list, CHECK_AT_MOST, "", silent, 0.0, 0.0, "property",
                  "%d elements, sweep: called converged with a residual above 1e-6", mesh[k]);
        check_add(list, CHECK_AT_MOST, "", (double)iterations / (double)solved, 0.0, 4.0,
                  "property", "%d elements, sweep: Newton iterations per step", mesh[k]);
        rig_done(&r);
    }
}

static void fill(struct check_list *list)
{
    convergence(list);
    meshes(list);
    sweep(list);
}

const struct check_group group_stalled_line = {
    .name = "stalled_line",
    .title = "Lifting line through stall",
    .text =
        "Aspect ratio 7.4, mirror at the root; the lift of the section rises by 2 pi per rad to "
        "8 degrees and falls by 1.7 per rad to 24. At 16 uniform elements the equation without "
        "viscosity has no relaxed iteration that converges below -0.93 per rad. The starts are "
        "the table, no lift, and twice the lift of the solution. The "
        "same Newton's method without viscosity misses 8, 105, 117 and 125 of the 195 at 8, 16, 32 "
        "and 64 elements, and 23, 540, 822 and 1175 steps of the sweep.",
    .fill = fill,
};

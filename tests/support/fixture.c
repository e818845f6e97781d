#include "tests/support/fixture.h"

#include "core/num.h"
#include "core/random.h"

#include <assert.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

struct material fixture_skin(void)
{
    return (struct material){.name = "AS4/3501-6",
                             .e_l = 141.96e9,
                             .e_t = 9.78e9,
                             .g_lt = 6.0e9,
                             .g_tt = 4.83e9,
                             .nu_lt = 0.42,
                             .nu_tt = 0.50,
                             .density = 1445.0};
}

struct material fixture_foam(void)
{
    return (struct material){.name = "foam",
                             .e_l = 15e6,
                             .e_t = 15e6,
                             .g_lt = 8e6,
                             .g_tt = 8e6,
                             .nu_lt = 0.28,
                             .nu_tt = 0.28,
                             .density = 35.0};
}

struct material fixture_minguet(void)
{
    return (struct material){.name = "AS4/3501-6 Minguet",
                             .e_l = 142e9,
                             .e_t = 9.8e9,
                             .g_lt = 6.0e9,
                             .g_tt = 4.83e9,
                             .nu_lt = 0.30,
                             .nu_tt = 0.50,
                             .density = 1540.0};
}

struct material fixture_isotropic(double e, double nu, double density)
{
    const double g = e / (2.0 * (1.0 + nu));
    return (struct material){.name = "isotropic",
                             .e_l = e,
                             .e_t = e,
                             .g_lt = g,
                             .g_tt = g,
                             .nu_lt = nu,
                             .nu_tt = nu,
                             .density = density};
}

void fixture_paper_beam(double degrees, const struct polar_def *polar, struct case_def *out)
{
    case_def_defaults(out);
    (void)snprintf(out->name, sizeof out->name, "paper beam, %g deg", degrees);
    out->beam.length = 0.37;
    struct section_def *s = &out->beam.section;
    s->shape.width = 0.1;
    s->shape.layup[0].n_ply = 2;
    s->shape.layup[0].ply[0] =
        (struct ply){.material = fixture_skin(), .angle = num_rad(degrees), .thickness = 0.00013};
    s->shape.layup[0].ply[1] = (struct ply){.material = fixture_foam(), .thickness = 0.00387};
    out->flow.speed = 6.0;
    out->flow.incidence = num_rad(5.0);
    out->aero.polar = polar;
    out->solver.duration = 1.0;
}

void fixture_strip(const struct material *m, double length, double chord, double thickness,
                   struct case_def *out)
{
    case_def_defaults(out);
    out->kind = CASE_MODES;
    out->beam.length = length;
    out->beam.root_warping = ROOT_WARPING_FREE;
    out->beam.section.shape.width = chord;
    out->beam.section.shape.layup[0].n_ply = 1;
    out->beam.section.shape.layup[0].ply[0] = (struct ply){.material = *m, .thickness = thickness};
}

void fixture_minguet_strip(struct case_def *out)
{
    static const double degrees[4] = {45.0, 0.0, 0.0, 45.0};
    const struct material m = fixture_minguet();
    fixture_strip(&m, 0.55, 0.03, 0.000134, out);
    out->solver.modes = 5;
    out->beam.section.shape.layup[0].n_ply = 4;
    for (int i = 0; i < 4; i++) {
        out->beam.section.shape.layup[0].ply[i] =
            (struct ply){.material = m, .angle = num_rad(degrees[i]), .thickness = 0.000134};
    }
}

static double *doubles(int n)
{
    double *x = calloc((size_t)n, sizeof *x);
    assert(x != NULL);
    return x;
}

struct polar_def fixture_linear_polar(double lift_slope, double moment_slope, double drag,
                                      double limit)
{
    enum { ANGLES = 5 };
    struct polar_def p = {.name = "linear",
                          .n_alpha = ANGLES,
                          .n_plunge = 1,
                          .alpha = doubles(ANGLES),
                          .plunge = doubles(1),
                          .cl = doubles(ANGLES),
                          .cd = doubles(ANGLES),
                          .cm = doubles(ANGLES),
                          .linear_from = -limit,
                          .linear_to = limit,
                          .stall = stall_def_default()};
    for (int i = 0; i < ANGLES; i++) {
        p.alpha[i] = limit * (2.0 * i / (ANGLES - 1) - 1.0);
        p.cl[i] = lift_slope * p.alpha[i];
        p.cm[i] = moment_slope * p.alpha[i];
        p.cd[i] = drag;
    }
    return p;
}

static void fill_random(int n, double size, uint64_t *state, double *x)
{
    for (int i = 0; i < n; i++) {
        x[i] = size * (2.0 * random_uniform(state) - 1.0);
    }
}

struct network_def fixture_network(int hidden, double size, uint64_t seed)
{
    enum { IN = 4, OUT = 2 };
    /* The acceleration counts little: the loads act on the acceleration they depend on, and above a
     * sensitivity of about 0.02 per unit the march at 2e-4 s answers with a step-to-step zigzag. */
    static const double scale[IN] = {0.2, 0.1, 0.05, 2.0};
    struct network_def d = {.name = "random",
                            .n_in = IN,
                            .n_hidden = hidden,
                            .n_out = OUT,
                            .input = {NET_IN_MEAN_ALPHA, NET_IN_DELTA_ALPHA, NET_IN_ALPHA_RATE,
                                      NET_IN_ALPHA_ACCELERATION},
                            .output = {NET_OUT_CL, NET_OUT_CM},
                            .out_scale = {size, 0.2 * size},
                            .w1 = doubles(IN * hidden),
                            .b1 = doubles(hidden),
                            .w2 = doubles(OUT * hidden),
                            .b2 = doubles(OUT)};
    memcpy(d.in_scale, scale, sizeof scale);
    for (int i = 0; i < IN; i++) {
        d.hull_min[i] = -10.0;
        d.hull_max[i] = 10.0;
    }
    fill_random(IN * hidden, 1.0, &seed, d.w1);
    fill_random(hidden, 1.0, &seed, d.b1);
    fill_random(OUT * hidden, 2.0 / sqrt(hidden), &seed, d.w2);
    fill_random(OUT, 0.1, &seed, d.b2);
    return d;
}

double fixture_normal(uint64_t *state)
{
    /* Box-Muller; 1 - u is never zero. */
    const double u = 1.0 - random_uniform(state), v = random_uniform(state);
    return sqrt(-2.0 * log(u)) * cos(2.0 * NUM_PI * v);
}

void fixture_multiply(int n, const double *a, const double *x, double *y)
{
    for (int i = 0; i < n; i++) {
        y[i] = 0.0;
        for (int j = 0; j < n; j++) {
            y[i] += a[num_at(i, j, n)] * x[j];
        }
    }
}

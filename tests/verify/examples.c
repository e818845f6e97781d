/* The two integrators against each other on every shipped simulation, and on one with a network. */
#include "api/case.h"
#include "core/num.h"
#include "tests/support/fixture.h"
#include "tests/verify/built.h"
#include "tests/verify/check.h"

#include <stdio.h>
#include <stdlib.h>

/* Largest difference of the tip twist over the first second, relative to its range. */
static double disagreement(const struct case_def *given)
{
    struct case_def def = *given;
    def.solver.duration = fmin(def.solver.duration, 1.0);
    def.output.sample_every = 1;
    def.output.n_channel = 1;
    def.output.channel[0] = CHANNEL_TIP_TWIST;
    def.solver.integrator = INTEGRATOR_EXPONENTIAL;
    struct sim *exact = built_run(&def);
    def.solver.integrator = INTEGRATOR_RK4_ADAPTIVE;
    def.solver.tolerance = 1e-10;
    struct sim *adaptive = built_run(&def);
    const int n = sim_result(exact)->n_sample;
    const double *a = sim_column(exact, 0), *b = sim_column(adaptive, 0);
    double lo = a[0], hi = a[0], largest = 0.0;
    for (int i = 0; i < n && sim_result(adaptive)->n_sample == n; i++) {
        lo = fmin(lo, a[i]);
        hi = fmax(hi, a[i]);
        largest = fmax(largest, fabs(a[i] - b[i]));
    }
    sim_destroy(adaptive);
    sim_destroy(exact);
    return hi > lo ? largest / (hi - lo) : (double)NAN;
}

static const char *const expected = "tolerance 1e-10 a step";

static void shipped(struct check_list *list)
{
    struct library *lib = NULL;
    struct failure fail = {0};
    if (library_create_builtin(&lib, &fail) != ST_OK) {
        (void)fprintf(stderr, "library: %s\n", fail.detail);
        exit(EXIT_FAILURE);
    }
    struct failure_list *problems = calloc(1, sizeof *problems);
    const char *path, *text;
    size_t size;
    for (int i = 0; (path = library_example_case(i, &text, &size)) != NULL; i++) {
        struct api_case *c = NULL;
        if (api_case_parse(lib, text, size, "", &c, problems) != ST_OK) {
            check_add(list, CHECK_AT_MOST, "", (double)NAN, 0.0, 0.0, "", "%s does not parse",
                      path);
            continue;
        }
        if (api_case_def(c)->kind == CASE_SIMULATION) {
            check_add(list, CHECK_AT_MOST, "", disagreement(api_case_def(c)), 0.0, 1e-6, expected,
                      "%s", path);
        }
        api_case_destroy(c);
    }
    free(problems);
    library_destroy(lib);
}

static void with_network(struct check_list *list)
{
    struct polar_def polar = fixture_linear_polar(5.0, 0.8, 0.05, 0.5);
    struct network_def network = fixture_network(50, 0.02, 7);
    struct case_def def;
    fixture_paper_beam(-45.0, &polar, &def);
    def.aero.dynamic = DYNAMIC_NETWORK;
    def.aero.network = &network;
    check_add(list, CHECK_AT_MOST, "", disagreement(&def), 0.0, 1e-6, expected,
              "paper beam with a network 4-50-2");
    network_def_done(&network);
    polar_def_done(&polar);
}

static void fill(struct check_list *list)
{
    shipped(list);
    with_network(list);
}

const struct check_group group_examples = {
    .name = "examples",
    .title = "Agreement of the integrators",
    .text =
        "Largest difference of the tip twist between `exponential` and `rk4_adaptive` "
        "(tolerance 1e-10) over the first second, relative to the range of the twist. The network "
        "is random, 4-50-2, with little weight on the acceleration.",
    .fill = fill,
};

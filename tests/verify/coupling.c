/* The coupled march: work of the loads, energy without air, convergence in the time step. */
#include "core/coupling/loads.h"
#include "core/num.h"
#include "tests/support/fixture.h"
#include "tests/verify/built.h"
#include "tests/verify/check.h"

#include <stdlib.h>
#include <string.h>

/* Power of the station loads on the station velocities against that of the modal loads, in a random
 * state, with a polar that bends, drag, incidence and the network. */
static void work_balance(struct check_list *list)
{
    struct polar_def polar = fixture_linear_polar(5.0, 0.8, 0.05, 0.6);
    struct network_def network = fixture_network(50, 0.2, 3);
    struct case_def def;
    struct model m;
    struct workspace w;
    uint64_t seed = 11;
    fixture_paper_beam(-30.0, &polar, &def);
    def.aero.dynamic = DYNAMIC_NETWORK;
    def.aero.network = &network;
    def.solver.modes = 8;
    built_model(&def, &m);
    if (workspace_init(&m, &w) != ST_OK) {
        abort();
    }
    double modal = 0.0, station = 0.0, size = 0.0;
    for (int j = 0; j < m.n_mode; j++) {
        w.q[j] = 1e-3 * fixture_normal(&seed);
        w.qd[j] = 0.05 * fixture_normal(&seed);
    }
    loads_evaluate(&m, &w, false);
    for (int j = 0; j < m.n_mode; j++) {
        modal += w.load[j] * w.qd[j];
    }
    for (int i = 0; i < m.n_station; i++) {
        struct beam_motion velocity = {0};
        for (int j = 0; j < m.n_mode; j++) {
            const struct beam_motion shape =
                beam_motion_at(&m.beam, m.modes.shape + (size_t)j * (size_t)m.modes.n_dof,
                               (i + 0.5) * m.station_length);
            velocity.u += shape.u * w.qd[j];
            velocity.v += shape.v * w.qd[j];
            velocity.theta += shape.theta * w.qd[j];
        }
        const double power =
            m.station_length *
            (w.force_x[i] * velocity.u + w.force_y[i] * velocity.v + w.moment[i] * velocity.theta);
        station += power;
        size += fabs(power);
    }
    check_add(list, CHECK_AT_MOST, "", fabs(modal - station) / size, 0.0, 1e-13, "property",
              "power of the station loads less that of the modal loads");
    workspace_done(&w);
    model_done(&m);
    network_def_done(&network);
    polar_def_done(&polar);
}

static double modal_energy(const struct sim *sim, int modes, const struct sim_result *r, int i)
{
    double energy = 0.0;
    for (int j = 0; j < modes; j++) {
        const double omega = 2.0 * NUM_PI * r->mode[j].frequency_hz;
        energy += 0.5 * num_sq(omega * sim_column(sim, j)[i]);
        energy += 0.5 * num_sq(sim_column(sim, modes + j)[i]);
    }
    return energy;
}

static void ask_modal_state(struct case_def *def)
{
    def->output.n_channel = 2;
    def->output.channel[0] = CHANNEL_MODAL_AMPLITUDE;
    def->output.channel[1] = CHANNEL_MODAL_VELOCITY;
}

/* No air: the energy stays, with modal damping it falls as it must. */
static void energy(struct check_list *list)
{
    static const struct {
        const char *name;
        enum integrator integrator;
        double tolerance, limit;
    } row[] = {{"exponential", INTEGRATOR_EXPONENTIAL, 1e-9, 1e-10},
               {"adaptive Runge-Kutta, 1e-12", INTEGRATOR_RK4_ADAPTIVE, 1e-12, 1e-8}};
    struct polar_def polar = fixture_linear_polar(2.0 * NUM_PI, 0.0, 0.0, 1.0);
    for (size_t k = 0; k < sizeof row / sizeof row[0]; k++) {
        struct case_def def;
        fixture_paper_beam(-45.0, &polar, &def);
        ask_modal_state(&def);
        def.flow.density = 0.0;
        def.solver.integrator = row[k].integrator;
        def.solver.tolerance = row[k].tolerance;
        def.solver.start = START_AMPLITUDES;
        def.solver.n_amplitude = 4;
        memcpy(def.solver.amplitude, (double[]){1e-3, -2e-4, 1e-4, 5e-5}, 4 * sizeof(double));
        memcpy(def.solver.velocity, (double[]){0.01, 0.02, 0.0, -0.01}, 4 * sizeof(double));
        struct sim *sim = built_run(&def);
        const struct sim_result *r = sim_result(sim);
        const double first = modal_energy(sim, 4, r, 0);
        const double last = modal_energy(sim, 4, r, r->n_sample - 1);
        check_add(list, CHECK_AT_MOST, "", fabs(last / first - 1.0), 0.0, row[k].limit, "property",
                  "density 0, 1 s, 4 modes, %s: relative change of energy", row[k].name);
        sim_destroy(sim);
    }
    polar_def_done(&polar);
}

/* Modal state after 0.1 s at a time step, from amplitudes, linear polar, lifting line. */
static void final_state(const struct polar_def *polar, double step, int order, double out[8])
{
    struct case_def def;
    fixture_paper_beam(-45.0, polar, &def);
    ask_modal_state(&def);
    def.aero.tolerance = 1e-13;
    def.solver.time_step = step;
    def.solver.duration = 0.1;
    def.solver.load_order = order;
    def.solver.start = START_AMPLITUDES;
    def.solver.n_amplitude = 4;
    memcpy(def.solver.amplitude, (double[]){1e-3, -2e-4, 1e-4, 5e-5}, 4 * sizeof(double));
    struct sim *sim = built_run(&def);
    for (int j = 0; j < 8; j++) {
        const double omega = j < 4 ? 2.0 * NUM_PI * sim_result(sim)->mode[j].frequency_hz : 1.0;
        out[j] = omega * sim_column(sim, j)[sim_result(sim)->n_sample - 1];
    }
    sim_destroy(sim);
}

static double state_distance(const double a[8], const double b[8])
{
    double sum = 0.0, size = 0.0;
    for (int j = 0; j < 8; j++) {
        sum += num_sq(a[j] - b[j]);
        size += num_sq(b[j]);
    }
    return sqrt(sum / size);
}

/* Order p of the extrapolation gives order p + 1 of the march; but the first steps know no history,
 * and their lower order leaves an error of order 2 behind, whatever p is. */
static void time_step(struct check_list *list)
{
    struct polar_def polar = fixture_linear_polar(5.0, 0.8, 0.02, 0.9);
    double exact[8], coarse[8], fine[8];
    final_state(&polar, 2e-6, 2, exact);
    for (int order = 0; order <= 3; order++) {
        final_state(&polar, 4e-4, order, coarse);
        final_state(&polar, 2e-4, order, fine);
        const double a = state_distance(coarse, exact), b = state_distance(fine, exact);
        check_add(list, CHECK_AT_LEAST, "", log2(a / b), 0.0, order == 0 ? 0.9 : 1.9,
                  "property: order 1, then 2",
                  "load order %d: observed order, 4e-4 to 2e-4 s (%.1e, %.1e)", order, a, b);
    }
    polar_def_done(&polar);
}

static void fill(struct check_list *list)
{
    work_balance(list);
    energy(list);
    time_step(list);
}

const struct check_group group_coupling = {
    .name = "coupling",
    .title = "Coupled march",
    .text = "The paper's beam. Distances of states are relative, in the energy norm. The order of "
            "the march is limited to 2 by its first steps, which have no history of loads.",
    .fill = fill,
};

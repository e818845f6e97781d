/* tests/bench/step_model.c
 * Marches the paper's case with lifting line and network, times the march alone, and writes the
 * model in numbers with the result as JSON, for tests/bench/step_numpy.py to march the same.
 *
 * Usage: step_model [steps] [rounds] */
#include "core/coupling/exponential.h"
#include "core/coupling/march.h"
#include "core/num.h"
#include "core/sim.h"
#include "tests/bench/paper_case.h"

#include <stdio.h>
#include <stdlib.h>

enum { ROUNDS_MAX = 101 };

static void must(enum status st, const char *what)
{
    if (st != ST_OK) {
        (void)fprintf(stderr, "%s failed\n", what);
        exit(1);
    }
}

static void put(const char *name, int n, const double *x)
{
    (void)printf("\"%s\":[", name);
    for (int i = 0; i < n; i++) {
        (void)printf("%s%.17g", i > 0 ? "," : "", x[i]);
    }
    (void)printf("],\n");
}

/* One march from rest. Microseconds a step; the state at the end in q and qd. */
static double march_once(const struct model *m, double *q, double *qd, long *iterations)
{
    struct workspace w;
    struct record record;
    struct march march;
    must(workspace_init(m, &w), "workspace");
    must(record_init(m, &record), "record");
    march_init(m, &w, &record, &march);
    const double start = paper_cpu_now();
    must(march_run(&march, NULL), "march");
    const double used = paper_cpu_now() - start;
    for (int j = 0; j < m->n_mode; j++) {
        q[j] = w.q[j];
        qd[j] = w.qd[j];
    }
    *iterations = w.counters.lifting_line_iterations;
    record_done(&record);
    workspace_done(&w);
    return 1e6 * used / march.steps;
}

static void put_model(const struct model *m)
{
    const int ns = m->n_station, nm = m->n_mode;
    struct exponential e;
    double matrix[LIMIT_ELEMENTS];
    exponential_init(nm, m->omega2, m->damping, m->def.solver.time_step, &e);
    for (int k = 0; k < 4; k++) {
        const char name[] = {'p', (char)('0' + k), '\0'};
        put(name, nm, e.p[k]);
    }
    put("w00", nm, e.w[0][0]);
    put("w01", nm, e.w[0][1]);
    put("w10", nm, e.w[1][0]);
    put("w11", nm, e.w[1][1]);
    put("omega2", nm, m->omega2);
    put("damping", nm, m->damping);
    put("gravity", nm, m->gravity);
    put("chord", ns, m->chord);
    put("station_u", ns * nm, m->station_u);
    put("station_v", ns * nm, m->station_v);
    put("station_theta", ns * nm, m->station_theta);
    for (int j = 0; j < ns; j++) {
        char name[32];
        for (int i = 0; i < ns; i++) {
            matrix[i] = m->lifting_line.induced[num_at(i, j, m->lifting_line.rows)];
        }
        (void)snprintf(name, sizeof name, "induced%d", j);
        put(name, ns, matrix);
    }
}

static void put_tables(const struct case_def *def)
{
    const struct polar_def *p = def->aero.polar;
    const struct network_def *n = def->aero.network;
    put("alpha", p->n_alpha, p->alpha);
    put("plunge", p->n_plunge, p->plunge);
    put("cl", p->n_alpha * p->n_plunge, p->cl);
    put("cd", p->n_alpha * p->n_plunge, p->cd);
    put("cm", p->n_alpha * p->n_plunge, p->cm);
    put("net_w1", n->n_in * n->n_hidden, n->w1);
    put("net_b1", n->n_hidden, n->b1);
    put("net_w2", n->n_hidden * n->n_out, n->w2);
    put("net_b2", n->n_out, n->b2);
    put("net_scale", n->n_in, n->in_scale);
    put("net_out", n->n_out, n->out_scale);
}

int main(int argc, char **argv)
{
    const long steps = argc > 1 ? strtol(argv[1], NULL, 10) : 15000;
    const long asked = argc > 2 ? strtol(argv[2], NULL, 10) : 5;
    const int rounds = asked < 1 ? 1 : (asked > ROUNDS_MAX ? ROUNDS_MAX : (int)asked);
    sim_process_init();
    struct paper_case paper;
    paper_case_read(&paper);
    struct case_def def = *api_case_def(paper.parsed);
    def.aero.dynamic = DYNAMIC_NETWORK;
    def.aero.network = &paper.network;
    def.solver.duration = (double)steps * def.solver.time_step;
    struct model m;
    struct failure fail;
    must(model_build(&def, &m, &fail), "model");
    double us[ROUNDS_MAX], q[LIMIT_MODES], qd[LIMIT_MODES];
    long iterations = 0;
    for (int r = 0; r < rounds; r++) {
        us[r] = march_once(&m, q, qd, &iterations);
    }
    (void)printf("{\"us_per_step\":%.6g,\"steps\":%ld,\"iterations\":%ld,\"dt\":%.17g,\n",
                 paper_median(rounds, us), steps, iterations, def.solver.time_step);
    const double period = 2.0 * NUM_PI / m.modes.omega[0];
    (void)printf("\"speed\":%.17g,\"incidence\":%.17g,\"pressure\":%.17g,\"strip\":%.17g,"
                 "\"window\":%d,\"tolerance\":%.17g,\n",
                 def.flow.speed, def.flow.incidence, m.dynamic_pressure, m.station_length,
                 (int)floor(period / def.solver.time_step + 0.5), def.aero.tolerance);
    put_model(&m);
    put_tables(&def);
    put("q", m.n_mode, q);
    put("qd", m.n_mode, qd);
    (void)printf("\"modes\":%d}\n", m.n_mode);
    model_done(&m);
    paper_case_done(&paper);
    return 0;
}

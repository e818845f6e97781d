#include "core/network/assess.h"

#include "core/num.h"

#include <stdlib.h>

double assess_energy_error(const struct assess_work *model, const struct assess_work *record)
{
    const double work = record->pitch + record->plunge;
    return (model->pitch + model->plunge - work) / work;
}

struct window {
    int from, n;   /* samples of the errors */
    int work_from; /* of the work, to the last one */
    double periods;
};

static struct window window_of(const struct flow_record *r)
{
    const int first = flow_record_first(r);
    struct window w = {.from = first, .n = r->n - first, .work_from = first, .periods = 1.0};
    if (r->period > 0.0) {
        const double samples = r->period / flow_record_step(r);
        const double whole = floor((w.n - 1) / samples + 1e-6);
        if (whole >= 1.0) {
            w.periods = whole;
            w.work_from = r->n - 1 - (int)lround(whole * samples);
            w.work_from = w.work_from < 0 ? 0 : w.work_from;
        }
    }
    return w;
}

/* Adds sample i of the trapezoidal rule. */
static void add_work(const struct flow_record *r, const struct window *w, int i, double cl,
                     double cm, struct assess_work *out)
{
    if (i < w->work_from) {
        return;
    }
    const double end = i == w->work_from || i == r->n - 1 ? 0.5 : 1.0;
    const double dt = end * flow_record_step(r) / w->periods;
    out->pitch += cm * r->value[num_at(i, FLOW_THETA_RATE, r->n)] * dt;
    out->plunge += cl * r->value[num_at(i, FLOW_W_RATE, r->n)] * dt;
}

static void compare(const struct flow_record *r, const struct window *w, const double *steady,
                    const double *model, struct assessment *a)
{
    for (int i = w->from; i < r->n; i++) {
        const double cl = r->value[num_at(i, FLOW_CL, r->n)];
        const double cm = r->value[num_at(i, FLOW_CM, r->n)];
        const double *s = steady + num_at(0, i, NET_OUT_COUNT);
        const double *m = model + num_at(0, i, NET_OUT_COUNT);
        a->network_cl += num_sq(m[NET_OUT_CL] - cl);
        a->network_cm += num_sq(m[NET_OUT_CM] - cm);
        a->steady_cl += num_sq(s[NET_OUT_CL] - cl);
        a->steady_cm += num_sq(s[NET_OUT_CM] - cm);
        add_work(r, w, i, cl, cm, &a->record);
        add_work(r, w, i, m[NET_OUT_CL], m[NET_OUT_CM], &a->network);
        add_work(r, w, i, s[NET_OUT_CL], s[NET_OUT_CM], &a->steady);
    }
    double *const square[] = {&a->network_cl, &a->network_cm, &a->steady_cl, &a->steady_cm};
    for (size_t k = 0; k < sizeof square / sizeof square[0]; k++) {
        *square[k] = sqrt(*square[k] / w->n);
    }
}

enum status assess_coefficients(const struct flow_record *r, const double *steady,
                                const double *model, struct assessment *out)
{
    const struct window w = window_of(r);
    if (w.n < 1) {
        return ST_INVALID;
    }
    *out = (struct assessment){.range_cl = flow_record_range(r, FLOW_CL, w.from),
                               .range_cm = flow_record_range(r, FLOW_CM, w.from)};
    compare(r, &w, steady, model, out);
    return ST_OK;
}

enum status assess_record(const struct flow_record *r, double window, const struct polar *polar,
                          const struct network *net, struct assessment *out)
{
    const size_t n = (size_t)r->n;
    const int first = flow_record_first(r);
    double *x = malloc(n * (NET_IN_COUNT + 2 * NET_OUT_COUNT) * sizeof *x);
    if (x == NULL) {
        return ST_NO_MEMORY;
    }
    double *steady = x + n * NET_IN_COUNT, *model = steady + n * NET_OUT_COUNT;
    int outside = 0;
    flow_record_inputs(r, window, x);
    flow_record_steady(r, polar, steady);
    enum status st = flow_record_march(r, network_frame_of(net), polar, x, model);
    for (int i = first; i < r->n && st == ST_OK; i++) {
        double increment[NET_OUT_COUNT], *y = model + num_at(0, i, NET_OUT_COUNT);
        outside += network_eval(net, 1, x + num_at(0, i, NET_IN_COUNT), increment);
        for (int o = 0; o < NET_OUT_COUNT; o++) {
            y[o] += increment[o];
        }
    }
    st = st == ST_OK ? assess_coefficients(r, steady, model, out) : st;
    if (st == ST_OK) {
        out->outside_hull = (double)outside / (r->n - first);
    }
    free(x);
    return st;
}

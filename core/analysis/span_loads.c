#include "core/analysis/span_loads.h"

#include "core/num.h"

void span_loads_report(const struct model *m, const struct record *r, struct span_loads *out)
{
    const int n = m->n_station;
    double mean[LIMIT_ELEMENTS * SPAN_VALUES];
    const int from = span_mean_get(&r->span, mean);
    const bool drag = polar_def_has_drag(m->def.aero.polar);
    out->n_station = n;
    out->window_from = from * m->def.solver.time_step;
    out->window_to = (r->n - 1) * m->def.solver.time_step;
    for (int i = 0; i < n; i++) {
        const double force = m->dynamic_pressure * m->chord[i];
        out->z[i] = (i + 0.5) * m->station_length;
        out->chord[i] = m->chord[i];
        out->cl[i] = mean[num_at(i, SPAN_CL, n)];
        out->cd[i] = drag ? mean[num_at(i, SPAN_CD, n)] : (double)NAN;
        out->cm[i] = mean[num_at(i, SPAN_CM, n)];
        out->induced[i] = mean[num_at(i, SPAN_INDUCED, n)];
        out->alpha[i] = mean[num_at(i, SPAN_ALPHA, n)];
        out->lift[i] = force * out->cl[i];
        out->drag[i] = force * out->cd[i];
        out->moment[i] = force * m->chord[i] * out->cm[i];
    }
}

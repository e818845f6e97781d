#include "core/analysis/doubt.h"

#include "core/num.h"

const double doubt_alternations_max = 0.5;
const double doubt_outside_hull_max = 0.5;
const double doubt_outside_hull_told = 0.01;

/* Change of a coefficient that is none: above what the lifting line leaves. */
static const double change_floor = 1e-6;

static bool turns_back(const double *y, int i)
{
    const double before = y[i - 1] - y[i - 2], now = y[i] - y[i - 1];
    return fabs(before) > change_floor && fabs(now) > change_floor && before * now < 0.0;
}

long doubt_alternations(const struct record *r, int from)
{
    const double *cl = record_history(r, HISTORY_CL), *cm = record_history(r, HISTORY_CM);
    long count = 0;
    for (int i = from < 2 ? 2 : from; i < r->n; i++) {
        count += turns_back(cl, i) || turns_back(cm, i);
    }
    return count;
}

struct doubt doubt_of(const struct march *march)
{
    enum { LEAST = 12 }; /* samples of which a share means something */
    const struct record *r = march->record;
    const struct model *m = march->model;
    const int from = r->n * 2 / 3;
    struct doubt d = {0};
    if (r->n - from >= LEAST) {
        d.alternations = (double)doubt_alternations(r, from) / (r->n - from);
    }
    if (m->network != NULL) {
        const double evaluations = (march->steps + 1.0) * m->n_station;
        d.outside_hull = (double)march->w->counters.outside_hull / evaluations;
    }
    return d;
}

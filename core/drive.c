#include "core/drive.h"

#include "core/num.h"
#include "core/range.h"

#include <stdio.h>

void drive_defaults(enum drive_type type, struct drive_def *out)
{
    *out = (struct drive_def){.given = true, .type = type, .ramp = (double)NAN};
}

void drive_complete(struct drive_def *d)
{
    if (isnan(d->ramp)) {
        d->ramp = 1.0 / d->frequency;
    }
}

void drive_check(const struct drive_def *d, const char *pointer, const char *value_key,
                 struct failure_list *out)
{
    if (!d->given) {
        return;
    }
    if (d->type == DRIVE_TABLE) {
        range_check_table(d->n, d->time, d->value, pointer, value_key, out);
        return;
    }
    char frequency[160], start[160], ramp[160];
    (void)snprintf(frequency, sizeof frequency, "%.120s/frequency_hz", pointer);
    (void)snprintf(start, sizeof start, "%.120s/start_s", pointer);
    (void)snprintf(ramp, sizeof ramp, "%.120s/ramp_s", pointer);
    const struct range rule[] = {{frequency, d->frequency, 0.0, HUGE_VAL, true, false},
                                 {start, d->start, 0.0, HUGE_VAL, false, false}};
    /* What may follow from the frequency. */
    const struct range fade[] = {{ramp, d->ramp, 0.0, HUGE_VAL, true, false}};
    const int before = out->total;
    RANGE_CHECK(rule, out);
    if (out->total == before) {
        RANGE_CHECK(fade, out);
    }
}

double drive_end(const struct drive_def *d)
{
    if (!d->given) {
        return 0.0;
    }
    return d->type == DRIVE_SINE ? HUGE_VAL : d->time[d->n - 1];
}

/* Spline of zero end slopes: a tridiagonal system in the second derivatives, by elimination. */
static void find_bends(const struct drive_def *d, double *bend)
{
    const int n = d->n;
    double upper[LIMIT_TABLE];
    for (int i = 0; i < n; i++) {
        const double left = i > 0 ? d->time[i] - d->time[i - 1] : 0.0;
        const double right = i + 1 < n ? d->time[i + 1] - d->time[i] : 0.0;
        const double slope_left = i > 0 ? (d->value[i] - d->value[i - 1]) / left : 0.0;
        const double slope_right = i + 1 < n ? (d->value[i + 1] - d->value[i]) / right : 0.0;
        const double before = i > 0 ? upper[i - 1] : 0.0;
        const double pivot = 2.0 * (left + right) - left * before;
        upper[i] = right / pivot;
        bend[i] = (6.0 * (slope_right - slope_left) - (i > 0 ? left * bend[i - 1] : 0.0)) / pivot;
    }
    for (int i = n - 2; i >= 0; i--) {
        bend[i] -= upper[i] * bend[i + 1];
    }
}

void drive_init(const struct drive_def *def, struct drive *out)
{
    *out = (struct drive){.def = *def};
    if (def->given && def->type == DRIVE_TABLE) {
        find_bends(def, out->bend);
    }
}

static struct drive_state sine_at(const struct drive_def *d, double t)
{
    const double tau = t - d->start, omega = 2.0 * NUM_PI * d->frequency;
    if (tau <= 0.0) {
        return (struct drive_state){0};
    }
    /* 10 x^3 - 15 x^4 + 6 x^5: at rest at both ends, up to the acceleration. */
    const double x = fmin(1.0, tau / d->ramp), a = omega * tau + d->phase;
    const double r = x * x * x * (10.0 + x * (-15.0 + 6.0 * x));
    const double r1 = 30.0 * num_sq(x * (1.0 - x)) / d->ramp;
    const double r2 = 60.0 * x * (1.0 - x) * (1.0 - 2.0 * x) / num_sq(d->ramp);
    const double s = sin(a), c = omega * cos(a);
    return (struct drive_state){.value = d->amplitude * r * s,
                                .rate = d->amplitude * (r1 * s + r * c),
                                .acceleration =
                                    d->amplitude * (r2 * s + 2.0 * r1 * c - r * omega * omega * s)};
}

static struct drive_state table_at(const struct drive *d, double t)
{
    const struct drive_def *p = &d->def;
    if (t <= p->time[0] || t >= p->time[p->n - 1]) {
        return (struct drive_state){.value = p->value[t <= p->time[0] ? 0 : p->n - 1]};
    }
    int low = 0, high = p->n - 1;
    while (high - low > 1) {
        const int middle = (low + high) / 2;
        if (t >= p->time[middle]) {
            low = middle;
        } else {
            high = middle;
        }
    }
    const double h = p->time[high] - p->time[low];
    const double a = (p->time[high] - t) / h, b = 1.0 - a;
    const double m0 = d->bend[low], m1 = d->bend[high];
    return (struct drive_state){
        .value = a * p->value[low] + b * p->value[high] +
                 ((a * a * a - a) * m0 + (b * b * b - b) * m1) * h * h / 6.0,
        .rate = (p->value[high] - p->value[low]) / h +
                ((3.0 * b * b - 1.0) * m1 - (3.0 * a * a - 1.0) * m0) * h / 6.0,
        .acceleration = a * m0 + b * m1};
}

struct drive_state drive_at(const struct drive *d, double t)
{
    if (!d->def.given) {
        return (struct drive_state){0};
    }
    return d->def.type == DRIVE_SINE ? sine_at(&d->def, t) : table_at(d, t);
}

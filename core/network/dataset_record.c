#include "core/network/dataset.h"

#include "core/aero/moving_section.h"
#include "core/num.h"

#include <stdio.h>

/* Widest that a section is moved in earnest: more is another unit. */
static const double angle_max = 0.5 * NUM_PI, plunge_max = 10.0;
/* Rates may differ from those of the samples by so much of their size (both rms)... */
static const double rate_tolerance = 0.1;
/* ...and by what the printed digits leave. */
static const double rate_floor = 2e-4;

static const char *const column_name[FLOW_ROWS] = {
#define NAME(code, name) [code] = (name),
    FLOW_ROW_LIST(NAME)
#undef NAME
};

static double value(const struct flow_record *r, enum flow_row row, int i)
{
    return r->value[num_at(i, (int)row, r->n)];
}

static void refuse(struct failure_list *out, const struct flow_record *r, enum flow_row row,
                   const char *code, const char *expected, double got)
{
    char where[160], text[32];
    (void)snprintf(where, sizeof where, "/%s/%s", r->name, column_name[row]);
    (void)snprintf(text, sizeof text, "%g", got);
    failure_set(failure_add(out), ST_INVALID, where, code, expected, text,
                "%s of the record %s is not admissible", column_name[row], r->name);
}

double flow_record_step(const struct flow_record *r)
{
    return (value(r, FLOW_TIME, r->n - 1) - value(r, FLOW_TIME, 0)) / (r->n - 1);
}

int flow_record_first(const struct flow_record *r)
{
    int i = 0;
    while (i < r->n && value(r, FLOW_TIME, i) < r->start) {
        i++;
    }
    return i;
}

double flow_record_range(const struct flow_record *r, enum flow_row row, int from)
{
    double least = value(r, row, from), most = least;
    for (int i = from; i < r->n; i++) {
        least = fmin(least, value(r, row, i));
        most = fmax(most, value(r, row, i));
    }
    return most - least;
}

bool flow_record_moves(const struct flow_record *r)
{
    for (int i = 0; i < r->n; i++) {
        if (fabs(value(r, FLOW_THETA_RATE, i)) > 0.0 || fabs(value(r, FLOW_W_RATE, i)) > 0.0) {
            return true;
        }
    }
    return false;
}

/* Derivative of a row at sample i: central of the fourth order, at the ends one-sided of the
 * second.
 */
static double difference(const struct flow_record *r, enum flow_row row, int i, double step)
{
    if (i >= 2 && i + 2 < r->n) {
        return (8.0 * (value(r, row, i + 1) - value(r, row, i - 1)) - value(r, row, i + 2) +
                value(r, row, i - 2)) /
               (12.0 * step);
    }
    const int inward = i < 2 ? 1 : -1;
    return inward *
           (4.0 * value(r, row, i + inward) - 3.0 * value(r, row, i) -
            value(r, row, i + 2 * inward)) /
           (2.0 * step);
}

static bool check_times(const struct flow_record *r, struct failure_list *out)
{
    const double step = flow_record_step(r);
    for (int i = 1; i < r->n; i++) {
        const double distance = value(r, FLOW_TIME, i) - value(r, FLOW_TIME, i - 1);
        if (!(distance > 0.0)) {
            refuse(out, r, FLOW_TIME, "not_increasing", "times that increase",
                   value(r, FLOW_TIME, i));
            return false;
        }
        if (fabs(distance - step) > 1e-3 * step) {
            refuse(out, r, FLOW_TIME, "gap", "equal steps of time", value(r, FLOW_TIME, i));
            return false;
        }
    }
    return true;
}

static bool check_values(const struct flow_record *r, struct failure_list *out)
{
    const int before = out->total;
    for (int k = 0; k < FLOW_ROWS; k++) {
        for (int i = 0; i < r->n; i++) {
            const double v = value(r, (enum flow_row)k, i);
            if (!isfinite(v)) {
                refuse(out, r, (enum flow_row)k, "out_of_range", "finite numbers", v);
                break;
            }
            if (k == FLOW_THETA && fabs(v) > angle_max) {
                refuse(out, r, FLOW_THETA, "out_of_range", "degrees, -90..90", num_deg(v));
                break;
            }
            if (k == FLOW_W && fabs(v) > plunge_max) {
                refuse(out, r, FLOW_W, "out_of_range", "chords, -10..10", v);
                break;
            }
        }
    }
    return out->total == before;
}

/* A rate in other units is found by the motion it does not belong to. */
static void check_rate(const struct flow_record *r, enum flow_row of, enum flow_row rate,
                       struct failure_list *out)
{
    const double step = flow_record_step(r);
    double wrong = 0.0, size = 0.0;
    for (int i = 2; i + 2 < r->n; i++) {
        const double d = difference(r, of, i, step);
        wrong += num_sq(value(r, rate, i) - d);
        size += num_sq(d);
    }
    const double n = r->n - 4;
    if (sqrt(wrong / n) > rate_tolerance * sqrt(size / n) + rate_floor / step) {
        refuse(out, r, rate, "contradiction", "the rate of the motion by c/V, angles in radians",
               sqrt(wrong / n));
    }
}

void flow_record_check(const struct flow_record *r, struct failure_list *out)
{
    if (r->n < FLOW_SAMPLES_MIN || r->n > FLOW_SAMPLES_MAX) {
        refuse(out, r, FLOW_TIME, "too_few", "16..1000000 samples", r->n);
        return;
    }
    if (!check_values(r, out) || !check_times(r, out)) {
        return;
    }
    check_rate(r, FLOW_THETA, FLOW_THETA_RATE, out);
    check_rate(r, FLOW_THETA_RATE, FLOW_THETA_ACCELERATION, out);
    check_rate(r, FLOW_W, FLOW_W_RATE, out);
    check_rate(r, FLOW_W_RATE, FLOW_W_ACCELERATION, out);
}

/* Samples of the sliding mean. */
static int mean_samples(const struct flow_record *r, double window)
{
    const double whole =
        r->period > 0.0 ? fmax(1.0, nearbyint(window / r->period)) * r->period : window;
    return (int)num_clamp(nearbyint(whole / flow_record_step(r)), 1.0, FLOW_SAMPLES_MAX);
}

static double angle(const struct flow_record *r, int i)
{
    return value(r, FLOW_THETA, i) - value(r, FLOW_W_RATE, i);
}

void flow_record_inputs(const struct flow_record *r, double window, double *x)
{
    const double step = flow_record_step(r);
    const int width = mean_samples(r, window);
    double sum = width * angle(r, 0); /* at rest before */
    for (int i = 0; i < r->n; i++) {
        double *in = x + num_at(0, i, NET_IN_COUNT);
        sum += angle(r, i) - angle(r, i >= width ? i - width : 0);
        in[NET_IN_MEAN_ALPHA] = sum / width;
        in[NET_IN_DELTA_ALPHA] = angle(r, i) - sum / width;
        in[NET_IN_ALPHA_RATE] = value(r, FLOW_THETA_RATE, i) - value(r, FLOW_W_ACCELERATION, i);
        in[NET_IN_ALPHA_ACCELERATION] =
            value(r, FLOW_THETA_ACCELERATION, i) - difference(r, FLOW_W_ACCELERATION, i, step);
        in[NET_IN_PLUNGE_RATE] = value(r, FLOW_W_RATE, i);
        in[NET_IN_ALPHA] = angle(r, i);
        in[NET_IN_PITCH_RATE] = value(r, FLOW_THETA_RATE, i);
        for (int k = NET_IN_ALPHA_LAG_1; k < NET_IN_COUNT; k++) {
            in[k] = 0.0;
        }
    }
}

static struct moving_state motion_at(const struct flow_record *r, int i)
{
    return (struct moving_state){.theta = value(r, FLOW_THETA, i),
                                 .theta_rate = value(r, FLOW_THETA_RATE, i),
                                 .theta_acceleration = value(r, FLOW_THETA_ACCELERATION, i),
                                 .w = value(r, FLOW_W, i),
                                 .w_rate = value(r, FLOW_W_RATE, i),
                                 .w_acceleration = value(r, FLOW_W_ACCELERATION, i)};
}

enum status flow_record_march(const struct flow_record *r, const struct network_frame *frame,
                              const struct polar *polar, double *x, double *y)
{
    struct moving_section section;
    const enum status st = moving_section_init(frame, polar, flow_record_step(r), &section);
    for (int i = 0; i < r->n && st == ST_OK; i++) {
        const struct moving_state m = motion_at(r, i);
        const struct moving_value v = moving_section_step(&section, &m, i == 0);
        double *out = y + num_at(0, i, NET_OUT_COUNT), *in = x + num_at(0, i, NET_IN_COUNT);
        out[NET_OUT_CL] = v.cl;
        out[NET_OUT_CM] = v.cm;
        out[NET_OUT_CD] = v.cd;
        for (int k = NET_IN_ALPHA_LAG_1; k < NET_IN_COUNT; k++) {
            in[k] = section.input[k];
        }
    }
    moving_section_done(&section);
    return st;
}

void flow_record_steady(const struct flow_record *r, const struct polar *polar, double *y)
{
    for (int i = 0; i < r->n; i++) {
        const struct polar_value v = polar_at(polar, angle(r, i), value(r, FLOW_W, i));
        double *out = y + num_at(0, i, NET_OUT_COUNT);
        out[NET_OUT_CL] = v.cl;
        out[NET_OUT_CM] = v.cm;
        out[NET_OUT_CD] = v.cd;
    }
}

/* A row at a position between samples, by the cubic through four of them. */
static double between(const struct flow_record *r, enum flow_row row, double position)
{
    const int i = (int)num_clamp(floor(position), 1.0, r->n - 3.0);
    const double s = position - i;
    return (s - 1.0) * (s - 2.0) * (3.0 * (s + 1.0) * value(r, row, i) - s * value(r, row, i - 1)) /
               6.0 +
           s * (s + 1.0) *
               ((s - 1.0) * value(r, row, i + 2) - 3.0 * (s - 2.0) * value(r, row, i + 1)) / 6.0;
}

/* Mean of a row over all cycles behind the start, at the phase of sample i. */
static double phase_mean(const struct flow_record *r, enum flow_row row, int first, int i)
{
    const double cycle = r->period / flow_record_step(r);
    const int before = (int)((i - first) / cycle), behind = (int)((r->n - 1 - i) / cycle);
    double sum = 0.0;
    for (int k = -before; k <= behind; k++) {
        sum += k == 0 ? value(r, row, i) : between(r, row, i + k * cycle);
    }
    return sum / (before + behind + 1);
}

void flow_record_subtract(const struct flow_record *r, int first, int i, double *y)
{
    static const enum flow_row row[NET_OUT_COUNT] = {
        [NET_OUT_CL] = FLOW_CL, [NET_OUT_CM] = FLOW_CM, [NET_OUT_CD] = FLOW_CD};
    const bool repeats = r->period > 0.0 && i >= first;
    for (int o = 0; o < NET_OUT_COUNT; o++) {
        y[o] = (repeats ? phase_mean(r, row[o], first, i) : value(r, row[o], i)) - y[o];
    }
}

#include "core/analysis/damping.h"

#include "core/analysis/pencil.h"
#include "core/num.h"

#include <complex.h>
#include <stdbool.h>
#include <stdlib.h>

enum { SAMPLES_MAX = 640, SAMPLES_MIN = 24 };
static const double samples_per_period_high = 3.0; /* of the fastest mode: Nyquist with a margin */
static const double threshold = 1e-3;              /* singular values, relative to the largest */
static const double same_frequency = 0.02;         /* e-folds between roots of one motion */
static const double share_least = 0.05;            /* of the largest root, for one to count */

static double mean_of(const double *y, int from, int to)
{
    double sum = 0.0;
    for (int i = from; i < to; i++) {
        sum += y[i];
    }
    return sum / (to - from);
}

double damping_fluctuation(const double *y, int from, int to)
{
    const double mean = mean_of(y, from, to);
    double sum = 0.0;
    for (int i = from; i < to; i++) {
        sum += num_sq(y[i] - mean);
    }
    return sqrt(sum / (to - from));
}

struct window {
    int from, to; /* samples [from, to) */
};

static struct window choose_window(int n, const double *y, double dt, double frequency_low)
{
    const double period = 1.0 / (frequency_low * dt); /* in samples */
    const double wanted = DAMPING_PERIODS * period;
    const int length = wanted < n ? (int)wanted : n;
    const int skip = period + length < n ? (int)period : n - length;
    struct window first = {skip, skip + length}, last = {n - length, n};
    const bool decays = damping_fluctuation(y, last.from, last.to) <
                        0.5 * damping_fluctuation(y, first.from, first.to);
    return decays ? first : last;
}

/* Means of blocks of `block` samples, less the mean of all; returns how many. */
static int decimate(const double *y, struct window w, int block, double *out)
{
    const int n = (w.to - w.from) / block;
    const double offset = mean_of(y, w.from, w.from + n * block);
    for (int i = 0; i < n; i++) {
        out[i] = mean_of(y, w.from + i * block, w.from + (i + 1) * block) - offset;
    }
    return n;
}

/* What a mean over a block makes of e^{lambda t}, relative to its value at the block's start. */
static double block_gain(double complex lambda, double dt, int block)
{
    double complex sum = 0.0;
    for (int i = 0; i < block; i++) {
        sum += cexp(lambda * (dt * i));
    }
    return cabs(sum) / block;
}

/* Envelope slope of the component at omega: demodulated, averaged over one of its periods, fitted
 * in the middle four fifths. Equals the Hilbert envelope of the band around omega. */
static double envelope_ratio(const double *y, struct window w, double dt, double omega)
{
    const int span = (int)floor(2.0 * NUM_PI / (omega * dt) + 0.5);
    const int length = w.to - w.from - span, step = span / 8 > 0 ? span / 8 : 1;
    if (span < 4 || length < 4 * span) {
        return (double)NAN;
    }
    const double mean = mean_of(y, w.from, w.to);
    double s0 = 0.0, st = 0.0, stt = 0.0, sl = 0.0, stl = 0.0;
    for (int i = w.from + length / 10; i < w.from + length - length / 10; i += step) {
        double complex sum = 0.0;
        for (int k = 0; k < span; k++) {
            sum += (y[i + k] - mean) * cexp(NUM_COMPLEX(0.0, -omega * dt * (i + k - w.from)));
        }
        const double size = cabs(sum), t = dt * (i - w.from);
        if (!(size > 0.0)) {
            return (double)NAN;
        }
        s0 += 1.0;
        st += t;
        stt += t * t;
        sl += log(size);
        stl += t * log(size);
    }
    const double sigma = (s0 * stl - st * sl) / (s0 * stt - st * st);
    return -sigma / hypot(sigma, omega);
}

/* Mean logarithmic decrement of the maxima above the mean. */
static double log_decrement(const double *y, struct window w)
{
    const double mean = mean_of(y, w.from, w.to);
    double first = 0.0, last = 0.0;
    int peaks = 0;
    for (int i = w.from + 1; i + 1 < w.to; i++) {
        if (y[i] > y[i - 1] && y[i] >= y[i + 1] && y[i] > mean) {
            last = y[i] - mean;
            first = peaks == 0 ? last : first;
            peaks++;
        }
    }
    return peaks >= 3 ? log(first / last) / (peaks - 1) : (double)NAN;
}

/* Distance of two frequencies in e-folds; infinite where one is not positive. */
static double log_distance(double f, double frequency)
{
    return f > 0.0 && frequency > 0.0 ? fabs(log(f / frequency)) : HUGE_VAL;
}

/* Index of the root that is the torsion: the one nearest in frequency, at most half as much or
 * twice. An envelope that is not exponential (an approach to a limit cycle) is fitted by several
 * roots of almost one frequency: of those the largest stands for it. */
static int find_torsion(const struct damping_result *r, double frequency)
{
    int nearest = -1;
    double distance = log(2.0);
    for (int k = 0; k < r->n_root; k++) {
        const double d = log_distance(r->root[k].frequency_hz, frequency);
        if (d < distance) {
            distance = d;
            nearest = k;
        }
    }
    for (int k = 0; k < nearest; k++) { /* by falling amplitude: the first of them is the largest */
        if (log_distance(r->root[k].frequency_hz, r->root[nearest].frequency_hz) < same_frequency) {
            return k;
        }
    }
    return nearest;
}

/* Index of the least damped of the roots that count at the end of the window: what the motion turns
 * into. Smaller ones may be noise of the fit. */
static int find_least_stable(const struct damping_result *r, const double *size_at_end)
{
    double largest = 0.0;
    for (int k = 0; k < r->n_root; k++) {
        largest = fmax(largest, size_at_end[k]);
    }
    int least = -1;
    for (int k = 0; k < r->n_root; k++) {
        if (size_at_end[k] >= share_least * largest &&
            (least < 0 || r->root[k].ratio < r->root[least].ratio)) {
            least = k;
        }
    }
    return least;
}

/* Size a root reaches within the window. */
static double reach(const struct pencil_root *p, double length)
{
    return p->amplitude * exp(fmax(0.0, p->sigma * length));
}

/* Is it the offset of the signal and its drift: a root that does not swing within the window and
 * neither grows e-fold nor comes near the size of the others? */
static bool is_drift(const struct pencil_fit *fit, const struct pencil_root *p, double length)
{
    double largest = 0.0;
    for (int k = 0; k < fit->n; k++) {
        largest = fmax(largest, reach(&fit->root[k], length));
    }
    return p->omega * length < NUM_PI &&
           (p->sigma * length < 1.0 || reach(p, length) < 0.1 * largest);
}

static void take_roots(const struct pencil_fit *fit, double dt, int block, double length,
                       struct damping_result *out)
{
    const double nyquist = NUM_PI / (dt * block);
    double size_at_end[LIMIT_ROOTS];
    for (int k = 0; k < fit->n && out->n_root < LIMIT_ROOTS; k++) {
        const struct pencil_root *p = &fit->root[k];
        if (is_drift(fit, p, length) || p->omega > 0.999 * nyquist) {
            continue;
        }
        const double complex lambda = NUM_COMPLEX(p->sigma, p->omega);
        size_at_end[out->n_root] = p->amplitude * exp(p->sigma * length);
        out->root[out->n_root++] =
            (struct root_result){.frequency_hz = p->omega / (2.0 * NUM_PI),
                                 .ratio = -p->sigma / cabs(lambda),
                                 .amplitude = p->amplitude / block_gain(lambda, dt, block),
                                 .residual = fit->residual};
    }
    out->least_stable = find_least_stable(out, size_at_end);
}

enum status damping_identify(int n, const double *y, double dt, const struct damping_system *system,
                             struct damping_result *out)
{
    struct damping_result r = {.torsion = -1,
                               .least_stable = -1,
                               .hilbert_ratio = (double)NAN,
                               .log_decrement = (double)NAN};
    double sample[SAMPLES_MAX];
    if (n < SAMPLES_MIN) {
        *out = r;
        return ST_OK;
    }
    const struct window w = choose_window(n, y, dt, system->frequency_low);
    const int length = w.to - w.from;
    r.window_from = w.from * dt;
    r.window_to = (w.to - 1) * dt;
    int block = (int)(1.0 / (samples_per_period_high * system->frequency_high * dt));
    block = block < 1 ? 1 : block;
    const int least = (length + SAMPLES_MAX - 1) / SAMPLES_MAX;
    block = block < least ? least : block;
    const int count = length / block >= SAMPLES_MIN ? decimate(y, w, block, sample) : 0;
    enum status st = ST_OK;
    if (count > 0 && damping_fluctuation(sample, 0, count) > 0.0) {
        struct pencil_fit fit;
        st = pencil_identify(count, sample, dt * block, threshold, 2 * system->n_mode + 1, &fit);
        if (st == ST_OK) {
            take_roots(&fit, dt, block, length * dt, &r);
        }
    }
    r.torsion = find_torsion(&r, system->frequency_torsion);
    if (r.n_root > 0 && r.root[0].frequency_hz > 0.0) {
        r.hilbert_ratio = envelope_ratio(y, w, dt, 2.0 * NUM_PI * r.root[0].frequency_hz);
        r.log_decrement = log_decrement(y, w);
    }
    if (st == ST_OK) {
        *out = r;
    }
    return st;
}

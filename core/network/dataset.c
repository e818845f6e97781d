#include "core/network/dataset.h"

#include "core/aero/moving_section.h"
#include "core/num.h"
#include "core/random.h"

#include <assert.h>
#include <stdlib.h>
#include <string.h>

void dataset_def_defaults(struct dataset_def *def)
{
    *def = (struct dataset_def){
        .window = 12.5, .samples_max = 500, .anchors = 500, .held_share = 0.1, .seed = 1};
}

/* Every how many samples one is taken. */
static int stride(const struct dataset_def *def, const struct flow_record *r)
{
    const int n = r->n - flow_record_first(r);
    return (n + def->samples_max - 1) / def->samples_max;
}

static int taken(const struct dataset_def *def, const struct flow_record *r)
{
    const int n = r->n - flow_record_first(r), step = stride(def, r);
    return n > 0 ? (n + step - 1) / step : 0;
}

/* The draw without replacement: Fisher and Yates over those that move. */
static enum status draw(const struct dataset_def *def, int n_record,
                        const struct flow_record *record, struct failure_list *problems,
                        struct dataset *d)
{
    int moving = 0;
    int *index = malloc((size_t)n_record * sizeof *index);
    d->is_held = calloc((size_t)n_record, sizeof *d->is_held);
    if (index == NULL || d->is_held == NULL) {
        free(index);
        return ST_NO_MEMORY;
    }
    for (int i = 0; i < n_record; i++) {
        if (flow_record_moves(&record[i])) {
            index[moving++] = i;
        }
    }
    if (moving < 2) {
        failure_set(failure_add(problems), ST_INVALID, "", "too_few",
                    "two records or more in which the section moves", moving == 1 ? "1" : "0",
                    "one is trained and another one held out: there are too few records");
        free(index);
        return ST_INVALID;
    }
    uint64_t seed = def->seed;
    d->n_held = (int)num_clamp(nearbyint(def->held_share * moving), 1.0, moving - 1.0);
    for (int k = 0; k < d->n_held; k++) {
        const int pick = k + (int)(random_uniform(&seed) * (moving - k));
        const int keep = index[k];
        index[k] = index[pick];
        index[pick] = keep;
        d->is_held[index[k]] = true;
    }
    free(index);
    return ST_OK;
}

/* For n samples in so many groups. */
static enum status room(int n, int groups, struct sample_set *s)
{
    s->x = malloc((size_t)n * NET_IN_COUNT * sizeof *s->x);
    s->y = malloc((size_t)n * NET_OUT_COUNT * sizeof *s->y);
    s->weight = malloc((size_t)n * sizeof *s->weight);
    s->end = malloc((size_t)groups * sizeof *s->end);
    return s->x != NULL && s->y != NULL && s->weight != NULL && s->end != NULL ? ST_OK
                                                                               : ST_NO_MEMORY;
}

/* A sample and its mirror image. */
static void put(const double *x, const double *y, double weight, struct sample_set *s)
{
    static const double mirrored[NET_OUT_COUNT] = {
        [NET_OUT_CL] = -1.0, [NET_OUT_CM] = -1.0, [NET_OUT_CD] = 1.0};
    for (int side = 0; side < 2; side++) {
        double *in = s->x + num_at(0, s->n, NET_IN_COUNT);
        double *increment = s->y + num_at(0, s->n, NET_OUT_COUNT);
        for (int i = 0; i < NET_IN_COUNT; i++) {
            in[i] = side == 0 ? x[i] : -x[i];
        }
        for (int o = 0; o < NET_OUT_COUNT; o++) {
            increment[o] = side == 0 ? y[o] : mirrored[o] * y[o];
        }
        s->weight[s->n] = weight;
        s->n++;
    }
}

/* What was put since the last call is a group. */
static void end_group(struct sample_set *s)
{
    s->end[s->n_group++] = s->n;
}

/* Sums of the squares of the ranges behind the start. */
static void add_ranges(const struct flow_record *r, double square[NET_OUT_COUNT])
{
    static const enum flow_row row[NET_OUT_COUNT] = {
        [NET_OUT_CL] = FLOW_CL, [NET_OUT_CM] = FLOW_CM, [NET_OUT_CD] = FLOW_CD};
    for (int o = 0; o < NET_OUT_COUNT; o++) {
        square[o] += num_sq(flow_record_range(r, row[o], flow_record_first(r)));
    }
}

/* Weight of each record, not yet one in the mean; range (NET_OUT_COUNT) of the moving ones, rms. */
static void weigh(const struct dataset_def *def, int n_record, const struct flow_record *record,
                  double *weight, double *range)
{
    double all[NET_OUT_COUNT] = {0.0};
    int moving = 0;
    for (int i = 0; i < n_record; i++) {
        if (flow_record_moves(&record[i])) {
            add_ranges(&record[i], all);
            moving++;
        }
    }
    for (int i = 0; i < n_record; i++) {
        double own[NET_OUT_COUNT] = {0.0}, size = 0.0;
        add_ranges(&record[i], own);
        for (int k = 0; k < 2; k++) {
            const int o = k == 0 ? NET_OUT_CL : NET_OUT_CM;
            size += all[o] > 0.0 ? 0.5 * moving * own[o] / all[o] : 0.0;
        }
        size = flow_record_moves(&record[i]) ? size : 1.0; /* small, but nothing to measure by */
        weight[i] = def->balance > 0.0 ? 1.0 / (size + num_sq(def->balance)) : 1.0;
    }
    for (int o = 0; o < NET_OUT_COUNT; o++) {
        range[o] = sqrt(all[o] / moving);
    }
}

/* Returns the factor. */
static double level(struct sample_set *s)
{
    double sum = 0.0;
    for (int k = 0; k < s->n; k++) {
        sum += s->weight[k];
    }
    for (int k = 0; k < s->n; k++) {
        s->weight[k] *= s->n / sum;
    }
    return s->n / sum;
}

static enum status add_record(const struct dataset_def *def, const struct polar *polar,
                              const struct flow_record *r, double weight, struct sample_set *s,
                              int *outside_polar)
{
    double *x = malloc((size_t)r->n * (NET_IN_COUNT + NET_OUT_COUNT) * sizeof *x);
    if (x == NULL) {
        return ST_NO_MEMORY;
    }
    double *y = x + (ptrdiff_t)r->n * NET_IN_COUNT;
    flow_record_inputs(r, def->window, x);
    const enum status st = flow_record_march(r, &def->frame, polar, x, y);
    const int first = flow_record_first(r), step = stride(def, r);
    for (int i = first; st == ST_OK && i < r->n; i += step) {
        const double *in = x + num_at(0, i, NET_IN_COUNT);
        const double alpha = in[NET_IN_ALPHA];
        flow_record_subtract(r, first, i, y + num_at(0, i, NET_OUT_COUNT));
        *outside_polar += polar_at(polar, alpha, r->value[num_at(i, FLOW_W, r->n)]).outside;
        put(in, y + num_at(0, i, NET_OUT_COUNT), weight, s);
    }
    end_group(s);
    free(x);
    return st;
}

/* At rest there is no increment, whatever the angle. */
static enum status add_anchors(const struct dataset_def *def, const struct polar *polar,
                               struct sample_set *s)
{
    struct moving_section section;
    double largest = 0.0;
    for (int k = 0; k < s->n; k++) {
        largest = fmax(largest, fabs(s->x[num_at(NET_IN_ALPHA, k, NET_IN_COUNT)]));
    }
    const enum status st = moving_section_init(&def->frame, polar, 1.0, &section);
    for (int k = 0; k < def->anchors && st == ST_OK; k++) {
        const struct moving_state at = {.theta = largest * k / def->anchors};
        const double y[NET_OUT_COUNT] = {0.0};
        (void)moving_section_step(&section, &at, true);
        section.input[NET_IN_MEAN_ALPHA] = at.theta;
        put(section.input, y, 1.0, s);
    }
    if (def->anchors > 0) {
        end_group(s);
    }
    moving_section_done(&section);
    return st;
}

static enum status add_records(const struct dataset_def *def, int n_record,
                               const struct flow_record *record, struct dataset *d)
{
    struct polar *polar = NULL;
    double *weight = malloc((size_t)n_record * sizeof *weight);
    enum status st = weight != NULL ? polar_create(def->polar, &polar) : ST_NO_MEMORY;
    if (st == ST_OK) {
        weigh(def, n_record, record, weight, d->unit);
    }
    for (int i = 0; i < n_record && st == ST_OK; i++) {
        st = add_record(def, polar, &record[i], weight[i], d->is_held[i] ? &d->held : &d->trained,
                        &d->outside_polar);
    }
    if (st == ST_OK) {
        const double root = sqrt(level(&d->trained));
        (void)level(&d->held);
        for (int o = 0; o < NET_OUT_COUNT; o++) {
            d->unit[o] *= root;
        }
        st = add_anchors(def, polar, &d->trained);
    }
    polar_destroy(polar);
    free(weight);
    return st;
}

enum status dataset_build(const struct dataset_def *def, int n_record,
                          const struct flow_record *record, struct failure_list *problems,
                          struct dataset *out)
{
    assert(n_record <= FLOW_RECORDS_MAX);
    struct dataset d = {.n_record = n_record};
    int count[2] = {2 * def->anchors, 0};
    enum status st = n_record > 0 ? ST_OK : ST_INVALID;
    for (int i = 0; i < n_record; i++) {
        if (taken(def, &record[i]) == 0) {
            failure_set(failure_add(problems), ST_INVALID, record[i].name, "too_few",
                        "samples behind the start", NULL, "the record ends before it counts");
            st = ST_INVALID;
        }
    }
    if (n_record == 0) {
        failure_set(failure_add(problems), ST_INVALID, "", "too_few", "records", "0",
                    "there is no record");
    }
    st = st == ST_OK ? draw(def, n_record, record, problems, &d) : st;
    for (int i = 0; i < n_record && st == ST_OK; i++) {
        count[d.is_held[i]] += 2 * taken(def, &record[i]);
    }
    st = st == ST_OK ? room(count[0], n_record + 1, &d.trained) : st;
    st = st == ST_OK ? room(count[1], n_record, &d.held) : st;
    st = st == ST_OK ? add_records(def, n_record, record, &d) : st;
    if (st == ST_OK) {
        *out = d;
    } else {
        dataset_done(&d);
    }
    return st;
}

void dataset_done(struct dataset *d)
{
    free(d->trained.x);
    free(d->trained.y);
    free(d->trained.weight);
    free(d->trained.end);
    free(d->held.x);
    free(d->held.y);
    free(d->held.weight);
    free(d->held.end);
    free(d->is_held);
    *d = (struct dataset){0};
}

/* Mean, deviation and range of row i of x (rows x n). */
struct spread {
    double mean, deviation, least, most;
};

static struct spread spread_of(const double *x, int rows, int n, int i)
{
    struct spread s = {.least = x[i], .most = x[i]};
    for (int k = 0; k < n; k++) {
        const double v = x[num_at(i, k, rows)];
        s.mean += v;
        s.least = fmin(s.least, v);
        s.most = fmax(s.most, v);
    }
    s.mean /= n;
    for (int k = 0; k < n; k++) {
        s.deviation += num_sq(x[num_at(i, k, rows)] - s.mean);
    }
    s.deviation = sqrt(s.deviation / n);
    return s;
}

/* Varies by more than rounding does? */
static double scale_of(const struct spread *s, const char *name, struct failure_list *problems)
{
    const double floor = 1e-9;
    if (s->deviation > floor) {
        return s->deviation;
    }
    failure_set(failure_add(problems), ST_INVALID, name, "constant", "values that vary", NULL,
                "%s is the same in all samples: nothing can be learnt from it", name);
    return 1.0;
}

void dataset_scaling(const struct sample_set *s, struct network_def *net,
                     struct failure_list *problems)
{
    static const char *const output[NET_OUT_COUNT] = {
        [NET_OUT_CL] = "cl", [NET_OUT_CM] = "cm", [NET_OUT_CD] = "cd"};
    for (int i = 0; i < net->n_in; i++) {
        const struct spread v = spread_of(s->x, NET_IN_COUNT, s->n, (int)net->input[i]);
        net->in_offset[i] = v.mean;
        net->in_scale[i] = scale_of(&v, network_input_name(net->input[i]), problems);
        net->hull_min[i] = v.least;
        net->hull_max[i] = v.most;
    }
    for (int o = 0; o < net->n_out; o++) {
        const struct spread v = spread_of(s->y, NET_OUT_COUNT, s->n, (int)net->output[o]);
        net->out_offset[o] = v.mean;
        net->out_scale[o] = scale_of(&v, output[net->output[o]], problems);
    }
}

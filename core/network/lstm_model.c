#include "core/network/lstm_model.h"

#include "core/network/lstm_records.h"
#include "core/num.h"

#include <stdlib.h>
#include <string.h>

void lstm_def_done(struct lstm_def *def)
{
    network_def_done(&def->net);
    free(def->p);
    def->p = NULL;
}

struct lstm lstm_shape(const struct lstm_def *def)
{
    return (struct lstm){
        .n_in = def->net.n_in, .n_hidden = def->net.n_hidden, .n_out = def->net.n_out};
}

/* Phases of a record that is sampled more often than the memory steps run side by side. */
struct phases {
    int stride, n; /* n steps each */
    lanes *x;      /* (n_in x n), owned */
    lanes *y;      /* (n_out x n) */
    lanes *tape;   /* (tape rows x n + 1) */
};

static enum status phases_init(const struct lstm_def *def, const struct flow_record *r,
                               struct phases *s)
{
    const struct lstm shape = lstm_shape(def);
    const int stride = lstm_stride(r, def->step);
    if (stride == 0) {
        return ST_INVALID;
    }
    const size_t n = (size_t)((r->n + stride - 1) / stride);
    const size_t rows = (size_t)lstm_tape_rows(&shape), io = (size_t)(shape.n_in + shape.n_out);
    lanes *block = aligned_alloc(sizeof(lanes), (n * (io + rows) + rows) * sizeof *block);
    if (block == NULL) {
        return ST_NO_MEMORY;
    }
    *s = (struct phases){.stride = stride,
                         .n = (int)n,
                         .x = block,
                         .y = block + n * (size_t)shape.n_in,
                         .tape = block + n * io};
    return ST_OK;
}

enum status lstm_predict(const struct lstm_def *def, const struct flow_record *r, const double *in,
                         double *y)
{
    const struct lstm shape = lstm_shape(def);
    struct phases s = {0};
    const enum status st = phases_init(def, r, &s);
    if (st != ST_OK) {
        return st;
    }
    memset(y, 0, (size_t)r->n * NET_OUT_COUNT * sizeof *y);
    for (int first = 0; first < s.stride; first += LANES) {
        const int here = s.stride - first < LANES ? s.stride - first : LANES;
        memset(s.x, 0, (size_t)s.n * (size_t)shape.n_in * sizeof *s.x);
        memset(s.tape, 0, (size_t)lstm_tape_rows(&shape) * sizeof *s.tape);
        for (int l = 0; l < here; l++) {
            lstm_pack_inputs(r, &def->net, in, first + l, s.stride, 1.0, s.n, l, s.x);
        }
        lstm_forward(&shape, def->p, s.n, s.x, s.tape, s.y);
        for (int i = 0; i < r->n; i++) {
            const int lane = i % s.stride - first;
            for (int o = 0; o < shape.n_out && lane >= 0 && lane < here; o++) {
                const double v = s.y[num_at(o, i / s.stride, shape.n_out)][lane];
                y[num_at((int)def->net.output[o], i, NET_OUT_COUNT)] =
                    def->net.out_offset[o] + def->net.out_scale[o] * v;
            }
        }
    }
    free(s.x);
    return ST_OK;
}

enum status lstm_assess(const struct flow_record *r, double window, const struct polar *polar,
                        const struct lstm_def *net, struct assessment *out)
{
    const size_t n = (size_t)r->n;
    double *x = malloc(n * (NET_IN_COUNT + 2 * NET_OUT_COUNT) * sizeof *x);
    if (x == NULL) {
        return ST_NO_MEMORY;
    }
    double *steady = x + n * NET_IN_COUNT, *model = steady + n * NET_OUT_COUNT;
    flow_record_inputs(r, window, x);
    flow_record_steady(r, polar, steady);
    enum status st = lstm_predict(net, r, x, model);
    for (size_t i = 0; i < n * NET_OUT_COUNT && st == ST_OK; i++) {
        model[i] += steady[i];
    }
    st = st == ST_OK ? assess_coefficients(r, steady, model, out) : st;
    free(x);
    return st;
}

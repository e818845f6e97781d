#include "server/series_read.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

/* "modal_amplitude" and "modal_amplitude[2]" both ask for the column modal_amplitude[2]. */
static bool column_matches(const char *column, const char *asked)
{
    const size_t n = strlen(asked);
    return strncmp(column, asked, n) == 0 && (column[n] == '\0' || column[n] == '[');
}

static int first_unknown(const struct series_data *all, int n_channel, const char *const *channel)
{
    for (int i = 0; i < n_channel; i++) {
        bool known = false;
        for (int j = 0; j < all->n_column; j++) {
            known = known || column_matches(all->column[j].name, channel[i]);
        }
        if (!known) {
            return i;
        }
    }
    return -1;
}

static bool is_asked(const char *column, int n_channel, const char *const *channel)
{
    bool asked = n_channel == 0;
    for (int i = 0; i < n_channel; i++) {
        asked = asked || column_matches(column, channel[i]);
    }
    return asked;
}

/* Samples with from <= t <= to, where the ends may miss a sample's time by rounding. */
static void window(const struct series_data *all, double from_s, double to_s, int *first, int *n)
{
    const double slack = 1e-6;
    double lo = ceil((from_s - all->t0) / all->step - slack);
    double hi = floor((to_s - all->t0) / all->step + slack);
    lo = lo > 0.0 ? lo : 0.0;
    hi = hi < all->n - 1 ? hi : all->n - 1;
    *first = lo <= hi ? (int)lo : 0;
    *n = lo <= hi ? (int)(hi - lo) + 1 : 0;
}

/* Keeps the asked columns of *data and fills in their samples. */
static enum store_status read_samples(struct store_session *r, const struct series_ask *ask,
                                      struct series_data *data)
{
    int first = 0, n = 0, kept = 0;
    window(data, ask->from_s, ask->to_s, &first, &n);
    enum store_status st = STORE_OK;
    for (int j = 0; st == STORE_OK && j < data->n_column; j++) {
        if (!is_asked(data->column[j].name, ask->n_channel, ask->channel)) {
            continue;
        }
        double *value = malloc((size_t)(n > 0 ? n : 1) * sizeof *value);
        data->column[kept] = data->column[j];
        data->column[kept].value = value;
        st = value == NULL ? STORE_ERROR : STORE_OK;
        if (st == STORE_OK && n > 0) {
            st = r->ops->get_samples(r, ask->id, j, first, n, value);
        }
        kept++;
    }
    data->n_column = kept;
    data->t0 += first * data->step;
    data->n = n;
    return st;
}

enum store_status series_read(struct store_session *s, const struct series_ask *ask,
                              struct series_data *out, int *bad_channel)
{
    struct series_data data = {.n = 0};
    *bad_channel = -1;
    enum store_status st = s->ops->get_series(s, ask->id, &data);
    if (st == STORE_OK) {
        *bad_channel = first_unknown(&data, ask->n_channel, ask->channel);
        st = *bad_channel >= 0 ? STORE_NONE : read_samples(s, ask, &data);
    }
    if (st == STORE_OK) {
        *out = data;
    } else {
        series_data_done(&data);
    }
    return st;
}

#include "api/series_out.h"

#include <assert.h>
#include <math.h>
#include <stdlib.h>

/* Keeps the extremes of samples [first, last), in order of time. */
static void bucket_extremes(const double *value, int first, int last, int kept[2])
{
    int low = first, high = last - 1; /* distinct also when all values are equal */
    bool equal = true;
    for (int i = first; i < last; i++) {
        equal = equal && !(value[i] < value[low]) && !(value[i] > value[low]);
        /* A value that is not a number loses every comparison, and the place to any other. */
        low = value[i] < value[low] || isnan(value[low]) ? i : low;
        high = value[i] > value[high] || isnan(value[high]) ? i : high;
    }
    if (equal || low == high) {
        low = first;
        high = last - 1;
    }
    kept[0] = low < high ? low : high;
    kept[1] = low < high ? high : low;
}

int series_minmax(int n, const double *value, int points, int *index)
{
    assert(points >= 2);
    assert(n > points);
    const int buckets = points / 2;
    for (int b = 0; b < buckets; b++) {
        const int first = (int)((long long)n * b / buckets);
        const int last = (int)((long long)n * (b + 1) / buckets);
        bucket_extremes(value, first, last, index + 2 * (ptrdiff_t)b);
    }
    return 2 * buckets;
}

static bool is_thinned(const struct series_data *data, int points)
{
    return points >= 2 && data->n > points;
}

static double time_at(const struct series_data *data, int i)
{
    return data->t0 + i * data->step;
}

static void write_column(struct json_out *out, const struct series_data *data,
                         const struct series_column *column, int points, int *index)
{
    json_key(out, column->name);
    json_object_begin(out);
    if (index == NULL) {
        json_key_numbers(out, "value", data->n, column->value, 1, 1.0);
    } else {
        const int kept = series_minmax(data->n, column->value, points, index);
        json_key(out, "time_s");
        json_array_begin(out);
        for (int i = 0; i < kept; i++) {
            json_number(out, time_at(data, index[i]));
        }
        json_array_end(out);
        json_key(out, "value");
        json_array_begin(out);
        for (int i = 0; i < kept; i++) {
            json_number(out, column->value[index[i]]);
        }
        json_array_end(out);
    }
    json_object_end(out);
}

void series_out_json(struct json_out *out, const struct series_data *data, int points)
{
    const bool thinned = is_thinned(data, points);
    int *index = thinned ? malloc((size_t)points * sizeof *index) : NULL;
    if (thinned && index == NULL) {
        out->failed = true;
        return;
    }
    json_object_begin(out);
    json_key_number(out, "t0_s", data->t0);
    json_key_number(out, "step_s", data->step);
    json_key_integer(out, "samples", data->n);
    json_key(out, "thinned");
    json_boolean(out, thinned);
    json_key(out, "channels");
    json_object_begin(out);
    for (int j = 0; j < data->n_column; j++) {
        write_column(out, data, &data->column[j], points, index);
    }
    json_object_end(out);
    json_object_end(out);
    free(index);
}

static void csv_number(struct json_out *out, double value)
{
    char text[NUMBER_TEXT_SIZE];
    if (isfinite(value)) {
        const size_t length = number_text(value, text);
        json_out_bytes(out, text, length);
    }
}

/* Each column with its own times. index: kept samples, (kept x n_column). */
static void csv_thinned(struct json_out *out, const struct series_data *data, int kept,
                        const int *index)
{
    for (int j = 0; j < data->n_column; j++) {
        json_out_text(out, j > 0 ? "," : "");
        json_out_text(out, data->column[j].name);
        json_out_text(out, ".time_s,");
        json_out_text(out, data->column[j].name);
    }
    json_out_text(out, "\n");
    for (int i = 0; i < kept; i++) {
        for (int j = 0; j < data->n_column; j++) {
            const int sample = index[i + (ptrdiff_t)j * kept];
            json_out_text(out, j > 0 ? "," : "");
            csv_number(out, time_at(data, sample));
            json_out_text(out, ",");
            csv_number(out, data->column[j].value[sample]);
        }
        json_out_text(out, "\n");
    }
}

static void csv_whole(struct json_out *out, const struct series_data *data)
{
    json_out_text(out, "time_s");
    for (int j = 0; j < data->n_column; j++) {
        json_out_text(out, ",");
        json_out_text(out, data->column[j].name);
    }
    json_out_text(out, "\n");
    for (int i = 0; i < data->n; i++) {
        csv_number(out, time_at(data, i));
        for (int j = 0; j < data->n_column; j++) {
            json_out_text(out, ",");
            csv_number(out, data->column[j].value[i]);
        }
        json_out_text(out, "\n");
    }
}

void series_out_csv(struct json_out *out, const struct series_data *data, int points)
{
    if (!is_thinned(data, points)) {
        csv_whole(out, data);
        return;
    }
    const int kept = 2 * (points / 2);
    int *index =
        calloc((size_t)kept * (size_t)(data->n_column > 0 ? data->n_column : 1), sizeof *index);
    if (index == NULL) {
        out->failed = true;
        return;
    }
    for (int j = 0; j < data->n_column; j++) {
        (void)series_minmax(data->n, data->column[j].value, points, index + (ptrdiff_t)j * kept);
    }
    csv_thinned(out, data, kept, index);
    free(index);
}

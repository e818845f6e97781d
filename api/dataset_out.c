/* What GET /v1/datasets and its entries show. */
#include "api/dataset.h"
#include "core/num.h"

static const double *row_of(const struct flow_record *r, int row)
{
    return r->value + num_at(0, row, r->n);
}

static void write_range(struct json_out *out, const char *key, double low, double high)
{
    json_key(out, key);
    json_object_begin(out);
    json_key_number(out, "min", low);
    json_key_number(out, "max", high);
    json_object_end(out);
}

static void row_range(const struct flow_record *r, int row, double *low, double *high)
{
    const double *v = row_of(r, row);
    const double unit = row == FLOW_THETA ? 180.0 / NUM_PI : 1.0;
    for (int i = 0; i < r->n; i++) {
        *low = fmin(*low, v[i] * unit);
        *high = fmax(*high, v[i] * unit);
    }
}

static const int ranged[] = {FLOW_THETA, FLOW_W, FLOW_CL, FLOW_CD, FLOW_CM};
enum { RANGED = sizeof ranged / sizeof ranged[0] };

void dataset_write_head(struct json_out *out, const struct dataset_entry *e)
{
    long long samples = 0;
    json_key_string(out, "name", e->name);
    json_key_string(out, "hash", e->hash);
    json_key(out, "description");
    json_raw(out, e->description);
    json_key(out, "provenance");
    json_raw(out, e->provenance);
    json_key_integer(out, "count", e->n_record);
    for (int i = 0; i < e->n_record; i++) {
        samples += e->record[i].n;
    }
    json_key_integer(out, "samples", samples);
    for (int k = 0; k < RANGED; k++) {
        double low = INFINITY, high = (double)-INFINITY;
        for (int i = 0; i < e->n_record; i++) {
            row_range(&e->record[i], ranged[k], &low, &high);
        }
        write_range(out, dataset_columns[DATASET_FLOW + ranged[k]], low, high);
    }
}

void dataset_write_records(struct json_out *out, const struct dataset_entry *e)
{
    json_array_begin(out);
    for (int i = 0; i < e->n_record; i++) {
        const struct flow_record *r = &e->record[i];
        json_object_begin(out);
        json_key_string(out, "name", r->name);
        json_key_integer(out, "samples", r->n);
        json_key_number(out, "step_c_v", flow_record_step(r));
        json_key_number(out, "from_c_v", row_of(r, FLOW_TIME)[0]);
        json_key_number(out, "to_c_v", row_of(r, FLOW_TIME)[r->n - 1]);
        json_key_number(out, "period_c_v", r->period);
        json_key_number(out, "start_c_v", r->start);
        json_key(out, "moves");
        json_boolean(out, flow_record_moves(r));
        for (int k = 0; k < RANGED; k++) {
            double low = INFINITY, high = (double)-INFINITY;
            row_range(r, ranged[k], &low, &high);
            write_range(out, dataset_columns[DATASET_FLOW + ranged[k]], low, high);
        }
        json_object_end(out);
    }
    json_array_end(out);
}

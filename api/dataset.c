#include "api/dataset.h"

#include "api/embedded.h"
#include "api/hash.h"
#include "core/num.h"

#include <cjson/cJSON.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <zstd.h>

enum { EXPANDED_MAX = 512 << 20, LEVEL = 6 };

const char dataset_built_in[] = "plate-4pct";

void dataset_entry_done(struct dataset_entry *e)
{
    for (int i = 0; i < e->n_record; i++) {
        free(e->record[i].value);
    }
    free(e->record);
    free(e->description);
    free(e->provenance);
    *e = (struct dataset_entry){0};
}

/* -- checks ----------------------------------------------------------------------------- */

static void refuse(struct failure_list *out, int i, const char *key, const char *code,
                   const char *expected, const char *detail)
{
    char pointer[96];
    (void)snprintf(pointer, sizeof pointer, "/records/%d/%s", i, key);
    failure_set(failure_add(out), ST_INVALID, pointer, code, expected, NULL, "%s", detail);
}

/* The core names the record where the document counts. */
static void check_flow(const struct flow_record *r, int i, struct failure_list *problems)
{
    const int first = problems->count;
    flow_record_check(r, problems);
    for (int k = first; k < problems->count; k++) {
        char column[96];
        const char *slash = strrchr(problems->item[k].pointer, '/');
        (void)snprintf(column, sizeof column, "%.90s", slash != NULL ? slash + 1 : "");
        (void)snprintf(problems->item[k].pointer, sizeof problems->item[k].pointer,
                       "/records/%d/%s", i, column);
    }
}

static bool is_constant(const struct flow_record *r, enum flow_row row)
{
    const double *v = r->value + num_at(0, (int)row, r->n);
    int i = 1;
    while (i < r->n && v[i] == v[0]) {
        i++;
    }
    return i == r->n;
}

static void check_record(const struct dataset_entry *e, int i, struct failure_list *problems)
{
    const struct flow_record *r = &e->record[i];
    const int before = problems->total;
    if (!shelf_name_is_allowed(r->name) || strchr(r->name, '/') != NULL) {
        refuse(problems, i, "name", "bad_name", "1..63 letters, digits, and any of ._+-",
               "the name of the record is not admissible");
    }
    for (int k = 0; k < i; k++) {
        if (strcmp(e->record[k].name, r->name) == 0) {
            refuse(problems, i, "name", "duplicate_name", "distinct names",
                   "two records have this name, or its lines do not stand together");
            break;
        }
    }
    check_flow(r, i, problems);
    if (problems->total > before) {
        return;
    }
    if (!(r->period >= 0.0)) {
        refuse(problems, i, "period_c_v", "out_of_range", "0 for none, or more", "the period");
    }
    if (flow_record_first(r) >= r->n) {
        refuse(problems, i, "start_c_v", "out_of_range", "a time before the last sample",
               "every sample is before the start");
    }
    static const struct {
        enum flow_row row;
        const char *key;
    } channel[] = {{FLOW_CL, "cl"}, {FLOW_CM, "cm"}};
    for (int k = 0; k < 2 && flow_record_moves(r); k++) {
        if (is_constant(r, channel[k].row)) {
            refuse(problems, i, channel[k].key, "constant", "values that answer the motion",
                   "the section moves and the coefficient stays the same");
        }
    }
}

void dataset_check(const struct dataset_entry *e, struct failure_list *problems)
{
    const int before = problems->total;
    int moving = 0;
    for (int i = 0; i < e->n_record; i++) {
        check_record(e, i, problems);
        moving += e->record[i].n > 0 && flow_record_moves(&e->record[i]);
    }
    if (problems->total == before && moving < 2) {
        char got[48];
        (void)snprintf(got, sizeof got, "%d", moving);
        failure_set(failure_add(problems), ST_INVALID, "/records", "too_few",
                    "at least two records that move", got,
                    "one record is held out of a training: a single one cannot be both");
    }
}

/* -- JSON ------------------------------------------------------------------------------- */

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

/* -- compression ------------------------------------------------------------------------ */

void *dataset_compress(const char *text, size_t size, size_t *packed_size)
{
    const size_t bound = ZSTD_compressBound(size);
    void *packed = malloc(bound);
    const size_t n = packed != NULL ? ZSTD_compress(packed, bound, text, size, LEVEL) : 0;
    if (packed == NULL || ZSTD_isError(n)) {
        free(packed);
        return NULL;
    }
    *packed_size = n;
    return packed;
}

char *dataset_expand(const void *packed, size_t size, size_t *text_size)
{
    const unsigned long long n = ZSTD_getFrameContentSize(packed, size);
    if (n > EXPANDED_MAX) { /* unknown and damaged are beyond it, too */
        return NULL;
    }
    char *text = malloc((size_t)n + 1);
    if (text == NULL || ZSTD_decompress(text, (size_t)n, packed, size) != n) {
        free(text);
        return NULL;
    }
    text[n] = '\0';
    *text_size = (size_t)n;
    return text;
}

/* -- loading ---------------------------------------------------------------------------- */

static enum service_status expand(const void *packed, size_t size, struct dataset_entry *out)
{
    size_t n = 0;
    char *text = dataset_expand(packed, size, &n);
    struct failure_list *problems = calloc(1, sizeof *problems);
    const bool read =
        text != NULL && problems != NULL && dataset_read_csv(text, n, out, problems) == ST_OK;
    if (read) {
        hash_text(text, n, out->hash);
    }
    free(problems);
    free(text);
    return read ? SERVICE_OK : SERVICE_ERROR;
}

static enum service_status load_built_in(struct dataset_entry *out)
{
    static const char description[] = "\"Coefficients of the square-edged 4 % plate in pitch and "
                                      "plunge, from flow computations\"";
    out->description = strdup(description);
    return out->description != NULL
               ? expand(dataset_files[0].data, embedded_size(&dataset_files[0]), out)
               : SERVICE_ERROR;
}

enum service_status dataset_load(const struct library *lib, const char *reference,
                                 struct dataset_entry *out, int *version)
{
    const struct shelf *shelf = library_shelf(lib);
    struct dataset_entry e = {.n_record = 0};
    struct shelf_entry kept = {.version = 1};
    int wanted = 0;
    if (!shelf_reference(reference, e.name, &wanted)) {
        return SERVICE_NOT_FOUND;
    }
    enum service_status st = SERVICE_NOT_FOUND;
    if (strcmp(e.name, dataset_built_in) == 0) {
        st = wanted <= 1 ? load_built_in(&e) : SERVICE_NOT_FOUND;
    } else if (shelf != NULL) {
        st = shelf->get(shelf->ctx, SHELF_DATASET, e.name, wanted, &kept);
        if (st == SERVICE_OK) {
            st = expand(kept.data, kept.size, &e);
        }
    }
    if (st == SERVICE_OK) {
        if (version != NULL) {
            *version = kept.version;
        }
        *out = e;
    } else {
        dataset_entry_done(&e);
    }
    shelf_entry_done(&kept);
    return st;
}

enum service_status dataset_find(const struct library *lib, const char *reference,
                                 char name[LIMIT_NAME], int *version, char hash[LIMIT_HASH])
{
    const struct shelf *shelf = library_shelf(lib);
    int wanted = 0;
    if (!shelf_reference(reference, name, &wanted)) {
        return SERVICE_NOT_FOUND;
    }
    if (strcmp(name, dataset_built_in) == 0) {
        struct dataset_entry e = {.n_record = 0};
        const enum service_status st = dataset_load(lib, reference, &e, version);
        memcpy(hash, e.hash, sizeof e.hash);
        dataset_entry_done(&e);
        return st;
    }
    struct shelf_entry kept = {.version = 0};
    const enum service_status st = shelf != NULL
                                       ? shelf->get(shelf->ctx, SHELF_DATASET, name, wanted, &kept)
                                       : SERVICE_NOT_FOUND;
    if (st == SERVICE_OK) {
        *version = kept.version;
        memcpy(hash, kept.hash, sizeof kept.hash);
    }
    shelf_entry_done(&kept);
    return st;
}

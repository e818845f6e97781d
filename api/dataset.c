#include "api/dataset.h"

#include "api/pack.h"
#include "api/shelf.h"
#include "core/num.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <zstd.h>

enum { EXPANDED_MAX = 512 << 20, LEVEL = 6 };

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

const char dataset_built_in[] = "plate-4pct";

bool dataset_is_built_in(const char *name)
{
    return strcmp(name, dataset_built_in) == 0;
}

/* -- compression ------------------------------------------------------------------------ */

void *dataset_compress(const char *text, size_t size, size_t *packed_size)
{
    return pack_text(text, size, LEVEL, packed_size);
}

char *dataset_expand(const void *packed, size_t size, size_t *text_size)
{
    const unsigned long long n = ZSTD_getFrameContentSize(packed, size);
    if (n > EXPANDED_MAX) { /* unknown and damaged are beyond it, too */
        return NULL;
    }
    char *text = unpack_text(packed, size, (size_t)n);
    if (text != NULL) {
        *text_size = (size_t)n;
    }
    return text;
}

/* api/dataset.h
 * Datasets: records of the flow about a moving section as one entry of the library.
 *
 * A struct dataset_entry owns everything in it. The form it is kept, hashed and sent in is one CSV
 * text with a line for each sample: `record`, `period_c_v`, `start_c_v`, then the columns of
 * core/network/dataset.h, angles in degrees. No function keeps state; the library must outlive a
 * call. */
#ifndef AEROM_API_DATASET_H
#define AEROM_API_DATASET_H

#include "api/json_out.h"
#include "api/library.h"
#include "api/reader.h"
#include "core/network/dataset.h"

struct dataset_entry {
    char name[LIMIT_NAME];
    char hash[LIMIT_HASH]; /* of the CSV text */
    char *description;     /* JSON text or NULL, as is the next one */
    char *provenance;
    int n_record;
    struct flow_record *record; /* owned, with their values */
};

/* Accepts a zeroed struct. */
void dataset_entry_done(struct dataset_entry *e);

/* Columns of the text in order; the first are those of a record, then those of enum flow_row. */
enum {
    DATASET_RECORD,
    DATASET_PERIOD,
    DATASET_START,
    DATASET_FLOW,
    DATASET_COLUMNS = DATASET_FLOW + FLOW_ROWS
};
extern const char *const dataset_columns[]; /* ends with NULL */
/* May the column be absent? Period, start and plunge are then zero. */
bool dataset_column_is_optional(int column);

/* The records of a CSV text, whose lines of one record stand together. Problems are appended with
 * the line in their pointer. On failure the caller still frees *out. */
MUST_CHECK enum status dataset_read_csv(const char *text, size_t size, struct dataset_entry *out,
                                        struct failure_list *problems);
/* {"name", "description", "provenance", "records": [{"name", "period_c_v", "start_c_v", columns}]}.
 */
void dataset_read_json(struct reader *r, const struct cJSON *json, struct dataset_entry *out);
/* Appends what is wrong: names, flow_record_check, constant coefficients of a moving record, fewer
 * than two that move. Pointers are /records/INDEX/COLUMN. */
void dataset_check(const struct dataset_entry *e, struct failure_list *problems);

void dataset_write_csv(struct json_out *out, const struct dataset_entry *e);
/* A room for n more samples of a new record; NULL when out of memory. */
struct flow_record *dataset_add_record(struct dataset_entry *e, const char *name, int n);

/* Members: what a list shows. */
void dataset_write_head(struct json_out *out, const struct dataset_entry *e);
/* An array with spans and ranges of every record. */
void dataset_write_records(struct json_out *out, const struct dataset_entry *e);
/* A drawing of one record: angle and plunge, c_l, c_m over time. */
void dataset_write_svg(struct json_out *out, const struct flow_record *r);

/* Compressed text, malloc'ed, and back (zero-terminated); NULL when out of memory or damaged. */
void *dataset_compress(const char *text, size_t size, size_t *packed_size);
char *dataset_expand(const void *packed, size_t size, size_t *text_size);

/* The one that is compiled in, and what a list shows of it: members as dataset_write_head's. */
extern const char dataset_built_in[];
bool dataset_is_built_in(const char *name);
const char *dataset_built_in_head(void);
/* Loads what "name" or "name@version" refers to, without its notes, which stand in the head of
 * *kept (NULL: not asked for; of the one compiled in it has head and version only), freed with
 * shelf_entry_done. SERVICE_NOT_FOUND. */
enum service_status dataset_load(const struct library *lib, const char *reference,
                                 struct dataset_entry *out, struct shelf_entry *kept);
/* Version and hash only. */
enum service_status dataset_find(const struct library *lib, const char *reference,
                                 char name[LIMIT_NAME], int *version, char hash[LIMIT_HASH]);

#endif

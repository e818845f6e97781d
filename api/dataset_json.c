/* Datasets as JSON documents. */
#include "api/dataset.h"
#include "api/json.h"
#include "core/num.h"

#include <cjson/cJSON.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

static bool expect(struct reader *r, bool ok, const char *what, const cJSON *json)
{
    if (!ok) {
        reader_problem(r, json == NULL ? "required" : "wrong_type", what, json,
                       json == NULL ? "the member is missing" : "the value must be %s", what);
    }
    return ok;
}

static void report_unknown(struct reader *r, const cJSON *json, const char *const *keys)
{
    for (const cJSON *c = json->child; c != NULL; c = c->next) {
        int k = 0;
        while (keys[k] != NULL && strcmp(keys[k], c->string) != 0) {
            k++;
        }
        if (keys[k] == NULL) {
            char expected[128];
            const size_t mark = reader_enter_key(r, c->string);
            reader_join(keys, sizeof expected, expected);
            reader_problem(r, "unknown_key", expected, c, "there is no such key here");
            reader_leave(r, mark);
        }
    }
}

static void read_row(struct reader *r, const cJSON *json, struct flow_record *record, int row)
{
    const double unit = row == FLOW_THETA ? NUM_PI / 180.0 : 1.0;
    if (!expect(r, cJSON_IsArray(json), "an array of numbers", json)) {
        return;
    }
    if (cJSON_GetArraySize(json) != record->n) {
        reader_problem(r, "wrong_length", "as many values as t", json,
                       "the list has %d entries, t has %d", cJSON_GetArraySize(json), record->n);
        return;
    }
    int i = 0;
    for (const cJSON *c = json->child; c != NULL; c = c->next, i++) {
        if (!cJSON_IsNumber(c)) {
            const size_t mark = reader_enter_index(r, i);
            (void)expect(r, false, "a number", c);
            reader_leave(r, mark);
            return;
        }
        record->value[num_at(i, row, record->n)] = c->valuedouble * unit;
    }
}

static double read_number(struct reader *r, const cJSON *json, const char *key)
{
    const cJSON *c = cJSON_GetObjectItemCaseSensitive(json, key);
    if (c == NULL) {
        return 0.0;
    }
    const size_t mark = reader_enter_key(r, key);
    (void)expect(r, cJSON_IsNumber(c), "a number", c);
    reader_leave(r, mark);
    return c->valuedouble;
}

/* The text of a required name, "" when it is none (reported). */
static void read_name(struct reader *r, const cJSON *json, char out[LIMIT_NAME])
{
    const cJSON *c = cJSON_GetObjectItemCaseSensitive(json, "name");
    const size_t mark = reader_enter_key(r, "name");
    out[0] = '\0';
    if (expect(r, cJSON_IsString(c) && strlen(c->valuestring) < LIMIT_NAME, "a name of 1..63 bytes",
               c)) {
        (void)snprintf(out, LIMIT_NAME, "%s", c->valuestring);
    }
    reader_leave(r, mark);
}

static void read_record(struct reader *r, const cJSON *json, struct dataset_entry *out)
{
    const char *keys[DATASET_COLUMNS + 1];
    memcpy(keys, dataset_columns, sizeof keys);
    keys[DATASET_RECORD] = "name";
    char name[LIMIT_NAME];
    if (!expect(r, cJSON_IsObject(json), "an object", json)) {
        return;
    }
    report_unknown(r, json, keys);
    read_name(r, json, name);
    const cJSON *t = cJSON_GetObjectItemCaseSensitive(json, "t");
    struct flow_record *record =
        dataset_add_record(out, name, cJSON_IsArray(t) ? cJSON_GetArraySize(t) : 0);
    if (record == NULL) {
        reader_no_memory(r);
        return;
    }
    record->period = read_number(r, json, "period_c_v");
    record->start = read_number(r, json, "start_c_v");
    for (int k = 0; k < FLOW_ROWS; k++) {
        const char *key = keys[DATASET_FLOW + k];
        const cJSON *row = cJSON_GetObjectItemCaseSensitive(json, key);
        if (row != NULL || !dataset_column_is_optional(DATASET_FLOW + k)) {
            const size_t mark = reader_enter_key(r, key);
            read_row(r, row, record, k);
            reader_leave(r, mark);
        }
    }
}

static char *note(struct reader *r, const cJSON *json, const char *key)
{
    const cJSON *c = cJSON_GetObjectItemCaseSensitive(json, key);
    struct json_out out = {0};
    if (c == NULL || cJSON_IsNull(c)) {
        return NULL;
    }
    json_value(&out, c);
    char *text = json_out_take(&out, NULL);
    if (text == NULL) {
        reader_no_memory(r);
    }
    return text;
}

void dataset_read_json(struct reader *r, const struct cJSON *json, struct dataset_entry *out)
{
    static const char *const keys[] = {"name", "description", "provenance", "records", NULL};
    if (!expect(r, cJSON_IsObject(json), "an object", json)) {
        return;
    }
    report_unknown(r, json, keys);
    read_name(r, json, out->name);
    const cJSON *description = cJSON_GetObjectItemCaseSensitive(json, "description");
    if (description != NULL && !cJSON_IsNull(description)) {
        const size_t mark = reader_enter_key(r, "description");
        (void)expect(r, cJSON_IsString(description), "a string", description);
        reader_leave(r, mark);
    }
    out->description = note(r, json, "description");
    out->provenance = note(r, json, "provenance");
    const cJSON *records = cJSON_GetObjectItemCaseSensitive(json, "records");
    const size_t mark = reader_enter_key(r, "records");
    if (expect(r, cJSON_IsArray(records), "an array of records", records)) {
        int i = 0;
        for (const cJSON *c = records->child; c != NULL && i < FLOW_RECORDS_MAX; c = c->next, i++) {
            const size_t at = reader_enter_index(r, i);
            read_record(r, c, out);
            reader_leave(r, at);
        }
    }
    reader_leave(r, mark);
}

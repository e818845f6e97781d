/* Datasets as CSV text: the form they are kept and hashed in. */
#include "api/dataset.h"
#include "core/num.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

enum { CELLS_MAX = 64 };

const char *const dataset_columns[] = {[DATASET_RECORD] = "record",
                                       [DATASET_PERIOD] = "period_c_v",
                                       [DATASET_START] = "start_c_v",
#define COLUMN(code, name) [DATASET_FLOW + (code)] = (name),
                                       FLOW_ROW_LIST(COLUMN)
#undef COLUMN
                                           [DATASET_COLUMNS] = NULL};

bool dataset_column_is_optional(int column)
{
    return column == DATASET_PERIOD || column == DATASET_START ||
           (column >= DATASET_FLOW + FLOW_W && column <= DATASET_FLOW + FLOW_W_ACCELERATION);
}

/* -- writing ---------------------------------------------------------------------------- */

static void write_cell(struct json_out *out, double value)
{
    char text[NUMBER_TEXT_SIZE];
    json_out_bytes(out, ",", 1);
    json_out_bytes(out, text, number_text(value, text));
}

static void write_line(struct json_out *out, const struct flow_record *r, int i)
{
    json_out_text(out, r->name);
    write_cell(out, r->period);
    write_cell(out, r->start);
    for (int k = 0; k < FLOW_ROWS; k++) {
        const double v = r->value[num_at(i, k, r->n)];
        if (k == FLOW_THETA) {
            json_out_bytes(out, ",", 1);
            out->separate = false;
            json_number_in_unit(out, v, NUM_PI / 180.0);
        } else {
            write_cell(out, v);
        }
    }
    json_out_bytes(out, "\n", 1);
}

void dataset_write_csv(struct json_out *out, const struct dataset_entry *e)
{
    for (int k = 0; k < DATASET_COLUMNS; k++) {
        json_out_text(out, k > 0 ? "," : "");
        json_out_text(out, dataset_columns[k]);
    }
    json_out_text(out, "\n");
    for (int j = 0; j < e->n_record; j++) {
        for (int i = 0; i < e->record[j].n; i++) {
            write_line(out, &e->record[j], i);
        }
    }
    out->separate = false;
}

/* -- reading ---------------------------------------------------------------------------- */

struct flow_record *dataset_add_record(struct dataset_entry *e, const char *name, int n)
{
    struct flow_record *grown = realloc(e->record, ((size_t)e->n_record + 1) * sizeof *e->record);
    double *value = calloc((size_t)n * FLOW_ROWS + 1, sizeof *value);
    if (grown != NULL) {
        e->record = grown;
    }
    if (grown == NULL || value == NULL) {
        free(value);
        return NULL;
    }
    struct flow_record *r = &grown[e->n_record++];
    *r = (struct flow_record){.n = n, .value = value};
    (void)snprintf(r->name, sizeof r->name, "%s", name);
    return r;
}

/* A text being read, line by line, and what its first line says of the others. */
struct csv {
    const char *at, *end;
    int line, n_cell;
    int column[CELLS_MAX]; /* of the text -> DATASET_... */
    struct failure_list *problems;
};

static void refuse(struct csv *c, const char *code, const char *expected, const char *got,
                   const char *detail)
{
    char pointer[48];
    (void)snprintf(pointer, sizeof pointer, "/lines/%d", c->line);
    failure_set(failure_add(c->problems), ST_INVALID, pointer, code, expected, got, "line %d: %s",
                c->line, detail);
}

static size_t cell_length(const struct csv *c)
{
    size_t n = 0;
    while (c->at + n < c->end && strchr(",\r\n", c->at[n]) == NULL) {
        n++;
    }
    return n;
}

/* Past the comma behind a cell; false at the end of the line, which is left too. */
static bool next_cell(struct csv *c)
{
    if (c->at < c->end && *c->at == ',') {
        c->at++;
        return true;
    }
    while (c->at < c->end && (*c->at == '\r' || *c->at == '\n')) {
        c->at++;
    }
    return false;
}

static bool read_header(struct csv *c)
{
    bool seen[DATASET_COLUMNS] = {false};
    bool more = true;
    while (more) {
        const size_t n = cell_length(c);
        char got[80];
        int k = 0;
        (void)snprintf(got, sizeof got, "\"%.*s\"", (int)(n < 64 ? n : 64), c->at);
        while (k < DATASET_COLUMNS &&
               (strlen(dataset_columns[k]) != n || strncmp(dataset_columns[k], c->at, n) != 0)) {
            k++;
        }
        if (k == DATASET_COLUMNS || seen[k] || c->n_cell == CELLS_MAX) {
            char expected[128];
            reader_join(dataset_columns, sizeof expected, expected);
            refuse(c, k < DATASET_COLUMNS ? "duplicate_key" : "unknown_key", expected, got,
                   "there is no such column, or it stands twice");
            return false;
        }
        seen[k] = true;
        c->column[c->n_cell++] = k;
        c->at += n;
        more = next_cell(c);
    }
    for (int k = 0; k < DATASET_COLUMNS; k++) {
        if (!seen[k] && !dataset_column_is_optional(k)) {
            refuse(c, "required", dataset_columns[k], NULL, "the column is missing");
            return false;
        }
    }
    return true;
}

/* One line: the name of its record, and numbers by DATASET_.... */
static bool read_line(struct csv *c, char name[LIMIT_NAME], double *number)
{
    c->line++;
    for (int i = 0; i < c->n_cell; i++) {
        const size_t n = cell_length(c);
        char text[LIMIT_NAME], *end = NULL;
        if (n == 0 || n >= sizeof text) {
            refuse(c, "wrong_type", dataset_columns[c->column[i]], NULL,
                   "a cell is empty or too long");
            return false;
        }
        memcpy(text, c->at, n);
        text[n] = '\0';
        if (c->column[i] == DATASET_RECORD) {
            memcpy(name, text, n + 1);
        } else {
            number[c->column[i]] = strtod(text, &end);
            if (*end != '\0' || !isfinite(number[c->column[i]])) {
                refuse(c, "wrong_type", "a finite number", text, dataset_columns[c->column[i]]);
                return false;
            }
        }
        c->at += n;
        if (next_cell(c) != (i + 1 < c->n_cell)) {
            refuse(c, "wrong_length", NULL, NULL, "the line has not as many cells as the first");
            return false;
        }
    }
    return true;
}

/* Lines of one record as they come, row by row. */
struct gathering {
    char name[LIMIT_NAME];
    int n, room;
    double period, start;
    double *line; /* (FLOW_ROWS x room), row fastest */
};

static bool gather(struct gathering *g, const double *number)
{
    if (g->n == g->room) {
        const int room = g->room > 0 ? 2 * g->room : 1024;
        double *grown = realloc(g->line, (size_t)room * FLOW_ROWS * sizeof *grown);
        if (grown == NULL) {
            return false;
        }
        g->line = grown;
        g->room = room;
    }
    memcpy(g->line + (size_t)g->n * FLOW_ROWS, number + DATASET_FLOW, FLOW_ROWS * sizeof *number);
    g->line[(size_t)g->n * FLOW_ROWS + FLOW_THETA] *= NUM_PI / 180.0;
    g->n++;
    return true;
}

static bool finish(struct gathering *g, struct dataset_entry *out)
{
    if (g->n == 0) {
        return true;
    }
    struct flow_record *r = dataset_add_record(out, g->name, g->n);
    if (r == NULL) {
        return false;
    }
    r->period = g->period;
    r->start = g->start;
    for (int k = 0; k < FLOW_ROWS; k++) {
        for (int i = 0; i < g->n; i++) {
            r->value[num_at(i, k, g->n)] = g->line[(size_t)i * FLOW_ROWS + (size_t)k];
        }
    }
    g->n = 0;
    return true;
}

static enum status read_lines(struct csv *c, struct gathering *g, struct dataset_entry *out)
{
    while (c->at < c->end) {
        char name[LIMIT_NAME] = "";
        double number[DATASET_COLUMNS] = {0.0};
        if (!read_line(c, name, number)) {
            return ST_INVALID;
        }
        if (g->n == 0 || strcmp(name, g->name) != 0) {
            if (!finish(g, out)) {
                return ST_NO_MEMORY;
            }
            memcpy(g->name, name, sizeof g->name);
            g->period = number[DATASET_PERIOD];
            g->start = number[DATASET_START];
        }
        if (out->n_record == FLOW_RECORDS_MAX || g->n == FLOW_SAMPLES_MAX) {
            refuse(c, "too_many", "4096 records of 1000000 samples", NULL, "there are too many");
            return ST_INVALID;
        }
        if (!gather(g, number)) {
            return ST_NO_MEMORY;
        }
    }
    return finish(g, out) ? ST_OK : ST_NO_MEMORY;
}

enum status dataset_read_csv(const char *text, size_t size, struct dataset_entry *out,
                             struct failure_list *problems)
{
    struct csv c = {.at = text, .end = text + size, .line = 1, .problems = problems};
    struct gathering g = {.n = 0};
    const enum status st = read_header(&c) ? read_lines(&c, &g, out) : ST_INVALID;
    free(g.line);
    return st;
}

#include "cli/records.h"

#include "cli/columns.h"
#include "cli/file.h"
#include "cli/report.h"
#include "core/num.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

enum { PATH_SIZE = 1024, INDEX_MAX = 4 * 1024 * 1024, CELL_SIZE = 256 };

/* A motion starts then, and one without a period has faded in, and left what that shed behind. */
static const double motion_start = 2.0, fade_end = 12.0;

enum index_column { NAME, BLOCK, STATUS, PITCH, PLUNGE, SKIPPED, INDEX_COLUMNS };
static const char *const index_name[INDEX_COLUMNS] = {"name",  "block",  "status",
                                                      "pitch", "plunge", "cycles_skipped"};

/* Where the columns stand in a line, -1 where there is none. */
struct layout {
    int place[INDEX_COLUMNS];
};

/* Cell number `place` of a line; an empty text where there is none. */
static void cell_of(const char *line, int place, char cell[CELL_SIZE])
{
    const char *p = line;
    cell[0] = '\0';
    for (int i = 0; i < place; i++) {
        p += strcspn(p, ",\r\n");
        if (*p++ != ',') {
            return;
        }
    }
    const size_t length = strcspn(p, ",\r\n");
    if (place >= 0 && length < CELL_SIZE) {
        memcpy(cell, p, length);
        cell[length] = '\0';
    }
}

static struct layout layout_of(const char *line)
{
    struct layout l;
    const int n = 1 + (int)strcspn(line, "\r\n");
    for (int k = 0; k < INDEX_COLUMNS; k++) {
        l.place[k] = -1;
        for (int i = 0; i < n && l.place[k] < 0; i++) {
            char cell[CELL_SIZE];
            cell_of(line, i, cell);
            l.place[k] = strcmp(cell, index_name[k]) == 0 ? i : -1;
        }
    }
    return l;
}

static bool counts(const char *line, const struct layout *l)
{
    char block[CELL_SIZE], status[CELL_SIZE];
    cell_of(line, l->place[BLOCK], block);
    cell_of(line, l->place[STATUS], status);
    return (l->place[STATUS] < 0 || strcmp(status, "done") == 0) &&
           (l->place[BLOCK] < 0 || strncmp(block, "sine_", 5) == 0 ||
            strncmp(block, "broadband_", 10) == 0);
}

/* Frequency of a motion of one tone, 0 of none, NaN of any other. */
static double tone(const char *motion)
{
    const char *at = strchr(motion, '@');
    char *end = NULL;
    if (at == NULL) {
        return 0.0;
    }
    const double f = strtod(at + 1, &end);
    return *end == '+' && strchr(end, '@') == NULL && f > 0.0 ? f : (double)NAN;
}

/* Period and start, from the words of the index. */
static void time_of(const char *line, const struct layout *l, struct flow_record *r)
{
    char pitch[CELL_SIZE], plunge[CELL_SIZE], skipped[CELL_SIZE];
    cell_of(line, l->place[PITCH], pitch);
    cell_of(line, l->place[PLUNGE], plunge);
    cell_of(line, l->place[SKIPPED], skipped);
    const double a = tone(pitch), b = tone(plunge), f = fmax(a, b);
    const bool one =
        !isnan(a) && !isnan(b) && f > 0.0 && (fmin(a, b) <= 0.0 || fabs(a - b) <= 1e-9 * f);
    r->period = one ? 1.0 / f : 0.0;
    r->start = one ? motion_start + strtod(skipped, NULL) / f : fade_end;
}

static bool read_record(const char *folder, const char *line, const struct layout *l,
                        struct flow_record *r)
{
    static const struct column column[FLOW_ROWS] = {
#define COLUMN(code, name) [code] = {(name), true},
        FLOW_ROW_LIST(COLUMN)
#undef COLUMN
    };
    char name[CELL_SIZE], path[PATH_SIZE];
    cell_of(line, l->place[NAME], name);
    const int length = snprintf(path, sizeof path, "%s/records/%s.csv", folder, name);
    if (name[0] == '\0' || strlen(name) >= LIMIT_NAME || strchr(name, '/') != NULL ||
        length >= PATH_SIZE) {
        (void)fprintf(stderr, "aerom: %s/index.csv: '%s' is no name of a record\n", folder, name);
        return false;
    }
    *r = (struct flow_record){0};
    memcpy(r->name, name, strlen(name));
    if (!columns_read(path, FLOW_ROWS, column, &r->n, &r->value)) {
        return false;
    }
    for (int i = 0; i < r->n; i++) {
        r->value[num_at(i, FLOW_THETA, r->n)] = num_rad(r->value[num_at(i, FLOW_THETA, r->n)]);
    }
    time_of(line, l, r);
    return true;
}

static bool add(const char *folder, const char *line, const struct layout *l, struct records *out)
{
    if (out->n == FLOW_RECORDS_MAX) {
        (void)fprintf(stderr, "aerom: %s: more than %d records\n", folder, FLOW_RECORDS_MAX);
        return false;
    }
    struct flow_record *grown = realloc(out->record, (size_t)(out->n + 1) * sizeof *out->record);
    if (grown == NULL) {
        (void)fprintf(stderr, "aerom: %s: out of memory\n", folder);
        return false;
    }
    out->record = grown;
    if (!read_record(folder, line, l, &grown[out->n])) {
        return false;
    }
    out->n++;
    return true;
}

static bool read_index(const char *folder, const char *text, struct records *out)
{
    const struct layout l = layout_of(text);
    if (l.place[NAME] < 0) {
        (void)fprintf(stderr, "aerom: %s/index.csv: no column 'name' in the first line\n", folder);
        return false;
    }
    for (const char *p = text + strcspn(text, "\n"); *p != '\0'; p += strcspn(p, "\n")) {
        p++;
        if (*p != '\0' && *p != '\r' && *p != '\n' && counts(p, &l) && !add(folder, p, &l, out)) {
            return false;
        }
    }
    return true;
}

bool records_read(const char *folder, struct failure_list *problems, struct records *out)
{
    char path[PATH_SIZE], *text = NULL;
    size_t size = 0;
    *out = (struct records){0};
    if (snprintf(path, sizeof path, "%s/index.csv", folder) >= PATH_SIZE ||
        !file_read(path, INDEX_MAX, &text, &size)) {
        return false;
    }
    bool done = read_index(folder, text, out);
    for (int i = 0; i < out->n && done; i++) {
        flow_record_check(&out->record[i], problems);
    }
    if (done && problems->total > 0) {
        report_failures(stderr, folder, problems);
        done = false;
    }
    free(text);
    if (!done) {
        records_done(out);
    }
    return done;
}

void records_done(struct records *r)
{
    for (int i = 0; i < r->n; i++) {
        free(r->record[i].value);
    }
    free(r->record);
    *r = (struct records){0};
}

#include "cli/motion.h"

#include "cli/file.h"
#include "core/num.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

enum { TIME = MOTION_ROWS, COLUMNS, COLUMNS_MAX = 64, FILE_MAX = 64 * 1024 * 1024 };

static const struct {
    const char *name;
    bool required;
} columns[COLUMNS] = {
    [MOTION_THETA] = {"alpha_deg", true},
    [MOTION_THETA_RATE] = {"alpha_dot", true},
    [MOTION_THETA_ACCELERATION] = {"alpha_ddot", true},
    [MOTION_W] = {"w", false},
    [MOTION_W_RATE] = {"w_dot", false},
    [MOTION_W_ACCELERATION] = {"w_ddot", false},
    [TIME] = {"t", true},
};

/* What stands in each place of a line: a column of ours, or COLUMNS for another one. */
struct header {
    int n;
    int what[COLUMNS_MAX];
};

static size_t word(const char *text)
{
    return strcspn(text, ",\r\n");
}

static bool read_header(const char *file, const char **text, struct header *h)
{
    bool found[COLUMNS] = {false};
    const char *p = *text;
    h->n = 0;
    for (;;) {
        const size_t length = word(p);
        int k = 0;
        while (k < COLUMNS &&
               (strlen(columns[k].name) != length || strncmp(columns[k].name, p, length) != 0)) {
            k++;
        }
        if (h->n == COLUMNS_MAX) {
            (void)fprintf(stderr, "aerom: %s: more than %d columns\n", file, COLUMNS_MAX);
            return false;
        }
        h->what[h->n++] = k;
        if (k < COLUMNS) {
            found[k] = true;
        }
        p += length;
        if (*p != ',') {
            break;
        }
        p++;
    }
    for (int k = 0; k < COLUMNS; k++) {
        if (columns[k].required && !found[k]) {
            (void)fprintf(stderr, "aerom: %s: no column '%s' in the first line\n", file,
                          columns[k].name);
            return false;
        }
    }
    *text = p + strspn(p, "\r\n");
    return true;
}

/* One line into row (COLUMNS); *text goes to the next. */
static bool read_row(const struct header *h, const char **text, double *row)
{
    const char *p = *text;
    for (int i = 0; i < h->n; i++) {
        char *end = NULL;
        const double value = strtod(p, &end);
        if (end == p || end != p + word(p) || !isfinite(value)) {
            return false;
        }
        if (h->what[i] < COLUMNS) {
            row[h->what[i]] = value;
        }
        p = end;
        if (i + 1 < h->n && *p++ != ',') {
            return false;
        }
    }
    if (*p != '\0' && *p != '\r' && *p != '\n') {
        return false;
    }
    *text = p + strspn(p, "\r\n");
    return true;
}

static int count_lines(const char *text)
{
    int n = 1;
    for (; *text != '\0'; text++) {
        n += *text == '\n';
    }
    return n;
}

/* Samples into value (room x MOTION_ROWS, time fastest) and time (room); the number, or -1. */
static int read_rows(const char *file, const char *text, const struct header *h, int room,
                     double *value, double *time)
{
    int n = 0;
    while (*text != '\0' && n < room) {
        double row[COLUMNS] = {0.0};
        if (!read_row(h, &text, row)) {
            (void)fprintf(stderr, "aerom: %s: line %d is not %d numbers\n", file, n + 2, h->n);
            return -1;
        }
        row[MOTION_THETA] = num_rad(row[MOTION_THETA]);
        for (int k = 0; k < MOTION_ROWS; k++) {
            value[num_at(n, k, room)] = row[k];
        }
        time[n++] = row[TIME];
    }
    for (int i = 2; i < n; i++) {
        if (fabs((time[i] - time[i - 1]) - (time[1] - time[0])) > 1e-3 * (time[1] - time[0])) {
            (void)fprintf(stderr, "aerom: %s: line %d: t does not run in equal steps\n", file,
                          i + 2);
            return -1;
        }
    }
    return n;
}

bool motion_read(const char *file, struct loop_motion *out, double *start)
{
    char *text = NULL;
    size_t size = 0;
    struct header h;
    if (!file_read(file, FILE_MAX, &text, &size)) {
        return false;
    }
    const char *p = text;
    const int room = count_lines(text);
    double *value = calloc((size_t)room, MOTION_ROWS * sizeof *value);
    double *time = calloc((size_t)room, sizeof *time);
    int n = -1;
    if (value == NULL || time == NULL) {
        (void)fprintf(stderr, "aerom: %s: out of memory\n", file);
    } else if (read_header(file, &p, &h)) {
        n = read_rows(file, p, &h, room, value, time);
    }
    if (n >= 0) {
        for (int k = 1; k < MOTION_ROWS; k++) {
            memmove(value + (ptrdiff_t)n * k, value + (ptrdiff_t)room * k,
                    (size_t)n * sizeof *value);
        }
        *start = time[0];
        *out = (struct loop_motion){
            .n = n, .step = n > 1 ? (time[n - 1] - time[0]) / (n - 1) : 0.0, .value = value};
        value = NULL;
    }
    free(value);
    free(time);
    free(text);
    return n >= 0;
}

#include "cli/columns.h"

#include "cli/file.h"
#include "core/num.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

enum { COLUMNS_MAX = 64, FILE_MAX = 64 * 1024 * 1024 };

/* What stands in each place of a line: a column asked for, or n_column for another one. */
struct header {
    int n, n_column;
    int what[COLUMNS_MAX];
};

static size_t word(const char *text)
{
    return strcspn(text, ",\r\n");
}

static bool has_all(const char *file, const struct column *column, const struct header *h)
{
    for (int k = 0; k < h->n_column; k++) {
        bool found = !column[k].required;
        for (int i = 0; i < h->n; i++) {
            found |= h->what[i] == k;
        }
        if (!found) {
            (void)fprintf(stderr, "aerom: %s: no column '%s' in the first line\n", file,
                          column[k].name);
            return false;
        }
    }
    return true;
}

static bool read_header(const char *file, const struct column *column, const char **text,
                        struct header *h)
{
    const char *p = *text;
    h->n = 0;
    for (;;) {
        const size_t length = word(p);
        int k = 0;
        while (k < h->n_column &&
               (strlen(column[k].name) != length || strncmp(column[k].name, p, length) != 0)) {
            k++;
        }
        if (h->n == COLUMNS_MAX) {
            (void)fprintf(stderr, "aerom: %s: more than %d columns\n", file, COLUMNS_MAX);
            return false;
        }
        h->what[h->n++] = k;
        p += length;
        if (*p != ',') {
            break;
        }
        p++;
    }
    *text = p + strspn(p, "\r\n");
    return has_all(file, column, h);
}

/* One line into row (COLUMNS_MAX); *text goes to the next. */
static bool read_row(const struct header *h, const char **text, double *row)
{
    const char *p = *text;
    for (int i = 0; i < h->n; i++) {
        char *end = NULL;
        const double value = strtod(p, &end);
        if (end == p || end != p + word(p) || !isfinite(value)) {
            return false;
        }
        if (h->what[i] < h->n_column) {
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

/* Lines into value (room x n_column, lines fastest); their number, or -1. */
static int read_rows(const char *file, const char *text, const struct header *h, int room,
                     double *value)
{
    int n = 0;
    while (*text != '\0' && n < room) {
        double row[COLUMNS_MAX] = {0.0};
        if (!read_row(h, &text, row)) {
            (void)fprintf(stderr, "aerom: %s: line %d is not %d numbers\n", file, n + 2, h->n);
            return -1;
        }
        for (int k = 0; k < h->n_column; k++) {
            value[num_at(n, k, room)] = row[k];
        }
        n++;
    }
    return n;
}

bool columns_read(const char *file, int n_column, const struct column *column, int *n_line,
                  double **value)
{
    char *text = NULL;
    size_t size = 0;
    struct header h = {.n_column = n_column};
    if (!file_read(file, FILE_MAX, &text, &size)) {
        return false;
    }
    const char *p = text;
    const int room = count_lines(text);
    double *read = calloc((size_t)room * (size_t)n_column, sizeof *read);
    int n = -1;
    if (read == NULL) {
        (void)fprintf(stderr, "aerom: %s: out of memory\n", file);
    } else if (read_header(file, column, &p, &h)) {
        n = read_rows(file, p, &h, room, read);
    }
    if (n >= 0) {
        for (int k = 1; k < n_column; k++) {
            memmove(read + num_at(0, k, n), read + num_at(0, k, room), (size_t)n * sizeof *read);
        }
        *n_line = n;
        *value = read;
        read = NULL;
    }
    free(read);
    free(text);
    return n >= 0;
}

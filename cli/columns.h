/* cli/columns.h
 * Numbers read from CSV by the names in its first line. */
#ifndef AEROM_CLI_COLUMNS_H
#define AEROM_CLI_COLUMNS_H

#include <stdbool.h>

struct column {
    const char *name;
    bool required; /* otherwise zero where the file has none */
};

/* Reads n_column columns into *value (*n x n_column), lines fastest, malloc'ed; other columns are
 * passed over. All numbers are finite. On failure a line has gone to stderr and the outputs are
 * unchanged. */
bool columns_read(const char *file, int n_column, const struct column *column, int *n,
                  double **value);

#endif

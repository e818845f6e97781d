/* server/series_read.h
 * Reads the asked columns and window of a stored series. */
#ifndef AEROM_SERVER_SERIES_READ_H
#define AEROM_SERVER_SERIES_READ_H

#include "server/store.h"

struct series_ask {
    const char *id;
    int n_channel;              /* 0 = all */
    const char *const *channel; /* a column's name, or its name before '[' */
    double from_s, to_s;        /* samples with from <= t <= to */
};

/* Columns in stored order; freed with series_data_done. STORE_NONE with *bad_channel >= 0: no
 * column answers to that channel; otherwise *bad_channel is -1. */
enum store_status series_read(struct store_session *s, const struct series_ask *ask,
                              struct series_data *out, int *bad_channel);

#endif

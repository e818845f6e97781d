/* tests/api/fake_study.h
 * The cells of every study of the fake service: the first of six is done, the second has failed.
 * Plain functions, for one thread. */
#ifndef AEROM_TESTS_API_FAKE_STUDY_H
#define AEROM_TESTS_API_FAKE_STUDY_H

#include "api/service.h"

#include <stdlib.h>
#include <string.h>

static inline struct service_study fake_study_progress(void)
{
    return (struct service_study){.n_cell = 6, .done = 1, .failed = 1, .reused = 1, .cpu_s = 0.25};
}

static inline char *fake_summary(void)
{
    static const char text[] = "{\"verdict\":\"stable\",\"means\":{\"cl\":0.5}}";
    char *copy = NULL;
    while (copy == NULL) { /* the fake itself never runs out of memory */
        copy = malloc(sizeof text);
    }
    memcpy(copy, text, sizeof text);
    return copy;
}

static inline enum service_status fake_get_cells(void *ctx, const char *id, int from, int limit,
                                                 bool summaries, struct service_cell **out, int *n)
{
    const struct service_cell cell[] = {
        {.cell = 0, .state = STUDY_CELL_DONE, .reused = true, .verdict = "stable", .cpu_s = 0.25},
        {.cell = 1,
         .state = STUDY_CELL_FAILED,
         .error_code = "singular",
         .error_detail = "/beam: it is"}};
    (void)ctx;
    (void)id;
    do {
        *out = calloc(2, sizeof **out);
    } while (*out == NULL);
    *n = 0;
    for (int i = from; i < 2 && *n < limit; i++) {
        (*out)[*n] = cell[i];
        (*out)[*n].summary = summaries && i == 0 ? fake_summary() : NULL;
        ++*n;
    }
    return SERVICE_OK;
}

#endif

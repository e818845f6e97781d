/* api/study_seek.h
 * The answer of a cell that is more than one run: the boundary of a field, or the optimum from one
 * start. Inside api only. */
#ifndef AEROM_API_STUDY_SEEK_H
#define AEROM_API_STUDY_SEEK_H

#include "api/study_evaluate.h"
#include "api/study_run.h"

/* Appends what tells the search of one cell from that of another, beside the case of the cell. */
void study_seek_identity(const struct study *s, int cell, struct json_out *out);

/* Searches from the values of `cell`, which stand in the tree. Fills summary, verdict (the outcome)
 * and cpu_s of *out. ST_CANCELLED and ST_NO_MEMORY leave *out unchanged. */
MUST_CHECK enum status study_seek(struct study_evaluator *e, int cell,
                                  struct study_cell_result *out);

/* A boundary as it was found, with what its evaluations answered. */
struct study_boundary {
    enum boundary_sweep sweep;
    struct boundary_result result;
    struct {
        char hash[LIMIT_HASH], verdict[24], code[40];
    } sample[BOUNDARY_SAMPLES_MAX];
};
/* Large: callers allocate it. The field has its own value again afterwards. */
MUST_CHECK enum status study_seek_boundary(struct study_evaluator *e, enum boundary_sweep sweep,
                                           struct study_boundary *out);
/* Members of an object. */
void study_boundary_members(struct json_out *out, const struct study_boundary *b);
/* The boundary as a number to compare: where the criterion holds, or fails, over the whole range,
 * the end of the range. NaN when the search failed. */
double study_boundary_value(const struct study *s, const struct study_boundary *b);

/* The optimum from the start of a cell. */
MUST_CHECK enum status study_seek_optimum(struct study_evaluator *e, int cell,
                                          struct study_cell_result *out);

#endif

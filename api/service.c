#include "api/service.h"

#include "api/case.h"

#include <assert.h>
#include <stdlib.h>
#include <string.h>

static const char *const state_names[JOB_STATE_COUNT] = {
#define STATE_NAME(code, name) [code] = (name),
    JOB_STATE_LIST(STATE_NAME)
#undef STATE_NAME
};

const char *job_state_name(enum job_state state)
{
    assert((unsigned)state < JOB_STATE_COUNT);
    return state_names[state];
}

bool job_state_parse(const char *name, enum job_state *out)
{
    for (int i = 0; i < JOB_STATE_COUNT; i++) {
        if (strcmp(state_names[i], name) == 0) {
            *out = (enum job_state)i;
            return true;
        }
    }
    return false;
}

static const char study_kind[] = "study";

const char *job_kind_name(int kind)
{
    assert(kind >= 0);
    assert(kind < JOB_KIND_COUNT);
    return kind == JOB_STUDY ? study_kind : case_kind_name((enum case_kind)kind);
}

bool job_kind_parse(const char *name, int *out)
{
    enum case_kind kind = CASE_SIMULATION;
    if (strcmp(name, study_kind) == 0) {
        *out = JOB_STUDY;
        return true;
    }
    if (!case_kind_parse(name, &kind)) {
        return false;
    }
    *out = (int)kind;
    return true;
}

void service_cells_done(struct service_cell *cell, int n)
{
    for (int i = 0; i < n; i++) {
        free(cell[i].summary);
        cell[i].summary = NULL;
    }
}

void series_data_done(struct series_data *data)
{
    for (int i = 0; i < data->n_column; i++) {
        free(data->column[i].value);
    }
    free(data->column);
    *data = (struct series_data){0};
}

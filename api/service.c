#include "api/service.h"

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

void series_data_done(struct series_data *data)
{
    for (int i = 0; i < data->n_column; i++) {
        free(data->column[i].value);
    }
    free(data->column);
    *data = (struct series_data){0};
}

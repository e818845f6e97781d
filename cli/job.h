/* cli/job.h
 * What the contract says about a job, as far as the command line needs it. Plain values. */
#ifndef AEROM_CLI_JOB_H
#define AEROM_CLI_JOB_H

#include <stdbool.h>
#include <stddef.h>
#include <stdio.h>

struct job {
    char id[64];
    char state[24];
    char kind[24];
    char name[128];
    char verdict[24]; /* "" unless a simulation is done */
    char error[512];  /* "" unless failed */
    double progress;  /* 0..1 */
    bool reused;
};

/* Reads a job object. False, after a line on stderr, when the text is none. */
bool job_parse(const char *json, size_t size, struct job *out);

/* True once the state never changes again. */
bool job_is_final(const struct job *job);

/* Prints the answer of GET /v1/jobs as a table, one job a line. False as job_parse. */
bool job_print_list(FILE *out, const char *json, size_t size);

#endif

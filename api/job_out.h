/* api/job_out.h
 * A job as the contract shows it. Inside api only. */
#ifndef AEROM_API_JOB_OUT_H
#define AEROM_API_JOB_OUT_H

#include "api/json_out.h"
#include "api/service.h"

/* The members alone, inside an object already begun. */
void job_write_members(struct json_out *out, const struct job_record *job);
void job_write(struct json_out *out, const struct job_record *job);

#endif

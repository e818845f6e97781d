/* api/respond.h
 * Answers the handlers share. Inside api only. */
#ifndef AEROM_API_RESPOND_H
#define AEROM_API_RESPOND_H

#include "api/json_out.h"
#include "api/route.h"

/* A JSON body that must not be kept by caches. */
void respond_json(struct api_response *res, int status, struct json_out *out);

/* A malloc'ed body (taken) that is named by the hash of its bytes: ETag, and 304 when the client
 * has it. `cache` is the Cache-Control. NULL answers 500. */
void respond_tagged(const struct api_call *call, struct api_response *res, const char *type,
                    const char *cache, char *body, size_t size);
extern const char respond_immutable[];  /* for results, which never change */
extern const char respond_revalidate[]; /* for what changes with the program */

/* The problems of a document, of which there is at least one; the first is the detail. */
void respond_refuse(struct api_response *res, enum problem p, const struct failure_list *problems);

/* The problem a service status other than SERVICE_OK means; `id` names the job. */
void respond_service(struct api_response *res, enum service_status st, const char *id);

/* Whether the body says it is JSON; otherwise the answer is given: 415. */
bool respond_is_json(const struct api_call *call, struct api_response *res);

/* The job of the path; false when the answer is given already (unknown, or the service failed). */
bool respond_find_job(const struct api_call *call, struct api_response *res,
                      struct job_record *out);
/* Whether the job is done; otherwise the answer is given: 409 with its state. */
bool respond_require_done(struct api_response *res, const struct job_record *job);

#endif

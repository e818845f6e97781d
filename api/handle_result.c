/* The case of a job and its result documents. */
#include "api/respond.h"
#include "api/result.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

void handle_case(const struct api_call *call, struct api_response *res)
{
    const struct service *s = call->api->service;
    struct job_record job;
    char *json = NULL;
    if (!respond_find_job(call, res, &job)) {
        return;
    }
    const enum service_status st = s->get_case(s->ctx, job.id, &json);
    if (st != SERVICE_OK) {
        respond_service(res, st, job.id);
        return;
    }
    respond_tagged(call, res, "application/json", respond_immutable, json, strlen(json));
}

static bool kind_has(int kind, const char *document)
{
    if (kind == JOB_STUDY) {
        return false;
    }
    const char *const *list = result_documents((enum case_kind)kind);
    for (int i = 0; list[i] != NULL; i++) {
        if (strcmp(list[i], document) == 0) {
            return true;
        }
    }
    return false;
}

void handle_document(const struct api_call *call, struct api_response *res)
{
    const struct service *s = call->api->service;
    const char *document = call->route->document;
    struct job_record job;
    char *json = NULL;
    if (!respond_find_job(call, res, &job)) {
        return;
    }
    if (!kind_has(job.kind, document)) {
        char detail[128];
        (void)snprintf(detail, sizeof detail, "a job of kind \"%s\" has no %s",
                       job_kind_name(job.kind), document);
        problem_response(res, PROBLEM_NO_DOCUMENT, detail, NULL, NULL);
        return;
    }
    if (!respond_require_done(res, &job)) {
        return;
    }
    const enum service_status st = s->get_document(s->ctx, job.id, document, &json);
    if (st != SERVICE_OK) {
        respond_service(res, st, job.id);
        return;
    }
    respond_tagged(call, res, "application/json", respond_immutable, json, strlen(json));
}

#include "api/respond.h"

#include "api/hash.h"
#include "api/text.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

const char respond_immutable[] = "private, max-age=31536000, immutable";
const char respond_revalidate[] = "no-cache";

void respond_json(struct api_response *res, int status, struct json_out *out)
{
    res->body = json_out_take(out, &res->body_size);
    if (res->body == NULL) {
        problem_response(res, PROBLEM_INTERNAL, status_text(ST_NO_MEMORY), NULL, NULL);
        return;
    }
    res->status = status;
    (void)snprintf(res->content_type, sizeof res->content_type, "application/json");
    api_response_header(res, "Cache-Control", "no-store");
}

void respond_tagged(const struct api_call *call, struct api_response *res, const char *type,
                    const char *cache, char *body, size_t size)
{
    char hash[LIMIT_HASH];
    char etag[LIMIT_HASH + 2];
    if (body == NULL) {
        problem_response(res, PROBLEM_INTERNAL, status_text(ST_NO_MEMORY), NULL, NULL);
        return;
    }
    hash_text(body, size, hash);
    (void)snprintf(etag, sizeof etag, "\"%.32s\"", hash);
    api_response_header(res, "ETag", "%s", etag);
    api_response_header(res, "Cache-Control", "%s", cache);
    if (text_etag_matches(call->req->if_none_match, etag)) {
        free(body);
        res->status = 304;
        return;
    }
    res->status = 200;
    (void)snprintf(res->content_type, sizeof res->content_type, "%s", type);
    res->body = body;
    res->body_size = size;
}

void respond_refuse(struct api_response *res, enum problem p, const struct failure_list *problems)
{
    char detail[600];
    const struct failure *first = &problems->item[0];
    (void)snprintf(detail, sizeof detail, "%s: %s%s", first->pointer, first->detail,
                   problems->total > 1 ? " (and more, see errors)" : "");
    problem_response(res, p, detail, problems, NULL);
}

void respond_service(struct api_response *res, enum service_status st, const char *id)
{
    char detail[128];
    (void)snprintf(detail, sizeof detail, "there is no job \"%.60s\"", id);
    static const struct {
        enum problem problem;
        const char *detail;
    } table[] = {
        [SERVICE_OK] = {PROBLEM_INTERNAL, "no failure"},
        [SERVICE_NOT_FOUND] = {PROBLEM_UNKNOWN_JOB, NULL},
        [SERVICE_NOT_READY] = {PROBLEM_NOT_READY, "the job has no result yet"},
        [SERVICE_BUSY] = {PROBLEM_BUSY, "the queue is full or the server is stopping; try again"},
        [SERVICE_DISK_FULL] = {PROBLEM_DISK_FULL, "nothing more can be stored"},
        [SERVICE_ERROR] = {PROBLEM_INTERNAL, "the failure is in the server's log"},
    };
    problem_response(res, table[st].problem, table[st].detail != NULL ? table[st].detail : detail,
                     NULL, NULL);
}

bool respond_is_json(const struct api_call *call, struct api_response *res)
{
    const char *type = call->req->content_type;
    char detail[160];
    if (text_is_media_type(type, "application/json")) {
        return true;
    }
    (void)snprintf(detail, sizeof detail, "Content-Type is %.80s; send application/json",
                   type != NULL ? type : "absent");
    problem_response(res, PROBLEM_MEDIA_TYPE, detail, NULL, NULL);
    return false;
}

bool respond_find_job(const struct api_call *call, struct api_response *res, struct job_record *out)
{
    const struct service *s = call->api->service;
    const char *id = call->param;
    enum service_status st = SERVICE_NOT_FOUND;
    /* Anything else is not even shaped like an id. */
    if (strlen(id) == JOB_ID_SIZE - 1 && strspn(id, "0123456789abcdef-") == JOB_ID_SIZE - 1) {
        st = s->get(s->ctx, id, out);
    }
    if (st != SERVICE_OK) {
        respond_service(res, st, id);
    }
    return st == SERVICE_OK;
}

bool respond_require_done(struct api_response *res, const struct job_record *job)
{
    char detail[800];
    if (job->state == JOB_DONE) {
        return true;
    }
    const char *state = job_state_name(job->state);
    if (job->state == JOB_FAILED) {
        (void)snprintf(detail, sizeof detail, "the job failed (%s): %s", job->error_code,
                       job->error_detail);
    } else {
        (void)snprintf(detail, sizeof detail, "the job is %s; results exist once it is done",
                       state);
    }
    problem_response(res, PROBLEM_NOT_READY, detail, NULL,
                     &(const struct problem_member){"state", state});
    return false;
}

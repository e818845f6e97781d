#include "api/job_out.h"

#include "api/result.h"
#include "api/text.h"

#include <stdio.h>

static void write_time(struct json_out *out, const char *key, int64_t us)
{
    char text[TEXT_TIME_SIZE];
    if (us > 0) {
        text_time(us, text);
    }
    json_key_string(out, key, us > 0 ? text : NULL);
}

static void write_link(struct json_out *out, const char *id, const char *name, const char *tail)
{
    char path[96];
    (void)snprintf(path, sizeof path, "/v1/jobs/%s%s%s", id, tail[0] != '\0' ? "/" : "", tail);
    json_key_string(out, name, path);
}

static void write_study_links(struct json_out *out, const char *id)
{
    static const char *const name[][2] = {{"study", ""}, {"cells", "/cells"}, {"map", "/map"}};
    for (size_t i = 0; i < sizeof name / sizeof name[0]; i++) {
        char path[96];
        (void)snprintf(path, sizeof path, "/v1/studies/%s%s", id, name[i][1]);
        json_key_string(out, name[i][0], path);
    }
}

static void write_links(struct json_out *out, const struct job_record *job)
{
    json_key(out, "links");
    json_object_begin(out);
    write_link(out, job->id, "self", "");
    write_link(out, job->id, "case", "case");
    if (job->kind == JOB_STUDY) {
        write_study_links(out, job->id);
    } else if (job->state == JOB_DONE) {
        const char *const *document = result_documents((enum case_kind)job->kind);
        for (int i = 0; document[i] != NULL; i++) {
            write_link(out, job->id, document[i], document[i]);
        }
        if (case_kind_records(job->kind)) {
            write_link(out, job->id, "series", "series");
        }
    }
    json_object_end(out);
}

void job_write_members(struct json_out *out, const struct job_record *job)
{
    json_key_string(out, "id", job->id);
    json_key_string(out, "kind", job_kind_name(job->kind));
    json_key_string(out, "state", job_state_name(job->state));
    json_key_string(out, "name", job->name);
    json_key_number(out, "progress", job->progress);
    json_key_integer(out, "attempt", job->attempt);
    write_time(out, "created", job->created_us);
    write_time(out, "started", job->started_us);
    write_time(out, "finished", job->finished_us);
    json_key_string(out, "verdict", job->verdict[0] != '\0' ? job->verdict : NULL);
    json_key(out, "error");
    if (job->error_code[0] != '\0') {
        json_object_begin(out);
        json_key_string(out, "code", job->error_code);
        json_key_string(out, "detail", job->error_detail);
        json_object_end(out);
    } else {
        json_null(out);
    }
    json_key_string(out, "content_hash", job->content_hash);
    write_links(out, job);
}

void job_write(struct json_out *out, const struct job_record *job)
{
    json_object_begin(out);
    job_write_members(out, job);
    json_object_end(out);
}

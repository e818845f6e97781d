#include "cli/job.h"

#include <cjson/cJSON.h>

#include <string.h>

static const cJSON *member(const cJSON *object, const char *key)
{
    return cJSON_GetObjectItemCaseSensitive(object, key);
}

static void copy_text(const cJSON *object, const char *key, size_t size, char *out)
{
    const cJSON *item = member(object, key);
    (void)snprintf(out, size, "%s", cJSON_IsString(item) ? item->valuestring : "");
}

static bool read_job(const cJSON *object, struct job *out)
{
    struct job job = {0};
    const cJSON *progress = member(object, "progress");
    copy_text(object, "id", sizeof job.id, job.id);
    copy_text(object, "state", sizeof job.state, job.state);
    copy_text(object, "kind", sizeof job.kind, job.kind);
    copy_text(object, "name", sizeof job.name, job.name);
    copy_text(object, "verdict", sizeof job.verdict, job.verdict);
    copy_text(member(object, "error"), "detail", sizeof job.error, job.error);
    job.progress = cJSON_IsNumber(progress) ? progress->valuedouble : 0.0;
    job.reused = cJSON_IsTrue(member(object, "reused"));
    if (job.id[0] == '\0' || job.state[0] == '\0') {
        return false;
    }
    *out = job;
    return true;
}

static bool complain(const char *json)
{
    (void)fprintf(stderr, "aerom: unexpected answer: %.200s\n", json);
    return false;
}

bool job_parse(const char *json, size_t size, struct job *out)
{
    cJSON *tree = cJSON_ParseWithLength(json, size);
    const bool known = read_job(tree, out);
    cJSON_Delete(tree);
    return known || complain(json);
}

bool job_is_final(const struct job *job)
{
    static const char *const final[] = {"done", "failed", "cancelled"};
    for (size_t i = 0; i < sizeof final / sizeof final[0]; i++) {
        if (strcmp(job->state, final[i]) == 0) {
            return true;
        }
    }
    return false;
}

bool job_print_list(FILE *out, const char *json, size_t size)
{
    cJSON *tree = cJSON_ParseWithLength(json, size);
    const cJSON *jobs = member(tree, "jobs");
    const bool known = cJSON_IsArray(jobs);
    const cJSON *item = NULL;
    cJSON_ArrayForEach(item, jobs)
    {
        struct job job;
        if (read_job(item, &job)) {
            (void)fprintf(out, "%s  %-10s %-10s %4.0f %%  %-13s  %s\n", job.id, job.kind, job.state,
                          100.0 * job.progress, job.verdict[0] != '\0' ? job.verdict : "-",
                          job.name);
        }
    }
    cJSON_Delete(tree);
    return known || complain(json);
}

#include "cli/remote.h"

#include "cli/command.h"
#include "cli/file.h"
#include "cli/http_client.h"
#include "cli/job.h"
#include "cli/options.h"
#include "cli/report.h"

#include "api/router.h"

#include <stdbool.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <time.h>

enum { PATH_MAX_SIZE = 512 };

static struct http_client *connect_to(const struct options *o)
{
    struct http_client *client = http_client_create(o->url);
    if (client == NULL) {
        (void)fprintf(stderr, "aerom: no client for %s\n", o->url);
    }
    return client;
}

/* Identifiers and values go into paths as they are, so they must be plain. */
static bool is_plain(const char *text)
{
    static const char plain[] = "abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ0123456789-_.";
    const size_t n = strlen(text);
    return n > 0 && n < 128 && strspn(text, plain) == n;
}

static bool path_of(const char *id, const char *collection, const char *tail,
                    char path[PATH_MAX_SIZE])
{
    if (!is_plain(id) || strchr(id, '.') != NULL) { /* ".." would lead elsewhere */
        (void)fprintf(stderr, "aerom: '%s' is no job id\n", id);
        return false;
    }
    (void)snprintf(path, PATH_MAX_SIZE, "/v1/%s/%s%s", collection, id, tail);
    return true;
}

static bool job_path(const char *id, const char *tail, char path[PATH_MAX_SIZE])
{
    return path_of(id, "jobs", tail, path);
}

/* One request whose answer must be a success; everything else is reported as about `source`. */
static bool ask(struct http_client *client, const char *source, const char *method,
                const char *path, const char *body, size_t size, struct http_answer *answer)
{
    struct http_answer received = {0};
    if (!http_client_request(client, method, path, body, size, &received)) {
        return false;
    }
    if (received.status < 200 || received.status > 299) {
        report_problem(stderr, source, received.status, received.body, received.size);
        http_answer_done(&received);
        return false;
    }
    *answer = received;
    return true;
}

static bool get_job(struct http_client *client, const char *id, struct job *out)
{
    char path[PATH_MAX_SIZE];
    struct http_answer answer = {0};
    if (!job_path(id, "", path) || !ask(client, id, "GET", path, NULL, 0, &answer)) {
        return false;
    }
    const bool known = job_parse(answer.body, answer.size, out);
    http_answer_done(&answer);
    return known;
}

static double seconds_now(void)
{
    struct timespec t = {0};
    (void)clock_gettime(CLOCK_MONOTONIC, &t);
    return (double)t.tv_sec + 1e-9 * (double)t.tv_nsec;
}

/* Short at first, so that small cases come back at once; then at most two requests a second. */
static void pause_between(int round)
{
    const long ms = round < 10 ? 20 + 10L * round : 500;
    const struct timespec t = {.tv_sec = 0, .tv_nsec = ms * 1000000L};
    (void)nanosleep(&t, NULL);
}

static int wait_for(struct http_client *client, const char *id, double deadline)
{
    struct job job = {0};
    int shown = -1;
    for (int round = 0;; round++) {
        if (!get_job(client, id, &job)) {
            return COMMAND_FAILED;
        }
        const int percent = (int)(100.0 * job.progress);
        if (percent != shown || job_is_final(&job)) {
            (void)fprintf(stderr, "%s %s %d %%\n", job.id, job.state, percent);
            shown = percent;
        }
        if (job_is_final(&job)) {
            break;
        }
        if (seconds_now() > deadline) {
            (void)fprintf(stderr, "aerom: %s is still %s\n", job.id, job.state);
            return COMMAND_TIMEOUT;
        }
        pause_between(round);
    }
    if (job.error[0] != '\0') {
        (void)fprintf(stderr, "aerom: %s: %s\n", job.id, job.error);
    }
    return strcmp(job.state, "done") == 0 ? COMMAND_OK : COMMAND_FAILED;
}

static double deadline_of(const struct options *o)
{
    return o->timeout_s < 0.0 ? 1e300 : seconds_now() + o->timeout_s;
}

static int worst(int a, int b)
{
    return a > b ? a : b;
}

/* Submits one file; *job is the accepted job. */
static bool submit_file(struct http_client *client, const char *file, struct job *job)
{
    char *text = NULL;
    size_t size = 0;
    struct http_answer answer = {0};
    bool done = false;
    if (!file_read(file, router_body_max("POST", "/v1/jobs"), &text, &size)) {
        return false;
    }
    if (ask(client, file, "POST", "/v1/jobs", text, size, &answer)) {
        done = job_parse(answer.body, answer.size, job);
    }
    if (done) {
        (void)printf("%s %s %s%s\n", job->id, job->state, file, job->reused ? " (reused)" : "");
        (void)fflush(stdout);
    }
    http_answer_done(&answer);
    free(text);
    return done;
}

int remote_submit(int argc, char **argv)
{
    struct options o;
    if (!options_parse(argc, argv, "uwt", 1, -1, &o)) {
        return command_usage("submit");
    }
    int code = COMMAND_OK;
    const int n = o.n_operand;
    struct job *job = calloc((size_t)n, sizeof *job);
    struct http_client *client = connect_to(&o);
    if (client == NULL || job == NULL) {
        code = COMMAND_FAILED;
        goto out;
    }
    for (int i = 0; i < n; i++) {
        if (!submit_file(client, o.operand[i], &job[i])) {
            code = COMMAND_FAILED;
        }
    }
    const double deadline = deadline_of(&o);
    for (int i = 0; o.wait && i < n; i++) {
        if (job[i].id[0] != '\0') {
            code = worst(code, wait_for(client, job[i].id, deadline));
        }
    }
out:
    http_client_destroy(client);
    free(job);
    return code;
}

int remote_wait(int argc, char **argv)
{
    struct options o;
    if (!options_parse(argc, argv, "ut", 1, -1, &o)) {
        return command_usage("wait");
    }
    struct http_client *client = connect_to(&o);
    const double deadline = deadline_of(&o);
    int code = client == NULL ? COMMAND_FAILED : COMMAND_OK;
    for (int i = 0; client != NULL && i < o.n_operand; i++) {
        code = worst(code, wait_for(client, o.operand[i], deadline));
    }
    http_client_destroy(client);
    return code;
}

/* Fetches a path; the answer is the caller's. */
static bool fetch(const struct options *o, const char *path, struct http_answer *answer)
{
    struct http_client *client = connect_to(o);
    const bool done = client != NULL && ask(client, o->operand[0], "GET", path, NULL, 0, answer);
    http_client_destroy(client);
    return done;
}

/* Appends "&key=value" (or "?" first) when there is a value; only plain values are possible. */
static bool add_query(char path[PATH_MAX_SIZE], const char *key, const char *value)
{
    if (value == NULL) {
        return true;
    }
    if (!is_plain(value)) {
        (void)fprintf(stderr, "aerom: '%s' is no %s\n", value, key);
        return false;
    }
    const size_t used = strlen(path);
    (void)snprintf(path + used, PATH_MAX_SIZE - used, "%c%s=%s",
                   strchr(path, '?') == NULL ? '?' : '&', key, value);
    return true;
}

/* The documents get knows, and their place below the job or the study. */
static const struct document {
    const char *name, *collection, *tail;
} documents[] = {
    {"job", "jobs", ""},
    {"summary", "jobs", "/summary"},
    {"case", "jobs", "/case"},
    {"series", "jobs", "/series"},
    {"damping", "jobs", "/damping"},
    {"loads", "jobs", "/loads"},
    {"modes", "jobs", "/modes"},
    {"section", "jobs", "/section"},
    {"static", "jobs", "/static"},
    {"stability", "jobs", "/stability"},
    {"training", "jobs", "/training"},
    {"network", "jobs", "/network"},
    {"study", "studies", ""},
    {"cells", "studies", "/cells"},
    {"map", "studies", "/map"},
    {"boundary", "studies", "/boundary"},
    {"optimum", "studies", "/optimum"},
    {"uncertainty", "studies", "/uncertainty"},
};

static const struct document *find_document(const char *name)
{
    for (size_t i = 0; i < sizeof documents / sizeof documents[0]; i++) {
        if (strcmp(documents[i].name, name) == 0) {
            return &documents[i];
        }
    }
    return NULL;
}

int remote_get(int argc, char **argv)
{
    struct options o;
    char path[PATH_MAX_SIZE];
    if (!options_parse(argc, argv, "ucV", 1, 2, &o)) {
        return command_usage("get");
    }
    const struct document *d = find_document(o.n_operand == 2 ? o.operand[1] : "summary");
    if (d == NULL || (o.csv && strcmp(d->name, "series") != 0 && strcmp(d->name, "map") != 0) ||
        (o.value != NULL && strcmp(d->name, "map") != 0)) {
        return command_usage("get");
    }
    struct http_answer answer = {0};
    if (!path_of(o.operand[0], d->collection, d->tail, path) ||
        !add_query(path, "format", o.csv ? "csv" : NULL) || !add_query(path, "value", o.value) ||
        !fetch(&o, path, &answer)) {
        return COMMAND_FAILED;
    }
    bool done = file_write("-", answer.body, answer.size);
    if (done && (answer.size == 0 || answer.body[answer.size - 1] != '\n')) {
        done = file_write("-", "\n", 1);
    }
    http_answer_done(&answer);
    return done ? COMMAND_OK : COMMAND_FAILED;
}

int remote_show(int argc, char **argv)
{
    struct options o;
    if (!options_parse(argc, argv, "u", 1, 1, &o)) {
        return command_usage("show");
    }
    struct http_answer answer = {0};
    char path[PATH_MAX_SIZE];
    if (!job_path(o.operand[0], "/summary", path) || !fetch(&o, path, &answer)) {
        return COMMAND_FAILED;
    }
    const bool shown = report_summary(stdout, answer.body, answer.size);
    http_answer_done(&answer);
    return shown ? COMMAND_OK : COMMAND_FAILED;
}

int remote_cancel(int argc, char **argv)
{
    struct options o;
    if (!options_parse(argc, argv, "u", 1, -1, &o)) {
        return command_usage("cancel");
    }
    struct http_client *client = connect_to(&o);
    int code = client == NULL ? COMMAND_FAILED : COMMAND_OK;
    for (int i = 0; client != NULL && i < o.n_operand; i++) {
        char path[PATH_MAX_SIZE];
        struct http_answer answer = {0};
        struct job job = {0};
        if (job_path(o.operand[i], "", path) &&
            ask(client, o.operand[i], "DELETE", path, NULL, 0, &answer) &&
            job_parse(answer.body, answer.size, &job)) {
            (void)printf("%s %s\n", job.id, job.state);
        } else {
            code = COMMAND_FAILED;
        }
        http_answer_done(&answer);
    }
    http_client_destroy(client);
    return code;
}

int remote_list(int argc, char **argv)
{
    struct options o;
    char path[PATH_MAX_SIZE] = "/v1/jobs";
    if (!options_parse(argc, argv, "usknj", 0, 0, &o) || !add_query(path, "state", o.state) ||
        !add_query(path, "kind", o.kind) || !add_query(path, "limit", o.limit)) {
        return command_usage("list");
    }
    struct http_client *client = connect_to(&o);
    struct http_answer answer = {0};
    bool done = client != NULL && ask(client, "list", "GET", path, NULL, 0, &answer);
    if (done && o.json) {
        done = file_write("-", answer.body, answer.size) && file_write("-", "\n", 1);
    } else if (done) {
        done = job_print_list(stdout, answer.body, answer.size);
    }
    http_answer_done(&answer);
    http_client_destroy(client);
    return done ? COMMAND_OK : COMMAND_FAILED;
}

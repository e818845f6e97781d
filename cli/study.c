#include "cli/study.h"

#include "cli/clock.h"
#include "cli/file.h"
#include "cli/report.h"

#include "api/json.h"
#include "api/study_run.h"

#include <cjson/cJSON.h>
#include <pthread.h>
#include <stdatomic.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

enum { THREADS_MAX = 64, FAILURES_SHOWN = 20 };

/* What the threads share. */
struct computation {
    const struct library *library;
    const char *canonical;
    int n_cell, piece; /* places of the order a thread takes at a time */
    atomic_int next;   /* first place nobody has */
    atomic_bool no_memory;
    pthread_mutex_t mutex; /* guards the rest */
    struct study_map *map;
    bool absent, composite; /* no cell has the value so far; it is more than one value */
    int failed;
};

bool study_text(const char *text, size_t size)
{
    struct cJSON *tree = NULL;
    struct failure fail;
    const bool is = json_parse(text, size, &tree, &fail) == ST_OK && study_is_one(tree);
    json_free(tree);
    return is;
}

static void report_problems(const char *file, enum status st, const struct failure_list *problems)
{
    if (problems != NULL && problems->count > 0) {
        report_failures(stderr, file, problems);
    } else {
        (void)fprintf(stderr, "aerom: %s: %s\n", file, status_text(st));
    }
}

/* -- threads ---------------------------------------------------------------------------- */

static void enter(struct computation *c, int cell, const struct study_cell_result *r)
{
    cJSON *summary = r->summary != NULL ? cJSON_Parse(r->summary) : NULL;
    (void)pthread_mutex_lock(&c->mutex);
    const enum study_value_kind kind = study_map_set(c->map, cell, r->state, summary);
    if (summary != NULL) {
        c->absent = c->absent && kind == STUDY_VALUE_ABSENT;
        c->composite = c->composite || kind == STUDY_VALUE_NONE;
    }
    if (r->state == STUDY_CELL_FAILED && c->failed++ < FAILURES_SHOWN) {
        (void)fprintf(stderr, "cell %d failed (%s): %s\n", cell, r->code, r->detail);
    }
    (void)pthread_mutex_unlock(&c->mutex);
    cJSON_Delete(summary);
}

static enum status compute_piece(struct computation *c, struct study *s, struct study_runner *r,
                                 int from)
{
    enum status st = ST_OK;
    for (int place = from; st == ST_OK && place < from + c->piece && place < c->n_cell; place++) {
        char hash[LIMIT_HASH];
        struct study_cell_result result;
        const int cell = study_cell_at(s, place);
        st = study_runner_begin(r, cell, hash);
        if (st == ST_OK) {
            st = study_runner_compute(r, NULL, &result);
        }
        if (st == ST_OK) {
            enter(c, cell, &result);
            study_cell_result_done(&result);
        }
    }
    return st;
}

static void *thread_main(void *arg)
{
    struct computation *c = arg;
    struct study *s = NULL;
    struct study_runner *r = NULL;
    struct failure_list *problems = calloc(1, sizeof *problems);
    enum status st =
        problems != NULL ? study_open(c->library, c->canonical, &s, problems) : ST_NO_MEMORY;
    if (st == ST_OK) {
        r = study_runner_create(s, clock_thread_cpu);
        st = r != NULL ? ST_OK : ST_NO_MEMORY;
    }
    int from = 0;
    while (st == ST_OK && (from = atomic_fetch_add(&c->next, c->piece)) < c->n_cell) {
        st = compute_piece(c, s, r, from);
    }
    if (st != ST_OK) {
        atomic_store(&c->no_memory, true);
    }
    study_runner_destroy(r);
    study_destroy(s);
    free(problems);
    return NULL;
}

/* All cells, by this thread and as many more as there are cores. */
static void compute(struct computation *c)
{
    pthread_t thread[THREADS_MAX];
    const long cores = sysconf(_SC_NPROCESSORS_ONLN);
    const int pieces = (c->n_cell + c->piece - 1) / c->piece;
    int n = 0;
    while (n + 1 < cores && n + 1 < pieces && n < THREADS_MAX &&
           pthread_create(&thread[n], NULL, thread_main, c) == 0) {
        n++;
    }
    (void)thread_main(c);
    for (int i = 0; i < n; i++) {
        (void)pthread_join(thread[i], NULL);
    }
}

/* -- the study -------------------------------------------------------------------------- */

static bool print_map(const struct study *s, const struct study_map *m)
{
    struct json_out out = {0};
    size_t size = 0;
    json_object_begin(&out);
    json_key_string(&out, "name", study_name(s));
    study_map_members(&out, m);
    json_object_end(&out);
    char *text = json_out_take(&out, &size);
    const bool done = text != NULL && file_write("-", text, size) && file_write("-", "\n", 1);
    free(text);
    return done;
}

static bool run(const char *file, const struct library *lib, const struct study *s,
                struct study_map *m)
{
    const struct study_plan plan = study_plan_of(s);
    struct computation c = {.library = lib,
                            .canonical = study_canonical(s),
                            .n_cell = plan.n_cell,
                            .piece = plan.unit,
                            .map = m,
                            .absent = true};
    (void)pthread_mutex_init(&c.mutex, NULL);
    compute(&c);
    (void)pthread_mutex_destroy(&c.mutex);
    if (c.failed > FAILURES_SHOWN) {
        (void)fprintf(stderr, "and %d more cells failed\n", c.failed - FAILURES_SHOWN);
    }
    if (atomic_load(&c.no_memory)) {
        (void)fprintf(stderr, "aerom: %s: %s\n", file, status_text(ST_NO_MEMORY));
        return false;
    }
    if (c.composite || (c.absent && c.failed < c.n_cell)) {
        (void)fprintf(stderr, "aerom: --value: the summary of a cell has no single '%s'\n",
                      m->value_name);
        return false;
    }
    return print_map(s, m);
}

bool study_run(const struct options *o, const struct library *lib, const char *text, size_t size)
{
    const char *file = o->operand[0];
    struct study *s = NULL;
    struct study_map m = {.value_name = o->value};
    bool done = false;
    struct failure_list *problems = calloc(1, sizeof *problems);
    enum status st = ST_NO_MEMORY;
    if (problems != NULL) {
        st = study_parse(lib, text, size, &s, problems);
    }
    if (st != ST_OK) {
        report_problems(file, st, problems);
        goto out;
    }
    if (m.value_name == NULL) {
        m.value_name = study_main_value(s);
    }
    study_map_axes(s, &m);
    if (!study_map_init(&m)) {
        report_problems(file, ST_NO_MEMORY, NULL);
        goto out;
    }
    done = run(file, lib, s, &m);
out:
    study_map_done(&m);
    study_destroy(s);
    free(problems);
    return done;
}

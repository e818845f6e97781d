#include "cli/run.h"

#include "cli/command.h"
#include "cli/file.h"
#include "cli/options.h"
#include "cli/report.h"

#include "api/case.h"
#include "api/channel.h"
#include "api/json_out.h"
#include "api/result.h"
#include "api/router.h"
#include "api/series_out.h"

#include <stdlib.h>
#include <string.h>
#include <time.h>

static double cpu_seconds(void)
{
    struct timespec t = {0};
    (void)clock_gettime(CLOCK_THREAD_CPUTIME_ID, &t);
    return (double)t.tv_sec + 1e-9 * (double)t.tv_nsec;
}

static bool has_document(enum case_kind kind, const char *document)
{
    const char *const *known = result_documents(kind);
    while (*known != NULL && strcmp(*known, document) != 0) {
        known++;
    }
    if (*known == NULL) {
        (void)fprintf(stderr, "aerom: this kind of case has no document '%s'\n", document);
    }
    return *known != NULL;
}

static bool read_case(const struct library *lib, const char *file, struct api_case **out)
{
    char *text = NULL;
    size_t size = 0;
    if (!file_read(file, router_body_max("POST", "/v1/jobs"), &text, &size)) {
        return false;
    }
    struct failure_list *problems = calloc(1, sizeof *problems);
    enum status st = ST_NO_MEMORY;
    if (problems != NULL) {
        st = api_case_parse(lib, text, size, "", out, problems);
    }
    if (problems != NULL && problems->count > 0) {
        report_failures(stderr, file, problems);
    } else if (st != ST_OK) {
        (void)fprintf(stderr, "aerom: %s: %s\n", file, status_text(st));
    }
    free(problems);
    free(text);
    return st == ST_OK;
}

/* The record of the run in presented units; freed with series_data_done. */
static bool series_of(const struct case_def *def, const struct sim *sim, struct series_data *out)
{
    const struct sim_result *r = sim_result(sim);
    struct series_data data = {.step = r->sample_step, .n = r->n_sample};
    data.column = calloc((size_t)r->n_column + 1, sizeof *data.column);
    for (int j = 0; data.column != NULL && j < r->n_column; j++) {
        double scale = 1.0;
        struct series_column *column = &data.column[j];
        column->value = calloc((size_t)r->n_sample + 1, sizeof *column->value);
        if (column->value == NULL || !channel_column(def, j, column->name, &scale)) {
            goto out;
        }
        data.n_column = j + 1;
        const double *value = sim_column(sim, j);
        for (int i = 0; i < r->n_sample; i++) {
            column->value[i] = value[i] * scale;
        }
    }
    if (data.column != NULL) {
        *out = data;
        return true;
    }
out:
    series_data_done(&data);
    return false;
}

static bool write_series(const struct case_def *def, const struct sim *sim, const char *file)
{
    struct series_data data;
    if (!series_of(def, sim, &data)) {
        (void)fprintf(stderr, "aerom: %s: out of memory\n", file);
        return false;
    }
    size_t size = 0;
    struct json_out out = {0};
    series_out_csv(&out, &data, 0);
    char *csv = json_out_take(&out, &size);
    const bool done = csv != NULL && file_write(file, csv, size);
    free(csv);
    series_data_done(&data);
    return done;
}

static bool write_document(const struct options *o, const struct api_case *c, const struct sim *sim,
                           double cpu_s)
{
    const struct run_timing timing = {.cpu_s = cpu_s};
    const char *document = o->document != NULL ? o->document : "summary";
    char *text = result_document(document, c, sim_result(sim), &timing);
    bool done = text != NULL;
    if (done && o->text) {
        done = report_summary(stdout, text, strlen(text));
    } else if (done) {
        done = file_write("-", text, strlen(text)) && file_write("-", "\n", 1);
    }
    free(text);
    return done;
}

static bool compute(const struct options *o, const struct api_case *c)
{
    const struct case_def *def = api_case_def(c);
    struct sim *sim = NULL;
    struct failure fail = {0};
    const double start = cpu_seconds();
    enum status st = sim_create(def, &sim, &fail);
    if (st == ST_OK) {
        st = sim_run(sim, NULL, &fail);
    }
    const double cpu_s = cpu_seconds() - start;
    bool done = false;
    if (st != ST_OK) {
        const struct failure_list list = {.count = 1, .total = 1, .item = {fail}};
        report_failures(stderr, o->operand[0], &list);
        goto out;
    }
    done = write_document(o, c, sim, cpu_s) &&
           (o->series == NULL || write_series(def, sim, o->series));
out:
    sim_destroy(sim);
    return done;
}

int run_main(int argc, char **argv)
{
    struct options o;
    if (!options_parse(argc, argv, "odx", 1, 1, &o) || (o.text && o.document != NULL)) {
        return command_usage("run");
    }
    struct library *lib = NULL;
    struct api_case *c = NULL;
    struct failure fail = {0};
    bool done = false;
    if (library_create_builtin(&lib, &fail) != ST_OK) {
        (void)fprintf(stderr, "aerom: shipped library: %s: %s\n", fail.pointer, fail.detail);
        goto out;
    }
    if (!read_case(lib, o.operand[0], &c)) {
        goto out;
    }
    const enum case_kind kind = api_case_def(c)->kind;
    if (o.document != NULL && !has_document(kind, o.document)) {
        goto out;
    }
    if (o.series != NULL && !case_kind_records(kind)) {
        (void)fprintf(stderr, "aerom: a case of kind %s has no series\n", case_kind_name(kind));
        goto out;
    }
    done = compute(&o, c);
out:
    api_case_destroy(c);
    library_destroy(lib);
    return done ? COMMAND_OK : COMMAND_FAILED;
}

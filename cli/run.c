#include "cli/run.h"

#include "cli/clock.h"
#include "cli/command.h"
#include "cli/file.h"
#include "cli/options.h"
#include "cli/report.h"
#include "cli/study.h"

#include "api/case.h"
#include "api/channel.h"
#include "api/json_out.h"
#include "api/result.h"
#include "api/router.h"
#include "api/series_out.h"

#include <stdlib.h>
#include <string.h>

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

static bool read_case(const struct library *lib, const char *file, const char *text, size_t size,
                      struct api_case **out)
{
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
    const double start = clock_thread_cpu();
    enum status st = sim_create(def, &sim, &fail);
    if (st == ST_OK) {
        st = sim_run(sim, NULL, &fail);
    }
    const double cpu_s = clock_thread_cpu() - start;
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

static bool run_case(const struct options *o, const struct library *lib, const char *text,
                     size_t size)
{
    struct api_case *c = NULL;
    if (o->value != NULL) {
        (void)fprintf(stderr, "aerom: --value is for studies\n");
        return false;
    }
    if (!read_case(lib, o->operand[0], text, size, &c)) {
        return false;
    }
    const enum case_kind kind = api_case_def(c)->kind;
    bool done = o->document == NULL || has_document(kind, o->document);
    if (done && o->series != NULL && !case_kind_records(kind)) {
        (void)fprintf(stderr, "aerom: a case of kind %s has no series\n", case_kind_name(kind));
        done = false;
    }
    done = done && compute(o, c);
    api_case_destroy(c);
    return done;
}

static bool run_text(const struct options *o, const struct library *lib, const char *text,
                     size_t size)
{
    if (!study_text(text, size)) {
        return run_case(o, lib, text, size);
    }
    if (o->document != NULL || o->series != NULL || o->text) {
        (void)fprintf(stderr, "aerom: a study has a map and nothing else: --value\n");
        return false;
    }
    return study_run(o, lib, text, size);
}

int run_main(int argc, char **argv)
{
    struct options o;
    if (!options_parse(argc, argv, "odxV", 1, 1, &o) || (o.text && o.document != NULL)) {
        return command_usage("run");
    }
    struct library *lib = NULL;
    struct failure fail = {0};
    char *text = NULL;
    size_t size = 0;
    bool done = false;
    if (library_create_builtin(&lib, &fail) != ST_OK) {
        (void)fprintf(stderr, "aerom: shipped library: %s: %s\n", fail.pointer, fail.detail);
    } else if (file_read(o.operand[0], router_body_max("POST", "/v1/jobs"), &text, &size)) {
        done = run_text(&o, lib, text, size);
    }
    free(text);
    library_destroy(lib);
    return done ? COMMAND_OK : COMMAND_FAILED;
}

#include "cli/train.h"

#include "api/both_threads.h"
#include "cli/command.h"
#include "cli/progress.h"
#include "cli/report.h"
#include "cli/training.h"

#include <stdio.h>
#include <stdlib.h>

static void training_done(struct training *t)
{
    network_def_done(&t->entry.def);
    free(t->entry.description);
    free(t->entry.provenance);
    training_result_done(&t->result);
    records_done(&t->records);
    sources_done(&t->sources);
    free(t->problems);
    free(t);
}

static bool succeed(struct training *t, enum status st, const char *what)
{
    if (t->problems->total > 0) {
        report_failures(stderr, what, t->problems);
    } else if (st != ST_OK) {
        (void)fprintf(stderr, "aerom: %s: %s\n", what, status_text(st));
    }
    return st == ST_OK;
}

/* The network moves on into the entry. */
static enum status run(struct training *t)
{
    struct progress progress;
    progress_start(&progress);
    const struct sim_control control = {.both = both_threads, .progress = &progress.share};
    const enum status st =
        training_run(&t->def, t->records.n, t->records.record, &control, &t->result, t->problems);
    progress_stop(&progress);
    t->entry.def = t->result.network;
    t->result.network = (struct network_def){.n_in = 0};
    return st;
}

static bool train(const struct options *o, struct training *t)
{
    return training_set(o, t) && sources_init(&t->sources) &&
           source_polar(o->polar, &t->sources, t->problems, &t->def.data.polar) &&
           records_read(o->operand[0], t->problems, &t->records) &&
           succeed(t, run(t), o->operand[0]) && training_write(o, t) && training_print(t);
}

int train_main(int argc, char **argv)
{
    struct options o;
    if (!options_parse(argc, argv, "WAXBLCIPHKZQUGTROEYS", 1, 1, &o) || o.output == NULL) {
        return command_usage("train");
    }
    struct training *t = calloc(1, sizeof *t);
    struct failure_list *problems = calloc(1, sizeof *problems);
    if (t == NULL || problems == NULL) {
        (void)fprintf(stderr, "aerom: out of memory\n");
        free(t);
        free(problems);
        return COMMAND_FAILED;
    }
    t->problems = problems;
    const bool done = train(&o, t);
    training_done(t);
    return done ? COMMAND_OK : COMMAND_FAILED;
}

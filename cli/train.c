#include "cli/train.h"

#include "cli/command.h"
#include "cli/report.h"
#include "cli/training.h"

#include "core/num.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

static void training_done(struct training *t)
{
    network_def_done(&t->entry.def);
    free(t->entry.description);
    free(t->entry.provenance);
    free(t->assessment);
    free(t->fold);
    ensemble_members_done(ENSEMBLE_MEMBERS_MAX, t->member);
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

/* Errors of a network on the records that are marked. */
static enum status assess(const struct training *t, const struct network_def *net,
                          const bool *which, struct assessment *out)
{
    struct polar *polar = NULL;
    struct network *network = NULL;
    enum status st = polar_create(t->dataset_def.polar, &polar);
    st = st == ST_OK ? network_create(net, &network) : st;
    for (int i = 0; i < t->records.n && st == ST_OK; i++) {
        if (which == NULL || which[i]) {
            st = assess_record(&t->records.record[i], t->dataset_def.window, polar, network,
                               &out[i]);
        }
    }
    polar_destroy(polar);
    network_destroy(network);
    return st;
}

/* Deals the records that move out to the folds, in an order drawn from the seed; -1 for the others.
 */
static void deal(const struct training *t, int *fold)
{
    uint64_t seed = t->dataset_def.seed;
    int moving = 0;
    for (int i = 0; i < t->records.n; i++) {
        fold[i] = flow_record_moves(&t->records.record[i]) ? moving++ % t->folds : -1;
    }
    for (int i = t->records.n - 1; i > 0; i--) {
        const int k = (int)(dataset_uniform(&seed) * (i + 1));
        if (fold[i] >= 0 && fold[k] >= 0) {
            const int keep = fold[i];
            fold[i] = fold[k];
            fold[k] = keep;
        }
    }
}

/* Trains on all records but those of a fold, as the network itself is trained, and assesses these.
 */
static enum status train_fold(struct training *t, const int *fold, int number,
                              struct flow_record *rest, bool *which)
{
    struct ensemble_member *member = calloc((size_t)t->members, sizeof *member);
    struct network_def net = t->entry.def;
    int n = 0;
    for (int i = 0; i < t->records.n; i++) {
        which[i] = fold[i] == number;
        if (!which[i]) {
            rest[n++] = t->records.record[i];
        }
    }
    net.n_hidden = t->member_hidden;
    enum status st = member != NULL ? ensemble_train(&t->dataset_def, &t->def, t->members, n, rest,
                                                     NULL, &net, member, t->problems)
                                    : ST_NO_MEMORY;
    if (st == ST_OK) {
        ensemble_members_done(t->members, member);
        st = assess(t, &net, which, t->fold);
        network_def_done(&net);
    }
    free(member);
    return st;
}

static enum status cross_validate(struct training *t)
{
    if (t->folds == 0) {
        return ST_OK;
    }
    const size_t n = (size_t)t->records.n;
    int *fold = malloc(n * sizeof *fold);
    struct flow_record *rest = malloc(n * sizeof *rest);
    bool *which = malloc(n * sizeof *which);
    t->fold = calloc(n, sizeof *t->fold);
    enum status st =
        fold != NULL && rest != NULL && which != NULL && t->fold != NULL ? ST_OK : ST_NO_MEMORY;
    if (st == ST_OK) {
        deal(t, fold);
    }
    for (int k = 0; k < t->folds && st == ST_OK; k++) {
        st = train_fold(t, fold, k, rest, which);
    }
    free(fold);
    free(rest);
    free(which);
    return st;
}

static enum status train_and_assess(struct training *t)
{
    struct network_def *net = &t->entry.def;
    memcpy(net->polar_hash, t->dataset_def.polar->hash, sizeof net->polar_hash);
    enum status st = cross_validate(t);
    if (st == ST_OK) {
        st = ensemble_train(&t->dataset_def, &t->def, t->members, t->records.n, t->records.record,
                            NULL, net, t->member, t->problems);
    }
    t->assessment = calloc((size_t)t->records.n, sizeof *t->assessment);
    if (st == ST_OK && t->assessment == NULL) {
        st = ST_NO_MEMORY;
    }
    return st == ST_OK ? assess(t, net, NULL, t->assessment) : st;
}

static bool train(const struct options *o, struct training *t)
{
    return training_set(o, t) && sources_init(&t->sources) &&
           source_polar(o->polar, &t->sources, t->problems, &t->dataset_def.polar) &&
           records_read(o->operand[0], t->problems, &t->records) &&
           succeed(t, train_and_assess(t), o->operand[0]) && training_write(o, t) &&
           training_print(t);
}

int train_main(int argc, char **argv)
{
    struct options o;
    if (!options_parse(argc, argv, "WAXBLIPHKZQUOEYS", 1, 1, &o) || o.output == NULL) {
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

#include "cli/train.h"

#include "cli/command.h"
#include "cli/file.h"
#include "cli/options.h"
#include "cli/records.h"
#include "cli/report.h"
#include "cli/source.h"

#include "core/network/assess.h"
#include "core/network/train.h"
#include "core/num.h"

#include <stdlib.h>
#include <string.h>

/* Everything one training reads and makes. */
struct training {
    struct sources sources;
    struct records records;
    struct failure_list *problems;
    struct dataset_def dataset_def;
    struct dataset dataset;
    struct train_def def;
    struct train_curve curve;
    struct network_entry entry;
    struct assessment *assessment; /* one a record */
};

static void training_done(struct training *t)
{
    network_def_done(&t->entry.def);
    free(t->entry.description);
    free(t->entry.provenance);
    free(t->assessment);
    train_curve_done(&t->curve);
    dataset_done(&t->dataset);
    records_done(&t->records);
    sources_done(&t->sources);
    free(t->problems);
}

static bool is_word(const char *list, size_t length, const char *name)
{
    return strlen(name) == length && strncmp(list, name, length) == 0;
}

/* Names separated by commas; those of the paper when there are none. */
static bool set_inputs(const char *list, struct network_def *net)
{
    const char *p = list != NULL ? list : "mean_alpha,delta_alpha,alpha_rate,alpha_acceleration";
    net->n_in = 0;
    while (*p != '\0') {
        const size_t length = strcspn(p, ",");
        int k = 0;
        while (k < NET_IN_COUNT && !is_word(p, length, network_input_name((enum network_input)k))) {
            k++;
        }
        for (int i = 0; i < net->n_in; i++) {
            k = (int)net->input[i] == k ? NET_IN_COUNT : k; /* twice is a mistake as well */
        }
        if (k == NET_IN_COUNT) {
            (void)fprintf(stderr, "aerom: --inputs: '%.*s' is no input, or stands twice\n",
                          (int)length, p);
            return false;
        }
        net->input[net->n_in++] = (enum network_input)k;
        p += length + (p[length] == ',');
    }
    if (net->n_in == 0) {
        (void)fprintf(stderr, "aerom: --inputs: a network needs one\n");
    }
    return net->n_in > 0;
}

static bool set_def(const struct options *o, struct training *t)
{
    const char *optimiser = o->optimiser != NULL ? o->optimiser : "lm";
    const enum train_optimiser kind = train_optimiser_of(optimiser);
    struct network_def *net = &t->entry.def;
    if (kind == TRAIN_OPTIMISERS) {
        (void)fprintf(stderr, "aerom: --optimiser: '%s' is not one of lm, adam\n", optimiser);
        return false;
    }
    const char *name = o->name != NULL ? o->name : "trained";
    if (name[0] == '\0' || strlen(name) >= LIMIT_NAME) {
        (void)fprintf(stderr, "aerom: --name: 1..63 bytes\n");
        return false;
    }
    memcpy(net->name, name, strlen(name) + 1);
    net->n_hidden = options_whole(o->hidden, 50);
    net->n_out = 2;
    net->output[0] = NET_OUT_CL;
    net->output[1] = NET_OUT_CM;
    train_def_defaults(kind, &t->def);
    t->def.epochs = options_whole(o->epochs, t->def.epochs);
    t->def.decay = options_given(o->decay, t->def.decay);
    const int seed = options_whole(o->seed, 1);
    t->def.seed = (uint64_t)seed;
    dataset_def_defaults(&t->dataset_def);
    t->dataset_def.seed = (uint64_t)seed;
    if (seed < 0) {
        (void)fprintf(stderr, "aerom: --seed: a whole number, 0..1000000\n");
        return false;
    }
    train_def_check(&t->def, net->n_hidden, t->problems);
    if (t->problems->total > 0) {
        report_failures(stderr, "train", t->problems);
    }
    return t->problems->total == 0 && set_inputs(o->inputs, net);
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

static enum status assess_all(struct training *t)
{
    struct polar *polar = NULL;
    struct network *network = NULL;
    t->assessment = calloc((size_t)t->records.n, sizeof *t->assessment);
    enum status st = t->assessment != NULL ? ST_OK : ST_NO_MEMORY;
    st = st == ST_OK ? polar_create(t->dataset_def.polar, &polar) : st;
    st = st == ST_OK ? network_create(&t->entry.def, &network) : st;
    for (int i = 0; i < t->records.n && st == ST_OK; i++) {
        st = assess_record(&t->records.record[i], t->dataset_def.window, polar, network,
                           &t->assessment[i]);
    }
    polar_destroy(polar);
    network_destroy(network);
    return st;
}

static double work_of(const struct assess_work *w)
{
    return w->pitch + w->plunge;
}

static bool print(const struct training *t)
{
    (void)printf("epoch,trained,held\n");
    for (int i = 0; i < t->curve.n; i++) {
        (void)printf("%d,%.6g,%.6g\n", i, t->curve.trained[i], t->curve.held[i]);
    }
    (void)printf(
        "# kept epoch %d; %d records, %d held out; %d samples, mirrored, and %d; %d outside "
        "the polar\n",
        t->curve.best, t->records.n, t->dataset.n_held, t->dataset.trained.n, t->dataset.held.n,
        t->dataset.outside_polar);
    (void)printf("record,part,cl_rms,cl_steady_rms,cl_range,cm_rms,cm_steady_rms,cm_range,work,"
                 "network_work,steady_work,energy_error\n");
    for (int i = 0; i < t->records.n; i++) {
        const struct assessment *a = &t->assessment[i];
        (void)printf("%s,%s,%.5f,%.5f,%.5f,%.5f,%.5f,%.5f,%.6f,%.6f,%.6f,%.4f\n",
                     t->records.record[i].name, t->dataset.is_held[i] ? "held" : "trained",
                     a->network_cl, a->steady_cl, a->range_cl, a->network_cm, a->steady_cm,
                     a->range_cm, work_of(&a->record), work_of(&a->network), work_of(&a->steady),
                     assess_energy_error(&a->network, &a->record));
    }
    return fflush(stdout) == 0 && !ferror(stdout);
}

static void write_names(const struct training *t, bool held, const char *key, struct json_out *out)
{
    json_key(out, key);
    json_array_begin(out);
    for (int i = 0; i < t->records.n; i++) {
        if (t->dataset.is_held[i] == held) {
            json_string(out, t->records.record[i].name);
        }
    }
    json_array_end(out);
}

/* What the numbers come from: enough to make them again. */
static char *provenance(const struct training *t)
{
    const struct polar_def *polar = t->dataset_def.polar;
    struct json_out out = {0};
    json_object_begin(&out);
    json_key_string(&out, "made_by", "aerom train");
    json_key_string(&out, "core_version", AEROM_CORE_VERSION);
    json_key_string(&out, "polar", polar->name);
    json_key_string(&out, "polar_hash", polar->hash);
    json_key_number(&out, "window_c_v", t->dataset_def.window);
    json_key_integer(&out, "samples_max", t->dataset_def.samples_max);
    json_key_integer(&out, "anchors", t->dataset_def.anchors);
    json_key_integer(&out, "samples_trained", t->dataset.trained.n);
    json_key_integer(&out, "samples_held", t->dataset.held.n);
    json_key_string(&out, "optimiser", train_optimiser_name(t->def.optimiser));
    json_key_integer(&out, "seed", (long long)t->def.seed);
    json_key_number(&out, "decay", t->def.decay);
    json_key_integer(&out, "epochs", t->curve.n - 1);
    json_key_integer(&out, "epoch_kept", t->curve.best);
    json_key_number(&out, "mean_square_error_trained", t->curve.trained[t->curve.best]);
    json_key_number(&out, "mean_square_error_held", t->curve.held[t->curve.best]);
    write_names(t, false, "records_trained", &out);
    write_names(t, true, "records_held", &out);
    json_object_end(&out);
    return json_out_take(&out, NULL);
}

static char *quoted(const char *text)
{
    struct json_out out = {0};
    json_string(&out, text != NULL ? text : "dynamic increment of c_l and c_m, trained on records");
    return json_out_take(&out, NULL);
}

static bool write(const struct options *o, struct training *t)
{
    struct json_out out = {0};
    size_t size = 0;
    t->entry.provenance = provenance(t);
    t->entry.description = quoted(o->description);
    network_write(&out, &t->entry);
    json_out_text(&out, "\n");
    char *text = json_out_take(&out, &size);
    bool done = t->entry.provenance != NULL && t->entry.description != NULL && text != NULL;
    if (!done) {
        (void)fprintf(stderr, "aerom: %s: out of memory\n", o->output);
    }
    done = done && file_write(o->output, text, size);
    free(text);
    return done;
}

static bool train(const struct options *o, struct training *t)
{
    return set_def(o, t) && sources_init(&t->sources) &&
           source_polar(o->polar, &t->sources, t->problems, &t->dataset_def.polar) &&
           records_read(o->operand[0], t->problems, &t->records) &&
           succeed(t,
                   dataset_build(&t->dataset_def, t->records.n, t->records.record, t->problems,
                                 &t->dataset),
                   o->operand[0]) &&
           succeed(t,
                   train_network(&t->dataset, &t->def, NULL, &t->entry.def, &t->curve, t->problems),
                   o->operand[0]) &&
           succeed(t, assess_all(t), o->operand[0]) && write(o, t) && print(t);
}

int train_main(int argc, char **argv)
{
    struct options o;
    if (!options_parse(argc, argv, "WAXIPHOEYS", 1, 1, &o) || o.output == NULL) {
        return command_usage("train");
    }
    struct training t = {.problems = calloc(1, sizeof *t.problems)};
    if (t.problems == NULL) {
        (void)fprintf(stderr, "aerom: out of memory\n");
        return COMMAND_FAILED;
    }
    const bool done = train(&o, &t);
    training_done(&t);
    return done ? COMMAND_OK : COMMAND_FAILED;
}

#include "cli/training.h"

#include "cli/file.h"

#include <stdio.h>
#include <stdlib.h>

static double work_of(const struct assess_work *w)
{
    return w->pitch + w->plunge;
}

static void print_curve(const struct training *t, int k)
{
    const struct ensemble_member *m = &t->result.member[k];
    if (t->result.n_member > 1) {
        (void)printf("# member %d of %d\n", k + 1, t->result.n_member);
    }
    (void)printf("epoch,trained,held\n");
    for (int i = 0; i < m->curve.n; i++) {
        (void)printf("%d,%.6g,%.6g\n", i, m->curve.trained[i], m->curve.held[i]);
    }
    (void)printf("# kept epoch %d; %d records, %d held out; %d samples, mirrored, and %d; %d "
                 "outside the polar\n",
                 m->curve.best, t->records.n, m->n_held_record, m->n_trained, m->n_held,
                 m->outside_polar);
}

static void print_rows(const struct training *t, const struct assessment *assessment,
                       const char *part)
{
    for (int i = 0; i < t->records.n; i++) {
        const struct assessment *a = &assessment[i];
        if (!(a->range_cl > 0.0)) {
            continue; /* a record at rest has no fold */
        }
        (void)printf("%s,%s,%.5f,%.5f,%.5f,%.5f,%.5f,%.5f,%.6f,%.6f,%.6f,%.4f\n",
                     t->records.record[i].name,
                     part != NULL ? part : (t->result.is_held[i] ? "held" : "trained"),
                     a->network_cl, a->steady_cl, a->range_cl, a->network_cm, a->steady_cm,
                     a->range_cm, work_of(&a->record), work_of(&a->network), work_of(&a->steady),
                     assess_energy_error(&a->network, &a->record));
    }
}

bool training_print(const struct training *t)
{
    for (int k = 0; k < t->result.n_member; k++) {
        print_curve(t, k);
    }
    (void)printf("record,part,cl_rms,cl_steady_rms,cl_range,cm_rms,cm_steady_rms,cm_range,work,"
                 "network_work,steady_work,energy_error\n");
    print_rows(t, t->result.assessment, NULL);
    if (t->result.fold != NULL) {
        print_rows(t, t->result.fold, "fold");
    }
    return fflush(stdout) == 0 && !ferror(stdout);
}

static void write_names(const struct training *t, bool held, const char *key, struct json_out *out)
{
    json_key(out, key);
    json_array_begin(out);
    for (int i = 0; i < t->records.n; i++) {
        if (t->result.is_held[i] == held) {
            json_string(out, t->records.record[i].name);
        }
    }
    json_array_end(out);
}

static void write_members(const struct training *t, struct json_out *out)
{
    json_key(out, "members");
    json_array_begin(out);
    for (int k = 0; k < t->result.n_member; k++) {
        const struct ensemble_member *m = &t->result.member[k];
        json_object_begin(out);
        json_key_integer(out, "hidden", t->def.network.n_hidden);
        json_key_integer(out, "seed", (long long)t->def.train.seed + k);
        json_key_integer(out, "samples_trained", m->n_trained);
        json_key_integer(out, "samples_held", m->n_held);
        json_key_integer(out, "epochs", m->curve.n - 1);
        json_key_integer(out, "epoch_kept", m->curve.best);
        json_key_number(out, "mean_square_error_trained", m->curve.trained[m->curve.best]);
        json_key_number(out, "mean_square_error_held", m->curve.held[m->curve.best]);
        json_object_end(out);
    }
    json_array_end(out);
}

/* What the numbers come from: enough to make them again. */
static char *provenance(const struct training *t)
{
    const struct polar_def *polar = t->def.data.polar;
    struct json_out out = {0};
    json_object_begin(&out);
    json_key_string(&out, "made_by", "aerom train");
    json_key_string(&out, "core_version", AEROM_CORE_VERSION);
    json_key_string(&out, "polar", polar->name);
    json_key_string(&out, "polar_hash", polar->hash);
    json_key_number(&out, "window_c_v", t->def.data.window);
    json_key_integer(&out, "samples_max", t->def.data.samples_max);
    json_key_integer(&out, "anchors", t->def.data.anchors);
    json_key_string(&out, "optimiser", train_optimiser_name(t->def.train.optimiser));
    json_key_integer(&out, "seed", (long long)t->def.train.seed);
    json_key_number(&out, "decay", t->def.train.decay);
    json_key_number(&out, "balance", t->def.data.balance);
    json_key_number(&out, "tolerance", t->def.train.tolerance);
    json_key(&out, "symmetric");
    json_boolean(&out, t->def.train.symmetric);
    write_members(t, &out);
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

bool training_write(const struct options *o, struct training *t)
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

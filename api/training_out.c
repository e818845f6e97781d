#include "api/training_out.h"

#include "api/case_fields.h"
#include "api/dataset.h"
#include "api/library_set.h"

#include <assert.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

struct training_out {
    const struct api_case *c;
    struct dataset_entry data;
    struct training_result result;
    struct entry_set network; /* the one trained, as it is read from its document */
    char hash[LIMIT_HASH];
    char *head, *text;
};

/* -- the network as an entry -------------------------------------------------------------- */

static void write_names(struct json_out *out, const struct training_out *t, bool held,
                        const char *key)
{
    json_key(out, key);
    json_array_begin(out);
    for (int i = 0; i < t->data.n_record; i++) {
        if (t->result.is_held[i] == held) {
            json_string(out, t->data.record[i].name);
        }
    }
    json_array_end(out);
}

/* How each training of the mean went. */
static void write_members(struct json_out *out, const struct training_out *t)
{
    json_key(out, "members");
    json_array_begin(out);
    for (int k = 0; k < t->result.n_member; k++) {
        const struct ensemble_member *m = &t->result.member[k];
        json_object_begin(out);
        json_key_integer(out, "seed", t->c->training.seed + k);
        json_key_integer(out, "epochs", m->curve.n - 1);
        json_key_integer(out, "epoch_kept", m->curve.best);
        json_key_number(out, "mean_square_error_trained", m->curve.trained[m->curve.best]);
        json_key_number(out, "mean_square_error_held", m->curve.held[m->curve.best]);
        json_key_integer(out, "records_held", m->n_held_record);
        json_key_integer(out, "samples_trained", m->n_trained);
        json_key_integer(out, "samples_held", m->n_held);
        json_key_integer(out, "outside_polar", m->outside_polar);
        json_object_end(out);
    }
    json_array_end(out);
}

/* What the numbers come from: enough to make them again. */
static char *provenance(const struct training_out *t)
{
    const struct training_entry *e = &t->c->training;
    const struct polar_def *polar = e->def.data.polar;
    struct json_out out = {0};
    json_object_begin(&out);
    json_key_string(&out, "made_by", "aeromd, kind training");
    json_key_string(&out, "case_hash", api_case_hash(t->c));
    json_key_string(&out, "core_version", AEROM_CORE_VERSION);
    json_key_string(&out, "dataset", e->dataset);
    json_key_string(&out, "dataset_hash", e->dataset_hash);
    json_key_string(&out, "polar", polar->name);
    json_key_string(&out, "polar_hash", polar->hash);
    json_key(&out, "definition");
    field_write(&out, training_fields, CASE_IN_TRAINING, t->c);
    write_members(&out, t);
    write_names(&out, t, false, "records_trained");
    write_names(&out, t, true, "records_held");
    json_object_end(&out);
    return json_out_take(&out, NULL);
}

/* Through its own document, so that what is kept has passed every check of an upload. */
static enum status make_entry(struct training_out *t)
{
    static const char description[] = "\"dynamic increment of the coefficients, trained here\"";
    struct network_entry e = {.def = t->result.network, .description = strdup(description)};
    struct json_out out = {0};
    size_t size = 0;
    e.provenance = provenance(t);
    network_write(&out, &e);
    char *text = json_out_take(&out, &size);
    struct failure_list *problems = calloc(1, sizeof *problems);
    enum status st = ST_NO_MEMORY;
    if (e.description != NULL && e.provenance != NULL && text != NULL && problems != NULL) {
        st = entry_parse(text, size, entry_read_network, &t->network, problems);
    }
    if (st == ST_OK) {
        (void)library_item(&t->network, SHELF_NETWORK, t->hash, &t->head, &t->text);
        st = t->head != NULL && t->text != NULL ? ST_OK : ST_NO_MEMORY;
    }
    free(problems);
    free(text);
    free(e.description);
    free(e.provenance);
    return st;
}

/* -- computing ---------------------------------------------------------------------------- */

static enum status load(struct training_out *t, struct failure *fail)
{
    const struct training_entry *e = &t->c->training;
    if (dataset_load(t->c->library, e->dataset, &t->data, NULL) == SERVICE_OK &&
        strcmp(t->data.hash, e->dataset_hash) == 0) {
        return ST_OK;
    }
    failure_set(fail, ST_INVALID, "/training/dataset", "unknown_dataset", NULL, e->dataset,
                "the dataset is no longer there");
    return ST_INVALID;
}

static enum status train(struct training_out *t, const struct sim_control *control,
                         struct failure *fail)
{
    struct failure_list *problems = calloc(1, sizeof *problems);
    enum status st = ST_NO_MEMORY;
    if (problems != NULL) {
        st = training_run(&t->c->training.def, t->data.n_record, t->data.record, control,
                          &t->result, problems);
    }
    if (st != ST_OK && problems != NULL && problems->count > 0) {
        *fail = problems->item[0];
    }
    free(problems);
    return st;
}

enum status training_compute(const struct api_case *c, const struct sim_control *control,
                             struct training_out **out, struct failure *fail)
{
    struct training_out *t = calloc(1, sizeof *t);
    enum status st = t != NULL ? ST_OK : ST_NO_MEMORY;
    *fail = (struct failure){.status = ST_OK};
    if (st == ST_OK) {
        t->c = c;
        st = load(t, fail);
    }
    st = st == ST_OK ? train(t, control, fail) : st;
    st = st == ST_OK ? make_entry(t) : st;
    if (st == ST_OK) {
        sim_control_tell(control, 1.0);
        *out = t;
        return ST_OK;
    }
    training_out_destroy(t);
    if (fail->code[0] == '\0') {
        failure_set(fail, st, "/training", status_name(st), NULL, NULL, "the training ended: %s",
                    status_text(st));
    }
    return st;
}

void training_out_destroy(struct training_out *t)
{
    if (t != NULL) {
        dataset_entry_done(&t->data);
        training_result_done(&t->result);
        entry_set_done(&t->network);
        free(t->head);
        free(t->text);
        free(t);
    }
}

struct shelf_item training_item(const struct training_out *t)
{
    return (struct shelf_item){.kind = SHELF_NETWORK,
                               .name = t->network.network[0].def.name,
                               .hash = t->hash,
                               .head = t->head,
                               .job = "",
                               .data = t->text,
                               .size = strlen(t->text)};
}

/* -- documents ---------------------------------------------------------------------------- */

static void write_work(struct json_out *out, const char *key, const struct assess_work *w)
{
    json_key(out, key);
    json_object_begin(out);
    json_key_number(out, "pitch", w->pitch);
    json_key_number(out, "plunge", w->plunge);
    json_object_end(out);
}

/* What networks that have not seen the record make of it; null without, and for one at rest. */
static void write_fold(struct json_out *out, const struct training_out *t, int i)
{
    if (t->result.fold == NULL || !flow_record_moves(&t->data.record[i])) {
        json_null(out);
        return;
    }
    const struct assessment *a = &t->result.fold[i];
    json_object_begin(out);
    json_key_number(out, "cl_rms", a->network_cl);
    json_key_number(out, "cm_rms", a->network_cm);
    json_key_number(out, "energy_error", assess_energy_error(&a->network, &a->record));
    json_object_end(out);
}

static void write_assessment(struct json_out *out, const struct training_out *t, int i)
{
    const struct assessment *a = &t->result.assessment[i];
    json_object_begin(out);
    json_key_string(out, "name", t->data.record[i].name);
    json_key_string(out, "part", t->result.is_held[i] ? "held" : "trained");
    json_key_number(out, "cl_range", a->range_cl);
    json_key_number(out, "cl_rms", a->network_cl);
    json_key_number(out, "cl_rms_polar", a->steady_cl);
    json_key_number(out, "cm_range", a->range_cm);
    json_key_number(out, "cm_rms", a->network_cm);
    json_key_number(out, "cm_rms_polar", a->steady_cm);
    write_work(out, "work", &a->record);
    write_work(out, "work_network", &a->network);
    write_work(out, "work_polar", &a->steady);
    json_key_number(out, "energy_error", assess_energy_error(&a->network, &a->record));
    json_key_number(out, "outside_hull", a->outside_hull);
    json_key(out, "fold");
    write_fold(out, t, i);
    json_object_end(out);
}

static void write_curve(struct json_out *out, const struct train_curve *curve, int seed)
{
    json_object_begin(out);
    json_key_integer(out, "seed", seed);
    json_key_integer(out, "epoch_kept", curve->best);
    json_key(out, "curve");
    json_object_begin(out);
    json_key_numbers(out, "trained", curve->n, curve->trained, 1, 1.0);
    json_key_numbers(out, "held", curve->n, curve->held, 1, 1.0);
    json_object_end(out);
    json_object_end(out);
}

static void write_training(struct json_out *out, const struct training_out *t)
{
    json_object_begin(out);
    json_key(out, "members");
    json_array_begin(out);
    for (int k = 0; k < t->result.n_member; k++) {
        write_curve(out, &t->result.member[k].curve, t->c->training.seed + k);
    }
    json_array_end(out);
    json_key(out, "records");
    json_array_begin(out);
    for (int i = 0; i < t->result.n_record; i++) {
        write_assessment(out, t, i);
    }
    json_array_end(out);
    json_object_end(out);
}

enum part { PART_TRAINED, PART_HELD, PART_FOLDS, PARTS };
static const char *const part_name[PARTS] = {
    [PART_TRAINED] = "trained", [PART_HELD] = "held", [PART_FOLDS] = "folds"};

/* Root mean square over the moving records of a part, of the errors by their range. */
static void write_part(struct json_out *out, const struct training_out *t, enum part part)
{
    double cl = 0.0, cm = 0.0, cl_polar = 0.0, cm_polar = 0.0;
    int n = 0;
    for (int i = 0; i < t->result.n_record; i++) {
        const struct assessment *a =
            part == PART_FOLDS ? &t->result.fold[i] : &t->result.assessment[i];
        if ((part == PART_FOLDS || t->result.is_held[i] == (part == PART_HELD)) &&
            flow_record_moves(&t->data.record[i])) {
            cl += num_sq(a->network_cl / a->range_cl);
            cm += num_sq(a->network_cm / a->range_cm);
            cl_polar += num_sq(a->steady_cl / a->range_cl);
            cm_polar += num_sq(a->steady_cm / a->range_cm);
            n++;
        }
    }
    json_key(out, part_name[part]);
    json_object_begin(out);
    json_key_integer(out, "moving_records", n);
    json_key_number(out, "cl_rms_of_range", sqrt(cl / n));
    json_key_number(out, "cm_rms_of_range", sqrt(cm / n));
    json_key_number(out, "cl_rms_of_range_polar", sqrt(cl_polar / n));
    json_key_number(out, "cm_rms_of_range_polar", sqrt(cm_polar / n));
    json_object_end(out);
}

static void write_identity(struct json_out *out, const struct training_out *t)
{
    const struct training_entry *e = &t->c->training;
    json_key(out, "identity");
    json_object_begin(out);
    json_key_string(out, "content_hash", api_case_hash(t->c));
    json_key_string(out, "core_version", AEROM_CORE_VERSION);
    json_key(out, "polar");
    json_object_begin(out);
    json_key_string(out, "name", e->def.data.polar->name);
    json_key_string(out, "hash", e->def.data.polar->hash);
    json_object_end(out);
    json_key(out, "dataset");
    json_object_begin(out);
    json_key_string(out, "name", e->dataset);
    json_key_string(out, "hash", e->dataset_hash);
    json_object_end(out);
    json_object_end(out);
}

static void write_summary(struct json_out *out, const struct training_out *t,
                          const struct run_timing *timing)
{
    json_object_begin(out);
    json_key_string(out, "kind", case_kind_name(CASE_TRAINING));
    json_key_string(out, "name", api_case_def(t->c)->name);
    json_key(out, "network");
    json_object_begin(out);
    json_key_string(out, "name", t->c->training.def.network.name);
    json_key_string(out, "hash", t->hash);
    json_object_end(out);
    json_key_integer(out, "records", t->result.n_record);
    write_members(out, t);
    for (int part = 0; part < (t->result.fold != NULL ? PARTS : PART_FOLDS); part++) {
        write_part(out, t, (enum part)part);
    }
    json_key(out, "timing");
    json_object_begin(out);
    json_key_number(out, "cpu_s", timing->cpu_s);
    json_object_end(out);
    write_identity(out, t);
    json_object_end(out);
}

char *training_document(const char *document, const struct training_out *t,
                        const struct run_timing *timing)
{
    struct json_out out = {0};
    if (strcmp(document, "summary") == 0) {
        write_summary(&out, t, timing);
    } else if (strcmp(document, "training") == 0) {
        write_training(&out, t);
    } else {
        assert(strcmp(document, "network") == 0);
        json_out_text(&out, t->text);
    }
    return json_out_take(&out, NULL);
}

#include "api/training_fields.h"

#include "api/case_fields.h"
#include "api/case_refs.h"
#include "api/dataset.h"
#include "api/entry_fields.h"

#include <cjson/cJSON.h>
#include <math.h>
#include <stdio.h>
#include <string.h>

static const struct field_range hidden = {.min = 1, .max = LIMIT_NET_HIDDEN};
static const struct field_range epochs = {.min = 1, .max = TRAIN_EPOCHS_MAX};
static const struct field_range seed = {.min = 0, .max = 1000000};
static const struct field_range batch = {.min = 1, .max = 1000000};
static const struct field_range samples = {.min = 1, .max = FLOW_SAMPLES_MAX};
static const struct field_range anchors = {.min = 0, .max = FLOW_SAMPLES_MAX};
static const struct field_range members = {.min = 1, .max = ENSEMBLE_MEMBERS_MAX};
static const struct field_range folds = {.min = 0, .max = TRAINING_FOLDS_MAX};
static const struct field_range decay = {.min = 0.0, .max = 1.0};
static const struct field_range balance = {.min = 0.0, .max = 1.0};
static const struct field_range tolerance = {.min = 0.0, .max = 1.0};
static const struct field_range rate = {.min = 0.0, .max = 1.0, .above_min = true};
static const struct field_range window = {.min = 0.0, .max = 1000.0, .above_min = true};
static const struct field_range share = {
    .min = 0.0, .max = 1.0, .above_min = true, .below_max = true};

/* Sets what the optimiser decides: how long it is patient. */
static void read_optimiser(struct reader *r, const struct cJSON *json, void *base)
{
    struct training_def *d = &((struct api_case *)base)->training.def;
    const enum train_optimiser kind =
        cJSON_IsString(json) ? train_optimiser_of(json->valuestring) : TRAIN_OPTIMISERS;
    if (kind == TRAIN_OPTIMISERS) {
        reader_problem(r, cJSON_IsString(json) ? "unknown_value" : "wrong_type", "\"lm\", \"adam\"",
                       json, "the value must be one of lm, adam");
        return;
    }
    train_def_defaults(kind, &d->train);
}

static void write_optimiser(struct json_out *out, const void *base)
{
    json_string(
        out, train_optimiser_name(((const struct api_case *)base)->training.def.train.optimiser));
}

static void read_dataset(struct reader *r, const struct cJSON *json, void *base)
{
    struct api_case *c = base;
    char name[LIMIT_NAME];
    int version = 0;
    if (!cJSON_IsString(json)) {
        reader_problem(r, "wrong_type", "a name", json, "the value must be a name");
        return;
    }
    if (dataset_find(c->library, json->valuestring, name, &version, c->training.dataset_hash) !=
        SERVICE_OK) {
        reader_problem(r, "unknown_dataset", "a dataset of the library", json,
                       "the library has no such dataset; /v1/datasets lists them");
        return;
    }
    (void)snprintf(c->training.dataset, sizeof c->training.dataset, "%s@%d", name, version);
}

static void write_dataset(struct json_out *out, const void *base)
{
    json_string(out, ((const struct api_case *)base)->training.dataset);
}

#define AT(member_) offsetof(struct api_case, training.member_)
#define NUMBER(key_, member_, range_)                                                              \
    {                                                                                              \
        .key = (key_), .kind = FIELD_NUMBER, .offset = AT(member_), .unit = 1.0,                   \
        .range = &(range_)                                                                         \
    }
#define INTEGER(key_, member_, range_)                                                             \
    {                                                                                              \
        .key = (key_), .kind = FIELD_INTEGER, .offset = AT(member_), .range = &(range_)            \
    }
#define NAMES(key_, member_, count_, names_, max_)                                                 \
    {                                                                                              \
        .key = (key_), .kind = FIELD_NAMES, .offset = AT(def.network.member_), .names = (names_),  \
        .count = AT(def.network.count_), .min = 1, .max = (max_)                                   \
    }

/* The optimiser before what it has defaults for. */
const struct field training_fields[] = {
    {.key = "network",
     .kind = FIELD_TEXT,
     .required = true,
     .offset = AT(def.network.name),
     .size = LIMIT_NAME},
    {.key = "dataset",
     .kind = FIELD_CUSTOM,
     .required = true,
     .read = read_dataset,
     .write = write_dataset},
    {.key = "polar",
     .kind = FIELD_CUSTOM,
     .required = true,
     .read = case_read_polar,
     .write = case_write_polar},
    {.key = "base",
     .kind = FIELD_ENUM,
     .offset = AT(def.network.frame.base),
     .names = network_base_names},
    {.key = "lags_c_v",
     .kind = FIELD_ARRAY,
     .offset = AT(def.network.frame.lag),
     .count = AT(def.network.frame.n_lag),
     .max = NETWORK_LAGS},
    {.key = "oscillators",
     .kind = FIELD_LIST,
     .offset = AT(def.network.frame.oscillator),
     .size = sizeof(struct network_oscillator),
     .fields = network_oscillator_fields,
     .count = AT(def.network.frame.n_oscillator),
     .max = NETWORK_OSCILLATORS,
     .start = network_oscillator_start},
    NAMES("inputs", input, n_in, network_input_names, LIMIT_NET_INPUTS),
    NAMES("outputs", output, n_out, network_output_names, LIMIT_NET_OUTPUTS),
    INTEGER("hidden", def.network.n_hidden, hidden),
    INTEGER("members", def.members, members),
    INTEGER("folds", def.folds, folds),
    {.key = "optimiser", .kind = FIELD_CUSTOM, .read = read_optimiser, .write = write_optimiser},
    INTEGER("epochs", def.train.epochs, epochs),
    INTEGER("patience", def.train.patience, epochs),
    NUMBER("decay", def.train.decay, decay),
    NUMBER("rate", def.train.rate, rate),
    INTEGER("batch", def.train.batch, batch),
    INTEGER("seed", seed, seed),
    NUMBER("window_c_v", def.data.window, window),
    INTEGER("samples_max", def.data.samples_max, samples),
    INTEGER("anchors", def.data.anchors, anchors),
    NUMBER("balance", def.data.balance, balance),
    NUMBER("tolerance", def.train.tolerance, tolerance),
    {.key = "symmetric", .kind = FIELD_BOOLEAN, .offset = AT(def.train.symmetric)},
    NUMBER("held_share", def.data.held_share, share),
    {0},
};

/* What only shows together: inputs without their lag or base, too many neurons. */
static void check_network(struct reader *r, const struct training_def *d)
{
    const long long neurons = (long long)d->members * d->network.n_hidden;
    network_def_check_frame(&d->network, r->pointer, r->problems);
    training_def_check_parts(d, r->pointer, r->problems);
    if (neurons > LIMIT_NET_HIDDEN) {
        const size_t mark = reader_enter_key(r, "members");
        char expected[48];
        (void)snprintf(expected, sizeof expected, "members * hidden <= %d", LIMIT_NET_HIDDEN);
        reader_problem(r, "out_of_range", expected, NULL,
                       "%d members of %d neurons are a network of %lld", d->members,
                       d->network.n_hidden, neurons);
        reader_leave(r, mark);
    }
    if (d->folds == 1) {
        const size_t mark = reader_enter_key(r, "folds");
        reader_problem(r, "out_of_range", "0, or 2 and more", NULL,
                       "one fold would leave nothing to train on");
        reader_leave(r, mark);
    }
}

void training_finish(struct reader *r, const struct cJSON *json, void *base)
{
    struct api_case *c = base;
    struct training_entry *t = &c->training;
    const char *name = t->def.network.name;
    (void)json;
    t->def.train.seed = (uint64_t)t->seed;
    t->def.data.seed = (uint64_t)t->seed;
    t->def.data.polar = c->def.aero.polar;
    check_network(r, &t->def);
    const size_t mark = reader_enter_key(r, "network");
    if (name[0] != '\0' && library_is_built_in(c->library, SHELF_NETWORK, name)) {
        reader_problem(r, "built_in", "a name of your own", NULL,
                       "the name belongs to a network that is built in");
    } else if (name[0] != '\0' && !shelf_name_is_allowed(name)) {
        reader_problem(r, "bad_name", "1..63 letters, digits, and any of ._+/-", NULL,
                       "the name has characters a reference cannot have");
    }
    reader_leave(r, mark);
}

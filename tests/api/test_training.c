/* Documents of a training against the schemas, and the network it leaves against a new reading. */
#include "api/dataset.h"
#include "api/embedded.h"
#include "api/entry.h"
#include "api/json.h"
#include "api/training_out.h"
#include "tests/api/schema_check.h"

#include <cjson/cJSON.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

#define CASE(more)                                                                                 \
    "{\"schema_version\":1,\"kind\":\"training\",\"training\":{\"network\":\"small\","             \
    "\"dataset\":\"plate-4pct\",\"polar\":\"plate-4pct-channel\",\"hidden\":3,\"epochs\":3,"       \
    "\"inputs\":[\"mean_alpha\",\"alpha_rate\"],\"samples_max\":20,\"anchors\":10" more "}}"

#define LAG_CASE(more)                                                                             \
    "{\"schema_version\":1,\"kind\":\"training\",\"training\":{\"network\":\"lags\","              \
    "\"dataset\":\"plate-4pct\",\"polar\":\"plate-4pct-channel\",\"hidden\":3,\"epochs\":3,"       \
    "\"base\":\"dynamic_stall\",\"lags_c_v\":[1,4],\"oscillators\":[{\"f_c_v\":0.7,"               \
    "\"damping\":0.2}],\"inputs\":[\"alpha_lag_2\",\"stall_bubble\",\"alpha_oscillator_1\"],"      \
    "\"samples_max\":20,\"anchors\":10" more "}}"

struct fixture {
    struct library *lib;
    cJSON *doc;
    struct failure_list problems;
};

static int setup(void **state)
{
    struct failure fail;
    struct fixture *f = calloc(1, sizeof *f);
    *state = f;
    return library_create_builtin(&f->lib, &fail) == ST_OK &&
                   json_parse(openapi_files[0].data, embedded_size(&openapi_files[0]), &f->doc,
                              &fail) == ST_OK
               ? 0
               : -1;
}

static int teardown(void **state)
{
    struct fixture *f = *state;
    json_free(f->doc);
    library_destroy(f->lib);
    free(f);
    return 0;
}

static struct api_case *parse(struct fixture *f, const char *json)
{
    struct api_case *c = NULL;
    assert_int_equal(api_case_parse(f->lib, json, strlen(json), "", &c, &f->problems), ST_OK);
    return c;
}

static char *check(struct fixture *f, const struct training_out *t, const char *name,
                   const char *schema)
{
    struct cJSON *tree = NULL;
    struct failure fail;
    char why[256];
    char *text = training_document(name, t, &(const struct run_timing){.cpu_s = 0.5});
    assert_non_null(text);
    assert_int_equal(json_parse(text, strlen(text), &tree, &fail), ST_OK);
    if (!schema_check(f->doc, schema_node(f->doc, schema), tree, why)) {
        fail_msg("%s: %s in %.300s", name, why, text);
    }
    json_free(tree);
    return text;
}

static void test_documents(void **state)
{
    struct fixture *f = *state;
    struct failure fail;
    struct training_out *t = NULL;
    struct api_case *c = parse(f, CASE(""));
    _Atomic double progress = 0.0;
    const struct sim_control control = {.progress = &progress};
    assert_int_equal(training_compute(c, &control, &t, &fail), ST_OK);
    assert_true(progress == 1.0);
    free(check(f, t, "summary", "#/components/schemas/SummaryTraining"));
    free(check(f, t, "training", "#/components/schemas/TrainingResult"));
    char *network = check(f, t, "network", "#/components/schemas/Network");
    const struct shelf_item item = training_item(t);
    assert_string_equal(item.data, network);
    struct entry_set set = {0};
    assert_int_equal(entry_parse(network, strlen(network), entry_read_network, &set, &f->problems),
                     ST_OK);
    assert_string_equal(set.network[0].def.hash, item.hash);
    assert_int_equal(set.network[0].def.n_hidden, 3);
    entry_set_done(&set);
    /* The same definition, the same bits. */
    struct training_out *again = NULL;
    assert_int_equal(training_compute(c, NULL, &again, &fail), ST_OK);
    assert_string_equal(training_item(again).hash, item.hash);
    training_out_destroy(again);
    training_out_destroy(t);
    free(network);
    api_case_destroy(c);
}

static void compute(struct fixture *f, const char *json, struct api_case **c,
                    struct training_out **t)
{
    struct failure fail;
    *c = parse(f, json);
    assert_int_equal(training_compute(*c, NULL, t, &fail), ST_OK);
}

static cJSON *document(struct fixture *f, const struct training_out *t, const char *name,
                       const char *schema)
{
    struct failure fail;
    cJSON *tree = NULL;
    char *text = check(f, t, name, schema);
    assert_int_equal(json_parse(text, strlen(text), &tree, &fail), ST_OK);
    free(text);
    return tree;
}

static const cJSON *at(const cJSON *tree, const char *key)
{
    const cJSON *item = cJSON_GetObjectItemCaseSensitive(tree, key);
    assert_non_null(item);
    return item;
}

/* The second of two members is the training with the next seed, and the network has the neurons,
 * base and lags of both, for its polar only. */
static void test_lags_and_members(void **state)
{
    struct fixture *f = *state;
    struct api_case *two, *one;
    struct training_out *pair, *single;
    compute(f, LAG_CASE(",\"members\":2,\"folds\":2"), &two, &pair);
    compute(f, LAG_CASE(",\"seed\":2"), &one, &single);
    cJSON *curves = document(f, pair, "training", "#/components/schemas/TrainingResult");
    cJSON *alone = document(f, single, "training", "#/components/schemas/TrainingResult");
    assert_int_equal(cJSON_GetArraySize(at(curves, "members")), 2);
    const cJSON *second = cJSON_GetArrayItem(at(curves, "members"), 1);
    assert_true(cJSON_Compare(second, cJSON_GetArrayItem(at(alone, "members"), 0), true));
    assert_int_equal(at(second, "seed")->valueint, 2);
    const cJSON *record = NULL;
    int folded = 0;
    cJSON_ArrayForEach(record, at(curves, "records"))
    {
        folded += cJSON_IsObject(at(record, "fold"));
    }
    assert_null(cJSON_GetObjectItem(cJSON_GetArrayItem(at(alone, "records"), 0), "fold")->child);
    cJSON *summary = document(f, pair, "summary", "#/components/schemas/SummaryTraining");
    assert_int_equal(cJSON_GetArraySize(at(summary, "members")), 2);
    /* Every record that moves has been left out once. */
    assert_int_equal(at(at(summary, "folds"), "moving_records")->valueint, folded);
    assert_int_equal(folded, at(at(summary, "held"), "moving_records")->valueint +
                                 at(at(summary, "trained"), "moving_records")->valueint);

    char *network = check(f, pair, "network", "#/components/schemas/Network");
    struct entry_set set = {0};
    assert_int_equal(entry_parse(network, strlen(network), entry_read_network, &set, &f->problems),
                     ST_OK);
    const struct network_def *def = &set.network[0].def;
    assert_int_equal(def->n_hidden, 6);
    assert_int_equal(def->frame.base, NETWORK_ON_STALL);
    assert_int_equal(def->frame.n_lag, 2);
    assert_true(def->frame.lag[0] == 1.0 && def->frame.lag[1] == 4.0);
    assert_int_equal(def->frame.n_oscillator, 1);
    assert_true(def->frame.oscillator[0].frequency == 0.7);
    assert_true(def->frame.oscillator[0].damping == 0.2);
    assert_string_equal(def->polar_hash, api_case_def(two)->aero.polar->hash);
    entry_set_done(&set);
    free(network);
    cJSON_Delete(summary);
    cJSON_Delete(curves);
    cJSON_Delete(alone);
    training_out_destroy(pair);
    training_out_destroy(single);
    api_case_destroy(two);
    api_case_destroy(one);
}

static void test_refusals(void **state)
{
    static const struct {
        const char *json, *pointer, *code;
    } bad[] = {
        {CASE(",\"base\":\"wake\""), "/training/base", "unknown_value"},
        {CASE(",\"lags_c_v\":[1,0]"), "/training/lags_c_v/1", "out_of_range"},
        {CASE(",\"lags_c_v\":[1,2,3,4,5]"), "/training/lags_c_v", "wrong_length"},
        {CASE(",\"oscillators\":[{\"f_c_v\":1}]"), "/training/oscillators/0/damping", "required"},
        {CASE(",\"oscillators\":[{\"f_c_v\":0,\"damping\":0.5}]"), "/training/oscillators/0/f_c_v",
         "out_of_range"},
        {CASE(",\"oscillators\":[{\"f_c_v\":1,\"damping\":1}]"), "/training/oscillators/0/damping",
         "out_of_range"},
        {CASE(",\"members\":0"), "/training/members", "out_of_range"},
        {CASE(",\"folds\":1"), "/training/folds", "out_of_range"},
        {CASE(",\"members\":65"), "/training/members", "out_of_range"},
        {CASE(",\"balance\":2"), "/training/balance", "out_of_range"},
        {CASE(",\"tolerance\":-1"), "/training/tolerance", "out_of_range"},
        {CASE(",\"symmetric\":1"), "/training/symmetric", "wrong_type"},
        {CASE(",\"symmetric\":true"), "/training/hidden", "out_of_range"},
        {"{\"schema_version\":1,\"kind\":\"training\",\"training\":{\"network\":\"odd\","
         "\"dataset\":"
         "\"plate-4pct\",\"polar\":\"plate-4pct-channel\",\"symmetric\":true,"
         "\"outputs\":[\"cl\",\"cd\"]}}",
         "/training/symmetric", "contradiction"},
        {"{\"schema_version\":1,\"kind\":\"training\",\"training\":{\"network\":\"big\","
         "\"dataset\":"
         "\"plate-4pct\",\"polar\":\"plate-4pct-channel\",\"hidden\":257,\"members\":2}}",
         "/training/members", "out_of_range"},
        {"{\"schema_version\":1,\"kind\":\"training\",\"training\":{\"network\":\"swing\","
         "\"dataset\":"
         "\"plate-4pct\",\"polar\":\"plate-4pct-channel\",\"oscillators\":[],"
         "\"inputs\":[\"pitch_rate_oscillator_1\"]}}",
         "/training/inputs/0", "contradiction"},
        {"{\"schema_version\":1,\"kind\":\"training\",\"training\":{\"network\":\"lag\","
         "\"dataset\":"
         "\"plate-4pct\",\"polar\":\"plate-4pct-channel\",\"lags_c_v\":[1],"
         "\"inputs\":[\"alpha_lag_2\"]}}",
         "/training/inputs/0", "contradiction"},
        {"{\"schema_version\":1,\"kind\":\"training\",\"training\":{\"network\":\"lag\","
         "\"dataset\":"
         "\"plate-4pct\",\"polar\":\"plate-4pct-channel\",\"base\":\"attached\","
         "\"inputs\":[\"alpha\",\"stall_lost\"]}}",
         "/training/inputs/1", "contradiction"},
    };
    struct fixture *f = *state;
    for (size_t i = 0; i < sizeof bad / sizeof *bad; i++) {
        struct api_case *c = NULL;
        f->problems = (struct failure_list){0};
        assert_int_equal(
            api_case_parse(f->lib, bad[i].json, strlen(bad[i].json), "", &c, &f->problems),
            ST_INVALID);
        assert_int_equal(f->problems.total, 1);
        assert_string_equal(f->problems.item[0].pointer, bad[i].pointer);
        assert_string_equal(f->problems.item[0].code, bad[i].code);
    }
}

static void test_cancel(void **state)
{
    struct fixture *f = *state;
    struct failure fail;
    struct training_out *t = NULL;
    struct api_case *c = parse(f, CASE(""));
    atomic_bool cancel = true;
    const struct sim_control control = {.cancel = &cancel};
    assert_int_equal(training_compute(c, &control, &t, &fail), ST_CANCELLED);
    assert_null(t);
    api_case_destroy(c);
}

/* What the optimiser decides is filled in; what the case is known by has the dataset in it. */
static void test_defaults(void **state)
{
    struct fixture *f = *state;
    struct api_case *c = parse(f, CASE(",\"optimiser\":\"adam\""));
    const char *text = api_case_canonical(c);
    assert_non_null(strstr(text, "\"dataset\":\"plate-4pct@1\""));
    assert_non_null(strstr(text, "\"patience\":200"));
    struct api_case *again = parse(f, text);
    assert_string_equal(api_case_hash(again), api_case_hash(c));
    assert_string_equal(api_case_canonical(again), text);
    struct api_case *other = parse(f, CASE(",\"optimiser\":\"adam\",\"seed\":2"));
    assert_string_not_equal(api_case_hash(other), api_case_hash(c));
    api_case_destroy(c);
    api_case_destroy(again);
    api_case_destroy(other);
}

int main(void)
{
#define TEST(name) cmocka_unit_test_setup_teardown(name, setup, teardown)
    const struct CMUnitTest tests[] = {TEST(test_documents), TEST(test_lags_and_members),
                                       TEST(test_refusals), TEST(test_cancel), TEST(test_defaults)};
    return cmocka_run_group_tests(tests, NULL, NULL);
}

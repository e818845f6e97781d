/* Datasets: one content in three forms, hostile files, and texts that were damaged at random. */
#include "api/dataset.h"
#include "api/hdf5_dataset.h"
#include "api/json.h"
#include "core/num.h"
#include "core/random.h"

#include <cjson/cJSON.h>
#include <hdf5.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

enum { SAMPLES = 40, RECORDS = 3 };

static struct failure_list problems;

static int reset(void **state)
{
    (void)state;
    memset(&problems, 0, sizeof problems);
    return 0;
}

/* Pitching sections, whose values are short in decimals: three records of one period. */
static double sample(int record, int row, int i)
{
    const double omega = 0.5 + 0.25 * record, t = i * 0.25;
    const double s = sin(omega * t), c = cos(omega * t), a = 0.05;
    const double all[FLOW_ROWS] = {[FLOW_TIME] = t,
                                   [FLOW_THETA] = a * s * 180.0 / NUM_PI,
                                   [FLOW_THETA_RATE] = a * omega * c,
                                   [FLOW_THETA_ACCELERATION] = -a * omega * omega * s,
                                   [FLOW_CL] = 6.0 * a * s,
                                   [FLOW_CD] = 0.05,
                                   [FLOW_CM] = a * c};
    return all[row];
}

static void name_of(int record, char out[16])
{
    (void)snprintf(out, 16, "r%d", record);
}

static char *csv_of(void)
{
    struct json_out out = {0};
    json_out_text(&out, "record,period_c_v,t,alpha_deg,alpha_dot,alpha_ddot,cl,cd,cm\n");
    for (int j = 0; j < RECORDS; j++) {
        for (int i = 0; i < SAMPLES; i++) {
            char text[NUMBER_TEXT_SIZE], name[16];
            name_of(j, name);
            json_out_text(&out, name);
            json_out_text(&out, ",10");
            for (int k = 0; k < FLOW_ROWS; k++) {
                if (k < FLOW_W || k > FLOW_W_ACCELERATION) {
                    json_out_text(&out, ",");
                    json_out_bytes(&out, text, number_text(sample(j, k, i), text));
                }
            }
            json_out_text(&out, "\n");
        }
    }
    return json_out_take(&out, NULL);
}

static char *json_of(void)
{
    struct json_out out = {0};
    json_object_begin(&out);
    json_key_string(&out, "name", "d");
    json_key(&out, "records");
    json_array_begin(&out);
    for (int j = 0; j < RECORDS; j++) {
        char name[16];
        name_of(j, name);
        json_object_begin(&out);
        json_key_string(&out, "name", name);
        json_key_integer(&out, "period_c_v", 10);
        for (int k = 0; k < FLOW_ROWS; k++) {
            double value[SAMPLES];
            for (int i = 0; i < SAMPLES; i++) {
                value[i] = sample(j, k, i);
            }
            json_key_numbers(&out, dataset_columns[DATASET_FLOW + k], SAMPLES, value, 1, 1.0);
        }
        json_object_end(&out);
    }
    json_array_end(&out);
    json_object_end(&out);
    return json_out_take(&out, NULL);
}

/* What is wrong with the file, beside nothing. */
enum fault { SOUND, EXTERNAL_LINK, EXTERNAL_DATA, SHORT_COLUMN, MATRIX, NO_TIMES, TEXT_PERIOD };

static void put_column(hid_t group, int column, int record, enum fault fault)
{
    double value[SAMPLES];
    const char *key = dataset_columns[DATASET_FLOW + column];
    const bool odd = column == FLOW_CL && record == 1;
    const hsize_t extent[2] = {odd && fault == SHORT_COLUMN ? SAMPLES - 1 : SAMPLES, 1};
    for (int i = 0; i < SAMPLES; i++) {
        value[i] = sample(record, column, i);
    }
    if (column == FLOW_TIME && record == 1 && fault == NO_TIMES) {
        return;
    }
    if (odd && fault == EXTERNAL_LINK) {
        assert_true(H5Lcreate_external("/etc/passwd", "/x", group, key, H5P_DEFAULT, H5P_DEFAULT) >=
                    0);
        return;
    }
    const hid_t plist = H5Pcreate(H5P_DATASET_CREATE);
    if (odd && fault == EXTERNAL_DATA) {
        assert_true(H5Pset_external(plist, "/dev/zero", 0, sizeof value) >= 0);
    }
    const hid_t space = H5Screate_simple(odd && fault == MATRIX ? 2 : 1, extent, NULL);
    const hid_t array =
        H5Dcreate2(group, key, H5T_NATIVE_DOUBLE, space, H5P_DEFAULT, plist, H5P_DEFAULT);
    assert_true(array >= 0);
    if (!(odd && fault == EXTERNAL_DATA)) {
        assert_true(H5Dwrite(array, H5T_NATIVE_DOUBLE, H5S_ALL, H5S_ALL, H5P_DEFAULT, value) >= 0);
    }
    (void)H5Dclose(array);
    (void)H5Sclose(space);
    (void)H5Pclose(plist);
}

static void put_period(hid_t group, enum fault fault)
{
    const double period = 10.0;
    const hid_t space = H5Screate(H5S_SCALAR);
    const hid_t type = H5Tcopy(fault == TEXT_PERIOD ? H5T_C_S1 : H5T_NATIVE_DOUBLE);
    const hid_t a = H5Acreate2(group, "period_c_v", type, space, H5P_DEFAULT, H5P_DEFAULT);
    assert_true(H5Awrite(a, type, &period) >= 0);
    (void)H5Aclose(a);
    (void)H5Tclose(type);
    (void)H5Sclose(space);
}

static void *hdf5_of(enum fault fault, size_t *size)
{
    const hid_t access = H5Pcreate(H5P_FILE_ACCESS);
    assert_true(H5Pset_fapl_core(access, 1 << 16, false) >= 0);
    const hid_t file = H5Fcreate("made.h5", H5F_ACC_TRUNC, H5P_DEFAULT, access);
    for (int j = 0; j < RECORDS; j++) {
        char name[16];
        name_of(j, name);
        const hid_t group = H5Gcreate2(file, name, H5P_DEFAULT, H5P_DEFAULT, H5P_DEFAULT);
        put_period(group, fault);
        for (int k = 0; k < FLOW_ROWS; k++) {
            put_column(group, k, j, fault);
        }
        (void)H5Gclose(group);
    }
    assert_true(H5Fflush(file, H5F_SCOPE_GLOBAL) >= 0);
    const ssize_t n = H5Fget_file_image(file, NULL, 0);
    assert_true(n > 0);
    void *bytes = malloc((size_t)n);
    assert_true(H5Fget_file_image(file, bytes, (size_t)n) == n);
    (void)H5Fclose(file);
    (void)H5Pclose(access);
    *size = (size_t)n;
    return bytes;
}

static enum status read_json(const char *text, size_t size, struct dataset_entry *e)
{
    struct cJSON *tree = NULL;
    struct failure fail;
    struct reader r;
    if (json_parse(text, size, &tree, &fail) != ST_OK) {
        *failure_add(&problems) = fail;
        return ST_INVALID;
    }
    reader_init(&r, "", &problems);
    json_check(&r, tree);
    if (problems.total == 0) {
        dataset_read_json(&r, tree, e);
    }
    json_free(tree);
    return problems.total == 0 ? ST_OK : ST_INVALID;
}

static char *text_of(const struct dataset_entry *e)
{
    struct json_out out = {0};
    dataset_write_csv(&out, e);
    return json_out_take(&out, NULL);
}

static void one_content_in_three_forms(void **state)
{
    (void)state;
    struct dataset_entry e[3] = {{.n_record = 0}};
    char *csv = csv_of(), *json = json_of(), *text[3];
    size_t size = 0;
    void *bytes = hdf5_of(SOUND, &size);
    assert_int_equal(dataset_read_csv(csv, strlen(csv), &e[0], &problems), ST_OK);
    assert_int_equal(read_json(json, strlen(json), &e[1]), ST_OK);
    assert_int_equal(hdf5_read_dataset(bytes, size, &e[2], &problems), ST_OK);
    for (int i = 0; i < 3; i++) {
        dataset_check(&e[i], &problems);
        assert_int_equal(problems.total, 0);
        assert_int_equal(e[i].n_record, RECORDS);
        text[i] = text_of(&e[i]);
        assert_string_equal(text[i], text[0]);
    }
    /* The canonical text reads as itself, compressed too. */
    size_t packed_size = 0, text_size = 0;
    void *packed = dataset_compress(text[0], strlen(text[0]), &packed_size);
    assert_true(packed_size < strlen(text[0]));
    char *expanded = dataset_expand(packed, packed_size, &text_size);
    assert_string_equal(expanded, text[0]);
    assert_null(dataset_expand(packed, packed_size - 1, &text_size));
    struct dataset_entry again = {.n_record = 0};
    assert_int_equal(dataset_read_csv(expanded, strlen(expanded), &again, &problems), ST_OK);
    char *second = text_of(&again);
    assert_string_equal(second, text[0]);
    for (int i = 0; i < 3; i++) {
        dataset_entry_done(&e[i]);
        free(text[i]);
    }
    dataset_entry_done(&again);
    free(second);
    free(expanded);
    free(packed);
    free(bytes);
    free(json);
    free(csv);
}

/* Head and hash that the build has made of the shipped dataset are those of its records. */
static void the_shipped_one(void **state)
{
    (void)state;
    struct library *lib = NULL;
    struct failure fail;
    struct dataset_entry e = {.n_record = 0};
    struct shelf_entry kept = {.version = 0};
    char name[LIMIT_NAME], hash[LIMIT_HASH];
    int version = 0;
    assert_int_equal(library_create_builtin(&lib, &fail), ST_OK);
    assert_int_equal(dataset_load(lib, dataset_built_in, &e, &kept), SERVICE_OK);
    assert_int_equal(dataset_find(lib, dataset_built_in, name, &version, hash), SERVICE_OK);
    assert_string_equal(name, e.name);
    assert_string_equal(hash, e.hash);
    assert_int_equal(version, kept.version);
    struct json_out text = {0}, note = {0}, head = {0};
    json_object_begin(&text);
    json_members(&text, kept.head, strlen(kept.head));
    json_object_end(&text);
    struct cJSON *tree = NULL;
    assert_int_equal(json_parse(text.text, text.size, &tree, &fail), ST_OK);
    json_value(&note, cJSON_GetObjectItemCaseSensitive(tree, "description"));
    e.description = json_out_take(&note, NULL);
    dataset_write_head(&head, &e);
    assert_string_equal(head.text, kept.head);
    json_free(tree);
    json_out_done(&text);
    json_out_done(&head);
    dataset_entry_done(&e);
    shelf_entry_done(&kept);
    library_destroy(lib);
}

static void hdf5_stays_in_the_file(void **state)
{
    (void)state;
    static const struct {
        enum fault fault;
        const char *pointer, *code;
    } bad[] = {{EXTERNAL_LINK, "/records/1/cl", "required"},
               {EXTERNAL_DATA, "/records/1/cl", "wrong_length"},
               {SHORT_COLUMN, "/records/1/cl", "wrong_length"},
               {MATRIX, "/records/1/cl", "wrong_length"},
               {NO_TIMES, "/records/1/t", "required"},
               {TEXT_PERIOD, "/records/0/period_c_v", "wrong_type"}};
    for (size_t i = 0; i < sizeof bad / sizeof bad[0]; i++) {
        struct dataset_entry e = {.n_record = 0};
        size_t size = 0;
        void *bytes = hdf5_of(bad[i].fault, &size);
        (void)reset(NULL);
        assert_int_equal(hdf5_read_dataset(bytes, size, &e, &problems), ST_INVALID);
        assert_string_equal(problems.item[0].pointer, bad[i].pointer);
        assert_string_equal(problems.item[0].code, bad[i].code);
        dataset_entry_done(&e);
        free(bytes);
    }
}

/* A file cut anywhere is refused; no bytes at all, and text, too. */
static void hdf5_that_was_cut(void **state)
{
    (void)state;
    size_t size = 0;
    void *bytes = hdf5_of(SOUND, &size);
    for (size_t n = 0; n < size; n += 1 + size / 40) {
        struct dataset_entry e = {.n_record = 0};
        (void)reset(NULL);
        assert_int_equal(hdf5_read_dataset(bytes, n, &e, &problems), ST_INVALID);
        assert_string_equal(problems.item[0].pointer, "/records");
        assert_string_equal(problems.item[0].code, "corrupt");
        dataset_entry_done(&e);
    }
    free(bytes);
}

/* Damaged texts: either nothing is wrong with what is read, or a problem says where. */
static void damaged_texts(void **state)
{
    (void)state;
    static const char alphabet[] = ",\n\r.-e0919\"[]{}:xr\t \x80";
    uint64_t state_of = 7;
    for (int i = 0; i < 600; i++) {
        char *text = i % 2 == 0 ? csv_of() : json_of();
        size_t size = strlen(text);
        const int changes = 1 + (int)(4.0 * random_uniform(&state_of));
        for (int k = 0; k < changes; k++) {
            const size_t at = (size_t)(random_uniform(&state_of) * (double)size);
            const size_t what = (size_t)(random_uniform(&state_of) * (double)(sizeof alphabet - 1));
            text[at] = alphabet[what];
        }
        if (i % 7 == 0) {
            size = (size_t)(random_uniform(&state_of) * (double)size);
        }
        struct dataset_entry e = {.n_record = 0};
        (void)reset(NULL);
        const enum status st =
            i % 2 == 0 ? dataset_read_csv(text, size, &e, &problems) : read_json(text, size, &e);
        assert_true((st == ST_OK) == (problems.total == 0));
        if (st == ST_OK) {
            dataset_check(&e, &problems);
        }
        for (int k = 0; k < problems.count; k++) {
            assert_true(problems.item[k].code[0] != '\0' && problems.item[k].detail[0] != '\0');
        }
        dataset_entry_done(&e);
        free(text);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test_setup(one_content_in_three_forms, reset),
        cmocka_unit_test_setup(the_shipped_one, reset),
        cmocka_unit_test_setup(hdf5_stays_in_the_file, reset),
        cmocka_unit_test_setup(hdf5_that_was_cut, reset),
        cmocka_unit_test_setup(damaged_texts, reset),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}

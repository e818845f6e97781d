/* Maps as CSV, NPY and HDF5: read back by other means than they were written. */
#include "api/hdf5_out.h"
#include "api/map_out.h"
#include "tests/support/unit.h"

#include <hdf5.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

static const double speeds[] = {3.0, 4.5, 6.0};
static const double incidences[] = {1.0, 2.0, 2.5};
static const char *const polars[] = {"flat-plate", "a \"b\", c"};

/* 2 polars x 3 speeds, the incidence zipped to the speed; one cell failed, one is pending. */
static struct study_map map_of(bool texts)
{
    struct study_map m = {.value_name = texts ? "verdict" : "damping.tip_twist",
                          .n_dimension = 2,
                          .shape = {2, 3},
                          .n_axis = 3,
                          .axis = {{"/aerodynamics/polar", 0, 2, NULL, polars},
                                   {"/flow/speed_m_s", 1, 3, speeds, NULL},
                                   {"/flow/incidence_deg", 1, 3, incidences, NULL}}};
    assert_true(study_map_init(&m));
    for (int i = 0; i < 4; i++) {
        m.status[i] = STUDY_CELL_DONE;
        m.value[i] = texts ? i % 2 : 0.25 * i - 0.5;
    }
    m.status[4] = STUDY_CELL_FAILED;
    if (texts) {
        m.n_class = 2;
        (void)snprintf(m.class_name[0], STUDY_CLASS_SIZE, "stable");
        (void)snprintf(m.class_name[1], STUDY_CLASS_SIZE, "stall_flutter");
    }
    return m;
}

static void rows_of_csv(void **state)
{
    (void)state;
    struct study_map m = map_of(false);
    struct json_out out = {0};
    map_out_csv(&out, &m);
    char *text = json_out_take(&out, NULL);
    assert_string_equal(
        text,
        "cell,/aerodynamics/polar,/flow/speed_m_s,/flow/incidence_deg,damping.tip_twist,status\n"
        "0,flat-plate,3,1,-0.5,done\n"
        "1,flat-plate,4.5,2,-0.25,done\n"
        "2,flat-plate,6,2.5,0,done\n"
        "3,\"a \"\"b\"\", c\",3,1,0.25,done\n"
        "4,\"a \"\"b\"\", c\",4.5,2,,failed\n"
        "5,\"a \"\"b\"\", c\",6,2.5,,pending\n");
    free(text);
    study_map_done(&m);
    m = map_of(true);
    out = (struct json_out){0};
    map_out_csv(&out, &m);
    text = json_out_take(&out, NULL);
    assert_non_null(strstr(text, "\n1,flat-plate,4.5,2,stall_flutter,done\n"));
    free(text);
    study_map_done(&m);
}

/* The header by its definition: magic, version 1.0, length, a Python literal, 64-byte blocks. */
static const char *npy_data(const char *file, size_t size, const char *descr, const char *shape)
{
    char expected[128];
    assert_memory_equal(file, "\x93NUMPY\x01\x00", 8);
    const size_t length = (unsigned char)file[8] + 256u * (unsigned char)file[9];
    assert_int_equal((10 + length) % 64, 0);
    assert_true(size > 10 + length);
    assert_int_equal(file[10 + length - 1], '\n');
    const int n =
        snprintf(expected, sizeof expected,
                 "{'descr': '%s', 'fortran_order': False, 'shape': (%s), }", descr, shape);
    assert_memory_equal(file + 10, expected, (size_t)n);
    return file + 10 + length;
}

static void npy_of_numbers_and_texts(void **state)
{
    (void)state;
    struct study_map m = map_of(false);
    struct json_out out = {0};
    size_t size = 0;
    map_out_npy(&out, &m);
    char *file = json_out_take(&out, &size);
    const char *data = npy_data(file, size, "<f8", "2,3,");
    assert_int_equal(size - (size_t)(data - file), 6 * sizeof(double));
    for (int i = 0; i < 6; i++) {
        double value;
        memcpy(&value, data + (size_t)i * sizeof value,
               sizeof value); /* of this little-endian machine */
        assert_true(i < 4 ? value == m.value[i] : isnan(value));
    }
    free(file);
    study_map_done(&m);
    m = map_of(true);
    out = (struct json_out){0};
    map_out_npy(&out, &m);
    file = json_out_take(&out, &size);
    data = npy_data(file, size, "|S48", "2,3,");
    assert_int_equal(size - (size_t)(data - file), 6 * 48);
    assert_string_equal(data + 48, "stall_flutter");
    assert_string_equal(data + 4 * 48, "");
    free(file);
    study_map_done(&m);
}

/* -- HDF5 ------------------------------------------------------------------------------- */

static hid_t open_image(char *image, size_t size)
{
    const hid_t access = H5Pcreate(H5P_FILE_ACCESS);
    assert_true(H5Pset_fapl_core(access, 1 << 16, false) >= 0);
    assert_true(H5Pset_file_image(access, image, size) >= 0);
    const hid_t file = H5Fopen("read.h5", H5F_ACC_RDONLY, access);
    assert_true(file >= 0);
    assert_true(H5Pclose(access) >= 0);
    return file;
}

static void check_shape(hid_t dataset, int rank, const hsize_t *shape)
{
    hsize_t found[8];
    const hid_t space = H5Dget_space(dataset);
    assert_int_equal(H5Sget_simple_extent_ndims(space), rank);
    assert_int_equal(H5Sget_simple_extent_dims(space, found, NULL), rank);
    assert_memory_equal(found, shape, (size_t)rank * sizeof *shape);
    assert_true(H5Sclose(space) >= 0);
}

/* A text or list of texts, as it is stored. */
static void check_text(hid_t object, const char *name, const char *expected, size_t size)
{
    char found[256] = {0};
    const hid_t attribute = H5Aopen(object, name, H5P_DEFAULT);
    assert_true(attribute >= 0);
    const hid_t type = H5Aget_type(attribute);
    assert_int_equal(H5Aget_storage_size(attribute), size);
    assert_true(H5Aread(attribute, type, found) >= 0);
    assert_memory_equal(found, expected, size);
    (void)H5Tclose(type);
    (void)H5Aclose(attribute);
}

static void check_axes(hid_t file)
{
    double value[3];
    int dimension = -1;
    hid_t dataset = H5Dopen2(file, "axis2", H5P_DEFAULT);
    assert_true(H5Dread(dataset, H5T_NATIVE_DOUBLE, H5S_ALL, H5S_ALL, H5P_DEFAULT, value) >= 0);
    assert_memory_equal(value, incidences, sizeof value);
    check_text(dataset, "pointer", "/flow/incidence_deg", sizeof "/flow/incidence_deg");
    const hid_t attribute = H5Aopen(dataset, "dimension", H5P_DEFAULT);
    assert_true(H5Aread(attribute, H5T_NATIVE_INT, &dimension) >= 0);
    assert_int_equal(dimension, 1);
    (void)H5Aclose(attribute);
    (void)H5Dclose(dataset);
    char label[2][10];
    dataset = H5Dopen2(file, "axis0", H5P_DEFAULT);
    const hid_t type = H5Dget_type(dataset);
    assert_int_equal(H5Tget_size(type), 10); /* of "flat-plate" */
    assert_true(H5Dread(dataset, type, H5S_ALL, H5S_ALL, H5P_DEFAULT, label) >= 0);
    assert_memory_equal(label[0], "flat-plate", 10);
    assert_memory_equal(label[1], "a \"b\", c\0\0", 10);
    (void)H5Tclose(type);
    (void)H5Dclose(dataset);
}

static void hdf5_of_numbers(void **state)
{
    (void)state;
    static const hsize_t shape[] = {2, 3};
    struct study_map m = map_of(false);
    size_t size = 0, size_again = 0;
    char *image = hdf5_out_map(&m, &size), *again = hdf5_out_map(&m, &size_again);
    assert_non_null(image);
    assert_int_equal(size, size_again);
    assert_memory_equal(image, again, size);
    const hid_t file = open_image(image, size);
    hid_t dataset = H5Dopen2(file, "values", H5P_DEFAULT);
    double value[6];
    check_shape(dataset, 2, shape);
    check_text(dataset, "value", "damping.tip_twist", sizeof "damping.tip_twist");
    assert_true(H5Dread(dataset, H5T_NATIVE_DOUBLE, H5S_ALL, H5S_ALL, H5P_DEFAULT, value) >= 0);
    for (int i = 0; i < 6; i++) {
        assert_true(i < 4 ? value[i] == m.value[i] : isnan(value[i]));
    }
    (void)H5Dclose(dataset);
    dataset = H5Dopen2(file, "status", H5P_DEFAULT);
    unsigned char status[6];
    check_shape(dataset, 2, shape);
    static const char states[3][16] = {"pending", "done", "failed"};
    check_text(dataset, "states", states[0], sizeof states);
    assert_true(H5Dread(dataset, H5T_NATIVE_UCHAR, H5S_ALL, H5S_ALL, H5P_DEFAULT, status) >= 0);
    assert_memory_equal(status, m.status, sizeof status);
    (void)H5Dclose(dataset);
    check_axes(file);
    (void)H5Fclose(file);
    free(image);
    free(again);
    study_map_done(&m);
}

static void hdf5_of_texts(void **state)
{
    (void)state;
    struct study_map m = map_of(true);
    size_t size = 0;
    char *image = hdf5_out_map(&m, &size);
    char text[6][STUDY_CLASS_SIZE];
    assert_non_null(image);
    const hid_t file = open_image(image, size);
    const hid_t dataset = H5Dopen2(file, "values", H5P_DEFAULT);
    const hid_t type = H5Dget_type(dataset);
    assert_int_equal(H5Tget_size(type), STUDY_CLASS_SIZE);
    assert_true(H5Dread(dataset, type, H5S_ALL, H5S_ALL, H5P_DEFAULT, text) >= 0);
    assert_string_equal(text[0], "stable");
    assert_string_equal(text[3], "stall_flutter");
    assert_string_equal(text[5], "");
    (void)H5Tclose(type);
    (void)H5Dclose(dataset);
    (void)H5Fclose(file);
    free(image);
    study_map_done(&m);
}

static void forms_by_name_and_by_type(void **state)
{
    (void)state;
    for (enum map_format f = 0; f < MAP_FORMATS; f++) {
        assert_int_equal(map_format_of(map_format_name(f)), f);
    }
    assert_int_equal(map_format_of("xls"), MAP_FORMATS);
    assert_int_equal(map_format_accepted(NULL), MAP_JSON);
    assert_int_equal(map_format_accepted("*/*"), MAP_JSON);
    assert_int_equal(map_format_accepted("text/csv"), MAP_CSV);
    assert_int_equal(map_format_accepted("image/svg+xml, application/json;q=0.5"), MAP_SVG);
    assert_int_equal(map_format_accepted("application/x-hdf5"), MAP_HDF5);
    assert_int_equal(map_format_accepted("application/x-npy;q=0.9, */*;q=0.1"), MAP_NPY);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(rows_of_csv),
        cmocka_unit_test(npy_of_numbers_and_texts),
        cmocka_unit_test(hdf5_of_numbers),
        cmocka_unit_test(hdf5_of_texts),
        cmocka_unit_test(forms_by_name_and_by_type),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}

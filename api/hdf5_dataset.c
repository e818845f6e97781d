#include "api/hdf5_dataset.h"

#include "api/hdf5_lock.h"
#include "core/num.h"

#include <hdf5.h>

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

enum { MEMORY_STEP = 1 << 16, CHUNK_MAX = 4 * FLOW_SAMPLES_MAX };

/* A record being read. */
struct place {
    struct failure_list *problems;
    int index;
    const char *name;
};

static void refuse(const struct place *p, const char *key, const char *code, const char *expected,
                   const char *detail)
{
    char pointer[160];
    if (p->index < 0) {
        (void)snprintf(pointer, sizeof pointer, "/records");
    } else {
        (void)snprintf(pointer, sizeof pointer, "/records/%d%s%s", p->index,
                       key[0] != '\0' ? "/" : "", key);
    }
    failure_set(failure_add(p->problems), ST_INVALID, pointer, code, expected, NULL, "%s%.63s%s%s",
                p->name[0] != '\0' ? "group " : "", p->name, p->name[0] != '\0' ? ": " : "",
                detail);
}

/* The bytes as a file; negative when they are none. */
static hid_t open_bytes(const void *bytes, size_t size)
{
    const hid_t access = H5Pcreate(H5P_FILE_ACCESS);
    hid_t file = -1;
    /* The image is copied by the library: it is not written to. */
    union {
        const void *given;
        void *taken;
    } image = {.given = bytes};
    if (size > 0 && H5Pset_fapl_core(access, MEMORY_STEP, false) >= 0 &&
        H5Pset_file_image(access, image.taken, size) >= 0) {
        file = H5Fopen("dataset", H5F_ACC_RDONLY, access);
    }
    (void)H5Pclose(access);
    return file;
}

/* Is it kept in the file itself, in pieces of reasonable size? */
static bool is_kept_inside(hid_t array)
{
    const hid_t plist = H5Dget_create_plist(array);
    const H5D_layout_t layout = H5Pget_layout(plist);
    bool ok = H5Pget_external_count(plist) == 0 && layout >= 0 && layout != H5D_VIRTUAL;
    if (ok && layout == H5D_CHUNKED) {
        hsize_t chunk = 0;
        ok = H5Pget_chunk(plist, 1, &chunk) == 1 && chunk >= 1 && chunk <= CHUNK_MAX;
    }
    (void)H5Pclose(plist);
    return ok;
}

/* Samples of a one-dimensional array of numbers; -1 when it is none. */
static long array_length(hid_t array)
{
    const hid_t space = H5Dget_space(array), type = H5Dget_type(array);
    const H5T_class_t class = H5Tget_class(type);
    hsize_t n = 0;
    long length = -1;
    if ((class == H5T_FLOAT || class == H5T_INTEGER) && H5Sget_simple_extent_ndims(space) == 1 &&
        H5Sget_simple_extent_dims(space, &n, NULL) == 1 && n <= FLOW_SAMPLES_MAX &&
        is_kept_inside(array)) {
        length = (long)n;
    }
    (void)H5Tclose(type);
    (void)H5Sclose(space);
    return length;
}

/* Opens an object of the file itself; negative when there is none of this name. */
static hid_t open_inside(hid_t group, const char *name, H5I_type_t wanted)
{
    H5L_info_t link;
    if (H5Lexists(group, name, H5P_DEFAULT) <= 0 ||
        H5Lget_info(group, name, &link, H5P_DEFAULT) < 0 || link.type != H5L_TYPE_HARD) {
        return -1;
    }
    const hid_t object = H5Oopen(group, name, H5P_DEFAULT);
    if (object >= 0 && H5Iget_type(object) != wanted) {
        (void)H5Oclose(object);
        return -1;
    }
    return object;
}

static void read_column(hid_t group, int column, struct flow_record *r, const struct place *p)
{
    const char *key = dataset_columns[DATASET_FLOW + column];
    const hid_t array = open_inside(group, key, H5I_DATASET);
    if (array < 0) {
        if (!dataset_column_is_optional(DATASET_FLOW + column)) {
            refuse(p, key, "required", "an array of numbers", "the column is missing");
        }
        return;
    }
    double *value = r->value + num_at(0, column, r->n);
    if (array_length(array) != r->n) {
        refuse(p, key, "wrong_length", "one dimension, as long as t, kept in the file",
               "the column does not fit");
    } else if (H5Dread(array, H5T_NATIVE_DOUBLE, H5S_ALL, H5S_ALL, H5P_DEFAULT, value) < 0) {
        refuse(p, key, "corrupt", "an array that can be read", "the column is damaged");
    }
    for (int i = 0; column == FLOW_THETA && i < r->n; i++) {
        value[i] *= NUM_PI / 180.0;
    }
    (void)H5Oclose(array);
}

/* A number beside the columns, 0 when absent. */
static double read_attribute(hid_t group, const char *key, const struct place *p)
{
    double value = 0.0;
    if (H5Aexists(group, key) <= 0) {
        return value;
    }
    const hid_t attribute = H5Aopen(group, key, H5P_DEFAULT);
    const hid_t space = H5Aget_space(attribute), type = H5Aget_type(attribute);
    const H5T_class_t class = H5Tget_class(type);
    if ((class != H5T_FLOAT && class != H5T_INTEGER) || H5Sget_simple_extent_npoints(space) != 1 ||
        H5Aread(attribute, H5T_NATIVE_DOUBLE, &value) < 0) {
        refuse(p, key, "wrong_type", "a number", "the attribute is none");
    }
    (void)H5Tclose(type);
    (void)H5Sclose(space);
    (void)H5Aclose(attribute);
    return value;
}

static enum status read_record(hid_t group, struct dataset_entry *out, const struct place *p)
{
    const hid_t time = open_inside(group, dataset_columns[DATASET_FLOW], H5I_DATASET);
    const long n = time >= 0 ? array_length(time) : -1;
    if (time >= 0) {
        (void)H5Oclose(time);
    }
    if (n < 0) {
        refuse(p, dataset_columns[DATASET_FLOW], "required",
               "a one-dimensional array of at most 1000000 numbers, kept in the file",
               "the times are missing");
        return ST_OK;
    }
    struct flow_record *r = dataset_add_record(out, p->name, (int)n);
    if (r == NULL) {
        return ST_NO_MEMORY;
    }
    r->period = read_attribute(group, dataset_columns[DATASET_PERIOD], p);
    r->start = read_attribute(group, dataset_columns[DATASET_START], p);
    for (int k = 0; k < FLOW_ROWS; k++) {
        read_column(group, k, r, p);
    }
    return ST_OK;
}

static enum status read_records(hid_t file, struct dataset_entry *out, struct place *p)
{
    H5G_info_t info;
    enum status st = ST_OK;
    if (H5Gget_info(file, &info) < 0 || info.nlinks > FLOW_RECORDS_MAX) {
        refuse(p, "", "too_many", "at most 4096 groups", "the file has no list of groups, or more");
        return ST_INVALID;
    }
    for (int i = 0; st == ST_OK && i < (int)info.nlinks; i++) {
        char name[LIMIT_NAME];
        const ssize_t length = H5Lget_name_by_idx(file, ".", H5_INDEX_NAME, H5_ITER_INC, (hsize_t)i,
                                                  name, sizeof name, H5P_DEFAULT);
        p->index = i;
        p->name = length > 0 && length < LIMIT_NAME ? name : "";
        const hid_t group = p->name[0] != '\0' ? open_inside(file, name, H5I_GROUP) : -1;
        if (group < 0) {
            refuse(p, "", "wrong_type", "a group with a name of 1..63 bytes",
                   "every link of the file must be a group of its own");
            continue;
        }
        st = read_record(group, out, p);
        (void)H5Oclose(group);
    }
    return st;
}

enum status hdf5_read_dataset(const void *bytes, size_t size, struct dataset_entry *out,
                              struct failure_list *problems)
{
    struct place p = {.problems = problems, .index = -1, .name = ""};
    enum status st = ST_INVALID;
    const int before = problems->total;
    hdf5_lock();
    (void)H5PLset_loading_state(0); /* no filters of other files */
    const hid_t file = open_bytes(bytes, size);
    if (file >= 0) {
        st = read_records(file, out, &p);
        (void)H5Fclose(file);
    } else {
        refuse(&p, "", "corrupt", "an HDF5 file", "the body is no HDF5 file, or damaged");
    }
    hdf5_unlock();
    return st == ST_OK && problems->total > before ? ST_INVALID : st;
}

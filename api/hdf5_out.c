#include "api/hdf5_out.h"

#include "api/hdf5_lock.h"

#include <hdf5.h>

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

enum { MEMORY_STEP = 1 << 16 };

/* A type of texts with so many bytes, filled up with zeros. */
static hid_t text_type(size_t size)
{
    const hid_t type = H5Tcopy(H5T_C_S1);
    if (type >= 0 && (H5Tset_size(type, size) < 0 || H5Tset_strpad(type, H5T_STR_NULLPAD) < 0 ||
                      H5Tset_cset(type, H5T_CSET_UTF8) < 0)) {
        (void)H5Tclose(type);
        return -1;
    }
    return type;
}

/* n texts of `size` bytes each as an attribute; n 0 is one text alone. */
static bool put_text(hid_t object, const char *name, int n, size_t size, const char *texts)
{
    const hsize_t length = (hsize_t)n;
    const hid_t type = text_type(size);
    const hid_t space = n > 0 ? H5Screate_simple(1, &length, NULL) : H5Screate(H5S_SCALAR);
    const hid_t attribute = H5Acreate2(object, name, type, space, H5P_DEFAULT, H5P_DEFAULT);
    const bool ok = attribute >= 0 && H5Awrite(attribute, type, texts) >= 0;
    (void)H5Aclose(attribute);
    (void)H5Sclose(space);
    (void)H5Tclose(type);
    return ok;
}

static bool put_integer(hid_t object, const char *name, int value)
{
    const hid_t space = H5Screate(H5S_SCALAR);
    const hid_t attribute =
        H5Acreate2(object, name, H5T_STD_I32LE, space, H5P_DEFAULT, H5P_DEFAULT);
    const bool ok = attribute >= 0 && H5Awrite(attribute, H5T_NATIVE_INT, &value) >= 0;
    (void)H5Aclose(attribute);
    (void)H5Sclose(space);
    return ok;
}

/* A dataset of the file; the caller closes it. Negative on failure. */
static hid_t put_array(hid_t file, const char *name, int rank, const int *shape, hid_t stored,
                       hid_t given, const void *values)
{
    hsize_t extent[STUDY_AXES_MAX];
    for (int d = 0; d < rank; d++) {
        extent[d] = (hsize_t)shape[d];
    }
    const hid_t space = H5Screate_simple(rank, extent, NULL);
    const hid_t plist = H5Pcreate(H5P_DATASET_CREATE);
    /* Without the time of writing, so that equal maps are equal bytes. */
    (void)H5Pset_obj_track_times(plist, false);
    hid_t dataset = H5Dcreate2(file, name, stored, space, H5P_DEFAULT, plist, H5P_DEFAULT);
    if (dataset >= 0 && H5Dwrite(dataset, given, H5S_ALL, H5S_ALL, H5P_DEFAULT, values) < 0) {
        (void)H5Dclose(dataset);
        dataset = -1;
    }
    (void)H5Pclose(plist);
    (void)H5Sclose(space);
    return dataset;
}

/* Texts of a list that has any, packed to one length; NULL when out of memory. */
static char *pack(int n, const char *const *label, size_t *size)
{
    if (n < 1) {
        return NULL;
    }
    *size = 1;
    for (int i = 0; i < n; i++) {
        *size = strlen(label[i]) > *size ? strlen(label[i]) : *size;
    }
    char *packed = calloc((size_t)n, *size);
    for (int i = 0; i < n && packed != NULL; i++) {
        memcpy(packed + (size_t)i * *size, label[i], strlen(label[i]));
    }
    return packed;
}

static hid_t put_labels(hid_t file, const char *name, int n, const char *const *label)
{
    size_t size = 0;
    char *packed = pack(n, label, &size);
    if (packed == NULL) {
        return -1;
    }
    const hid_t type = text_type(size);
    const hid_t dataset = put_array(file, name, 1, &n, type, type, packed);
    (void)H5Tclose(type);
    free(packed);
    return dataset;
}

static bool put_axis(hid_t file, int index, const struct study_axis_view *a)
{
    char name[32];
    (void)snprintf(name, sizeof name, "axis%d", index);
    const hid_t dataset = a->value != NULL ? put_array(file, name, 1, &a->n, H5T_IEEE_F64LE,
                                                       H5T_NATIVE_DOUBLE, a->value)
                                           : put_labels(file, name, a->n, a->label);
    const bool ok = dataset >= 0 &&
                    put_text(dataset, "pointer", 0, strlen(a->pointer) + 1, a->pointer) &&
                    put_integer(dataset, "dimension", a->dimension);
    (void)H5Dclose(dataset);
    return ok;
}

/* Numbers, or the texts they stand for. */
static hid_t put_results(hid_t file, const struct study_map *m)
{
    if (m->n_class == 0) {
        return put_array(file, "values", m->n_dimension, m->shape, H5T_IEEE_F64LE,
                         H5T_NATIVE_DOUBLE, m->value);
    }
    char(*text)[STUDY_CLASS_SIZE] = calloc((size_t)m->n_cell, sizeof *text);
    if (text == NULL) {
        return -1;
    }
    for (int i = 0; i < m->n_cell; i++) {
        (void)snprintf(text[i], sizeof text[i], "%s", study_map_class(m, i));
    }
    const hid_t type = text_type(sizeof text[0]);
    const hid_t dataset = put_array(file, "values", m->n_dimension, m->shape, type, type, text);
    (void)H5Tclose(type);
    free(text);
    return dataset;
}

static bool put_values(hid_t file, const struct study_map *m)
{
    const hid_t dataset = put_results(file, m);
    const bool ok =
        dataset >= 0 && put_text(dataset, "value", 0, strlen(m->value_name) + 1, m->value_name);
    (void)H5Dclose(dataset);
    return ok;
}

static bool put_status(hid_t file, const struct study_map *m)
{
    static const enum study_cell_state last = STUDY_CELL_FAILED;
    char states[STUDY_CELL_FAILED + 1][16] = {{0}};
    for (enum study_cell_state s = 0; s <= last; s++) {
        (void)snprintf(states[s], sizeof states[s], "%s", study_cell_state_name(s));
    }
    const hid_t dataset = put_array(file, "status", m->n_dimension, m->shape, H5T_STD_U8LE,
                                    H5T_NATIVE_UCHAR, m->status);
    const bool ok =
        dataset >= 0 && put_text(dataset, "states", last + 1, sizeof states[0], states[0]);
    (void)H5Dclose(dataset);
    return ok;
}

static bool put_map(hid_t file, const struct study_map *m)
{
    bool ok = put_values(file, m) && put_status(file, m);
    for (int i = 0; i < m->n_axis && ok; i++) {
        ok = put_axis(file, i, &m->axis[i]);
    }
    return ok && H5Fflush(file, H5F_SCOPE_GLOBAL) >= 0;
}

static char *image_of(hid_t file, size_t *size)
{
    const ssize_t need = H5Fget_file_image(file, NULL, 0);
    char *image = need > 0 ? malloc((size_t)need) : NULL;
    if (image != NULL && H5Fget_file_image(file, image, (size_t)need) != need) {
        free(image);
        return NULL;
    }
    *size = image != NULL ? (size_t)need : 0;
    return image;
}

char *hdf5_out_map(const struct study_map *m, size_t *size)
{
    char *image = NULL;
    hdf5_lock();
    const hid_t access = H5Pcreate(H5P_FILE_ACCESS);
    /* Memory only: nothing is written under this name. */
    if (access >= 0 && H5Pset_fapl_core(access, MEMORY_STEP, false) >= 0) {
        const hid_t file = H5Fcreate("map.h5", H5F_ACC_TRUNC, H5P_DEFAULT, access);
        if (file >= 0) {
            image = put_map(file, m) ? image_of(file, size) : NULL;
            (void)H5Fclose(file);
        }
    }
    (void)H5Pclose(access);
    hdf5_unlock();
    return image;
}

#include "api/map_out.h"

#include "api/text.h"

#include <math.h>
#include <stdint.h>
#include <stdio.h>
#include <string.h>

static const struct {
    const char *name, *type;
} formats[] = {
    [MAP_JSON] = {"json", "application/json"},
    [MAP_CSV] = {"csv", "text/csv; charset=utf-8; header=present"},
    [MAP_NPY] = {"npy", "application/x-npy"},
    [MAP_HDF5] = {"hdf5", "application/x-hdf5"},
    [MAP_SVG] = {"svg", "image/svg+xml"},
};

const char *map_format_name(enum map_format f)
{
    return (unsigned)f < MAP_FORMATS ? formats[f].name : "";
}

const char *map_format_type(enum map_format f)
{
    return (unsigned)f < MAP_FORMATS ? formats[f].type : "";
}

enum map_format map_format_of(const char *name)
{
    int f = 0;
    while (f < MAP_FORMATS && strcmp(formats[f].name, name) != 0) {
        f++;
    }
    return (enum map_format)f;
}

enum map_format map_format_accepted(const char *accept)
{
    enum map_format best = MAP_JSON;
    int weight = text_accept_weight(accept, formats[MAP_JSON].type);
    for (enum map_format f = MAP_CSV; f < MAP_FORMATS; f++) {
        char type[64];
        (void)snprintf(type, sizeof type, "%.*s", (int)strcspn(formats[f].type, ";"),
                       formats[f].type);
        if (text_accept_weight(accept, type) > weight) {
            weight = text_accept_weight(accept, type);
            best = f;
        }
    }
    return best;
}

/* -- CSV -------------------------------------------------------------------------------- */

/* RFC 4180: quoted where a comma, a quote or a line end stands in it. */
static void csv_text(struct json_out *out, const char *text)
{
    if (strpbrk(text, ",\"\r\n") == NULL) {
        json_out_text(out, text);
        return;
    }
    json_out_text(out, "\"");
    for (const char *c = text; *c != '\0'; c++) {
        json_out_bytes(out, c, 1);
        if (*c == '"') {
            json_out_bytes(out, c, 1);
        }
    }
    json_out_text(out, "\"");
}

static void csv_number(struct json_out *out, double value)
{
    char text[NUMBER_TEXT_SIZE];
    if (isfinite(value)) {
        json_out_bytes(out, text, number_text(value, text));
    }
}

static void csv_row(struct json_out *out, const struct study_map *m, int cell)
{
    char number[NUMBER_TEXT_SIZE];
    (void)snprintf(number, sizeof number, "%d", cell);
    json_out_text(out, number);
    for (int i = 0; i < m->n_axis; i++) {
        const struct study_axis_view *a = &m->axis[i];
        const int k = study_map_index(m, cell, a->dimension);
        json_out_text(out, ",");
        if (a->value != NULL) {
            csv_number(out, a->value[k]);
        } else {
            csv_text(out, a->label[k]);
        }
    }
    json_out_text(out, ",");
    if (m->n_class > 0) {
        csv_text(out, study_map_class(m, cell));
    } else {
        csv_number(out, m->value[cell]);
    }
    json_out_text(out, ",");
    json_out_text(out, study_cell_state_name((enum study_cell_state)m->status[cell]));
    json_out_text(out, "\n");
}

void map_out_csv(struct json_out *out, const struct study_map *m)
{
    json_out_text(out, "cell");
    for (int i = 0; i < m->n_axis; i++) {
        json_out_text(out, ",");
        csv_text(out, m->axis[i].pointer);
    }
    json_out_text(out, ",");
    csv_text(out, m->value_name);
    json_out_text(out, ",status\n");
    for (int cell = 0; cell < m->n_cell; cell++) {
        csv_row(out, m, cell);
    }
}

/* -- NPY -------------------------------------------------------------------------------- */

enum { NPY_ALIGN = 64, NPY_PREFIX = 10 }; /* magic, version, length of the header */

static void npy_header(struct json_out *out, const struct study_map *m)
{
    char text[256];
    size_t n = (size_t)snprintf(text, sizeof text, "{'descr': '");
    n += m->n_class > 0 ? (size_t)snprintf(text + n, sizeof text - n, "|S%d", STUDY_CLASS_SIZE)
                        : (size_t)snprintf(text + n, sizeof text - n, "<f8");
    n += (size_t)snprintf(text + n, sizeof text - n, "', 'fortran_order': False, 'shape': (");
    for (int d = 0; d < m->n_dimension; d++) {
        n += (size_t)snprintf(text + n, sizeof text - n, "%d,", m->shape[d]);
    }
    n += (size_t)snprintf(text + n, sizeof text - n, "), }");
    while ((NPY_PREFIX + n + 1) % NPY_ALIGN != 0) {
        text[n++] = ' ';
    }
    text[n++] = '\n';
    const unsigned char prefix[NPY_PREFIX] = {
        0x93, 'N', 'U', 'M', 'P', 'Y', 1, 0, (unsigned char)(n & 0xff), (unsigned char)(n >> 8)};
    json_out_bytes(out, (const char *)prefix, sizeof prefix);
    json_out_bytes(out, text, n);
}

static void npy_number(struct json_out *out, double value)
{
    uint64_t bits;
    char bytes[sizeof bits];
    memcpy(&bits, &value, sizeof bits);
    for (size_t i = 0; i < sizeof bits; i++) {
        bytes[i] = (char)((bits >> (8 * i)) & 0xff);
    }
    json_out_bytes(out, bytes, sizeof bytes);
}

void map_out_npy(struct json_out *out, const struct study_map *m)
{
    npy_header(out, m);
    for (int cell = 0; cell < m->n_cell; cell++) {
        if (m->n_class > 0) {
            char text[STUDY_CLASS_SIZE] = {0};
            (void)snprintf(text, sizeof text, "%s", study_map_class(m, cell));
            json_out_bytes(out, text, sizeof text);
        } else {
            npy_number(out, m->value[cell]);
        }
    }
}

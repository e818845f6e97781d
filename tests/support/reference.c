#include "tests/support/reference.h"

#include "core/num.h"
#include "tests/support/draw.h"

#include <cjson/cJSON.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

struct reference {
    cJSON *tree;
    const cJSON *material, *record;
};

static void stop(const char *what)
{
    (void)fprintf(stderr, "three-dimensional reference: %s\n", what);
    exit(EXIT_FAILURE);
}

static const cJSON *need(const cJSON *object, const char *key)
{
    const cJSON *v = cJSON_GetObjectItemCaseSensitive(object, key);
    if (v == NULL) {
        stop(key);
    }
    return v;
}

static double number(const cJSON *object, const char *key)
{
    const cJSON *v = need(object, key);
    if (!cJSON_IsNumber(v)) {
        stop(key);
    }
    return v->valuedouble;
}

static char *read_file(const char *path)
{
    FILE *in = fopen(path, "rb");
    if (in == NULL || fseek(in, 0, SEEK_END) != 0) {
        stop(path);
        return NULL;
    }
    const long size = ftell(in);
    char *text = size > 0 ? malloc((size_t)size + 1) : NULL;
    rewind(in);
    if (text == NULL || fread(text, 1, (size_t)size, in) != (size_t)size) {
        stop(path);
        return NULL;
    }
    text[size] = '\0';
    (void)fclose(in);
    return text;
}

struct reference *reference_open(const char *path)
{
    struct reference *r = calloc(1, sizeof *r);
    char *text = read_file(path);
    if (r == NULL || (r->tree = cJSON_Parse(text)) == NULL) {
        stop("not JSON");
        return NULL;
    }
    free(text);
    r->material = need(r->tree, "materials");
    r->record = need(r->tree, "cases");
    return r;
}

void reference_close(struct reference *r)
{
    cJSON_Delete(r->tree);
    free(r);
}

int reference_count(const struct reference *r)
{
    return cJSON_GetArraySize(r->record);
}

static const cJSON *record_at(const struct reference *r, int i)
{
    return cJSON_GetArrayItem(r->record, i);
}

const char *reference_name(const struct reference *r, int i)
{
    return need(record_at(r, i), "name")->valuestring;
}

static struct ply read_ply(const struct reference *r, const cJSON *ply)
{
    const char *name = need(ply, "material")->valuestring;
    const cJSON *m = need(r->material, name);
    struct ply out = {.angle = num_rad(number(ply, "angle_deg")),
                      .thickness = number(ply, "thickness_m"),
                      .material = {.e_l = number(m, "e_l_pa"),
                                   .e_t = number(m, "e_t_pa"),
                                   .g_lt = number(m, "g_lt_pa"),
                                   .g_tt = number(m, "g_tt_pa"),
                                   .nu_lt = number(m, "nu_lt"),
                                   .nu_tt = number(m, "nu_tt"),
                                   .density = number(m, "density_kg_m3")}};
    (void)snprintf(out.material.name, sizeof out.material.name, "%s", name);
    return out;
}

static int add_layup(const struct reference *r, const cJSON *layup, struct shape *s)
{
    static struct ply ply[LIMIT_PLIES];
    const cJSON *item = NULL;
    int n = 0;
    cJSON_ArrayForEach(item, layup)
    {
        if (n == LIMIT_PLIES || s->n_layup == LIMIT_LAYUPS) {
            stop("more plies or layups than a section may have");
        }
        ply[n++] = read_ply(r, item);
    }
    return draw_layup(s, n, ply);
}

static void read_section(const struct reference *r, const cJSON *section, struct shape *s)
{
    const cJSON *item = NULL;
    draw_contour(s, 16);
    if (strcmp(need(section, "type")->valuestring, "strip") == 0) {
        s->type = SECTION_STRIP;
        s->width = number(section, "chord_m");
        (void)add_layup(r, need(section, "layup"), s);
        return;
    }
    cJSON_ArrayForEach(item, need(section, "points"))
    {
        (void)draw_point(s, number(item, "x_m"), number(item, "y_m"));
    }
    cJSON_ArrayForEach(item, need(section, "walls"))
    {
        (void)draw_wall(s, (int)number(item, "from"), (int)number(item, "to"),
                        add_layup(r, need(item, "layup"), s));
    }
}

void reference_case(const struct reference *r, int i, struct station_def station[2],
                    struct case_def *out)
{
    const cJSON *beam = need(need(record_at(r, i), "definition"), "beam");
    const cJSON *taper = cJSON_GetObjectItemCaseSensitive(beam, "taper");
    case_def_defaults(out);
    out->kind = CASE_MODES;
    out->solver.modes = REFERENCE_MODES;
    out->beam.length = number(beam, "length_m");
    read_section(r, need(beam, "section"), &out->beam.section.shape);
    (void)snprintf(out->name, sizeof out->name, "%s", reference_name(r, i));
    if (taper != NULL) {
        station[0] = (struct station_def){.z = 0.0, .section = out->beam.section};
        station[1] = (struct station_def){.z = out->beam.length, .section = out->beam.section};
        station[1].section.shape.width = number(taper, "tip_chord_m");
        draw_stations(out, 2, station);
    }
}

/* The model of a record that tests compare with. */
static const cJSON *model_of(const struct reference *r, int i)
{
    const cJSON *record = record_at(r, i);
    return need(need(record, "models"), need(record, "reference")->valuestring);
}

int reference_modes(const struct reference *r, int i, struct reference_mode *out)
{
    const cJSON *item = NULL;
    int n = 0;
    cJSON_ArrayForEach(item, need(model_of(r, i), "modes"))
    {
        if (n < REFERENCE_MODES) {
            out[n++] =
                (struct reference_mode){.frequency = number(item, "frequency_hz"),
                                        .label = need(item, "label")->valuestring,
                                        .torsion = number(need(item, "kinetic_share"), "torsion")};
        }
    }
    return n;
}

double reference_tip(const struct reference *r, int i, const char *load, const char *key)
{
    const cJSON *answer = cJSON_GetObjectItemCaseSensitive(need(model_of(r, i), "static"), load);
    if (answer == NULL) {
        return (double)NAN;
    }
    return number(need(answer, "tip"), key);
}

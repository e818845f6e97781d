#include "api/result.h"

#include "api/json_out.h"
#include "core/num.h"

#include <assert.h>
#include <math.h>
#include <string.h>

/* What a document is written from. */
struct view {
    const struct api_case *c;
    const struct case_def *def;
    const struct sim_result *r;
    const struct run_timing *timing;
};

static const double degrees = 180.0 / NUM_PI;

static void write_window(struct json_out *out, double from, double to)
{
    json_key_numbers(out, "window_s", 2, (const double[]){from, to}, 1, 1.0);
}

static void write_root(struct json_out *out, const struct root_result *root, double scale)
{
    json_object_begin(out);
    json_key_number(out, "frequency_hz", root->frequency_hz);
    json_key_number(out, "ratio", root->ratio);
    json_key_number(out, "amplitude", root->amplitude * scale);
    json_key_number(out, "residual", root->residual);
    json_object_end(out);
}

static void write_signal_damping(struct json_out *out, const struct damping_result *d, double scale)
{
    json_object_begin(out);
    json_key(out, "roots");
    json_array_begin(out);
    for (int i = 0; i < d->n_root; i++) {
        write_root(out, &d->root[i], scale);
    }
    json_array_end(out);
    json_key(out, "torsion");
    if (d->torsion >= 0 && d->torsion < d->n_root) {
        write_root(out, &d->root[d->torsion], scale);
    } else {
        json_null(out);
    }
    write_window(out, d->window_from, d->window_to);
    json_key_number(out, "hilbert_ratio", d->hilbert_ratio);
    json_key_number(out, "log_decrement", d->log_decrement);
    json_object_end(out);
}

static void write_damping(struct json_out *out, const struct view *v)
{
    json_object_begin(out);
    json_key(out, "tip_twist");
    write_signal_damping(out, &v->r->tip_twist, degrees);
    json_key(out, "tip_plunge");
    write_signal_damping(out, &v->r->tip_plunge, 1.0);
    json_object_end(out);
}

static void write_mode_shape(struct json_out *out, const struct mode_result *m, double length)
{
    double z[MODE_SAMPLES];
    for (int i = 0; i < MODE_SAMPLES; i++) {
        z[i] = length * i / (MODE_SAMPLES - 1);
    }
    json_key(out, "shape");
    json_object_begin(out);
    json_key_numbers(out, "z_m", MODE_SAMPLES, z, 1, 1.0);
    json_key_numbers(out, "plunge", MODE_SAMPLES, m->plunge, 1, 1.0);
    json_key_numbers(out, "chordwise", MODE_SAMPLES, m->chordwise, 1, 1.0);
    json_key_numbers(out, "twist", MODE_SAMPLES, m->twist, 1, 1.0);
    json_object_end(out);
}

static void write_mode(struct json_out *out, const struct mode_result *m, double length)
{
    static const enum mode_label parts[] = {MODE_BENDING, MODE_LAG, MODE_TORSION, MODE_AXIAL};
    json_object_begin(out);
    json_key_number(out, "frequency_hz", m->frequency_hz);
    json_key_string(out, "label", mode_label_name(m->label));
    json_key_number(out, "modal_mass_kg", m->modal_mass);
    json_key(out, "energy_share");
    json_object_begin(out);
    for (size_t i = 0; i < sizeof parts / sizeof parts[0]; i++) {
        json_key_number(out, mode_label_name(parts[i]), m->share[i]);
    }
    json_object_end(out);
    write_mode_shape(out, m, length);
    json_object_end(out);
}

static void write_modes(struct json_out *out, const struct view *v)
{
    json_object_begin(out);
    json_key(out, "modes");
    json_array_begin(out);
    for (int i = 0; i < v->r->n_mode; i++) {
        write_mode(out, &v->r->mode[i], v->def->beam.length);
    }
    json_array_end(out);
    json_object_end(out);
}

static void write_matrix(struct json_out *out, const char *key, int n, const double *a)
{
    json_key(out, key);
    json_array_begin(out);
    for (int i = 0; i < n; i++) {
        json_array_begin(out);
        for (int j = 0; j < n; j++) {
            json_number(out, a[i + j * n]);
        }
        json_array_end(out);
    }
    json_array_end(out);
}

static void write_names(struct json_out *out, const char *key, int n, const char *const *names)
{
    json_key(out, key);
    json_array_begin(out);
    for (int i = 0; i < n; i++) {
        json_string(out, names[i]);
    }
    json_array_end(out);
}

/* The scalars that describe a section, inside an object already begun. */
static void write_section_essentials(struct json_out *out, const struct section_result *s)
{
    json_key_number(out, "mass_kg_m", s->mass_per_length);
    json_key_number(out, "thickness_m", s->thickness);
    json_key_number(out, "ei_flap_n_m2", s->ei_flap);
    json_key_number(out, "ei_lag_n_m2", s->ei_lag);
    json_key_number(out, "gj_n_m2", s->gj);
    json_key_number(out, "bend_twist_n_m2", s->bend_twist);
    json_key_string(out, "wash", wash_name(s->wash));
}

static void write_section(struct json_out *out, const struct view *v)
{
    /* The condensed stiffness has the first five. */
    static const char *const strains[SECTION_STRAINS] = {"w'",      "psi'",     "phi'",    "theta'",
                                                         "theta''", "gamma_xz", "gamma_yz"};
    static const char *const motions[SECTION_MASS] = {"u", "v", "w", "v'", "u'", "theta", "theta'"};
    const struct section_result *s = &v->r->section;
    json_object_begin(out);
    write_matrix(out, "stiffness", SECTION_STRAINS, s->stiffness);
    write_matrix(out, "stiffness_condensed", SECTION_CLASSICAL, s->stiffness_condensed);
    write_matrix(out, "mass", SECTION_MASS, s->mass);
    write_names(out, "order", SECTION_STRAINS, strains);
    write_names(out, "mass_order", SECTION_MASS, motions);
    write_section_essentials(out, s);
    json_object_end(out);
}

static void write_mode_list(struct json_out *out, const struct sim_result *r)
{
    json_key(out, "modes");
    json_array_begin(out);
    for (int i = 0; i < r->n_mode; i++) {
        json_object_begin(out);
        json_key_number(out, "frequency_hz", r->mode[i].frequency_hz);
        json_key_string(out, "label", mode_label_name(r->mode[i].label));
        json_object_end(out);
    }
    json_array_end(out);
}

static void write_means(struct json_out *out, const struct sim_result *r)
{
    json_key(out, "means");
    json_object_begin(out);
    write_window(out, r->means.window_from, r->means.window_to);
    json_key_number(out, "tip_plunge_m", r->means.tip_plunge);
    json_key_number(out, "tip_twist_deg", r->means.tip_twist * degrees);
    json_key_number(out, "cl", r->means.cl);
    json_key_number(out, "cm", r->means.cm);
    json_key_number(out, "cd", r->means.cd);
    json_key_number(out, "lift_n", r->means.lift);
    json_key_number(out, "drag_n", r->means.drag);
    json_key_number(out, "moment_n_m", r->means.moment);
    json_object_end(out);
}

static void write_counters(struct json_out *out, const struct sim_counters *n)
{
    json_key(out, "counters");
    json_object_begin(out);
    json_key_integer(out, "outside_polar", n->outside_polar);
    json_key_integer(out, "outside_hull", n->outside_hull);
    json_key_integer(out, "not_converged", n->not_converged);
    json_key_integer(out, "lifting_line_iterations", n->lifting_line_iterations);
    json_key_number(out, "lifting_line_residual", n->lifting_line_residual);
    json_key_integer(out, "inner_steps", n->inner_steps);
    json_object_end(out);
}

static void write_marching(struct json_out *out, const struct view *v)
{
    const struct sim_result *r = v->r;
    json_key_string(out, "verdict", verdict_name(r->verdict));
    json_key_string(out, "verdict_reason", r->verdict_reason);
    json_key(out, "stop");
    json_object_begin(out);
    json_key_string(out, "reason", stop_reason_name(r->stop));
    json_key_number(out, "time_s", r->stop_time);
    json_object_end(out);
    json_key_number(out, "e_star", r->e_star);
    json_key_number(out, "reynolds", r->reynolds);
    json_key_string(out, "wash", wash_name(r->section.wash));
    write_mode_list(out, r);
    write_means(out, r);
    json_key(out, "damping");
    write_damping(out, v);
    json_key(out, "modal_contribution");
    json_object_begin(out);
    json_key_numbers(out, "position", r->n_mode, r->contribution_position, 1, 1.0);
    json_key_numbers(out, "velocity", r->n_mode, r->contribution_velocity, 1, 1.0);
    json_object_end(out);
    write_counters(out, &r->counters);
}

static void write_timing(struct json_out *out, const struct view *v)
{
    const bool marched = v->def->kind == CASE_SIMULATION;
    json_key(out, "timing");
    json_object_begin(out);
    if (marched) {
        json_key_integer(out, "steps", v->r->steps);
    }
    json_key_number(out, "cpu_s", v->timing->cpu_s);
    if (marched) {
        const double steps = (double)v->r->steps;
        json_key_number(out, "us_per_step",
                        steps > 0.0 ? v->timing->cpu_s * 1e6 / steps : (double)NAN);
    }
    json_object_end(out);
}

static void write_reference(struct json_out *out, const char *key, const char *name,
                            const char *hash)
{
    json_key(out, key);
    if (name == NULL) {
        json_null(out);
        return;
    }
    json_object_begin(out);
    json_key_string(out, "name", name);
    json_key_string(out, "hash", hash);
    json_object_end(out);
}

static void write_identity(struct json_out *out, const struct view *v)
{
    const bool flows = v->def->kind == CASE_SIMULATION;
    const struct polar_def *polar = flows ? v->def->aero.polar : NULL;
    const struct network_def *network = flows ? v->def->aero.network : NULL;
    json_key(out, "identity");
    json_object_begin(out);
    json_key_string(out, "content_hash", api_case_hash(v->c));
    json_key_string(out, "core_version", AEROM_CORE_VERSION);
    write_reference(out, "polar", polar != NULL ? polar->name : NULL,
                    polar != NULL ? polar->hash : NULL);
    write_reference(out, "network", network != NULL ? network->name : NULL,
                    network != NULL ? network->hash : NULL);
    json_object_end(out);
}

static void write_summary(struct json_out *out, const struct view *v)
{
    json_object_begin(out);
    json_key_string(out, "kind", case_kind_name(v->def->kind));
    json_key_string(out, "name", v->def->name);
    if (v->def->kind == CASE_SIMULATION) {
        write_marching(out, v);
    } else if (v->def->kind == CASE_MODES) {
        write_mode_list(out, v->r);
    }
    json_key(out, "section");
    json_object_begin(out);
    write_section_essentials(out, &v->r->section);
    json_object_end(out);
    write_timing(out, v);
    write_identity(out, v);
    json_object_end(out);
}

static const struct {
    const char *name;
    void (*write)(struct json_out *out, const struct view *v);
} documents[] = {
    {"summary", write_summary},
    {"damping", write_damping},
    {"modes", write_modes},
    {"section", write_section},
};

const char *const *result_documents(enum case_kind kind)
{
    static const char *const simulation[] = {"summary", "damping", "modes", "section", NULL};
    static const char *const modes[] = {"summary", "modes", "section", NULL};
    static const char *const section[] = {"summary", "section", NULL};
    static const char *const *const lists[] = {
        [CASE_SIMULATION] = simulation, [CASE_MODES] = modes, [CASE_SECTION] = section};
    assert((unsigned)kind < sizeof lists / sizeof lists[0]);
    return lists[kind];
}

char *result_document(const char *document, const struct api_case *c, const struct sim_result *r,
                      const struct run_timing *timing)
{
    const struct view v = {.c = c, .def = api_case_def(c), .r = r, .timing = timing};
    struct json_out out = {0};
    for (size_t i = 0; i < sizeof documents / sizeof documents[0]; i++) {
        if (strcmp(documents[i].name, document) == 0) {
            documents[i].write(&out, &v);
        }
    }
    assert(out.failed || out.text != NULL);
    return json_out_take(&out, NULL);
}

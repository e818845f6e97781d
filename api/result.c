#include "api/result.h"

#include "api/result_parts.h"
#include "core/num.h"

#include <assert.h>
#include <math.h>
#include <string.h>

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

static void write_root_at(struct json_out *out, const char *key, const struct damping_result *d,
                          int index, double scale)
{
    json_key(out, key);
    if (index >= 0 && index < d->n_root) {
        write_root(out, &d->root[index], scale);
    } else {
        json_null(out);
    }
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
    write_root_at(out, "torsion", d, d->torsion, scale);
    write_root_at(out, "least_stable", d, d->least_stable, scale);
    write_window(out, d->window_from, d->window_to);
    json_key_number(out, "hilbert_ratio", d->hilbert_ratio);
    json_key_number(out, "log_decrement", d->log_decrement);
    json_object_end(out);
}

static void write_damping(struct json_out *out, const struct result_view *v)
{
    json_object_begin(out);
    json_key(out, "tip_twist");
    write_signal_damping(out, &v->r->tip_twist, degrees);
    json_key(out, "tip_plunge");
    write_signal_damping(out, &v->r->tip_plunge, 1.0);
    json_object_end(out);
}

/* Frequencies and labels only: the shapes have a document of their own. */
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
    json_key_number(out, "tip_plunge_rms_m", r->means.plunge_rms);
    json_key_number(out, "tip_twist_rms_deg", r->means.twist_rms * degrees);
    json_key_number(out, "cl", r->means.cl);
    json_key_number(out, "cm", r->means.cm);
    json_key_number(out, "cd", r->means.cd);
    json_key_number(out, "lift_n", r->means.lift);
    json_key_number(out, "drag_n", r->means.drag);
    json_key_number(out, "moment_n_m", r->means.moment);
    json_key_number(out, "efficiency", r->means.efficiency);
    json_object_end(out);
}

static void write_extreme(struct json_out *out, const char *key, const struct extreme *e,
                          double scale)
{
    json_key(out, key);
    json_object_begin(out);
    json_key_number(out, "max", e->max * scale);
    json_key_number(out, "max_time_s", e->max_time);
    json_key_number(out, "min", e->min * scale);
    json_key_number(out, "min_time_s", e->min_time);
    json_object_end(out);
}

static void write_peaks(struct json_out *out, const struct sim_result *r)
{
    json_key(out, "peaks");
    json_object_begin(out);
    write_extreme(out, "tip_plunge_m", &r->peak_plunge, 1.0);
    write_extreme(out, "tip_twist_deg", &r->peak_twist, degrees);
    write_extreme(out, "root_bending_n_m", &r->peak_bending, 1.0);
    json_object_end(out);
}

static void write_counters(struct json_out *out, const struct sim_counters *n)
{
    json_key(out, "counters");
    json_object_begin(out);
    json_key_integer(out, "outside_polar", n->outside_polar);
    json_key_integer(out, "outside_hull", n->outside_hull);
    json_key_integer(out, "load_alternations", n->load_alternations);
    json_key_integer(out, "not_converged", n->not_converged);
    json_key_integer(out, "lifting_line_iterations", n->lifting_line_iterations);
    json_key_number(out, "lifting_line_residual", n->lifting_line_residual);
    json_key_integer(out, "lifting_line_regularised", n->lifting_line_regularised);
    json_key_number(out, "lifting_line_smoothing", n->lifting_line_smoothing);
    json_key_integer(out, "inner_steps", n->inner_steps);
    json_object_end(out);
}

static void write_marching(struct json_out *out, const struct result_view *v)
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
    write_peaks(out, r);
    json_key(out, "damping");
    write_damping(out, v);
    json_key(out, "modal_contribution");
    json_object_begin(out);
    json_key_numbers(out, "position", r->n_mode, r->contribution_position, 1, 1.0);
    json_key_numbers(out, "velocity", r->n_mode, r->contribution_velocity, 1, 1.0);
    json_object_end(out);
    write_counters(out, &r->counters);
}

static void write_timing(struct json_out *out, const struct result_view *v)
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

static void write_identity(struct json_out *out, const struct result_view *v)
{
    const bool moves = case_kind_is_dynamic(v->def->kind);
    const struct polar_def *polar = case_def_has_polar(v->def) ? v->def->aero.polar : NULL;
    const struct network_def *network = moves ? v->def->aero.network : NULL;
    json_key(out, "identity");
    json_object_begin(out);
    json_key_string(out, "content_hash", api_case_hash(v->c));
    json_key_string(out, "core_version", AEROM_CORE_VERSION);
    write_reference(out, "polar", polar != NULL ? polar->name : NULL,
                    polar != NULL ? polar->hash : NULL);
    write_reference(out, "network", network != NULL ? network->name : NULL,
                    network != NULL ? network->hash : NULL);
    if (network != NULL) {
        json_key(out, "network_forced");
        json_boolean(out, network_def_is_of_other_polar(network, polar->hash));
    }
    json_object_end(out);
}

static void write_summary(struct json_out *out, const struct result_view *v)
{
    json_object_begin(out);
    json_key_string(out, "kind", case_kind_name(v->def->kind));
    json_key_string(out, "name", v->def->name);
    if (v->def->kind == CASE_SIMULATION) {
        write_marching(out, v);
    } else if (v->def->kind == CASE_MODES) {
        result_modes_members(out, v);
    } else if (v->def->kind == CASE_STATIC) {
        result_static_members(out, v);
    } else if (v->def->kind == CASE_STABILITY) {
        result_stability_members(out, v);
        write_mode_list(out, v->r);
    } else if (v->def->kind == CASE_LOOP) {
        result_loop_members(out, v);
    } else {
        result_matrix_members(out, &v->r->section);
    }
    if (case_kind_has_beam(v->def->kind)) {
        json_key(out, "section");
        json_object_begin(out);
        result_section_members(out, &v->r->section);
        json_object_end(out);
    }
    write_timing(out, v);
    write_identity(out, v);
    json_object_end(out);
}

static const struct {
    const char *name;
    void (*write)(struct json_out *out, const struct result_view *v);
} documents[] = {
    {"summary", write_summary},
    {"damping", write_damping},
    {"loads", result_write_loads},
    {"modes", result_write_modes},
    {"section", result_write_section},
    {"static", result_write_static},
    {"stability", result_write_stability},
};

const char *const *result_documents(enum case_kind kind)
{
    static const char *const simulation[] = {"summary", "damping", "loads",
                                             "modes",   "section", NULL};
    static const char *const modes[] = {"summary", "modes", "section", NULL};
    static const char *const section[] = {"summary", "section", NULL};
    static const char *const statics[] = {"summary", "static", "section", NULL};
    static const char *const stability[] = {"summary", "stability", "modes", "section", NULL};
    static const char *const loop[] = {"summary", NULL};
    static const char *const training[] = {"summary", "training", "network", NULL};
    static const char *const *const lists[] = {
        [CASE_SIMULATION] = simulation, [CASE_MODES] = modes,         [CASE_SECTION] = section,
        [CASE_STATIC] = statics,        [CASE_STABILITY] = stability, [CASE_LOOP] = loop,
        [CASE_TRAINING] = training};
    assert((unsigned)kind < sizeof lists / sizeof lists[0]);
    return lists[kind];
}

char *result_document(const char *document, const struct api_case *c, const struct sim_result *r,
                      const struct run_timing *timing)
{
    const struct result_view v = {.c = c, .def = api_case_def(c), .r = r, .timing = timing};
    struct json_out out = {0};
    for (size_t i = 0; i < sizeof documents / sizeof documents[0]; i++) {
        if (strcmp(documents[i].name, document) == 0) {
            documents[i].write(&out, &v);
        }
    }
    assert(out.failed || out.text != NULL);
    return json_out_take(&out, NULL);
}

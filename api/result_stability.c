/* Instabilities, branches and equilibria over a range of speeds as JSON. */
#include "api/result_parts.h"
#include "core/num.h"

#include <math.h>

static const char *const onset_names[] = {[ONSET_NONE] = "none",
                                          [ONSET_CROSSING] = "crossing",
                                          [ONSET_LIMIT_POINT] = "limit_point",
                                          [ONSET_BELOW] = "below_range"};

static double pressure_at(const struct result_view *v, double speed)
{
    return 0.5 * v->def->flow.density * num_sq(speed);
}

static void write_divergence(struct json_out *out, const struct result_view *v)
{
    const struct divergence_point *d = &v->r->stability.divergence;
    json_key(out, "divergence");
    if (d->onset == ONSET_NONE) {
        json_string(out, "none_in_range");
        return;
    }
    json_object_begin(out);
    json_key_number(out, "speed_m_s", d->speed);
    json_key_number(out, "dynamic_pressure_pa", pressure_at(v, d->speed));
    json_key_string(out, "onset", onset_names[d->onset]);
    json_object_end(out);
}

static void write_flutter(struct json_out *out, const struct result_view *v)
{
    const struct flutter_point *f = &v->r->stability.flutter;
    json_key(out, "flutter");
    if (f->onset == ONSET_NONE) {
        json_string(out, "none_in_range");
        return;
    }
    json_object_begin(out);
    json_key_number(out, "speed_m_s", f->speed);
    json_key_number(out, "frequency_hz", f->frequency);
    json_key_integer(out, "mode", f->mode + 1);
    json_key_string(out, "mode_label", mode_label_name(v->r->mode[f->mode].label));
    json_key_number(out, "reduced_frequency", f->reduced_frequency);
    json_key_number(out, "damping_ratio", f->damping);
    json_key_number(out, "dynamic_pressure_pa", pressure_at(v, f->speed));
    json_key_string(out, "mechanism", f->coupled ? "coupled_modes" : "single_mode");
    json_key(out, "stalled");
    json_boolean(out, f->stalled);
    json_key_numbers(out, "energy_share", v->r->n_mode, f->share, 1, 1.0);
    json_key_string(out, "onset", onset_names[f->onset]);
    json_object_end(out);
}

static void write_least(struct json_out *out, const struct stability_result *s)
{
    json_key(out, "least_damped");
    if (!isfinite(s->least.damping)) {
        json_null(out);
        return;
    }
    json_object_begin(out);
    json_key_integer(out, "mode", s->least.mode + 1);
    json_key_number(out, "speed_m_s", s->least.speed);
    json_key_number(out, "frequency_hz", s->least.frequency);
    json_key_number(out, "damping_ratio", s->least.damping);
    json_object_end(out);
}

void result_stability_members(struct json_out *out, const struct result_view *v)
{
    json_key_string(out, "verdict", verdict_name(v->r->verdict));
    json_key_string(out, "verdict_reason", v->r->verdict_reason);
    write_divergence(out, v);
    write_flutter(out, v);
    write_least(out, &v->r->stability);
}

static void write_branches(struct json_out *out, const struct result_view *v)
{
    const struct stability_result *s = &v->r->stability;
    json_key(out, "branches");
    json_array_begin(out);
    for (int j = 0; j < s->n_mode; j++) {
        const ptrdiff_t first = num_at(0, j, v->def->stability.count);
        json_object_begin(out);
        json_key_integer(out, "mode", j + 1);
        json_key_string(out, "label", mode_label_name(v->r->mode[j].label));
        json_key_numbers(out, "frequency_hz", s->n_speed, s->frequency + first, 1, 1.0);
        json_key_numbers(out, "damping_ratio", s->n_speed, s->damping + first, 1, 1.0);
        json_object_end(out);
    }
    json_array_end(out);
}

static void write_shape(struct json_out *out, const struct result_view *v)
{
    const struct flutter_point *f = &v->r->stability.flutter;
    json_key(out, "flutter_shape");
    if (f->onset == ONSET_NONE) {
        json_null(out);
        return;
    }
    double z[STABILITY_SAMPLES];
    for (int i = 0; i < STABILITY_SAMPLES; i++) {
        z[i] = v->def->beam.length * i / (STABILITY_SAMPLES - 1);
    }
    json_object_begin(out);
    json_key_numbers(out, "z_m", STABILITY_SAMPLES, z, 1, 1.0);
    json_key_numbers(out, "plunge_re_chords", STABILITY_SAMPLES, f->shape.plunge_re, 1, 1.0);
    json_key_numbers(out, "plunge_im_chords", STABILITY_SAMPLES, f->shape.plunge_im, 1, 1.0);
    json_key_numbers(out, "twist_re_rad", STABILITY_SAMPLES, f->shape.twist_re, 1, 1.0);
    json_key_numbers(out, "twist_im_rad", STABILITY_SAMPLES, f->shape.twist_im, 1, 1.0);
    json_object_end(out);
}

void result_write_stability(struct json_out *out, const struct result_view *v)
{
    const struct stability_result *s = &v->r->stability;
    json_object_begin(out);
    result_stability_members(out, v);
    json_key_numbers(out, "speeds_m_s", s->n_speed, s->speed, 1, 1.0);
    write_branches(out, v);
    json_key(out, "equilibrium");
    json_object_begin(out);
    json_key_numbers(out, "tip_plunge_m", s->n_speed, s->tip_plunge, 1, 1.0);
    json_key_numbers(out, "tip_twist_deg", s->n_speed, s->tip_twist, 1, 180.0 / NUM_PI);
    json_object_end(out);
    write_shape(out, v);
    json_object_end(out);
}

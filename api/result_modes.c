/* The modes of a run as JSON. */
#include "api/result_parts.h"

#include <math.h>

/* Zero crossings of a shape along the span, the clamped root excluded, by linear interpolation
 * between the samples. A shape that is small against the whole mode has none: it is rounding. */
static int nodes_of(const double *shape, double length, double whole, double z[MODE_SAMPLES])
{
    double largest = 0.0;
    for (int i = 0; i < MODE_SAMPLES; i++) {
        largest = fmax(largest, fabs(shape[i]));
    }
    int n = 0, last = 0;
    for (int i = 1; i < MODE_SAMPLES && largest > 1e-6 * whole; i++) {
        if (fabs(shape[i]) <= 1e-9 * largest) {
            continue;
        }
        if (last > 0 && (shape[i] > 0.0) != (shape[last] > 0.0)) {
            const double t = shape[last] / (shape[last] - shape[i]);
            z[n++] = length * (last + t * (i - last)) / (MODE_SAMPLES - 1);
        }
        last = i;
    }
    return n;
}

static void write_nodes(struct json_out *out, const struct mode_result *m, double length,
                        double chord)
{
    double z[MODE_SAMPLES], whole = 0.0;
    for (int i = 0; i < MODE_SAMPLES; i++) {
        whole = fmax(whole, fmax(fabs(m->plunge[i]), fabs(m->chordwise[i])));
        whole = fmax(whole, fabs(m->twist[i]) * chord);
    }
    json_key(out, "nodes");
    json_object_begin(out);
    int n = nodes_of(m->plunge, length, whole, z);
    json_key_numbers(out, "plunge_z_m", n, z, 1, 1.0);
    n = nodes_of(m->twist, length, whole / chord, z);
    json_key_numbers(out, "twist_z_m", n, z, 1, 1.0);
    json_object_end(out);
}

static void write_shape(struct json_out *out, const struct mode_result *m, double length)
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

static void write_mode(struct json_out *out, const struct mode_result *m, double length,
                       double chord)
{
    static const enum mode_label parts[] = {MODE_BENDING, MODE_LAG, MODE_TORSION, MODE_AXIAL};
    json_object_begin(out);
    json_key_number(out, "frequency_hz", m->frequency_hz);
    json_key_string(out, "label", mode_label_name(m->label));
    json_key_number(out, "modal_mass", m->modal_mass);
    json_key(out, "energy_share");
    json_object_begin(out);
    for (size_t i = 0; i < sizeof parts / sizeof parts[0]; i++) {
        json_key_number(out, mode_label_name(parts[i]), m->share[i]);
    }
    json_object_end(out);
    write_nodes(out, m, length, chord);
    write_shape(out, m, length);
    json_object_end(out);
}

void result_modes_members(struct json_out *out, const struct result_view *v)
{
    const double chord = section_def_chord(beam_def_root(&v->def->beam));
    json_key(out, "modes");
    json_array_begin(out);
    for (int i = 0; i < v->r->n_mode; i++) {
        write_mode(out, &v->r->mode[i], v->def->beam.length, chord);
    }
    json_array_end(out);
}

void result_write_modes(struct json_out *out, const struct result_view *v)
{
    json_object_begin(out);
    result_modes_members(out, v);
    json_object_end(out);
}

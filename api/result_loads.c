/* Loads along the span as JSON. */
#include "api/result_parts.h"
#include "core/num.h"

void result_write_loads(struct json_out *out, const struct result_view *v)
{
    const struct span_loads *l = &v->r->loads;
    const struct {
        const char *key;
        const double *value;
        double scale;
    } column[] = {
        {"z_m", l->z, 1.0},
        {"chord_m", l->chord, 1.0},
        {"cl", l->cl, 1.0},
        {"cd", l->cd, 1.0},
        {"cm", l->cm, 1.0},
        {"lift_n_m", l->lift, 1.0},
        {"drag_n_m", l->drag, 1.0},
        {"moment_n", l->moment, 1.0},
        {"induced_deg", l->induced, num_deg(1.0)},
        {"alpha_deg", l->alpha, num_deg(1.0)},
    };
    json_object_begin(out);
    json_key_numbers(out, "window_s", 2, (const double[]){l->window_from, l->window_to}, 1, 1.0);
    for (size_t i = 0; i < sizeof column / sizeof column[0]; i++) {
        json_key_numbers(out, column[i].key, l->n_station, column[i].value, 1, column[i].scale);
    }
    json_object_end(out);
}

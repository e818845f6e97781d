/* What a section in prescribed motion gives: "loop". */
#include "api/result_parts.h"
#include "core/num.h"

#include <math.h>

static void write_range(struct json_out *out, const char *key, int n, const double *value)
{
    double least = value[0], most = value[0];
    for (int i = 1; i < n; i++) {
        least = fmin(least, value[i]);
        most = fmax(most, value[i]);
    }
    json_key(out, key);
    json_object_begin(out);
    json_key_number(out, "min", least);
    json_key_number(out, "max", most);
    json_object_end(out);
}

void result_loop_members(struct json_out *out, const struct result_view *v)
{
    const struct loop_result *r = &v->r->loop;
    json_key(out, "work");
    json_object_begin(out);
    json_key_number(out, "pitch", r->work_pitch);
    json_key_number(out, "plunge", r->work_plunge);
    json_key_number(out, "total", r->work_pitch + r->work_plunge);
    json_object_end(out);
    json_key_integer(out, "samples", r->n);
    json_key_number(out, "step_c_v", v->r->sample_step);
    json_key_number(out, "outside_polar", (double)r->outside_polar / r->n);
    json_key_number(out, "outside_hull", (double)r->outside_hull / r->n);
    write_range(out, "cl", r->n, r->value + num_at(0, LOOP_CL, r->n));
    write_range(out, "cm", r->n, r->value + num_at(0, LOOP_CM, r->n));
    write_range(out, "cd", r->n, r->value + num_at(0, LOOP_CD, r->n));
}

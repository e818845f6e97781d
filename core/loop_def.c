#include "core/loop_def.h"

#include "core/num.h"
#include "core/range.h"

#include <math.h>

void loop_def_defaults(struct loop_def *def)
{
    *def = (struct loop_def){.dynamic = DYNAMIC_NONE, .cycles = 10, .steps = 400};
}

/* Does the network see what a table does not have: a mean of the angle, or the jerk? */
static bool wants_a_sine(const struct network_def *net)
{
    return network_def_uses(net, NET_IN_MEAN_ALPHA) || network_def_uses(net, NET_IN_DELTA_ALPHA) ||
           network_def_uses(net, NET_IN_ALPHA_ACCELERATION);
}

static void check_table(const struct loop_motion *m, const struct network_def *net,
                        struct failure_list *out)
{
    if (m->n < 2 || m->n > LOOP_SAMPLES_MAX) {
        range_refuse(out, "/motion", "2..1000000 samples", m->n);
    } else if (!(m->step > 0.0) || !num_all_finite(m->n * MOTION_ROWS, m->value)) {
        range_refuse(out, "/motion", "equal steps of time and finite values", m->step);
    }
    if (net != NULL && wants_a_sine(net)) {
        failure_set(failure_add(out), ST_INVALID, "/motion", "contradiction",
                    "a network without mean_alpha, delta_alpha and alpha_acceleration", net->name,
                    "the mean angle a network sees is that of a cycle: a table has none");
    }
}

void loop_def_check(const struct loop_def *def, struct failure_list *out)
{
    if (def->motion != NULL) {
        check_table(def->motion, def->network, out);
        return;
    }
    if (!(fabs(def->mean) <= NUM_PI)) {
        range_refuse(out, "/motion/mean_deg", "-180..180", num_deg(def->mean));
    }
    if (!(def->amplitude >= 0.0 && def->amplitude <= NUM_PI)) {
        range_refuse(out, "/motion/amplitude_deg", "0..180", num_deg(def->amplitude));
    }
    if (!(def->frequency > 0.0 && def->frequency <= 10.0)) {
        range_refuse(out, "/motion/frequency_c_v", "f c/V, above 0 and at most 10", def->frequency);
    }
    if (!(def->plunge >= 0.0 && def->plunge <= 10.0)) {
        range_refuse(out, "/motion/plunge_c", "0..10 chords", def->plunge);
    }
    if (!isfinite(def->phase)) {
        range_refuse(out, "/motion/phase_deg", "a finite angle", num_deg(def->phase));
    }
    if (def->cycles < 1 || def->cycles > LOOP_CYCLES_MAX) {
        range_refuse(out, "/motion/cycles", "1..1000", def->cycles);
    }
    if (def->steps < LOOP_STEPS_MIN || def->steps > LOOP_STEPS_MAX) {
        range_refuse(out, "/motion/steps", "16..10000", def->steps);
    } else if ((long)def->cycles * def->steps >= LOOP_SAMPLES_MAX) {
        range_refuse(out, "/motion/steps", "fewer than 1000000 steps in all cycles", def->steps);
    }
}

/* From the instabilities of a range of speeds to one word. */
#include "core/analysis/stability.h"

#include <stdio.h>

static const char *sort_of(enum onset onset)
{
    static const char *const text[] = {[ONSET_NONE] = "",
                                       [ONSET_CROSSING] = "",
                                       [ONSET_LIMIT_POINT] = ", where the equilibrium ends",
                                       [ONSET_BELOW] = ", below the range or at its start"};
    return text[onset];
}

enum verdict stability_verdict(const struct stability_result *r, char reason[VERDICT_REASON])
{
    const struct flutter_point *f = &r->flutter;
    const struct divergence_point *d = &r->divergence;
    const bool flutters = f->onset != ONSET_NONE, diverges = d->onset != ONSET_NONE;
    if (flutters && (!diverges || f->speed <= d->speed)) {
        (void)snprintf(reason, VERDICT_REASON,
                       "mode %d grows from %.5g m/s%s, at %.5g Hz (reduced frequency %.3g), %s%s",
                       f->mode + 1, f->speed, sort_of(f->onset), f->frequency, f->reduced_frequency,
                       f->coupled ? "coupled with another mode" : "nearly alone",
                       f->stalled ? ", beyond the linear range of the polar" : "");
        return f->stalled ? VERDICT_STALL_FLUTTER : VERDICT_FLUTTER;
    }
    if (diverges) {
        (void)snprintf(reason, VERDICT_REASON, "the static stiffness vanishes at %.5g m/s%s",
                       d->speed, sort_of(d->onset));
        return VERDICT_DIVERGENCE;
    }
    (void)snprintf(reason, VERDICT_REASON,
                   "no instability in the range; least damped is mode %d with a ratio of %.3g at "
                   "%.5g m/s, %.5g Hz",
                   r->least.mode + 1, r->least.damping, r->least.speed, r->least.frequency);
    return VERDICT_STABLE;
}

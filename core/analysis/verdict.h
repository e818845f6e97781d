/* core/analysis/verdict.h
 * From the histories of a run to one word and the numbers that decided it. */
#ifndef AEROM_CORE_ANALYSIS_VERDICT_H
#define AEROM_CORE_ANALYSIS_VERDICT_H

#include "core/coupling/march.h"

/* X(code, name on the wire) */
#define VERDICT_LIST(X)                                                                            \
    X(VERDICT_STABLE, "stable")                                                                    \
    X(VERDICT_DIVERGENCE, "divergence")                                                            \
    X(VERDICT_FLUTTER, "flutter")                                                                  \
    X(VERDICT_STALL_FLUTTER, "stall_flutter")                                                      \
    X(VERDICT_LIMIT_CYCLE, "limit_cycle")                                                          \
    X(VERDICT_LARGE_DEFLECTION, "large_deflection")                                                \
    X(VERDICT_FORCED, "forced")                                                                    \
    X(VERDICT_INDETERMINATE, "indeterminate")
#define VERDICT_ENUM(code, name) code,
enum verdict { VERDICT_LIST(VERDICT_ENUM) VERDICT_COUNT };
#undef VERDICT_ENUM

const char *verdict_name(enum verdict v);

/* Rules, in this order (thirds are of the record; fluctuation is rms about the mean):
 *  - the load turns back at most steps of the last third, or most evaluations of the network are
 *    outside its training hull: indeterminate (core/analysis/doubt.h);
 *  - stopped by amplitude, but the motion has no more energy about the static equilibrium than it
 *    began with, and that equilibrium is beyond the limit or the limit was passed within
 *    VERDICT_PERIODS periods of the first mode: large_deflection, nothing has grown yet;
 *  - stopped by amplitude or a number that is not finite: the last period of the first mode swings
 *    to and fro -> flutter (stall_flutter if stalled), else divergence; indeterminate when the
 *    first mode has fewer than VERDICT_STEPS time steps a period;
 *  - in what follows the record begins when a gust or a table of the root's motion has ended; with
 *    a sine, which does not end, when it has faded in;
 *  - shorter than VERDICT_PERIODS periods of the first mode: indeterminate;
 *  - driven by a sine: the tip's motion grows from third to third -> flutter or stall_flutter; else
 *    it repeats itself from one period of the drive to the next -> forced; else indeterminate;
 *  - twist and plunge stay below the floor, yet one has grown from third to third: indeterminate;
 *  - the fluctuation of twist or plunge grows from the second to the last third -> flutter, or
 *    stall_flutter when stations were stalled;
 *  - it stays and is above the floor -> stall_flutter when stalled, limit_cycle when it differs
 *    from the first third, else indeterminate;
 *  - it decays or is below the floor: divergence when the span sits at angles outside the polar,
 * else stable. `reason` receives one sentence with the numbers. */
enum { VERDICT_STEPS = 8, VERDICT_PERIODS = 3, VERDICT_REASON = 384 };
enum verdict verdict_of(const struct march *march, char reason[VERDICT_REASON]);

#endif

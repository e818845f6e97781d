/* core/analysis/damping.h
 * Damping of a recorded signal: window, decimation, matrix pencil and two cross-checks. */
#ifndef AEROM_CORE_ANALYSIS_DAMPING_H
#define AEROM_CORE_ANALYSIS_DAMPING_H

#include "core/limits.h"
#include "core/status.h"

struct root_result {
    double frequency_hz; /* damped frequency, 0 for a real root */
    double ratio;        /* damping ratio -Re(lambda)/|lambda|; negative grows */
    double amplitude;    /* at the start of the window, in the unit of the signal */
    double residual;     /* rms of the signal the whole fit leaves, relative to its rms */
};

/* Damping of one signal by the matrix pencil, with two cross-checks. */
struct damping_result {
    int n_root;
    struct root_result root[LIMIT_ROOTS]; /* by falling amplitude */
    int torsion;      /* index of the root of the first torsion mode: the nearest, or the largest */
                      /* within 2 % of it; -1 if none */
    int least_stable; /* index of the root with the least ratio among those that have at least 5 %
                       */
                      /* of the size of the largest at the end of the window; -1 if none */
    double window_from; /* [s] */
    double window_to;
    double hilbert_ratio; /* slope of the envelope of the dominant root, NaN if not usable */
    double log_decrement; /* from the peaks of the signal, NaN if fewer than 3 */
};

/* What the identification knows of the system. */
struct damping_system {
    int n_mode;
    double frequency_low;     /* of the first mode: sets the window [Hz] */
    double frequency_high;    /* of the last mode kept: sets the sampling [Hz] */
    double frequency_torsion; /* of the first torsion mode [Hz], 0 if there is none */
};

/* n values at distance dt [s]. The window is DAMPING_PERIODS periods of the first mode: after the
 * first period of a signal that decays, else at its end. The offset and its drift (roots that
 * neither swing nor grow to a size that counts) are not reported. A signal too short or at rest
 * gives no roots. */
enum { DAMPING_PERIODS = 8 };
MUST_CHECK enum status damping_identify(int n, const double *y, double dt,
                                        const struct damping_system *system,
                                        struct damping_result *out);

/* Rms about the mean of y[from..to). */
double damping_fluctuation(const double *y, int from, int to);

#endif

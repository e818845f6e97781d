/* core/analysis/statics.h
 * Kind `static`: deflection of the beam under its loads and, in a stream, at aeroelastic
 * equilibrium; reactions, stresses and first-ply failure. */
#ifndef AEROM_CORE_ANALYSIS_STATICS_H
#define AEROM_CORE_ANALYSIS_STATICS_H

#include "core/analysis/aeroelastic.h"
#include "core/structure/static.h"

enum { STATIC_SAMPLES = 33 }; /* equidistant points of the span, root and tip included */

/* Motion of the section at a point of the span; SI, radians. */
struct static_sample {
    double z;
    struct beam_motion motion;
};

/* Ply states at one position of a static case. */
struct stress_result {
    double z;
    double strain[SECTION_WIDE_COUNT];
    int n_ply;
    struct ply_state *ply; /* (n_ply), owned */
};

struct static_result {
    struct beam_motion tip;
    struct static_sample span[STATIC_SAMPLES];    /* equidistant, root and tip included */
    double reaction_force[3], reaction_moment[3]; /* of the clamp on the beam, about its origin */
    int n_stress;
    struct stress_result stress[LIMIT_STRESS_POSITIONS];
    double reserve_min; /* factor on all loads until first-ply failure, NaN if not known */
    int critical_position, critical_ply; /* where: indices, -1 if not known */
    struct aeroelastic_result air; /* with a flow; without equilibrium all above is NaN or empty */
};

/* Solves the static case of a model (CASE_STATIC). *out owns memory: statics_done, also on a zeroed
 * struct. */
MUST_CHECK enum status statics_run(const struct model *m, struct static_result *out);
void statics_done(struct static_result *r);

#endif

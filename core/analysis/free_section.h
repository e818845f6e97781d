/* core/analysis/free_section.h
 * A rigid section on springs, free to pitch and to plunge, in the march that flies beams: what a
 * dynamic model says of flutter where a flow computation about a body on springs can answer too.
 *
 * Two-dimensional and without dimensions: density, speed and chord are one, time is in c/V. The
 * section is a model of one station and two modes, without a lifting line. Plunge up, pitch and
 * angles nose-up positive. */
#ifndef AEROM_CORE_ANALYSIS_FREE_SECTION_H
#define AEROM_CORE_ANALYSIS_FREE_SECTION_H

#include "core/coupling/march.h"

#include <stddef.h>

struct free_section_def {
    const struct polar_def *polar; /* borrowed */
    enum dynamic_type dynamic;
    const struct network_def *network; /* borrowed, NULL unless DYNAMIC_NETWORK */
    /* Per unit span, by density and powers of the chord. The springs act at the elastic axis. */
    double mass;      /* > 0 */
    double inertia;   /* about the elastic axis, > mass imbalance^2 */
    double axis;      /* elastic axis behind mid-chord, in chords */
    double imbalance; /* mass centre behind the elastic axis, in chords */
    /* f c/V, > 0, of each freedom alone in a vacuum: the square root of stiffness over mass, and
     * over moment of inertia, by 2 pi. */
    double plunge_frequency, pitch_frequency;
    double plunge_damping, pitch_damping; /* ratios of the two modes in a vacuum, 0 <= zeta < 1 */
    double rest;                          /* angle of the chord at which the springs are slack */
    double pitch, pitch_rate;             /* at t = 0, beyond rest [rad, rad V/c] */
    double plunge, plunge_rate;           /* of the elastic axis at t = 0 [c, V] */
    double duration;                      /* c/V */
    double step;                          /* c/V */
};

/* Mass 50, moment of inertia 4, everything else zero but a duration of 200 and a step of 0.02. */
void free_section_def_defaults(struct free_section_def *def);

/* The numbers of a section by name, with their ranges: what a user gives. */
struct free_section_field {
    const char *name;
    size_t offset; /* of the double in struct free_section_def */
    bool degrees;  /* given in degrees, kept in radians */
    double low, high;
    bool open; /* low itself is excluded */
    const char *expected;
};
enum { FREE_SECTION_FIELDS = 15 };
extern const struct free_section_field free_section_fields[FREE_SECTION_FIELDS];

/* Appends what is wrong; pointers are the names of the fields. */
void free_section_def_check(const struct free_section_def *def, struct failure_list *out);

enum free_section_quantity {
    FREE_TIME,   /* c/V */
    FREE_ALPHA,  /* angle of the chord [rad] */
    FREE_PLUNGE, /* of mid-chord, w/c */
    FREE_CL,     /* normal to the undisturbed stream */
    FREE_CD,     /* NaN if the polar has no drag */
    FREE_CM,     /* about mid-chord, nose-up */
    FREE_QUANTITIES
};

struct free_section_result {
    int n;         /* steps taken + 1 */
    double *value; /* (n x FREE_QUANTITIES), time fastest, owned */
    enum stop_reason stop;
    long outside_polar, outside_hull; /* steps */
};

/* The model of a checked section, for whatever else can be asked of one. The polar must outlive it;
 * model_done frees it. On failure *out is unchanged. */
MUST_CHECK enum status free_section_model(const struct free_section_def *def, struct model *out);

/* Marches a checked section: its loads as of steady flow at the start. On failure *out is
 * unchanged. */
MUST_CHECK enum status free_section_run(const struct free_section_def *def,
                                        struct free_section_result *out);
/* Accepts a zeroed struct. */
void free_section_done(struct free_section_result *r);

#endif

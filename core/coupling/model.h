/* core/coupling/model.h
 * case_def -> immutable model: sections, beam, modes, aerodynamic tables and the transfer between
 * modes and stations. Built once, then only read; any number of threads may share it. */
#ifndef AEROM_CORE_COUPLING_MODEL_H
#define AEROM_CORE_COUPLING_MODEL_H

#include "core/aero/attached.h"
#include "core/aero/dynamic_stall.h"
#include "core/aero/network_memory.h"
#include "core/case_def.h"
#include "core/structure/centres.h"
#include "core/structure/modes.h"

/* How a moving clamp and a gust act on the modes: core/coupling/excitation.h. */
struct excitation {
    double *mid_chord; /* x of mid-chord from the axis at the stations [m] (n_station), owned with
                          the next three: r' m phi of a rigid beam, the air's mass included */
    double *plunge;    /* (n_mode) */
    double *pitch;     /* (n_mode) */
    double *bending;   /* moment in the clamp per unit q'' (n_mode) */
    double bending_plunge, bending_pitch; /* per unit acceleration of the clamp */
    double bending_weight;                /* [N m] */
    struct drive root_pitch, root_plunge;
    struct kuessner kuessner; /* n = 0 without a gust on a wake that lags */
};

struct model {
    struct case_def def;    /* the case; polar, network and stations still borrowed */
    struct section section; /* of the root */
    struct section_summary section_summary;
    struct centres centres;
    double thickness;       /* of the root section, overall [m]; NaN with properties */
    struct beam beam;       /* not for CASE_SECTION */
    struct modes modes;     /* not for CASE_SECTION, and for CASE_STATIC only with a flow */
    bool borrows_structure; /* what beam and modes point to belongs to another model */

    /* The rest only where case_def_flows. */
    struct polar *polar;
    struct network *network;              /* NULL without one */
    struct network_memory network_memory; /* n = 0 without a network */
    struct lifting_line lifting_line;     /* n = 0 without one */
    struct attached attached;             /* n = 0 without a wake that lags */
    struct dynamic_stall stall;           /* n = 0 without; it has a wake that lags too */
    int n_mode;
    int n_station;           /* middles of equal parts of the span */
    double station_length;   /* [m] */
    double dynamic_pressure; /* rho V^2 / 2 [Pa] */
    double area;             /* of the planform [m^2] */
    double *chord;           /* at the stations [m] (n_station) */
    double *omega2;          /* squared natural frequencies (n_mode) */
    double *damping;         /* 2 zeta omega               (n_mode) */
    double *gravity;         /* modal load of gravity      (n_mode) */
    /* Mode shapes at the stations, of mid-chord, station fastest. Loads use the same matrices, so
     * the power of the loads on the stations is that on the modes. */
    double *station_u;       /* (n_station x n_mode) */
    double *station_v;       /* (n_station x n_mode) */
    double *station_theta;   /* (n_station x n_mode) */
    struct beam_motion *tip; /* of mid-chord (n_mode) */
    /* Only with apparent mass: the modes marched in are those in still air. */
    double *to_vacuo; /* amplitudes of the modes in vacuo per unit of these (n_mode x n_mode) */
    double *damping_coupling;     /* structural damping off the diagonal (n_mode x n_mode) */
    struct excitation excitation; /* CASE_SIMULATION */
};

/* Builds from a checked case. On failure *out is unchanged and *fail names the part. */
MUST_CHECK enum status model_build(const struct case_def *def, struct model *out,
                                   struct failure *fail);
/* The same for a case that differs from the one of `like` in nothing that shapes sections, beam and
 * modes (stream, air, stepping, output, loads): those are taken over, not solved again. They still
 * belong to `like`, which must outlive *out. */
MUST_CHECK enum status model_build_like(const struct case_def *def, const struct model *like,
                                        struct model *out, struct failure *fail);
void model_done(struct model *m);

/* Room, zeroed, for what a model whose n_mode and n_station are set keeps of its modes and
 * stations; model_done frees it, also after a failure. */
MUST_CHECK enum status model_allocate(struct model *m);
/* The aerodynamics of a model whose case, modes and stations are complete: what model_build does
 * last, for models that come from no beam (core/analysis/free_section.h). */
MUST_CHECK enum status model_build_aero(struct model *m);

/* Builds each section of a case that case_def_check found in order, with a coarse mesh, and appends
 * those that cannot carry load: what is wrong with them only shows there. ST_NO_MEMORY or ST_OK. */
MUST_CHECK enum status model_try_sections(const struct beam_def *b, struct failure_list *out);

/* Motion of mid-chord at z [m] for freedoms x of the beam (n_dof): what the stream sees and results
 * report. The beam's own motion is that of its axis, the origin of the sections. */
struct beam_motion model_motion_at(const struct model *m, const double *x, double z);

#endif

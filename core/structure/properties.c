#include "core/structure/properties.h"

#include "core/num.h"
#include "core/range.h"

#include <stdio.h>
#include <string.h>

enum { C = SECTION_CLASSIC, R = SECTION_STRAIN_COUNT, M = SECTION_MOTION_COUNT };

void properties_defaults(struct properties *out)
{
    *out = (struct properties){.ei_lag = (double)NAN,
                               .ea = (double)NAN,
                               .inertia_axis = INERTIA_ELASTIC_AXIS,
                               .elastic_axis = 0.5,
                               .mass_axis = (double)NAN};
}

void properties_complete(struct properties *p)
{
    if (isnan(p->ei_lag)) {
        p->ei_lag = PROPERTIES_LAG_RATIO * p->ei_flap;
    }
    if (isnan(p->ea)) {
        p->ea = 12.0 * p->ei_lag / num_sq(p->chord);
    }
    if (isnan(p->mass_axis)) {
        p->mass_axis = p->elastic_axis;
    }
}

double properties_mid_chord(const struct properties *p)
{
    return (p->elastic_axis - 0.5) * p->chord;
}

double properties_mass_centre(const struct properties *p)
{
    return (p->elastic_axis - p->mass_axis) * p->chord;
}

/* Distance between the mass centre and the axis the inertia is given about. */
static double inertia_arm(const struct properties *p)
{
    switch (p->inertia_axis) {
    case INERTIA_ELASTIC_AXIS:
        return properties_mass_centre(p);
    case INERTIA_MID_CHORD:
        return properties_mass_centre(p) - properties_mid_chord(p);
    case INERTIA_MASS_CENTRE:
        break;
    }
    return 0.0;
}

double properties_central_inertia(const struct properties *p)
{
    return p->torsion_inertia - p->mass * num_sq(inertia_arm(p));
}

/* Rules over several numbers, once each is in its range. */
static void check_together(const struct properties *p, const char *pointer,
                           struct failure_list *out)
{
    char at[160], expected[128], got[32];
    const double limit = sqrt(p->ei_flap * p->gj);
    if (!(fabs(p->bend_twist) < limit)) {
        (void)snprintf(at, sizeof at, "%.120s/bend_twist_n_m2", pointer);
        (void)snprintf(expected, sizeof expected,
                       "a magnitude below sqrt(ei_flap_n_m2 gj_n_m2) = %.6g", limit);
        (void)snprintf(got, sizeof got, "%.10g", p->bend_twist);
        failure_set(failure_add(out), ST_INVALID, at, "not_positive_definite", expected, got,
                    "with this coupling a bending and twisting section would release energy");
    }
    if (!(properties_central_inertia(p) > 0.0)) {
        (void)snprintf(at, sizeof at, "%.120s/torsion_inertia_kg_m", pointer);
        (void)snprintf(expected, sizeof expected,
                       "more than mass_kg_m times the squared distance to the mass centre, %.6g",
                       p->mass * num_sq(inertia_arm(p)));
        (void)snprintf(got, sizeof got, "%.10g", p->torsion_inertia);
        failure_set(failure_add(out), ST_INVALID, at, "inertia_too_small", expected, got,
                    "about the mass centre the inertia would not be positive; see "
                    "torsion_inertia_about");
    }
}

void properties_check(const struct properties *p, const char *pointer, struct failure_list *out)
{
    enum { KEYS = 11 };
    static const char *const key[KEYS] = {"chord_m",
                                          "ei_flap_n_m2",
                                          "ei_lag_n_m2",
                                          "gj_n_m2",
                                          "ea_n",
                                          "bend_twist_n_m2",
                                          "ei_warping_n_m4",
                                          "mass_kg_m",
                                          "mass_axis_chord",
                                          "torsion_inertia_kg_m",
                                          "elastic_axis_chord"};
    char at[KEYS][160];
    for (int i = 0; i < KEYS; i++) {
        (void)snprintf(at[i], sizeof at[i], "%.120s/%s", pointer, key[i]);
    }
    const struct range rule[] = {
        {at[0], p->chord, 0.0, HUGE_VAL, true, false},
        {at[1], p->ei_flap, 0.0, HUGE_VAL, true, false},
        {at[3], p->gj, 0.0, HUGE_VAL, true, false},
        {at[5], p->bend_twist, -HUGE_VAL, HUGE_VAL, true, true},
        {at[6], p->ei_warping, 0.0, HUGE_VAL, false, false},
        {at[7], p->mass, 0.0, HUGE_VAL, true, false},
        {at[9], p->torsion_inertia, 0.0, HUGE_VAL, true, false},
        {at[10], p->elastic_axis, 0.0, 1.0, false, false},
    };
    /* These may follow from the others. */
    const struct range completed[] = {
        {at[2], p->ei_lag, 0.0, HUGE_VAL, true, false},
        {at[4], p->ea, 0.0, HUGE_VAL, true, false},
        {at[8], p->mass_axis, 0.0, 1.0, false, false},
    };
    const int before = out->total;
    RANGE_CHECK(rule, out);
    if (out->total == before) {
        RANGE_CHECK(completed, out);
    }
    if (out->total == before) {
        check_together(p, pointer, out);
    }
}

static double mix(double a, double b, double t)
{
    return a + t * (b - a);
}

void properties_blend(const struct properties *a, const struct properties *b, double t,
                      struct properties *out)
{
    *out = (struct properties){
        .chord = mix(a->chord, b->chord, t),
        .ei_flap = mix(a->ei_flap, b->ei_flap, t),
        .ei_lag = mix(a->ei_lag, b->ei_lag, t),
        .gj = mix(a->gj, b->gj, t),
        .ea = mix(a->ea, b->ea, t),
        .bend_twist = mix(a->bend_twist, b->bend_twist, t),
        .ei_warping = mix(a->ei_warping, b->ei_warping, t),
        .mass = mix(a->mass, b->mass, t),
        .torsion_inertia = mix(properties_central_inertia(a), properties_central_inertia(b), t),
        .inertia_axis = INERTIA_MASS_CENTRE,
        .elastic_axis = mix(a->elastic_axis, b->elastic_axis, t),
        .mass_axis = mix(a->mass_axis, b->mass_axis, t),
    };
}

/* Velocities of the line of mass centres: u, v + x theta, w - x u'. */
static void fill_mass(const struct properties *p, double *out)
{
    const double m = p->mass, x = properties_mass_centre(p);
    memset(out, 0, (size_t)(M * M) * sizeof *out);
    out[num_at(M_U, M_U, M)] = out[num_at(M_V, M_V, M)] = out[num_at(M_W, M_W, M)] = m;
    out[num_at(M_V, M_THETA, M)] = out[num_at(M_THETA, M_V, M)] = m * x;
    out[num_at(M_W, M_DU, M)] = out[num_at(M_DU, M_W, M)] = -m * x;
    out[num_at(M_DU, M_DU, M)] = m * x * x;
    out[num_at(M_THETA, M_THETA, M)] = properties_central_inertia(p) + m * x * x;
}

void properties_build(const struct properties *p, struct section *out)
{
    const double diagonal[C] = {[S_W] = p->ea,
                                [S_PSI] = p->ei_lag,
                                [S_PHI] = p->ei_flap,
                                [S_THETA] = p->gj,
                                [S_THETA2] = p->ei_warping};
    *out = (struct section){.shear_unknown = true};
    for (int i = 0; i < C; i++) {
        out->classic[num_at(i, i, C)] = diagonal[i];
    }
    out->classic[num_at(S_PHI, S_THETA, C)] = out->classic[num_at(S_THETA, S_PHI, C)] =
        p->bend_twist;
    for (int i = 0; i < R; i++) {
        for (int j = 0; j < R; j++) {
            out->stiffness[num_at(i, j, R)] =
                i < C && j < C ? out->classic[num_at(i, j, C)] : (double)NAN;
        }
    }
    fill_mass(p, out->mass);
    memcpy(out->mass_retained, out->mass, sizeof out->mass);
}

/* The static deflection, its reactions and ply stresses as JSON. */
#include "api/result_parts.h"
#include "core/num.h"

#include <math.h>
#include <stddef.h>
#include <string.h>

static void write_motion_members(struct json_out *out, const struct beam_motion *m)
{
    json_key_number(out, "plunge_m", m->v);
    json_key_number(out, "chordwise_m", m->u);
    json_key_number(out, "axial_m", m->w);
    json_key_number(out, "twist_deg", num_deg(m->theta));
    /* v' and u' where shear does not turn the section further. */
    json_key_number(out, "slope_flap_deg", num_deg(-m->phi));
    json_key_number(out, "slope_lag_deg", num_deg(m->psi));
}

static void write_reactions(struct json_out *out, const struct static_result *s)
{
    static const char *const force[3] = {"force_x_n", "force_y_n", "force_z_n"};
    static const char *const moment[3] = {"moment_x_n_m", "moment_y_n_m", "moment_z_n_m"};
    json_key(out, "reactions");
    json_object_begin(out);
    for (int d = 0; d < 3; d++) {
        json_key_number(out, force[d], s->reaction_force[d] + 0.0); /* never -0 */
    }
    for (int d = 0; d < 3; d++) {
        json_key_number(out, moment[d], s->reaction_moment[d] + 0.0);
    }
    json_object_end(out);
}

/* Name of a layup: its own, else the wall of a box it belongs to, else null. */
static const char *layup_name(const struct shape *shape, int layup)
{
    static const char *const wall[BOX_WALLS] = {
        [BOX_FRONT] = "front", [BOX_TOP] = "top", [BOX_REAR] = "rear", [BOX_BOTTOM] = "bottom"};
    if (shape->type == SECTION_CONTOUR) {
        return shape->layup[layup].name;
    }
    return shape->n_layup == BOX_WALLS ? wall[layup] : NULL;
}

/* Where the load meets the first ply; reserves above one are safe. */
static void write_first_failure(struct json_out *out, const struct result_view *v)
{
    const struct static_result *s = &v->r->statics;
    json_key(out, "first_ply_failure");
    if (s->critical_position < 0) {
        json_null(out);
        return;
    }
    const struct stress_result *at = &s->stress[s->critical_position];
    const struct ply_state *ply = &at->ply[s->critical_ply];
    json_object_begin(out);
    json_key_number(out, "reserve", s->reserve_min);
    json_key_number(out, "z_m", at->z);
    json_key_string(out, "layup",
                    layup_name(&beam_def_given_at(&v->def->beam, at->z)->shape, ply->layup));
    json_key_integer(out, "ply", ply->ply);
    json_object_end(out);
}

static void write_totals(struct json_out *out, const struct load_totals *t)
{
    json_key_number(out, "lift_n", t->lift);
    json_key_number(out, "drag_n", t->drag);
    json_key_number(out, "moment_n_m", t->moment);
    json_key_number(out, "cl", t->cl);
    json_key_number(out, "cd", t->cd);
    json_key_number(out, "cm", t->cm);
}

/* Null without a stream. */
static void write_aeroelastic(struct json_out *out, const struct result_view *v)
{
    const struct aeroelastic_result *a = &v->r->statics.air;
    const double q = 0.5 * v->def->flow.density * num_sq(v->def->flow.speed);
    json_key(out, "aeroelastic");
    if (!case_def_flows(v->def)) {
        json_null(out);
        return;
    }
    json_object_begin(out);
    json_key_string(out, "state", aeroelastic_state_name(a->state));
    json_key_string(out, "reason", a->reason);
    json_key_number(out, "divergence_speed_m_s", a->divergence_speed);
    json_key_number(out, "pressure_ratio",
                    isfinite(a->divergence_pressure) ? q / a->divergence_pressure : (double)NAN);
    json_key_number(out, "followed_to", a->share);
    json_key_integer(out, "iterations", a->iterations);
    json_key_number(out, "residual", a->residual);
    json_key_number(out, "lifting_line_residual", a->lifting_line_residual);
    json_key_integer(out, "stations_outside_polar", a->outside_polar);
    write_totals(out, &a->total);
    json_object_end(out);
}

void result_static_members(struct json_out *out, const struct result_view *v)
{
    json_key(out, "tip");
    json_object_begin(out);
    write_motion_members(out, &v->r->statics.tip);
    json_object_end(out);
    write_reactions(out, &v->r->statics);
    write_first_failure(out, v);
    write_aeroelastic(out, v);
}

/* Column of the span samples by the name of its quantity. */
static void write_span(struct json_out *out, const struct static_result *s)
{
    enum { COLUMNS = 7 };
    static const char *const key[COLUMNS] = {"z_m",          "plunge_m",  "chordwise_m",
                                             "axial_m",      "twist_deg", "slope_flap_deg",
                                             "slope_lag_deg"};
    double column[COLUMNS][STATIC_SAMPLES];
    for (int i = 0; i < STATIC_SAMPLES; i++) {
        const struct beam_motion *m = &s->span[i].motion;
        const double value[COLUMNS] = {
            s->span[i].z, m->v, m->u, m->w, num_deg(m->theta), num_deg(-m->phi), num_deg(m->psi)};
        for (int k = 0; k < COLUMNS; k++) {
            column[k][i] = value[k];
        }
    }
    json_key(out, "span");
    json_object_begin(out);
    for (int k = 0; k < COLUMNS; k++) {
        json_key_numbers(out, key[k], STATIC_SAMPLES, column[k], 1, 1.0);
    }
    json_object_end(out);
}

/* Loads along the span, one entry a station; empty lists without an equilibrium in a stream. */
static void write_stations(struct json_out *out, const struct aeroelastic_result *a)
{
    static const struct {
        const char *key;
        size_t member;
        double unit;
    } column[] = {
#define COLUMN(key_, member_, unit_) {key_, offsetof(struct aeroelastic_station, member_), unit_}
        COLUMN("z_m", z, 1.0),
        COLUMN("chord_m", chord, 1.0),
        COLUMN("alpha_deg", alpha, 180.0 / NUM_PI),
        COLUMN("induced_deg", induced, 180.0 / NUM_PI),
        COLUMN("twist_deg", twist, 180.0 / NUM_PI),
        COLUMN("plunge_m", plunge, 1.0),
        COLUMN("cl", cl, 1.0),
        COLUMN("cd", cd, 1.0),
        COLUMN("cm", cm, 1.0),
        COLUMN("lift_n_m", lift, 1.0),
        COLUMN("drag_n_m", drag, 1.0),
        COLUMN("moment_n", moment, 1.0),
#undef COLUMN
    };
    json_key(out, "air");
    json_object_begin(out);
    for (size_t k = 0; k < sizeof column / sizeof column[0]; k++) {
        json_key(out, column[k].key);
        json_array_begin(out);
        for (int i = 0; i < a->n_station; i++) {
            double value;
            memcpy(&value, (const char *)&a->station[i] + column[k].member, sizeof value);
            json_number(out, value * column[k].unit);
        }
        json_array_end(out);
    }
    json_object_end(out);
}

static void write_ply(struct json_out *out, const struct shape *shape, const struct ply_state *p)
{
    json_object_begin(out);
    json_key_string(out, "layup", layup_name(shape, p->layup));
    json_key_integer(out, "ply", p->ply);
    json_key_string(out, "material", shape->layup[p->layup].ply[p->ply].material.name);
    json_key_integer(out, "wall", p->wall);
    json_key_number(out, "x_m", p->x);
    json_key_number(out, "y_m", p->y);
    json_key_number(out, "n_m", p->n);
    json_key_number(out, "sigma_l_pa", p->stress.l);
    json_key_number(out, "sigma_t_pa", p->stress.t);
    json_key_number(out, "tau_lt_pa", p->stress.lt);
    json_key_number(out, "strain_l", p->strain_l);
    json_key_number(out, "strain_t", p->strain_t);
    json_key_number(out, "strain_lt", p->strain_lt);
    json_key_number(out, "index", p->index);
    json_key_number(out, "reserve", p->reserve);
    json_object_end(out);
}

static void write_stress(struct json_out *out, const struct result_view *v)
{
    static const char *const strain[SECTION_STRAIN_COUNT] = {[S_W] = "w_rate",
                                                             [S_PSI] = "psi_rate_1_m",
                                                             [S_PHI] = "phi_rate_1_m",
                                                             [S_THETA] = "theta_rate_1_m",
                                                             [S_THETA2] = "theta_rate2_1_m2",
                                                             [S_GXZ] = "gamma_xz",
                                                             [S_GYZ] = "gamma_yz"};
    const struct static_result *s = &v->r->statics;
    json_key(out, "stress");
    json_array_begin(out);
    for (int i = 0; i < s->n_stress; i++) {
        const struct shape *shape = &beam_def_given_at(&v->def->beam, s->stress[i].z)->shape;
        json_object_begin(out);
        json_key_number(out, "z_m", s->stress[i].z);
        json_key(out, "strains");
        json_object_begin(out);
        for (int k = 0; k < SECTION_STRAIN_COUNT; k++) {
            json_key_number(out, strain[k], s->stress[i].strain[k]);
        }
        json_object_end(out);
        json_key(out, "plies");
        json_array_begin(out);
        for (int k = 0; k < s->stress[i].n_ply; k++) {
            write_ply(out, shape, &s->stress[i].ply[k]);
        }
        json_array_end(out);
        json_object_end(out);
    }
    json_array_end(out);
}

void result_write_static(struct json_out *out, const struct result_view *v)
{
    json_object_begin(out);
    result_static_members(out, v);
    write_span(out, &v->r->statics);
    write_stations(out, &v->r->statics.air);
    write_stress(out, v);
    json_object_end(out);
}

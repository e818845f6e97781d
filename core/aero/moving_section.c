#include "core/aero/moving_section.h"

/* The units of this room. */
static const double chord = 1.0, speed = 1.0, density = 1.0, dynamic_pressure = 0.5;

enum status moving_section_init(const struct network_frame *frame, const struct polar *polar,
                                double dt, struct moving_section *out)
{
    *out = (struct moving_section){.polar = polar};
    enum status st = network_memory_init(1, &chord, speed, dt, frame, &out->memory);
    if (st == ST_OK && frame->base != NETWORK_ON_POLAR) {
        st = attached_init(1, &chord, speed, dt, &out->attached);
    }
    if (st == ST_OK && frame->base == NETWORK_ON_STALL) {
        st = dynamic_stall_init(1, &chord, speed, dt, polar, polar_stall(polar), &out->stall);
    }
    return st;
}

void moving_section_done(struct moving_section *s)
{
    dynamic_stall_done(&s->stall);
    attached_done(&s->attached);
    network_memory_done(&s->memory);
}

/* The angle that acts: of the chord in the relative stream, or what the wake lets act of the one at
 * three quarters of the chord. */
static double effective_angle(struct moving_section *s, const struct moving_state *m, bool first)
{
    double alpha = m->theta - m->w_rate;
    if (s->attached.n == 0) {
        return alpha;
    }
    const double alpha_34 = alpha + 0.25 * m->theta_rate;
    if (first) {
        attached_steady(1, &alpha_34, s->wake);
    } else {
        attached_step(&s->attached, &s->alpha_34, &alpha_34, s->wake);
    }
    s->alpha_34 = alpha_34;
    attached_angle(1, &alpha_34, s->wake, &alpha);
    return alpha;
}

static void apply_stall(struct moving_section *s, double alpha, const struct moving_state *m,
                        bool first, struct moving_value *v)
{
    if (s->stall.n == 0) {
        return;
    }
    if (first) {
        dynamic_stall_steady(&s->stall, &alpha, &m->w, s->stall_state);
    } else {
        dynamic_stall_step(&s->stall, &alpha, &m->w, s->stall_state);
    }
    dynamic_stall_coefficients(&s->stall, &alpha, s->stall_state, &v->cl, &v->cd, &v->cm);
    network_stall_inputs(1, s->stall_state, s->input);
}

static void add_apparent_mass(const struct moving_section *s, const struct moving_state *m,
                              struct moving_value *v)
{
    if (s->attached.n == 0) {
        return;
    }
    v->cl += attached_cl_rate() * m->theta_rate -
             attached_mass(density, chord) * m->w_acceleration / dynamic_pressure;
    v->cm += attached_cm_rate() * m->theta_rate -
             attached_inertia(density, chord) * m->theta_acceleration / dynamic_pressure;
}

struct moving_value moving_section_step(struct moving_section *s, const struct moving_state *m,
                                        bool first)
{
    const double geometric = m->theta - m->w_rate;
    const double alpha = effective_angle(s, m, first);
    const struct polar_value p = polar_at(s->polar, alpha, m->w);
    struct moving_value v = {.cl = p.cl, .cd = p.cd, .cm = p.cm, .outside = p.outside};
    apply_stall(s, alpha, m, first, &v);
    add_apparent_mass(s, m, &v);
    if (first) {
        network_memory_steady(&s->memory, &geometric, &m->theta_rate, s->input);
    } else {
        network_memory_step(&s->memory, &geometric, &m->theta_rate, s->input);
    }
    return v;
}

#include "tests/support/typical_section.h"

#include "core/coupling/apparent_mass.h"
#include "core/la.h"
#include "core/num.h"

#include <stdlib.h>
#include <string.h>

enum { FREEDOMS = 2 };

struct typical_section typical_section_hodges(void)
{
    /* mu = m/(pi rho b^2) = 20, a = -1/5, x_theta = 1/10, r^2 = 6/25, sigma = omega_h/omega_theta
     * = 2/5 */
    const double density = 1.0, mass = 20.0 * NUM_PI * density;
    return (struct typical_section){.chord = 2.0,
                                    .a = -0.2,
                                    .mass = mass,
                                    .x_theta = 0.1,
                                    .inertia = mass * 0.24,
                                    .k_plunge = mass * 0.16,
                                    .k_pitch = mass * 0.24,
                                    .density = density};
}

/* Case and arrays of one station of unit span with given mode shapes (v at mid-chord, theta). */
static void fill(double chord, double density, const struct polar_def *polar,
                 enum dynamic_type dynamic, double speed, double time_step, const double *v,
                 const double *theta, const double *omega, struct model *m)
{
    *m = (struct model){.n_mode = FREEDOMS, .n_station = 1, .station_length = 1.0, .area = chord};
    case_def_defaults(&m->def);
    m->def.kind = CASE_SIMULATION;
    m->def.beam.length = 1.0;
    m->def.beam.elements = 1;
    m->def.flow.speed = speed;
    m->def.flow.density = density;
    m->def.flow.incidence = 0.0;
    m->def.aero.polar = polar;
    m->def.aero.dynamic = dynamic;
    m->def.aero.lifting_line = false;
    m->def.solver.modes = FREEDOMS;
    m->def.solver.time_step = time_step;
    m->dynamic_pressure = 0.5 * density * speed * speed;
    m->omega2 = calloc(3 * FREEDOMS + 1 + 3 * FREEDOMS, sizeof *m->omega2);
    m->tip = calloc(FREEDOMS, sizeof *m->tip);
    m->modes = (struct modes){.n_mode = FREEDOMS, .omega = calloc(FREEDOMS, sizeof(double))};
    if (m->omega2 == NULL || m->tip == NULL || m->modes.omega == NULL ||
        polar_create(polar, &m->polar) != ST_OK ||
        (dynamic == DYNAMIC_ATTACHED &&
         attached_init(1, &chord, speed, time_step, &m->attached) != ST_OK)) {
        abort();
    }
    m->damping = m->omega2 + FREEDOMS;
    m->gravity = m->damping + FREEDOMS;
    m->chord = m->gravity + FREEDOMS;
    m->station_u = m->chord + 1;
    m->station_v = m->station_u + FREEDOMS;
    m->station_theta = m->station_v + FREEDOMS;
    m->chord[0] = chord;
    for (int j = 0; j < FREEDOMS; j++) {
        m->modes.omega[j] = omega[j];
        m->omega2[j] = num_sq(omega[j]);
        m->station_v[j] = v[j];
        m->station_theta[j] = theta[j];
        m->tip[j] = (struct beam_motion){.v = v[j], .theta = theta[j]};
    }
}

void typical_section_model(const struct typical_section *s, const struct polar_def *polar,
                           enum dynamic_type dynamic, double speed, double time_step,
                           struct model *out)
{
    const double b = 0.5 * s->chord;
    /* Of v at the elastic axis and theta; x points to the leading edge, so a mass centre behind
     * the axis goes down when the nose goes up. */
    const double off = -s->mass * s->x_theta * b;
    double mass[FREEDOMS * FREEDOMS] = {s->mass, off, off, s->inertia};
    double stiffness[FREEDOMS * FREEDOMS] = {s->k_plunge, 0.0, 0.0, s->k_pitch};
    double lambda[FREEDOMS], x[FREEDOMS * FREEDOMS], v[FREEDOMS], theta[FREEDOMS], omega[FREEDOMS];
    if (la_smallest_modes(FREEDOMS, stiffness, mass, FREEDOMS, lambda, x) != ST_OK) {
        abort();
    }
    for (int j = 0; j < FREEDOMS; j++) {
        omega[j] = sqrt(lambda[j]);
        theta[j] = x[num_at(1, j, FREEDOMS)];
        v[j] = x[num_at(0, j, FREEDOMS)] + s->a * b * theta[j]; /* mid-chord is a b ahead */
    }
    fill(s->chord, s->density, polar, dynamic, speed, time_step, v, theta, omega, out);
    if (dynamic == DYNAMIC_ATTACHED && apparent_mass_apply(out) != ST_OK) {
        abort();
    }
}

void typical_section_driven(double chord, double density, const struct polar_def *polar,
                            enum dynamic_type dynamic, double speed, double time_step,
                            struct model *out)
{
    static const double v[FREEDOMS] = {1.0, 0.0}, theta[FREEDOMS] = {0.0, 1.0};
    static const double omega[FREEDOMS] = {1.0, 1.0};
    fill(chord, density, polar, dynamic, speed, time_step, v, theta, omega, out);
}

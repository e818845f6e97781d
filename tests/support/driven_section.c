#include "tests/support/driven_section.h"

#include "core/num.h"

#include <stdlib.h>

enum { FREEDOMS = 2 };

void driven_section_model(double chord, double density, const struct polar_def *polar,
                          enum dynamic_type dynamic, double speed, double time_step,
                          struct model *m)
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
    m->modes = (struct modes){.n_mode = FREEDOMS, .omega = calloc(FREEDOMS, sizeof(double))};
    if (model_allocate(m) != ST_OK || m->modes.omega == NULL ||
        polar_create(polar, &m->polar) != ST_OK ||
        (dynamic == DYNAMIC_ATTACHED &&
         attached_init(1, &chord, speed, time_step, &m->attached) != ST_OK)) {
        abort();
    }
    m->chord[0] = chord;
    for (int j = 0; j < FREEDOMS; j++) {
        const double v = j == 0 ? 1.0 : 0.0, theta = j == 1 ? 1.0 : 0.0;
        m->modes.omega[j] = m->omega2[j] = 1.0;
        m->station_v[j] = v;
        m->station_theta[j] = theta;
        m->tip[j] = (struct beam_motion){.v = v, .theta = theta};
    }
}

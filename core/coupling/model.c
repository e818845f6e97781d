#include "core/coupling/model.h"

#include "core/num.h"

#include <assert.h>
#include <stdlib.h>
#include <string.h>

static enum status build_section(struct model *m)
{
    const struct section_def *s = &m->def.beam.section;
    /* The contour of a strip runs from the leading to the trailing edge, so the case's angle
     * (negative towards the leading edge) is the laminate's angle towards +s as it stands. */
    enum status st = laminate_build(s->n_ply, s->ply, s->chordwise, &m->laminate);
    struct contour contour = {0};
    if (st == ST_OK) {
        st = contour_strip(s->chord, s->contour_elements, &contour);
    }
    if (st == ST_OK) {
        st = section_build(&contour, &m->laminate, &m->section);
    }
    if (st == ST_OK) {
        st = section_summarise(&m->section, &m->section_summary);
    }
    contour_done(&contour);
    return st;
}

static enum status build_beam(struct model *m)
{
    const struct beam_def *b = &m->def.beam;
    struct beam_mesh mesh = {0};
    enum status st = beam_mesh_build(b->length, b->elements, 0, NULL, &mesh);
    if (st == ST_OK) {
        const struct beam_spec spec = {.mesh = &mesh,
                                       .section = &m->section,
                                       .uniform = true,
                                       .shear = b->section.shear,
                                       .root = b->root_warping};
        st = beam_build(&spec, &m->beam);
    }
    beam_mesh_done(&mesh);
    if (st == ST_OK) {
        st = modes_solve(&m->beam, b->section.chord, m->def.solver.modes, &m->modes);
    }
    return st;
}

static enum status build_transfer(struct model *m)
{
    m->n_mode = m->modes.n_mode;
    m->n_station = m->def.beam.elements;
    m->station_length = m->def.beam.length / m->n_station;
    const size_t nm = (size_t)m->n_mode, block = nm * (size_t)m->n_station;
    m->omega2 = malloc((2 * nm + 3 * block) * sizeof *m->omega2);
    m->tip = malloc(nm * sizeof *m->tip);
    if (m->omega2 == NULL || m->tip == NULL) {
        return ST_NO_MEMORY;
    }
    m->damping = m->omega2 + nm;
    m->station_u = m->damping + nm;
    m->station_v = m->station_u + block;
    m->station_theta = m->station_v + block;
    for (int j = 0; j < m->n_mode; j++) {
        const double *shape = m->modes.shape + (size_t)j * (size_t)m->modes.n_dof;
        m->omega2[j] = num_sq(m->modes.omega[j]);
        m->damping[j] = 2.0 * m->def.solver.modal_damping * m->modes.omega[j];
        m->tip[j] = modes_tip(&m->beam, &m->modes, j);
        for (int i = 0; i < m->n_station; i++) {
            const struct beam_motion at =
                beam_motion_at(&m->beam, shape, (i + 0.5) * m->station_length);
            const ptrdiff_t k = num_at(i, j, m->n_station);
            m->station_u[k] = at.u;
            m->station_v[k] = at.v;
            m->station_theta[k] = at.theta;
        }
    }
    return ST_OK;
}

static enum status build_aero(struct model *m)
{
    const struct aero_def *a = &m->def.aero;
    const struct beam_def *b = &m->def.beam;
    m->dynamic_pressure = 0.5 * m->def.flow.density * num_sq(m->def.flow.speed);
    enum status st = polar_create(a->polar, &m->polar);
    if (st == ST_OK && a->dynamic == DYNAMIC_NETWORK) {
        st = network_create(a->network, &m->network);
    }
    if (st == ST_OK && a->lifting_line) {
        st = lifting_line_init(m->n_station, b->length, b->section.chord, a->walls, a->width,
                               a->tolerance, a->iterations_max, &m->lifting_line);
    }
    return st;
}

enum status model_build(const struct case_def *def, struct model *out, struct failure *fail)
{
    struct model m = {.def = *def};
    const char *part = "section", *pointer = "/beam/section";
    enum status st = build_section(&m);
    if (st == ST_OK && def->kind != CASE_SECTION) {
        part = "natural modes";
        pointer = "/beam";
        st = build_beam(&m);
    }
    if (st == ST_OK && def->kind == CASE_SIMULATION) {
        part = "transfer between modes and stations";
        st = build_transfer(&m);
    }
    if (st == ST_OK && def->kind == CASE_SIMULATION) {
        part = "aerodynamic model";
        pointer = "/aerodynamics";
        st = build_aero(&m);
    }
    if (st != ST_OK) {
        failure_set(fail, st, pointer, status_name(st), NULL, NULL, "the %s could not be built: %s",
                    part, status_text(st));
        model_done(&m);
        return st;
    }
    *out = m;
    return ST_OK;
}

void model_done(struct model *m)
{
    beam_done(&m->beam);
    modes_done(&m->modes);
    polar_destroy(m->polar);
    network_destroy(m->network);
    lifting_line_done(&m->lifting_line);
    free(m->omega2);
    free(m->tip);
    *m = (struct model){0};
}

#include "core/analysis/statics.h"

#include "core/num.h"

#include <assert.h>
#include <stdlib.h>
#include <string.h>

/* Adds force and moment at z to the resultant about the root's origin. Forces act on the axis. */
static void add_resultant(double z, const struct beam_load *load, double factor, double force[3],
                          double moment[3])
{
    const double arm[3] = {-z * load->force[1], z * load->force[0], 0.0}; /* z e_z x F */
    for (int d = 0; d < 3; d++) {
        force[d] += factor * load->force[d];
        moment[d] += factor * (load->moment[d] + arm[d]);
    }
}

/* Weight of the beam: f = m a on the freedoms. */
static void add_gravity(const struct model *m, double *f)
{
    for (int d = 0; d < 3; d++) {
        for (int i = 0; i < m->beam.n_dof; i++) {
            f[i] += m->def.beam.gravity[d] * m->beam.inertia[num_at(i, d, m->beam.n_dof)];
        }
    }
}

static void assemble_loads(const struct model *m, double *f, double force[3], double moment[3])
{
    const struct loads_def *l = &m->def.loads;
    for (int i = 0; i < l->n_point; i++) {
        beam_add_point_load(&m->beam, l->point[i].z, &l->point[i].load, f);
        add_resultant(l->point[i].z, &l->point[i].load, 1.0, force, moment);
    }
    for (int i = 0; i < l->n_line; i++) {
        const struct line_load_def *p = &l->line[i];
        beam_add_line_load(&m->beam, p->from, p->to, &p->load, f);
        add_resultant(0.5 * (p->from + p->to), &p->load, p->to - p->from, force, moment);
    }
}

/* Resultant of the weight: the consistent loads of all nodes, that of the root included. */
static void gravity_resultant(const struct model *m, double force[3], double moment[3])
{
    const struct beam *b = &m->beam;
    for (int node = 0; node <= b->mesh.n_element; node++) {
        for (int d = 0; d < 3; d++) {
            double part[BEAM_NODE_FREEDOMS];
            for (int k = 0; k < BEAM_NODE_FREEDOMS; k++) {
                const int row = beam_index(b, node, (enum beam_freedom)k);
                part[k] = m->def.beam.gravity[d] *
                          (node == 0 ? b->root_inertia[num_at(k, d, BEAM_NODE_FREEDOMS)]
                                     : b->inertia[num_at(row, d, b->n_dof)]);
            }
            const struct beam_load load = {.force = {part[D_U], part[D_V], part[D_W]},
                                           .moment = {-part[D_DV], part[D_DU], part[D_THETA]}};
            add_resultant(b->mesh.z[node], &load, 1.0, force, moment);
        }
    }
}

/* Resultant of the air's loads. */
static void air_resultant(const struct model *m, const struct aeroelastic_result *air,
                          double force[3], double moment[3])
{
    for (int i = 0; i < air->n_station; i++) {
        const struct beam_load load = aeroelastic_load(m, &air->station[i]);
        add_resultant(air->station[i].z, &load, m->station_length, force, moment);
    }
}

/* A polar without drag: what is left is the induced part, which is not the drag. */
static void forget_drag(struct aeroelastic_result *r)
{
    r->total.drag = r->total.cd = (double)NAN;
    for (int i = 0; i < r->n_station; i++) {
        r->station[i].cd = r->station[i].drag = (double)NAN;
    }
}

/* Deflection x under the loads f, and in a stream those of the air. */
static enum status deflect(const struct model *m, const double *f, double *x,
                           struct static_result *r)
{
    if (case_def_flows(&m->def)) {
        return aeroelastic_solve(m, f, x, &r->air);
    }
    const enum status st = static_solve(&m->beam, f, x);
    return st == ST_OK && !num_all_finite(m->beam.n_dof, x) ? ST_NOT_FINITE : st;
}

static enum status recover_stress(const struct model *m, const double *x, double z,
                                  struct stress_result *out)
{
    enum { STATES = LIMIT_LAYUPS * LIMIT_PLIES };
    struct section_def *section = malloc(sizeof *section);
    struct ply_state *ply = malloc(STATES * sizeof *ply);
    if (section == NULL || ply == NULL) {
        free(section);
        free(ply);
        return ST_NO_MEMORY;
    }
    out->z = z;
    beam_strain_at(&m->beam, x, z, out->strain);
    beam_def_section_at(&m->def.beam, z, section);
    const enum status st =
        static_ply_states(&section->shape, m->beam.shear, out->strain, ply, &out->n_ply);
    free(section);
    out->ply = ply; /* freed with the result, also after a failure */
    return st;
}

static void find_critical(struct static_result *r)
{
    r->reserve_min = (double)NAN;
    r->critical_position = r->critical_ply = -1;
    for (int i = 0; i < r->n_stress; i++) {
        for (int k = 0; k < r->stress[i].n_ply; k++) {
            const double reserve = r->stress[i].ply[k].reserve;
            if (!isnan(reserve) && !(reserve >= r->reserve_min)) {
                r->reserve_min = reserve;
                r->critical_position = i;
                r->critical_ply = k;
            }
        }
    }
}

enum status statics_run(const struct model *m, struct static_result *out)
{
    const struct beam *b = &m->beam;
    assert(b->n_dof > 0);
    struct static_result r = {.n_stress = 0};
    double force[3] = {0}, moment[3] = {0};
    double *f = calloc(2 * (size_t)b->n_dof, sizeof *f);
    if (f == NULL) {
        return ST_NO_MEMORY;
    }
    double *x = f + b->n_dof;
    assemble_loads(m, f, force, moment);
    add_gravity(m, f);
    gravity_resultant(m, force, moment);
    enum status st = deflect(m, f, x, &r);
    if (st != ST_OK) {
        goto out;
    }
    const bool at_rest = num_all_finite(b->n_dof, x); /* NaN where there is no equilibrium */
    air_resultant(m, &r.air, force, moment);
    if (case_def_flows(&m->def) && !polar_def_has_drag(m->def.aero.polar)) {
        forget_drag(&r.air);
    }
    r.tip = model_motion_at(m, x, b->length);
    for (int i = 0; i < STATIC_SAMPLES; i++) {
        const double z = b->length * i / (STATIC_SAMPLES - 1);
        r.span[i] = (struct static_sample){.z = z, .motion = model_motion_at(m, x, z)};
    }
    for (int d = 0; d < 3; d++) {
        r.reaction_force[d] = at_rest ? -force[d] : (double)NAN;
        r.reaction_moment[d] = at_rest ? -moment[d] : (double)NAN;
    }
    for (int i = 0; i < m->def.output.n_stress && at_rest && st == ST_OK; i++) {
        st = recover_stress(m, x, m->def.output.stress[i], &r.stress[i]);
        r.n_stress++;
    }
    find_critical(&r);
out:
    free(f);
    if (st != ST_OK) {
        statics_done(&r);
        return st;
    }
    *out = r;
    return ST_OK;
}

void statics_done(struct static_result *r)
{
    for (int i = 0; i < r->n_stress; i++) {
        free(r->stress[i].ply);
    }
    aeroelastic_done(&r->air);
    *r = (struct static_result){.n_stress = 0};
}

/* The section of a run as JSON. */
#include "api/result_parts.h"
#include "core/num.h"

static void write_matrix(struct json_out *out, const char *key, int n, const double *a)
{
    json_key(out, key);
    json_array_begin(out);
    for (int i = 0; i < n; i++) {
        json_array_begin(out);
        for (int j = 0; j < n; j++) {
            json_number(out, a[i + j * n]);
        }
        json_array_end(out);
    }
    json_array_end(out);
}

static void write_names(struct json_out *out, const char *key, int n, const char *const *names)
{
    json_key(out, key);
    json_array_begin(out);
    for (int i = 0; i < n; i++) {
        json_string(out, names[i]);
    }
    json_array_end(out);
}

void result_matrix_members(struct json_out *out, const struct section_result *s)
{
    /* The condensed stiffness has the first five. */
    static const char *const strains[SECTION_STRAINS] = {"w'",      "psi'",     "phi'",    "theta'",
                                                         "theta''", "gamma_xz", "gamma_yz"};
    static const char *const motions[SECTION_MASS] = {"u", "v", "w", "v'", "u'", "theta", "theta'"};
    write_matrix(out, "stiffness", SECTION_STRAINS, s->stiffness);
    write_matrix(out, "stiffness_condensed", SECTION_CLASSICAL, s->stiffness_condensed);
    write_matrix(out, "mass", SECTION_MASS, s->mass);
    write_names(out, "order", SECTION_STRAINS, strains);
    write_names(out, "mass_order", SECTION_MASS, motions);
    json_key_string(
        out, "reference_axis",
        "the z axis of the case: the origin of x (towards the leading edge) and y (up); "
        "mid-chord of a strip and centre of a box, the elastic axis of properties");
}

static void write_point(struct json_out *out, const char *key, double x, double y)
{
    json_key(out, key);
    json_object_begin(out);
    json_key_number(out, "x_m", x);
    json_key_number(out, "y_m", y);
    json_object_end(out);
}

static void write_centres(struct json_out *out, const struct centres *c)
{
    write_point(out, "tension_centre", c->tension_x, c->tension_y);
    write_point(out, "shear_centre", c->shear_x, c->shear_y);
    write_point(out, "mass_centre", c->mass_x, c->mass_y);
    json_key(out, "principal");
    json_object_begin(out);
    json_key_number(out, "angle_deg", num_deg(c->principal_angle));
    json_key_number(out, "ei_major_n_m2", c->ei_major);
    json_key_number(out, "ei_minor_n_m2", c->ei_minor);
    json_object_end(out);
    json_key_number(out, "ea_n", c->ea);
    json_key_number(out, "gj_shear_centre_n_m2", c->gj);
    json_key_number(out, "ei_warping_n_m4", c->ei_warping);
    json_key_number(out, "inertia_polar_kg_m", c->inertia_polar);
    json_key(out, "couplings");
    json_object_begin(out);
    json_key_number(out, "extension_twist_n_m", c->extension_twist);
    json_key_number(out, "flap_twist_n_m2", c->flap_twist);
    json_key_number(out, "lag_twist_n_m2", c->lag_twist);
    json_key_number(out, "flap_lag_n_m2", c->flap_lag);
    json_key_number(out, "extension_shear_x_n", c->extension_shear_x);
    json_key_number(out, "extension_shear_y_n", c->extension_shear_y);
    json_object_end(out);
}

void result_section_members(struct json_out *out, const struct section_result *s)
{
    json_key_number(out, "mass_kg_m", s->mass_per_length);
    json_key_number(out, "thickness_m", s->thickness);
    json_key_integer(out, "cells", s->cells);
    json_key_number(out, "ei_flap_n_m2", s->ei_flap);
    json_key_number(out, "ei_lag_n_m2", s->ei_lag);
    json_key_number(out, "gj_n_m2", s->gj);
    json_key_number(out, "bend_twist_n_m2", s->bend_twist);
    json_key_string(out, "wash", wash_name(s->wash));
    write_centres(out, &s->centres);
}

static void write_warping(struct json_out *out, const struct section_result *s)
{
    json_key(out, "warping");
    json_array_begin(out);
    for (int i = 0; i < s->n_warping; i++) {
        const struct warping_point *p = &s->warping[i];
        json_object_begin(out);
        json_key_integer(out, "wall", p->wall);
        json_key_number(out, "x_m", p->x);
        json_key_number(out, "y_m", p->y);
        json_key_number(out, "omega_m2", p->omega);
        json_object_end(out);
    }
    json_array_end(out);
}

void result_write_section(struct json_out *out, const struct result_view *v)
{
    json_object_begin(out);
    result_matrix_members(out, &v->r->section);
    result_section_members(out, &v->r->section);
    write_warping(out, &v->r->section);
    json_object_end(out);
}

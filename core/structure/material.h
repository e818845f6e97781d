/* core/structure/material.h
 * An orthotropic ply material in its own axes: l along the fibre, t across it.
 * Plain value type; nothing is owned. */
#ifndef AEROM_CORE_STRUCTURE_MATERIAL_H
#define AEROM_CORE_STRUCTURE_MATERIAL_H

#include "core/limits.h"
#include "core/status.h"

struct material {
    char name[LIMIT_NAME];
    double e_l;     /* Young's modulus along the fibre            [Pa] */
    double e_t;     /* Young's modulus across the fibre           [Pa] */
    double g_lt;    /* shear modulus in the plane of the ply      [Pa] */
    double g_tt;    /* shear modulus across the fibre             [Pa] */
    double nu_lt;   /* Poisson's ratio, strain in t from stress in l   */
    double nu_tt;   /* Poisson's ratio across the fibre                */
    double density; /* [kg/m^3] */
    /* Strengths for the failure index, all positive, 0 = not known: along the fibre and across it
     * in tension and compression, shear in the plane. [Pa] */
    double x_tension, x_compression, y_tension, y_compression, s_shear;
};

/* Are all five strengths known? */
static inline int material_has_strength(const struct material *m)
{
    return m->x_tension > 0.0 && m->x_compression > 0.0 && m->y_tension > 0.0 &&
           m->y_compression > 0.0 && m->s_shear > 0.0;
}

/* Appends what makes the material inadmissible (moduli and density positive; 1 - nu_lt nu_tl > 0;
 * |nu_tt| < 1; some strengths but not all). `pointer` is the JSON pointer of the material. Field
 * names below it are those of the contract. */
void material_check(const struct material *m, const char *pointer, struct failure_list *out);

#endif

#include "core/structure/material.h"

#include <math.h>
#include <stddef.h>
#include <stdio.h>

static void require_positive(double value, const char *pointer, const char *field,
                             struct failure_list *out)
{
    if (isfinite(value) && value > 0.0) {
        return;
    }
    char where[160];
    char got[96];
    (void)snprintf(where, sizeof where, "%s/%s", pointer, field);
    (void)snprintf(got, sizeof got, "%g", value);
    failure_set(failure_add(out), ST_INVALID, where, "out_of_range", "a finite number > 0", got,
                "%s of a material must be positive", field);
}

/* All five strengths or none: the failure index needs each. */
static void check_strengths(const struct material *m, const char *pointer, struct failure_list *out)
{
    const struct {
        const char *field;
        double value;
    } strength[] = {{"x_tension_pa", m->x_tension},
                    {"x_compression_pa", m->x_compression},
                    {"y_tension_pa", m->y_tension},
                    {"y_compression_pa", m->y_compression},
                    {"s_shear_pa", m->s_shear}};
    enum { STRENGTHS = sizeof strength / sizeof strength[0] };
    int given = 0;
    for (int i = 0; i < STRENGTHS; i++) {
        given += strength[i].value != 0.0;
    }
    for (int i = 0; i < STRENGTHS && given > 0; i++) {
        require_positive(strength[i].value, pointer, strength[i].field, out);
    }
}

void material_check(const struct material *m, const char *pointer, struct failure_list *out)
{
    require_positive(m->e_l, pointer, "e_l_pa", out);
    require_positive(m->e_t, pointer, "e_t_pa", out);
    require_positive(m->g_lt, pointer, "g_lt_pa", out);
    require_positive(m->g_tt, pointer, "g_tt_pa", out);
    require_positive(m->density, pointer, "density_kg_m3", out);

    check_strengths(m, pointer, out);

    char where[160];
    char got[96];
    /* Positive strain energy in the plane: 1 - nu_lt nu_tl > 0 with nu_tl = nu_lt E_t/E_l. */
    if (!(m->nu_lt * m->nu_lt * m->e_t < m->e_l)) {
        (void)snprintf(where, sizeof where, "%s/nu_lt", pointer);
        (void)snprintf(got, sizeof got, "%g", m->nu_lt);
        failure_set(failure_add(out), ST_INVALID, where, "inadmissible_poisson",
                    "|nu_lt| < sqrt(e_l_pa/e_t_pa)", got,
                    "the strain energy would not be positive");
    }
    if (!(fabs(m->nu_tt) < 1.0)) {
        (void)snprintf(where, sizeof where, "%s/nu_tt", pointer);
        (void)snprintf(got, sizeof got, "%g", m->nu_tt);
        failure_set(failure_add(out), ST_INVALID, where, "inadmissible_poisson", "|nu_tt| < 1", got,
                    "the strain energy would not be positive");
    }
}

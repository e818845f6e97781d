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

void material_check(const struct material *m, const char *pointer, struct failure_list *out)
{
    require_positive(m->e_l, pointer, "e_l_pa", out);
    require_positive(m->e_t, pointer, "e_t_pa", out);
    require_positive(m->g_lt, pointer, "g_lt_pa", out);
    require_positive(m->g_tt, pointer, "g_tt_pa", out);
    require_positive(m->density, pointer, "density_kg_m3", out);

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

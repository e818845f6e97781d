#include "core/structure/warping.h"

#include "core/num.h"
#include "core/structure/camber.h"

#include <assert.h>
#include <stdbool.h>
#include <stdlib.h>
#include <string.h>

enum { N = SECTION_WARPED, WIDE = SECTION_WIDE_COUNT };

const double contour_gauss_point[CONTOUR_GAUSS] = {-0.774596669241483377, 0.0,
                                                   0.774596669241483377};
const double contour_gauss_weight[CONTOUR_GAUSS] = {5.0 / 9.0, 8.0 / 9.0, 5.0 / 9.0};

struct warping_basis warping_basis_at(const struct warping *w, const struct contour_element *el,
                                      const struct contour_point *p)
{
    struct warping_basis b;
    const bool flexible = w->n_value > w->n_node;
    b.n = flexible ? (int)WARPING_LOCAL : 3;
    memset(b.g, 0, (size_t)b.n * sizeof *b.g);
    memset(b.g_slope, 0, (size_t)b.n * sizeof *b.g_slope);
    memset(b.turn, 0, (size_t)b.n * sizeof *b.turn);
    memset(b.turn_slope, 0, (size_t)b.n * sizeof *b.turn_slope);
    for (int a = 0; a < 3; a++) {
        b.value[a] = el->node[a];
        b.g[a] = p->shape[a];
        b.g_slope[a] = p->slope[a];
    }
    if (!flexible) {
        return b;
    }
    for (int a = 0; a < 3; a++) {
        b.value[3 + a] = w->n_node + el->node[a];
        b.turn[3 + a] = p->shape[a];
        b.turn_slope[3 + a] = p->slope[a];
    }
    b.value[6] = 2 * w->n_node;
    b.turn[6] = -p->dy;
    b.value[7] = 2 * w->n_node + 1;
    b.turn[7] = p->dx;
    b.n = WARPING_LOCAL;
    return b;
}

static struct warping_field field_of(const struct warping *w, const struct warping_basis *b, int k)
{
    const double *value = w->g + num_at(0, k, w->n_value);
    struct warping_field f = {0};
    for (int a = 0; a < b->n; a++) {
        const double z = value[b->value[a]];
        f.g += b->g[a] * z;
        f.g_slope += b->g_slope[a] * z;
        f.turn += b->turn[a] * z;
        f.turn_slope += b->turn_slope[a] * z;
    }
    return f;
}

struct warping_field warping_field_at(const struct warping *w, const struct contour_element *el,
                                      const struct contour_point *p, int k)
{
    const struct warping_basis b = warping_basis_at(w, el, p);
    return field_of(w, &b, k);
}

double warping_at(const struct warping *w, const struct contour_element *el,
                  const struct contour_point *p, int k)
{
    return warping_field_at(w, el, p, k).g;
}

/* The normal turns with the wall: r_t theta' less the shear gamma_nz of Eq. (A.7). */
static double across_of(const struct warping *w, const struct contour_point *p, double turn)
{
    return p->r_t - w->twist_shear[0] * p->dy + w->twist_shear[1] * p->dx + turn;
}

double warping_across(const struct warping *w, const struct contour_element *el,
                      const struct contour_point *p)
{
    return across_of(w, p, warping_field_at(w, el, p, WARPING_VLASOV).turn);
}

double warping_bare_normal_shear(const struct contour_point *p, int k)
{
    return k == S_GXZ ? p->dy : (k == S_GYZ ? -p->dx : 0.0);
}

double warping_normal_shear(const struct warping *w, const struct contour_element *el,
                            const struct contour_point *p, int k)
{
    const bool flexible = w->n_value > w->n_node;
    return flexible ? warping_bare_normal_shear(p, k) + warping_field_at(w, el, p, k).turn : 0.0;
}

double warping_flow(const double *reduced, int row, const double e[WALL_STRAINS])
{
    double sum = 0.0;
    for (int j = 0; j < WALL_STRAINS; j++) {
        sum += reduced[row + WALL_STRAINS * j] * e[j];
    }
    return sum;
}

int warping_strain_count(const struct warping *w)
{
    return w->camber.on ? (int)SECTION_WARPED : (int)S_CAMBER_RATE;
}

void warping_bare_strain(const struct warping *w, const struct contour_point *p, int k,
                         double stretched, double across, double e[WALL_STRAINS])
{
    if (k == S_CAMBER_RATE) {
        camber_rate_strain(&w->camber, p, e);
        return;
    }
    memset(e, 0, WALL_STRAINS * sizeof *e);
    switch ((enum section_strain)k) {
    case S_W:
        e[W_EPS] = 1.0;
        break;
    case S_PSI:
        e[W_EPS] = -p->x;
        e[W_KAPPA] = -p->dy;
        break;
    case S_PHI:
        e[W_EPS] = p->y;
        e[W_KAPPA] = -p->dx;
        break;
    case S_THETA:
        e[W_GAMMA] = p->r_n;
        e[W_TWIST] = 2.0;
        break;
    case S_THETA2:
        e[W_EPS] = stretched;
        e[W_KAPPA] = across;
        break;
    case S_GXZ:
        e[W_GAMMA] = p->dx;
        break;
    case S_GYZ:
        e[W_GAMMA] = p->dy;
        break;
    case SECTION_STRAIN_COUNT:
        assert(false);
    }
}

void warping_strains(const struct warping *w, const struct contour_element *el,
                     const struct contour_point *p, double *e)
{
    const struct warping_basis b = warping_basis_at(w, el, p);
    const struct warping_field vlasov = field_of(w, &b, WARPING_VLASOV);
    memset(e + WALL_STRAINS * (ptrdiff_t)S_CAMBER_RATE, 0, WALL_STRAINS * sizeof *e);
    for (int k = 0; k < warping_strain_count(w); k++) {
        const struct warping_field f = field_of(w, &b, k);
        warping_bare_strain(w, p, k, vlasov.g, across_of(w, p, vlasov.turn),
                            e + WALL_STRAINS * (ptrdiff_t)k);
        e[W_GAMMA + WALL_STRAINS * k] += f.g_slope;
        e[W_TWIST + WALL_STRAINS * k] += f.turn_slope;
    }
}

/* Strains of an amplitude of the warping f by itself, and of its rate along the span. */
static void put_amplitude(const struct warping_field *f, int value, int rate, double *e,
                          double *normal)
{
    e[W_GAMMA + WALL_STRAINS * value] = f->g_slope;
    e[W_TWIST + WALL_STRAINS * value] = f->turn_slope;
    normal[value] = f->turn;
    e[W_EPS + WALL_STRAINS * rate] = f->g;
    e[W_KAPPA + WALL_STRAINS * rate] = f->turn;
}

/* Column k less `share` of column `amplitude`, which carries that part. */
static void hand_on(int k, double share, int amplitude, double *e, double *normal)
{
    for (int r = 0; r < WALL_STRAINS; r++) {
        e[r + WALL_STRAINS * k] -= share * e[r + WALL_STRAINS * amplitude];
    }
    normal[k] -= share * normal[amplitude];
}

bool warping_has_lag(const struct warping *w)
{
    return w->lag[S_PSI] != 0.0 || w->lag[S_PHI] != 0.0;
}

void warping_wide_strains(const struct warping *w, const struct contour_element *el,
                          const struct contour_point *p, double *e, double *normal)
{
    const struct warping_field f = warping_field_at(w, el, p, WARPING_VLASOV);
    warping_strains(w, el, p, e);
    for (int k = 0; k < N; k++) {
        normal[k] = warping_normal_shear(w, el, p, k);
    }
    memset(e + WALL_STRAINS * (ptrdiff_t)N, 0, (WIDE - N) * WALL_STRAINS * sizeof *e);
    memset(normal + N, 0, (WIDE - N) * sizeof *normal);
    /* The wall turns as a whole: gamma_sz = r_n + n, gamma_nz = -r_t. */
    e[W_GAMMA + WALL_STRAINS * S_ETA] = p->r_n;
    e[W_TWIST + WALL_STRAINS * S_ETA] = 1.0;
    normal[S_ETA] = -p->r_t;
    put_amplitude(&f, S_SURPLUS, S_SURPLUS_RATE, e, normal);
    for (int k = S_W; k <= S_PHI; k++) {
        hand_on(k, w->follow[k], S_SURPLUS, e, normal);
    }
    if (w->camber.on) {
        camber_turn_rate_strain(&w->camber, e + WALL_STRAINS * (ptrdiff_t)S_TURN_RATE);
    }
    if (warping_has_lag(w)) {
        const struct warping_field lag = warping_field_at(w, el, p, WARPING_LAG);
        put_amplitude(&lag, S_LAG, S_LAG_RATE, e, normal);
        for (int k = 0; k < SECTION_STRAIN_COUNT; k++) {
            hand_on(k, w->lag[k], S_LAG, e, normal);
        }
    }
}

void warping_unit_strains(const struct warping *w, const struct contour_element *el,
                          const struct contour_point *p, int n_strain, double *e, double *normal)
{
    if (n_strain > N) {
        warping_wide_strains(w, el, p, e, normal);
        return;
    }
    warping_strains(w, el, p, e);
    for (int k = 0; k < N; k++) {
        normal[k] = warping_normal_shear(w, el, p, k);
    }
}

void warping_stiffness(const struct contour *c, const struct laminate *laminate,
                       const struct warping *w, int n_strain, double *out)
{
    for (int a = 0; a < n_strain; a++) {
        for (int b = 0; b < n_strain; b++) {
            out[num_at(a, b, n_strain)] = a < N && b < N ? w->wall_shear[num_at(a, b, N)] : 0.0;
        }
    }
    for (int i = 0; i < c->n_element * CONTOUR_GAUSS; i++) {
        const struct contour_element *el = &c->element[i / CONTOUR_GAUSS];
        const struct laminate *l = &laminate[el->laminate];
        const struct contour_point p = contour_at(el, contour_gauss_point[i % CONTOUR_GAUSS]);
        const double weight = contour_gauss_weight[i % CONTOUR_GAUSS] * p.jacobian;
        double e[WALL_STRAINS * WIDE], stress[WALL_STRAINS * WIDE], normal[WIDE];
        warping_unit_strains(w, el, &p, n_strain, e, normal);
        for (int k = 0; k < n_strain; k++) {
            for (int r = 0; r < WALL_STRAINS; r++) {
                stress[num_at(r, k, WALL_STRAINS)] =
                    warping_flow(l->reduced, r, e + num_at(0, k, WALL_STRAINS));
            }
        }
        for (int b = 0; b < n_strain; b++) {
            for (int a = 0; a <= b; a++) {
                double sum = l->shear_zn * normal[a] * normal[b];
                for (int r = 0; r < WALL_STRAINS; r++) {
                    sum += e[num_at(r, a, WALL_STRAINS)] * stress[num_at(r, b, WALL_STRAINS)];
                }
                out[num_at(a, b, n_strain)] += weight * sum;
            }
        }
    }
    for (int b = 0; b < n_strain; b++) {
        for (int a = 0; a < b; a++) {
            out[num_at(b, a, n_strain)] = out[num_at(a, b, n_strain)];
        }
    }
}

void warping_done(struct warping *w)
{
    free(w->g);
    *w = (struct warping){0};
}

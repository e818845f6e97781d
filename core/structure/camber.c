#include "core/structure/camber.h"

#include "core/num.h"

#include <math.h>
#include <string.h>

struct camber_line camber_line_of(const struct laminate *lam, double x0, double y0, double x1,
                                  double y1)
{
    const double b = hypot(x1 - x0, y1 - y0), axis = lam->b[4] / lam->a[4];
    return (struct camber_line){.on = true,
                                .x = 0.5 * (x0 + x1),
                                .y = 0.5 * (y0 + y1),
                                .dx = (x1 - x0) / b,
                                .dy = (y1 - y0) / b,
                                .width = b,
                                .axis = axis,
                                .stiffness = b * (lam->d[4] - axis * lam->b[4]),
                                .shear = b * lam->shear_sn};
}

static double from_middle(const struct camber_line *line, const struct contour_point *p)
{
    return (p->x - line->x) * p->dx + (p->y - line->y) * p->dy;
}

void camber_rate_strain(const struct camber_line *line, const struct contour_point *p,
                        double e[WALL_STRAINS])
{
    const double s = from_middle(line, p);
    memset(e, 0, WALL_STRAINS * sizeof *e);
    e[W_GAMMA] = -line->axis * s;
    e[W_TWIST] = 2.0 * s;
}

void camber_turn_rate_strain(const struct camber_line *line, double e[WALL_STRAINS])
{
    memset(e, 0, WALL_STRAINS * sizeof *e);
    e[W_GAMMA] = -line->axis;
    e[W_TWIST] = 1.0;
}

void camber_motion(const struct camber_line *line, const struct contour_point *p,
                   struct camber_motion *out)
{
    const double s = from_middle(line, p);
    const double w = -0.5 * (s * s - line->width * line->width / 12.0);
    *out = (struct camber_motion){
        .bend = {w * p->dy - line->axis * s * p->dx, -w * p->dx - line->axis * s * p->dy},
        .bend_slope = {s * p->dx, s * p->dy},
        .turn = {-line->axis * p->dx, -line->axis * p->dy},
        .turn_slope = {p->dx, p->dy}};
}

void camber_natural(const struct contour *c, const struct laminate *lam, const struct warping *w,
                    int n_strain, double natural[SECTION_WIDE_COUNT])
{
    memset(natural, 0, SECTION_WIDE_COUNT * sizeof *natural);
    for (int i = 0; i < c->n_element * CONTOUR_GAUSS; i++) {
        const struct contour_element *el = &c->element[i / CONTOUR_GAUSS];
        const struct contour_point p = contour_at(el, contour_gauss_point[i % CONTOUR_GAUSS]);
        const double weight =
            contour_gauss_weight[i % CONTOUR_GAUSS] * p.jacobian / c->camber.width;
        double e[WALL_STRAINS * SECTION_WIDE_COUNT], normal[SECTION_WIDE_COUNT];
        warping_unit_strains(w, el, &p, n_strain, e, normal);
        for (int k = 0; k < n_strain; k++) {
            natural[k] += weight * laminate_cross_strain(&lam[el->laminate], CHORDWISE_CLAMPED,
                                                         e + num_at(0, k, WALL_STRAINS))
                                       .kappa_ss;
        }
    }
}

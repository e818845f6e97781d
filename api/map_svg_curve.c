#include "api/map_svg_parts.h"

#include <math.h>

/* Strokes twice, light below dark, to be seen on every colour. */
static const char halo[] =
    "fill=\"none\" stroke=\"#fff\" stroke-width=\"4.5\" stroke-linecap=\"round\" "
    "stroke-linejoin=\"round\"";
static const char line[] =
    "fill=\"none\" stroke=\"#111\" stroke-width=\"2\" stroke-linecap=\"round\" "
    "stroke-linejoin=\"round\"";

struct corner {
    double x, y, value; /* above the level */
};

/* Corners of a square between four cells, anticlockwise; false where one has no value. */
static bool square_at(const struct map_plot *plot, const struct svg_scale *x,
                      const struct svg_scale *y, int i, int k, struct corner c[4])
{
    static const int right[] = {0, 1, 1, 0}, up[] = {0, 0, 1, 1};
    for (int j = 0; j < 4; j++) {
        const int a = i + right[j], b = k + up[j];
        const int cell = svg_cell(plot, x->order[a], y->order[b]);
        c[j] = (struct corner){x->centre[a], y->centre[b], plot->map->value[cell] - plot->level};
        if (!isfinite(c[j].value)) {
            return false;
        }
    }
    return true;
}

/* Where the level crosses the sides of a square, in order round it: none, two or four points, which
 * are joined in pairs. */
static void write_square(struct json_out *out, const struct corner c[4])
{
    double x[4], y[4];
    int n = 0;
    for (int j = 0; j < 4; j++) {
        const struct corner a = c[j], b = c[(j + 1) % 4];
        if ((a.value < 0.0) == (b.value < 0.0)) {
            continue;
        }
        const double share = a.value / (a.value - b.value);
        x[n] = a.x + share * (b.x - a.x);
        y[n] = a.y + share * (b.y - a.y);
        n++;
    }
    for (int j = 0; j + 1 < n; j += 2) {
        svg_put(out, "M%.1f %.1fL%.1f %.1f", x[j], y[j], x[j + 1], y[j + 1]);
    }
}

static void write_contour(struct json_out *out, const struct map_plot *plot,
                          const struct svg_scale *x, const struct svg_scale *y)
{
    struct corner c[4];
    for (int k = 0; k + 1 < y->n; k++) {
        for (int i = 0; i + 1 < x->n; i++) {
            if (square_at(plot, x, y, i, k, c)) {
                write_square(out, c);
            }
        }
    }
}

void svg_contour(struct json_out *out, const struct map_plot *plot, const struct svg_scale *x,
                 const struct svg_scale *y)
{
    json_out_text(out, "<g class=\"contour\"><path d=\"");
    write_contour(out, plot, x, y);
    svg_put(out, "\" %s/><path d=\"", halo);
    write_contour(out, plot, x, y);
    svg_put(out, "\" %s/></g>\n", line);
}

static bool is_inside(const struct svg_scale *s, double value)
{
    return isfinite(value) && value >= s->low && value <= s->high;
}

static void write_curve(struct json_out *out, const struct map_curve *c, const struct svg_scale *x,
                        const struct svg_scale *y)
{
    bool joined = false;
    for (int i = 0; i < c->n; i++) {
        const bool inside = is_inside(x, c->x[i]) && is_inside(y, c->y[i]);
        if (inside) {
            svg_put(out, "%c%.1f %.1f", joined ? 'L' : 'M', svg_pixel(x, c->x[i]),
                    svg_pixel(y, c->y[i]));
        }
        joined = inside;
    }
}

static void write_points(struct json_out *out, const struct map_curve *c, const struct svg_scale *x,
                         const struct svg_scale *y)
{
    for (int i = 0; i < c->n; i++) {
        if (is_inside(x, c->x[i]) && is_inside(y, c->y[i])) {
            svg_put(out,
                    "<circle cx=\"%.1f\" cy=\"%.1f\" r=\"3\" fill=\"#111\" stroke=\"#fff\"/>\n",
                    svg_pixel(x, c->x[i]), svg_pixel(y, c->y[i]));
        }
    }
}

void svg_curves(struct json_out *out, const struct map_plot *plot, const struct svg_scale *x,
                const struct svg_scale *y)
{
    for (int i = 0; i < plot->n_curve; i++) {
        const struct map_curve *c = &plot->curve[i];
        const char *const dash = i % 2 == 0 ? "" : " stroke-dasharray=\"7 6\"";
        json_out_text(out, "<g><title>");
        svg_text(out, c->name);
        json_out_text(out, "</title><path d=\"");
        write_curve(out, c, x, y);
        svg_put(out, "\" %s/><path d=\"", halo);
        write_curve(out, c, x, y);
        svg_put(out, "\" %s%s/>\n", line, dash);
        write_points(out, c, x, y);
        json_out_text(out, "</g>\n");
    }
}

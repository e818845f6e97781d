#include "api/map_svg_parts.h"

#include <math.h>

/* The numbers along the line, with a little room; classes stand on lines of their own. */
struct band {
    double low, high;
};

static struct band band_of(const struct map_plot *plot, int n)
{
    const struct study_map *m = plot->map;
    struct band b = {(double)INFINITY, -(double)INFINITY};
    if (m->n_class > 0) {
        return (struct band){-0.5, m->n_class - 0.5};
    }
    for (int i = 0; i < n; i++) {
        const double value = m->value[svg_cell(plot, i, 0)];
        if (isfinite(value)) {
            b.low = fmin(b.low, value);
            b.high = fmax(b.high, value);
        }
    }
    if (isfinite(plot->level) && b.low <= b.high) {
        b.low = fmin(b.low, plot->level);
        b.high = fmax(b.high, plot->level);
    }
    if (!(b.low <= b.high)) {
        return (struct band){0.0, 1.0};
    }
    const double room = b.high > b.low ? 0.06 * (b.high - b.low) : 0.5;
    return (struct band){b.low - room, b.high + room};
}

static double pixel_y(const struct band *b, double value)
{
    return SVG_BOTTOM - (value - b->low) / (b->high - b->low) * (SVG_BOTTOM - SVG_TOP);
}

static void write_line(struct json_out *out, const struct map_plot *plot, const struct svg_scale *x,
                       const struct band *b)
{
    bool joined = false;
    json_out_text(out, "<path class=\"line\" d=\"");
    for (int k = 0; k < x->n; k++) {
        const double value = plot->map->value[svg_cell(plot, x->order[k], 0)];
        if (isfinite(value)) {
            svg_put(out, "%c%.1f %.1f", joined ? 'L' : 'M', x->centre[k], pixel_y(b, value));
        }
        joined = isfinite(value);
    }
    json_out_text(out, "\" fill=\"none\" stroke=\"#2166ac\" stroke-width=\"2\"/>\n");
}

/* A dot for each value, a cross on the axis where a cell failed. */
static void write_marks(struct json_out *out, const struct map_plot *plot,
                        const struct svg_scale *x, const struct band *b)
{
    for (int k = 0; k < x->n; k++) {
        const int cell = svg_cell(plot, x->order[k], 0);
        const double value = plot->map->value[cell];
        if (isfinite(value)) {
            svg_put(out, "<circle cx=\"%.1f\" cy=\"%.1f\" r=\"2.5\" fill=\"#2166ac\"/>\n",
                    x->centre[k], pixel_y(b, value));
        } else if (plot->map->status[cell] == STUDY_CELL_FAILED) {
            svg_put(out,
                    "<path d=\"M%.1f %dl8 -8m0 8l-8 -8\" stroke=\"#b2182b\" "
                    "stroke-width=\"1.5\"/>\n",
                    x->centre[k] - 4.0, SVG_BOTTOM - 3);
        }
    }
}

/* Names of the classes on the right, a line each. */
static void write_classes(struct json_out *out, const struct study_map *m, const struct band *b)
{
    for (int i = 0; i < m->n_class; i++) {
        svg_put(out, "<path d=\"M%d %.1fH%d\" stroke=\"#ddd\"/><text x=\"%d\" y=\"%.1f\">",
                SVG_LEFT, pixel_y(b, i), SVG_RIGHT, SVG_RIGHT + 8, pixel_y(b, i) + 4.5);
        svg_text(out, m->class_name[i]);
        json_out_text(out, "</text>\n");
    }
}

void svg_lines(struct json_out *out, const struct map_plot *plot)
{
    const struct study_map *m = plot->map;
    const struct band b = band_of(plot, m->axis[plot->x].n);
    struct svg_scale x;
    char title[MAP_TITLE_SIZE];
    if (!svg_scale_init(&m->axis[plot->x], false, SVG_LEFT, SVG_RIGHT, &x)) {
        out->failed = true;
        return;
    }
    map_title(m->value_name, title);
    svg_title_y(out, title);
    if (m->n_class > 0) {
        write_classes(out, m, &b);
    } else {
        svg_ticks_y(out, b.low, b.high);
        if (isfinite(plot->level)) {
            svg_put(out, "<path d=\"M%d %.1fH%d\" stroke=\"#111\" stroke-dasharray=\"5 4\"/>\n",
                    SVG_LEFT, pixel_y(&b, plot->level), SVG_RIGHT);
        }
        write_line(out, plot, &x, &b);
    }
    write_marks(out, plot, &x, &b);
    svg_frame(out);
    svg_axis_x(out, &x);
    svg_scale_done(&x);
}

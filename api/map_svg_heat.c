#include "api/map_svg_parts.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

/* What a cell is filled with: a shade or class from 0, or one of these. */
enum { FILL_PENDING = -1, FILL_FAILED = -2, FILL_MISSING = -3 };

/* Range of the numbers and how they are coloured. */
struct palette {
    double low, high;
    bool both_signs; /* then symmetrical about zero */
    bool classes;
};

static struct palette palette_of(const struct study_map *m)
{
    struct palette p = {
        .low = (double)INFINITY, .high = -(double)INFINITY, .classes = m->n_class > 0};
    for (int i = 0; i < m->n_cell; i++) {
        if (isfinite(m->value[i])) {
            p.low = fmin(p.low, m->value[i]);
            p.high = fmax(p.high, m->value[i]);
        }
    }
    if (!(p.low <= p.high)) {
        p.low = p.high = 0.0;
    }
    p.both_signs = p.low < 0.0 && p.high > 0.0;
    if (p.both_signs) {
        p.high = fmax(p.high, -p.low);
        p.low = -p.high;
    } else if (!(p.high > p.low)) {
        p.low -= 0.5;
        p.high += 0.5;
    }
    return p;
}

static int fill_of(const struct study_map *m, const struct palette *p, int cell)
{
    const double value = m->value[cell];
    if (m->status[cell] != STUDY_CELL_DONE) {
        return m->status[cell] == STUDY_CELL_FAILED ? FILL_FAILED : FILL_PENDING;
    }
    if (!isfinite(value)) {
        return FILL_MISSING;
    }
    if (p->classes) {
        return (int)value;
    }
    const int shade = (int)((value - p->low) / (p->high - p->low) * SVG_COLOURS);
    return shade < SVG_COLOURS ? shade : SVG_COLOURS - 1;
}

static void fill_text(const struct palette *p, int fill, char out[24])
{
    if (fill < 0) {
        (void)snprintf(out, 24, "%s",
                       fill == FILL_FAILED    ? "url(#failed)"
                       : fill == FILL_PENDING ? "url(#pending)"
                                              : "#fff");
    } else if (p->classes) {
        (void)snprintf(out, 24, "url(#class%d)", fill);
    } else {
        svg_colour(fill, p->both_signs, out);
    }
}

static void write_patterns(struct json_out *out, const struct study_map *m)
{
    json_out_text(
        out, "<defs>\n"
             "<pattern id=\"pending\" width=\"6\" height=\"6\" patternUnits=\"userSpaceOnUse\">"
             "<rect width=\"6\" height=\"6\" fill=\"#f4f4f4\"/><path d=\"M0 6L6 0\" "
             "stroke=\"#ccc\" stroke-width=\"0.8\"/></pattern>\n"
             "<pattern id=\"failed\" width=\"6\" height=\"6\" patternUnits=\"userSpaceOnUse\">"
             "<rect width=\"6\" height=\"6\" fill=\"#555\"/><path d=\"M0 6L6 0M0 0L6 6\" "
             "stroke=\"#ddd\" stroke-width=\"0.8\"/></pattern>\n");
    svg_class_patterns(out, m->n_class);
    json_out_text(out, "</defs>\n");
}

/* Neighbours of one fill in a row are one rectangle; a little overlap hides seams. */
static void write_cells(struct json_out *out, const struct map_plot *plot, const struct palette *p,
                        const struct svg_scale *x, const struct svg_scale *y)
{
    const double overlap = 0.4;
    json_out_text(out, "<g class=\"cells\">\n");
    for (int k = 0; k < y->n; k++) {
        for (int i = 0; i < x->n;) {
            const int fill = fill_of(plot->map, p, svg_cell(plot, x->order[i], y->order[k]));
            int end = i + 1;
            while (end < x->n &&
                   fill_of(plot->map, p, svg_cell(plot, x->order[end], y->order[k])) == fill) {
                end++;
            }
            char colour[24];
            fill_text(p, fill, colour);
            const double right = end < x->n ? x->edge[end] + overlap : x->edge[end];
            const double top = k + 1 < y->n ? y->edge[k + 1] - overlap : y->edge[k + 1];
            svg_put(out,
                    "<rect x=\"%.2f\" y=\"%.2f\" width=\"%.2f\" height=\"%.2f\" fill=\"%s\"/>\n",
                    x->edge[i], top, right - x->edge[i], y->edge[k] - top, colour);
            i = end;
        }
    }
    json_out_text(out, "</g>\n");
}

static double bar_pixel(const struct palette *p, double value)
{
    return SVG_BOTTOM - (value - p->low) / (p->high - p->low) * (SVG_BOTTOM - SVG_TOP);
}

static void write_bar(struct json_out *out, const struct palette *p, const char *name)
{
    char colour[24], text[32], title[MAP_TITLE_SIZE];
    const double height = (double)(SVG_BOTTOM - SVG_TOP) / SVG_COLOURS;
    for (int i = 0; i < SVG_COLOURS; i++) {
        fill_text(p, i, colour);
        svg_put(out, "<rect x=\"%d\" y=\"%.2f\" width=\"%d\" height=\"%.2f\" fill=\"%s\"/>\n",
                SVG_BAR_LEFT, SVG_BOTTOM - (i + 1) * height, SVG_BAR_RIGHT - SVG_BAR_LEFT,
                height + (i > 0 ? 0.4 : 0.0), colour);
    }
    svg_put(out,
            "<rect x=\"%d\" y=\"%d\" width=\"%d\" height=\"%d\" fill=\"none\" "
            "stroke=\"#222\"/>\n",
            SVG_BAR_LEFT, SVG_TOP, SVG_BAR_RIGHT - SVG_BAR_LEFT, SVG_BOTTOM - SVG_TOP);
    const double step = svg_tick_step(p->high - p->low, 8);
    const int last = (int)floor(p->high / step + 1e-9);
    for (int i = (int)ceil(p->low / step - 1e-9); i <= last; i++) {
        svg_tick_text(i * step, step, text);
        svg_put(out,
                "<path d=\"M%d %.1fh5\" stroke=\"#222\"/><text x=\"%d\" y=\"%.1f\">%s</text>\n",
                SVG_BAR_RIGHT, bar_pixel(p, i * step), SVG_BAR_RIGHT + 8,
                bar_pixel(p, i * step) + 4.5, text);
    }
    map_title(name, title);
    svg_put(out,
            "<text transform=\"translate(%d %d) rotate(-90)\" text-anchor=\"middle\" "
            "font-size=\"14\">",
            SVG_WIDTH - 62, (SVG_TOP + SVG_BOTTOM) / 2);
    svg_text(out, title);
    json_out_text(out, "</text>\n");
}

static void legend_entry(struct json_out *out, int row, const char *fill, const char *text)
{
    svg_put(out,
            "<rect x=\"%d\" y=\"%d\" width=\"22\" height=\"16\" fill=\"%s\" "
            "stroke=\"#222\" stroke-width=\"0.6\"/><text x=\"%d\" y=\"%d\">",
            SVG_BAR_LEFT, SVG_TOP + 24 * row, fill, SVG_BAR_RIGHT + 8, SVG_TOP + 24 * row + 13);
    svg_text(out, text);
    json_out_text(out, "</text>\n");
}

/* The classes, and what the hatches of cells without a value mean. */
static void write_legend(struct json_out *out, const struct study_map *m)
{
    char fill[24];
    bool has[STUDY_CELL_FAILED + 1] = {false};
    enum { ROWS_MAX = (SVG_BOTTOM - SVG_TOP) / 24 - 2 };
    int row = 0;
    for (; row < m->n_class && row < ROWS_MAX; row++) {
        (void)snprintf(fill, sizeof fill, "url(#class%d)", row);
        legend_entry(out, row, fill, m->class_name[row]);
    }
    for (int i = 0; i < m->n_cell; i++) {
        has[m->status[i]] = true;
    }
    if (has[STUDY_CELL_FAILED]) {
        legend_entry(out, row++, "url(#failed)", "failed");
    }
    if (has[STUDY_CELL_PENDING]) {
        legend_entry(out, row, "url(#pending)", "not yet computed");
    }
}

void svg_heat(struct json_out *out, const struct map_plot *plot)
{
    const struct study_map *m = plot->map;
    const struct palette p = palette_of(m);
    struct svg_scale x, y;
    if (!svg_scale_init(&m->axis[plot->x], true, SVG_LEFT, SVG_RIGHT, &x)) {
        out->failed = true;
        return;
    }
    if (!svg_scale_init(&m->axis[plot->y], true, SVG_BOTTOM, SVG_TOP, &y)) {
        svg_scale_done(&x);
        out->failed = true;
        return;
    }
    write_patterns(out, m);
    write_cells(out, plot, &p, &x, &y);
    if (!p.classes && isfinite(plot->level)) {
        svg_contour(out, plot, &x, &y);
    }
    svg_curves(out, plot, &x, &y);
    svg_frame(out);
    svg_axis_x(out, &x);
    svg_axis_y(out, &y);
    if (p.classes) {
        write_legend(out, m);
    } else {
        write_bar(out, &p, m->value_name);
    }
    svg_scale_done(&x);
    svg_scale_done(&y);
}

#include "api/map_svg_parts.h"

#include <assert.h>
#include <math.h>
#include <stdio.h>
#include <string.h>

/* -- titles ----------------------------------------------------------------------------- */

void map_title(const char *name, char out[MAP_TITLE_SIZE])
{
    /* The longer ending first. */
    static const struct {
        const char *ending, *unit;
    } units[] = {{"_n_m2", "N m²"}, {"_kg_m3", "kg/m³"}, {"_kg_m2", "kg/m²"}, {"_m2_s", "m²/s"},
                 {"_kg_m", "kg/m"}, {"_n_m", "N m"},     {"_m_s", "m/s"},     {"_deg", "deg"},
                 {"_rad", "rad"},   {"_hz", "Hz"},       {"_pa", "Pa"},       {"_kg", "kg"},
                 {"_m", "m"},       {"_n", "N"},         {"_s", "s"}};
    const size_t length = strlen(name);
    const char *begin = *name == '/' ? name + 1 : name;
    for (size_t i = 0; i < sizeof units / sizeof units[0]; i++) {
        const size_t n = strlen(units[i].ending);
        if (length > n && strcmp(name + length - n, units[i].ending) == 0) {
            (void)snprintf(out, MAP_TITLE_SIZE, "%.*s [%s]", (int)(name + length - n - begin),
                           begin, units[i].unit);
            return;
        }
    }
    (void)snprintf(out, MAP_TITLE_SIZE, "%s", begin);
}

/* -- which axes ------------------------------------------------------------------------- */

/* First axis of a dimension; -1 when it has none. */
static int axis_of(const struct study_map *m, int dimension)
{
    for (int i = 0; i < m->n_axis; i++) {
        if (m->axis[i].dimension == dimension) {
            return i;
        }
    }
    return -1;
}

void map_plot_defaults(const struct study_map *m, struct map_plot *out)
{
    int long_one = -1, other = -1;
    *out = (struct map_plot){.map = m, .title = "", .y = -1, .level = (double)NAN};
    for (int d = 0; d < m->n_dimension; d++) {
        if (long_one < 0 || m->shape[d] > m->shape[long_one]) {
            other = long_one;
            long_one = d;
        } else if (other < 0 || m->shape[d] > m->shape[other]) {
            other = d;
        }
    }
    if (other >= 0 && m->shape[other] > 1) {
        out->x = axis_of(m, other < long_one ? other : long_one);
        out->y = axis_of(m, other < long_one ? long_one : other);
    } else {
        out->x = axis_of(m, long_one < 0 ? 0 : long_one);
    }
    if (strncmp(m->value_name, "damping", strlen("damping")) == 0) {
        out->level = 0.0;
    }
}

int svg_cell(const struct map_plot *plot, int i, int k)
{
    const struct study_map *m = plot->map;
    int cell = 0;
    for (int d = 0; d < m->n_dimension; d++) {
        const int place = d == m->axis[plot->x].dimension                   ? i
                          : plot->y >= 0 && d == m->axis[plot->y].dimension ? k
                                                                            : plot->fixed[d];
        cell = cell * m->shape[d] + place;
    }
    return cell;
}

/* -- sheet ------------------------------------------------------------------------------ */

/* What the other dimensions are held at, for the second line. */
static void write_fixed(struct json_out *out, const struct map_plot *plot)
{
    const struct study_map *m = plot->map;
    const char *between = "";
    for (int i = 0; i < m->n_axis; i++) {
        const struct study_axis_view *a = &m->axis[i];
        char title[MAP_TITLE_SIZE];
        if (a->dimension == m->axis[plot->x].dimension ||
            (plot->y >= 0 && a->dimension == m->axis[plot->y].dimension)) {
            continue;
        }
        map_title(a->pointer, title);
        json_out_text(out, between);
        svg_text(out, title);
        json_out_text(out, " = ");
        const int k = plot->fixed[a->dimension];
        if (a->value != NULL) {
            svg_put(out, "%.6g", a->value[k]);
        } else {
            svg_text(out, a->label[k]);
        }
        between = ", ";
    }
}

/* How many cells are there and how many are not. */
static void write_counts(struct json_out *out, const struct map_plot *plot)
{
    const struct study_map *m = plot->map;
    int count[STUDY_CELL_FAILED + 1] = {0};
    for (int i = 0; i < m->n_cell; i++) {
        count[m->status[i]]++;
    }
    if (isfinite(plot->level) && m->n_class == 0) {
        svg_put(out, "%s at %g, ", plot->y >= 0 ? "contour" : "line", plot->level);
    }
    svg_put(out, "%d of %d cells", count[STUDY_CELL_DONE], m->n_cell);
    if (count[STUDY_CELL_FAILED] > 0) {
        svg_put(out, ", %d failed", count[STUDY_CELL_FAILED]);
    }
}

void map_svg(struct json_out *out, const struct map_plot *plot)
{
    char title[MAP_TITLE_SIZE];
    assert(plot->x >= 0);
    map_title(plot->map->value_name, title);
    svg_put(out,
            "<svg xmlns=\"http://www.w3.org/2000/svg\" viewBox=\"0 0 %d %d\" width=\"%d\" "
            "height=\"%d\" font-family=\"sans-serif\" font-size=\"13\" fill=\"#222\">\n"
            "<rect width=\"%d\" height=\"%d\" fill=\"#fff\"/>\n",
            SVG_WIDTH, SVG_HEIGHT, SVG_WIDTH, SVG_HEIGHT, SVG_WIDTH, SVG_HEIGHT);
    svg_put(out, "<text x=\"%d\" y=\"26\" font-size=\"16\" font-weight=\"bold\">", SVG_LEFT);
    svg_text(out, plot->title[0] != '\0' ? plot->title : title);
    svg_put(out, "</text>\n<text x=\"%d\" y=\"46\" fill=\"#555\">", SVG_LEFT);
    write_fixed(out, plot);
    svg_put(out, "</text>\n<text x=\"%d\" y=\"%d\" text-anchor=\"end\" fill=\"#777\">",
            SVG_WIDTH - 16, SVG_HEIGHT - 12);
    write_counts(out, plot);
    json_out_text(out, "</text>\n");
    if (plot->y >= 0) {
        svg_heat(out, plot);
    } else {
        svg_lines(out, plot);
    }
    json_out_text(out, "</svg>\n");
}

#include "api/map_svg_parts.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>

enum { TICKS = 7, LABELS_MAX = 24 };

struct entry {
    double value;
    int place;
};

static int by_value(const void *a, const void *b)
{
    const struct entry *x = a, *y = b;
    return x->value != y->value ? (x->value > y->value) - (x->value < y->value)
                                : (x->place > y->place) - (x->place < y->place);
}

/* Places in rising order of the values; false when out of memory. */
static bool sort_order(const struct study_axis_view *a, int *order)
{
    struct entry *list = malloc((size_t)a->n * sizeof *list);
    if (list == NULL) {
        return false;
    }
    for (int i = 0; i < a->n; i++) {
        list[i] = (struct entry){a->value != NULL ? a->value[i] : i, i};
    }
    qsort(list, (size_t)a->n, sizeof *list, by_value);
    for (int i = 0; i < a->n; i++) {
        order[i] = list[i].place;
    }
    free(list);
    return true;
}

static double value_at(const struct svg_scale *s, int k)
{
    return s->axis->value != NULL ? s->axis->value[s->order[k]] : k;
}

/* Value of the edge before the k-th; the ends are as far out as the next edge is in. */
static double edge_value(const struct svg_scale *s, bool cells, int k)
{
    const int n = s->n;
    if (n == 1) {
        return value_at(s, 0) + (k == 0 ? -0.5 : 0.5);
    }
    if (!cells && (k == 0 || k == n)) {
        return value_at(s, k == 0 ? 0 : n - 1);
    }
    if (k == 0) {
        return 1.5 * value_at(s, 0) - 0.5 * value_at(s, 1);
    }
    if (k == n) {
        return 1.5 * value_at(s, n - 1) - 0.5 * value_at(s, n - 2);
    }
    return 0.5 * (value_at(s, k - 1) + value_at(s, k));
}

bool svg_scale_init(const struct study_axis_view *axis, bool cells, int from, int to,
                    struct svg_scale *out)
{
    const size_t n = (size_t)axis->n;
    struct svg_scale s = {.n = axis->n, .from = from, .to = to, .axis = axis};
    s.order = malloc(n * sizeof *s.order);
    s.centre = malloc((2 * n + 1) * sizeof *s.centre);
    if (s.order == NULL || s.centre == NULL || !sort_order(axis, s.order)) {
        free(s.order);
        free(s.centre);
        return false;
    }
    s.edge = s.centre + n;
    s.low = edge_value(&s, cells, 0);
    s.high = edge_value(&s, cells, s.n);
    if (!(s.high > s.low)) { /* all values equal */
        s.low -= 0.5;
        s.high += 0.5;
    }
    for (int k = 0; k < s.n; k++) {
        s.centre[k] = svg_pixel(&s, value_at(&s, k));
        s.edge[k] = svg_pixel(&s, edge_value(&s, cells, k));
    }
    s.edge[s.n] = svg_pixel(&s, edge_value(&s, cells, s.n));
    *out = s;
    return true;
}

void svg_scale_done(struct svg_scale *s)
{
    free(s->order);
    free(s->centre);
    *s = (struct svg_scale){.n = 0};
}

double svg_pixel(const struct svg_scale *s, double value)
{
    return s->from + (value - s->low) / (s->high - s->low) * (s->to - s->from);
}

double svg_tick_step(double range, int count)
{
    const double rough = range / count, power = pow(10.0, floor(log10(rough)));
    const double digit = rough / power;
    return power * (digit <= 1.0 ? 1.0 : digit <= 2.0 ? 2.0 : digit <= 5.0 ? 5.0 : 10.0);
}

void svg_tick_text(double value, double step, char out[32])
{
    (void)snprintf(out, 32, "%.6g", fabs(value) < 1e-6 * step ? 0.0 : value);
}

static void tick_x(struct json_out *out, double pixel, const char *text)
{
    svg_put(out,
            "<path d=\"M%.1f %dv5\" stroke=\"#222\"/><text x=\"%.1f\" y=\"%d\" "
            "text-anchor=\"middle\">",
            pixel, SVG_BOTTOM, pixel, SVG_BOTTOM + 19);
    svg_text(out, text);
    json_out_text(out, "</text>\n");
}

static void tick_y(struct json_out *out, double pixel, const char *text)
{
    svg_put(out,
            "<path d=\"M%d %.1fh-5\" stroke=\"#222\"/><text x=\"%d\" y=\"%.1f\" "
            "text-anchor=\"end\">",
            SVG_LEFT, pixel, SVG_LEFT - 8, pixel + 4.5);
    svg_text(out, text);
    json_out_text(out, "</text>\n");
}

typedef void (*tick_writer)(struct json_out *out, double pixel, const char *text);

static void write_ticks(struct json_out *out, const struct svg_scale *s, tick_writer write)
{
    char text[32];
    if (s->axis->value == NULL) {
        const int every = (s->n + LABELS_MAX - 1) / LABELS_MAX;
        for (int k = 0; k < s->n; k += every) {
            write(out, s->centre[k], s->axis->label[k]);
        }
        return;
    }
    const double step = svg_tick_step(s->high - s->low, TICKS);
    const int last = (int)floor(s->high / step + 1e-9);
    for (int i = (int)ceil(s->low / step - 1e-9); i <= last; i++) {
        svg_tick_text(i * step, step, text);
        write(out, svg_pixel(s, i * step), text);
    }
}

void svg_axis_x(struct json_out *out, const struct svg_scale *s)
{
    char title[MAP_TITLE_SIZE];
    write_ticks(out, s, tick_x);
    map_title(s->axis->pointer, title);
    svg_put(out, "<text x=\"%d\" y=\"%d\" text-anchor=\"middle\" font-size=\"14\">",
            (SVG_LEFT + SVG_RIGHT) / 2, SVG_BOTTOM + 44);
    svg_text(out, title);
    json_out_text(out, "</text>\n");
}

void svg_title_y(struct json_out *out, const char *title)
{
    svg_put(out,
            "<text transform=\"translate(24 %d) rotate(-90)\" text-anchor=\"middle\" "
            "font-size=\"14\">",
            (SVG_TOP + SVG_BOTTOM) / 2);
    svg_text(out, title);
    json_out_text(out, "</text>\n");
}

void svg_axis_y(struct json_out *out, const struct svg_scale *s)
{
    char title[MAP_TITLE_SIZE];
    write_ticks(out, s, tick_y);
    map_title(s->axis->pointer, title);
    svg_title_y(out, title);
}

void svg_ticks_y(struct json_out *out, double low, double high)
{
    const struct study_axis_view axis = {.value = &low, .n = 1};
    const struct svg_scale s = {
        .n = 1, .low = low, .high = high, .from = SVG_BOTTOM, .to = SVG_TOP, .axis = &axis};
    write_ticks(out, &s, tick_y);
}

void svg_frame(struct json_out *out)
{
    svg_put(out,
            "<rect x=\"%d\" y=\"%d\" width=\"%d\" height=\"%d\" fill=\"none\" "
            "stroke=\"#222\"/>\n",
            SVG_LEFT, SVG_TOP, SVG_RIGHT - SVG_LEFT, SVG_BOTTOM - SVG_TOP);
}

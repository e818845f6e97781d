/* A record of a dataset as a drawing: motion, c_l and c_m over time, one under the other. */
#include "api/dataset.h"
#include "api/svg.h"
#include "core/num.h"

#include <math.h>

enum { WIDTH = 760, PANEL = 170, LEFT = 70, RIGHT = 20, TOP = 34, GAP = 30, POINTS_MAX = 2000 };

/* One panel: a row of the record in the unit of the document. */
struct panel {
    const struct flow_record *r;
    int row;
    double unit, low, high;
    double top; /* [px] */
};

static double value_at(const struct panel *p, int i)
{
    return p->r->value[num_at(i, p->row, p->r->n)] * p->unit;
}

static double time_at(const struct panel *p, int i)
{
    return p->r->value[num_at(i, FLOW_TIME, p->r->n)];
}

static double x_of(const struct panel *p, int i)
{
    const double from = time_at(p, 0), to = time_at(p, p->r->n - 1);
    return LEFT + (WIDTH - LEFT - RIGHT) * (time_at(p, i) - from) / (to - from);
}

static double y_of(const struct panel *p, double value)
{
    return p->top + PANEL * (p->high - value) / (p->high - p->low);
}

static void scale(struct panel *p)
{
    p->low = p->high = value_at(p, 0);
    for (int i = 1; i < p->r->n; i++) {
        p->low = fmin(p->low, value_at(p, i));
        p->high = fmax(p->high, value_at(p, i));
    }
    const double margin = p->high > p->low ? 0.05 * (p->high - p->low) : 1.0;
    p->low -= margin;
    p->high += margin;
}

static void draw(struct json_out *out, const struct panel *p, const char *title)
{
    const int every = 1 + p->r->n / POINTS_MAX;
    svg_put(
        out,
        "<rect x=\"%d\" y=\"%.1f\" width=\"%d\" height=\"%d\" fill=\"none\" stroke=\"#999\"/>\n",
        LEFT, p->top, WIDTH - LEFT - RIGHT, PANEL);
    svg_put(out, "<text x=\"%d\" y=\"%.1f\" font-weight=\"bold\">%s</text>\n", LEFT, p->top - 6.0,
            title);
    for (int i = 0; i <= 2; i++) {
        const double v = p->low + 0.5 * i * (p->high - p->low);
        svg_put(out, "<text x=\"%d\" y=\"%.1f\" text-anchor=\"end\">%.3g</text>\n", LEFT - 6,
                y_of(p, v) + 4.0, fabs(v) < 1e-12 ? 0.0 : v);
    }
    if (p->low < 0.0 && p->high > 0.0) {
        svg_put(out, "<path d=\"M%d %.1fH%d\" stroke=\"#ddd\"/>\n", LEFT, y_of(p, 0.0),
                WIDTH - RIGHT);
    }
    svg_put(out, "<path fill=\"none\" stroke=\"#1f5fa8\" stroke-width=\"1.2\" d=\"");
    for (int i = 0; i < p->r->n; i += every) {
        svg_put(out, "%c%.1f %.1f", i == 0 ? 'M' : 'L', x_of(p, i), y_of(p, value_at(p, i)));
    }
    svg_put(out, "\"/>\n");
}

void dataset_write_svg(struct json_out *out, const struct flow_record *r)
{
    static const struct {
        int row;
        bool angle;
        const char *title;
    } rows[] = {{FLOW_THETA, true, "angle of the chord [deg]"},
                {FLOW_W, false, "plunge w/c, up"},
                {FLOW_CL, false, "lift coefficient"},
                {FLOW_CM, false, "moment coefficient about mid-chord, nose-up"}};
    enum { N = sizeof rows / sizeof rows[0] };
    const int height = TOP + N * (PANEL + GAP) + 30;
    svg_put(out,
            "<svg xmlns=\"http://www.w3.org/2000/svg\" width=\"%d\" height=\"%d\" "
            "viewBox=\"0 0 %d %d\" font-family=\"sans-serif\" font-size=\"12\">\n",
            WIDTH, height, WIDTH, height);
    svg_put(out, "<title>%s</title>\n<rect width=\"100%%\" height=\"100%%\" fill=\"#fff\"/>\n",
            r->name);
    svg_put(out, "<text x=\"%d\" y=\"14\" text-anchor=\"end\">%s</text>\n", WIDTH - RIGHT, r->name);
    struct panel p = {.r = r};
    for (int i = 0; i < N; i++) {
        p.row = rows[i].row;
        p.unit = rows[i].angle ? 180.0 / NUM_PI : 1.0;
        p.top = TOP + i * (PANEL + GAP);
        scale(&p);
        draw(out, &p, rows[i].title);
    }
    svg_put(out, "<text x=\"%d\" y=\"%d\">%.4g</text>\n", LEFT, height - 26, time_at(&p, 0));
    svg_put(out, "<text x=\"%d\" y=\"%d\" text-anchor=\"end\">%.4g</text>\n", WIDTH - RIGHT,
            height - 26, time_at(&p, r->n - 1));
    svg_put(out, "<text x=\"%d\" y=\"%d\" text-anchor=\"middle\">time [c/V]</text>\n</svg>\n",
            (WIDTH + LEFT - RIGHT) / 2, height - 26);
}

/* api/map_svg_parts.h
 * What the drawings share: the sheet, scales, colours. Inside map_svg*.c only.
 *
 * A struct svg_scale owns its arrays: svg_scale_done. */
#ifndef AEROM_API_MAP_SVG_PARTS_H
#define AEROM_API_MAP_SVG_PARTS_H

#include "api/map_svg.h"
#include "api/svg.h"

/* The sheet and the field of the drawing on it, in user units. */
enum {
    SVG_WIDTH = 860,
    SVG_HEIGHT = 560,
    SVG_LEFT = 90,
    SVG_TOP = 60,
    SVG_RIGHT = 660,
    SVG_BOTTOM = 480,
    SVG_BAR_LEFT = 690,
    SVG_BAR_RIGHT = 712,
    SVG_COLOURS = 64
};

/* One axis on the sheet: its values in rising order, from pixel `from` to `to`. */
struct svg_scale {
    int n;
    int *order;       /* (n) place in the axis of the k-th smallest; texts keep their order */
    double *centre;   /* (n) pixel of the k-th */
    double *edge;     /* (n + 1) pixels between neighbours */
    double low, high; /* values at the ends; of numbers */
    int from, to;     /* pixels there */
    const struct study_axis_view *axis;
};
/* For cells (edges half way between neighbours) or for points (no room beyond the ends). False
 * when out of memory. */
bool svg_scale_init(const struct study_axis_view *axis, bool cells, int from, int to,
                    struct svg_scale *out);
void svg_scale_done(struct svg_scale *s);
double svg_pixel(const struct svg_scale *s, double value);

/* A round step for about `count` ticks over a range > 0. */
double svg_tick_step(double range, int count);
/* A tick's number without the dust of its sum. */
void svg_tick_text(double value, double step, char out[32]);

/* Frame, ticks and titles of both axes. */
void svg_axis_x(struct json_out *out, const struct svg_scale *s);
void svg_axis_y(struct json_out *out, const struct svg_scale *s);
void svg_frame(struct json_out *out);
void svg_title_y(struct json_out *out, const char *title);
/* Ticks of numbers along the left side. */
void svg_ticks_y(struct json_out *out, double low, double high);

/* Colours of numbers: from dark to bright, or through white at zero when the range has both signs.
 * shade 0..SVG_COLOURS - 1; text "#rrggbb". */
void svg_colour(int shade, bool both_signs, char out[8]);
/* Fill of a class, a colour under a hatch of its own. The patterns are defined once. */
void svg_class_patterns(struct json_out *out, int n_class);

/* The two kinds of drawing. */
void svg_heat(struct json_out *out, const struct map_plot *plot);
void svg_lines(struct json_out *out, const struct map_plot *plot);
/* Contour at plot->level and the curves. */
void svg_contour(struct json_out *out, const struct map_plot *plot, const struct svg_scale *x,
                 const struct svg_scale *y);
void svg_curves(struct json_out *out, const struct map_plot *plot, const struct svg_scale *x,
                const struct svg_scale *y);

/* Cell at places i and k of the axes drawn (k ignored without y). */
int svg_cell(const struct map_plot *plot, int i, int k);

#endif

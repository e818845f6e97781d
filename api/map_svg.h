/* api/map_svg.h
 * Drawings of a map as SVG without script: colours over two axes with a colour bar or the classes
 * of a text, a contour and curves on top; or a line over one axis. No state. */
#ifndef AEROM_API_MAP_SVG_H
#define AEROM_API_MAP_SVG_H

#include "api/study_map.h"

/* Points (x, y) in the units of the two axes, joined by a line; not finite: a gap. Borrowed. */
struct map_curve {
    const char *name;
    int n;
    const double *x, *y;
};

struct map_plot {
    const struct study_map *map;
    const char *title;         /* "" = the name of the value */
    int x, y;                  /* axes of the map; y -1: the value over x as a line */
    int fixed[STUDY_AXES_MAX]; /* places along the other dimensions */
    double level;              /* contour of a map of numbers; NaN: none */
    int n_curve;
    const struct map_curve *curve;
};

/* Axes as they are drawn by default: the two longest dimensions, the last one as y; one as x. The
 * contour is at zero for a damping. */
void map_plot_defaults(const struct study_map *m, struct map_plot *out);

/* The title of an axis or result, "flow/speed [m/s]" for "/flow/speed_m_s". */
enum { MAP_TITLE_SIZE = 200 };
void map_title(const char *name, char out[MAP_TITLE_SIZE]);

/* Marks `failed` in the writer when out of memory. */
void map_svg(struct json_out *out, const struct map_plot *plot);

#endif

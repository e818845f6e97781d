#include "api/map_svg_parts.h"

#include <stdio.h>

struct rgb {
    unsigned char r, g, b;
};

/* Even in lightness, readable in grey and by the colour-blind. */
static const struct rgb dark_to_bright[] = {{68, 1, 84},    {71, 44, 122},  {59, 81, 139},
                                            {44, 113, 142}, {33, 144, 141}, {39, 173, 129},
                                            {92, 200, 99},  {170, 220, 50}, {253, 231, 37}};
/* Below zero red, above blue. */
static const struct rgb through_white[] = {{124, 10, 30},   {178, 34, 52},   {222, 96, 82},
                                           {246, 174, 142}, {250, 250, 250}, {158, 202, 225},
                                           {88, 152, 204},  {36, 100, 170},  {8, 48, 107}};
enum { ANCHORS = sizeof dark_to_bright / sizeof dark_to_bright[0] };

static int mix(int a, int b, double share)
{
    return (int)(a + share * (b - a) + 0.5);
}

void svg_colour(int shade, bool both_signs, char out[8])
{
    const struct rgb *list = both_signs ? through_white : dark_to_bright;
    const double place = (double)shade / (SVG_COLOURS - 1) * (ANCHORS - 1);
    const int i = place < ANCHORS - 2 ? (int)place : ANCHORS - 2;
    const double share = place - i;
    const struct rgb a = list[i], b = list[i + 1];
    (void)snprintf(out, 8, "#%02x%02x%02x", (unsigned)mix(a.r, b.r, share) & 0xffu,
                   (unsigned)mix(a.g, b.g, share) & 0xffu, (unsigned)mix(a.b, b.b, share) & 0xffu);
}

void svg_class_patterns(struct json_out *out, int n_class)
{
    static const char *const colour[] = {"#9ecae1", "#f4a582", "#b2df8a", "#d9b3e6",
                                         "#ffe08a", "#c7c7c7", "#f2b6c6", "#8fd3c8"};
    static const char *const hatch[] = {
        "",                                 /* the first class is plain */
        "M-2 10L10 -2M-2 2L2 -2M6 10L10 6", /* rising */
        "M-2 -2L10 10M6 -2L10 2M-2 6L2 10", /* falling */
        "M0 4h8",                           /* lying */
        "M4 0v8",                           /* upright */
        "M-2 10L10 -2M-2 -2L10 10",         /* crossed */
        "M0 4h8M4 0v8",                     /* chequered */
        "M3 4h2",                           /* dotted */
    };
    enum { COLOURS = sizeof colour / sizeof colour[0], HATCHES = sizeof hatch / sizeof hatch[0] };
    for (int i = 0; i < n_class; i++) {
        /* After a full turn of the colours the hatches are shifted by one. */
        svg_put(out,
                "<pattern id=\"class%d\" width=\"8\" height=\"8\" patternUnits=\"userSpaceOnUse\">"
                "<rect width=\"8\" height=\"8\" fill=\"%s\"/><path d=\"%s\" stroke=\"#555\" "
                "stroke-width=\"0.9\" fill=\"none\"/></pattern>\n",
                i, colour[i % COLOURS], hatch[(i + i / COLOURS) % HATCHES]);
    }
}

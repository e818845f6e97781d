/* api/svg.h
 * Text of SVG documents. No state. */
#ifndef AEROM_API_SVG_H
#define AEROM_API_SVG_H

#include "api/json_out.h"

/* Formatted text, cut at 1 KiB. */
void svg_put(struct json_out *out, const char *format, ...) __attribute__((format(printf, 2, 3)));
/* With the five characters of XML replaced, and those it does not allow left out. */
void svg_text(struct json_out *out, const char *text);

#endif

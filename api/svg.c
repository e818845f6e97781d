#include "api/svg.h"

#include <stdarg.h>
#include <stdio.h>

void svg_put(struct json_out *out, const char *format, ...)
{
    char text[1024];
    va_list list;
    va_start(list, format);
    const int n = vsnprintf(text, sizeof text, format, list);
    va_end(list);
    if (n > 0) {
        json_out_text(out, text);
    }
}

void svg_text(struct json_out *out, const char *text)
{
    static const struct {
        char c;
        const char *entity;
    } table[] = {{'&', "&amp;"}, {'<', "&lt;"}, {'>', "&gt;"}, {'"', "&quot;"}, {'\'', "&#39;"}};
    enum { ENTITIES = sizeof table / sizeof table[0] };
    for (const char *c = text; *c != '\0'; c++) {
        int i = 0;
        while (i < ENTITIES && table[i].c != *c) {
            i++;
        }
        if (i < ENTITIES) {
            json_out_text(out, table[i].entity);
        } else if ((unsigned char)*c >= 0x20) {
            json_out_bytes(out, c, 1);
        }
    }
}

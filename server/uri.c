#include "server/uri.h"

#include <ctype.h>
#include <string.h>

static int hex(char c)
{
    if (c >= '0' && c <= '9') {
        return c - '0';
    }
    const int lower = tolower((unsigned char)c);
    return lower >= 'a' && lower <= 'f' ? lower - 'a' + 10 : -1;
}

/* Decodes in place; false for a malformed escape or a decoded control character. */
static bool decode(char *s)
{
    char *out = s;
    while (*s != '\0') {
        int c = (unsigned char)*s++;
        if (c == '+') {
            c = ' ';
        } else if (c == '%') {
            const int high = hex(s[0]);
            const int low = high < 0 ? -1 : hex(s[1]);
            if (low < 0) {
                return false;
            }
            c = 16 * high + low;
            s += 2;
        }
        if (c < 0x20 || c == 0x7f) {
            return false;
        }
        *out++ = (char)c;
    }
    *out = '\0';
    return true;
}

static enum uri_status split_query(char *query, struct api_request *req)
{
    while (query != NULL) {
        char *item = query;
        query = strchr(item, '&');
        if (query != NULL) {
            *query++ = '\0';
        }
        if (*item == '\0') {
            continue;
        }
        if (req->n_query == API_QUERY_MAX) {
            return URI_TOO_MANY;
        }
        char *value = strchr(item, '=');
        if (value != NULL) {
            *value++ = '\0';
        } else {
            value = item + strlen(item);
        }
        if (!decode(item) || !decode(value)) {
            return URI_BAD;
        }
        req->query[req->n_query++] = (struct api_query){.key = item, .value = value};
    }
    return URI_OK;
}

enum uri_status uri_split(char *target, struct api_request *req)
{
    req->n_query = 0;
    req->path = target;
    if (target[0] != '/') {
        return URI_BAD;
    }
    for (const char *p = target; *p != '\0'; p++) {
        if ((unsigned char)*p <= 0x20 || *p == 0x7f) {
            return URI_BAD;
        }
    }
    char *query = strchr(target, '?');
    if (query != NULL) {
        *query++ = '\0';
    }
    return split_query(query, req);
}

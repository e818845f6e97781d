#include "api/http_msg.h"

#include <assert.h>
#include <stdarg.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

const char *api_query_get(const struct api_request *req, const char *key)
{
    for (int i = 0; i < req->n_query; i++) {
        if (strcmp(req->query[i].key, key) == 0) {
            return req->query[i].value;
        }
    }
    return NULL;
}

void api_response_header(struct api_response *res, const char *name, const char *format, ...)
{
    assert(res->n_header < API_HEADER_MAX);
    struct api_header *h = &res->header[res->n_header++];
    (void)snprintf(h->name, sizeof h->name, "%s", name);
    va_list args;
    va_start(args, format);
    (void)vsnprintf(h->value, sizeof h->value, format, args);
    va_end(args);
}

void api_response_done(struct api_response *res)
{
    free(res->body);
    res->body = NULL;
    res->body_size = 0;
}

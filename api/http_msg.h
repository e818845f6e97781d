/* api/http_msg.h
 * One HTTP request and one response as plain structs, free of any HTTP library.
 *
 * A request is borrowed for the length of the handler call. A response owns its body and goes to
 * the reply exactly once. */
#ifndef AEROM_API_HTTP_MSG_H
#define AEROM_API_HTTP_MSG_H

#include <stdbool.h>
#include <stddef.h>

enum { API_QUERY_MAX = 32, API_HEADER_MAX = 8 };

struct api_query {
    const char *key;   /* percent-decoded */
    const char *value; /* percent-decoded; "" when absent */
};

struct api_request {
    const char *method; /* "GET" ... */
    const char *path;   /* without the query, not decoded */
    int n_query;
    struct api_query query[API_QUERY_MAX];
    const char *content_type; /* NULL when absent, as are the next ones */
    const char *accept;
    const char *if_none_match;
    const char *body; /* not zero-terminated */
    size_t body_size;
};

struct api_header {
    char name[32];
    char value[512];
};

struct api_response {
    int status;
    char content_type[64]; /* "" = no body */
    char *body;            /* malloc'ed, owned; NULL = no body */
    size_t body_size;
    int n_header;
    struct api_header header[API_HEADER_MAX];
};

/* Where a handler sends its one answer: at once, or later from another thread. The reply takes the
 * response's body; the response struct itself stays the caller's. */
struct api_reply {
    void (*send)(struct api_reply *reply, struct api_response *response);
};

/* Value of a query key, NULL when absent. */
const char *api_query_get(const struct api_request *req, const char *key);
/* Adds a header; the value is a printf format. Asserts that there is room. */
void api_response_header(struct api_response *res, const char *name, const char *format, ...)
    __attribute__((format(printf, 3, 4)));
/* Frees the body. */
void api_response_done(struct api_response *res);

#endif

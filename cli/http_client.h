/* cli/http_client.h
 * One keep-alive connection to a daemon, over libcurl. For one thread. */
#ifndef AEROM_CLI_HTTP_CLIENT_H
#define AEROM_CLI_HTTP_CLIENT_H

#include <stdbool.h>
#include <stddef.h>

struct http_client;

struct http_answer {
    long status; /* 200, 404, ... */
    char *body;  /* malloc'ed, ends with an extra zero; never NULL after a success */
    size_t size;
};

/* `url` is the address without a path ("http://127.0.0.1:8080"); copied. NULL when out of memory.
 */
struct http_client *http_client_create(const char *url);
void http_client_destroy(struct http_client *client);

/* Sends one request and waits for the answer. `path` starts with '/'; `body` NULL sends none,
 * otherwise it goes as application/json. Any status is a success of the call. On failure (no
 * connection, broken answer) a line has gone to stderr and *answer is unchanged. */
bool http_client_request(struct http_client *client, const char *method, const char *path,
                         const char *body, size_t size, struct http_answer *answer);
void http_answer_done(struct http_answer *answer);

#endif

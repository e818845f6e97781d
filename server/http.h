/* server/http.h
 * The HTTP adaptor: the only part that sees libmicrohttpd.
 *
 * A pool of threads turns connections into struct api_request, hands them to the router, and sends
 * what comes back, at once or later: while the writer works a connection is suspended and costs no
 * thread. */
#ifndef AEROM_SERVER_HTTP_H
#define AEROM_SERVER_HTTP_H

#include "api/router.h"
#include "server/log.h"

struct http_server;

struct http_config {
    const char *listen; /* "ADDRESS:PORT", "[ADDRESS]:PORT"; numeric address or "localhost" */
    int threads;
};

/* Starts serving. Borrows api and log. On failure NULL, and `why` (size bytes) says what is wrong.
 */
struct http_server *http_start(const struct http_config *config, const struct api *api,
                               const struct log *log, char *why, size_t size);
/* The address in use, with the real port: "http://127.0.0.1:8080". */
const char *http_url(const struct http_server *h);
/* Closes connections that are too slow. Called about once a second. */
void http_tick(struct http_server *h);
/* Takes no further connections; those that are open go on. */
void http_quiesce(struct http_server *h);
/* Closes everything and joins the threads. No answer may be outstanding. Accepts NULL. */
void http_stop(struct http_server *h);

#endif

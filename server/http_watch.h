/* server/http_watch.h
 * Time limits on connections: the HTTP library only knows an idle limit, which a client that sends
 * one byte at a time never reaches. Each connection is in a phase with a deadline; a periodic tick
 * shuts the sockets of those that are late, and the library then closes them.
 *
 * Safe from any thread. */
#ifndef AEROM_SERVER_HTTP_WATCH_H
#define AEROM_SERVER_HTTP_WATCH_H

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

/* Seconds: first header, next header on a kept connection, body (plus one for each megabyte). An
 * answer has no limit of its own: the library's idle limit ends a reader that stalls. */
enum { WATCH_FIRST_HEADER_S = 10, WATCH_NEXT_HEADER_S = 30, WATCH_BODY_S = 30 };

struct http_watch;
struct watched; /* one connection */

struct http_watch *http_watch_create(void);
/* Accepts NULL; all connections must be gone. */
void http_watch_destroy(struct http_watch *w);

/* A connection begins on a socket, waiting for its first header; NULL when out of memory (then it
 * is not watched). */
struct watched *http_watch_open(struct http_watch *w, int fd);
/* A connection is about to be closed. Accepts NULL, as do the next ones. */
void http_watch_close(struct http_watch *w, struct watched *c);
/* The header is complete and a body of at most `body_max` bytes follows. */
void http_watch_body(struct http_watch *w, struct watched *c, size_t body_max);
/* The request is complete; an answer is being made or sent. */
void http_watch_answer(struct http_watch *w, struct watched *c);
/* The answer is sent; the next header may come. */
void http_watch_next(struct http_watch *w, struct watched *c);

/* Shuts what is late at `now_us` (monotonic). Returns how many. */
int http_watch_tick(struct http_watch *w, int64_t now_us);

#endif

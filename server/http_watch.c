#include "server/http_watch.h"

#include "server/clock.h"

#include <pthread.h>
#include <stdlib.h>
#include <sys/socket.h>

struct watched {
    int fd;
    int64_t deadline_us; /* 0 = none */
    struct watched *next, **link;
};

struct http_watch {
    pthread_mutex_t mutex; /* guards the list and what is in it */
    struct watched *first;
};

struct http_watch *http_watch_create(void)
{
    struct http_watch *w = calloc(1, sizeof *w);
    if (w != NULL) {
        (void)pthread_mutex_init(&w->mutex, NULL);
    }
    return w;
}

void http_watch_destroy(struct http_watch *w)
{
    if (w == NULL) {
        return;
    }
    (void)pthread_mutex_destroy(&w->mutex);
    free(w);
}

static int64_t in_seconds(int64_t seconds)
{
    return clock_mono_us() + seconds * 1000000;
}

struct watched *http_watch_open(struct http_watch *w, int fd)
{
    struct watched *c = calloc(1, sizeof *c);
    if (c == NULL) {
        return NULL;
    }
    c->fd = fd;
    c->deadline_us = in_seconds(WATCH_FIRST_HEADER_S);
    (void)pthread_mutex_lock(&w->mutex);
    c->next = w->first;
    c->link = &w->first;
    if (c->next != NULL) {
        c->next->link = &c->next;
    }
    w->first = c;
    (void)pthread_mutex_unlock(&w->mutex);
    return c;
}

void http_watch_close(struct http_watch *w, struct watched *c)
{
    if (c == NULL) {
        return;
    }
    (void)pthread_mutex_lock(&w->mutex);
    *c->link = c->next;
    if (c->next != NULL) {
        c->next->link = c->link;
    }
    (void)pthread_mutex_unlock(&w->mutex);
    free(c);
}

static void set_deadline(struct http_watch *w, struct watched *c, int64_t deadline_us)
{
    if (c == NULL) {
        return;
    }
    (void)pthread_mutex_lock(&w->mutex);
    c->deadline_us = deadline_us;
    (void)pthread_mutex_unlock(&w->mutex);
}

void http_watch_body(struct http_watch *w, struct watched *c, size_t body_max)
{
    set_deadline(w, c, in_seconds(WATCH_BODY_S + (int64_t)(body_max >> 20)));
}

void http_watch_answer(struct http_watch *w, struct watched *c)
{
    set_deadline(w, c, 0);
}

void http_watch_next(struct http_watch *w, struct watched *c)
{
    set_deadline(w, c, in_seconds(WATCH_NEXT_HEADER_S));
}

int http_watch_tick(struct http_watch *w, int64_t now_us)
{
    int late = 0;
    (void)pthread_mutex_lock(&w->mutex);
    for (struct watched *c = w->first; c != NULL; c = c->next) {
        if (c->deadline_us != 0 && now_us > c->deadline_us) {
            (void)shutdown(c->fd, SHUT_RDWR); /* the descriptor stays open until http_watch_close */
            c->deadline_us = 0;
            late++;
        }
    }
    (void)pthread_mutex_unlock(&w->mutex);
    return late;
}

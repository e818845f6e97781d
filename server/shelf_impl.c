#include "server/shelf_impl.h"

#include "server/clock.h"
#include "server/port.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

struct shelf_impl {
    struct shelf port;
    struct store *store;
    struct writer *writer;
    const struct log *log;
};

/* -- writes ----------------------------------------------------------------------------- */

struct put_request {
    struct write_request base;
    const struct shelf_item *item; /* borrowed until `done` */
    shelf_put_done done;
    void *arg;
    int version;
    bool reused;
};

static enum store_status put_apply(struct write_request *r, struct store_session *s)
{
    struct put_request *q = (struct put_request *)r;
    return s->ops->shelf_put(s, q->item, clock_wall_us(), &q->version, &q->reused);
}

static void put_done(struct write_request *r, enum store_status st)
{
    struct put_request *q = (struct put_request *)r;
    q->done(q->arg, port_status(st), q->version, q->reused);
    free(q);
}

static void shelf_put(void *ctx, const struct shelf_item *item, shelf_put_done done, void *arg)
{
    struct shelf_impl *s = ctx;
    struct put_request *q = calloc(1, sizeof *q);
    if (q == NULL) {
        done(arg, SERVICE_ERROR, 0, false);
        return;
    }
    *q = (struct put_request){
        .base = {.apply = put_apply, .done = put_done}, .item = item, .done = done, .arg = arg};
    if (!writer_post(s->writer, &q->base)) {
        free(q);
        done(arg, SERVICE_BUSY, 0, false);
    }
}

struct drop_request {
    struct write_request base;
    enum shelf_kind kind;
    char name[LIMIT_NAME];
    int version;
    shelf_drop_done done;
    void *arg;
};

static enum store_status drop_apply(struct write_request *r, struct store_session *s)
{
    struct drop_request *q = (struct drop_request *)r;
    return s->ops->shelf_drop(s, q->kind, q->name, q->version);
}

static void drop_done(struct write_request *r, enum store_status st)
{
    struct drop_request *q = (struct drop_request *)r;
    q->done(q->arg, port_status(st));
    free(q);
}

static void shelf_drop(void *ctx, enum shelf_kind kind, const char *name, int version,
                       shelf_drop_done done, void *arg)
{
    struct shelf_impl *s = ctx;
    struct drop_request *q = calloc(1, sizeof *q);
    if (q == NULL) {
        done(arg, SERVICE_ERROR);
        return;
    }
    *q = (struct drop_request){.base = {.apply = drop_apply, .done = drop_done},
                               .kind = kind,
                               .version = version,
                               .done = done,
                               .arg = arg};
    (void)snprintf(q->name, sizeof q->name, "%s", name);
    if (!writer_post(s->writer, &q->base)) {
        free(q);
        done(arg, SERVICE_BUSY);
    }
}

/* -- reads ------------------------------------------------------------------------------ */

static enum service_status shelf_list(void *ctx, enum shelf_kind kind, struct shelf_entry **out,
                                      int *n)
{
    const struct shelf_impl *s = ctx;
    struct store_session *r = port_take(s->store, s->log);
    return r == NULL ? SERVICE_ERROR
                     : port_give(s->store, s->log, r, r->ops->shelf_list(r, kind, out, n));
}

static enum service_status shelf_get(void *ctx, enum shelf_kind kind, const char *name, int version,
                                     struct shelf_entry *out)
{
    const struct shelf_impl *s = ctx;
    struct store_session *r = port_take(s->store, s->log);
    return r == NULL
               ? SERVICE_ERROR
               : port_give(s->store, s->log, r, r->ops->shelf_get(r, kind, name, version, out));
}

struct shelf_impl *shelf_impl_create(struct store *st, struct writer *writer, const struct log *log)
{
    struct shelf_impl *s = calloc(1, sizeof *s);
    if (s == NULL) {
        return NULL;
    }
    *s = (struct shelf_impl){.port = {.ctx = s,
                                      .put = shelf_put,
                                      .drop = shelf_drop,
                                      .list = shelf_list,
                                      .get = shelf_get},
                             .store = st,
                             .writer = writer,
                             .log = log};
    return s;
}

void shelf_impl_destroy(struct shelf_impl *s)
{
    free(s);
}

const struct shelf *shelf_impl_port(const struct shelf_impl *s)
{
    return &s->port;
}

#include "server/app.h"

#include "core/sim.h"
#include "server/clock.h"
#include "server/http.h"
#include "server/service_impl.h"
#include "server/shelf_impl.h"
#include "server/worker.h"

#include <sodium.h>
#include <stdio.h>
#include <stdlib.h>

struct app {
    const struct config *config;
    const struct log *log;
    char owner[33]; /* names this process on its leases, unique over restarts */
    int64_t heartbeat_us;
    struct store *store;
    struct library *library;
    struct dispatch *dispatch;
    struct writer *writer;
    struct service_impl *service;
    struct shelf_impl *shelf;
    struct api api;
    struct workers *workers;
    struct http_server *http;
};

static enum app_exit failed(const struct app *a, const char *part, const char *why)
{
    LOG(a->log, LOG_LEVEL_ERROR, "start_failed", log_s("part", part), log_s("why", why));
    return APP_FAILURE;
}

static void make_owner(char out[33])
{
    unsigned char bytes[16];
    randombytes_buf(bytes, sizeof bytes);
    (void)sodium_bin2hex(out, 33, bytes, sizeof bytes);
}

static enum app_exit open_store(struct app *a)
{
    char why[STORE_MESSAGE] = "";
    const enum store_status st = store_open(a->config->store, &a->store, why);
    if (st == STORE_OK) {
        return APP_OK;
    }
    const enum app_exit code = failed(a, "store", why);
    return st == STORE_LOCKED ? APP_STORE_IN_USE : code;
}

static enum app_exit load_library(struct app *a)
{
    struct failure fail = {.status = ST_OK};
    const enum status st = library_create_builtin(&a->library, &fail);
    return st == ST_OK ? APP_OK : failed(a, "library", fail.detail);
}

static struct worker_env environment(const struct app *a)
{
    return (struct worker_env){.store = a->store,
                               .writer = a->writer,
                               .dispatch = a->dispatch,
                               .library = a->library,
                               .log = a->log,
                               .owner = a->owner,
                               .attempts_max = a->config->attempts};
}

/* Queue, writer and service; takes back what a previous process was running. */
static enum app_exit start_jobs(struct app *a)
{
    int64_t depth = 0;
    struct store_session *s = a->store->ops->writer(a->store); /* the writer has not started yet */
    if (s->ops->depth(s, &depth) != STORE_OK) {
        return failed(a, "store", s->ops->message(s));
    }
    a->dispatch = dispatch_create(a->config->workers, depth);
    if (a->dispatch == NULL || writer_create(a->store, a->log, &a->writer) != STORE_OK) {
        return failed(a, "writer", "out of memory or threads");
    }
    a->shelf = shelf_impl_create(a->store, a->writer, a->log);
    if (a->shelf == NULL) {
        return failed(a, "library", "out of memory");
    }
    library_attach(a->library, shelf_impl_port(a->shelf));
    const struct worker_env env = environment(a);
    if (workers_recover(&env) != STORE_OK) {
        return failed(a, "recovery", "the queue of the previous process cannot be taken over");
    }
    a->service =
        service_impl_create(a->store, a->writer, a->dispatch, a->log, a->config->queue_limit);
    return a->service != NULL ? APP_OK : failed(a, "service", "the store cannot be read");
}

static enum app_exit start_threads(struct app *a)
{
    const struct worker_env env = environment(a);
    if (workers_start(&env, &a->workers) != STORE_OK) {
        return failed(a, "workers", "out of memory or threads");
    }
    a->api = (struct api){.library = a->library,
                          .service = service_impl_port(a->service),
                          .shelf = shelf_impl_port(a->shelf)};
    const struct http_config http = {.listen = a->config->listen,
                                     .threads = a->config->http_threads};
    char why[256] = "";
    a->http = http_start(&http, &a->api, a->log, why, sizeof why);
    return a->http != NULL ? APP_OK : failed(a, "http", why);
}

enum app_exit app_start(const struct config *config, const struct log *log, struct app **out)
{
    struct app *a = calloc(1, sizeof *a);
    if (a == NULL) {
        return APP_FAILURE;
    }
    a->config = config;
    a->log = log;
    if (sodium_init() < 0) {
        (void)failed(a, "random", "no source of random numbers");
        free(a);
        return APP_FAILURE;
    }
    make_owner(a->owner);
    static enum app_exit (*const step[])(struct app *) = {open_store, load_library, start_jobs,
                                                          start_threads};
    for (size_t i = 0; i < sizeof step / sizeof step[0]; i++) {
        const enum app_exit code = step[i](a);
        if (code != APP_OK) {
            app_stop(a);
            return code;
        }
    }
    a->heartbeat_us = clock_mono_us();
    LOG(log, LOG_LEVEL_INFO, "started", log_s("version", AEROM_VERSION),
        log_s("core", AEROM_CORE_VERSION), log_s("blas", sim_blas_description()),
        log_s("store", config->store), log_i("workers", config->workers));
    LOG(log, LOG_LEVEL_INFO, "listening", log_s("url", http_url(a->http)));
    *out = a;
    return APP_OK;
}

void app_tick(struct app *a)
{
    const int64_t space = a->store->ops->space(a->store);
    const int64_t reserve = (int64_t)a->config->disk_reserve_mb << 20;
    service_impl_disk_low(a->service, space >= 0 && space < reserve);
    http_tick(a->http);
    const int64_t now = clock_mono_us();
    if (now - a->heartbeat_us >= HEARTBEAT_S * INT64_C(1000000)) {
        a->heartbeat_us = now;
        workers_keep(a->workers);
    }
}

/* Also undoes a start that failed half way: every part may be missing. */
void app_stop(struct app *a)
{
    if (a->service != NULL) {
        service_impl_stop(a->service);
    }
    if (a->http != NULL) {
        http_quiesce(a->http);
    }
    workers_stop(a->workers); /* running jobs go back to the queue */
    writer_stop(a->writer);   /* every outstanding write is answered */
    http_stop(a->http);       /* the answers are out */
    writer_destroy(a->writer);
    service_impl_destroy(a->service);
    shelf_impl_destroy(a->shelf);
    dispatch_destroy(a->dispatch);
    library_destroy(a->library);
    store_close(a->store);
    free(a);
}

#include "server/http.h"

#include "server/clock.h"
#include "server/http_listen.h"
#include "server/http_watch.h"
#include "server/uri.h"

#include <microhttpd.h>
#include <pthread.h>
#include <stdatomic.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <strings.h>
#include <time.h>
#include <unistd.h>

enum {
    CONNECTIONS_MAX = 1024,
    CONNECTION_MEMORY = 32 * 1024, /* request line and header: 431 beyond it */
    IDLE_S = 30,
    DRAIN_S = 5,
    BODY_FIRST = 4096 /* first allocation for a body of unknown size */
};

struct http_server {
    const struct api *api;
    const struct log *log;
    struct MHD_Daemon *daemon;
    struct http_watch *watch;
    int listen_fd;         /* once quiesced: ours to close */
    atomic_bool quiescing; /* connections are closed after their current request */
    atomic_int open;       /* requests whose header has come and whose answer is not sent */
    char url[128];
};

/* One request on a connection, from its first line until the answer is sent. The connection's
 * thread owns it; `mutex` guards what the answering thread touches. */
struct request {
    struct api_reply reply; /* first member: the router hands it back */
    struct http_server *server;
    struct MHD_Connection *connection;
    struct watched *watched;
    char *target; /* raw; cut up by uri_split */
    bool started; /* the header has been looked at */
    bool routed;
    bool too_large;
    size_t body_max, body_size, body_room;
    char *body;

    pthread_mutex_t mutex; /* guards the rest */
    bool suspended;
    bool answered;
    struct api_response response;
};

/* -- answers ---------------------------------------------------------------------------- */

/* Called once for each routed request, from any thread. The request stays until the library has
 * sent the answer, and that cannot be before the mutex is released. */
static void reply_send(struct api_reply *reply, struct api_response *response)
{
    struct request *r = (struct request *)reply;
    (void)pthread_mutex_lock(&r->mutex);
    r->response = *response;
    r->answered = true;
    if (r->suspended) {
        r->suspended = false;
        MHD_resume_connection(r->connection);
    }
    (void)pthread_mutex_unlock(&r->mutex);
    response->body = NULL; /* taken over */
    response->body_size = 0;
}

static enum MHD_Result queue_response(struct request *r, bool close)
{
    struct api_response *res = &r->response;
    struct MHD_Response *m =
        MHD_create_response_from_buffer(res->body_size, res->body, MHD_RESPMEM_MUST_FREE);
    if (m == NULL) {
        api_response_done(res);
        return MHD_NO;
    }
    res->body = NULL; /* freed with the response */
    if (res->content_type[0] != '\0') {
        (void)MHD_add_response_header(m, MHD_HTTP_HEADER_CONTENT_TYPE, res->content_type);
    }
    for (int i = 0; i < res->n_header; i++) {
        (void)MHD_add_response_header(m, res->header[i].name, res->header[i].value);
    }
    if (close || atomic_load(&r->server->quiescing)) {
        (void)MHD_add_response_header(m, MHD_HTTP_HEADER_CONNECTION, "close");
    }
    const enum MHD_Result ok = MHD_queue_response(r->connection, (unsigned)res->status, m);
    MHD_destroy_response(m);
    return ok;
}

/* An answer of the adaptor's own; the connection is closed because its framing is in doubt. */
static enum MHD_Result refuse(struct request *r, int status, const char *code, const char *detail)
{
    LOG(r->server->log, LOG_LEVEL_WARN, "http_refused", log_i("status", status),
        log_s("code", code));
    memset(&r->response, 0, sizeof r->response);
    router_problem(&r->response, status, code, detail);
    return queue_response(r, true);
}

/* -- requests --------------------------------------------------------------------------- */

struct header_count {
    int content_length, transfer_encoding, host;
};

static enum MHD_Result count_header(void *arg, enum MHD_ValueKind kind, const char *key,
                                    const char *value)
{
    (void)kind;
    (void)value;
    struct header_count *n = arg;
    n->content_length += strcasecmp(key, MHD_HTTP_HEADER_CONTENT_LENGTH) == 0;
    n->transfer_encoding += strcasecmp(key, MHD_HTTP_HEADER_TRANSFER_ENCODING) == 0;
    n->host += strcasecmp(key, MHD_HTTP_HEADER_HOST) == 0;
    return MHD_YES;
}

static const char *header(const struct request *r, const char *name)
{
    return MHD_lookup_connection_value(r->connection, MHD_HEADER_KIND, name);
}

/* What the library accepts but a proxy in front of us might read differently. NULL: fine. */
static const char *bad_framing(const struct request *r, const char *version)
{
    struct header_count n = {0};
    (void)MHD_get_connection_values(r->connection, MHD_HEADER_KIND, count_header, &n);
    if (n.content_length > 1) {
        return "more than one Content-Length";
    }
    if (n.content_length > 0 && n.transfer_encoding > 0) {
        return "Content-Length together with Transfer-Encoding";
    }
    if (n.transfer_encoding > 1 ||
        (n.transfer_encoding == 1 &&
         strcasecmp(header(r, MHD_HTTP_HEADER_TRANSFER_ENCODING), "chunked") != 0)) {
        return "a Transfer-Encoding other than chunked";
    }
    if (n.host > 1 || (n.host == 0 && strcmp(version, MHD_HTTP_VERSION_1_1) == 0)) {
        return "not exactly one Host";
    }
    return NULL;
}

/* First look at a request: its header is complete. */
static enum MHD_Result start_request(struct request *r, const char *method, const char *version)
{
    r->started = true;
    atomic_fetch_add(&r->server->open, 1);
    const char *problem = bad_framing(r, version);
    if (problem != NULL) {
        return refuse(r, MHD_HTTP_BAD_REQUEST, "bad_framing", problem);
    }
    const size_t path_size = strcspn(r->target, "?");
    char path[256];
    (void)snprintf(path, sizeof path, "%.*s", path_size < 255 ? (int)path_size : 255, r->target);
    r->body_max = router_body_max(method, path);
    const char *length = header(r, MHD_HTTP_HEADER_CONTENT_LENGTH);
    if (length != NULL && strtoull(length, NULL, 10) > r->body_max) {
        return refuse(r, MHD_HTTP_CONTENT_TOO_LARGE, "body_too_large",
                      "the body is larger than this resource accepts");
    }
    http_watch_body(r->server->watch, r->watched, r->body_max);
    return MHD_YES;
}

/* Appends a piece of the body; past the limit it is only counted. False: give up. */
static bool take_body(struct request *r, const char *data, size_t size)
{
    if (r->too_large || size > r->body_max - r->body_size) {
        r->too_large = true;
        free(r->body);
        r->body = NULL;
        r->body_size += size < SIZE_MAX - r->body_size ? size : 0;
        return r->body_size / 4 <= r->body_max; /* reads on a little, for a clean refusal */
    }
    if (r->body_size + size > r->body_room) {
        size_t room = r->body_room > 0 ? 2 * r->body_room : BODY_FIRST;
        room = room < r->body_size + size ? r->body_size + size : room;
        char *body = realloc(r->body, room);
        if (body == NULL) {
            return false;
        }
        r->body = body;
        r->body_room = room;
    }
    memcpy(r->body + r->body_size, data, size);
    r->body_size += size;
    return true;
}

/* The request is complete: hands it to the router and suspends unless the answer is there. */
static enum MHD_Result route_request(struct request *r, const char *method)
{
    r->routed = true;
    http_watch_answer(r->server->watch, r->watched);
    if (r->too_large) {
        return refuse(r, MHD_HTTP_CONTENT_TOO_LARGE, "body_too_large",
                      "the body is larger than this resource accepts");
    }
    struct api_request req = {.method = method,
                              .content_type = header(r, MHD_HTTP_HEADER_CONTENT_TYPE),
                              .accept = header(r, MHD_HTTP_HEADER_ACCEPT),
                              .if_none_match = header(r, MHD_HTTP_HEADER_IF_NONE_MATCH),
                              .body = r->body,
                              .body_size = r->body_size};
    const enum uri_status uri = uri_split(r->target, &req);
    if (uri != URI_OK) {
        return refuse(r, MHD_HTTP_BAD_REQUEST, "bad_target",
                      uri == URI_BAD ? "the path or the query is malformed"
                                     : "the query has too many items");
    }
    router_handle(r->server->api, &req, &r->reply);

    (void)pthread_mutex_lock(&r->mutex);
    const bool answered = r->answered;
    if (!answered) {
        r->suspended = true;
        MHD_suspend_connection(r->connection);
    }
    (void)pthread_mutex_unlock(&r->mutex);
    return answered ? queue_response(r, false) : MHD_YES;
}

static enum MHD_Result on_access(void *arg, struct MHD_Connection *connection, const char *url,
                                 const char *method, const char *version, const char *upload_data,
                                 size_t *upload_data_size, void **state)
{
    (void)arg;
    (void)url;
    struct request *r = *state;
    if (r == NULL) {
        return MHD_NO; /* no memory when the request line came */
    }
    if (!r->started) {
        r->connection = connection;
        const union MHD_ConnectionInfo *info =
            MHD_get_connection_info(connection, MHD_CONNECTION_INFO_SOCKET_CONTEXT);
        r->watched = info != NULL ? info->socket_context : NULL;
        return start_request(r, method, version);
    }
    if (*upload_data_size > 0) {
        const bool ok = take_body(r, upload_data, *upload_data_size);
        *upload_data_size = 0;
        return ok ? MHD_YES : MHD_NO;
    }
    if (!r->routed) {
        return route_request(r, method);
    }
    (void)pthread_mutex_lock(&r->mutex); /* waits until reply_send has let go of the request */
    const bool answered = r->answered;
    (void)pthread_mutex_unlock(&r->mutex);
    return answered ? queue_response(r, false) : MHD_YES;
}

/* The request line has come; what is returned is the request's state from here on. */
static void *on_target(void *arg, const char *target, struct MHD_Connection *connection)
{
    struct request *r = calloc(1, sizeof *r);
    char *copy = strdup(target);
    if (r == NULL || copy == NULL) {
        free(r);
        free(copy);
        return NULL;
    }
    r->reply.send = reply_send;
    r->server = arg;
    r->connection = connection;
    r->target = copy;
    (void)pthread_mutex_init(&r->mutex, NULL);
    return r;
}

static void on_completed(void *arg, struct MHD_Connection *connection, void **state,
                         enum MHD_RequestTerminationCode code)
{
    (void)arg;
    (void)connection;
    (void)code;
    struct request *r = *state;
    if (r == NULL) {
        return;
    }
    http_watch_next(r->server->watch, r->watched);
    if (r->started) {
        atomic_fetch_sub(&r->server->open, 1);
    }
    (void)pthread_mutex_lock(&r->mutex);
    (void)pthread_mutex_unlock(&r->mutex);
    (void)pthread_mutex_destroy(&r->mutex);
    api_response_done(&r->response);
    free(r->body);
    free(r->target);
    free(r);
    *state = NULL;
}

static void on_connection(void *arg, struct MHD_Connection *connection, void **socket_context,
                          enum MHD_ConnectionNotificationCode code)
{
    struct http_server *h = arg;
    if (code == MHD_CONNECTION_NOTIFY_STARTED) {
        const union MHD_ConnectionInfo *info =
            MHD_get_connection_info(connection, MHD_CONNECTION_INFO_CONNECTION_FD);
        *socket_context = info != NULL ? http_watch_open(h->watch, info->connect_fd) : NULL;
    } else {
        http_watch_close(h->watch, *socket_context);
        *socket_context = NULL;
    }
}

/* Leaves escapes alone: the router wants the raw path, uri_split decodes the query. */
static size_t keep_escapes(void *arg, struct MHD_Connection *connection, char *text)
{
    (void)arg;
    (void)connection;
    return strlen(text);
}

/* -- life ------------------------------------------------------------------------------- */

static struct MHD_Daemon *start_daemon(struct http_server *h,
                                       const struct sockaddr_storage *address, int threads)
{
    unsigned flags = MHD_USE_EPOLL_INTERNAL_THREAD | MHD_ALLOW_SUSPEND_RESUME | MHD_USE_ITC;
    if (address->ss_family == AF_INET6) {
        flags |= MHD_USE_IPv6;
    }
    const struct MHD_OptionItem pool[] = {
        {threads > 1 ? MHD_OPTION_THREAD_POOL_SIZE : MHD_OPTION_END, threads, NULL},
        {MHD_OPTION_END, 0, NULL},
    };
    return MHD_start_daemon(
        flags, 0, NULL, NULL, on_access, h, MHD_OPTION_SOCK_ADDR, (const void *)address,
        MHD_OPTION_URI_LOG_CALLBACK, on_target, h, MHD_OPTION_UNESCAPE_CALLBACK, keep_escapes, NULL,
        MHD_OPTION_NOTIFY_COMPLETED, on_completed, NULL, MHD_OPTION_NOTIFY_CONNECTION,
        on_connection, h, MHD_OPTION_CONNECTION_LIMIT, (unsigned)CONNECTIONS_MAX,
        MHD_OPTION_CONNECTION_MEMORY_LIMIT, (size_t)CONNECTION_MEMORY,
        MHD_OPTION_CONNECTION_TIMEOUT, (unsigned)IDLE_S, MHD_OPTION_STRICT_FOR_CLIENT, 1,
        MHD_OPTION_LISTENING_ADDRESS_REUSE, 1U, MHD_OPTION_ARRAY, pool, MHD_OPTION_END);
}

struct http_server *http_start(const struct http_config *config, const struct api *api,
                               const struct log *log, char *why, size_t size)
{
    struct sockaddr_storage address;
    socklen_t address_size = 0;
    if (!listen_parse(config->listen, &address, &address_size)) {
        (void)snprintf(why, size, "listen '%s' is not of the form ADDRESS:PORT", config->listen);
        return NULL;
    }
    struct http_server *h = calloc(1, sizeof *h);
    if (h == NULL) {
        (void)snprintf(why, size, "out of memory");
        return NULL;
    }
    h->api = api;
    h->log = log;
    h->listen_fd = -1;
    h->watch = http_watch_create();
    h->daemon = h->watch != NULL ? start_daemon(h, &address, config->threads) : NULL;
    if (h->daemon == NULL) {
        (void)snprintf(why, size, "cannot listen on %s: is the port free?", config->listen);
        http_stop(h);
        return NULL;
    }
    const union MHD_DaemonInfo *info = MHD_get_daemon_info(h->daemon, MHD_DAEMON_INFO_BIND_PORT);
    listen_url(&address, info != NULL ? info->port : 0, h->url, sizeof h->url);
    if (!listen_is_loopback(&address)) {
        LOG(log, LOG_LEVEL_WARN, "listen_public", log_s("url", h->url),
            log_s("note", "no encryption and no tokens: put a proxy in front"));
    }
    return h;
}

const char *http_url(const struct http_server *h)
{
    return h->url;
}

void http_tick(struct http_server *h)
{
    const int late = http_watch_tick(h->watch, clock_mono_us());
    if (late > 0) {
        LOG(h->log, LOG_LEVEL_WARN, "http_late", log_i("connections", late));
    }
}

void http_quiesce(struct http_server *h)
{
    if (!atomic_exchange(&h->quiescing, true)) {
        h->listen_fd = MHD_quiesce_daemon(h->daemon);
    }
}

/* Lets the last answers go out; a client that does not read them is not waited for. */
static void drain(const struct http_server *h)
{
    const int64_t until = clock_mono_us() + DRAIN_S * INT64_C(1000000);
    const struct timespec t = {.tv_nsec = 2000000};
    while (atomic_load(&h->open) > 0 && clock_mono_us() < until) {
        (void)nanosleep(&t, NULL);
    }
}

void http_stop(struct http_server *h)
{
    if (h == NULL) {
        return;
    }
    drain(h);
    if (h->daemon != NULL) {
        MHD_stop_daemon(h->daemon);
    }
    if (h->listen_fd >= 0) {
        (void)close(h->listen_fd);
    }
    http_watch_destroy(h->watch);
    free(h);
}

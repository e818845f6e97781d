#include "server/port.h"

enum service_status port_status(enum store_status st)
{
    switch (st) {
    case STORE_OK:
        return SERVICE_OK;
    case STORE_NONE:
        return SERVICE_NOT_FOUND;
    case STORE_NOT_READY:
        return SERVICE_NOT_READY;
    case STORE_FULL:
        return SERVICE_DISK_FULL;
    case STORE_CONFLICT:
    case STORE_LOCKED:
    case STORE_REFUSED:
    case STORE_CORRUPT:
    case STORE_ERROR:
        break;
    }
    return SERVICE_ERROR;
}

struct store_session *port_take(struct store *store, const struct log *log)
{
    struct store_session *r = store->ops->reader_take(store);
    if (r == NULL) {
        LOG(log, LOG_LEVEL_ERROR, "read_failed", log_s("message", "no reader can be opened"));
    }
    return r;
}

enum service_status port_give(struct store *store, const struct log *log, struct store_session *r,
                              enum store_status st)
{
    const enum service_status status = port_status(st);
    if (status == SERVICE_ERROR) {
        LOG(log, LOG_LEVEL_ERROR, "read_failed", log_i("status", st),
            log_s("message",
                  st == STORE_CORRUPT ? "stored data fail their check" : r->ops->message(r)));
    }
    store->ops->reader_give(store, r);
    return status;
}

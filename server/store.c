#include "server/store.h"

#include <stdio.h>
#include <string.h>

/* The back ends, by the scheme of the URL. */
enum store_status sqlite_store_open(const char *path, struct store **out, char why[STORE_MESSAGE]);

static const struct {
    const char *scheme;
    enum store_status (*open)(const char *location, struct store **out, char *why);
} backends[] = {
    {"sqlite:", sqlite_store_open},
};

enum store_status store_open(const char *url, struct store **out, char why[STORE_MESSAGE])
{
    for (size_t i = 0; i < sizeof backends / sizeof backends[0]; i++) {
        const size_t n = strlen(backends[i].scheme);
        if (strncmp(url, backends[i].scheme, n) == 0 && url[n] != '\0') {
            return backends[i].open(url + n, out, why);
        }
    }
    (void)snprintf(why, STORE_MESSAGE, "store '%.200s' is not of the form sqlite:PATH", url);
    return STORE_REFUSED;
}

void store_close(struct store *st)
{
    if (st != NULL) {
        st->ops->close(st);
    }
}

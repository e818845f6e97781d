#include "server/http_listen.h"

#include <arpa/inet.h>
#include <netinet/in.h>
#include <stdio.h>
#include <string.h>

bool listen_parse(const char *text, struct sockaddr_storage *out, socklen_t *size)
{
    const char *colon = strrchr(text, ':');
    if (colon == NULL || colon == text || colon[1] == '\0') {
        return false;
    }
    size_t n = (size_t)(colon - text);
    const bool bracket = text[0] == '[' && n >= 2 && text[n - 1] == ']';
    const char *start = bracket ? text + 1 : text;
    n -= bracket ? 2 : 0;
    char host[128];
    if (n == 0 || n >= sizeof host || (!bracket && memchr(start, ':', n) != NULL)) {
        return false;
    }
    memcpy(host, start, n);
    host[n] = '\0';

    const char *numeric = strcmp(host, "localhost") == 0 ? "127.0.0.1" : host;
    const struct addrinfo hints = {.ai_socktype = SOCK_STREAM,
                                   .ai_flags = AI_NUMERICHOST | AI_NUMERICSERV | AI_PASSIVE};
    struct addrinfo *found = NULL;
    if (getaddrinfo(numeric, colon + 1, &hints, &found) != 0) {
        return false;
    }
    memset(out, 0, sizeof *out);
    memcpy(out, found->ai_addr, found->ai_addrlen);
    *size = found->ai_addrlen;
    freeaddrinfo(found);
    return true;
}

bool listen_is_loopback(const struct sockaddr_storage *address)
{
    if (address->ss_family == AF_INET6) {
        struct sockaddr_in6 v6;
        memcpy(&v6, address, sizeof v6);
        return memcmp(&v6.sin6_addr, &in6addr_loopback, sizeof v6.sin6_addr) == 0;
    }
    struct sockaddr_in v4;
    memcpy(&v4, address, sizeof v4);
    return ntohl(v4.sin_addr.s_addr) >> 24 == 127;
}

void listen_url(const struct sockaddr_storage *address, unsigned port, char *out, size_t size)
{
    char host[INET6_ADDRSTRLEN] = "";
    if (address->ss_family == AF_INET6) {
        struct sockaddr_in6 v6;
        memcpy(&v6, address, sizeof v6);
        (void)inet_ntop(AF_INET6, &v6.sin6_addr, host, sizeof host);
        (void)snprintf(out, size, "http://[%s]:%u", host, port);
        return;
    }
    struct sockaddr_in v4;
    memcpy(&v4, address, sizeof v4);
    (void)inet_ntop(AF_INET, &v4.sin_addr, host, sizeof host);
    (void)snprintf(out, size, "http://%s:%u", host, port);
}

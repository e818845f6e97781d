/* server/http_listen.h
 * Addresses to listen on. Pure functions but for the name lookup of "localhost". */
#ifndef AEROM_SERVER_HTTP_LISTEN_H
#define AEROM_SERVER_HTTP_LISTEN_H

#include <netdb.h>
#include <stdbool.h>
#include <stddef.h>
#include <sys/socket.h>

/* Parses "ADDRESS:PORT" or "[ADDRESS]:PORT" to a socket address. */
bool listen_parse(const char *text, struct sockaddr_storage *out, socklen_t *size);
/* True when only this machine can reach the address. */
bool listen_is_loopback(const struct sockaddr_storage *address);
/* "http://ADDRESS:PORT" with the given port. */
void listen_url(const struct sockaddr_storage *address, unsigned port, char *out, size_t size);

#endif

/* server/log.h
 * The log of the process: one line for each event on a file descriptor,
 *   2026-01-31T12:00:00.123456Z info job_done id=0190... cpu_s=0.21
 * Values with spaces or quotes are quoted. A line is one write(2), so lines of several threads do
 * not mix. A struct log is immutable after log_init and shared by all threads. */
#ifndef AEROM_SERVER_LOG_H
#define AEROM_SERVER_LOG_H

#include <stdbool.h>

enum log_level { LOG_LEVEL_ERROR, LOG_LEVEL_WARN, LOG_LEVEL_INFO, LOG_LEVEL_DEBUG };

struct log {
    int fd;
    enum log_level level; /* lines above it are dropped */
};

struct log_field {
    const char *key; /* NULL ends a list */
    const char *text;
    long long integer;
    double real;
    char kind; /* 't' 'i' 'r' */
};

static inline struct log_field log_s(const char *key, const char *value)
{
    return (struct log_field){.key = key, .text = value, .kind = 't'};
}

static inline struct log_field log_i(const char *key, long long value)
{
    return (struct log_field){.key = key, .integer = value, .kind = 'i'};
}

static inline struct log_field log_f(const char *key, double value)
{
    return (struct log_field){.key = key, .real = value, .kind = 'r'};
}

/* "error" "warn" "info" "debug". */
bool log_level_parse(const char *name, enum log_level *out);

/* LOG(log, LOG_LEVEL_INFO, "job_done", log_s("id", id), log_f("cpu_s", t)); at least one field. */
#define LOG(log, level, event, ...)                                                                \
    log_write(log, level, event, (const struct log_field[]){__VA_ARGS__, {.key = (const char *)0}})

void log_write(const struct log *log, enum log_level level, const char *event,
               const struct log_field *field);

#endif

#include "server/log.h"

#include <stdio.h>
#include <string.h>
#include <sys/time.h>
#include <time.h>
#include <unistd.h>

enum { LINE_SIZE = 2048 };

static const char *const level_names[] = {
    [LOG_LEVEL_ERROR] = "error",
    [LOG_LEVEL_WARN] = "warn",
    [LOG_LEVEL_INFO] = "info",
    [LOG_LEVEL_DEBUG] = "debug",
};

struct line {
    char text[LINE_SIZE];
    size_t used;
};

static void put_char(struct line *l, char c)
{
    if (l->used < LINE_SIZE - 1) { /* one place is kept for the line end */
        l->text[l->used++] = c;
    }
}

static void put_text(struct line *l, const char *s)
{
    for (; *s != '\0'; s++) {
        put_char(l, *s);
    }
}

/* Control characters are escaped: a value can never start a line of its own. */
static void put_value(struct line *l, const char *s)
{
    const bool quote = *s == '\0' || strpbrk(s, " \"=\\\n\r\t") != NULL;
    if (!quote) {
        put_text(l, s);
        return;
    }
    put_char(l, '"');
    for (; *s != '\0'; s++) {
        const unsigned char c = (unsigned char)*s;
        if (c == '"' || c == '\\') {
            put_char(l, '\\');
            put_char(l, *s);
        } else if (c < 0x20 || c == 0x7f) {
            char escape[8];
            (void)snprintf(escape, sizeof escape, "\\x%02x", c);
            put_text(l, escape);
        } else {
            put_char(l, *s);
        }
    }
    put_char(l, '"');
}

static void put_time(struct line *l)
{
    struct timeval now = {0};
    (void)gettimeofday(&now, NULL);
    struct tm utc = {0};
    (void)gmtime_r(&now.tv_sec, &utc);
    char text[40];
    const size_t n = strftime(text, sizeof text, "%Y-%m-%dT%H:%M:%S", &utc);
    (void)snprintf(text + n, sizeof text - n, ".%06ldZ", (long)now.tv_usec);
    put_text(l, text);
}

bool log_level_parse(const char *name, enum log_level *out)
{
    for (size_t i = 0; i < sizeof level_names / sizeof level_names[0]; i++) {
        if (strcmp(name, level_names[i]) == 0) {
            *out = (enum log_level)i;
            return true;
        }
    }
    return false;
}

void log_write(const struct log *log, enum log_level level, const char *event,
               const struct log_field *field)
{
    if (level > log->level) {
        return;
    }
    struct line l = {.used = 0};
    put_time(&l);
    put_char(&l, ' ');
    put_text(&l, level_names[level]);
    put_char(&l, ' ');
    put_text(&l, event);
    for (; field->key != NULL; field++) {
        char number[40];
        put_char(&l, ' ');
        put_text(&l, field->key);
        put_char(&l, '=');
        if (field->kind == 't') {
            put_value(&l, field->text);
            continue;
        }
        if (field->kind == 'i') {
            (void)snprintf(number, sizeof number, "%lld", field->integer);
        } else {
            (void)snprintf(number, sizeof number, "%.6g", field->real);
        }
        put_text(&l, number);
    }
    l.text[l.used++] = '\n';
    const ssize_t written = write(log->fd, l.text, l.used);
    (void)written; /* nowhere left to report a log that cannot be written */
}

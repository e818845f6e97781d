#include "api/reader.h"

#include "api/json.h"

#include <assert.h>
#include <stdarg.h>
#include <stdio.h>
#include <string.h>

void reader_init(struct reader *r, const char *prefix, struct failure_list *problems)
{
    assert(problems != NULL);
    *r = (struct reader){.problems = problems, .kind = (unsigned)READER_ALL};
    (void)snprintf(r->pointer, sizeof r->pointer, "%s", prefix);
    r->length = strlen(r->pointer);
}

static void append(struct reader *r, char c)
{
    if (r->length + 1 < sizeof r->pointer) {
        r->pointer[r->length++] = c;
        r->pointer[r->length] = '\0';
    }
}

size_t reader_enter_key(struct reader *r, const char *key)
{
    const size_t mark = r->length;
    append(r, '/');
    for (const char *c = key; *c != '\0'; c++) {
        if (*c == '~' || *c == '/') { /* RFC 6901 */
            append(r, '~');
            append(r, *c == '~' ? '0' : '1');
        } else {
            append(r, *c);
        }
    }
    return mark;
}

size_t reader_enter_index(struct reader *r, int index)
{
    char text[16];
    (void)snprintf(text, sizeof text, "%d", index);
    return reader_enter_key(r, text);
}

void reader_leave(struct reader *r, size_t mark)
{
    assert(mark <= r->length);
    r->length = mark;
    r->pointer[mark] = '\0';
}

void reader_problem(struct reader *r, const char *code, const char *expected,
                    const struct cJSON *got, const char *detail, ...)
{
    char text[sizeof((struct failure *)0)->detail];
    char got_text[sizeof((struct failure *)0)->got] = "";
    va_list args;
    va_start(args, detail);
    (void)vsnprintf(text, sizeof text, detail, args);
    va_end(args);
    if (got != NULL) {
        json_describe(got, sizeof got_text, got_text);
    }
    failure_set(failure_add(r->problems), ST_INVALID, r->pointer, code, expected, got_text, "%s",
                text);
}

void reader_no_memory(struct reader *r)
{
    failure_set(failure_add(r->problems), ST_NO_MEMORY, r->pointer, status_name(ST_NO_MEMORY), NULL,
                NULL, "%s", status_text(ST_NO_MEMORY));
}

bool reader_ran_out_of_memory(const struct failure_list *problems)
{
    for (int i = 0; i < problems->count; i++) {
        if (problems->item[i].status == ST_NO_MEMORY) {
            return true;
        }
    }
    return false;
}

void reader_join(const char *const *names, size_t size, char *out)
{
    static const char more[] = ", ...";
    size_t used = 0;
    assert(size > sizeof more);
    out[0] = '\0';
    for (int i = 0; names[i] != NULL; i++) {
        const size_t need = strlen(names[i]) + 4; /* quotes, comma, space */
        if (used + need + sizeof more > size) {
            memcpy(out + used, more, sizeof more);
            return;
        }
        used += (size_t)snprintf(out + used, size - used, "%s\"%s\"", i > 0 ? ", " : "", names[i]);
    }
}

#include "core/status.h"

#include <assert.h>
#include <stdarg.h>
#include <stdio.h>
#include <string.h>

static const struct {
    const char *name;
    const char *text;
} status_table[STATUS_COUNT] = {
#define STATUS_ROW(code, name, text) [code] = {name, text},
    STATUS_LIST(STATUS_ROW)
#undef STATUS_ROW
};

const char *status_name(enum status st)
{
    assert((unsigned)st < STATUS_COUNT);
    return status_table[st].name;
}

const char *status_text(enum status st)
{
    assert((unsigned)st < STATUS_COUNT);
    return status_table[st].text;
}

static void copy_text(char *to, size_t size, const char *from)
{
    (void)snprintf(to, size, "%s", from != NULL ? from : "");
}

void failure_set(struct failure *f, enum status st, const char *pointer, const char *code,
                 const char *expected, const char *got, const char *detail, ...)
{
    assert(f != NULL);
    f->status = st;
    copy_text(f->pointer, sizeof f->pointer, pointer);
    copy_text(f->code, sizeof f->code, code);
    copy_text(f->expected, sizeof f->expected, expected);
    copy_text(f->got, sizeof f->got, got);
    va_list args;
    va_start(args, detail);
    (void)vsnprintf(f->detail, sizeof f->detail, detail, args);
    va_end(args);
}

struct failure *failure_add(struct failure_list *list)
{
    assert(list != NULL);
    list->total++;
    if (list->count < FAILURE_LIST_MAX) {
        list->count++;
    }
    /* Once full, the last item is overwritten: the count of all is still right. */
    return &list->item[list->count - 1];
}

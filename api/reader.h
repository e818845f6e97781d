/* api/reader.h
 * Where a document is being read, and the list its problems go to. A value on the stack of one
 * thread; the list is borrowed. */
#ifndef AEROM_API_READER_H
#define AEROM_API_READER_H

#include "core/status.h"

#include <stdbool.h>
#include <stddef.h>

struct cJSON;

enum { READER_ALL = ~0 };

struct reader {
    struct failure_list *problems;
    /* Required fields are asked for only where their `kinds` share a bit with this; 0 waives all,
     * READER_ALL asks for all. */
    unsigned kind;
    void *context; /* of the field tables' own functions */
    size_t length;
    char pointer[160]; /* JSON pointer of the value being read, cut when longer */
};

/* Starts at `prefix`, a JSON pointer, "" for a whole document. */
void reader_init(struct reader *r, const char *prefix, struct failure_list *problems);

/* One step down; the result goes to reader_leave. */
size_t reader_enter_key(struct reader *r, const char *key);
size_t reader_enter_index(struct reader *r, int index);
void reader_leave(struct reader *r, size_t mark);

/* Reports a problem at the present place. `expected` and `got` may be NULL. */
void reader_problem(struct reader *r, const char *code, const char *expected,
                    const struct cJSON *got, const char *detail, ...)
    __attribute__((format(printf, 5, 6)));

/* Reports that memory ran out: a failure of ours (ST_NO_MEMORY), not of the document. */
void reader_no_memory(struct reader *r);
/* Whether a list holds such a report. */
bool reader_ran_out_of_memory(const struct failure_list *problems);

/* "a", "b" and so on into a text of at most `size` bytes, cut with "..." at a whole name. */
void reader_join(const char *const *names, size_t size, char *out);

#endif

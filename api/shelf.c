#include "api/shelf.h"

#include <assert.h>
#include <stdlib.h>
#include <string.h>

const char *shelf_kind_name(enum shelf_kind kind)
{
    static const char *const names[SHELF_KINDS] = {"material", "polar", "network", "dataset"};
    assert((unsigned)kind < SHELF_KINDS);
    return names[kind];
}

void shelf_entry_done(struct shelf_entry *e)
{
    free(e->head);
    free(e->data);
    *e = (struct shelf_entry){0};
}

void shelf_entries_done(struct shelf_entry *list, int n)
{
    for (int i = 0; i < n; i++) {
        shelf_entry_done(&list[i]);
    }
    free(list);
}

bool shelf_reference(const char *text, char name[LIMIT_NAME], int *version)
{
    enum { DIGITS_MAX = 9 };
    const char *at = strrchr(text, '@');
    const size_t n = at != NULL ? (size_t)(at - text) : strlen(text);
    long v = 0;
    if (at != NULL) {
        const size_t digits = strspn(at + 1, "0123456789");
        v = strtol(at + 1, NULL, 10);
        if (digits == 0 || digits > DIGITS_MAX || at[1 + digits] != '\0' || v == 0) {
            return false;
        }
    }
    if (n == 0 || n >= LIMIT_NAME) {
        return false;
    }
    memcpy(name, text, n);
    name[n] = '\0';
    *version = (int)v;
    return true;
}

bool shelf_name_is_allowed(const char *name)
{
    const size_t n = strlen(name);
    return n > 0 && n < LIMIT_NAME &&
           strspn(name, "abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ0123456789._+/-") == n;
}

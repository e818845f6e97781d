#include "tests/api/parsing.h"

#include <stdlib.h>
#include <string.h>

int parsing_setup(void **state)
{
    struct failure fail;
    struct fixture *f = calloc(1, sizeof *f);
    f->problems = calloc(1, sizeof *f->problems);
    if (library_create_builtin(&f->lib, &fail) != ST_OK) {
        print_error("%s\n", fail.detail);
        return -1;
    }
    *state = f;
    return 0;
}

int parsing_teardown(void **state)
{
    struct fixture *f = *state;
    library_destroy(f->lib);
    free(f->problems);
    free(f);
    return 0;
}

struct api_case *parse(struct fixture *f, const char *json)
{
    struct api_case *c = NULL;
    f->problems->count = f->problems->total = 0;
    const enum status st = api_case_parse(f->lib, json, strlen(json), "", &c, f->problems);
    assert_int_equal(st == ST_OK, c != NULL);
    assert_int_equal(st == ST_OK, f->problems->total == 0);
    return c;
}

struct api_case *parse_good(struct fixture *f, const char *json)
{
    struct api_case *c = parse(f, json);
    if (c == NULL) {
        fail_msg("%s %s: %s", f->problems->item[0].pointer, f->problems->item[0].code,
                 f->problems->item[0].detail);
    }
    return c;
}

void assert_stable(struct fixture *f, const char *json)
{
    struct api_case *first = parse_good(f, json);
    struct api_case *second = parse_good(f, api_case_canonical(first));
    assert_string_equal(api_case_canonical(first), api_case_canonical(second));
    assert_string_equal(api_case_hash(first), api_case_hash(second));
    assert_int_equal(strlen(api_case_hash(first)), 64);
    api_case_destroy(first);
    api_case_destroy(second);
}

void assert_all_refused(struct fixture *f, size_t n, const struct bad_case *bad)
{
    for (size_t i = 0; i < n; i++) {
        const struct bad_case *b = &bad[i];
        assert_null(parse(f, b->json));
        const struct failure *p = &f->problems->item[0];
        if (f->problems->total != 1 || strcmp(p->pointer, b->pointer) != 0 ||
            strcmp(p->code, b->code) != 0) {
            fail_msg("case %zu: expected one problem %s at \"%s\", found %d: %s at \"%s\" (%s)", i,
                     b->code, b->pointer, f->problems->total, p->code, p->pointer, p->detail);
        }
        assert_true(p->detail[0] != '\0');
    }
}

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

#include "tests/verify/built.h"

#include "api/case.h"
#include "api/library.h"
#include "core/la.h"
#include "core/num.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

static void require(enum status st, const char *what, const struct failure *fail)
{
    if (st != ST_OK) {
        (void)fprintf(stderr, "%s: %s: %s\n", what, status_name(st),
                      fail != NULL ? fail->detail : "");
        exit(EXIT_FAILURE);
    }
}

void built_model(const struct case_def *def, struct model *out)
{
    struct failure fail = {0};
    require(model_build(def, out, &fail), def->name, &fail);
}

double built_frequency(const struct model *m, int share, int number)
{
    for (int j = 0; j < m->modes.n_mode; j++) {
        const double *s = m->modes.share + (size_t)j * MODE_SHARES;
        int largest = 0;
        for (int f = 1; f < MODE_SHARES; f++) {
            largest = s[f] > s[largest] ? f : largest;
        }
        if (largest == share && number-- == 0) {
            return m->modes.omega[j] / (2.0 * NUM_PI);
        }
    }
    return (double)NAN;
}

double *built_static(const struct model *m, const double *f)
{
    const size_t n = (size_t)m->beam.n_dof;
    double *x = malloc(n * sizeof *x), *k = malloc(n * n * sizeof *k);
    require(x != NULL && k != NULL ? ST_OK : ST_NO_MEMORY, "built_static", NULL);
    memcpy(x, f, n * sizeof *x);
    memcpy(k, m->beam.k, n * n * sizeof *k);
    require(la_solve_symmetric(m->beam.n_dof, k, 1, x), "built_static", NULL);
    free(k);
    return x;
}

void built_section(const struct shape *shape, struct model *out)
{
    static struct case_def def; /* large */
    case_def_defaults(&def);
    def.kind = CASE_SECTION;
    def.beam.section.shape = *shape;
    built_model(&def, out);
}

void built_answer(const struct model *m, struct static_result *out)
{
    require(statics_run(m, out), m->def.name, NULL);
}

struct beam_motion built_tip(const struct case_def *def)
{
    struct model m;
    struct static_result r;
    built_model(def, &m);
    built_answer(&m, &r);
    const struct beam_motion tip = r.tip;
    statics_done(&r);
    model_done(&m);
    return tip;
}

double built_hz(const struct model *m, int j)
{
    return m->modes.omega[j] / (2.0 * NUM_PI);
}

struct sim *built_run(const struct case_def *def)
{
    struct failure fail = {0};
    struct sim *sim = NULL;
    require(sim_create(def, &sim, &fail), "sim_create", &fail);
    require(sim_run(sim, NULL, &fail), "sim_run", &fail);
    return sim;
}

struct built_case {
    struct library *library;
    struct api_case *c;
};

struct built_case *built_shipped(const char *name)
{
    struct failure fail = {0};
    struct failure_list *problems = calloc(1, sizeof *problems);
    struct built_case *b = calloc(1, sizeof *b);
    char file[128];
    const char *path, *text;
    size_t size;
    require(problems != NULL && b != NULL ? ST_OK : ST_NO_MEMORY, name, NULL);
    require(library_create_builtin(&b->library, &fail), name, &fail);
    (void)snprintf(file, sizeof file, "%s.json", name);
    for (int i = 0; (path = library_example_case(i, &text, &size)) != NULL && b->c == NULL; i++) {
        const char *slash = strrchr(path, '/');
        if (strcmp(slash != NULL ? slash + 1 : path, file) == 0) {
            require(api_case_parse(b->library, text, size, "", &b->c, problems), name,
                    &problems->item[0]);
        }
    }
    require(b->c != NULL ? ST_OK : ST_INVALID, name, NULL);
    free(problems);
    return b;
}

const struct case_def *built_case_def(const struct built_case *c)
{
    return api_case_def(c->c);
}

void built_release(struct built_case *c)
{
    api_case_destroy(c->c);
    library_destroy(c->library);
    free(c);
}

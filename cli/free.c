#include "cli/free.h"

#include "cli/command.h"
#include "cli/options.h"
#include "cli/report.h"
#include "cli/source.h"

#include "core/analysis/free_section.h"
#include "core/num.h"
#include "core/sim.h"

#include <errno.h>
#include <stdlib.h>
#include <string.h>

/* One NAME=VALUE. */
static bool set_field(const char *word, struct free_section_def *d)
{
    const char *equals = strchr(word, '=');
    const size_t length = equals != NULL ? (size_t)(equals - word) : strlen(word);
    for (int i = 0; i < FREE_SECTION_FIELDS; i++) {
        const struct free_section_field *f = &free_section_fields[i];
        if (equals == NULL || strlen(f->name) != length || strncmp(f->name, word, length) != 0) {
            continue;
        }
        char *end = NULL;
        errno = 0;
        const double given = strtod(equals + 1, &end);
        const double value = f->degrees ? num_rad(given) : given;
        if (end == equals + 1 || *end != '\0' || errno != 0) {
            (void)fprintf(stderr, "aerom: free: %s: '%s' is no number\n", f->name, equals + 1);
            return false;
        }
        memcpy((char *)d + f->offset, &value, sizeof value);
        return true;
    }
    (void)fprintf(stderr, "aerom: free: '%s' is none of NAME=VALUE with NAME", word);
    for (int i = 0; i < FREE_SECTION_FIELDS; i++) {
        (void)fprintf(stderr, " %s", free_section_fields[i].name);
    }
    (void)fputc('\n', stderr);
    return false;
}

static bool print(const struct free_section_result *r)
{
    (void)printf("t,alpha_deg,w,cl,cd,cm\n");
    for (int i = 0; i < r->n; i++) {
        const double *v = r->value + i;
        const ptrdiff_t n = r->n;
        (void)printf("%.6g,%.6f,%.6f,%.6f,%.6f,%.6f\n", v[n * FREE_TIME],
                     num_deg(v[n * FREE_ALPHA]), v[n * FREE_PLUNGE], v[n * FREE_CL], v[n * FREE_CD],
                     v[n * FREE_CM]);
    }
    (void)printf("# stop %s outside_polar %ld outside_hull %ld\n", stop_reason_name(r->stop),
                 r->outside_polar, r->outside_hull);
    return fflush(stdout) == 0 && !ferror(stdout);
}

static bool compute(const struct free_section_def *d, struct failure_list *problems)
{
    struct free_section_result r = {0};
    free_section_def_check(d, problems);
    if (problems->count > 0) {
        report_failures(stderr, "free", problems);
        return false;
    }
    const enum status st = free_section_run(d, &r);
    if (st != ST_OK) {
        (void)fprintf(stderr, "aerom: free: %s\n", status_text(st));
        return false;
    }
    const bool done = print(&r);
    free_section_done(&r);
    return done;
}

int free_main(int argc, char **argv)
{
    struct options o;
    if (!options_parse(argc, argv, "PDNF", 1, -1, &o)) {
        return command_usage("free");
    }
    struct sources s = {0};
    struct free_section_def def;
    bool done = false;
    struct failure_list *problems = calloc(1, sizeof *problems);
    if (problems == NULL || !sources_init(&s)) {
        goto out;
    }
    free_section_def_defaults(&def);
    for (int i = 0; i < o.n_operand; i++) {
        if (!set_field(o.operand[i], &def)) {
            goto out;
        }
    }
    if (source_polar(o.polar, &s, problems, &def.polar) &&
        source_dynamic(o.dynamic, o.network, o.force, def.polar, &s, problems, &def.dynamic,
                       &def.network)) {
        done = compute(&def, problems);
    }
out:
    sources_done(&s);
    free(problems);
    return done ? COMMAND_OK : COMMAND_FAILED;
}

#include "cli/loop.h"

#include "cli/command.h"
#include "cli/file.h"
#include "cli/motion.h"
#include "cli/options.h"
#include "cli/report.h"

#include "api/case.h"
#include "api/entry.h"
#include "api/library.h"
#include "api/router.h"
#include "core/analysis/loop.h"
#include "core/num.h"

#include <stdlib.h>
#include <string.h>

static const char *const polar_default = "plate-4pct-channel";

/* What the options name: polar and network of the library or of a file each. */
struct sources {
    struct library *library;
    struct entry_set own;
};

static bool is_file(const char *name)
{
    const size_t length = strlen(name);
    return length > 5 && strcmp(name + length - 5, ".json") == 0;
}

static bool read_entry(const char *file, entry_reader read_one, struct sources *s,
                       struct failure_list *problems)
{
    char *text = NULL;
    size_t size = 0;
    if (!file_read(file, router_body_max("POST", "/v1/jobs"), &text, &size)) {
        return false;
    }
    const enum status st = entry_parse(text, size, read_one, &s->own, problems);
    free(text);
    if (st != ST_OK) {
        report_failures(stderr, file, problems);
    }
    return st == ST_OK;
}

static bool find_polar(const char *name, struct sources *s, struct failure_list *problems,
                       const struct polar_def **out)
{
    if (is_file(name)) {
        if (!read_entry(name, entry_read_polar, s, problems)) {
            return false;
        }
        *out = &s->own.polar[0].def;
        return true;
    }
    *out = library_polar(s->library, name);
    if (*out == NULL) {
        (void)fprintf(stderr, "aerom: --polar: the library has no polar '%s'\n", name);
    }
    return *out != NULL;
}

static bool find_network(const char *name, struct sources *s, struct failure_list *problems,
                         const struct network_def **out)
{
    if (is_file(name)) {
        if (!read_entry(name, entry_read_network, s, problems)) {
            return false;
        }
        *out = &s->own.network[0].def;
        return true;
    }
    *out = library_network(s->library, name);
    if (*out == NULL) {
        (void)fprintf(stderr, "aerom: --network: the library has no network '%s'\n", name);
    }
    return *out != NULL;
}

static bool find_dynamic(const struct options *o, struct sources *s, struct failure_list *problems,
                         struct loop_def *d)
{
    if (o->dynamic != NULL && !dynamic_type_parse(o->dynamic, &d->dynamic)) {
        (void)fprintf(stderr,
                      "aerom: --dynamic: '%s' is not one of none, network, attached, "
                      "dynamic_stall\n",
                      o->dynamic);
        return false;
    }
    if ((d->dynamic == DYNAMIC_NETWORK) != (o->network != NULL)) {
        (void)fprintf(stderr, "aerom: --network goes with, and only with, --dynamic network\n");
        return false;
    }
    return o->network == NULL || find_network(o->network, s, problems, &d->network);
}

static double given(double value, double otherwise)
{
    return isnan(value) ? otherwise : value;
}

/* A count that is no whole number is out of range. */
static int whole(double value, int otherwise)
{
    const double v = given(value, otherwise);
    return fabs(v) <= 1e6 && fabs(v - nearbyint(v)) < 1e-9 ? (int)lround(v) : -1;
}

static bool has_sine(const struct options *o)
{
    return !(isnan(o->mean_deg) && isnan(o->amplitude_deg) && isnan(o->plunge) &&
             isnan(o->phase_deg) && isnan(o->cycles) && isnan(o->steps));
}

static void set_motion(const struct options *o, struct loop_def *d)
{
    d->mean = num_rad(given(o->mean_deg, 0.0));
    d->amplitude = num_rad(given(o->amplitude_deg, 0.0));
    d->plunge = given(o->plunge, 0.0);
    d->phase = num_rad(given(o->phase_deg, 0.0));
    d->frequency = o->frequency;
    d->cycles = whole(o->cycles, d->cycles);
    d->steps = whole(o->steps, d->steps);
}

/* `start` is the time of the first sample. */
static bool print(const struct loop_result *r, double start)
{
    (void)printf("t,alpha_deg,w,cl,cd,cm\n");
    for (int i = 0; i < r->n; i++) {
        const double *v = r->value + i;
        const ptrdiff_t n = r->n;
        (void)printf("%.6g,%.6f,%.6f,%.6f,%.6f,%.6f\n", start + v[n * LOOP_TIME],
                     num_deg(v[n * LOOP_ALPHA]), v[n * LOOP_PLUNGE], v[n * LOOP_CL], v[n * LOOP_CD],
                     v[n * LOOP_CM]);
    }
    (void)printf("# work %.8f pitch %.8f plunge %.8f outside_polar %ld\n",
                 r->work_pitch + r->work_plunge, r->work_pitch, r->work_plunge, r->outside_polar);
    return fflush(stdout) == 0 && !ferror(stdout);
}

static bool compute(const struct loop_def *d, double start, struct failure_list *problems)
{
    struct loop_result r = {0};
    loop_def_check(d, problems);
    if (problems->count > 0) {
        report_failures(stderr, "loop", problems);
        return false;
    }
    const enum status st = loop_run(d, &r);
    if (st != ST_OK) {
        (void)fprintf(stderr, "aerom: loop: %s\n", status_text(st));
        return false;
    }
    const bool done = print(&r, start);
    loop_done(&r);
    return done;
}

int loop_main(int argc, char **argv)
{
    struct options o;
    if (!options_parse(argc, argv, "PDNMmaflpye", 0, 0, &o) ||
        isnan(o.frequency) == (o.motion == NULL) || (o.motion != NULL && has_sine(&o))) {
        return command_usage("loop");
    }
    struct sources s = {0};
    struct loop_def def;
    struct loop_motion motion = {0};
    double start = 0.0;
    struct failure fail = {0};
    bool done = false;
    struct failure_list *problems = calloc(1, sizeof *problems);
    if (problems == NULL || library_create_builtin(&s.library, &fail) != ST_OK) {
        (void)fprintf(stderr, "aerom: shipped library: %s: %s\n", fail.pointer, fail.detail);
        goto out;
    }
    loop_def_defaults(&def);
    set_motion(&o, &def);
    if (o.motion != NULL) {
        if (!motion_read(o.motion, &motion, &start)) {
            goto out;
        }
        def.motion = &motion;
    }
    if (find_polar(o.polar != NULL ? o.polar : polar_default, &s, problems, &def.polar) &&
        find_dynamic(&o, &s, problems, &def)) {
        done = compute(&def, start, problems);
    }
out:
    free(motion.value);
    entry_set_done(&s.own);
    library_destroy(s.library);
    free(problems);
    return done ? COMMAND_OK : COMMAND_FAILED;
}

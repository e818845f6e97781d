#include "cli/loop.h"

#include "cli/command.h"
#include "cli/motion.h"
#include "cli/options.h"
#include "cli/report.h"
#include "cli/source.h"

#include "core/analysis/loop.h"
#include "core/num.h"

#include <stdlib.h>
#include <string.h>

static bool has_sine(const struct options *o)
{
    return !(isnan(o->mean_deg) && isnan(o->amplitude_deg) && isnan(o->plunge) &&
             isnan(o->phase_deg) && isnan(o->cycles) && isnan(o->steps));
}

static void set_motion(const struct options *o, struct loop_def *d)
{
    d->mean = num_rad(options_given(o->mean_deg, 0.0));
    d->amplitude = num_rad(options_given(o->amplitude_deg, 0.0));
    d->plunge = options_given(o->plunge, 0.0);
    d->phase = num_rad(options_given(o->phase_deg, 0.0));
    d->frequency = o->frequency;
    d->cycles = options_whole(o->cycles, d->cycles);
    d->steps = options_whole(o->steps, d->steps);
}

/* `start` is the time of the first sample. A section that only pitches has no column of plunge. */
static bool print(const struct loop_result *r, bool plunges, double start)
{
    (void)printf("t,alpha_deg,cl,cd,cm%s\n", plunges ? ",w" : "");
    for (int i = 0; i < r->n; i++) {
        const double *v = r->value + i;
        const ptrdiff_t n = r->n;
        (void)printf("%.6g,%.6f,%.6f,%.6f,%.6f", start + v[n * LOOP_TIME],
                     num_deg(v[n * LOOP_ALPHA]), v[n * LOOP_CL], v[n * LOOP_CD], v[n * LOOP_CM]);
        if (plunges) {
            (void)printf(",%.6f", v[n * LOOP_PLUNGE]);
        }
        (void)printf("\n");
    }
    (void)printf("# work %.8f pitch %.8f plunge %.8f outside_polar %ld outside_hull %ld\n",
                 r->work_pitch + r->work_plunge, r->work_pitch, r->work_plunge, r->outside_polar,
                 r->outside_hull);
    return fflush(stdout) == 0 && !ferror(stdout);
}

/* The check speaks of the members of "motion". */
static void name_options(struct failure_list *problems)
{
    static const struct {
        const char *member, *option;
    } names[] = {{"/motion", "--motion"},
                 {"/motion/mean_deg", "--mean-deg"},
                 {"/motion/amplitude_deg", "--amplitude-deg"},
                 {"/motion/frequency_c_v", "--frequency"},
                 {"/motion/plunge_c", "--plunge"},
                 {"/motion/phase_deg", "--phase-deg"},
                 {"/motion/cycles", "--cycles"},
                 {"/motion/steps", "--steps"}};
    for (int i = 0; i < problems->count; i++) {
        struct failure *f = &problems->item[i];
        for (size_t k = 0; k < sizeof names / sizeof names[0]; k++) {
            if (strcmp(f->pointer, names[k].member) == 0) {
                (void)snprintf(f->pointer, sizeof f->pointer, "%s", names[k].option);
                break;
            }
        }
    }
}

static bool compute(const struct loop_def *d, double start, struct failure_list *problems)
{
    struct loop_result r = {0};
    loop_def_check(d, problems);
    if (problems->count > 0) {
        name_options(problems);
        report_failures(stderr, "loop", problems);
        return false;
    }
    const enum status st = loop_run(d, &r);
    if (st != ST_OK) {
        (void)fprintf(stderr, "aerom: loop: %s\n", status_text(st));
        return false;
    }
    const bool done = print(&r, d->motion != NULL || d->plunge != 0.0, start);
    loop_done(&r);
    return done;
}

int loop_main(int argc, char **argv)
{
    struct options o;
    if (!options_parse(argc, argv, "PDNFMmaflpye", 0, 0, &o) ||
        isnan(o.frequency) == (o.motion == NULL) || (o.motion != NULL && has_sine(&o))) {
        return command_usage("loop");
    }
    struct sources s = {0};
    struct loop_def def;
    struct loop_motion motion = {0};
    double start = 0.0;
    bool done = false;
    struct failure_list *problems = calloc(1, sizeof *problems);
    if (problems == NULL || !sources_init(&s)) {
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
    if (source_polar(o.polar, &s, problems, &def.polar) &&
        source_dynamic(o.dynamic, o.network, o.force, def.polar, &s, problems, &def.dynamic,
                       &def.network)) {
        done = compute(&def, start, problems);
    }
out:
    free(motion.value);
    sources_done(&s);
    free(problems);
    return done ? COMMAND_OK : COMMAND_FAILED;
}

#include "cli/report.h"

#include <cjson/cJSON.h>

#include <stdbool.h>
#include <string.h>

static const cJSON *member(const cJSON *object, const char *key)
{
    return cJSON_GetObjectItemCaseSensitive(object, key);
}

static const char *text_of(const cJSON *object, const char *key)
{
    const cJSON *item = member(object, key);
    return cJSON_IsString(item) ? item->valuestring : "";
}

static void print_failure(FILE *out, const char *pointer, const char *detail, const char *expected,
                          const char *got)
{
    /* Many details already say what was expected. */
    const bool said = expected[0] == '\0' || strstr(detail, expected) != NULL;
    (void)fprintf(out, "  %s%s%s", pointer, pointer[0] != '\0' ? ": " : "", detail);
    if (!said) {
        (void)fprintf(out, " (expected %s%s%s)", expected, got[0] != '\0' ? ", got " : "", got);
    } else if (got[0] != '\0') {
        (void)fprintf(out, " (got %s)", got);
    }
    (void)fputc('\n', out);
}

void report_failures(FILE *out, const char *source, const struct failure_list *list)
{
    (void)fprintf(out, "aerom: %s: %d problem%s\n", source, list->total,
                  list->total == 1 ? "" : "s");
    for (int i = 0; i < list->count; i++) {
        const struct failure *f = &list->item[i];
        print_failure(out, f->pointer, f->detail, f->expected, f->got);
    }
    if (list->total > list->count) {
        (void)fprintf(out, "  ... and %d more\n", list->total - list->count);
    }
}

void report_problem(FILE *out, const char *source, long http_status, const char *body, size_t size)
{
    cJSON *problem = cJSON_ParseWithLength(body, size);
    const cJSON *errors = member(problem, "errors");
    const cJSON *item = NULL;
    (void)fprintf(out, "aerom: %s: %ld %s", source, http_status,
                  problem != NULL ? text_of(problem, "title") : body);
    /* With a list of errors the detail only repeats its first one. */
    if (cJSON_GetArraySize(errors) == 0 && text_of(problem, "detail")[0] != '\0') {
        (void)fprintf(out, ": %s", text_of(problem, "detail"));
    }
    (void)fputc('\n', out);
    cJSON_ArrayForEach(item, errors)
    {
        print_failure(out, text_of(item, "pointer"), text_of(item, "detail"),
                      text_of(item, "expected"), text_of(item, "got"));
    }
    cJSON_Delete(problem);
}

/* A number of the document, or a dash for null and for what is not there. */
static void print_number(FILE *out, const char *format, const char *blank, const cJSON *item)
{
    if (cJSON_IsNumber(item)) {
        /* The formats are the literals of this file. */
#pragma GCC diagnostic push
#pragma GCC diagnostic ignored "-Wformat-nonliteral"
        (void)fprintf(out, format, item->valuedouble);
#pragma GCC diagnostic pop
    } else {
        (void)fputs(blank, out);
    }
}

static void print_modes(FILE *out, const cJSON *modes)
{
    const cJSON *mode = NULL;
    int number = 0;
    cJSON_ArrayForEach(mode, modes)
    {
        (void)fprintf(out, "  mode %-2d", ++number);
        print_number(out, " %10.3f Hz", "          -   ", member(mode, "frequency_hz"));
        (void)fprintf(out, "  %s\n", text_of(mode, "label"));
    }
}

/* The numbers of an object, one a line. */
static void print_numbers(FILE *out, const char *title, const cJSON *object)
{
    const cJSON *item = NULL;
    if (object == NULL) {
        return;
    }
    (void)fprintf(out, "%s\n", title);
    cJSON_ArrayForEach(item, object)
    {
        if (cJSON_IsNumber(item)) {
            (void)fprintf(out, "  %-22s %12.5g\n", item->string, item->valuedouble);
        }
    }
}

/* An instability: its numbers, or that the range has none. */
static void print_instability(FILE *out, const char *title, const cJSON *point)
{
    if (cJSON_IsString(point)) {
        (void)fprintf(out, "%s\n  none in the range\n", title);
    } else {
        print_numbers(out, title, point);
    }
}

static void print_first_failure(FILE *out, const cJSON *failure)
{
    if (!cJSON_IsObject(failure)) {
        return;
    }
    const char *layup = text_of(failure, "layup");
    print_number(out, "first ply fails at %.4g times the load", "first ply",
                 member(failure, "reserve"));
    print_number(out, ": at z = %.4g m", "", member(failure, "z_m"));
    print_number(out, ", ply %.0f", "", member(failure, "ply"));
    (void)fprintf(out, "%s%s\n", layup[0] != '\0' ? " of " : "", layup);
}

static void print_damping(FILE *out, const cJSON *damping, const char *signal, const char *unit)
{
    const cJSON *roots = member(member(damping, signal), "roots");
    const cJSON *root = NULL;
    if (roots == NULL) {
        return;
    }
    (void)fprintf(out, "damping of %s\n  frequency [Hz]  ratio [%%]  amplitude [%s]  residual\n",
                  signal, unit);
    cJSON_ArrayForEach(root, roots)
    {
        const cJSON *ratio = member(root, "ratio");
        print_number(out, "  %14.3f", "               -", member(root, "frequency_hz"));
        if (cJSON_IsNumber(ratio)) {
            (void)fprintf(out, "  %9.3f", 100.0 * ratio->valuedouble);
        } else {
            (void)fputs("          -", out);
        }
        print_number(out, "  %13.3e", "              -", member(root, "amplitude"));
        print_number(out, "  %8.1e\n", "         -\n", member(root, "residual"));
    }
}

/* Of a section in prescribed motion and of a training. */
static void print_small_kinds(FILE *out, const cJSON *summary)
{
    print_numbers(out, "work fed into the motion, by rho V^2 c^2/2", member(summary, "work"));
    print_numbers(out, "lift coefficient", member(summary, "cl"));
    print_numbers(out, "moment coefficient", member(summary, "cm"));
    print_number(out, "share of the steps outside the polar %.4g\n", "",
                 member(summary, "outside_hull") != NULL ? member(summary, "outside_polar") : NULL);
    print_number(out, "share of the steps outside the hull %.4g\n", "",
                 member(summary, "outside_hull"));
    print_numbers(out, "errors of the records trained", member(summary, "trained"));
    print_numbers(out, "errors of the records held out", member(summary, "held"));
}

bool report_summary(FILE *out, const char *json, size_t size)
{
    cJSON *summary = cJSON_ParseWithLength(json, size);
    if (!cJSON_IsObject(summary)) {
        cJSON_Delete(summary);
        (void)fprintf(stderr, "aerom: this is no summary: %.200s\n", json);
        return false;
    }
    const cJSON *verdict = member(summary, "verdict");
    if (cJSON_IsString(verdict)) {
        (void)fprintf(out, "verdict: %s\n  %s\n", verdict->valuestring,
                      text_of(summary, "verdict_reason"));
    }
    print_number(out, "E* %.4g, ", "", member(summary, "e_star"));
    print_number(out, "Reynolds number %.4g\n", "", member(summary, "reynolds"));
    print_instability(out, "divergence", member(summary, "divergence"));
    print_instability(out, "flutter", member(summary, "flutter"));
    print_numbers(out, "least damped oscillation", member(summary, "least_damped"));
    const cJSON *modes = member(summary, "modes");
    if (modes != NULL) {
        (void)fputs("natural modes\n", out);
        print_modes(out, modes);
    }
    print_numbers(out, "means", member(summary, "means"));
    print_numbers(out, "tip", member(summary, "tip"));
    print_numbers(out, "reactions of the clamp", member(summary, "reactions"));
    print_first_failure(out, member(summary, "first_ply_failure"));
    print_small_kinds(out, summary);
    if (verdict == NULL) {
        print_numbers(out, "section", member(summary, "section"));
    }
    const cJSON *damping = member(summary, "damping");
    print_damping(out, damping, "tip_twist", "deg");
    print_damping(out, damping, "tip_plunge", "m");
    const cJSON *timing = member(summary, "timing");
    if (timing != NULL) {
        print_number(out, "computed in %.3f s of processor time", "", member(timing, "cpu_s"));
        print_number(out, ", %.2f us per step\n", "\n", member(timing, "us_per_step"));
    }
    cJSON_Delete(summary);
    return true;
}

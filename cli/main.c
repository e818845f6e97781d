/* aerom: computes a case in this process, or talks to a daemon. */
#include "cli/command.h"
#include "cli/free.h"
#include "cli/loop.h"
#include "cli/remote.h"
#include "cli/run.h"
#include "cli/train.h"

#include "core/sim.h"

#include <stddef.h>
#include <stdio.h>
#include <string.h>

static int help_main(int argc, char **argv);

static const struct command commands[] = {
    {"run", run_main, "CASE.json [--series FILE.csv] [--document NAME] [--text] [--value NAME]",
     "compute a case here and print its summary, or a study and print the map of a value (default\n"
     "      verdict); CASE '-' reads standard input"},
    {"loop", loop_main,
     "--frequency F | --motion FILE.csv [--polar NAME|FILE.json] [--dynamic TYPE|network:NAME]\n"
     "      [--network NAME|FILE.json [--force]] [--mean-deg A] [--amplitude-deg A] [--plunge W] "
     "[--phase-deg A]\n"
     "      [--cycles N] [--steps N]",
     "coefficients of a section in prescribed pitch and plunge, as CSV; the last line is the work"},
    {"free", free_main,
     "NAME=VALUE... [--polar NAME|FILE.json] [--dynamic TYPE] [--network NAME|FILE.json [--force]]",
     "a section on springs, free to pitch and plunge, as CSV; the last line says how it ended"},
    {"train", train_main,
     "FOLDER --output FILE.json [--name NAME] [--description TEXT] [--polar NAME|FILE.json]\n"
     "      [--base polar|attached|dynamic_stall] [--lags T,...] [--oscillators F:D,...]\n"
     "      [--inputs NAME,...] [--hidden N] [--members N] [--folds N] [--samples N]\n"
     "      [--anchors N] [--optimiser lm|adam] [--epochs N] [--decay X] [--balance X]\n"
     "      [--tolerance X] [--symmetric] [--seed N]",
     "train a network on the records of a folder like data/cfd; prints the learning curve and the\n"
     "      errors on each record, as CSV"},
    {"submit", remote_submit, "CASE.json... [--wait]", "hand cases to the daemon, print their ids"},
    {"wait", remote_wait, "ID... [--timeout SECONDS]", "wait until jobs are finished"},
    {"get", remote_get,
     "ID [job|summary|case|series|damping|loads|modes|section|static|stability|training|network|\n"
     "      study|cells|map|boundary|optimum|uncertainty] [--csv] [--value NAME]",
     "print a result of a job as JSON (series and map: also CSV); default summary; of a study its "
     "state,\n      its cells, the map of a value, or what it has found"},
    {"show", remote_show, "ID", "print the summary of a job as a table"},
    {"cancel", remote_cancel, "ID...", "cancel jobs"},
    {"list", remote_list, "[--state STATE] [--kind KIND] [--limit N] [--json]",
     "list jobs, newest first"},
    {"help", help_main, "", "print this"},
};

enum { COMMAND_COUNT = sizeof commands / sizeof commands[0] };

static const struct command *find(const char *name)
{
    for (size_t i = 0; i < COMMAND_COUNT; i++) {
        if (strcmp(commands[i].name, name) == 0) {
            return &commands[i];
        }
    }
    return NULL;
}

int command_usage(const char *name)
{
    const struct command *c = find(name);
    if (c != NULL) {
        (void)fprintf(stderr, "usage: aerom %s %s\n", c->name, c->arguments);
    }
    return COMMAND_USAGE;
}

static int print_help(FILE *out)
{
    (void)fputs("aerom: aeroelastic stability of composite beams\n\n", out);
    for (size_t i = 0; i < COMMAND_COUNT; i++) {
        (void)fprintf(out, "  aerom %s %s\n      %s\n", commands[i].name, commands[i].arguments,
                      commands[i].purpose);
    }
    (void)fputs("  aerom --version\n\n"
                "Commands that talk to the daemon take --url URL; without it AEROM_URL of the\n"
                "environment counts, then http://127.0.0.1:8080.\n"
                "Exit codes: 0 done, 1 failed (stderr says why), 2 wrong arguments, 3 wait timed "
                "out.\n",
                out);
    return COMMAND_OK;
}

static int help_main(int argc, char **argv)
{
    (void)argc;
    (void)argv;
    return print_help(stdout);
}

int main(int argc, char **argv)
{
    sim_process_init();
    if (argc < 2) {
        (void)print_help(stderr);
        return COMMAND_USAGE;
    }
    if (strcmp(argv[1], "--version") == 0) {
        (void)printf("aerom %s (core %s)\n", AEROM_VERSION, AEROM_CORE_VERSION);
        return COMMAND_OK;
    }
    if (strcmp(argv[1], "--help") == 0 || strcmp(argv[1], "-h") == 0) {
        return print_help(stdout);
    }
    const struct command *c = find(argv[1]);
    if (c == NULL) {
        (void)fprintf(stderr, "aerom: no command '%s'; 'aerom help' lists them\n", argv[1]);
        return COMMAND_USAGE;
    }
    return c->run(argc - 1, argv + 1);
}

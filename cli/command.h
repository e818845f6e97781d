/* cli/command.h
 * The commands of aerom: one table in main.c, one file for each group of commands.
 *
 * A command gets its own name as argv[0] and returns an exit code. Results go to standard output,
 * everything else to stderr. */
#ifndef AEROM_CLI_COMMAND_H
#define AEROM_CLI_COMMAND_H

enum command_exit {
    COMMAND_OK = 0,
    COMMAND_FAILED = 1, /* the case, the job, the daemon or the machine said no; stderr says why */
    COMMAND_USAGE = 2,  /* the arguments make no sense */
    COMMAND_TIMEOUT = 3 /* wait: the job is not finished yet */
};

struct command {
    const char *name;
    int (*run)(int argc, char **argv);
    const char *arguments;
    const char *purpose;
};

/* Prints how the named command is used on stderr and returns COMMAND_USAGE. */
int command_usage(const char *name);

#endif

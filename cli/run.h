/* cli/run.h
 * aerom run: one case, or a study, computed in this process, without a daemon. */
#ifndef AEROM_CLI_RUN_H
#define AEROM_CLI_RUN_H

/* Prints the document GET /v1/jobs/{id}/summary would give (or the one --document names) on
 * standard output; of a study its map. Arguments and exit code as in cli/command.h. */
int run_main(int argc, char **argv);

#endif

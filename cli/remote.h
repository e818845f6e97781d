/* cli/remote.h
 * The commands that talk to a daemon. Arguments and exit codes as in cli/command.h. */
#ifndef AEROM_CLI_REMOTE_H
#define AEROM_CLI_REMOTE_H

/* Submits each case; prints "ID state file" a line. With --wait also waits for all of them. */
int remote_submit(int argc, char **argv);
/* Polls until every job is finished; progress on stderr. Fails when one failed or was cancelled. */
int remote_wait(int argc, char **argv);
/* Prints one document of a job. */
int remote_get(int argc, char **argv);
/* Prints the summary of a job as a table. */
int remote_show(int argc, char **argv);
/* Cancels jobs; prints "ID state" a line. Idempotent. */
int remote_cancel(int argc, char **argv);
/* Prints jobs, newest first, as a table or as the JSON of the contract. */
int remote_list(int argc, char **argv);

#endif

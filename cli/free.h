/* cli/free.h
 * aerom free: a section on springs, free to pitch and plunge, with one of the dynamic models. */
#ifndef AEROM_CLI_FREE_H
#define AEROM_CLI_FREE_H

/* Prints t,alpha_deg,w,cl,cd,cm and, as the last line, how the march ended. Arguments and exit code
 * as in cli/command.h. */
int free_main(int argc, char **argv);

#endif

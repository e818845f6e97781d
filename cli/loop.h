/* cli/loop.h
 * aerom loop: a section in prescribed pitch and plunge, through one of the dynamic models. */
#ifndef AEROM_CLI_LOOP_H
#define AEROM_CLI_LOOP_H

/* Prints t,alpha_deg,cl,cd,cm, where the section plunges w, and, as the last line, the work of the
 * last cycle. Arguments and exit code as in cli/command.h. */
int loop_main(int argc, char **argv);

#endif

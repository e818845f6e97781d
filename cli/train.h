/* cli/train.h
 * The command that trains a network here, without a daemon. */
#ifndef AEROM_CLI_TRAIN_H
#define AEROM_CLI_TRAIN_H

int train_main(int argc, char **argv);

#endif

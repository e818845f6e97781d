/* api/channel.h
 * Names and presented units of the recorded channels. */
#ifndef AEROM_API_CHANNEL_H
#define AEROM_API_CHANNEL_H

#include "core/case_def.h"

/* All names in the order of enum channel; ends with NULL. */
extern const char *const channel_names[];

/* Name on the wire, with its unit: "tip_twist_deg". */
const char *channel_name(enum channel channel);
bool channel_parse(const char *name, enum channel *out);
/* Factor from the core's unit to the presented unit (180/pi for angles, else 1). */
double channel_scale(enum channel channel);

/* The columns a case records, in order: name of column j ("modal_amplitude[2]" for a vector
 * channel, counted from 1) and the factor from the core's unit to the presented one. False past the
 * last column. */
bool channel_column(const struct case_def *def, int column, char name[64], double *scale);

#endif

/* server/clock.h
 * The clocks of the process. All functions are safe from any thread. */
#ifndef AEROM_SERVER_CLOCK_H
#define AEROM_SERVER_CLOCK_H

#include <stdint.h>

/* Wall time, microseconds since 1970 UTC: stored, shown, never used for intervals in memory. */
int64_t clock_wall_us(void);
/* Monotonic time in microseconds from an arbitrary origin: intervals and time limits. */
int64_t clock_mono_us(void);
/* Processor time of the calling thread [s]. */
double clock_thread_cpu_s(void);

#endif

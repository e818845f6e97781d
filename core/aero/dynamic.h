/* core/aero/dynamic.h
 * The models that make the steady polar unsteady. */
#ifndef AEROM_CORE_AERO_DYNAMIC_H
#define AEROM_CORE_AERO_DYNAMIC_H

/* What is added to the steady polar: nothing; a network; the wake's lag and apparent mass; these
 * and the lags of stall. */
enum dynamic_type { DYNAMIC_NONE, DYNAMIC_NETWORK, DYNAMIC_ATTACHED, DYNAMIC_STALL };

#endif

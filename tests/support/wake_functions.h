/* tests/support/wake_functions.h
 * Wagner's and Kuessner's functions by their integrals, for comparison with the lags of the core.
 */
#ifndef AEROM_TESTS_SUPPORT_WAKE_FUNCTIONS_H
#define AEROM_TESTS_SUPPORT_WAKE_FUNCTIONS_H

/* Lift of a flat plate over its final value, s semichords after a sudden incidence (Wagner), and
 * after its leading edge has met a sharp-edged gust (Kuessner); good to 1e-4. */
double wake_wagner(double s);
double wake_kuessner(double s);

#endif

/* api/hdf5_out.h
 * A map as an HDF5 file in memory. No state; any thread (hdf5_lock.h). */
#ifndef AEROM_API_HDF5_OUT_H
#define AEROM_API_HDF5_OUT_H

#include "api/study_map.h"

/* The bytes of a file (malloc'ed, *size), or NULL when out of memory. The same map gives the same
 * bytes. Datasets: "values" (shape of the map; doubles, NaN where missing; or texts of fixed
 * length, "" where missing), "status" (enum study_cell_state, whose names are its attribute
 * "states"), and "axis0", "axis1", ... with the attributes "pointer" and "dimension". The attribute
 * "value" of "values" is the name of the result. */
char *hdf5_out_map(const struct study_map *m, size_t *size);

#endif

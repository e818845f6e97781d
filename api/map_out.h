/* api/map_out.h
 * A map of a study in the forms it can be had in: JSON, CSV, NPY, HDF5, SVG. No state. */
#ifndef AEROM_API_MAP_OUT_H
#define AEROM_API_MAP_OUT_H

#include "api/study_map.h"

enum map_format { MAP_JSON, MAP_CSV, MAP_NPY, MAP_HDF5, MAP_SVG, MAP_FORMATS };
const char *map_format_name(enum map_format f); /* "json" "csv" "npy" "hdf5" "svg" */
const char *map_format_type(enum map_format f); /* its media type */
/* MAP_FORMATS for another name. */
enum map_format map_format_of(const char *name);
/* What an Accept header likes best, JSON among equals; NULL accepts all. */
enum map_format map_format_accepted(const char *accept);

/* Header line and one row a cell: "cell", the pointer of each axis, the name of the result,
 * "status". A missing value is empty. */
void map_out_csv(struct json_out *out, const struct study_map *m);

/* Format 1.0 of NumPy: an array of the shape of the map, last dimension fastest; doubles with NaN
 * where missing, or byte texts with b"" where missing. */
void map_out_npy(struct json_out *out, const struct study_map *m);

#endif

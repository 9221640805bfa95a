/// Buildings as input of commands: a file of storeys (sightline/storeys.h), by its ending.
#ifndef BUILDING_H
#define BUILDING_H

#include "inputs/pipeline.h"
#include "sightline/storeys.h"

#define BUILDING_ENDING ".storeys"

/// Whether the name is that of a building.
bool input_is_building(const char *path);

/// Reads a building. SL_BAD_INPUT with file and line for a plan that is no file, too; and
/// SL_BAD_ARGUMENT if `pipeline` has what only one plan can have.
sl_status building_read(sl_context *context, const char *path, const map_pipeline *pipeline,
                        sl_building *out);

/// How the plan of a storey is read: as `pipeline` says for all.
sl_status building_pipeline(sl_context *context, const map_pipeline *pipeline,
                            const sl_storey *storey, map_pipeline *out);

/// Reads a place of an option, "ground:3,4".
sl_status building_place(sl_context *context, const char *option, const char *text,
                         const sl_building *building, size_t *storey, sl_point *at);

/// SL_BAD_INPUT, naming both, if the unit of a storey's plan is not that of the first one.
sl_status building_check_unit(sl_context *context, const char *path, const sl_building *building,
                              size_t storey, const char *unit, const char *first);

#endif

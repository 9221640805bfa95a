/// Shortest ways through a building, over the links of its storeys.
#ifndef BUILDING_PATH_H
#define BUILDING_PATH_H

#include "inputs/building.h"

/// What is asked.
typedef struct building_path_plan {
    const char *input, *from, *to; ///< places as STOREY:X,Y
    const char *output;            ///< of the points, NULL for none
    map_pipeline *pipeline;
    double radius; ///< of the walker
    bool json;
} building_path_plan;

/// Finds and prints the way. Without one, the console has a fault.
sl_status building_path(command_console *console, const building_path_plan *plan);

#endif

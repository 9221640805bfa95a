/// Whether the unit that a drawing names makes a building of it, and what doors tell where it does
/// not.
#ifndef SL_PLAN_UNIT_H
#define SL_PLAN_UNIT_H

#include "sightline/map.h"
#include "sightline/support.h"

/// What is known of a plan.
typedef struct sli_plan_size {
    int unit;      ///< that the drawing names, a number of sli_units
    double scale;  ///< of the map: its numbers are those of the drawing times this
    double door;   ///< the usual width of doors that are drawn open, in the map; 0 for unknown
    size_t doors;  ///< how many these are
    bool building; ///< layers are named as walls and doors: it is no town
} sli_plan_size;

/// Notes a unit in which doors are no doors, or in which the plan is too small or too large for
/// one, with the units that fit and the option that says them. A drawing that names no unit, and
/// one of fewer than five walls, is never doubted.
void sli_plan_unit_tell(sl_context *context, const char *file, const sl_map *map,
                        const sli_plan_size *plan);

/// Forgets the map's unit where it is that of a page and no building's: a plan of five walls or
/// more would be too short for one. A note says so, unless `said`: the options give the true size.
void sli_plan_unit_of_page(sl_context *context, const char *file, sl_map *map, bool said);

/// Takes the width of entrances from doors that are drawn open, where the map's unit makes no doors
/// of them; `door` is their usual width.
void sli_plan_unit_entrance(sl_map *map, double door, size_t doors);

#endif

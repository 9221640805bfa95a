/// Compares a drawing with what buildings are like: doors are 0.4 to 1.6 m wide, plans 2.5 m to 1
/// km long. Plans of many walls are longer; towns are drawn in metres and larger units. These are
/// rules of thumb, so all that follows is a note.
#include "io/parts/plan_unit.h"

#include "map/scan.h"
#include "map/unit.h"

#include <math.h>
#include <string.h>

/// In metres: the least length of a plan, and of one with many walls; the largest, and that of a
/// town; the lengths that a unit is offered for; the usual, least and largest width of a door; that
/// of an entrance.
static const double SHORT = 2.5, SHORT_OF_MANY = 8, LONG = 1000, LONG_TOWN = 10000, OFFER_SHORT = 6,
                    OFFER_LONG = 500, DOOR = 0.85, DOOR_LEAST = 0.4, DOOR_MOST = 1.6,
                    ENTRANCE = 1.2;
enum { FEW_WALLS = 5, MANY_WALLS = 200, SURE_DOORS = 2 };

/// Whether plans are drawn in a unit: mm, cm, m, inches or feet.
static bool is_usual(const sli_unit *unit) {
    return unit->known && unit->metres <= 1 && strcmp(unit->sign, "yd") != 0;
}

/// "in cm it is 7.1 m long (--unit cm=m)", for each unit in which it is as long as buildings are.
static bool list_units(double length, int unit, char *text, size_t size) {
    text[0] = '\0';
    for (int i = 0; i < SLI_UNITS; i++) {
        const double metres = length * sli_units[i].metres;
        if (!is_usual(&sli_units[i]) || i == unit ||
            !(metres >= OFFER_SHORT && metres <= OFFER_LONG))
            continue;
        const size_t used = strlen(text);
        snprintf(text + used, size - used, "%sin %s it is %.3g m long (--unit %s=m)",
                 used ? ", " : "", sli_units[i].name, metres, sli_units[i].sign);
    }
    return text[0];
}

static bool is_door(double metres) {
    return metres >= DOOR_LEAST && metres <= DOOR_MOST;
}

/// The unit in which a door is nearest to a usual one.
static int unit_of_doors(double door) {
    int best = 0;
    double least = INFINITY;
    for (int i = 0; i < SLI_UNITS; i++) {
        const double metres = door * sli_units[i].metres;
        if (!is_usual(&sli_units[i]) || !is_door(metres)) continue;
        if (fabs(log(metres / DOOR)) >= least) continue;
        least = fabs(log(metres / DOOR));
        best = i;
    }
    return best;
}

void sli_plan_unit_tell(sl_context *context, const char *file, const sl_map *map,
                        const sli_plan_size *plan) {
    const sli_unit *unit = &sli_units[plan->unit];
    const sl_box bounds = sl_map_bounds(map);
    const double length =
        fmax(bounds.max.x - bounds.min.x, bounds.max.y - bounds.min.y) / plan->scale;
    const double metres = length * unit->metres, door = plan->door / plan->scale;
    char units[400];
    if (!(unit->metres > 0) || map->wall_count < FEW_WALLS || !isfinite(length)) return;
    if (plan->doors >= SURE_DOORS) {
        const int fits = unit_of_doors(door);
        if (is_door(door * unit->metres)) return;
        if (fits)
            sl_note(context,
                    "%s: the drawing says %s, but its doors are %.3g m wide then: in %s they are "
                    "%.2g m wide, and the plan is %.3g m long: --unit %s=m reads it so",
                    file, unit->name, door * unit->metres, sli_units[fits].name,
                    door * sli_units[fits].metres, length * sli_units[fits].metres,
                    sli_units[fits].sign);
        if (fits) return;
    }
    const double least = map->wall_count >= MANY_WALLS ? SHORT_OF_MANY : SHORT;
    const bool town = unit->metres >= 1 && !plan->building;
    if (metres >= least && metres <= (town ? LONG_TOWN : LONG)) return;
    if (list_units(length, plan->unit, units, sizeof units))
        sl_note(context,
                "%s: the drawing says %s, and is %.4g m long then: if this is the plan of a "
                "building, another unit is meant: %s",
                file, unit->name, metres, units);
    else
        sl_note(context,
                "%s: the drawing says %s, and is %.4g m long then: if this is the plan of a "
                "building, it is not in its true size: lengths and areas are those of the "
                "drawing; --unit N=m, for N metres to each of its units, gives the true size, and "
                "--entrance W says how wide its entrances are",
                file, unit->name, metres);
}

void sli_plan_unit_of_page(sl_context *context, const char *file, sl_map *map, bool said) {
    const sl_box bounds = sl_map_bounds(map);
    const double length = fmax(bounds.max.x - bounds.min.x, bounds.max.y - bounds.min.y);
    const double metres = length * sli_unit_metres(map->unit);
    if (!(metres > 0 && metres < SHORT) || map->wall_count < FEW_WALLS) return;
    if (!said)
        sl_note(
            context,
            "%s: the page is in %s, and the plan on it is %.3g m long: lengths are those on the "
            "page, without a unit; --unit N=m, for N metres to each, gives the true size",
            file, map->unit, metres);
    map->unit[0] = '\0';
}

void sli_plan_unit_entrance(sl_map *map, double door, size_t doors) {
    const double metres = sli_unit_metres(map->unit);
    if (doors < SURE_DOORS || map->entrance > 0 || is_door(door * metres)) return;
    map->entrance = sli_rounded_up(door * (ENTRANCE / DOOR));
    map->entrance_by_doors = map->entrance > 0;
}

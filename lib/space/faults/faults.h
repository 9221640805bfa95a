/// The search for faults, shared by faults.c, faults_leaks.c, faults_walls.c and
/// faults_snap.c.
#ifndef SL_SPACE_FAULTS_H
#define SL_SPACE_FAULTS_H

#include "geometry/length.h"
#include "sightline/faults.h"
#include "sightline/support.h"
#include "space/index.h"

#include <math.h>

typedef SL_ARRAY(sl_fault) sli_fault_list;

typedef struct sli_fault_search {
    sl_context *context;
    const sl_map *map; ///< as read
    sl_map clean;      ///< as it is used: gaps are looked for here
    const sl_space *space;
    sl_faults_options options;
    sli_wall_index index; ///< of the walls as read
    double weld;          ///< ends at most this far apart are one, as are an end and a wall at half
    double moved;         ///< how far a clean wall may be from the walls as read
    uint32_t welded;      ///< gaps that cleaning closes
    uint32_t leaks_left;  ///< that mending leaves
    bool trial;           ///< looks for gaps and leaks alone
    sli_fault_list faults;
    SL_ARRAY(sl_point) points;
} sli_fault_search;

static inline sl_status sli_add_to_list(sl_context *context, sli_fault_list *list, sl_fault fault) {
    SL_TRY(SL_ARRAY_ROOM(context, list, 1));
    list->items[list->count++] = fault;
    return SL_OK;
}

static inline sl_status sli_add_fault(sli_fault_search *search, sl_fault fault) {
    return sli_add_to_list(search->context, &search->faults, fault);
}

static inline double sli_apart(sl_point a, sl_point b) {
    return sli_length(a.x - b.x, a.y - b.y);
}

/// All faults; a trial finds gaps and leaks alone, and does not ask what mending would close.
sl_status sli_find_faults(sl_context *context, const sl_map *map, const sl_space *space,
                          const sl_faults_options *options, bool trial, sl_faults *out);

/// Gaps, overlaps and crossings (faults_walls.c).
sl_status sli_find_wall_faults(sli_fault_search *search);
/// The point of a wall that is nearest to another point: an end, or rounded.
sl_point sli_nearest_on_wall(const sl_wall *wall, sl_point point);
/// Exact.
bool sli_touches_wall(const sl_wall *wall, sl_point p);
/// Finds the wall as read that a place of a clean wall comes from, one of the same line if there is
/// any; UINT32_MAX for none.
sl_status sli_wall_as_read(sli_fault_search *search, sl_point p, uint32_t line, uint32_t *out);

/// Marks the gaps and leaks that mending leaves (faults_snap.c).
sl_status sli_try_mending(sli_fault_search *search);

/// The plan without its walls, as a net of free pieces (faults_leaks.c).
typedef struct sli_leak_search sli_leak_search;

sl_status sli_leak_search_begin(sli_fault_search *search, sli_leak_search **out);
void sli_leak_search_end(sl_context *context, sli_leak_search *leaks); ///< takes NULL
/// Adds the leaks of a start, with their ways.
sl_status sli_find_leaks_of(sli_leak_search *leaks, sl_point start);

/// Closes gaps up to the width `gap`, in two steps. No end moves farther than `gap` in a step.
///
/// 1. Ends that are near each other become one point: the one that most walls have, else the first.
/// 2. A free end near a wall is put onto it. Two axial walls meet along their own lines; else the
///    end goes to the nearest point, rounded, and the wall is split there. An end that touches a
///    wall already stays.
///
/// Doors and glass with an end at a place that moves go with it, unless they would lose their
/// length. Cells of the map's own no longer fit, and are dropped.
sl_status sli_map_snap(sl_context *context, sl_map *map, double gap, sl_mend_account *account);

#endif

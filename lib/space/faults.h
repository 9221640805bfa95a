/// The search for faults, shared by faults.c, faults_leaks.c and faults_walls.c.
#ifndef SL_SPACE_FAULTS_H
#define SL_SPACE_FAULTS_H

#include "sightline/faults.h"
#include "sightline/support.h"
#include "space/index.h"

#include <math.h>

typedef struct sli_fault_search {
    sl_context *context;
    const sl_map *map;
    const sl_space *space;
    sl_faults_options options;
    double weld; ///< ends at most this far apart are one, as are an end and a wall at half of it
    SL_ARRAY(sl_fault) faults;
    SL_ARRAY(sl_point) points;
} sli_fault_search;

static inline sl_status sli_add_fault(sli_fault_search *search, sl_fault fault) {
    SL_TRY(SL_ARRAY_ROOM(search->context, &search->faults, 1));
    search->faults.items[search->faults.count++] = fault;
    return SL_OK;
}

static inline double sli_apart(sl_point a, sl_point b) {
    return hypot(a.x - b.x, a.y - b.y);
}

/// Gaps, overlaps and crossings (faults_walls.c).
sl_status sli_find_wall_faults(sli_fault_search *search);

/// The plan without its walls, as a net of free pieces (faults_leaks.c).
typedef struct sli_leak_search sli_leak_search;

sl_status sli_leak_search_begin(sli_fault_search *search, sli_leak_search **out);
void sli_leak_search_end(sl_context *context, sli_leak_search *leaks); ///< takes NULL
/// Adds the leaks of a start, with their ways.
sl_status sli_find_leaks_of(sli_leak_search *leaks, sl_point start);

#endif

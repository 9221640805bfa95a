/// The search for faults, shared by faults.c and faults_walls.c.
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

#endif

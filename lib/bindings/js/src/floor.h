/// A map or a baked file under a query: what the modules that do not bake ask.
#ifndef SIGHTLINE_FLOOR_H
#define SIGHTLINE_FLOOR_H

#include "bindings/js/src/bindings.h"
#include "sightline/bake.h"

typedef struct sli_floor {
    sl_baked baked; ///< its space alone, where it comes from a map
    sl_query *query;
    struct sli_answers *answers; ///< what the module keeps for it; NULL before the first question
} sli_floor;

/// Frees what the module keeps for a floor, which goes, or a door of it has moved. NULL is allowed.
void sli_answers_destroy(struct sli_answers *answers);

#endif

/// Undo and redo of the walls.
#ifndef VIEWER_HISTORY_H
#define VIEWER_HISTORY_H

#include "sightline/map.h"

enum { SL_HISTORY_MOST = 100 };

typedef struct sl_walls {
    sl_wall *walls;
    size_t count;
} sl_walls;

/// Zeroed to start.
typedef struct sl_history {
    sl_walls done[SL_HISTORY_MOST], undone[SL_HISTORY_MOST];
    size_t done_count, undone_count;
} sl_history;

/// Keeps the walls as they are, before a change.
sl_status sl_history_keep(sl_context *context, sl_history *history, const sl_map *map);

/// Goes one change back (or forward again); false where there is none.
bool sl_history_undo(sl_context *context, sl_history *history, sl_map *map, bool redo,
                     sl_status *status);

void sl_history_clear(sl_context *context, sl_history *history);

#endif

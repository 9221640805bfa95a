/// Undo and redo of what is changed in the map by hand.
#ifndef VIEWER_HISTORY_H
#define VIEWER_HISTORY_H

#include "sightline/map.h"

enum { SL_HISTORY_MOST = 100 };

/// Zeroed to start.
typedef struct sl_history {
    sl_map done[SL_HISTORY_MOST], undone[SL_HISTORY_MOST];
    size_t done_count, undone_count;
} sl_history;

/// Keeps the map as it is, before a change.
sl_status sl_history_keep(sl_context *context, sl_history *history, const sl_map *map);

/// The last change kept was none.
void sl_history_forget_last(sl_context *context, sl_history *history);

/// Goes one change back (or forward again); false where there is none. *bake tells whether what
/// changed asks for a new bake.
bool sl_history_undo(sl_context *context, sl_history *history, sl_map *map, bool redo, bool *bake,
                     sl_status *status);

void sl_history_clear(sl_context *context, sl_history *history);

#endif

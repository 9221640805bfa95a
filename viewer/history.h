/// Undo and redo of what is changed in the map by hand.
#ifndef VIEWER_HISTORY_H
#define VIEWER_HISTORY_H

#include "sightline/map.h"

enum { HISTORY_MOST = 100 };

/// Zeroed to start.
typedef struct edit_history {
    sl_map done[HISTORY_MOST], undone[HISTORY_MOST];
    size_t done_count, undone_count;
} edit_history;

/// Keeps the map as it is, before a change.
sl_status history_keep(sl_context *context, edit_history *history, const sl_map *map);

/// The last change kept was none.
void history_forget_last(sl_context *context, edit_history *history);

/// Goes one change back (or forward again); false where there is none. *bake tells whether what
/// changed asks for a new bake.
bool history_undo(sl_context *context, edit_history *history, sl_map *map, bool redo, bool *bake,
                  sl_status *status);

void history_clear(sl_context *context, edit_history *history);

#endif

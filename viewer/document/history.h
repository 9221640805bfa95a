/// The changes of a map by hand, for undo and redo: a copy of the map before each of them.
#ifndef VIEWER_HISTORY_H
#define VIEWER_HISTORY_H

#include "sightline/map.h"

enum { HISTORY_MOST = 100 };

/// A map as it was, with the number of that state.
typedef struct kept_map {
    sl_map map;
    uint64_t state;
} kept_map;

typedef struct kept_maps {
    kept_map items[HISTORY_MOST];
    size_t count;
} kept_maps;

/// Zeroed to start. Each state of the map has a number of its own, so that it is known again.
typedef struct edit_history {
    kept_maps done, undone;     ///< the last one is the nearest
    uint64_t state, last_state; ///< that of the map now, and the largest one given
} edit_history;

/// Keeps the map as it is, before a change.
sl_status history_keep(sl_context *context, edit_history *history, const sl_map *map);

/// Drops the last change that was kept: nothing changed.
void history_forget_last(sl_context *context, edit_history *history);

/// Takes the last change back as if it had never been: the map is as it was kept. False where there
/// is none.
bool history_take_back(sl_context *context, edit_history *history, sl_map *map);

/// Goes one change back (or forward); false where there is none. *bake says whether the change
/// needs a new bake.
bool history_undo(sl_context *context, edit_history *history, sl_map *map, bool redo, bool *bake,
                  sl_status *status);

void history_clear(sl_context *context, edit_history *history);

#endif

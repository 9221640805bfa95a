/// A map that is saved in the background: as map text (.map), or baked (.slv).
#ifndef VIEWER_SAVE_JOB_H
#define VIEWER_SAVE_JOB_H

#include "document/document.h"

typedef struct save_job {
    task *task; ///< NULL once it has ended
    sl_map map;
    char *path;
    char *from;   ///< a baked file that has not changed: it is copied; NULL: none
    bool recover; ///< a copy of unsaved changes
    double weld;  ///< negative: the usual
    bool welds;   ///< the map is welded otherwise than its text says: its walls are saved welded
    uint32_t mirror_depth;
    uint64_t state; ///< of the map, as the history numbers it
} save_job;

/// Starts to save a copy of the map. `unchanged`: the map is as it was opened.
sl_status save_start(sl_context *context, const document_state *document, const char *path,
                     bool unchanged, bool recover, save_job **out);
/// Waits for it, and gives its status.
sl_status save_end(sl_context *context, save_job *job);
/// Stops it where it has not ended. NULL: nothing.
void save_free(sl_context *context, save_job *job);

#endif

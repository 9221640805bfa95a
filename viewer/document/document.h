/// What is open: a map with its space and visibility, baked again in the background after each
/// change. Undo belongs to it.
#ifndef VIEWER_DOCUMENT_H
#define VIEWER_DOCUMENT_H

#include "document/history.h"
#include "document/task.h"
#include "sightline/bake.h"
#include "sightline/faults.h"
#include "sightline/import.h"
#include "sightline/map.h"
#include "sightline/query.h"
#include "space/kd_tree.h" // private: a lesson and a layer show the splits

/// How to read a file.
typedef struct document_source {
    char *path;                ///< NULL: none was opened
    sl_import_options options; ///< its texts are the source's
    bool has_start;
    sl_point start;         ///< one beside the map's own
    double lowest, highest; ///< of a 3D model; equal for all else
    unsigned takes;         ///< of sl_import_takes: what the format has a use for
    bool again;             ///< the file that is open with other options: no other one is opened
    bool has_weld;
    double weld;        ///< as sl_clean_options.weld
    bool known;         ///< how to read it was said, now or before: nobody is asked
    sl_segment *closed; ///< openings that are walled up
    size_t closed_count;
} document_source;

/// Whether both read a file alike.
bool document_source_same(const document_source *a, const document_source *b);

/// Closes one more opening.
sl_status document_source_close(sl_context *context, document_source *source, sl_segment opening);

/// Reads its map, with what was closed and the start that was chosen.
sl_status document_source_read(sl_context *context, const document_source *source, sl_map *out);

/// A copy. `to` is untouched on failure.
sl_status document_source_copy(sl_context *context, const document_source *from,
                               document_source *to);
void document_source_destroy(sl_context *context, document_source *source); ///< and zeroes it

typedef struct bake_job bake_job;

enum { OBJECTS_MOST = 256, NOTES_TEXT = 2048 };

/// A document, zeroed to start. Its content stays empty while nothing is open.
typedef struct document_state {
    document_source source;
    sl_map map;            ///< as drawn: what is edited and baked
    sl_baked *baked;       ///< its space may be there before its visibility; NULL while nothing is
    bool has_visibility;   ///< what cells see; stab trees come later, or not
    sl_query *query;       ///< of `baked`; present.h sets what is asked
    sli_split *splits;     ///< of the kd-tree, by node
    double *areas;         ///< of the cells
    double area;           ///< of all cells that count
    double inside_area;    ///< of all cells that are inside
    uint32_t counted;      ///< how many there are
    uint32_t solid;        ///< how many cells are solid ground
    uint32_t mirror_depth; ///< reflections of a sightline, at most
    uint32_t baked_depth;  ///< that cells are seen with
    /// The objects of the map that can be moved, and which of them block sight. A map with too many
    /// has none that can be moved.
    size_t object_count;
    bool *blocks;
    uint32_t version; ///< grows with every change but that of stab trees, for who keeps pictures
    uint32_t sets;    ///< grows with visible sets that are taken over
    uint32_t touched; ///< grows with every change that needs no new bake
    uint32_t opened;  ///< grows with every file that is opened
    uint32_t read;    ///< the same, and with every file that is read again
    char notes[NOTES_TEXT];      ///< what the reader of the file said it took, in lines
    char inside[SL_INSIDE_TEXT]; ///< what is inside, where that is not plain
    bake_job *job;               ///< NULL: none runs
    edit_history history;        ///< of changes by hand
    bool stale;           ///< the map changes while something is dragged: it is to be made anew
    bool live;            ///< the space is one of a drag: no visible sets are made for it
    uint32_t edit, shown; ///< number of the last change that needs a bake, and of the one shown
    double weld;          ///< ends of walls this near to each other are one corner
} document_state;

/// Whether a file has the name of a baked map.
bool document_is_baked(const char *path);

/// Starts to open a file (map or .slv). The old map stays until the new one has its space. Copies
/// the source.
sl_status document_open(sl_context *context, document_state *document,
                        const document_source *source);

/// Starts with a map that is in no file, and takes it over. It counts as one that is opened.
sl_status document_begin(sl_context *context, document_state *document, sl_map *map);

/// The file that is being read; NULL for none.
const char *document_opening(const document_state *document);

/// Starts to bake the map as it is now. `live`: only its space, for the next frame of a drag.
sl_status document_rebuild(sl_context *context, document_state *document, bool live);

/// Starts the space of a drag that has changed the map, once the last one is there: jobs that start
/// at each step would never get that far.
sl_status document_keep_up(sl_context *context, document_state *document);

/// Whether the space that is shown is not that of the map as it is now.
bool document_is_late(const document_state *document);

/// Whether visible sets are there, and hold all that cells see with the present range.
bool document_has_rows(const document_state *document);

/// Whether a job is running that has no space yet.
bool document_awaits_space(const document_state *document);

/// Shows a change of the map that needs no new bake.
void document_touch(document_state *document);

/// Takes over results of the background; sets *changed where there is something new. A job that
/// failed gives its status and message, and the old map stays.
sl_status document_poll(sl_context *context, document_state *document, bool *changed);

/// Waits for the space of a running job, up to this time. The next poll takes it over.
void document_wait_space(const document_state *document, double seconds);

/// Waits until no job runs.
sl_status document_wait(sl_context *context, document_state *document, bool *changed);

/// The space of a drag shows no progress, as long as it comes soon.
job_progress document_progress(const document_state *document);

/// Tells the job to stop, if one runs; whoever cancels it later waits the less.
void document_stop_soon(document_state *document);

/// Stops the job, if one runs.
void document_cancel(sl_context *context, document_state *document);

/// Closes all but the changes kept for undo: the caller clears those.
void document_close(sl_context *context, document_state *document);

#endif

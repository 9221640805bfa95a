/// Cameras, put into the plan by hand or found: their table with its own undo, what they see
/// together, and the search for the fewest that see everything. The last two are made in the
/// background.
#ifndef VIEWER_CAMERAS_H
#define VIEWER_CAMERAS_H

#include "plan/view.h"
#include "sightline/coverage.h"

typedef struct camera_jobs camera_jobs;

enum { CAMERA_NAME = 32, PROOF_TEXT = 256 };

struct camera_layer {
    sl_cameras table;
    size_t chosen;                     ///< SIZE_MAX: none
    uint32_t stamp;                    ///< grows with every change of the table
    uint32_t saved;                    ///< the stamp of the table that a file has; 0: none
    SL_ARRAY(sl_cameras) done, undone; ///< tables before changes; the last one is the nearest
    sl_viewpoint like;                 ///< what a new one looks like
    uint32_t spot;                     ///< the blind spot that was gone to, from 1; 0: none
    bool known;                        ///< `coverage` is there, of `seen_stamp`
    uint32_t seen_stamp;
    sl_coverage coverage;
    char proof[PROOF_TEXT]; ///< of the cameras that were found; "" once they were changed
    camera_jobs *jobs;      ///< NULL: none yet
};

/// The layer, made where there is none yet; NULL without memory, which it reports.
camera_layer *cameras_of(view_state *view);
void camera_layer_destroy(sl_context *context, camera_layer *layer); ///< NULL: nothing
/// Another map was opened: drops the cameras and what was found.
void cameras_clear(view_state *view);

// --- the table

/// The name of a camera, or its number from 1.
void camera_name(const camera_layer *layer, size_t camera, char text[CAMERA_NAME]);
/// The chosen row; NULL: none.
sl_camera *camera_chosen_row(const view_state *view);
/// How it looks; NULL: none.
sl_viewpoint *camera_chosen(const view_state *view);

/// Call before a change: keeps the table for undo. After it: camera_changed().
void camera_keep(view_state *view);
void camera_changed(view_state *view);
/// Drops what was kept last where nothing has changed since.
void camera_settle(view_state *view);

/// Whether a camera can stand there: inside, and not in solid ground.
bool camera_has_ground(const view_state *view, sl_point at);
void camera_add(view_state *view, sl_point at); ///< and chooses it; says so where none can stand
void camera_copy(view_state *view);             ///< the chosen one, beside it
void camera_rename(view_state *view, const char *name); ///< the chosen one; "" takes its name away
void camera_delete(view_state *view);
void camera_choose(view_state *view, int by); ///< the next one, or one before
void camera_turn(view_state *view, double degrees);
void camera_widen(view_state *view, double degrees);
/// Sets the chosen one's field of view, its height over the ground (0: not known), and its tilt
/// below the horizon. Its dead zone and range are those of the ground, but for a smaller range that
/// was set by hand.
void camera_tilt(view_state *view, double fov, double height, double tilt);
void camera_range(view_state *view, double range);  ///< sets it; 0: no limit but that of the ground
void camera_reach(view_state *view, double factor); ///< its range; one without limit gets one
/// Goes back, or forward; false where there is nothing.
bool camera_undo(view_state *view, bool redo);

sl_status cameras_read(view_state *view, const char *path);
sl_status cameras_write(view_state *view, const char *path);
/// How many there are, where no file has them as they are; else 0.
size_t cameras_unsaved(const view_state *view);
/// Takes a table over, to be undone, and chooses none.
void cameras_replace(view_state *view, sl_cameras *table);

// --- by pointer

/// Takes hold of the camera or handle at drag->at; false: there is none.
bool camera_take(view_state *view, drag_state *drag);
void camera_move(view_state *view, drag_state *drag, sl_point now);

// --- what they see

/// Whether the coverage is there, of the table as it is.
bool cameras_are_seen(const view_state *view);
/// Shows a blind spot, from 0; the largest after the last.
void camera_go_to_spot(view_state *view, uint32_t spot);

/// Draws classes of coverage and borders; and marks over the walls.
void cameras_draw_below(view_state *view, const sl_frame *frame);
void cameras_draw_above(view_state *view, const sl_frame *frame);

// --- in the background (camera_jobs.c)

/// Follows the document and the table, in Cameras mode. With `wait` it waits for results.
void cameras_update(view_state *view, bool wait);
/// What is looked for. Those that look like the chosen camera, else like the last that was set.
typedef enum camera_search {
    SEARCH_FEWEST, ///< the fewest that see everything, in place of those that stand
    SEARCH_MORE,   ///< the fewest that see what those that stand do not
    SEARCH_ONE     ///< the one that sees most of it
} camera_search;

/// Starts to look for them.
void cameras_find(view_state *view, camera_search kind);
/// Stops that, and keeps the best; false where nothing runs.
bool cameras_stop(view_state *view);
/// What is looked for. Only while a search runs.
camera_search cameras_search(const camera_layer *layer);
/// Of the search. `done` and `total` are its bounds.
job_progress cameras_progress(const camera_layer *layer);
void camera_jobs_destroy(sl_context *context, camera_jobs *jobs); ///< NULL: nothing

#endif

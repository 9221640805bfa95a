/// The state of the viewer, and the frame that is drawn from it. It knows no window: the window,
/// scripts and tests use it alike.
#ifndef VIEWER_APP_H
#define VIEWER_APP_H

#include "dialogs/dialog.h"
#include "document/document.h"
#include "document/export.h"
#include "document/map_file.h"
#include "document/save.h"
#include "lessons/lesson.h"
#include "plan/changes.h"
#include "plan/heat.h"
#include "plan/layers.h"
#include "plan/present.h"
#include "plan/seen.h"
#include "plan/view.h"
#include "plan/view_cells.h"
#include "sightline/draw.h"
#include "sightline/explain.h"
#include "ui/ui.h"

typedef enum app_mode { MODE_EXPLORE, MODE_LEARN, MODE_DRAW, MODE_QUIZ } app_mode;

typedef enum comparison { COMPARE_OFF, COMPARE_PANES, COMPARE_DIFFERENCE } comparison;

/// A picture that is kept until what it shows changes.
typedef struct kept_picture {
    cairo_surface_t *surface;
    struct {
        uint32_t version, touched, show, depth, dark, views, mark, heat;
        sl_frame frame;
    } key;
    double seconds;   ///< that drawing it took
    plan_items items; ///< that are in it, while the map is edited
} kept_picture;

/// The account as it was drawn last.
typedef struct account_picture {
    cairo_surface_t *surface;
    uint32_t version;
    bool dark;
    double text, made; ///< when, by the clock
} account_picture;

/// What the first-person pane shows: wall pieces drawn, and columns of pixels by what is in them.
typedef struct first_person_counts {
    uint32_t pieces;
    uint32_t mirrors, reflected; ///< mirrors, and what is seen in them
    uint32_t leaves, frames;     ///< doors that are shut, and open ones
    uint32_t dark, tinted;       ///< one-way glass from its dark side, and from the other
} first_person_counts;

/// What the pointer does while its button is down.
typedef enum drag_kind {
    DRAG_NONE,
    DRAG_PAN,
    DRAG_LOOK,
    DRAG_HIT,  ///< a slider, the time line, the dual plane
    DRAG_LINE, ///< the lesson's line, in the plan
    DRAG_END,  ///< a portal end of the lesson
    DRAG_NEW_WALL,
    DRAG_NEW_DOOR,
    DRAG_WALL,
    DRAG_CORNER,
    DRAG_DOOR,
    DRAG_MIRROR,
    DRAG_OBJECT,
} drag_kind;

typedef struct drag_state {
    drag_kind kind;
    hit_area hit;
    sl_point from, last; ///< pointer
    sl_point at;         ///< where it began, in the map
    uint32_t index;
    bool moved;
    // Of a mirror or an object: what of it, where it was, and whether it has been changed.
    int part;
    sl_segment segment;
    bool changed;
} drag_state;

/// An end of a wall, a door or glass that is dragged, and where it was.
typedef struct held_end {
    int kind; ///< of edit.c
    size_t index;
    bool second;
    sl_point was;
} held_end;

typedef struct quiz_state {
    uint32_t from, to;
    bool asked, answered, right;
    bool judged; ///< answered by the user, who said `said`; else only explained
    bool said;
    bool seeded; ///< by the clock; under scripts questions are always the same
    unsigned asked_count, right_count;
    size_t subject, step; ///< of the lesson, while the pair was explained
    uint64_t random;
    sl_explanation explanation; ///< once answered
} quiz_state;

/// What is shown and from where. Results are kept from frame to frame.
typedef struct view_state {
    plan_camera camera;
    bool fitted; ///< the camera fits the map, and follows the window's size
    eye_state eye;
    unsigned show;                ///< layers, of show_bit
    unsigned filled[LAYER_COUNT]; ///< by layer: the larger, the later it was switched on
    unsigned last_filled;         ///< the largest of them
    uint32_t split_depth, tree_depth;
    size_t method, other; ///< of sl_eye_methods: chosen, and compared with
    bool mesh;            ///< the cells are those of a mesh
    comparison compare;
    double motion; ///< seconds for which a moving plan may be drawn by moving the kept picture

    present_state present;
    seen_state seen;

    sl_scene *scene;                    ///< of the plan; NULL: none yet
    sl_scene *tree;                     ///< the stab tree of the eye's cell, likewise
    uint32_t scene_version, scene_show; ///< of what the scene was made
    uint32_t tree_version, tree_cell;   ///< of what the tree was made
    bool tree_dark;
    double pen_size; ///< that lines of the plan are drawn for; it stays while something is dragged
    double draw_seconds;      ///< that a frame takes to draw, smoothed
    kept_picture under, over; ///< below and above what changes from frame to frame
    account_picture account;
    first_person_counts first_person; ///< of the last frame

    heat_choice heat_choice;
    node_layer *nodes; ///< these four: NULL: none yet
    view_layer *views;
    heat_layer *heat;
    watch_layer *watch;
} view_state;

/// What the user does: the mode, keys and pointer, the selection, and the exercises.
typedef struct tool_state {
    app_mode mode;
    unsigned held;    ///< keys, of hold_key
    sl_point pointer; ///< negative: outside
    drag_state drag;
    bool draws_doors;        ///< new doors instead of walls
    int chosen_kind;         ///< of edit.c
    uint32_t chosen;         ///< a wall or a door of the map; UINT32_MAX: none
    SL_ARRAY(held_end) ends; ///< that are dragged
    lesson_state lesson;
    quiz_state quiz;
    path_recorder recorder;
} tool_state;

struct app_state {
    sl_context *context;
    document_state document;
    view_state view;
    tool_state tool;
    ui_state ui;
    dialog_state dialog;
    file_state file;
    export_job *exports;       ///< NULL: no pictures are being written
    sl_import_options options; ///< the command line's, for files opened later too
    /// For pictures that may take longer than a frame has: the window stops them for keys that must
    /// not wait. NULL: they are drawn to their end.
    sl_context *drawing;
    bool steady; ///< under a script: no clock shows, nothing is remembered
    bool quit;
};

void app_init(app_state *app, sl_context *context);
void app_destroy(app_state *app);

/// The first map is there: puts the eye at its start.
void app_take_opened(app_state *app);

/// Shows the message of a failure; nothing for SL_OK.
void app_check(app_state *app, sl_status status);

/// Lets time pass: walks, plays, takes over results of the background.
void app_tick(app_state *app, double seconds);

/// Waits for the background. Scripts need this to be the same on every machine.
void app_settle(app_state *app);

/// The progress of the background; that of the document comes first.
job_progress app_progress(const app_state *app);

/// Draws the whole window of width x height.
void app_draw(app_state *app, cairo_t *cairo);

/// Fits the map into a plan of that size, if the camera is to fit.
void app_fit(app_state *app, sl_box plan);

/// Call before a change by hand: keeps the map for undo.
void app_keep(app_state *app);
/// The same where the change needs a new bake. Call app_after_edit after it: that starts the bake.
void app_before_edit(app_state *app);
void app_after_edit(app_state *app);
/// Call after each step of a drag that changed the map: the space follows, visible sets do not.
void app_after_step(app_state *app);
/// Call after a change that needs no new bake.
void app_after_touch(app_state *app);

/// Whether a point of the map is in solid ground, from where nobody looks.
bool app_is_solid(const app_state *app, sl_point at);

/// The cell of the eye; SL_NO_CELL outside, in solid ground, and without a map.
uint32_t app_eye_cell(const app_state *app);

/// Whether there is a panel at the right.
bool app_has_panel(const app_state *app);

/// The panes below the plan, side by side: rows of the table in modes.c.
enum { PANE_DUAL, PANE_PROGRAM, PANE_FIRST_PERSON, PANE_ACCOUNT, PANE_EFFECTS, PANES_BELOW };

/// Where things are on the page.
typedef struct window_layout {
    sl_box bar, side, status, plan[2], time;
    int plan_count;
    sl_box below[PANES_BELOW]; ///< the plan; of no width where they are not shown
} window_layout;

window_layout app_layout(const app_state *app);

/// Moves a border between panels, of ui_edges, by pixels; positive: the panel grows.
void app_drag_edge(app_state *app, int edge, double by);

void app_open_help(app_state *app);
void app_shut_help(app_state *app);

#endif

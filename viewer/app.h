/// The viewer's state, and the frame that is drawn of it. Knows nothing of windows: the window, a
/// script and a test drive it alike.
#ifndef VIEWER_APP_H
#define VIEWER_APP_H

#include "camera.h"
#include "document.h"
#include "history.h"
#include "layer_nodes.h"
#include "layer_views.h"
#include "layer_watch.h"
#include "layers.h"
#include "lesson.h"
#include "present.h"
#include "record.h"
#include "seen.h"
#include "sightline/canvas.h"
#include "sightline/explain.h"
#include "ui.h"

typedef enum sl_mode { SL_MODE_EXPLORE, SL_MODE_LEARN, SL_MODE_DRAW, SL_MODE_QUIZ } sl_mode;

typedef enum sl_compare { SL_COMPARE_OFF, SL_COMPARE_PANES, SL_COMPARE_DIFFERENCE } sl_compare;

/// Keys held down.
enum sl_hold {
    SL_HOLD_FORWARD = 1,
    SL_HOLD_BACK = 2,
    SL_HOLD_LEFT = 4,
    SL_HOLD_RIGHT = 8,
    SL_HOLD_TURN_LEFT = 16,
    SL_HOLD_TURN_RIGHT = 32,
};

typedef struct sl_eye {
    sl_point at;
    double heading, fov; ///< degrees; 360: all round
    bool flies;          ///< through walls
} sl_eye;

/// A picture that is kept as long as what it shows does not change.
typedef struct sl_kept {
    cairo_surface_t *surface;
    struct {
        uint32_t version, touched, show, depth, dark, views, mark;
        sl_frame frame;
    } key;
    double seconds; ///< that drawing it took
} sl_kept;

/// The account as it was drawn last.
typedef struct sl_account_picture {
    cairo_surface_t *surface;
    uint32_t version;
    bool dark;
    double text, made; ///< when, by the clock
} sl_account_picture;

/// What the pointer does while its button is down.
typedef enum sl_drag_kind {
    SL_DRAG_NONE,
    SL_DRAG_PAN,
    SL_DRAG_LOOK,
    SL_DRAG_HIT,  ///< a slider, the time line, the dual plane
    SL_DRAG_LINE, ///< the lesson's line, in the plan
    SL_DRAG_END,  ///< a portal end of the lesson
    SL_DRAG_NEW_WALL,
    SL_DRAG_WALL,
    SL_DRAG_MIRROR,
    SL_DRAG_OBJECT,
} sl_drag_kind;

typedef struct sl_drag {
    sl_drag_kind kind;
    sl_hit hit;
    sl_point from, last; ///< pointer
    sl_point at;         ///< where it began, in the map
    uint32_t index;
    bool moved;
    // Of a mirror or an object: what of it, where it was, and whether it has been changed.
    int part;
    sl_segment segment;
    bool changed;
} sl_drag;

/// The list that is shown while `maps_open`: files at hand, or the maps of one of them.
typedef struct sl_shelf {
    sl_map_list files;         ///< paths
    sl_document_source source; ///< whose maps are listed; no path: files are
    sl_map_list maps;          ///< of that file
    size_t at, first;          ///< the row that the keys are at, and the first one shown
} sl_shelf;

typedef struct sl_quiz {
    uint32_t from, to;
    bool asked, answered, right;
    unsigned asked_count, right_count;
    uint64_t random;
    sl_explanation explanation; ///< once answered
} sl_quiz;

struct sl_app {
    sl_context *context;
    sl_document document;
    sl_history history;
    sl_camera camera;
    bool fitted; ///< the camera fits the map, and follows the window's size
    sl_eye eye;
    unsigned held; ///< of sl_hold
    unsigned show; ///< of sl_show
    uint32_t split_depth, tree_depth;
    sl_mode mode;
    size_t method, other; ///< of sl_eye_methods: chosen, and compared with
    sl_compare compare;
    bool side_panel, first_person, accounts, effects, help, maps_open, dark;
    double text_scale;
    double density; ///< of the screen: pixels where a common one has 1
    bool steady;    ///< under a script: no clock shows, nothing is remembered
    bool quit;
    int width, height;
    sl_point pointer;
    sl_drag drag;
    bool stale; ///< the map changes while something is dragged: it is to be made anew
    sl_present present;
    sl_seen seen;
    sl_lesson lesson;
    sl_quiz quiz;
    sl_recorder recorder;
    uint32_t wall; ///< chosen, of the map; UINT32_MAX: none
    sl_ui ui;
    sl_kept under, over; ///< below and above what changes from frame to frame
    sl_account_picture account;
    sl_scene *scene;                    ///< that they are drawn of; NULL: none yet
    sl_scene *tree;                     ///< the stab tree of the eye's cell, likewise
    sl_node_layer *nodes;               ///< NULL: none yet
    sl_view_layer *views;               ///< likewise
    sl_watch_layer *watch;              ///< likewise
    uint32_t scene_version, scene_show; ///< of what the scene was made
    uint32_t tree_version, tree_cell;   ///< of what the tree was made
    bool tree_dark;
    double motion;     ///< seconds for which a moving plan may be drawn by moving the kept picture
    char message[512]; ///< the last thing to say
    bool message_is_error;
    sl_shelf shelf;
    sl_import_options options; ///< the command line's, for files opened later too
    double frame_seconds;      ///< smoothed; shown in the corner unless steady
};

void sl_app_init(sl_app *app, sl_context *context);
void sl_app_destroy(sl_app *app);

/// The first map is there: looks at it from its start.
void sl_app_take_opened(sl_app *app);

/// How many times larger than plain lines and marks are drawn.
static inline double sl_app_scale(const sl_app *app) {
    return app->text_scale * app->density;
}
/// The size of plain text, pixels.
static inline double sl_app_text(const sl_app *app) {
    return 13 * sl_app_scale(app);
}

/// Says something in the status line.
void sl_app_say(sl_app *app, bool error, const char *format, ...)
    __attribute__((format(printf, 3, 4)));

/// Says what failed, where something did.
void sl_app_check(sl_app *app, sl_status status);

/// Time goes on: walks, plays, takes over what the background has done.
void sl_app_tick(sl_app *app, double seconds);

/// Waits for the background, so that scripts are the same on every machine.
void sl_app_settle(sl_app *app);

/// How the work in the background stands: the document's before all else.
sl_document_progress sl_app_progress(const sl_app *app);

/// Draws the whole window of width x height.
void sl_app_draw(sl_app *app, cairo_t *cairo);

/// The camera fits the map into a plan of that size, where it is to.
void sl_app_fit(sl_app *app, sl_box plan);

/// The map is about to be changed by hand: remembers it for undo.
void sl_app_keep(sl_app *app);
/// Likewise where a new bake will be needed; after the change, makes all anew.
void sl_app_before_edit(sl_app *app);
void sl_app_after_edit(sl_app *app);
/// The map was changed, and no new bake is needed.
void sl_app_after_touch(sl_app *app);

/// The cell of the eye; SL_NO_CELL outside and without a map.
uint32_t sl_app_eye_cell(const sl_app *app);

/// The panes below the plan, side by side: the rows of the table in panes.c.
enum { SL_PANE_DUAL, SL_PANE_FIRST_PERSON, SL_PANE_ACCOUNT, SL_PANE_EFFECTS, SL_PANES_BELOW };

/// Where things are on the page.
typedef struct sl_layout {
    sl_box bar, side, status, plan[2], time;
    int plan_count;
    sl_box below[SL_PANES_BELOW]; ///< the plan; of no width where they are not shown
} sl_layout;

sl_layout sl_app_layout(const sl_app *app);

#endif

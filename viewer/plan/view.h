/// The view of a document on a page: the camera over the plan, the eye that walks through the map,
/// and what layers and tools of the plan keep from frame to frame.
#ifndef VIEWER_VIEW_H
#define VIEWER_VIEW_H

#include "document/document.h"
#include "plan/changes.h"
#include "plan/layer_table.h"
#include "plan/present.h"
#include "plan/seen.h"
#include "sightline/draw.h"
#include "sightline/support.h"
#include "ui/ui.h"

typedef enum view_mode {
    MODE_EXPLORE,
    MODE_LEARN,
    MODE_DRAW,
    MODE_QUIZ,
    MODE_CAMERAS,
    MODE_PLAN,
    MODES
} view_mode;

typedef struct view_state view_state;

// --- the camera

typedef struct plan_camera {
    sl_point middle;    ///< of the map, in the pane's middle
    double scale;       ///< pixels for a unit of the map
    double least, most; ///< bounds of the scale, by the map's size
} plan_camera;

/// All of `bounds` in a pane of that size, with a margin.
plan_camera camera_fit(sl_box bounds, double width, double height);

/// The frame that draws the whole plane through a pane.
sl_frame camera_frame(const plan_camera *camera, sl_box pane, double unit);

/// The map's point at a place on the page.
sl_point camera_point(const plan_camera *camera, sl_box pane, sl_point page);

// --- the state

/// Keys held down.
enum hold_key {
    HOLD_FORWARD = 1,
    HOLD_BACK = 2,
    HOLD_LEFT = 4,
    HOLD_RIGHT = 8,
    HOLD_TURN_LEFT = 16,
    HOLD_TURN_RIGHT = 32,
};

typedef struct eye_state {
    sl_point at;
    double heading, fov; ///< degrees; 360: all round
    bool flies;          ///< through walls
} eye_state;

/// What the pointer does in Plan mode: it puts the viewpoint, drags a line to see from, puts an end
/// of a path, chooses an axial line, a segment or a room.
typedef enum plan_tool {
    TOOL_ISOVIST,
    TOOL_FROM_LINE,
    TOOL_PATH,
    TOOL_AXIAL,
    TOOL_SEGMENTS,
    TOOL_COMPARE,
    TOOL_ROOMS,
    TOOLS
} plan_tool;

/// Whether a tool paints the plan itself: no layer fills it then, and the eye is not shown.
static inline bool tool_paints(plan_tool tool) {
    return tool == TOOL_FROM_LINE || tool == TOOL_AXIAL || tool == TOOL_SEGMENTS;
}

typedef enum comparison { COMPARE_OFF, COMPARE_PANES, COMPARE_DIFFERENCE } comparison;

/// A picture that is kept until what it shows changes.
typedef struct kept_picture {
    cairo_surface_t *surface;
    struct {
        uint32_t version, touched, show, depth, dark, views, mark, heat, drag;
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
    DRAG_CAMERA,
    DRAG_FROM_LINE,
    DRAG_ZONE,
} drag_kind;

typedef struct drag_state {
    drag_kind kind;
    hit_area hit;
    sl_point from, last; ///< pointer
    sl_point at;         ///< where it began, in the map
    uint32_t index;
    bool moved;
    // Of a mirror, an object or a camera: what of it, where it was, and whether it has been
    // changed.
    int part;
    sl_segment segment;
    bool changed;
} drag_state;

/// What segments can be held by an end.
typedef enum held_kind {
    HELD_WALL,
    HELD_DOOR,
    HELD_MIRROR,
    HELD_ONEWAY,
    HELD_SEAM,
    HELD_KINDS
} held_kind;

/// An end of a wall, a door or glass that is dragged, and where it was.
typedef struct held_end {
    held_kind kind;
    size_t index;
    bool second;
    sl_point was;
} held_end;

/// What is edited by hand.
typedef struct edit_state {
    bool draws_doors; ///< new doors instead of walls
    held_kind chosen_kind;
    uint32_t chosen;         ///< a wall or a door of the map; UINT32_MAX: none
    SL_ARRAY(held_end) ends; ///< that are dragged
    bool bakes;              ///< the drag at hand is one that worlds do not serve
} edit_state;

/// What is chosen of it. Zeroed: the first measure, on a grid of the usual step.
typedef struct heat_choice {
    size_t measure, before; ///< by heat_measure(); the one before steps were chosen
    double step;            ///< 0: the usual one
    bool held;              ///< the colour scale stays as it is
    bool ranks;             ///< each colour has as many points as any other
    double least, most;     ///< its ends then
    uint32_t stamp;         ///< grows with every change of what is drawn
} heat_choice;

typedef struct table_source table_source;

/// How the table of a tool is shown (table.h). Zeroed, but for `chosen`, which is SIZE_MAX.
typedef struct table_state {
    const table_source *of; ///< these four: what the order is of
    size_t rows;
    uint32_t stamp;
    bool sorted; ///< by a column; else as the rows come
    size_t column;
    bool down;
    size_t *order;       ///< rows as they are shown; NULL: as they come
    size_t chosen;       ///< a row; SIZE_MAX: none
    size_t first_column; ///< that is shown
    bool reveal;         ///< scroll to the chosen row
} table_state;

typedef struct node_layer node_layer;
typedef struct view_layer view_layer;
typedef struct heat_layer heat_layer;
typedef struct watch_layer watch_layer;
typedef struct camera_layer camera_layer;
typedef struct route_layer route_layer;
typedef struct from_line from_line;
typedef struct line_map line_map;
typedef struct plan_compare plan_compare;
typedef struct room_map room_map;
typedef struct drag_world drag_world;

/// What is shown and from where. Results are kept from frame to frame.
struct view_state {
    sl_context *context;
    ui_state *ui;
    document_state *document;
    /// For pictures that may take longer than a frame has: the window stops them for keys that must
    /// not wait. NULL: they are drawn to their end.
    sl_context *drawing;
    view_mode mode;
    plan_tool tool;
    double walker;  ///< the radius of who walks a path; 0: a point
    unsigned held;  ///< keys, of hold_key
    sl_box plan[2]; ///< where the plans are on the page, and how many
    int plan_count;
    drag_state drag;
    edit_state edit;
    plan_camera camera;
    bool fitted; ///< the camera fits the map, and follows the window's size
    eye_state eye;
    double source_scale;      ///< of the map that was taken: how long its unit is in the file
    uint32_t source_read;     ///< document->read then
    char *const *building;    ///< of which a storey is open, in the desk; NULL there: none
    struct building_way *way; ///< NULL: none
    double other_cone; ///< degrees: of Plan mode while in another one, else of the other ones
    unsigned show;     ///< layers, of show_bit
    unsigned filled[LAYER_COUNT]; ///< by layer: the larger, the later it was switched on
    unsigned last_filled;         ///< the largest of them
    uint32_t split_depth, tree_depth;
    size_t method, other; ///< of sl_eye_methods: chosen, and compared with
    bool in_the_making;   ///< the lesson of the subdivision: cells have no numbers yet
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
    node_layer *nodes; ///< these nine: NULL: none yet
    view_layer *views;
    heat_layer *heat;
    watch_layer *watch;
    camera_layer *cameras;
    route_layer *route;
    from_line *from_line;
    line_map *lines[2];     ///< axial lines, and segments
    size_t line_measure[2]; ///< the chosen measures of both
    table_state table;
    plan_compare *compared; ///< NULL: none
    room_map *rooms;        ///< likewise
    text_field name;        ///< that is typed for what is chosen
    bool drawn_lines;       ///< both are of the lines as they are drawn
    drag_world *drag_world; ///< NULL: none
    uint32_t drag_worlds;   ///< how many there were
    size_t world_walls;     ///< maps with as many walls are dragged in by worlds
};

/// Shows the message of a failure; nothing for SL_OK.
static inline void view_check(view_state *view, sl_status status) {
    ui_report(view->ui, view->context, status);
}

/// The place of the map under the pointer; false: it is not over the first plan.
bool view_pointed(const view_state *view, sl_point *at);

/// "12.34, 5.6": to about a ten-thousandth of the map's size, however far from the origin it is.
enum { PLACE_TEXT = 72 };
void view_say_place(const sl_map *map, sl_point at, char text[PLACE_TEXT]);

/// Marks a place of the map by a disc.
void view_mark(const view_state *view, const sl_frame *frame, sl_point place);

/// Follows the document and the eye.
void view_follow(view_state *view);

/// Drops the scenes of the plan and of the stab tree.
void view_drop_scenes(view_state *view);

/// Whether a point of the map is in solid ground, from where nobody looks.
bool view_is_solid(const view_state *view, sl_point at);

/// The cell of the eye; SL_NO_CELL outside, in solid ground, and without a map.
uint32_t view_eye_cell(const view_state *view);

// --- changes by hand

/// Changes the mode. In Plan mode the eye has a cone of its own, all round to begin with: there its
/// region is measured.
void view_set_mode(view_state *view, view_mode mode);
/// Call before one: keeps the map for undo.
void view_keep(view_state *view);
/// The same where the change needs a new bake. Call view_after_edit after it: that starts the bake.
void view_before_edit(view_state *view);
void view_after_edit(view_state *view);
/// Call after each step of a drag that changed the map: the space follows, visible sets do not. Of
/// a large map what the eye sees follows alone (drag_world.h).
void view_after_step(view_state *view);
/// Whether what is shown is not that of the map as it is now.
bool view_is_late(const view_state *view);
/// Call after a change that needs no new bake.
void view_after_touch(view_state *view);

// --- the camera, moved by hand: the plan no longer fits the pane by itself

/// Moves the plan by pixels, right and down.
void view_pan(view_state *view, double dx, double dy);

/// Zooms; the place at `offset` (pixels from the middle of the pane, right and down) stays.
void view_zoom(view_state *view, double factor, sl_point offset);

// --- the eye

/// The speed of the eye in map units a second: it depends on the size of cells.
double walk_speed(const document_state *document);

/// Moves the eye by the keys that are held. Walls stop a walking eye by an exact test, and it
/// slides along them.
void walk_tick(view_state *view, double seconds);

/// Puts the eye at the map's first start, or into the middle of its largest cell that counts.
void walk_home(view_state *view);

#endif

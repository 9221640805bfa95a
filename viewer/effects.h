/// What a map has beside walls: the effects in words, and doors, mirrors, objects and the view
/// range as they are changed by hand.
#ifndef VIEWER_EFFECTS_H
#define VIEWER_EFFECTS_H

#include "app.h"
#include "sightline/effects.h"

// --- in words

enum { CALLS_TEXT = 160 };

/// "calls for doors (6), mirrors (2)"; where nothing does, that.
void effects_in_words(const sl_map *map, char text[CALLS_TEXT]);

/// The effects that nothing in the map calls for: "mirrors, a view range"; empty where there are
/// none.
void effects_left_out(const sl_map *map, char text[CALLS_TEXT]);

// --- doors

/// The door under a place of the plan; UINT32_MAX for none.
uint32_t door_at(const app_state *app, sl_point at);

/// Shuts a door that is open, and opens one that is shut.
void door_toggle(app_state *app, uint32_t door);

/// The door nearest to the eye.
void door_toggle_nearest(app_state *app);

// --- mirrors: moved by an end, or whole

typedef enum grip { GRIP_A, GRIP_B, GRIP_WHOLE } grip;

/// The mirror under a place of the plan, and what of it; UINT32_MAX for none.
uint32_t mirror_at(const app_state *app, sl_point at, grip *part);

/// The pointer takes hold of what is under it; false where that is no mirror.
bool mirror_take(app_state *app, drag_state *drag);
/// Moves what it holds; ends go from one point of the grid to another.
void mirror_move(app_state *app, drag_state *drag, sl_point now);
/// Lets it go.
void mirror_drop(app_state *app, const drag_state *drag);

enum { MIRROR_DEPTH_MOST = 6 };

/// How often a sightline is reflected at most: what the eye sees follows at once. What cells see is
/// made anew once the depth has been chosen.
void mirror_set_depth(app_state *app, uint32_t depth);
void mirror_settle_depth(app_state *app);

/// The mirror that is held, or that could be, with its ends.
void mirror_draw(app_state *app, const sl_frame *frame);

// --- objects: boxes that are seen or not, and block sight or not; nothing is baked anew

/// The object whose border is under a place of the plan; UINT32_MAX for none.
uint32_t object_at(const app_state *app, sl_point at);

/// The pointer takes hold of what is under it; false where that is no object.
bool object_take(app_state *app, drag_state *drag);
/// Moves what it holds, by steps of the grid.
void object_move(app_state *app, drag_state *drag, sl_point now);
/// An object that did not block sight does, or the other way round.
void object_toggle(app_state *app, uint32_t object);

/// Those that are seen, those that block, and the one that is held.
void object_draw(app_state *app, const sl_frame *frame);

/// What there is to say of one.
void object_describe(const app_state *app, uint32_t object, char *text, size_t room);

// --- the view range

/// The farthest that the slider goes: the map's diagonal.
double range_most(const document_state *document);

/// Puts a range, above 0, in place of the one that is set; for the time being without a bake.
void range_set(app_state *app, double range);

/// Sets a range where there is none, and lifts the one that there is.
void range_toggle(app_state *app);

/// The range has been chosen: what cells see is made anew, where it was made with another one.
void range_settle(app_state *app);

/// The circle about the eye.
void range_draw(app_state *app, const sl_frame *frame);

#endif

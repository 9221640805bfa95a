/// What a map has beside walls: the effects in words; doors, mirrors, objects and the view range,
/// changed by hand.
#ifndef VIEWER_EFFECTS_H
#define VIEWER_EFFECTS_H

#include "plan/view.h"
#include "sightline/effects.h"

// --- in words

enum { CALLS_TEXT = 160 };

/// "calls for doors (6), mirrors (2)"; "" for a map without effects.
void effects_in_words(const sl_map *map, char text[CALLS_TEXT]);

/// The effects that the map does not need: "mirrors, a view range"; empty if it needs all.
void effects_left_out(const sl_map *map, char text[CALLS_TEXT]);

// --- doors

/// The door under a place of the plan; UINT32_MAX for none.
uint32_t door_at(const view_state *view, sl_point at);

/// Shuts an open door, opens a shut one, with all doors of its name.
void door_toggle(view_state *view, uint32_t door);

/// The same for the door nearest to the eye.
void door_toggle_nearest(view_state *view);

// --- mirrors: moved by an end, or whole

typedef enum grip { GRIP_A, GRIP_B, GRIP_WHOLE } grip;

/// Takes hold of the mirror under the pointer; false for none.
bool mirror_take(view_state *view, drag_state *drag);
/// Moves the mirror that is held. Ends move on the grid.
void mirror_move(view_state *view, drag_state *drag, sl_point now);
/// Lets the mirror go.
void mirror_drop(view_state *view, const drag_state *drag);

enum { MIRROR_DEPTH_MOST = 6 };

/// Sets how often a sightline is reflected at most. What the eye sees follows at once. Visible sets
/// are baked again by mirror_settle_depth.
void mirror_set_depth(view_state *view, uint32_t depth);
void mirror_settle_depth(view_state *view);

/// Draws the mirror that is held or under the pointer, with its ends.
void mirror_draw(view_state *view, const sl_frame *frame);

// --- objects: boxes that are seen or not, and block sight or not; nothing is baked anew

/// The object whose border is under a place of the plan; UINT32_MAX for none.
uint32_t object_at(const view_state *view, sl_point at);

/// Takes hold of the object under the pointer; false for none.
bool object_take(view_state *view, drag_state *drag);
/// Moves the object that is held, by steps of the grid.
void object_move(view_state *view, drag_state *drag, sl_point now);
/// Makes an object block sight, or stops it from doing so.
void object_toggle(view_state *view, uint32_t object);

/// Draws the objects that are seen, that block sight, and the one that is held.
void object_draw(view_state *view, const sl_frame *frame);

/// Describes an object in a sentence.
void object_describe(const view_state *view, uint32_t object, char *text, size_t room);

// --- the view range

/// The largest range of the slider: the map's diagonal.
double range_most(const document_state *document);

/// Sets a range above 0, without a bake for now.
void range_set(view_state *view, double range);

/// Sets a range where there is none, else removes it.
void range_toggle(view_state *view);

/// The range is chosen: bakes again where the bake had another one.
void range_settle(view_state *view);

/// Draws the circle about the eye.
void range_draw(view_state *view, const sl_frame *frame);

#endif

/// Mirrors, moved by hand: by an end, or whole. What is seen follows while they move, as fast as
/// cells are made anew in the background.
#ifndef VIEWER_MIRRORS_H
#define VIEWER_MIRRORS_H

#include "app.h"

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

#endif

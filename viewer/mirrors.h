/// Mirrors, moved by hand: by an end, or whole. What is seen follows while they move, as fast as
/// cells are made anew in the background.
#ifndef VIEWER_MIRRORS_H
#define VIEWER_MIRRORS_H

#include "app.h"

typedef enum sl_grip { SL_GRIP_A, SL_GRIP_B, SL_GRIP_WHOLE } sl_grip;

/// The mirror under a place of the plan, and what of it; UINT32_MAX for none.
uint32_t sl_mirror_at(const sl_app *app, sl_point at, sl_grip *part);

/// The pointer takes hold of what is under it; false where that is no mirror.
bool sl_mirror_take(sl_app *app, sl_drag *drag);
/// Moves what it holds; ends go from one point of the grid to another.
void sl_mirror_move(sl_app *app, sl_drag *drag, sl_point now);
/// Lets it go.
void sl_mirror_drop(sl_app *app, const sl_drag *drag);

enum { SL_MIRROR_DEPTH_MOST = 6 };

/// How often a sightline is reflected at most: what the eye sees follows at once. What cells see is
/// made anew once the depth has been chosen.
void sl_mirror_set_depth(sl_app *app, uint32_t depth);
void sl_mirror_settle_depth(sl_app *app);

/// The mirror that is held, or that could be, with its ends.
void sl_mirror_draw(sl_app *app, const sl_frame *frame);

#endif

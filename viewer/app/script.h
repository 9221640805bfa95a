/// Text commands that drive the viewer, one a line; '#' starts a comment.
///
///   open FILE            key NAME        down NAME / up NAME     action NAME
///   move X Y             click X Y       right X Y               drag X Y X2 Y2
///   wheel STEPS          wait FRAMES     size W H                eye X Y HEADING [CONE]
///   screenshot FILE      save FILE       account FILE            export FOLDER
///   text SCALE           drop FILE       type TEXT               expect TEXT
///
/// `drop` opens as `open` does, and asks first if changes would be lost. `type` is for a dialog.
/// `expect` fails where no title or message contains the text.
#ifndef VIEWER_SCRIPT_H
#define VIEWER_SCRIPT_H

#include "app/app.h"

/// Runs a script. Calls `after` (NULL: nothing) with `user` after each frame.
sl_status script_run(app_state *app, const char *path, void (*after)(void *user, app_state *app),
                     void *user);

/// Draws a frame onto nothing, so that clicks find what is there.
void script_frame(app_state *app);

#endif

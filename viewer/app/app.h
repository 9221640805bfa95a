/// The state of the viewer. It knows no window: the window, scripts and tests use it alike.
#ifndef VIEWER_APP_H
#define VIEWER_APP_H

#include "dialogs/desk.h"
#include "document/export.h"
#include "document/recorder.h"
#include "lessons/learn.h"

/// Each part points to those before it that it needs.
typedef struct app_state {
    sl_context *context;
    ui_state ui;
    document_state document;
    path_recorder recorder;
    export_state exports;
    view_state view;
    learn_state learn;
    desk_state desk;
} app_state;

#endif

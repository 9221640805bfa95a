/// Copies of maps with unsaved changes, in $XDG_STATE_HOME/sightline, for when the program ends
/// without saving.
///
/// A session has three files: unsaved-ID.lock, which it keeps locked while it runs, unsaved-ID.map,
/// the copy, and unsaved-ID.of, the name of the file that the map is of. The system drops the lock
/// when the program ends, however it ends. A lock that can be taken is of a session that is over:
/// a copy beside it was never saved. The lock comes first and goes last.
#ifndef VIEWER_SESSION_H
#define VIEWER_SESSION_H

#include "document/files.h"

/// Zeroed: none.
typedef struct session {
    char *name; ///< of its files, without their endings; NULL: none
    int lock;   ///< open while we have it
} session;

/// The path of one of its files.
void session_path(const session *s, const char *ending, char path[PATH_TEXT]);

/// A new one, with its lock; false without a folder for it.
bool session_begin(sl_context *context, session *s);

/// Finds the session that is over and comes next by name after another one ("": the first), so that
/// none is asked about twice. Takes its lock. False where there is none.
bool session_find(sl_context *context, const char *after, session *s);

/// Removes its files; none: nothing.
void session_remove(sl_context *context, session *s);
/// Lets it go, and leaves its files.
void session_leave(sl_context *context, session *s);

#endif

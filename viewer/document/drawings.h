/// How drawings are read, as it was chosen for each: kept between runs beside the recent files.
#ifndef VIEWER_DRAWINGS_H
#define VIEWER_DRAWINGS_H

#include "document/files.h"

/// Whether a file is a floor plan, by its ending: a drawing or a picture.
bool drawing_is(const char *path);

/// Takes over what was chosen for the source's file: layers, unit, entrance, weld, start, doors and
/// closed openings. Its texts are the source's own. False, and nothing is changed, where nothing
/// was chosen yet. SL_NO_MEMORY in *status leaves the source to be destroyed.
bool drawing_recall(sl_context *context, document_source *source, sl_status *status);

/// Keeps what is chosen for the file. What cannot be kept is not.
void drawing_remember(sl_context *context, const document_source *source);

#endif

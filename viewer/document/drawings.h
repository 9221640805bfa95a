/// How drawings are read, as it was chosen for each, and the rooms and zones that were named in a
/// plan: kept between runs beside the recent files.
#ifndef VIEWER_DRAWINGS_H
#define VIEWER_DRAWINGS_H

#include "document/files.h"
#include "sightline/support.h"

/// Whether a file is a floor plan, by its ending: a drawing or a picture.
bool drawing_is(const char *path);

/// How a plan of this file gets a unit, as a clause; NULL: of no file.
const char *drawing_unit_hint(const char *path);

/// Takes over what was chosen for the source's file: layers, unit, entrance, weld, start, doors,
/// error of curves, threshold and closed openings. Its texts are the source's own. False, and
/// nothing is changed, where nothing was chosen yet. SL_NO_MEMORY in *status leaves the source to
/// be destroyed.
bool drawing_recall(sl_context *context, document_source *source, sl_status *status);

/// Keeps what is chosen for the file. What cannot be kept is not.
void drawing_remember(sl_context *context, const document_source *source);

enum { PLACE_NAME = 64 };

/// A zone with its name; or, where the box is a point, the name of the room about it.
typedef struct named_place {
    sl_box box;
    char name[PLACE_NAME];
} named_place;

typedef SL_ARRAY(named_place) named_places;

/// Adds what was named in the file's plan to both lists. SL_NO_MEMORY.
sl_status places_recall(sl_context *context, const char *path, named_places *rooms,
                        named_places *zones);

/// Keeps them, or that there are none. What cannot be kept is not.
void places_remember(sl_context *context, const char *path, const named_places *rooms,
                     const named_places *zones);

#endif

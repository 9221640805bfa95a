/// The answer of `sightline eye` as a file for other programs.
#ifndef EYE_FILES_H
#define EYE_FILES_H

#include "studies/eye_run.h"

/// What eye_files_write() takes: names that end so.
#define EYE_FILES ".geojson .csv"

/// Writes a file by the ending of its name. GeoJSON: the eye, the visible region, what is seen by
/// mirror, the objects, and each cell that a method keeps. CSV: a line for each such cell.
sl_status eye_files_write(sl_context *context, const sl_baked *baked, const eye_run *run,
                          const eye_objects *objects, double heading, double fov, const char *path);

#endif

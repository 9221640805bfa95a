/// Viewpoints: cameras, guards, lamps, sensors; and tables of them.
#ifndef SIGHTLINE_VIEWPOINT_H
#define SIGHTLINE_VIEWPOINT_H

#include "sightline/context.h"
#include "sightline/geometry.h"

#include <stdio.h>

#ifdef __cplusplus
extern "C" {
#endif

/// A place to look from, and how far and wide it looks.
typedef struct sl_viewpoint {
    sl_point at;
    double heading; ///< degrees, counter-clockwise from +x; of no use where fov is 360
    double fov;     ///< width of the view cone in degrees, over 0 to 360; 360: all round
    double range;   ///< sees no farther, in the map's unit; 0: no limit
    double nearest; ///< sees nothing nearer: the dead zone below a camera; 0: none
    bool sign;      ///< it is a sign, which is read (sl_viewpoint_sign)
} sl_viewpoint;

/// The distance factor of signs that light falls on: they are read from so many times the height of
/// their letters (EN 1838; those lit from within, from twice as far).
#define SL_SIGN_FACTOR 100.0

/// Makes a viewpoint a sign: where can it be read? It faces its heading. Straight before it, it is
/// read from `range`, which is at most SL_SIGN_FACTOR times the height of its letters (0: not
/// given). At an angle letters look narrower, so the distance shrinks with the cosine of the angle.
/// That is a disc: `range` wide, it touches the wall of the sign (Xie, Filippidis, Gwynne, Galea,
/// Blackshields and Lawrence 2007, Signage Legibility Distances as a Function of Observation Angle:
/// the visibility catchment area, for a sign that is small beside its distance).
///
/// A sign counts from 2^-44 times the largest coordinate before its place: one on a wall hangs on
/// the side that it faces.
SL_API void sl_viewpoint_sign(sl_viewpoint *viewpoint, double letters);

/// How wide the picture of a camera is, by its height, where nothing else is known: 16:9.
#define SL_PICTURE_ASPECT (16.0 / 9)

/// The ground that a tilted camera sees: `nearest` and `range` where the lower and the upper border
/// of its picture meet the ground. `height` over the ground, in map units; `tilt` of its axis below
/// the horizon in degrees, 0 to 90; `fov` is the width of its cone, and the picture is `aspect`
/// times as wide as high, usually SL_PICTURE_ASPECT. The smaller range counts. A cone of 180
/// degrees and more keeps what it has.
SL_API void sl_viewpoint_tilt(sl_viewpoint *viewpoint, double height, double tilt, double aspect);

/// A row of a table.
typedef struct sl_camera {
    char *name; ///< UTF-8; NULL for none
    sl_viewpoint view;
    double height, tilt; ///< as they are given; 0 where they are not. `view` has what comes of them
    double letters;      ///< height of the letters of a sign; 0 where it is not given
    double cost;         ///< 1 where it is not given
    unsigned line;       ///< of the file
} sl_camera;

/// Zeroed, it is empty.
typedef struct sl_cameras {
    sl_camera *items;
    size_t count, capacity;
} sl_cameras;

/// Reads a table of viewpoints: columns name, x, y, heading, fov, range, height, tilt, letters,
/// sign, cost in any order and case, of which x and y are needed. A row with letters, or with a
/// sign other than 0, is a sign (sl_viewpoint_sign). Without a line of names: x, y, and maybe
/// heading, fov and range. Commas, semicolons or tabs stand between the columns. With semicolons or
/// tabs, numbers may have decimal commas. What a row leaves out is that of `like`. With height and
/// tilt the dead zone and the range are those of the ground (sl_viewpoint_tilt, SL_PICTURE_ASPECT).
/// Notes columns of other names, which are passed over.
///
/// SL_BAD_INPUT, with file and line, for what is no table of viewpoints, and for values out of
/// range; without a row, too. "-" is standard input.
SL_API sl_status sl_cameras_read(sl_context *context, const char *path, const sl_viewpoint *like,
                                 sl_cameras *out);
/// The same from memory; `path` is for messages.
SL_API sl_status sl_cameras_parse(sl_context *context, const char *path, const char *text,
                                  size_t size, const sl_viewpoint *like, sl_cameras *out);
/// Prints a table that reads back as the same. Columns that no row needs are left out, but for x
/// and y.
SL_API void sl_cameras_print(const sl_cameras *cameras, FILE *out);
/// The same to a file, "-" for standard output.
SL_API sl_status sl_cameras_write(sl_context *context, const sl_cameras *cameras, const char *path);
/// Adds a row with a copy of its name.
SL_API sl_status sl_cameras_add(sl_context *context, sl_cameras *cameras, const sl_camera *camera);
SL_API void sl_cameras_destroy(sl_context *context, sl_cameras *cameras); ///< and zeroes it

#ifdef __cplusplus
}
#endif

#endif

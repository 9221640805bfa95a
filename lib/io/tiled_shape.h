/// Tiled's objects as walls: rectangles, ellipses, polygons, polylines.
#ifndef SL_IMPORT_TILED_SHAPE_H
#define SL_IMPORT_TILED_SHAPE_H

#include "io/json.h"
#include "io/pen.h"

typedef enum sl_tiled_kind {
    SL_TILED_RECTANGLE,
    SL_TILED_ELLIPSE,
    SL_TILED_POLYGON,
    SL_TILED_POLYLINE,
    SL_TILED_PICTURE, ///< a tile as an object: a rectangle that stands on its place
    SL_TILED_OTHER,   ///< a point, a text, a capsule, an instance of a template
} sl_tiled_kind;

typedef struct sl_tiled_shape {
    sl_tiled_kind kind;
    double x, y, width, height; ///< pixels, y down
    double rotation;            ///< degrees, clockwise, about x, y
    uint32_t gid;               ///< of a picture
    uint32_t line;              ///< 0 where there is none
    sl_json points;             ///< of a polygon or polyline, from x, y
} sl_tiled_shape;

/// Reads what an object is; `object` must outlive the shape.
sl_status sl_tiled_read_shape(const sl_json *object, sl_tiled_shape *shape);

/// Draws the outline. The pen's affine leads from the object's layer to the map.
sl_status sl_tiled_draw_shape(sl_pen *pen, const sl_tiled_shape *shape);

#endif

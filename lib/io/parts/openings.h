/// Openings that are drawn over walls which go on beneath them: doors on layers of doors, swings of
/// doors, bars in the colour of the paper. The walls are cut there.
#ifndef SL_OPENINGS_H
#define SL_OPENINGS_H

#include "sightline/map.h"
#include "sightline/support.h"

/// A rectangle over walls: those are cut that go through it from end to end.
typedef struct sli_opening {
    sl_point from, to; ///< the middles of its ends
    double half;       ///< of its width
    bool box;          ///< it is drawn as wide as it is; else as a line
    double core;       ///< a door: how thick the wall may be whose faces it lies between; else 0
    double pen;    ///< half the width of lines that walls are drawn by, if it lies on them; else 0
    size_t below;  ///< only walls before this one are beneath it
    size_t shape;  ///< for who asks: which shape it is; SIZE_MAX for none
    bool window;   ///< for who asks: it is glazed
    bool cuts;     ///< it cuts a wall; set by sli_openings_cut()
    sl_segment at; ///< what it cuts out of the first such wall
} sli_opening;

/// A piece that is taken out of a wall.
typedef struct sli_opening_cut {
    size_t wall, opening;
    double begin, end; ///< as shares of the wall
    double left;       ///< how far at the left of the opening it is
    sl_segment at;     ///< from the end that is nearer to the wall's first one
} sli_opening_cut;

/// Zeroed, there are none.
typedef struct sli_openings {
    SL_ARRAY(sli_opening) items;
    SL_ARRAY(sli_opening_cut) cuts; ///< by wall, then from its first end on
    SL_ARRAY(sl_wall) jambs;        ///< between the two faces of a wall, at both ends of an opening
} sli_openings;

void sli_openings_destroy(sl_context *context, sli_openings *openings);

/// Adds the opening that walls draw, if they do: one line, or a closed outline of four sides that
/// is a rectangle, within a twentieth. Of one that is nearly a square both directions count. `wide`
/// is how wide a line is; openings shorter than `least` or longer than `most` are none.
sl_status sli_openings_add(sl_context *context, const sl_wall *walls, size_t count, double wide,
                           double least, double most, size_t below, size_t shape,
                           sli_openings *out);

/// Finds the pieces of walls that the openings cut out, among the walls that are in `kept`. Two
/// walls that one opening cuts are the faces of one wall: jambs close it. A door between the faces
/// of a wall, or a line along one, cuts both. An opening that cuts nothing so cuts the walls whose
/// lines, as wide as they are drawn, it lies on.
sl_status sli_openings_cut(sl_context *context, const sl_map *map, const sl_bits *kept,
                           sli_openings *openings);

#endif

/// Shapes of a drawing by how they look: the colour and the width of their lines, or the colour
/// that they are filled with. Where no name says what is a wall, the heaviest look is: thick dark
/// lines or bars against thin grey furniture, small lettering and coloured floors.
#ifndef SL_DRAWN_LOOKS_H
#define SL_DRAWN_LOOKS_H

#include "map/scan.h"
#include "sightline/map.h"
#include "sightline/support.h"

enum { SLI_LOOK_NAME = 40 };

/// How a shape is painted.
typedef struct sli_ink {
    bool line;       ///< by its line; else it is filled
    bool known;      ///< the colour is; a pattern, or one that is not read, is not
    uint32_t colour; ///< 0xRRGGBB, as it is seen on white
    double width;    ///< of the line, in the map's unit
} sli_ink;

typedef struct sli_look {
    sli_ink ink;
    char name[SLI_LOOK_NAME]; ///< "black line 3", "#d0e0ff fill"
    size_t shapes, walls;
    double length, around, area; ///< of long walls; of all; enclosed by each shape
    sl_box box;                  ///< about the long walls
    size_t rooms;                ///< shapes drawn by lines that are as large as rooms
    double room_area;            ///< of their boxes, as a share of the drawing's
    double weight;               ///< how much like a wall it looks; 0: not at all
    bool taken;
    bool glazed; ///< some of its lines are windows, though it is not taken
    bool kept;   ///< some of its shapes are walls in the end: not all are lettering
} sli_look;

/// How much like walls a look is among those that are not the heaviest: its long lines count by
/// their weight.
static inline double sli_look_likeness(const sli_look *look) {
    return look->length * (look->weight > 1e-9 ? look->weight : 1e-9);
}

/// Zeroed, there are none.
typedef struct sli_looks {
    SL_ARRAY(sli_look) items;
    uint32_t last;
} sli_looks;

/// Walls of one shape.
typedef struct sli_look_shape {
    size_t first, end;
    uint32_t look;
} sli_look_shape;

/// The number of the look of an ink.
sl_status sli_looks_find(sl_context *context, sli_looks *looks, const sli_ink *ink, uint32_t *out);

/// Whether a name may be that of a look.
bool sli_look_may_be(sli_word name);

/// How light what all shapes lie on is, from 0 to 1: paper is white, but for a filled shape that
/// holds all others.
double sli_looks_ground(const sl_map *map, const sli_look_shape *shapes, size_t count,
                        sli_looks *looks);
/// Whether an ink has the colour of the ground.
bool sli_ink_is_ground(const sli_ink *ink, double ground);

/// Chooses the looks that are walls, by the shapes whose names say nothing; the first shape lies
/// lowest. `taken`, all zero, gets the shapes that are walls: those of the looks that are taken,
/// but for lettering, and for a page that all lies on. `*chosen`: it leaves some out, and three
/// walls at least. Looks that are alike in weight stay together. Returns their share of all long
/// lines.
double sli_looks_choose(const sl_map *map, const sli_look_shape *shapes, size_t count,
                        sli_looks *looks, sl_bits *taken, bool *chosen);

#endif

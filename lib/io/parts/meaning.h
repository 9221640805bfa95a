/// What a layer, a group or a block of a drawing means by its name, in the languages that plans
/// come in: walls, doors, windows, or something else that stops no sight.
#ifndef SL_MEANING_H
#define SL_MEANING_H

#include "map/scan.h"

/// What a name says. Where it has words of several kinds, the last kind of this list counts:
/// "window schedule text" is text, "wall hatch" is hatch.
typedef enum sli_meaning {
    SLI_MEANS_NOTHING,
    SLI_MEANS_WALL, ///< columns and other parts of the building too
    SLI_MEANS_FRAME,
    SLI_MEANS_DOOR,
    SLI_MEANS_WINDOW,
    SLI_MEANS_OTHER, ///< roofs, ceilings, sections, what is torn down
    SLI_MEANS_SITE,
    SLI_MEANS_GRID,
    SLI_MEANS_STAIRS,
    SLI_MEANS_FURNITURE, ///< and equipment
    SLI_MEANS_HATCH,
    SLI_MEANS_TEXT, ///< and dimensions
    SLI_MEANS_LOW,  ///< no name says it: what stops steps and not sight
    SLI_MEANINGS,
} sli_meaning;

/// The kind for a message: "furniture"; "" for SLI_MEANS_NOTHING.
const char *sli_meaning_text(sli_meaning meaning);

/// What the words of a name say. Capitals and accents are the same as plain letters. The name is
/// UTF-8; bytes that are not count as Latin-1. Letters that DXF files (\U+5899) and Illustrator
/// (_xE4_) write as numbers are read. In "plan|A-WALL" and "plan$0$A-WALL", the names of layers of
/// other drawings, the last part counts, unless it says nothing. Layer codes of ISO 13567 are known
/// by the element that they name (CI/SfB table 1).
sli_meaning sli_meaning_of(sli_word name);

/// Whether a name of windows or doors says walls too, and not what walls of glass are called:
/// "walls, windows".
bool sli_meaning_is_wall_too(sli_word name);
/// Whether all words of a name are words for rooms: a layer of their outlines, or one room.
bool sli_meaning_is_rooms(sli_word name);
/// Whether a name is that of the nodes of a route graph, or of what may be its edges.
bool sli_meaning_is_nodes(sli_word name);
bool sli_meaning_is_edges(sli_word name);
/// Whether a name has a word for ways in and out.
bool sli_meaning_is_way_in(sli_word name);

#endif

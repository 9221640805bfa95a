/// The document as sight finds it now. Shut doors are walls, and so is glass that is dark from
/// where the eye is. Without such walls it is the document itself, and costs nothing.
#ifndef VIEWER_PRESENT_H
#define VIEWER_PRESENT_H

#include "document.h"
#include "sightline/mirrored.h"
#include "sightline/moving.h"
#include "sightline/support.h"

/// Zeroed to start. The pointers are NULL while nothing is open.
typedef struct present_state {
    uint32_t version;      ///< grows with every change, the document's among them
    const sl_space *space; ///< its cells and directed portals' cells are the document's; directed
                           ///< portals are not
    const sl_outline *outline;
    /// Where something is shut, the search has the visible sets of the eye's cells alone. It has
    /// none where the bake had a shorter range.
    sl_eye_search *search;
    /// The space with the map's objects and mirrors in it; NULL where it has none, or where they
    /// cannot be put in. If any of them blocks sight, the outline is that of this space, and its
    /// cell c is a part of cell parents[c]. Else `parents` is NULL.
    sl_moving *moving;
    bool still; ///< objects cannot be put in as they are now
    const uint32_t *parents;
    sl_room_mirrors mirrors; ///< of the outline; none where the map has none
    bool *shut;              ///< by door, then by glass; NULL where the map has neither
    size_t shut_count;
    struct present_own *own; ///< what is made for it; NULL while it is the document itself
    bool *wanted;            ///< scratch, as `shut`
    uint32_t document_version, mirrors_version, touched;
    bool backwards; ///< the caller's: as the eye is seen, not as it sees; there is no search then
    bool has_rows;  ///< there are visible sets, and they can be believed
} present_state;

/// Follows the document and the eye.
sl_status present_update(sl_context *context, present_state *present,
                         const document_state *document, sl_point eye);
/// Drops all but the version.
void present_drop(sl_context *context, present_state *present);

/// Whether cell `from` sees cell `to` by the bake, with doors as they are.
bool present_sees(const present_state *present, const document_state *document, uint32_t from,
                  uint32_t to);

/// Adds what a cell sees to a set of cells: directly, and by mirror.
void present_add_row(const present_state *present, const document_state *document, uint32_t cell,
                     sl_bits *set);
void present_add_mirrored(const present_state *present, const document_state *document,
                          uint32_t cell, sl_bits *set);

/// The stab tree of a cell without the sequences through shut doors; other cells get none. In terms
/// of the document's space. `out` is untouched on failure.
sl_status present_tree(sl_context *context, const present_state *present,
                       const document_state *document, uint32_t cell, sl_stab_trees *out);

#endif

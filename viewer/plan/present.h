/// The document as sight finds it now: the query of the document, which follows its doors, objects,
/// range and mirrors.
#ifndef VIEWER_PRESENT_H
#define VIEWER_PRESENT_H

#include "document/document.h"
#include "sightline/query.h"

/// Zeroed to start. The pointers are NULL while nothing is open.
typedef struct present_state {
    uint32_t version; ///< grows with every change but that of the range; the document's among them
    sl_query *query;  ///< the document's, or `own`
    const sl_outline *outline; ///< that sight goes by, with the objects if some of them block
    const uint32_t *parents;   ///< its cell c is a part of cell parents[c]; NULL: none is cut
    bool still;                ///< objects cannot be put in as they are now: sight passes them
    bool has_rows;             ///< there are visible sets, and they can be believed
    bool backwards;            ///< the caller's: as the eye is seen, not as it sees
    const sl_space *space;     ///< NULL until present_space() has made it
    sl_space filtered;         ///< what it may be
    sl_query *own;             ///< that looks backwards
    sl_visibility no_rows;
    sl_point eye;
    signed char *sides; ///< by glass: the side that the eye is on
    uint32_t document_version, touched, sets, mirror_depth;
} present_state;

/// Follows the document and the eye.
sl_status present_update(sl_context *context, present_state *present,
                         const document_state *document, sl_point eye);
/// Drops all but the version.
void present_drop(sl_context *context, present_state *present);

/// Makes `space`: as the eye finds it, without objects. Shut doors are walls, and so is glass that
/// is dark from where the eye is. Without such walls it is the document's. Its cells and those of
/// directed portals are the document's; directed portals are not.
sl_status present_space(sl_context *context, present_state *present);

/// Whether some door is shut.
bool present_has_shut(const present_state *present);

/// Whether cell `from` sees cell `to` by the bake, with doors as they are.
bool present_sees(sl_context *context, const present_state *present, uint32_t from, uint32_t to);

/// The stab tree of a cell without the sequences through shut doors; other cells get none. In terms
/// of the document's space. `out` is untouched on failure.
sl_status present_tree(sl_context *context, const present_state *present,
                       const document_state *document, uint32_t cell, sl_stab_trees *out);

#endif

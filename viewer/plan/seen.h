/// What the eye sees now: the result and the cost of every culling method, and what is seen in
/// mirrors.
#ifndef VIEWER_SEEN_H
#define VIEWER_SEEN_H

#include "plan/present.h"

enum { SEEN_MOST = 16 };

typedef struct seen_method {
    uint64_t *cells;    ///< words of the space's; NULL before the first look
    uint64_t *mirrored; ///< kept for what is seen in mirrors; none by methods that do not know them
    bool known;         ///< the method could answer
    uint32_t count, mirrored_count; ///< the latter of cells that are not seen directly
    double area, seconds;           ///< seconds are smoothed
    sl_eye_account account;
} seen_method;

/// Zeroed to start.
typedef struct seen_state {
    uint32_t version; ///< of what is present that it is of
    sl_view view;
    bool valid;
    seen_method methods[SEEN_MOST];
    uint64_t *pvs;      ///< of the eye's cell; all 0 while it is not known
    uint64_t *mirrored; ///< what it sees by mirror, likewise
    uint32_t cell, pvs_count;
    double pvs_area;
    bool *objects;          ///< of the document's object_count, whether each is seen directly
    bool *objects_mirrored; ///< likewise by mirror, if some object blocks sight
    size_t object_count;
    sl_region region;
    sl_mirrored_region in_mirrors; ///< its parts; none where the map has no mirrors
    double mirrored_area;          ///< of all parts
    uint32_t depth;                ///< reflections of the parts, fewer than asked for where they
                                   ///< would take longer than a frame has
    sl_mirrored_region deeper;     ///< scratch
    bool patient;                  ///< the caller's: there is no hurry
    sl_context *hurried;           ///< of work that ends at `until`, by the clock
    double until;
    double region_area, region_seconds;
    double range;
} seen_state;

/// Looks again where the view, the range or the map changed.
sl_status seen_update(sl_context *context, seen_state *seen, const document_state *document,
                      const present_state *present, const sl_view *view);
/// The region alone, by a query to other walls than the document's: no method knows anything.
sl_status seen_update_region(sl_context *context, seen_state *seen, const document_state *document,
                             sl_query *query, const sl_view *view);
/// Whether two views are equal.
bool seen_same_view(const sl_view *a, const sl_view *b);
void seen_destroy(sl_context *context, seen_state *seen);

#endif

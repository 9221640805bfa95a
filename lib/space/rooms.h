/// Rooms: an outline whose boundaries are those of cells, made anew with corners at the ends of
/// walls only.
#ifndef SL_ROOMS_H
#define SL_ROOMS_H

#include "sightline/outline.h"
#include "sightline/support.h"

/// The boundaries as they are worked on: sides in no order, those of a face linked both ways.
typedef struct sl_mesh {
    SL_ARRAY(sl_side) sides;
    SL_ARRAY(uint32_t) previous; ///< by side; SL_SIDE_GONE for one that is no more
    SL_ARRAY(uint32_t) unused;   ///< the sides that are no more
} sl_mesh;

#define SL_SIDE_GONE UINT32_MAX

/// Drops the corners of cells that no wall ends at, and cuts all into triangles with short sides.
/// A face that rounded corners keep from being cut stays. No coordinate is computed.
sl_status sl_mesh_triangulate(sl_context *context, sl_mesh *mesh);

/// Drops both sides of a portal.
sl_status sl_mesh_drop(sl_context *context, sl_mesh *mesh, uint32_t portal);

static inline sl_point sl_mesh_end(const sl_mesh *mesh, uint32_t side) {
    return mesh->sides.items[mesh->sides.items[side].next].start;
}

static inline void sl_mesh_link(sl_mesh *mesh, uint32_t before, uint32_t after) {
    mesh->sides.items[before].next = after;
    mesh->previous.items[after] = before;
}

/// Replaces the boundaries of cells in an outline by those of rooms, and tells which rooms each
/// cell has a part of.
sl_status sl_rooms_make(sl_context *context, sl_outline *outline);

#endif

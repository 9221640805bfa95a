// The tree, the grid, the cells, the seams, the walls and the view cells of a hostile file: checks
// read no byte behind their sections, a way down the tree ends, each cell that passes has its
// corners and portals, and each wall usable coordinates. Sections of up to two items.
//
// unwind 6
#include "proof.h"

#define SLRT_BIG_ENDIAN // numbers byte by byte
#define SIGHTLINE_RUNTIME_IMPLEMENTATION
#include "runtime/sightline_runtime.h"

enum { FEW = 2 };

static uint32_t up_to(uint32_t most) {
    const uint32_t count = nondet_uint();
    ASSUME(count <= most);
    return count;
}

/// A section of up to `most` items. The block ends with the last byte that checks read: `unread`
/// bytes at the end of each item are none of theirs.
#define ANY_SECTION(tag, most, item_bytes, unread)                                                 \
    const uint32_t tag##_count = up_to(most);                                                      \
    ANY_BYTES(tag##_items, (most) * (item_bytes) - (unread),                                       \
              tag##_count ? tag##_count * (size_t)(item_bytes) - (unread) : 0);                    \
    found[tag].items = tag##_items;                                                                \
    found[tag].count = tag##_count

void a_way_down_the_tree_ends(void) {
    sl_runtime rt = {0};
    slrt_section found[SLRT_TAGS] = {{0}};
    rt.cell_count = nondet_uint();
    ASSUME(rt.cell_count > 0 && rt.cell_count <= INT32_MAX);
    unsigned char info[128];
    found[SLRT_INFO].items = info;
    ANY_SECTION(SLRT_NODE, FEW, SLRT_NODE_BYTES, 4);
    ANY_SECTION(SLRT_NODG, 1, 8, 0);
    ANY_SECTION(SLRT_NODS, FEW, 4, 0);
    if (!slrt_take_tree(&rt, found)) return;
    int32_t at = rt.root;
    const uint64_t bucket = nondet_ulong();
    if (bucket < (uint64_t)rt.tree_columns * rt.tree_rows) {
        PROVE(bucket < SLRT_NODS_count);
        at = slrt_i32(rt.tree_starts + (size_t)bucket * 4);
    }
    int steps = 0;
    for (; at >= 0; steps++) {
        PROVE((uint32_t)at < rt.node_count && steps < FEW);
        at = slrt_i32(rt.nodes + (size_t)at * SLRT_NODE_BYTES + (nondet_bool() ? 12 : 16));
    }
    PROVE((uint32_t)~at < rt.cell_count);
}

void buckets_of_the_grid_lie_in_it(void) {
    sl_runtime rt = {0};
    slrt_section found[SLRT_TAGS] = {{0}};
    unsigned char info[128];
    rt.cell_count = nondet_uint();
    rt.vertex_count = up_to(FEW);
    found[SLRT_INFO].items = info;
    ANY_SECTION(SLRT_GRIO, FEW + 1, 4, 0);
    ANY_SECTION(SLRT_GRIC, FEW, 4, 0);
    ANY_SECTION(SLRT_BEYO, FEW, 4, 0);
    if (!slrt_take_grid(&rt, found)) return;
    const uint64_t buckets = (uint64_t)rt.grid_columns * rt.grid_rows;
    const uint32_t bucket = nondet_uint();
    ASSUME(bucket < buckets);
    PROVE(buckets < found[SLRT_GRIO].count);
    const uint32_t first = slrt_u32(rt.grid_offsets + (size_t)bucket * 4);
    const uint32_t end = slrt_u32(rt.grid_offsets + (size_t)bucket * 4 + 4);
    PROVE(first <= end && end <= found[SLRT_GRIC].count);
}

void cells_have_their_corners_and_portals(void) {
    sl_runtime rt = {0};
    slrt_section found[SLRT_TAGS] = {{0}};
    ANY_SECTION(SLRT_CELL, FEW, SLRT_CELL_BYTES, 0);
    ANY_SECTION(SLRT_VERT, 4, SLRT_VERTEX_BYTES, 0);
    ANY_SECTION(SLRT_PORTAL, FEW, SLRT_DIRECTED_BYTES, 0);
    rt.cell_count = SLRT_CELL_count;
    rt.vertex_count = SLRT_VERT_count;
    rt.directed_count = SLRT_PORTAL_count;
    rt.portal_count = nondet_uint();
    rt.cells = SLRT_CELL_items;
    rt.vertices = SLRT_VERT_items;
    rt.directed = SLRT_PORTAL_items;
    if (!slrt_cells_are_sound(&rt)) return;
    const uint32_t cell = nondet_uint();
    ASSUME(cell < rt.cell_count);
    const sl_runtime_cell c = sl_runtime_get_cell(&rt, cell);
    PROVE((uint64_t)c.first_vertex + c.vertex_count <= rt.vertex_count);
    PROVE((uint64_t)c.first_directed + c.directed_count <= rt.directed_count);
}

void seams_are_read_within_their_sections(void) {
    sl_runtime rt = {0};
    slrt_section found[SLRT_TAGS] = {{0}};
    rt.portal_count = nondet_uint();
    ANY_SECTION(SLRT_SEAM, FEW, 40, 8);
    ANY_SECTION(SLRT_SEPO, FEW, 12, 4);
    slrt_take_seams(&rt, found);
}

void walls_are_read_within_their_section(void) {
    sl_runtime rt = {0};
    slrt_section found[SLRT_TAGS] = {{0}};
    ANY_SECTION(SLRT_WALL, FEW, 32, 0);
    if (!slrt_take_walls(&rt, found)) return;
    const uint32_t wall = nondet_uint();
    ASSUME(wall < rt.wall_count);
    PROVE(slrt_usable(rt.walls + (size_t)wall * 32, 4));
}

/// Empty ones too: that of the numbers of view cells was once read before it was counted.
void view_cells_are_read_within_their_sections(void) {
    sl_runtime rt = {0};
    slrt_section found[SLRT_TAGS] = {{0}};
    ANY_SECTION(SLRT_VCIN, FEW, 8, 0);
    ANY_SECTION(SLRT_VCEL, FEW, 4, 0);
    ANY_SECTION(SLRT_VCPA, FEW, 4, 0);
    ANY_SECTION(SLRT_VCRO, FEW, 8, 0);
    ANY_SECTION(SLRT_VCRB, 4, 1, 0);
    unsigned char offsets[1];
    rt.row_offsets = offsets; // cells have rows of their own
    rt.cell_count = 1;
    slrt_open_views(found, &rt);
}

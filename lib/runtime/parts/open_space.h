/// What is checked of the space when a file is opened.

/// Whether a coordinate is sound: a number of at most 2e150, so that products stay finite. They are
/// compared as integers, which no fast-math option changes.
static bool slrt_is_coordinate(double value) {
    const double most = 2e150;
    uint64_t bits, limit;
    memcpy(&bits, &value, sizeof bits);
    memcpy(&limit, &most, sizeof limit);
    return (bits & UINT64_MAX >> 1) <= limit;
}

static bool slrt_usable(const unsigned char *at, int count) {
    int i;
    for (i = 0; i < count; i++)
        if (!slrt_is_coordinate(slrt_f64(at + 8 * i))) return false;
    return true;
}

static sl_runtime_status slrt_check_sizes(const slrt_section *found, sl_runtime *rt) {
    const unsigned char *info = found[SLRT_INFO].items;
    if (found[SLRT_INFO].count != 1 || found[SLRT_PVSO].count != found[SLRT_CELL].count + 1)
        return SL_RUNTIME_SECTION;
    // A cell is stored as ~cell in 32 bits with sign; the search numbers ends of directed portals.
    if (!found[SLRT_CELL].count || found[SLRT_CELL].count > INT32_MAX ||
        found[SLRT_NODE].count > INT32_MAX || found[SLRT_PORTAL].count > INT32_MAX / 2 - 4 ||
        found[SLRT_VERT].count > UINT32_MAX || found[SLRT_PORT].count > UINT32_MAX)
        return SL_RUNTIME_SPACE;
    rt->cell_count = (uint32_t)found[SLRT_CELL].count;
    rt->directed_count = (uint32_t)found[SLRT_PORTAL].count;
    rt->vertex_count = (uint32_t)found[SLRT_VERT].count;
    rt->portal_count = (uint32_t)found[SLRT_PORT].count;
    rt->cells = found[SLRT_CELL].items;
    rt->vertices = found[SLRT_VERT].items;
    rt->directed = found[SLRT_PORTAL].items;
    rt->portals = found[SLRT_PORT].items;
    rt->row_offsets = found[SLRT_PVSO].items;
    rt->row_bytes = found[SLRT_PVSB].items;
    rt->unfinished = found[SLRT_PART].items != NULL;
    if (!slrt_usable(info, 4)) return SL_RUNTIME_SPACE;
    rt->min_x = slrt_f64(info);
    rt->min_y = slrt_f64(info + 8);
    rt->max_x = slrt_f64(info + 16);
    rt->max_y = slrt_f64(info + 24);
    return rt->min_x < rt->max_x && rt->min_y < rt->max_y ? SL_RUNTIME_OK : SL_RUNTIME_SPACE;
}

/// A child comes after its parent, so every way down ends.
static bool slrt_child_is_sound(const sl_runtime *rt, int64_t parent, int32_t child) {
    return child < 0 ? (uint32_t)~child < rt->cell_count
                     : child > parent && (uint32_t)child < rt->node_count;
}

/// Where in the tree the search for the points of a bucket starts, if the file tells.
static bool slrt_take_starts(sl_runtime *rt, const slrt_section *found) {
    const unsigned char *size = found[SLRT_NODG].items;
    uint64_t i;
    if (!size || !found[SLRT_NODS].items) return !size && !found[SLRT_NODS].items;
    if (found[SLRT_NODG].count != 1) return false;
    rt->tree_starts = found[SLRT_NODS].items;
    rt->tree_columns = slrt_u32(size);
    rt->tree_rows = slrt_u32(size + 4);
    for (i = 0; i < found[SLRT_NODS].count; i++)
        if (!slrt_child_is_sound(rt, -1, slrt_i32(rt->tree_starts + (size_t)i * 4))) return false;
    return i && (uint64_t)rt->tree_columns * rt->tree_rows == i;
}

/// A node splits at x (axis 0) or y (axis 1) = its position.
static bool slrt_take_tree(sl_runtime *rt, const slrt_section *found) {
    uint32_t i;
    rt->root = slrt_i32(found[SLRT_INFO].items + 32);
    rt->nodes = found[SLRT_NODE].items;
    rt->node_count = (uint32_t)found[SLRT_NODE].count;
    if (!slrt_child_is_sound(rt, -1, rt->root)) return false;
    for (i = 0; i < rt->node_count; i++) {
        const unsigned char *node = rt->nodes + (size_t)i * SLRT_NODE_BYTES;
        const int32_t axis = slrt_i32(node + 8);
        if (!slrt_usable(node, 1) || axis < 0 || axis > 1 ||
            !slrt_child_is_sound(rt, i, slrt_i32(node + 12)) ||
            !slrt_child_is_sound(rt, i, slrt_i32(node + 16)))
            return false;
    }
    return slrt_take_starts(rt, found);
}

/// The cells of a bucket ascend.
static bool slrt_bucket_is_sound(const sl_runtime *rt, uint32_t first, uint32_t end) {
    uint32_t i, before = 0;
    for (i = first; i < end; i++) {
        const uint32_t cell = slrt_u32(rt->grid_cells + (size_t)i * 4);
        if (cell >= rt->cell_count || (i > first && cell <= before)) return false;
        before = cell;
    }
    return true;
}

static bool slrt_take_grid(sl_runtime *rt, const slrt_section *found) {
    const unsigned char *info = found[SLRT_INFO].items;
    const uint64_t entries = found[SLRT_GRIC].count;
    uint64_t buckets, i;
    uint32_t before = 0;
    rt->loose = slrt_u32(info + 60) != 0;
    rt->grid_columns = slrt_u32(info + 64);
    rt->grid_rows = slrt_u32(info + 68);
    rt->grid_offsets = found[SLRT_GRIO].items;
    rt->grid_cells = found[SLRT_GRIC].items;
    buckets = (uint64_t)rt->grid_columns * rt->grid_rows;
    rt->neighbours = found[SLRT_BEYO].items;
    if (!rt->neighbours || found[SLRT_BEYO].count != rt->vertex_count || !rt->grid_offsets ||
        !rt->grid_cells || !buckets || found[SLRT_GRIO].count != buckets + 1 ||
        entries > UINT32_MAX || slrt_u32(rt->grid_offsets) != 0)
        return false;
    for (i = 1; i <= buckets; i++) {
        const uint32_t end = slrt_u32(rt->grid_offsets + (size_t)i * 4);
        if (end < before || end > entries || !slrt_bucket_is_sound(rt, before, end)) return false;
        before = end;
    }
    return before == entries;
}

/// The index that locates points: a tree if all walls are axial, else a grid. Files of version 1
/// with oblique walls have a tree along oblique lines. It is ignored, and all cells are tested.
static bool slrt_take_location(sl_runtime *rt, const slrt_section *found, uint32_t version) {
    rt->loose = version == 1 && found[SLRT_BEYO].items;
    if (version != 1) return slrt_take_grid(rt, found);
    return rt->loose || slrt_take_tree(rt, found);
}

static bool slrt_cells_are_sound(const sl_runtime *rt) {
    uint32_t i, directed = 0;
    for (i = 0; i < rt->cell_count; i++) {
        const sl_runtime_cell cell = sl_runtime_get_cell(rt, i);
        if (cell.vertex_count < 3 || cell.first_vertex > rt->vertex_count ||
            cell.vertex_count > rt->vertex_count - cell.first_vertex ||
            cell.first_directed != directed || cell.directed_count > rt->directed_count - directed)
            return false;
        directed += cell.directed_count;
    }
    if (directed != rt->directed_count) return false;
    for (i = 0; i < rt->vertex_count; i++)
        if (!slrt_usable(rt->vertices + (size_t)i * SLRT_VERTEX_BYTES, 2)) return false;
    for (i = 0; i < rt->directed_count; i++) {
        const unsigned char *at = rt->directed + (size_t)i * SLRT_DIRECTED_BYTES;
        if (slrt_u32(at) >= rt->portal_count || slrt_u32(at + 4) >= rt->cell_count ||
            !slrt_usable(at + 8, 4))
            return false;
    }
    return true;
}

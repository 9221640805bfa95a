/// Reading a baked file: nothing in it is believed before it is checked.
#include "bake/slv.h"
#include "bake/view_rows.h"
#include "base/base.h"
#include "base/bits.h"
#include "base/size.h"
#include "cell_to_cell/pvs_rows.h"
#include "effects/mirrors.h"
#include "map/scan.h"
#include "space/index.h"
#include "space/kd_tree.h"
#include "space/walled.h"

#include <math.h>
#include <string.h>

typedef struct reader {
    sl_context *context;
    const char *name;
    const char *bytes;
    size_t size;
    sli_slv_header header;
    bool takes_shards;
    sl_baked *out;
} reader;

static sl_status fail_file(const reader *r, const char *what) {
    return sl_fail_at(r->context, r->name, 0, "%s", what);
}

/// Leads the message of a check that knows of no file with the file's name.
static sl_status in_file(const reader *r, sl_status status) {
    if (status != SL_BAD_INPUT) return status;
    char what[sizeof r->context->message];
    memcpy(what, r->context->message, sizeof what);
    return fail_file(r, what);
}

/// Begins the checksum over the file, in which its own four bytes count as 0.
static void begin_sum(const reader *r, sli_checksum *sum) {
    sli_slv_header header = r->header;
    header.checksum = 0;
    sli_slv_order_header(&header);
    sli_checksum_begin(sum);
    sli_checksum_add(sum, &header, sizeof header);
}

static uint32_t checksum_of(const reader *r) {
    sli_checksum sum;
    begin_sum(r, &sum);
    sli_checksum_add(&sum, r->bytes + sizeof r->header, r->size - sizeof r->header);
    return sli_checksum_value(&sum);
}

static sl_status check_header(reader *r) {
    if (r->size < sizeof r->header || memcmp(r->bytes, SLI_SLV_MAGIC, 8) != 0)
        return fail_file(r, "not a baked file (.slv): make one with sightline bake");
    memcpy(&r->header, r->bytes, sizeof r->header);
    sli_slv_order_header(&r->header);
    const sli_slv_header *h = &r->header;
    if (h->byte_order != SLI_SLV_BYTE_ORDER)
        return fail_file(r, "its byte order is not that of baked files: bake the map again");
    if (h->version != SLI_SLV_VERSION && h->version != SLI_SLV_VERSION_AXIAL)
        return sl_fail_at(r->context, r->name, 0,
                          "version %u of the baked format; this program knows versions up to %u: "
                          "bake the map again",
                          h->version, SLI_SLV_VERSION);
    if (h->file_bytes != r->size)
        return sl_fail_at(r->context, r->name, 0,
                          "cut short or damaged: %llu bytes expected, %zu found",
                          (unsigned long long)h->file_bytes, r->size);
    if (h->section_count > (r->size - sizeof *h) / sizeof(sli_slv_section))
        return fail_file(r, "damaged: more sections than fit");
    return SL_OK;
}

static sl_status check_sum(const reader *r, uint32_t sum) {
    return sum == r->header.checksum ? SL_OK : fail_file(r, "damaged: the checksum does not match");
}

/// Finds a section and checks its place. False where the file has none of that tag.
static sl_status find_section(const reader *r, const char *tag, size_t item_bytes,
                              sli_slv_section *out, bool *found) {
    *found = false;
    for (uint32_t i = 0; i < r->header.section_count; i++) {
        sli_slv_section s;
        memcpy(&s, r->bytes + sizeof r->header + i * sizeof s, sizeof s);
        sli_slv_order_entry(&s);
        if (memcmp(s.tag, tag, sizeof s.tag) != 0) continue;
        if (*found)
            return sl_fail_at(r->context, r->name, 0, "damaged: section %s is there twice", tag);
        if (s.item_bytes != item_bytes || s.offset > r->size ||
            s.count > (r->size - s.offset) / item_bytes)
            return sl_fail_at(r->context, r->name, 0, "damaged: section %s does not fit", tag);
        *out = s;
        *found = true;
    }
    return SL_OK;
}

/// Copies a section's items; SL_OK and none where an optional one is missing. `items` is the
/// address of a T *, written as bytes: a T * is no void * to the compiler.
static sl_status load(const reader *r, const char *tag, size_t item_bytes, bool optional,
                      void *items, uint64_t *count) {
    sli_slv_section s;
    bool found;
    *count = 0;
    SL_TRY(find_section(r, tag, item_bytes, &s, &found));
    if (!found && optional) return SL_OK;
    if (!found) return sl_fail_at(r->context, r->name, 0, "damaged: section %s is missing", tag);
    void *copy = sl_alloc_array(r->context, sli_size(s.count), item_bytes);
    if (!copy) return SL_NO_MEMORY;
    if (s.count) memcpy(copy, r->bytes + s.offset, sli_size(s.count * item_bytes));
    sli_slv_order(tag, s.item_bytes, copy, s.count);
    memcpy(items, &copy, sizeof copy);
    *count = s.count;
    return SL_OK;
}

/// As load, into a field of 32 bits.
static sl_status load_counted(const reader *r, const char *tag, size_t item_bytes, void *items,
                              uint32_t *count) {
    uint64_t found;
    SL_TRY(load(r, tag, item_bytes, false, items, &found));
    if (found > UINT32_MAX)
        return sl_fail_at(r->context, r->name, 0, "damaged: section %s is too long", tag);
    *count = (uint32_t)found;
    return SL_OK;
}

/// Within what a map without width or height is padded to: areas stay finite.
static bool is_bound(double value) {
    return fabs(value) <= 2 * SL_COORDINATE_MAX;
}

static bool makes_sense(const sli_slv_info *info) {
    return info->sight <= SL_OPEN && info->guarantee <= SL_ROUNDED && is_bound(info->bounds[0]) &&
           is_bound(info->bounds[1]) && is_bound(info->bounds[2]) && is_bound(info->bounds[3]) &&
           sli_slv_is_name(info->method) && sli_slv_is_name(info->solver);
}

static sl_status load_info(const reader *r) {
    sli_slv_section s;
    bool found;
    SL_TRY(find_section(r, "INFO", sizeof(sli_slv_info), &s, &found));
    if (!found || s.count != 1) return fail_file(r, "damaged: section INFO is missing");
    sli_slv_info info;
    memcpy(&info, r->bytes + s.offset, sizeof info);
    sli_slv_order("INFO", sizeof info, &info, 1);
    if (!makes_sense(&info)) return fail_file(r, "damaged: section INFO makes no sense");
    sl_baked *out = r->out;
    out->space.bounds =
        (sl_box){{info.bounds[0], info.bounds[1]}, {info.bounds[2], info.bounds[3]}};
    out->space.root = info.root;
    out->space.tree_depth = info.tree_depth;
    out->space.inside_count = info.inside_count;
    out->space.loose = info.loose != 0;
    out->space.grid.columns = info.grid_columns;
    out->space.grid.rows = info.grid_rows;
    out->visibility.sight = (sl_sight)info.sight;
    out->visibility.guarantee = (sl_guarantee)info.guarantee;
    out->visibility.trees.left_out = info.trees_left_out;
    out->visibility.account =
        (sl_see_account){.pairs = info.pairs, .doubtful_pairs = info.doubtful_pairs};
    memcpy(out->method, info.method, sizeof out->method);
    memcpy(out->solver, info.solver, sizeof out->solver);
    return SL_OK;
}

/// The check of the graph sorts the walls, for which their coordinates must be numbers.
static sl_status copy_walls(const reader *r, const sl_segment *segments, uint32_t count,
                            sl_wall *walls) {
    for (uint32_t i = 0; i < count; i++) {
        const sl_segment *s = &segments[i];
        if (!sl_coordinate_usable(s->a.x) || !sl_coordinate_usable(s->a.y) ||
            !sl_coordinate_usable(s->b.x) || !sl_coordinate_usable(s->b.y))
            return sl_fail_at(r->context, r->name, 0, "damaged: wall %u lies out of range", i);
        walls[i] = (sl_wall){.a = s->a, .b = s->b};
    }
    return SL_OK;
}

static sl_status load_walls(const reader *r) {
    sl_space *space = &r->out->space;
    sl_segment *segments = NULL;
    sl_status status = load_counted(r, "WALL", sizeof *segments, &segments, &space->wall_count);
    if (status == SL_OK) {
        space->walls = sl_alloc_array(r->context, space->wall_count, sizeof *space->walls);
        status =
            space->walls ? copy_walls(r, segments, space->wall_count, space->walls) : SL_NO_MEMORY;
    }
    sl_free(r->context, segments);
    return status;
}

static sl_status load_seams(const reader *r) {
    sl_space *s = &r->out->space;
    uint64_t seams, portals;
    SL_TRY(load(r, "SEAM", sizeof *s->seams, true, &s->seams, &seams));
    SL_TRY(load(r, "SEPO", sizeof *s->seam_portals, true, &s->seam_portals, &portals));
    if (seams > INT32_MAX || portals > UINT32_MAX)
        return fail_file(r, "damaged: section SEAM or SEPO is too long");
    s->seam_count = (uint32_t)seams;
    s->seam_portal_count = (uint32_t)portals;
    return SL_OK;
}

/// Each seam must be of something that the map has.
static sl_status check_seams(const reader *r) {
    const sl_baked *b = r->out;
    for (uint32_t i = 0; i < b->space.seam_count; i++) {
        const sl_seam *seam = &b->space.seams[i];
        if (seam->kind > SL_SEAM_ONEWAY)
            return sl_fail_at(r->context, r->name, 0, "damaged: seam %u is none", i);
        const size_t most = seam->kind == SL_SEAM_DOOR     ? b->map.door_count
                            : seam->kind == SL_SEAM_ONEWAY ? b->map.oneway_count
                                                           : b->map.seam_count;
        if (seam->number >= most)
            return sl_fail_at(r->context, r->name, 0, "damaged: seam %u is of nothing", i);
    }
    return SL_OK;
}

/// Whether bits are what a seam may stop.
static bool are_stops(uint32_t stops) {
    const uint32_t in_full = stops & SL_STOPS_ALL;
    return !(stops & ~(uint32_t)(SL_STOPS_ALL | SL_STOPS_LIMITED)) && in_full < SL_STOPS_ALL &&
           !(stops & SL_STOPS_LIMITED && stops & SL_STOPS_SIGHT);
}

/// What walls stop that do not stop all. The map that the seams are of is there already.
static sl_status load_stops(const reader *r) {
    sl_map *map = &r->out->map;
    const sl_space *s = &r->out->space;
    uint32_t *stops = NULL;
    uint64_t count;
    SL_TRY(load(r, "STOP", sizeof *stops, true, &stops, &count));
    bool sound = !count || count == s->seam_count;
    for (uint32_t i = 0; i < count && sound; i++) {
        const bool plain = s->seams[i].kind == SL_SEAM_PLAIN;
        const uint32_t what = stops[i] & ((1u << SLI_SLV_GROUND) - 1);
        const uint32_t ground = stops[i] >> SLI_SLV_GROUND;
        sound = are_stops(what) && ground <= (SL_SOLID_LEFT | SL_SOLID_RIGHT) &&
                (what || !ground) && (plain || !what);
        if (!sound || !plain) continue;
        map->seams[s->seams[i].number].stops = (uint8_t)what;
        map->seams[s->seams[i].number].ground = (uint8_t)ground;
    }
    sl_free(r->context, stops);
    return sound ? SL_OK : fail_file(r, "damaged: section STOP does not tell of each seam");
}

/// The walls that something passes. The check of the space looks at them.
static sl_status load_passages(const reader *r) {
    sli_slv_passage *items = NULL;
    uint64_t count;
    bool sound;
    SL_TRY(load(r, "PASS", sizeof *items, true, &items, &count));
    const sl_status status =
        sli_slv_take_passages(r->context, items, count, &r->out->space, &sound);
    sl_free(r->context, items);
    SL_TRY(status);
    return sound ? SL_OK : fail_file(r, "damaged: section PASS does not have each passage twice");
}

static sl_status load_channel(const reader *r) {
    sli_slv_section s;
    uint32_t *channel = NULL;
    uint64_t count;
    bool found;
    SL_TRY(find_section(r, "CHAN", sizeof *channel, &s, &found));
    if (!found) return SL_OK;
    SL_TRY(load(r, "CHAN", sizeof *channel, false, &channel, &count));
    const uint32_t told = count == 1 ? *channel : 0;
    sl_free(r->context, channel);
    if (!told || told > SL_STOPS_ALL) return fail_file(r, "damaged: section CHAN makes no sense");
    r->out->map.channel = told;
    return SL_OK;
}

/// In a file for sight, seams that limit it are such.
static void mark_limited(const reader *r) {
    const sl_map *map = &r->out->map;
    sl_space *s = &r->out->space;
    for (uint32_t i = 0; i < s->seam_count && sl_map_channel(map) & SL_STOPS_SIGHT; i++)
        if (s->seams[i].kind == SL_SEAM_PLAIN &&
            map->seams[s->seams[i].number].stops & SL_STOPS_LIMITED)
            s->seams[i].kind = SL_SEAM_LIMITED;
}

static sl_status load_grid(const reader *r) {
    sl_cell_grid *g = &r->out->space.grid;
    uint64_t buckets, entries;
    SL_TRY(load(r, "GRIO", sizeof *g->first, false, &g->first, &buckets));
    SL_TRY(load(r, "GRIC", sizeof *g->cells, false, &g->cells, &entries));
    if (buckets != (uint64_t)g->columns * g->rows + 1 || entries > UINT32_MAX)
        return fail_file(r, "damaged: sections GRIO and GRIC make no grid");
    g->entry_count = (uint32_t)entries;
    return SL_OK;
}

/// Whether a cell has corners that a grid can be made of.
static bool has_corners(const sl_space *s, const sl_cell *cell) {
    if (!cell->vertex_count || cell->first_vertex > s->vertex_count ||
        cell->vertex_count > s->vertex_count - cell->first_vertex)
        return false;
    for (uint32_t i = 0; i < cell->vertex_count; i++) {
        const sl_point p = s->vertices[cell->first_vertex + i];
        if (!is_bound(p.x) || !is_bound(p.y)) return false;
    }
    return true;
}

/// A BSP's file of version 1: its tree is dropped, and points are located by a grid.
static sl_status loosen(const reader *r) {
    sl_space *s = &r->out->space;
    s->loose = 1;
    s->node_count = s->tree_depth = 0;
    s->root = 0;
    for (uint32_t i = 0; i < s->cell_count; i++)
        if (!has_corners(s, &s->cells[i]))
            return sl_fail_at(r->context, r->name, 0, "damaged: cell %u has corners out of range",
                              i);
    const sl_box *b = &s->bounds;
    if (!s->cell_count || !(b->min.x < b->max.x) || !(b->min.y < b->max.y))
        return fail_file(r, "damaged: the bounds enclose no area");
    return sli_cell_grid_make(r->context, s);
}

/// Whether the file's grid over the tree, if there is one, is what is made of the tree.
static sl_status check_tree_grid(const reader *r) {
    sli_tree_grid own = {0};
    sli_slv_section size, starts;
    bool has_size, has_starts;
    SL_TRY(find_section(r, "NODG", 8, &size, &has_size));
    SL_TRY(find_section(r, "NODS", sizeof *own.starts, &starts, &has_starts));
    if ((!has_size && !has_starts) || r->out->space.neighbour) return SL_OK;
    SL_TRY(sli_tree_grid_make(r->context, &r->out->space, &own));
    const uint64_t buckets = (uint64_t)own.columns * own.rows;
    sli_slv_order("NODS", sizeof *own.starts, own.starts, buckets);
    uint32_t told[2] = {own.columns, own.rows};
    sli_slv_order("NODG", sizeof told, told, 1);
    const bool same =
        has_size && has_starts && size.count == 1 && starts.count == buckets &&
        memcmp(r->bytes + size.offset, told, sizeof told) == 0 &&
        memcmp(r->bytes + starts.offset, own.starts, buckets * sizeof *own.starts) == 0;
    sl_free(r->context, own.starts);
    return same ? SL_OK : fail_file(r, "damaged: sections NODG and NODS are not of the tree");
}

static sl_status load_space(const reader *r) {
    sl_space *s = &r->out->space;
    SL_TRY(load_counted(r, "NODE", sizeof *s->nodes, &s->nodes, &s->node_count));
    SL_TRY(load_counted(r, "CELL", sizeof *s->cells, &s->cells, &s->cell_count));
    SL_TRY(load_counted(r, "VERT", sizeof *s->vertices, &s->vertices, &s->vertex_count));
    SL_TRY(load_counted(r, "PORT", sizeof *s->portals, &s->portals, &s->portal_count));
    SL_TRY(load_counted(r, "EXIT", sizeof *s->directed, &s->directed, &s->directed_count));
    SL_TRY(load_walls(r));
    uint64_t sides;
    SL_TRY(load(r, "BEYO", sizeof *s->neighbour, true, &s->neighbour, &sides));
    SL_TRY(load_seams(r));
    SL_TRY(load_passages(r));
    if (s->neighbour && sides != s->vertex_count)
        return fail_file(r, "damaged: section BEYO does not tell of each side");
    const bool is_mesh = r->header.version != SLI_SLV_VERSION_AXIAL;
    if (is_mesh && !s->neighbour) return fail_file(r, "damaged: section BEYO is missing");
    if (s->neighbour) SL_TRY(is_mesh ? load_grid(r) : loosen(r));
    SL_TRY(in_file(r, sl_space_check(r->context, s)));
    SL_TRY(check_tree_grid(r));
    sli_ground_of_cells(s);
    return SL_OK;
}

static sl_status load_pvs(const reader *r, const char *offsets_tag, const char *bytes_tag,
                          bool optional, sl_pvs *pvs) {
    const uint32_t cells = r->out->space.cell_count;
    uint64_t offsets, bytes;
    SL_TRY(load(r, offsets_tag, sizeof *pvs->offsets, optional, &pvs->offsets, &offsets));
    if (!offsets && optional) return SL_OK;
    SL_TRY(load(r, bytes_tag, 1, false, &pvs->bytes, &bytes));
    if (offsets != (uint64_t)cells + 1 || pvs->offsets[cells] != bytes)
        return fail_file(r, "damaged: not one visible set a cell");
    pvs->cell_count = cells;
    return in_file(r, sli_pvs_check(r->context, pvs));
}

static sl_status load_doors(const reader *r, const char *offsets_tag, const char *bytes_tag,
                            sl_door_sets *sets) {
    const uint32_t cells = r->out->space.cell_count;
    uint64_t offsets, bytes;
    sli_slv_section section;
    bool has_offsets, has_bytes;
    SL_TRY(find_section(r, offsets_tag, sizeof *sets->offsets, &section, &has_offsets));
    SL_TRY(find_section(r, bytes_tag, 1, &section, &has_bytes));
    if (!has_offsets && !has_bytes) return SL_OK;
    SL_TRY(load(r, offsets_tag, sizeof *sets->offsets, false, &sets->offsets, &offsets));
    SL_TRY(load(r, bytes_tag, 1, false, &sets->bytes, &bytes));
    if (offsets != (uint64_t)cells + 1 || sets->offsets[cells] != bytes)
        return fail_file(r, "damaged: not one row of door sets a cell");
    sets->cell_count = cells;
    return SL_OK;
}

static sl_status load_effects(const reader *r) {
    sl_visibility *v = &r->out->visibility;
    SL_TRY(load_pvs(r, "MIRO", "MIRB", true, &v->mirrored));
    v->account.mirrored_pairs = sli_pvs_pairs(&v->mirrored);
    SL_TRY(load_doors(r, "DORO", "DORB", &v->doors));
    return load_doors(r, "MDOO", "MDOB", &v->mirrored_doors);
}

/// A cell sees itself; the row of one that was not looked from is empty.
static sl_status check_rows(const reader *r, const sl_pvs *pvs) {
    for (uint32_t cell = 0; cell < pvs->cell_count; cell++)
        if (pvs->offsets[cell] < pvs->offsets[cell + 1] && !sl_pvs_sees(pvs, cell, cell))
            return sl_fail_at(r->context, r->name, 0, "damaged: visible set %u lacks its own cell",
                              cell);
    return SL_OK;
}

/// Whether a mirror that stands in a tree is one that the cell ends at.
static bool mirror_is_sound(const sl_baked *baked, const sl_stab_node *node, uint32_t cell) {
    const uint32_t mirror = node->directed - SL_STAB_MIRROR;
    sli_mirror_side side;
    return node->cell == cell && mirror < baked->map.mirror_count &&
           sli_mirror_side_of(&baked->space, &baked->map, cell, mirror, &side);
}

/// A tree's nodes: parents first, each directed portal one of the parent's cell and leading to the
/// node's.
static bool tree_is_sound(const sl_baked *baked, const sl_stab_node *nodes, uint64_t count,
                          uint32_t source) {
    const sl_space *space = &baked->space;
    if (!count) return true;
    if (nodes[0].parent != 0 || nodes[0].cell != source || nodes[0].directed != UINT32_MAX)
        return false;
    for (uint64_t i = 1; i < count; i++) {
        const sl_stab_node *node = &nodes[i];
        if (node->parent >= i) return false;
        const uint32_t before = nodes[node->parent].cell;
        if (sl_stab_is_mirror(node)) {
            if (!mirror_is_sound(baked, node, before)) return false;
            continue;
        }
        if (node->directed >= space->directed_count) return false;
        const sl_cell *from = &space->cells[before];
        if (node->directed < from->first_directed ||
            node->directed - from->first_directed >= from->directed_count ||
            space->directed[node->directed].cell != node->cell)
            return false;
    }
    return true;
}

static sl_status load_trees(const reader *r) {
    sl_stab_trees *trees = &r->out->visibility.trees;
    const uint32_t cells = r->out->space.cell_count;
    uint64_t offsets, nodes;
    SL_TRY(load(r, "TREO", sizeof *trees->offsets, true, &trees->offsets, &offsets));
    if (!offsets) return SL_OK;
    SL_TRY(load(r, "TREN", sizeof *trees->nodes, false, &trees->nodes, &nodes));
    if (offsets != (uint64_t)cells + 1 || trees->offsets[0] != 0 || trees->offsets[cells] != nodes)
        return fail_file(r, "damaged: not one stab tree a cell");
    for (uint32_t i = 0; i < cells; i++)
        if (trees->offsets[i] > trees->offsets[i + 1] || trees->offsets[i + 1] > nodes)
            return fail_file(r, "damaged: a stab tree ends before it starts");
    for (uint32_t i = 0; i < cells; i++)
        if (!tree_is_sound(r->out, trees->nodes + trees->offsets[i],
                           trees->offsets[i + 1] - trees->offsets[i], i))
            return sl_fail_at(r->context, r->name, 0, "damaged: stab tree %u is no tree", i);
    trees->cell_count = cells;
    return SL_OK;
}

static sl_status load_views(const reader *r) {
    sl_view_rows *views = &r->out->views;
    sli_slv_section s;
    bool found;
    SL_TRY(find_section(r, "VCIN", sizeof(sli_slv_views), &s, &found));
    if (!found) return SL_OK;
    if (s.count != 1) return fail_file(r, "damaged: section VCIN makes no sense");
    sli_slv_views told;
    memcpy(&told, r->bytes + s.offset, sizeof told);
    sli_slv_order("VCIN", sizeof told, &told, 1);
    uint32_t cells, nodes;
    SL_TRY(load_counted(r, "VCEL", sizeof *views->view_cells, &views->view_cells, &cells));
    SL_TRY(load_counted(r, "VCPA", sizeof *views->parents, &views->parents, &nodes));
    SL_TRY(load_pvs(r, "VCRO", "VCRB", false, &views->rows));
    if (cells != views->rows.cell_count || nodes != told.node_count)
        return fail_file(r, "damaged: sections VCIN, VCEL and VCPA do not fit");
    views->view_cell_count = told.view_cell_count;
    views->node_count = told.node_count;
    return in_file(r, sli_view_rows_check(r->context, views));
}

/// A section of the map's things holds what the map text does.
static sl_status check_part(const reader *r, const sli_slv_part_of_map *part) {
    sli_slv_section s;
    bool found;
    SL_TRY(find_section(r, part->tag, part->item_bytes, &s, &found));
    sli_slv_order(part->tag, part->item_bytes, part->items, part->count);
    if (!found && !part->count) return SL_OK;
    if (found && s.count == part->count &&
        memcmp(part->items, r->bytes + s.offset, sli_size(s.count * s.item_bytes)) == 0)
        return SL_OK;
    return sl_fail_at(r->context, r->name, 0, "damaged: section %s is not that of the map text",
                      part->tag);
}

/// The transform of the map, which the text does not hold, and a check of its things. An old file
/// has none of this, and its transform is not known.
static sl_status load_things(const reader *r) {
    sl_map *map = &r->out->map;
    sli_slv_section s;
    sli_slv_map_info info;
    bool found;
    SL_TRY(find_section(r, "MAPI", sizeof info, &s, &found));
    if (!found) return SL_OK;
    if (s.count != 1) return fail_file(r, "damaged: section MAPI makes no sense");
    memcpy(&info, r->bytes + s.offset, sizeof info);
    sli_slv_order("MAPI", sizeof info, &info, 1);
    if (!sli_slv_transform(&info, &map->source.transform) || info.range != map->range)
        return fail_file(r, "damaged: section MAPI makes no sense");
    sli_slv_things things;
    sl_status status = sli_slv_things_make(r->context, map, &things);
    for (size_t i = 0; i < SLI_SLV_MAP_PARTS && status == SL_OK; i++)
        status = check_part(r, &things.parts[i]);
    sli_slv_things_destroy(r->context, &things);
    return status;
}

static sl_status load_map(const reader *r) {
    sli_slv_section s;
    bool found;
    SL_TRY(find_section(r, "MAPT", 1, &s, &found));
    if (!found) return fail_file(r, "damaged: section MAPT is missing");
    SL_TRY(sli_map_read_text(r->context, r->name, r->bytes + s.offset, sli_size(s.count),
                             &r->out->map));
    if (r->out->map.wall_count || r->out->map.cell_count)
        return fail_file(r, "damaged: section MAPT holds walls or cells");
    return load_things(r);
}

/// No portal is on a wall that stops what the file is for, and the walls of passages do.
static sl_status check_channel(const reader *r) {
    const sl_map *map = &r->out->map;
    const sl_space *s = &r->out->space;
    bool sound = !s->passage_count || sl_map_partial_walls(map);
    for (uint32_t i = 0; i < s->portal_count; i++)
        sound &= !(sli_portal_stops(map, s, i) & sl_map_channel(map));
    for (uint32_t i = 0; i < s->passage_count; i++)
        sound &= (s->passages[i].stops & sl_map_channel(map)) != 0;
    return sound ? SL_OK
                 : fail_file(r, "damaged: sections STOP, PASS and CHAN contradict each other");
}

// --- what is not finished

static bool bits_beyond_are_clear(const sl_partial *partial) {
    const uint32_t last = partial->unit_count % 64;
    return !last || !(partial->done[partial->unit_count / 64] >> last);
}

static sl_status load_done(const reader *r, sl_partial *partial) {
    uint64_t words;
    SL_TRY(load(r, "DONE", sizeof *partial->done, false, &partial->done, &words));
    if (words != sl_bits_words(partial->unit_count) || !bits_beyond_are_clear(partial))
        return fail_file(r, "damaged: section DONE does not tell of each unit");
    partial->done_count = (uint32_t)sli_bits_count(partial->done, (size_t)words);
    return SL_OK;
}

/// What was found of effects. The map that it must fit comes later.
static sl_status load_partial_effects(const reader *r) {
    sl_partial *partial = &r->out->partial;
    sli_slv_section s;
    sli_slv_part_effects told;
    bool found;
    SL_TRY(find_section(r, "PAEF", sizeof told, &s, &found));
    if (!found) return SL_OK;
    if (s.count != 1) return fail_file(r, "damaged: section PAEF makes no sense");
    memcpy(&told, r->bytes + s.offset, sizeof told);
    sli_slv_order("PAEF", sizeof told, &told, 1);
    if (told.rounded > 1) return fail_file(r, "damaged: section PAEF makes no sense");
    partial->effects = told.effects;
    partial->mirror_depth = told.mirror_depth;
    partial->door_limit = told.door_limit;
    partial->rounded = told.rounded;
    SL_TRY(load_pvs(r, "FNMO", "FNMB", true, &partial->mirrored));
    SL_TRY(load_doors(r, "FNEO", "FNEB", &partial->doors));
    return load_doors(r, "FNXO", "FNXB", &partial->mirrored_doors);
}

static sl_status check_partial_effects(const reader *r) {
    const sl_partial *partial = &r->out->partial;
    const sl_map *map = &r->out->map;
    if (!sl_partial_begun(partial)) return SL_OK;
    const bool doors = map->door_count > 0, mirrors = map->mirror_count > 0;
    if (partial->effects != sl_plan_make(map).effects || (partial->doors.cell_count > 0) != doors ||
        (partial->mirrored.cell_count > 0) != mirrors ||
        (partial->mirrored_doors.cell_count > 0) != (doors && mirrors))
        return fail_file(r, "damaged: what was found so far does not fit the effects of the map");
    SL_TRY(in_file(r, sli_door_sets_check(r->context, &partial->doors, map->door_count)));
    return in_file(r, sli_door_sets_check(r->context, &partial->mirrored_doors, map->door_count));
}

static sl_status load_partial(const reader *r) {
    sl_partial *partial = &r->out->partial;
    sli_slv_section s;
    sli_slv_part part;
    bool found;
    SL_TRY(find_section(r, "PART", sizeof part, &s, &found));
    if (!found) return SL_OK;
    if (s.count != 1) return fail_file(r, "damaged: section PART makes no sense");
    memcpy(&part, r->bytes + s.offset, sizeof part);
    sli_slv_order("PART", sizeof part, &part, 1);
    if (part.inside_only > 1 || part.shard > part.shard_count || (part.shard_count && !part.shard))
        return fail_file(r, "damaged: section PART makes no sense");
    partial->shard = part.shard;
    partial->shard_count = part.shard_count;
    partial->unit_count = part.unit_count;
    partial->inside_only = part.inside_only;
    SL_TRY(load_done(r, partial));
    SL_TRY(load_pvs(r, "FNDO", "FNDB", false, &partial->sure));
    SL_TRY(load_pvs(r, "FNRO", "FNRB", false, &partial->doubtful));
    return load_partial_effects(r);
}

/// The visible sets of cells from those of their view cells, where the file has only these.
static sl_status load_by_views(const reader *r) {
    sl_baked *out = r->out;
    uint64_t pairs;
    for (uint32_t i = 0; i < out->views.node_count; i++)
        if (out->views.parents[i] != SL_NO_VIEW_CELL)
            return fail_file(r, "damaged: cells have no visible sets, and view cells none alone");
    out->by_views = true;
    return sl_view_rows_expand(r->context, &out->views, &out->visibility.pvs, &pairs);
}

/// What the file tells of the rows, for the runtime header, is so.
static sl_status check_parts(const reader *r) {
    const sl_pvs *pvs = &r->out->visibility.pvs;
    uint64_t *told = NULL, count;
    SL_TRY(load(r, "PVSP", sizeof *told, true, &told, &count));
    if (!told) return SL_OK;
    uint64_t *parts = sl_alloc_array(r->context, pvs->cell_count, sizeof *parts);
    if (parts) sli_pvs_parts(pvs, parts);
    const bool same = parts && count == pvs->cell_count &&
                      memcmp(told, parts, pvs->cell_count * sizeof *told) == 0;
    sl_status status = parts ? SL_OK : SL_NO_MEMORY;
    if (parts && !same) status = fail_file(r, "damaged: section PVSP is not of the visible sets");
    sl_free(r->context, parts);
    sl_free(r->context, told);
    return status;
}

/// The visible sets, which a shard has none of.
static sl_status load_seen(const reader *r) {
    sl_visibility *visibility = &r->out->visibility;
    if (r->out->partial.shard_count) {
        if (r->takes_shards) return SL_OK;
        return sl_fail_at(r->context, r->name, 0,
                          "one shard of a bake, %u of %u: put them together with sightline merge",
                          r->out->partial.shard, r->out->partial.shard_count);
    }
    SL_TRY(load_pvs(r, "PVSO", "PVSB", r->out->views.view_cell_count > 0, &visibility->pvs));
    if (!visibility->pvs.cell_count) SL_TRY(load_by_views(r));
    SL_TRY(check_rows(r, &visibility->pvs));
    SL_TRY(check_parts(r));
    SL_TRY(load_pvs(r, "DBTO", "DBTB", true, &visibility->doubtful));
    if (sli_pvs_pairs(&visibility->pvs) != visibility->account.pairs ||
        sli_pvs_pairs(&visibility->doubtful) != visibility->account.doubtful_pairs)
        return fail_file(r, "damaged: the visible sets do not hold as many pairs as they should");
    return SL_OK;
}

static sl_status load_all(reader *r) {
    SL_TRY(check_header(r));
    SL_TRY(check_sum(r, checksum_of(r)));
    SL_TRY(load_info(r));
    SL_TRY(load_space(r));
    SL_TRY(load_partial(r));
    SL_TRY(load_views(r));
    SL_TRY(load_seen(r));
    SL_TRY(load_effects(r));
    SL_TRY(load_map(r));
    SL_TRY(load_trees(r));
    const sl_visibility *visibility = &r->out->visibility;
    const size_t doors = r->out->map.door_count;
    SL_TRY(in_file(r, sli_door_sets_check(r->context, &visibility->doors, doors)));
    SL_TRY(in_file(r, sli_door_sets_check(r->context, &visibility->mirrored_doors, doors)));
    SL_TRY(check_partial_effects(r));
    SL_TRY(check_seams(r));
    SL_TRY(load_stops(r));
    SL_TRY(load_channel(r));
    mark_limited(r);
    return check_channel(r);
}

static sl_status parse(sl_context *context, const char *name, const void *bytes, size_t size,
                       bool takes_shards, sl_baked *out) {
    sl_baked baked = {0};
    reader r = {.context = context,
                .name = name,
                .bytes = bytes,
                .size = size,
                .takes_shards = takes_shards,
                .out = &baked};
    const sl_status status = load_all(&r);
    if (status == SL_OK) {
        *out = baked;
        return SL_OK;
    }
    sl_baked_destroy(context, &baked);
    return status;
}

sl_status sl_baked_parse(sl_context *context, const char *name, const void *bytes, size_t size,
                         sl_baked *out) {
    return parse(context, name, bytes, size, false, out);
}

static sl_status read_file(sl_context *context, const char *path, bool takes_shards,
                           sl_baked *out) {
    sl_bytes file;
    SL_TRY(sl_file_read(context, path, &file));
    const sl_status status = parse(context, path, file.data, file.size, takes_shards, out);
    sl_free(context, file.data);
    return status;
}

sl_status sl_baked_read(sl_context *context, const char *path, sl_baked *out) {
    return read_file(context, path, false, out);
}

sl_status sl_baked_read_part(sl_context *context, const char *path, sl_baked *out) {
    return read_file(context, path, true, out);
}

// --- reading back what was written

/// Takes bytes of the file into the sum, and to `kept` where that is not NULL.
static sl_status take(const reader *r, sli_again *again, uint64_t bytes, sli_checksum *sum,
                      char *kept) {
    char buffer[16384];
    while (bytes) {
        const size_t part = bytes < sizeof buffer ? (size_t)bytes : sizeof buffer;
        SL_TRY(sl_check_cancelled(r->context));
        if (!sli_again_take(again, buffer, part)) return fail_file(r, "cut short");
        sli_checksum_add(sum, buffer, part);
        if (kept) memcpy(kept, buffer, part), kept += part;
        bytes -= part;
    }
    return SL_OK;
}

/// A section that is kept: where it is put, and its size.
typedef struct kept_section {
    const char *tag;
    char *bytes;
    size_t size;
} kept_section;

/// Goes through all sections in the order of the table, which is that of the file.
static sl_status take_sections(const reader *r, sli_again *again, sli_checksum *sum,
                               kept_section *kept, size_t kept_count) {
    for (uint32_t i = 0; i < r->header.section_count; i++) {
        sli_slv_section s;
        memcpy(&s, r->bytes + sizeof r->header + i * sizeof s, sizeof s);
        sli_slv_order_entry(&s);
        const uint64_t at = r->size - again->left, bytes = s.item_bytes * s.count;
        if (s.offset < at || s.offset > r->size || bytes > r->size - s.offset)
            return fail_file(r, "damaged: a section does not fit");
        SL_TRY(take(r, again, s.offset - at, sum, NULL));
        kept_section *own = NULL;
        for (size_t k = 0; k < kept_count; k++)
            if (!kept[k].bytes && memcmp(kept[k].tag, s.tag, sizeof s.tag) == 0) own = &kept[k];
        if (own) {
            own->size = sli_size(bytes);
            own->bytes = sl_alloc_array(r->context, own->size, 1);
            if (!own->bytes) return SL_NO_MEMORY;
        }
        SL_TRY(take(r, again, bytes, sum, own ? own->bytes : NULL));
    }
    return take(r, again, again->left, sum, NULL);
}

static sl_status check_kept(const reader *r, const kept_section *info, const kept_section *text,
                            const sl_map *map) {
    sli_slv_info read;
    sl_map again = {0};
    if (info->size != sizeof read || !text->bytes)
        return fail_file(r, "damaged: section INFO or MAPT is missing");
    memcpy(&read, info->bytes, sizeof read);
    sli_slv_order("INFO", sizeof read, &read, 1);
    if (!makes_sense(&read)) return fail_file(r, "damaged: section INFO makes no sense");
    SL_TRY(sli_map_read_text(r->context, r->name, text->bytes, text->size, &again));
    sl_status status = sli_map_check_again(r->context, r->name, map, &again);
    if (status == SL_OK) status = sli_slv_things_check_again(r->context, r->name, map, &again);
    sl_map_destroy(r->context, &again);
    return status;
}

sl_status sli_slv_read_back(sl_context *context, const char *name, const sl_map *map,
                            sli_again *again) {
    enum { MOST_SECTIONS = 64 }; // as the writer's
    char start[sizeof(sli_slv_header) + MOST_SECTIONS * sizeof(sli_slv_section)];
    reader r = {.context = context, .name = name, .bytes = start, .size = sli_size(again->left)};
    kept_section kept[] = {{.tag = "INFO"}, {.tag = "MAPT"}};
    sli_checksum sum;
    if (!sli_again_take(again, start, sizeof r.header)) return fail_file(&r, "cut short");
    SL_TRY(check_header(&r));
    const size_t table = r.header.section_count * sizeof(sli_slv_section);
    if (r.header.section_count > MOST_SECTIONS) return fail_file(&r, "damaged: too many sections");
    begin_sum(&r, &sum);
    sl_status status = take(&r, again, table, &sum, start + sizeof r.header);
    if (status == SL_OK) status = take_sections(&r, again, &sum, kept, 2);
    if (status == SL_OK) status = check_sum(&r, sli_checksum_value(&sum));
    if (status == SL_OK) status = check_kept(&r, &kept[0], &kept[1], map);
    sl_free(context, kept[0].bytes);
    sl_free(context, kept[1].bytes);
    return status;
}

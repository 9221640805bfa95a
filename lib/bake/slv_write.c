/// Writes baked files: which sections there are, their order, and the bytes, read back once.
#include "bake/slv.h"
#include "base/base.h"
#include "base/file_system.h"
#include "base/size.h"
#include "cell_to_cell/pvs_rows.h"
#include "map/scan.h"
#include "sightline/support.h"
#include "space/index.h"

#include <stdlib.h>
#include <string.h>

enum { MOST_SECTIONS = 64 };

/// A file made ready: what goes into each section, still where it lies.
typedef struct plan {
    sli_slv_header header;
    sli_slv_section sections[MOST_SECTIONS];
    const void *contents[MOST_SECTIONS];
    void *
        copies[MOST_SECTIONS]; ///< of the contents in the file's order of bytes, if that is another
    sl_segment *walls;
    uint32_t *stops; ///< by seam; NULL where each is passed by all
    sl_seam *seams;  ///< limited ones are plain in a file, whose stops say it; NULL where none is
    uint32_t channel;
    sli_slv_passage *passages;
    sl_map map; ///< of which the text is; its seams are the plan's
    char *map_text;
    sli_tree_grid grid; ///< over the tree of the space, if it has one
    uint64_t *parts;    ///< of the visible sets; NULL where the file has none
    sli_slv_things things;
    sli_slv_views views;
    sli_slv_part part;
    sli_slv_part_effects part_effects;
    uint32_t version;
} plan;

static void add_section(plan *p, const char *tag, const void *items, size_t item_bytes,
                        uint64_t count) {
    sli_slv_section *s = &p->sections[p->header.section_count];
    memcpy(s->tag, tag, sizeof s->tag);
    s->item_bytes = (uint32_t)item_bytes;
    s->count = count;
    p->contents[p->header.section_count++] = items;
}

static uint64_t section_bytes(const sli_slv_section *section) {
    return section->item_bytes * section->count;
}

static uint64_t padded(uint64_t bytes) {
    return (bytes + 7) / 8 * 8;
}

static sli_slv_info make_info(const sl_baked *baked) {
    const sl_space *space = &baked->space;
    const sl_see_account *account = &baked->visibility.account;
    sli_slv_info info = {
        .bounds = {space->bounds.min.x, space->bounds.min.y, space->bounds.max.x,
                   space->bounds.max.y},
        .root = space->root,
        .tree_depth = space->tree_depth,
        .inside_count = space->inside_count,
        .loose = space->loose,
        .grid_columns = space->grid.columns,
        .grid_rows = space->grid.rows,
        .sight = baked->visibility.sight,
        .guarantee = baked->visibility.guarantee,
        .trees_left_out = baked->visibility.trees.left_out,
        .pairs = account->pairs,
        .doubtful_pairs = account->doubtful_pairs,
    };
    memccpy(info.method, baked->method, 0, sizeof info.method);
    memccpy(info.solver, baked->solver, 0, sizeof info.solver);
    return info;
}

static sl_status copy_walls(sl_context *context, const sl_space *space, plan *p) {
    p->walls = sl_alloc_array(context, space->wall_count, sizeof *p->walls);
    if (!p->walls) return SL_NO_MEMORY;
    for (uint32_t i = 0; i < space->wall_count; i++)
        p->walls[i] = (sl_segment){space->walls[i].a, space->walls[i].b};
    return SL_OK;
}

static uint32_t stops_of(const sl_glass *seam) {
    const uint32_t ground = seam->ground & (SL_SOLID_LEFT | SL_SOLID_RIGHT);
    return seam->stops ? seam->stops | ground << SLI_SLV_GROUND : 0;
}

/// What each seam stops, if any stops something.
static sl_status list_stops(sl_context *context, const sl_baked *baked, plan *p) {
    const sl_space *space = &baked->space;
    bool any = false;
    p->channel = sl_map_channel(&baked->map);
    p->stops = sl_alloc_array(context, space->seam_count, sizeof *p->stops);
    if (!p->stops) return SL_NO_MEMORY;
    for (uint32_t i = 0; i < space->seam_count; i++) {
        const sl_seam *seam = &space->seams[i];
        if (sli_is_map_seam(seam)) p->stops[i] = stops_of(&baked->map.seams[seam->number]);
        any |= p->stops[i] != 0;
    }
    if (any) return SL_OK;
    sl_free(context, p->stops);
    p->stops = NULL;
    return SL_OK;
}

static sl_status copy_seams(sl_context *context, const sl_space *space, plan *p) {
    bool any = false;
    for (uint32_t i = 0; i < space->seam_count; i++) any |= space->seams[i].kind == SL_SEAM_LIMITED;
    if (!any) return SL_OK;
    p->seams = sl_alloc_array(context, space->seam_count, sizeof *p->seams);
    if (!p->seams) return SL_NO_MEMORY;
    memcpy(p->seams, space->seams, space->seam_count * sizeof *p->seams);
    for (uint32_t i = 0; i < space->seam_count; i++)
        if (p->seams[i].kind == SL_SEAM_LIMITED) p->seams[i].kind = SL_SEAM_PLAIN;
    return SL_OK;
}

/// The parts of the cells that each visible set reaches into, if the file has visible sets.
static sl_status list_parts(sl_context *context, const sl_baked *baked, plan *p) {
    const sl_pvs *pvs = &baked->visibility.pvs;
    if (sl_baked_is_shard(baked) || baked->by_views) return SL_OK;
    p->parts = sl_alloc_array(context, pvs->cell_count, sizeof *p->parts);
    if (!p->parts) return SL_NO_MEMORY;
    sli_pvs_parts(pvs, p->parts);
    return SL_OK;
}

/// The map's text without its walls and cells, which the space has.
static sl_status print_map(sl_context *context, const sl_map *map, plan *p, size_t *size) {
    sl_map *others = &p->map;
    *others = *map;
    others->wall_count = others->cell_count = 0;
    others->snap = 0;
    others->source.comment_count = 0;
    others->seams = sl_alloc_array(context, map->seam_count, sizeof *others->seams);
    if (!others->seams) return SL_NO_MEMORY;
    for (size_t i = 0; i < map->seam_count; i++) {
        others->seams[i] = map->seams[i];
        others->seams[i].stops = 0; // a section of its own says what they stop
    }
    sli_memory_stream memory;
    if (!sli_memory_open(&memory)) return sl_fail_memory(context);
    const sl_status status = sli_map_print_text(context, others, memory.stream);
    if (!sli_memory_close(&memory)) return sl_fail_memory(context);
    p->map_text = memory.text;
    *size = memory.size;
    return status;
}

static void add_pvs(plan *p, const char *offsets_tag, const char *bytes_tag, const sl_pvs *pvs) {
    add_section(p, offsets_tag, pvs->offsets, sizeof *pvs->offsets, (uint64_t)pvs->cell_count + 1);
    add_section(p, bytes_tag, pvs->bytes, 1, pvs->offsets[pvs->cell_count]);
}

static void add_doors(plan *p, const char *offsets_tag, const char *bytes_tag,
                      const sl_door_sets *sets) {
    if (!sets->cell_count) return;
    add_section(p, offsets_tag, sets->offsets, sizeof *sets->offsets,
                (uint64_t)sets->cell_count + 1);
    add_section(p, bytes_tag, sets->bytes, 1, sl_door_sets_bytes(sets));
}

static void add_partial_effects(plan *p, const sl_partial *partial) {
    p->part_effects = (sli_slv_part_effects){.effects = partial->effects,
                                             .mirror_depth = partial->mirror_depth,
                                             .door_limit = partial->door_limit,
                                             .rounded = partial->rounded};
    add_section(p, "PAEF", &p->part_effects, sizeof p->part_effects, 1);
    if (partial->mirrored.cell_count) add_pvs(p, "FNMO", "FNMB", &partial->mirrored);
    add_doors(p, "FNEO", "FNEB", &partial->doors);
    add_doors(p, "FNXO", "FNXB", &partial->mirrored_doors);
}

static void add_partial(plan *p, const sl_partial *partial) {
    p->part = (sli_slv_part){.shard = partial->shard,
                             .shard_count = partial->shard_count,
                             .unit_count = partial->unit_count,
                             .inside_only = partial->inside_only};
    add_section(p, "PART", &p->part, sizeof p->part, 1);
    add_section(p, "DONE", partial->done, sizeof *partial->done,
                sl_bits_words(partial->unit_count));
    add_pvs(p, "FNDO", "FNDB", &partial->sure);
    add_pvs(p, "FNRO", "FNRB", &partial->doubtful);
    if (partial->effects) add_partial_effects(p, partial);
}

static void add_effects(plan *p, const sl_visibility *visibility) {
    if (visibility->mirrored.cell_count) add_pvs(p, "MIRO", "MIRB", &visibility->mirrored);
    add_doors(p, "DORO", "DORB", &visibility->doors);
    add_doors(p, "MDOO", "MDOB", &visibility->mirrored_doors);
}

static void add_views(plan *p, const sl_view_rows *views) {
    p->views = (sli_slv_views){views->view_cell_count, views->node_count};
    add_section(p, "VCIN", &p->views, sizeof p->views, 1);
    add_section(p, "VCEL", views->view_cells, sizeof *views->view_cells, views->rows.cell_count);
    add_section(p, "VCPA", views->parents, sizeof *views->parents, views->node_count);
    add_pvs(p, "VCRO", "VCRB", &views->rows);
}

/// The map as text, and what it holds in items.
static void add_map(plan *p, size_t map_bytes) {
    add_section(p, "MAPT", p->map_text, 1, map_bytes);
    add_section(p, "MAPI", &p->things.info, sizeof p->things.info, 1);
    for (size_t i = 0; i < SLI_SLV_MAP_PARTS; i++) {
        const sli_slv_part_of_map *part = &p->things.parts[i];
        if (part->count) add_section(p, part->tag, part->items, part->item_bytes, part->count);
    }
}

static void add_sections(plan *p, const sl_baked *baked, const sli_slv_info *info,
                         size_t map_bytes) {
    const sl_space *space = &baked->space;
    const sl_stab_trees *trees = &baked->visibility.trees;
    p->version = space->neighbour ? SLI_SLV_VERSION : SLI_SLV_VERSION_AXIAL;
    add_section(p, "INFO", info, sizeof *info, 1);
    add_section(p, "NODE", space->nodes, sizeof *space->nodes, space->node_count);
    add_section(p, "CELL", space->cells, sizeof *space->cells, space->cell_count);
    add_section(p, "VERT", space->vertices, sizeof *space->vertices, space->vertex_count);
    add_section(p, "PORT", space->portals, sizeof *space->portals, space->portal_count);
    add_section(p, "EXIT", space->directed, sizeof *space->directed, space->directed_count);
    add_section(p, "WALL", p->walls, sizeof *p->walls, space->wall_count);
    if (p->grid.starts) {
        const uint64_t buckets = (uint64_t)p->grid.columns * p->grid.rows;
        add_section(p, "NODG", &p->grid, 8, 1); // columns, rows
        add_section(p, "NODS", p->grid.starts, sizeof *p->grid.starts, buckets);
    }
    if (space->neighbour) {
        const sl_cell_grid *g = &space->grid;
        add_section(p, "BEYO", space->neighbour, sizeof *space->neighbour, space->vertex_count);
        add_section(p, "GRIO", g->first, sizeof *g->first, (uint64_t)g->columns * g->rows + 1);
        add_section(p, "GRIC", g->cells, sizeof *g->cells, g->entry_count);
    }
    if (space->seam_count)
        add_section(p, "SEAM", p->seams ? p->seams : space->seams, sizeof *space->seams,
                    space->seam_count);
    if (space->seam_portal_count)
        add_section(p, "SEPO", space->seam_portals, sizeof *space->seam_portals,
                    space->seam_portal_count);
    if (p->stops) add_section(p, "STOP", p->stops, sizeof *p->stops, space->seam_count);
    if (space->passage_count)
        add_section(p, "PASS", p->passages, sizeof *p->passages,
                    2 * (uint64_t)space->passage_count);
    if (p->channel != SL_STOPS_SIGHT) add_section(p, "CHAN", &p->channel, sizeof p->channel, 1);
    if (p->parts) {
        add_pvs(p, "PVSO", "PVSB", &baked->visibility.pvs);
        add_section(p, "PVSP", p->parts, sizeof *p->parts, space->cell_count);
    }
    if (baked->visibility.account.doubtful_pairs)
        add_pvs(p, "DBTO", "DBTB", &baked->visibility.doubtful);
    add_effects(p, &baked->visibility);
    if (trees->cell_count) {
        add_section(p, "TREO", trees->offsets, sizeof *trees->offsets,
                    (uint64_t)trees->cell_count + 1);
        add_section(p, "TREN", trees->nodes, sizeof *trees->nodes,
                    trees->offsets[trees->cell_count]);
    }
    if (sl_partial_begun(&baked->partial)) add_partial(p, &baked->partial);
    if (baked->views.view_cell_count) add_views(p, &baked->views);
    add_map(p, map_bytes);
}

/// Where the machine's order of bytes is not the file's, what is written is a copy.
static sl_status order_contents(sl_context *context, plan *p) {
    for (uint32_t i = 0; i < p->header.section_count && !sli_slv_is_native(); i++) {
        const sli_slv_section *s = &p->sections[i];
        p->copies[i] = sl_alloc_array(context, sli_size(s->count), s->item_bytes);
        if (!p->copies[i]) return SL_NO_MEMORY;
        if (s->count) memcpy(p->copies[i], p->contents[i], sli_size(section_bytes(s)));
        sli_slv_order(s->tag, s->item_bytes, p->copies[i], s->count);
        p->contents[i] = p->copies[i];
    }
    return SL_OK;
}

static sli_slv_header ordered_header(const plan *p) {
    sli_slv_header header = p->header;
    sli_slv_order_header(&header);
    return header;
}

static sli_slv_section ordered_entry(const plan *p, uint32_t section) {
    sli_slv_section entry = p->sections[section];
    sli_slv_order_entry(&entry);
    return entry;
}

/// Places the sections one behind the other and sums up what will be written.
static void lay_out(plan *p) {
    static const char zeros[8] = {0};
    sli_slv_header *header = &p->header;
    memcpy(header->magic, SLI_SLV_MAGIC, sizeof header->magic);
    header->version = p->version;
    header->byte_order = SLI_SLV_BYTE_ORDER;
    uint64_t at = sizeof *header + header->section_count * sizeof *p->sections;
    for (uint32_t i = 0; i < header->section_count; i++) {
        p->sections[i].offset = at;
        at = padded(at + section_bytes(&p->sections[i]));
    }
    header->file_bytes = at;
    sli_checksum sum;
    sli_checksum_begin(&sum);
    const sli_slv_header first = ordered_header(p);
    sli_checksum_add(&sum, &first, sizeof first);
    for (uint32_t i = 0; i < header->section_count; i++) {
        const sli_slv_section entry = ordered_entry(p, i);
        sli_checksum_add(&sum, &entry, sizeof entry);
    }
    for (uint32_t i = 0; i < header->section_count; i++) {
        const uint64_t bytes = section_bytes(&p->sections[i]);
        sli_checksum_add(&sum, p->contents[i], sli_size(bytes));
        sli_checksum_add(&sum, zeros, (size_t)(padded(bytes) - bytes));
    }
    header->checksum = sli_checksum_value(&sum);
}

/// Where the file goes: a stream, or memory.
typedef struct target {
    FILE *stream; ///< NULL: memory, from `at` on
    char *at;
} target;

/// Refused writes are left to the stream's error flag, which the commit asks.
static void put(target *to, const void *bytes, size_t size) {
    if (!size) return;
    if (to->stream) {
        fwrite(bytes, 1, size, to->stream);
        return;
    }
    memcpy(to->at, bytes, size);
    to->at += size;
}

static sl_status put_plan(sl_context *context, const plan *p, target *to) {
    static const char zeros[8] = {0};
    const sli_slv_header header = ordered_header(p);
    put(to, &header, sizeof header);
    for (uint32_t i = 0; i < p->header.section_count; i++) {
        const sli_slv_section entry = ordered_entry(p, i);
        put(to, &entry, sizeof entry);
    }
    for (uint32_t i = 0; i < p->header.section_count; i++) {
        SL_TRY(sl_check_cancelled(context));
        const uint64_t bytes = section_bytes(&p->sections[i]);
        put(to, p->contents[i], sli_size(bytes));
        put(to, zeros, (size_t)(padded(bytes) - bytes));
        sl_report(context, "write", "bytes", p->sections[i].offset + bytes, p->header.file_bytes);
    }
    return SL_OK;
}

/// Makes the file ready; `info` is part of it and must live as long.
static sl_status make_plan(sl_context *context, const sl_baked *baked, const sli_slv_info *info,
                           plan *p) {
    const uint32_t cells = baked->space.cell_count;
    const sl_pvs *rows = sl_baked_is_shard(baked) ? &baked->partial.sure : &baked->visibility.pvs;
    if (!cells || rows->cell_count != cells)
        return sl_fail(context, SL_BAD_ARGUMENT, "nothing baked: no visible set for each cell");
    if (baked->by_views && !baked->views.view_cell_count)
        return sl_fail(context, SL_BAD_ARGUMENT, "no view cells to stand for the cells");
    if (baked->views.view_cell_count && baked->views.rows.cell_count != cells)
        return sl_fail(context, SL_BAD_ARGUMENT, "the view cells are of another space");
    if (!sli_slv_is_name(info->method) || !sli_slv_is_name(info->solver))
        return sl_fail(
            context, SL_BAD_ARGUMENT,
            "the names of method and solver must be up to 15 letters, digits and dashes");
    size_t map_bytes = 0;
    SL_TRY(copy_walls(context, &baked->space, p));
    SL_TRY(list_stops(context, baked, p));
    SL_TRY(copy_seams(context, &baked->space, p));
    SL_TRY(list_parts(context, baked, p));
    if (!baked->space.neighbour) SL_TRY(sli_tree_grid_make(context, &baked->space, &p->grid));
    SL_TRY(sli_slv_list_passages(context, &baked->space, &p->passages));
    SL_TRY(print_map(context, &baked->map, p, &map_bytes));
    SL_TRY(sli_slv_things_make(context, &baked->map, &p->things));
    add_sections(p, baked, info, map_bytes);
    SL_TRY(order_contents(context, p));
    lay_out(p);
    return SL_OK;
}

static sl_status write_plan(sl_context *context, const void *user, FILE *stream) {
    return put_plan(context, user, &(target){.stream = stream});
}

static sl_status read_back(sl_context *context, const void *user, const char *name,
                           sli_again *again) {
    const plan *p = user;
    return sli_slv_read_back(context, name, &p->map, again);
}

static void destroy_plan(sl_context *context, plan *p) {
    for (uint32_t i = 0; i < p->header.section_count; i++) sl_free(context, p->copies[i]);
    sl_free(context, p->walls);
    sl_free(context, p->stops);
    sl_free(context, p->seams);
    sl_free(context, p->parts);
    sl_free(context, p->grid.starts);
    sl_free(context, p->passages);
    sl_free(context, p->map.seams);
    sli_slv_things_destroy(context, &p->things);
    free(p->map_text);
}

/// The bytes of a plan; `out` stays as it was on failure.
static sl_status print_plan(sl_context *context, const plan *p, sl_bytes *out) {
    if (p->header.file_bytes >= SIZE_MAX) return sl_fail_memory(context);
    const size_t size = (size_t)p->header.file_bytes;
    char *data = sl_alloc(context, size + 1);
    if (!data) return SL_NO_MEMORY;
    const sl_status status = put_plan(context, p, &(target){.at = data});
    if (status != SL_OK) {
        sl_free(context, data);
        return status;
    }
    data[size] = 0;
    *out = (sl_bytes){data, size};
    return SL_OK;
}

sl_status sl_baked_print(sl_context *context, const sl_baked *baked, sl_bytes *out) {
    plan p = {0};
    const sli_slv_info info = make_info(baked);
    sl_status status = make_plan(context, baked, &info, &p);
    if (status == SL_OK) status = print_plan(context, &p, out);
    destroy_plan(context, &p);
    return status;
}

sl_status sl_baked_write(sl_context *context, const sl_baked *baked, const char *path) {
    plan p = {0};
    const sli_slv_info info = make_info(baked);
    sl_status status = make_plan(context, baked, &info, &p);
    const sli_to_write file = {&p, write_plan, read_back};
    if (status == SL_OK) status = sli_file_write(context, path, &file);
    destroy_plan(context, &p);
    return status;
}

#include "present.h"

#include "sightline/support.h"

#include <string.h>

typedef struct present_own {
    sl_space space;
    /// For mirrors, into which glass is dark or not by another side; empty where the map has not
    /// both. `doors` has walls in shut doors alone, `one_way` also on the dark sides of glass.
    sl_space doors, one_way;
    sl_outline outline;
    sl_visibility row; ///< of the first of the eye's cells: what all of them see
    uint32_t *cells;   ///< the eye's
    uint32_t cell_count;
    sl_bits *marks;
    sl_eye_search *search;
} own;

// --- what is shut

/// Glass from a to b can be looked through from its right to its left. A straight line that crosses
/// it comes from the side of the eye. So for an eye at its left the glass is a wall.
static bool find_shut(const sl_map *map, sl_point eye, bool backwards, bool *shut) {
    bool any = false;
    for (size_t i = 0; i < map->door_count; i++) any |= shut[i] = !map->doors[i].open;
    for (size_t i = 0; i < map->oneway_count; i++) {
        const sl_segment glass = map->oneways[i].segment;
        any |= shut[map->door_count + i] =
            (backwards ? sl_orient(glass.b, glass.a, eye) : sl_orient(glass.a, glass.b, eye)) > 0;
    }
    return any;
}

/// Makes the space with walls in what is shut. To the library, dark glass is one more door.
static sl_status make_space(sl_context *context, const present_state *present,
                            const document_state *document, sl_space *out) {
    sl_space from = document->baked->space;
    sl_seam *seams = sl_alloc_array(context, from.seam_count, sizeof *seams);
    if (!seams) return SL_NO_MEMORY;
    if (from.seam_count) memcpy(seams, from.seams, from.seam_count * sizeof *seams);
    for (uint32_t i = 0; i < from.seam_count; i++) {
        if (seams[i].kind != SL_SEAM_ONEWAY) continue;
        seams[i].kind = SL_SEAM_DOOR;
        seams[i].number += (uint32_t)document->baked->map.door_count;
    }
    from.seams = seams;
    const sl_filtered_space filtered = {.shut = present->shut};
    const sl_status status = sl_filtered_space_make(context, &from, &filtered, NULL, out);
    sl_free(context, seams);
    return status;
}

/// Where both are, what is dark in a mirror is not what is dark from the eye.
static bool has_both(const document_state *document) {
    return document->baked->map.mirror_count && document->baked->map.oneway_count;
}

// --- what it is made of

static void drop_own(sl_context *context, present_state *present) {
    own *o = present->own;
    sl_moving_destroy(context, present->moving);
    present->moving = NULL;
    present->parents = NULL;
    present->still = false;
    if (!o) return;
    sl_eye_search_destroy(context, o->search);
    sl_visibility_destroy(context, &o->row);
    sl_free(context, o->cells);
    sl_free(context, o->marks);
    sl_outline_destroy(context, &o->outline);
    sl_space_destroy(context, &o->space);
    sl_space_destroy(context, &o->doors);
    sl_space_destroy(context, &o->one_way);
    sl_free(context, o);
    present->own = NULL;
}

void present_drop(sl_context *context, present_state *present) {
    drop_own(context, present);
    sl_room_mirrors_destroy(context, &present->mirrors);
    sl_free(context, present->shut);
    sl_free(context, present->wanted);
    *present = (present_state){.version = present->version + 1, .backwards = present->backwards};
}

static void add_row(const present_state *present, const sl_pvs *pvs, const sl_door_sets *doors,
                    uint32_t cell, sl_bits *set) {
    if (!present->has_rows || cell >= pvs->cell_count) return;
    for (sl_pvs_run r = sl_pvs_begin(pvs, cell); sl_pvs_next(&r);)
        for (uint32_t i = r.first; i < r.end; i++) sl_bits_add(set, i);
    if (!doors->cell_count || !present->shut) return;
    for (sl_door_pairs p = sl_door_pairs_begin(doors, cell); sl_door_pairs_next(&p, present->shut);)
        if (!p.open) set[p.cell / 64] &= ~((sl_bits)1 << p.cell % 64);
}

void present_add_row(const present_state *present, const document_state *document, uint32_t cell,
                     sl_bits *set) {
    const sl_visibility *v = &document->baked->visibility;
    add_row(present, &v->pvs, &v->doors, cell, set);
}

void present_add_mirrored(const present_state *present, const document_state *document,
                          uint32_t cell, sl_bits *set) {
    const sl_visibility *v = &document->baked->visibility;
    add_row(present, &v->mirrored, &v->mirrored_doors, cell, set);
}

bool present_sees(const present_state *present, const document_state *document, uint32_t from,
                  uint32_t to) {
    const sl_visibility *v = &document->baked->visibility;
    if (from >= v->pvs.cell_count || !sl_pvs_sees(&v->pvs, from, to)) return false;
    return !v->doors.cell_count || !present->shut ||
           sl_door_sets_open(&v->doors, from, to, present->shut);
}

typedef void (*add_function)(const present_state *present, const document_state *document,
                             uint32_t cell, sl_bits *set);

/// A number in LEB128; returns its end.
static uint8_t *put_number(uint8_t *out, uint32_t number) {
    for (; number >= 128; number >>= 7) *out++ = (uint8_t)(number | 128);
    *out++ = (uint8_t)number;
    return out;
}

/// A set of `count` cells as the runs of a row (sl_pvs); returns its end. Without `out` it only
/// counts: a number has at most 5 bytes.
static size_t encode_row(const sl_bits *set, uint32_t count, uint8_t *out) {
    uint8_t *at = out;
    size_t numbers = 0;
    uint32_t first = 0, behind = 0; // of the run; behind the last one
    for (uint32_t i = 0; i < count; i++) {
        if (!sl_bits_has(set, i)) continue;
        for (first = i; i < count && sl_bits_has(set, i);) i++;
        numbers += 2;
        if (out) at = put_number(put_number(at, first - behind), i - first);
        behind = i;
    }
    return out ? (size_t)(at - out) : 5 * numbers;
}

/// What the eye's cells see, as rows of which all but the first cell's are empty.
static sl_status make_row(sl_context *context, const present_state *present,
                          const document_state *document, add_function add, sl_pvs *out) {
    const own *o = present->own;
    const uint32_t count = document->baked->space.cell_count;
    const uint32_t cell = o->cell_count ? o->cells[0] : SL_NO_CELL;
    sl_pvs made = {.cell_count = count};
    sl_bits *set = sl_alloc_array(context, sl_bits_words(count), sizeof *set);
    for (uint32_t i = 0; i < o->cell_count && set; i++) add(present, document, o->cells[i], set);
    made.offsets = sl_alloc_array(context, (size_t)count + 1, sizeof *made.offsets);
    if (set) made.bytes = sl_alloc_array(context, encode_row(set, count, NULL), 1);
    const bool good = set && made.offsets && made.bytes;
    if (good) {
        const size_t size = encode_row(set, count, made.bytes);
        for (uint32_t i = 0; i <= count; i++) made.offsets[i] = i > cell ? size : 0;
        *out = made;
    } else {
        sl_pvs_destroy(context, &made);
    }
    sl_free(context, set);
    return good ? SL_OK : SL_NO_MEMORY;
}

/// The search looks the row up again in each query.
static sl_status follow_eye(sl_context *context, present_state *present,
                            const document_state *document, sl_point eye) {
    own *o = present->own;
    const uint32_t before = o->cell_count ? o->cells[0] : SL_NO_CELL, count = o->cell_count;
    o->cell_count = sl_eye_cells(&o->space, eye, o->cells, o->marks);
    const bool same = count == 1 && o->cell_count == 1 && o->cells[0] == before;
    if (o->search && (same || !present->has_rows)) return SL_OK;
    sl_visibility row = {.sight = document->baked->visibility.sight};
    sl_status status = SL_OK;
    if (present->has_rows) status = make_row(context, present, document, present_add_row, &row.pvs);
    if (status == SL_OK && present->has_rows && document->map.mirror_count)
        status = make_row(context, present, document, present_add_mirrored, &row.mirrored);
    sl_visibility_destroy(context, &o->row);
    o->row = row;
    SL_TRY(status);
    if (o->search) return SL_OK;
    const sl_space *space = o->one_way.cell_count ? &o->one_way : &o->space;
    SL_TRY(sl_eye_search_create(context, space, &o->row, &o->search));
    return document_add_mirrors(context, document, o->search);
}

static sl_status make_own(sl_context *context, present_state *present,
                          const document_state *document) {
    own *o = present->own = sl_alloc_array(context, 1, sizeof *o);
    if (!o) return SL_NO_MEMORY;
    SL_TRY(make_space(context, present, document, &o->space));
    o->cells = sl_alloc_array(context, o->space.cell_count, sizeof *o->cells);
    o->marks = sl_alloc_array(context, sl_eye_words(&o->space), sizeof *o->marks);
    if (!o->cells || !o->marks) return SL_NO_MEMORY;
    if (!has_both(document)) return sl_outline_make(context, &o->space, &o->outline);
    sl_filtered_space filtered = {.shut = present->shut};
    SL_TRY(sl_filtered_space_make(context, &document->baked->space, &filtered, NULL, &o->doors));
    filtered = (sl_filtered_space){.shut = present->shut, .one_way = true, .dark_walls = true};
    SL_TRY(sl_filtered_space_make(context, &document->baked->space, &filtered, NULL, &o->one_way));
    return sl_outline_make(context, present->backwards ? &o->space : &o->one_way, &o->outline);
}

/// Starts again with a new document, or one that changed.
static sl_status begin(sl_context *context, present_state *present,
                       const document_state *document) {
    present_drop(context, present);
    // The clean map: in it, glass that something crosses is several.
    const sl_map *map = &document->baked->map;
    const size_t count = map->door_count + map->oneway_count;
    present->document_version = document->version;
    present->shut_count = count;
    if (!count) return SL_OK;
    present->shut = sl_alloc_array(context, count, sizeof *present->shut);
    present->wanted = sl_alloc_array(context, count, sizeof *present->wanted);
    return present->shut && present->wanted ? SL_OK : SL_NO_MEMORY;
}

/// Puts the map's objects into the space.
static sl_status place(sl_context *context, present_state *present,
                       const document_state *document) {
    sl_moving_box boxes[OBJECTS_MOST] = {0};
    const uint32_t *parents;
    bool any = false;
    for (size_t i = 0; i < document->object_count; i++) {
        boxes[i] = (sl_moving_box){document->map.objects[i].box, document->blocks[i]};
        any |= boxes[i].blocks;
    }
    SL_TRY(sl_moving_set_boxes(context, present->moving, boxes, document->object_count));
    sl_moving_space(present->moving, &parents);
    present->parents = any ? parents : NULL;
    return SL_OK;
}

/// Objects cut both sides of glass before it is dark from one.
static sl_status make_moving(sl_context *context, present_state *present,
                             const document_state *document) {
    const own *o = present->own;
    const bool both = has_both(document);
    SL_TRY(sl_moving_create(context, both ? &o->doors : present->space,
                            o ? &o->row : &document->baked->visibility, &present->moving));
    present->touched = document->touched + 1; // whatever it was
    if (both) SL_TRY(sl_moving_add_glass(context, present->moving));
    if (!document->baked->map.mirror_count || !document->mirror_depth) return SL_OK;
    return sl_moving_add_mirrors(context, present->moving, &document->baked->map,
                                 document->mirror_depth);
}

/// Puts objects in again where they moved or the space changed.
static sl_status put_objects(sl_context *context, present_state *present,
                             const document_state *document) {
    if (!present->moving) SL_TRY(make_moving(context, present, document));
    if (present->touched != document->touched) {
        SL_TRY(place(context, present, document));
        present->touched = document->touched;
        present->version++;
    }
    return present->parents ? sl_moving_outline(context, present->moving, &present->outline)
                            : SL_OK;
}

/// If objects cannot be put in as they are now, sight goes past them.
static sl_status follow_objects(sl_context *context, present_state *present,
                                const document_state *document) {
    if (!document->object_count || present->backwards) return SL_OK;
    if (present->still && present->touched == document->touched) return SL_OK;
    const sl_status status = put_objects(context, present, document);
    present->still = status == SL_UNSUPPORTED;
    if (!present->still) return status;
    sl_moving_destroy(context, present->moving);
    present->moving = NULL;
    present->parents = NULL;
    present->touched = document->touched;
    present->version++;
    return SL_OK;
}

static sl_status update(sl_context *context, present_state *present, const document_state *document,
                        sl_point eye) {
    const bool fresh = !present->space || present->document_version != document->version;
    if (fresh) SL_TRY(begin(context, present, document));
    const size_t count = present->shut_count;
    const bool has_rows = document_has_rows(document);
    const bool unused = document->has_visibility && !has_rows; // its search would believe them
    const bool any =
        count && find_shut(&document->baked->map, eye, present->backwards, present->wanted);
    const bool same = !count || memcmp(present->shut, present->wanted, count) == 0;
    if (fresh || !same || has_rows != present->has_rows) {
        if (count) memcpy(present->shut, present->wanted, count);
        present->has_rows = has_rows;
        present->version++;
        drop_own(context, present);
        if (any || unused || has_both(document)) SL_TRY(make_own(context, present, document));
    }
    if (present->own && !present->backwards) SL_TRY(follow_eye(context, present, document, eye));
    const own *o = present->own;
    present->space = o ? &o->space : &document->baked->space;
    present->outline = o ? &o->outline : &document->outline;
    present->search = o ? o->search : document->search;
    SL_TRY(follow_objects(context, present, document));
    const bool same_outline = present->mirrors.outline == present->outline &&
                              present->mirrors_version == present->version;
    if (!document->baked->map.mirror_count || same_outline) return SL_OK;
    sl_room_mirrors_destroy(context, &present->mirrors);
    present->mirrors_version = present->version;
    return sl_room_mirrors_make(context, present->outline, &document->baked->map,
                                &present->mirrors);
}

sl_status present_update(sl_context *context, present_state *present,
                         const document_state *document, sl_point eye) {
    if (!document->baked) {
        if (present->space) present_drop(context, present);
        return SL_OK;
    }
    const sl_status status = update(context, present, document, eye);
    if (status != SL_OK) present_drop(context, present);
    return status;
}

// --- the stab tree

static bool passes_shut(const present_state *present, const sl_space *space, uint32_t directed) {
    size_t count;
    const sl_seam_portal *on = sl_space_seams_of(space, space->directed[directed].portal, &count);
    for (size_t i = 0; i < count; i++) {
        const sl_seam *seam = &space->seams[on[i].seam];
        if (seam->kind == SL_SEAM_DOOR && present->shut[seam->number]) return true;
    }
    return false;
}

/// Keeps nodes whose parents are kept; `numbers` gets the new number of each.
static uint32_t keep_nodes(const present_state *present, const sl_space *space,
                           const sl_stab_node *from, uint32_t count, uint32_t *numbers,
                           sl_stab_node *to) {
    uint32_t kept = 0;
    for (uint32_t i = 0; i < count; i++) {
        numbers[i] = UINT32_MAX;
        const bool root = from[i].directed == UINT32_MAX;
        const bool portal = !root && !sl_stab_is_mirror(&from[i]);
        if (!root && numbers[from[i].parent] == UINT32_MAX) continue;
        if (portal && passes_shut(present, space, from[i].directed)) continue;
        to[kept] = from[i];
        to[kept].parent = root ? kept : numbers[from[i].parent];
        numbers[i] = kept++;
    }
    return kept;
}

sl_status present_tree(sl_context *context, const present_state *present,
                       const document_state *document, uint32_t cell, sl_stab_trees *out) {
    const sl_stab_trees *all = &document->baked->visibility.trees;
    const uint32_t cells = document->baked->space.cell_count;
    if (cell >= all->cell_count) {
        *out = (sl_stab_trees){0};
        return SL_OK;
    }
    const uint32_t count = (uint32_t)(all->offsets[cell + 1] - all->offsets[cell]);
    sl_stab_trees tree = {.cell_count = cells};
    uint32_t *numbers = sl_alloc_array(context, count, sizeof *numbers);
    tree.offsets = sl_alloc_array(context, (size_t)cells + 1, sizeof *tree.offsets);
    tree.nodes = sl_alloc_array(context, count, sizeof *tree.nodes);
    if (!numbers || !tree.offsets || !tree.nodes) {
        sl_free(context, numbers);
        sl_free(context, tree.offsets);
        sl_free(context, tree.nodes);
        return SL_NO_MEMORY;
    }
    const uint32_t kept = keep_nodes(present, &document->baked->space,
                                     all->nodes + all->offsets[cell], count, numbers, tree.nodes);
    for (uint32_t i = cell + 1; i <= cells; i++) tree.offsets[i] = kept;
    sl_free(context, numbers);
    *out = tree;
    return SL_OK;
}

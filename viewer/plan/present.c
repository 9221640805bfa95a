/// The query is brought up to date, each part only where it has changed.
#include "plan/present.h"

#include "sightline/support.h"

void present_drop(sl_context *context, present_state *present) {
    sl_query_destroy(context, present->own);
    sl_space_destroy(context, &present->filtered);
    sl_free(context, present->sides);
    *present = (present_state){.version = present->version + 1, .backwards = present->backwards};
}

/// Starts again with a new document, or one that changed.
static sl_status start_again(sl_context *context, present_state *present,
                             const document_state *document) {
    const sl_baked *baked = document->baked;
    present_drop(context, present);
    present->sides = sl_alloc_array(context, baked->map.oneway_count, sizeof *present->sides);
    if (!present->sides) return SL_NO_MEMORY;
    if (present->backwards) {
        SL_TRY(sl_query_over(context, &baked->space, &baked->map, NULL, &present->own));
        sl_query_set_backwards(context, present->own, true);
    }
    present->query = present->backwards ? present->own : document->query;
    present->document_version = document->version;
    present->touched = document->touched + 1; // whatever it was
    present->sets = document->sets + 1;
    return SL_OK;
}

/// Opens and shuts doors as in the document. Returns whether some changed.
static bool follow_doors(sl_context *context, present_state *present, const sl_map *map) {
    bool changed = false;
    for (size_t i = 0; i < map->door_count; i++) {
        if (sl_query_door_is_open(present->query, i) == map->doors[i].open) continue;
        sl_query_set_door_at(context, present->query, i, map->doors[i].open);
        changed = true;
    }
    return changed;
}

/// Finds the sides of glass that the eye is on. Returns whether it passed a line.
static bool follow_eye(present_state *present, const sl_map *map, sl_point eye) {
    bool changed = false;
    present->eye = eye;
    for (size_t i = 0; i < map->oneway_count; i++) {
        const sl_segment glass = map->oneways[i].segment;
        const int side = sl_orient(glass.a, glass.b, eye);
        changed |= present->sides[i] != side;
        present->sides[i] = (signed char)side;
    }
    return changed;
}

/// Visible sets do not serve a range beyond the one of their bake: they go before it grows, and
/// come after it shrank.
static sl_status follow_sets(sl_context *context, present_state *present,
                             const document_state *document) {
    const bool has_rows = document_has_rows(document);
    const bool same = present->sets == document->sets && present->has_rows == has_rows;
    const sl_visibility *sets = &document->baked->visibility;
    present->no_rows.sight = sets->sight;
    if (!same) SL_TRY(sl_query_set_visibility(context, present->query, &present->no_rows));
    SL_TRY(sl_query_set_range(context, present->query, document->map.range));
    if (!same && has_rows) SL_TRY(sl_query_set_visibility(context, present->query, sets));
    if (present->has_rows != has_rows) present->version++;
    present->has_rows = has_rows;
    present->sets = document->sets;
    return SL_OK;
}

/// Puts the map's objects in, and makes the outline that shows whether they fit.
static sl_status place_objects(sl_context *context, present_state *present,
                               const document_state *document) {
    sl_moving_box boxes[OBJECTS_MOST] = {0};
    for (size_t i = 0; i < document->object_count; i++)
        boxes[i] = (sl_moving_box){document->map.objects[i].box, document->blocks[i]};
    SL_TRY(sl_query_set_boxes(context, present->query, boxes, document->object_count));
    return sl_query_outline(context, present->query, &present->outline);
}

static sl_status follow_objects(sl_context *context, present_state *present,
                                const document_state *document) {
    present->touched = document->touched;
    const sl_status status = place_objects(context, present, document);
    present->still = status == SL_UNSUPPORTED;
    if (present->still) return sl_query_set_boxes(context, present->query, NULL, 0);
    return status;
}

static sl_status follow_changes(sl_context *context, present_state *present,
                                const document_state *document, sl_point eye) {
    const sl_map *map =
        &document->baked->map; // the clean one: its glass is cut where it is crossed
    if (!present->query || present->document_version != document->version)
        SL_TRY(start_again(context, present, document));
    bool changed = follow_doors(context, present, map);
    changed |= follow_eye(present, map, eye);
    SL_TRY(follow_sets(context, present, document));
    SL_TRY(sl_query_set_mirror_depth(context, present->query, document->mirror_depth));
    changed |= present->mirror_depth != document->mirror_depth;
    present->mirror_depth = document->mirror_depth;
    if (document->object_count && present->touched != document->touched) {
        SL_TRY(follow_objects(context, present, document));
        changed = true;
    }
    if (changed) {
        present->version++;
        sl_space_destroy(context, &present->filtered);
        present->space = NULL;
    }
    const sl_space *space;
    SL_TRY(sl_query_space(context, present->query, &space, &present->parents));
    SL_TRY(sl_query_outline(context, present->query, &present->outline));
    return SL_OK;
}

sl_status present_update(sl_context *context, present_state *present,
                         const document_state *document, sl_point eye) {
    if (!document->baked) {
        if (present->query) present_drop(context, present);
        return SL_OK;
    }
    const sl_status status = follow_changes(context, present, document, eye);
    if (status != SL_OK) present_drop(context, present);
    return status;
}

bool present_has_shut(const present_state *present) {
    const size_t count = present->query ? sl_query_map(present->query)->door_count : 0;
    for (size_t i = 0; i < count; i++)
        if (!sl_query_door_is_open(present->query, i)) return true;
    return false;
}

sl_status present_space(sl_context *context, present_state *present) {
    if (present->space) return SL_OK;
    bool any = present_has_shut(present);
    for (size_t i = 0; i < sl_query_map(present->query)->oneway_count; i++)
        any |= present->sides[i] >= 0;
    if (any) SL_TRY(sl_query_copy_space(context, present->query, present->eye, &present->filtered));
    present->space = any ? &present->filtered : sl_query_asked(present->query);
    return SL_OK;
}

bool present_sees(sl_context *context, const present_state *present, uint32_t from, uint32_t to) {
    bool sees = false;
    return present->has_rows &&
           sl_query_can_see(context, present->query, from, to, &sees) == SL_OK && sees;
}

// --- the stab tree

static bool passes_shut(const present_state *present, const sl_space *space, uint32_t directed) {
    size_t count;
    const sl_seam_portal *on = sl_space_seams_of(space, space->directed[directed].portal, &count);
    for (size_t i = 0; i < count; i++) {
        const sl_seam *seam = &space->seams[on[i].seam];
        if (seam->kind == SL_SEAM_DOOR && !sl_query_door_is_open(present->query, seam->number))
            return true;
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

/// A query puts what stands between a bake and an eye in layers, each made only where it is called
/// for and kept until a setting below it changes:
///
///     baked space and sets
///       doors that are shut: walls in their place, sets without what is seen through them
///         one-way glass: a wall on its dark side, a portal on the other
///           what answers: the search of cells, the outline of rooms, mirrors
///         moving boxes, which cut both sides of glass before it is one-way
///
/// A layer that changes nothing is the one below it.
#include "sightline/query.h"

#include "eye_to_cell/eye_search.h"
#include "geometry/crossing.h"
#include "sightline/moving.h"
#include "sightline/sees.h"
#include "sightline/support.h"

#include <math.h>
#include <string.h>

enum { MIRROR_DEPTH_MOST = 16 };

/// A space as sight finds it, and the visible sets that go with it.
typedef struct layer {
    const sl_space *space;
    const sl_visibility *visibility;
    sl_space own_space;           ///< where the layer makes one
    sl_visibility own_visibility; ///< of the glass: borrowed rows
} layer;

struct sl_query {
    const sl_baked *baked;
    sl_baked own; ///< where the query has read the file
    bool *shut;   ///< by door of the map
    double range;
    uint32_t mirror_depth;
    sl_moving_box *boxes;
    size_t box_count;
    bool any_blocks;   ///< some box hides what is behind it
    bool boxes_placed; ///< in `moving`

    layer doors, glass;
    bool has_doors, has_glass; ///< whether the layers are made

    // What answers, of the upper layer; NULL where it is not made.
    sl_eye_search *search;
    sl_outline *outline;
    sli_box_lists lists; ///< of the boxes; `first` NULL if not made
    sl_moving *moving;
    sl_room_mirrors *mirrors; ///< of the outline that is looked at
};

// --- making and letting go

static void drop_mirrors(sl_context *context, sl_query *q) {
    if (q->mirrors) sl_room_mirrors_destroy(context, q->mirrors);
    sl_free(context, q->mirrors);
    q->mirrors = NULL;
}

static void drop_boxes(sl_context *context, sl_query *q) {
    drop_mirrors(context, q);
    if (!SLI_BOXES) return;
    if (q->moving) sl_moving_destroy(context, q->moving);
    q->moving = NULL;
    q->boxes_placed = false;
    sli_box_lists_destroy(context, &q->lists);
}

static void drop_answers(sl_context *context, sl_query *q) {
    drop_boxes(context, q);
    if (q->search) sl_eye_search_destroy(context, q->search);
    if (q->outline) sl_outline_destroy(context, q->outline);
    sl_free(context, q->outline);
    q->search = NULL;
    q->outline = NULL;
}

static void drop_glass(sl_context *context, sl_query *q) {
    drop_answers(context, q);
    sl_space_destroy(context, &q->glass.own_space);
    q->has_glass = false;
}

static void drop_doors(sl_context *context, sl_query *q) {
    drop_glass(context, q);
    sl_space_destroy(context, &q->doors.own_space);
    sl_visibility_destroy(context, &q->doors.own_visibility);
    q->has_doors = false;
}

void sl_query_destroy(sl_context *context, sl_query *query) {
    if (!query) return;
    drop_doors(context, query);
    sl_baked_destroy(context, &query->own);
    sl_free(context, query->shut);
    sl_free(context, query->boxes);
    sl_free(context, query);
}

sl_status sl_query_create(sl_context *context, const sl_baked *baked, sl_query **out) {
    if (sl_baked_is_shard(baked))
        return sl_fail(context, SL_BAD_ARGUMENT,
                       "this is one shard of a bake, without visible sets: merge the shards first");
    sl_query *q = sl_alloc_array(context, 1, sizeof *q);
    if (!q) return SL_NO_MEMORY;
    q->baked = baked;
    q->range = baked->map.range;
    q->mirror_depth = 1;
    q->shut = sl_alloc_array(context, baked->map.door_count, sizeof *q->shut);
    if (!q->shut) {
        sl_query_destroy(context, q);
        return SL_NO_MEMORY;
    }
    for (size_t i = 0; i < baked->map.door_count; i++) q->shut[i] = !baked->map.doors[i].open;
    *out = q;
    return SL_OK;
}

sl_status sl_query_open(sl_context *context, const char *path, sl_query **out) {
    sl_baked baked = {0};
    SL_TRY(sl_baked_read(context, path, &baked));
    const sl_status status = sl_query_create(context, &baked, out);
    if (status != SL_OK) {
        sl_baked_destroy(context, &baked);
        return status;
    }
    (*out)->own = baked;
    (*out)->baked = &(*out)->own;
    return SL_OK;
}

const sl_baked *sl_query_baked(const sl_query *query) {
    return query->baked;
}

// --- settings

static sl_status fail_door(sl_context *context, const sl_map *map, const char *name) {
    char names[512] = "none";
    size_t length = 0;
    for (size_t i = 0; i < map->door_count && length < sizeof names; i++)
        length += (size_t)snprintf(names + length, sizeof names - length, "%s%.64s", i ? ", " : "",
                                   map->doors[i].name);
    return sl_fail(context, SL_BAD_ARGUMENT, "there is no door '%.64s'; the map's doors: %s", name,
                   names);
}

sl_status sl_query_set_door(sl_context *context, sl_query *query, const char *name, bool open) {
    const sl_map *map = &query->baked->map;
    bool found = false, changed = false;
    for (size_t i = 0; i < map->door_count; i++) {
        if (strcmp(map->doors[i].name, name) != 0) continue;
        found = true;
        changed |= query->shut[i] == open;
        query->shut[i] = !open;
    }
    if (changed) drop_doors(context, query);
    return found ? SL_OK : fail_door(context, map, name);
}

void sl_query_set_doors(sl_context *context, sl_query *query, bool open) {
    for (size_t i = 0; i < query->baked->map.door_count; i++) query->shut[i] = !open;
    drop_doors(context, query);
}

sl_status sl_query_set_boxes(sl_context *context, sl_query *query, const sl_moving_box *boxes,
                             size_t count) {
    sl_moving_box *copy = NULL;
    if (!SLI_BOXES && count)
        return sl_fail(context, SL_UNSUPPORTED, "this build has no boxes (SIGHTLINE_BOXES)");
    if (count) {
        copy = sl_alloc_array(context, count, sizeof *copy);
        if (!copy) return SL_NO_MEMORY;
        memcpy(copy, boxes, count * sizeof *copy);
    }
    drop_mirrors(context, query);
    query->boxes_placed = false;
    if (SLI_BOXES) sli_box_lists_destroy(context, &query->lists);
    sl_free(context, query->boxes);
    query->boxes = copy;
    query->box_count = count;
    query->any_blocks = false;
    for (size_t i = 0; i < count; i++) query->any_blocks |= copy[i].blocks;
    return SL_OK;
}

sl_status sl_query_set_range(sl_context *context, sl_query *query, double range) {
    const double baked = query->baked->map.range;
    if (!(range >= 0) || isinf(range))
        return sl_fail(context, SL_BAD_ARGUMENT,
                       "the range must be 0 or more, and finite; 0: no limit");
    if (baked > 0 && (range == 0 || range > baked))
        return sl_fail(
            context, SL_BAD_ARGUMENT,
            "the map was baked with a view range of %.17g, and nothing farther is known: "
            "ask for a range up to that, or bake the map --without range",
            baked);
    query->range = range;
    return SL_OK;
}

sl_status sl_query_set_mirror_depth(sl_context *context, sl_query *query, uint32_t depth) {
    if (depth > MIRROR_DEPTH_MOST)
        return sl_fail(context, SL_BAD_ARGUMENT, "the mirror depth must be 0 to %d",
                       MIRROR_DEPTH_MOST);
    if (depth != query->mirror_depth) drop_answers(context, query);
    query->mirror_depth = depth;
    return SL_OK;
}

// --- the layers

static sl_status make_doors(sl_context *context, sl_query *q) {
    layer *l = &q->doors;
    bool any = false;
    if (q->has_doors) return SL_OK;
    for (size_t i = 0; i < q->baked->map.door_count; i++) any |= q->shut[i];
    l->space = any ? &l->own_space : &q->baked->space;
    l->visibility = any ? &l->own_visibility : &q->baked->visibility;
    if (any) SL_TRY(sl_baked_shut(context, q->baked, q->shut, &l->own_space, &l->own_visibility));
    q->has_doors = true;
    return SL_OK;
}

static sl_status make_glass(sl_context *context, sl_query *q) {
    layer *l = &q->glass;
    if (q->has_glass) return SL_OK;
    l->space = q->doors.space;
    l->visibility = q->doors.visibility;
    if (q->baked->map.oneway_count) {
        const sl_filtered_space filtered = {.one_way = true, .dark_walls = true};
        SL_TRY(sl_filtered_space_make(context, q->doors.space, &filtered, NULL, &l->own_space));
        l->space = &l->own_space;
        // The rows are those of the doors' layer. Its stab trees have other directed portals.
        l->own_visibility = *q->doors.visibility;
        l->own_visibility.trees = (sl_stab_trees){0};
        l->visibility = &l->own_visibility;
    }
    q->has_glass = true;
    return SL_OK;
}

static sl_status make_layers(sl_context *context, sl_query *q) {
    if (SLI_BOXES) SL_TRY(sli_moving_boxes_check(context, q->boxes, q->box_count));
    SL_TRY(make_doors(context, q));
    return make_glass(context, q);
}

/// Whether sight goes past boxes that hide what is behind them.
static bool has_blocks(const sl_query *q) {
    return SLI_BOXES && q->any_blocks;
}

static bool has_mirrors(const sl_query *q) {
    return q->baked->map.mirror_count && q->mirror_depth;
}

// --- what answers

static sl_status make_search(sl_context *context, sl_query *q) {
    if (!q->search) {
        sl_eye_search *search;
        SL_TRY(sl_eye_search_create(context, q->glass.space, q->glass.visibility, &search));
        const sl_status status =
            has_mirrors(q)
                ? sl_eye_search_add_mirrors(context, search, &q->baked->map, q->mirror_depth)
                : SL_OK;
        if (status != SL_OK) {
            sl_eye_search_destroy(context, search);
            return status;
        }
        q->search = search;
    }
    sl_eye_search_set_range(q->search, q->range);
    return SL_OK;
}

static sl_status create_moving(sl_context *context, sl_query *q) {
    sl_moving *moving;
    SL_TRY(sl_moving_create(context, q->doors.space, q->doors.visibility, &moving));
    sl_status status = q->baked->map.oneway_count ? sl_moving_add_glass(context, moving) : SL_OK;
    if (status == SL_OK && has_mirrors(q))
        status = sl_moving_add_mirrors(context, moving, &q->baked->map, q->mirror_depth);
    if (status == SL_OK)
        q->moving = moving;
    else
        sl_moving_destroy(context, moving);
    return status;
}

static sl_status make_moving(sl_context *context, sl_query *q) {
    if (!q->moving) SL_TRY(create_moving(context, q));
    if (!q->boxes_placed) SL_TRY(sl_moving_set_boxes(context, q->moving, q->boxes, q->box_count));
    q->boxes_placed = true;
    sl_moving_set_range(q->moving, q->range);
    return SL_OK;
}

/// Whether the eye is on the line of one-way glass. What it sees then depends on the side that its
/// cell is on, which directed portals do not know.
static bool is_in_line_with_glass(const sl_query *q, sl_point eye) {
    const sl_map *map = &q->baked->map;
    for (size_t i = 0; i < map->oneway_count; i++)
        if (sli_orient(map->oneways[i].segment.a, map->oneways[i].segment.b, eye) == 0) return true;
    return false;
}

/// Boxes that hide nothing need no cut cells. Lists of boxes do not know mirrors, ranges and open
/// sight, nor an eye in line with glass.
static bool lists_will_do(const sl_query *q, sl_point eye) {
    return !q->any_blocks && !has_mirrors(q) && !(q->range > 0) && !q->baked->space.loose &&
           q->baked->visibility.sight == SL_CLOSED && !is_in_line_with_glass(q, eye);
}

static sl_status look_by_lists(sl_context *context, sl_query *q, const sl_view *view, bool *seen) {
    SL_TRY(make_search(context, q));
    if (!q->lists.first)
        SL_TRY(sli_box_lists_make(context, q->glass.space, q->boxes, q->box_count, &q->lists));
    uint64_t *cells = sl_alloc_array(context, sl_eye_words(q->glass.space), sizeof *cells);
    if (!cells) return SL_NO_MEMORY;
    const sl_status status = sli_eye_boxes_seen(context, q->search, &q->lists, view, cells, seen);
    sl_free(context, cells);
    return status;
}

/// The outline that sight goes by: with the boxes, if some of them block.
static sl_status make_outline(sl_context *context, sl_query *q, const sl_outline **out) {
    if (has_blocks(q)) {
        SL_TRY(make_moving(context, q));
        return sl_moving_outline(context, q->moving, out);
    }
    if (!q->outline) {
        sl_outline *outline = sl_alloc_array(context, 1, sizeof *outline);
        if (!outline) return SL_NO_MEMORY;
        const sl_status status = sl_outline_make(context, q->glass.space, outline);
        if (status != SL_OK) {
            sl_free(context, outline);
            return status;
        }
        q->outline = outline;
    }
    *out = q->outline;
    return SL_OK;
}

static sl_status make_mirrors(sl_context *context, sl_query *q, const sl_outline *outline) {
    if (q->mirrors && q->mirrors->outline == outline) return SL_OK;
    drop_mirrors(context, q);
    sl_room_mirrors *mirrors = sl_alloc_array(context, 1, sizeof *mirrors);
    if (!mirrors) return SL_NO_MEMORY;
    const sl_status status = sl_room_mirrors_make(context, outline, &q->baked->map, mirrors);
    if (status != SL_OK) {
        sl_free(context, mirrors);
        return status;
    }
    q->mirrors = mirrors;
    return SL_OK;
}

// --- questions

uint32_t sl_query_locate(const sl_query *query, sl_point point) {
    return sl_space_locate(&query->baked->space, point);
}

sl_status sl_query_can_see(sl_context *context, sl_query *query, uint32_t from, uint32_t to,
                           bool *out) {
    SL_TRY(make_doors(context, query));
    const sl_pvs *pvs = &query->doors.visibility->pvs;
    if (from >= pvs->cell_count || to >= pvs->cell_count)
        return sl_fail(context, SL_BAD_ARGUMENT, "there is no cell %u; cells are 0 to %u",
                       from >= pvs->cell_count ? from : to, pvs->cell_count - 1);
    *out = sl_pvs_sees(pvs, from, to);
    return SL_OK;
}

sl_status sl_query_sees(sl_context *context, sl_query *query, sl_point eye, sl_point point,
                        bool *out) {
    const sl_outline *outline;
    const sl_sight sight = query->baked->visibility.sight;
    bool sees;
    SL_TRY(make_layers(context, query));
    SL_TRY(make_outline(context, query, &outline));
    SL_TRY(sl_sees(context, outline, eye, point, sight, &sees));
    if (sees && query->range > 0)
        sees = sli_distance_compare(eye, point, query->range) < (sight == SL_CLOSED ? 1 : 0);
    *out = sees;
    return SL_OK;
}

sl_view sl_query_view(const sl_query *query, sl_point eye, double heading, double fov) {
    const sl_box b = query->baked->space.bounds;
    const double x = fmax(fabs(b.min.x), fabs(b.max.x)), y = fmax(fabs(b.min.y), fabs(b.max.y));
    const double reach = fmax(fmax(x, y), fmax(b.max.x - b.min.x, b.max.y - b.min.y));
    return sl_view_cone(eye, heading, fov, reach);
}

/// The last of the table.
static const sl_eye_method *exact_method(void) {
    size_t count;
    const sl_eye_method *methods = sl_eye_methods(&count);
    return &methods[count - 1];
}

/// The space for an eye in line with glass: glass that is dark for it is a wall, all other is open.
static sl_status make_space_in_line(sl_context *context, const sl_query *q, const sl_view *view,
                                    sl_space *out) {
    const sl_filtered_space filtered = {.eye = &view->eye};
    return sl_filtered_space_make(context, q->doors.space, &filtered, NULL, out);
}

static sl_status look_in_line(sl_context *context, sl_query *q, const sl_view *view,
                              const sl_eye_method *method, uint64_t *cells,
                              sl_eye_account *account) {
    sl_space space;
    sl_eye_search *search = NULL;
    SL_TRY(make_space_in_line(context, q, view, &space));
    sl_status status = sl_eye_search_create(context, &space, q->glass.visibility, &search);
    if (status == SL_OK) {
        sl_eye_search_set_range(search, q->range);
        status = method->cull(context, search, view, cells, account);
    }
    sl_eye_search_destroy(context, search);
    sl_space_destroy(context, &space);
    return status;
}

static sl_status look_past_in_line(sl_context *context, const sl_query *q, const sl_view *view,
                                   uint64_t *cells, bool *seen, sl_eye_account *account) {
    sl_space space;
    sl_moving *moving = NULL;
    SL_TRY(make_space_in_line(context, q, view, &space));
    sl_status status = sl_moving_create(context, &space, q->glass.visibility, &moving);
    if (status == SL_OK) status = sl_moving_set_boxes(context, moving, q->boxes, q->box_count);
    if (status == SL_OK) {
        sl_moving_set_range(moving, q->range);
        status = sl_moving_look(context, moving, view, cells, seen, account);
    }
    sl_moving_destroy(context, moving);
    sl_space_destroy(context, &space);
    return status;
}

/// What the exact method sees past the boxes. `seen` may be NULL.
static sl_status look_past(sl_context *context, sl_query *q, const sl_view *view, bool mirrored,
                           uint64_t *cells, bool *seen, sl_eye_account *account) {
    const bool in_line = !mirrored && is_in_line_with_glass(q, view->eye);
    if (!in_line) SL_TRY(make_moving(context, q));
    bool *all = seen ? seen : sl_alloc_array(context, q->box_count, sizeof *all);
    if (!all) return SL_NO_MEMORY;
    sl_status status;
    if (in_line)
        status = look_past_in_line(context, q, view, cells, all, account);
    else if (mirrored)
        status = sl_moving_look_mirrored(context, q->moving, view, cells, all, account);
    else
        status = sl_moving_look(context, q->moving, view, cells, all, account);
    if (!seen) sl_free(context, all);
    return status;
}

sl_status sl_query_look(sl_context *context, sl_query *query, const sl_view *view,
                        const sl_eye_method *method, uint64_t *cells, sl_eye_account *account) {
    if (!method) method = exact_method();
    SL_TRY(make_layers(context, query));
    if (has_blocks(query) && method == exact_method())
        return look_past(context, query, view, false, cells, NULL, account);
    if (is_in_line_with_glass(query, view->eye))
        return look_in_line(context, query, view, method, cells, account);
    SL_TRY(make_search(context, query));
    return method->cull(context, query->search, view, cells, account);
}

sl_status sl_query_look_mirrored(sl_context *context, sl_query *query, const sl_view *view,
                                 const sl_eye_method *method, uint64_t *cells,
                                 sl_eye_account *account) {
    if (!method) method = exact_method();
    if (!has_mirrors(query)) {
        memset(cells, 0, sl_eye_words(&query->baked->space) * sizeof *cells);
        if (account) *account = (sl_eye_account){0};
        return SL_OK;
    }
    if (!method->mirrored)
        return sl_fail(context, SL_UNSUPPORTED, "the method '%s' does not know mirrors",
                       method->name);
    SL_TRY(make_layers(context, query));
    if (has_blocks(query) && method == exact_method())
        return look_past(context, query, view, true, cells, NULL, account);
    SL_TRY(make_search(context, query));
    return method->mirrored(context, query->search, view, cells, account);
}

sl_status sl_query_boxes_seen(sl_context *context, sl_query *query, const sl_view *view, bool *seen,
                              bool *mirrored) {
    sl_eye_account account;
    SL_TRY(make_layers(context, query));
    if (!SLI_BOXES || !query->box_count) return SL_OK;
    if (mirrored) memset(mirrored, 0, query->box_count * sizeof *mirrored);
    if (lists_will_do(query, view->eye)) return look_by_lists(context, query, view, seen);
    uint64_t *cells = sl_alloc_array(context, sl_eye_words(query->glass.space), sizeof *cells);
    if (!cells) return SL_NO_MEMORY;
    sl_status status = look_past(context, query, view, false, cells, seen, &account);
    if (status == SL_OK && mirrored && has_mirrors(query))
        status = look_past(context, query, view, true, cells, mirrored, &account);
    sl_free(context, cells);
    return status;
}

sl_status sl_query_region(sl_context *context, sl_query *query, const sl_view *view,
                          sl_region *out) {
    const sl_outline *outline;
    SL_TRY(make_layers(context, query));
    SL_TRY(make_outline(context, query, &outline));
    return sl_region_make(context, outline, view, query->range, out);
}

sl_status sl_query_mirrored_region(sl_context *context, sl_query *query, const sl_view *view,
                                   sl_mirrored_region *out) {
    const sl_outline *outline;
    SL_TRY(make_layers(context, query));
    SL_TRY(make_outline(context, query, &outline));
    SL_TRY(make_mirrors(context, query, outline));
    return sl_mirrored_region_make(context, query->mirrors, view, query->range, query->mirror_depth,
                                   out);
}

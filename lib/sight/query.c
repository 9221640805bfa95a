/// A query puts what stands between a space and an eye in layers:
///
///     the space, its map and its visible sets
///       doors and one-way glass: changed in place (sight_space.h)
///         what answers: the search of cells, the outline of rooms, mirrors
///       boxes that block: of a region and of lines between points, compared with what is found
///       without them; for the rest a copy of the space, cut, whose glass then is one-way
///
/// Each is made where a question calls for it, and kept until a setting below it changes. A door
/// changes the cells and sides that it touches, and of the visible sets nothing: which pairs are
/// hidden is looked up with each row.
#include "sightline/query.h"

#include "cell_to_cell/pvs_rows.h"
#include "effects/filtered.h"
#include "geometry/crossing.h"
#include "sight/eye_search.h"
#include "sight/moving.h"
#include "sight/past_boxes.h"
#include "sight/query.h"
#include "sight/region.h"
#include "sight/sight_space.h"
#include "sightline/effects.h"
#include "sightline/support.h"
#include "space/index.h"

#include <math.h>
#include <string.h>

enum { MIRROR_DEPTH_MOST = 16 };

struct sl_query {
    const sl_space *asked;
    const sl_map *map;
    const sl_visibility *visibility; ///< the caller's; NULL for none
    sli_query_owner owner;
    const sl_outline *given; ///< of the space that is asked, where its owner keeps one
    bool *shut;              ///< by door of the map
    size_t shut_count;
    bool backwards;
    double range;
    uint32_t mirror_depth;
    sl_moving_box *boxes;
    size_t box_count;
    bool any_blocks;   ///< some box hides what is behind it
    bool boxes_placed; ///< in `moving`

    bool ready;            ///< `sight` is made
    bool settled;          ///< the boxes are checked, and `rows` are those of the settings
    sl_space turned;       ///< `asked` with its glass turned round; borrows the rest
    sli_sight_space sight; ///< doors and glass as they are
    sl_visibility rows;    ///< borrowed, without stab trees where the space has other portals

    // What answers; NULL where it is not made.
    sli_eye_search *search;
    sli_box_lists lists; ///< of the boxes; `first` NULL if not made
    sli_moving *moving;
    sl_space moving_ground;    ///< with walls in doors; empty where all are open
    sli_room_mirrors *mirrors; ///< of the outline that is looked at
};

// --- making and letting go

static void drop_mirrors(sl_context *context, sl_query *q) {
    if (q->mirrors) sli_room_mirrors_destroy(context, q->mirrors);
    sl_free(context, q->mirrors);
    q->mirrors = NULL;
}

/// Drops the space that boxes are cut into. Mirrors may be of its outline.
static void drop_moving(sl_context *context, sl_query *q) {
    if (!SLI_BOXES || !q->moving) return;
    drop_mirrors(context, q);
    sli_moving_destroy(context, q->moving);
    sl_space_destroy(context, &q->moving_ground);
    q->moving = NULL;
    q->boxes_placed = false;
}

static bool is_turned(const sl_query *q) {
    return q->backwards && q->map->oneway_count;
}

static bool has_mirrors(const sl_query *q) {
    return q->map->mirror_count && q->mirror_depth;
}

static void drop_search(sl_context *context, sl_query *q) {
    if (q->search) sli_eye_search_destroy(context, q->search);
    q->search = NULL;
}

static void drop_all(sl_context *context, sl_query *q) {
    drop_moving(context, q);
    drop_mirrors(context, q);
    drop_search(context, q);
    sli_sight_space_destroy(context, &q->sight);
    sl_free(context, q->turned.seams);
    sl_free(context, q->turned.seam_portals);
    q->turned = (sl_space){0};
    q->ready = q->settled = false;
}

void sl_query_destroy(sl_context *context, sl_query *query) {
    if (!query) return;
    drop_all(context, query);
    if (SLI_BOXES) sli_box_lists_destroy(context, &query->lists);
    if (query->owner.destroy) query->owner.destroy(context, query->owner.what);
    sl_free(context, query->shut);
    sl_free(context, query->boxes);
    sl_free(context, query);
}

sl_status sl_query_over(sl_context *context, const sl_space *space, const sl_map *map,
                        const sl_visibility *visibility, sl_query **out) {
    sl_query *q = sl_alloc_array(context, 1, sizeof *q);
    if (!q) return SL_NO_MEMORY;
    q->asked = space;
    q->map = map;
    q->visibility = visibility;
    q->range = map->range;
    q->mirror_depth = 1;
    q->shut = sl_alloc_array(context, map->door_count, sizeof *q->shut);
    if (!q->shut) {
        sl_query_destroy(context, q);
        return SL_NO_MEMORY;
    }
    for (size_t i = 0; i < map->door_count; i++) q->shut_count += q->shut[i] = !map->doors[i].open;
    *out = q;
    return SL_OK;
}

void sli_query_own(sl_query *query, sli_query_owner owner) {
    query->owner = owner;
}

void sli_query_space_changed(sl_context *context, sl_query *q, const sl_outline *outline) {
    const bool grown = q->ready && q->sight.space.cell_count != q->asked->cell_count;
    const bool rows = q->visibility && q->visibility->pvs.cell_count;
    q->given = outline;
    if (q->sight.own || q->map->oneway_count || is_turned(q)) {
        drop_all(context, q);
        return;
    }
    drop_moving(context, q);
    drop_mirrors(context, q);
    if (SLI_BOXES) sli_box_lists_destroy(context, &q->lists);
    if (grown || (q->search && (q->search->has_pvs != rows || q->search->limited ||
                                q->search->mirrors || outline->limited || has_mirrors(q))))
        drop_search(context, q);
    if (q->ready) q->sight.space = *q->asked;
    q->settled = false;
}

const sl_map *sl_query_map(const sl_query *query) {
    return query->map;
}

const sl_space *sl_query_asked(const sl_query *query) {
    return query->asked;
}

// --- settings

/// Visible sets of a map with a range know of nothing farther.
static sl_status check_range(sl_context *context, const sl_query *q,
                             const sl_visibility *visibility, double range) {
    const double known = visibility && visibility->pvs.cell_count ? q->map->range : 0;
    if (!(known > 0) || (range > 0 && range <= known)) return SL_OK;
    return sl_fail(context, SL_BAD_ARGUMENT,
                   "the map was baked with a view range of %.17g, and nothing farther is known: "
                   "ask for a range up to that, or bake the map --without range",
                   known);
}

sl_status sl_query_set_visibility(sl_context *context, sl_query *query,
                                  const sl_visibility *visibility) {
    SL_TRY(check_range(context, query, visibility, query->range));
    drop_search(context, query);
    drop_moving(context, query);
    query->visibility = visibility;
    query->settled = false;
    return SL_OK;
}

static sl_status fail_door(sl_context *context, const sl_map *map, const char *name) {
    char names[512] = "none";
    size_t length = 0;
    for (size_t i = 0; i < map->door_count && length < sizeof names; i++)
        length += (size_t)snprintf(names + length, sizeof names - length, "%s%.64s", i ? ", " : "",
                                   map->doors[i].name);
    return sl_fail(context, SL_BAD_ARGUMENT, "there is no door '%.64s'; the map's doors: %s", name,
                   names);
}

static void set_door(sl_context *context, sl_query *q, size_t door, bool shut) {
    if (q->shut[door] == shut) return;
    q->shut[door] = shut;
    q->settled = false;
    q->shut_count += shut ? 1 : (size_t)-1;
    if (q->ready) sli_sight_space_set_door(&q->sight, door, q->shut);
    drop_moving(context, q);
}

sl_status sl_query_set_door(sl_context *context, sl_query *query, const char *name, bool open) {
    const sl_map *map = query->map;
    bool found = false;
    for (size_t i = 0; i < map->door_count; i++) {
        if (strcmp(map->doors[i].name, name) != 0) continue;
        found = true;
        set_door(context, query, i, !open);
    }
    return found ? SL_OK : fail_door(context, map, name);
}

void sl_query_set_door_at(sl_context *context, sl_query *query, size_t door, bool open) {
    set_door(context, query, door, !open);
}

void sl_query_set_doors(sl_context *context, sl_query *query, bool open) {
    for (size_t i = 0; i < query->map->door_count; i++) set_door(context, query, i, !open);
}

bool sl_query_door_is_open(const sl_query *query, size_t door) {
    return !query->shut[door];
}

void sl_query_set_backwards(sl_context *context, sl_query *query, bool backwards) {
    if (backwards != query->backwards) drop_all(context, query);
    query->backwards = backwards;
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
    query->boxes_placed = query->settled = false;
    if (SLI_BOXES) sli_box_lists_destroy(context, &query->lists);
    sl_free(context, query->boxes);
    query->boxes = copy;
    query->box_count = count;
    query->any_blocks = false;
    for (size_t i = 0; i < count; i++) query->any_blocks |= copy[i].blocks;
    return SL_OK;
}

sl_status sl_query_set_range(sl_context *context, sl_query *query, double range) {
    if (!(range >= 0) || isinf(range))
        return sl_fail(context, SL_BAD_ARGUMENT,
                       "the range must be 0 or more, and finite; 0: no limit");
    SL_TRY(check_range(context, query, query->visibility, range));
    query->range = range;
    return SL_OK;
}

double sl_query_range(const sl_query *query) {
    return query->range;
}

sl_status sl_query_set_mirror_depth(sl_context *context, sl_query *query, uint32_t depth) {
    if (depth > MIRROR_DEPTH_MOST)
        return sl_fail(context, SL_BAD_ARGUMENT, "the mirror depth must be 0 to %d",
                       MIRROR_DEPTH_MOST);
    if (depth != query->mirror_depth) {
        drop_search(context, query);
        drop_moving(context, query);
    }
    query->mirror_depth = depth;
    return SL_OK;
}

// --- a copy

/// What a copy asks.
typedef struct copied_space {
    sl_space space;
    sl_map map;
} copied_space;

static void destroy_copied(sl_context *context, void *what) {
    copied_space *copied = what;
    sl_space_destroy(context, &copied->space);
    sl_map_destroy(context, &copied->map);
    sl_free(context, copied);
}

/// The numbers of a space that lives have gaps, which only what keeps them up knows.
static sl_status refuse_living(sl_context *context, const sl_query *q, const char *what) {
    if (!q->given) return SL_OK;
    return sl_fail(context, SL_UNSUPPORTED, "%s a world: ask a copy of it (sl_world_copy_space)",
                   what);
}

sl_status sl_query_copy(sl_context *context, const sl_query *query, sl_query **out) {
    SL_TRY(refuse_living(context, query, "no copies are made of a query to"));
    copied_space *copied = sl_alloc_array(context, 1, sizeof *copied);
    sl_query *q = NULL;
    if (!copied) return SL_NO_MEMORY;
    sl_status status = sl_map_copy(context, query->map, &copied->map);
    if (status == SL_OK)
        status = sli_filtered_space_make(context, query->asked, &(sli_filtered_space){0}, NULL,
                                         &copied->space);
    if (status == SL_OK) status = sl_query_over(context, &copied->space, &copied->map, NULL, &q);
    if (status != SL_OK) {
        destroy_copied(context, copied);
        return status;
    }
    sli_query_own(q, (sli_query_owner){copied, destroy_copied});
    for (size_t i = 0; i < q->map->door_count; i++) set_door(context, q, i, query->shut[i]);
    q->backwards = query->backwards;
    q->range = query->range;
    q->mirror_depth = query->mirror_depth;
    *out = q;
    return SL_OK;
}

// --- the layers

/// Makes `turned`: glass that is seen through from the other side.
static sl_status turn_glass(sl_context *context, sl_query *q) {
    const sl_space *from = q->asked;
    sl_space *to = &q->turned;
    *to = *from;
    to->seams = sl_alloc_array(context, from->seam_count, sizeof *to->seams);
    to->seam_portals = sl_alloc_array(context, from->seam_portal_count, sizeof *to->seam_portals);
    if (!to->seams || !to->seam_portals) return SL_NO_MEMORY;
    for (uint32_t i = 0; i < from->seam_count; i++) {
        const sl_segment at = from->seams[i].at;
        to->seams[i] = from->seams[i];
        if (from->seams[i].kind == SL_SEAM_ONEWAY) to->seams[i].at = (sl_segment){at.b, at.a};
    }
    for (uint32_t i = 0; i < from->seam_portal_count; i++) {
        to->seam_portals[i] = from->seam_portals[i];
        to->seam_portals[i].forward ^=
            from->seams[from->seam_portals[i].seam].kind == SL_SEAM_ONEWAY;
    }
    return SL_OK;
}

/// The visible sets say what is seen from a cell, and not from where it is seen.
static sl_visibility rows_of(const sl_query *q) {
    if (!q->visibility) return (sl_visibility){.sight = SL_CLOSED};
    return is_turned(q) ? (sl_visibility){.sight = q->visibility->sight} : *q->visibility;
}

static sl_status make_ready(sl_context *context, sl_query *q) {
    if (q->ready) return SL_OK;
    sl_status status = is_turned(q) ? turn_glass(context, q) : SL_OK;
    if (status == SL_OK)
        status = sli_sight_space_make(context, is_turned(q) ? &q->turned : q->asked, q->shut,
                                      q->map->door_count, &q->sight);
    q->ready = status == SL_OK;
    q->sight.given = q->given;
    if (!q->ready) drop_all(context, q);
    return status;
}

/// Changes nothing where all is as it was, so that several threads may ask.
static sl_status make_layers(sl_context *context, sl_query *q) {
    if (q->settled) return SL_OK;
    if (SLI_BOXES) SL_TRY(sli_boxes_check(context, q->boxes, q->box_count));
    SL_TRY(make_ready(context, q));
    q->rows = rows_of(q);
    // Stab trees are of a space with all its directed portals.
    if (q->shut_count || q->map->oneway_count) q->rows.trees = (sl_stab_trees){0};
    q->settled = true;
    return SL_OK;
}

/// The doors for visible sets.
static const bool *shut_of(const sl_query *q) {
    return q->shut_count ? q->shut : NULL;
}

/// Whether sight goes past boxes that hide what is behind them.
static bool has_blocks(const sl_query *q) {
    return SLI_BOXES && q->any_blocks;
}

// --- what answers

/// What is seen by mirror does not count limited walls.
static sl_status check_mirrors(sl_context *context, const sl_query *q) {
    return sli_refuse_limited(context, q->asked, "what an eye sees by mirror",
                              ", or leave the mirrors out (--without mirror)");
}

static sl_status make_search(sl_context *context, sl_query *q) {
    if (!q->search) {
        sli_eye_search *search;
        SL_TRY(sli_eye_search_create(context, &q->sight.space, &q->rows, &search));
        const sl_status status =
            has_mirrors(q) ? sli_eye_search_add_mirrors(context, search, q->map, q->mirror_depth)
                           : SL_OK;
        if (status != SL_OK) {
            sli_eye_search_destroy(context, search);
            return status;
        }
        q->search = search;
    }
    q->search->shut = shut_of(q);
    sli_eye_search_set_range(q->search, q->range);
    return SL_OK;
}

/// Boxes are cut into a space that lacks nothing: doors are walls in a copy, and glass is open both
/// ways until the boxes stand.
static sl_status create_moving(sl_context *context, sl_query *q) {
    const sli_filtered_space filtered = {.shut = q->shut};
    sli_moving *moving;
    if (q->shut_count)
        SL_TRY(sli_filtered_space_make(context, q->sight.base, &filtered, NULL, &q->moving_ground));
    sl_status status = sli_moving_create(context, q->shut_count ? &q->moving_ground : q->sight.base,
                                         &q->rows, &moving);
    if (status != SL_OK) {
        sl_space_destroy(context, &q->moving_ground);
        return status;
    }
    sli_moving_set_shut(moving, shut_of(q));
    status = q->map->oneway_count ? sli_moving_add_glass(context, moving) : SL_OK;
    if (status == SL_OK && has_mirrors(q))
        status = sli_moving_add_mirrors(context, moving, q->map, q->mirror_depth);
    q->moving = moving;
    if (status != SL_OK) drop_moving(context, q);
    return status;
}

static sl_status make_moving(sl_context *context, sl_query *q) {
    SL_TRY(refuse_living(context, q, "boxes are not cut into"));
    if (!q->moving) SL_TRY(create_moving(context, q));
    if (!q->boxes_placed) SL_TRY(sli_moving_set_boxes(context, q->moving, q->boxes, q->box_count));
    q->boxes_placed = true;
    sli_moving_set_range(q->moving, q->range);
    return SL_OK;
}

/// Whether the eye is on the line of one-way glass. What it sees then depends on the side that its
/// cell is on, which directed portals do not know.
static bool is_in_line_with_glass(const sl_query *q, sl_point eye) {
    const sl_map *map = q->map;
    for (size_t i = 0; i < map->oneway_count; i++)
        if (sli_orient(map->oneways[i].segment.a, map->oneways[i].segment.b, eye) == 0) return true;
    return false;
}

/// Boxes that hide nothing need no cut cells. Lists of boxes do not know mirrors, ranges and open
/// sight, nor an eye in line with glass.
static bool lists_will_do(const sl_query *q, sl_point eye) {
    return !q->any_blocks && !has_mirrors(q) && !(q->range > 0) && !q->asked->loose &&
           q->rows.sight == SL_CLOSED && !is_in_line_with_glass(q, eye);
}

static sl_status look_by_lists(sl_context *context, sl_query *q, const sl_view *view, bool *seen) {
    SL_TRY(make_search(context, q));
    if (!q->lists.first)
        SL_TRY(sli_box_lists_make(context, &q->sight.space, q->boxes, q->box_count, &q->lists));
    uint64_t *cells = sl_alloc_array(context, sl_eye_words(q->asked), sizeof *cells);
    if (!cells) return SL_NO_MEMORY;
    const sl_status status = sli_eye_boxes_seen(context, q->search, &q->lists, view, cells, seen);
    sl_free(context, cells);
    return status;
}

/// The outline without boxes. Those that block must be such as can be cut in.
static sl_status make_bare_outline(sl_context *context, sl_query *q, const sl_outline **out) {
    if (has_blocks(q) && q->asked->loose) SL_TRY(make_moving(context, q));
    return sli_sight_space_outline(context, &q->sight, out);
}

/// The outline that sight goes by: with the boxes, if some of them block.
static sl_status make_outline(sl_context *context, sl_query *q, const sl_outline **out) {
    if (has_blocks(q)) {
        SL_TRY(make_moving(context, q));
        return sli_moving_outline(context, q->moving, out);
    }
    return sli_sight_space_outline(context, &q->sight, out);
}

static sl_status make_mirrors(sl_context *context, sl_query *q, const sl_outline *outline) {
    if (q->mirrors && q->mirrors->outline == outline) return SL_OK;
    drop_mirrors(context, q);
    sli_room_mirrors *mirrors = sl_alloc_array(context, 1, sizeof *mirrors);
    if (!mirrors) return SL_NO_MEMORY;
    const sl_status status = sli_room_mirrors_make(context, outline, q->map, mirrors);
    if (status != SL_OK) {
        sl_free(context, mirrors);
        return status;
    }
    q->mirrors = mirrors;
    return SL_OK;
}

// --- questions

uint32_t sl_query_locate(const sl_query *query, sl_point point) {
    return sl_space_locate(query->asked, point);
}

/// What a row of the visible sets, or of what is seen by mirror, says with doors as they are.
static bool row_holds(const sl_query *q, const sl_pvs *pvs, const sl_door_sets *doors,
                      uint32_t from, uint32_t to) {
    return sl_pvs_sees(pvs, from, to) &&
           (!q->shut_count || !doors->cell_count || sli_door_sets_open(doors, from, to, q->shut));
}

static sl_status check_rows(sl_context *context, const sl_query *q, uint32_t from, uint32_t to) {
    const uint32_t count = q->asked->cell_count;
    if (!q->visibility || !q->visibility->pvs.cell_count)
        return sl_fail(context, SL_BAD_ARGUMENT, "there are no visible sets: bake the map");
    if (from >= count || to >= count)
        return sl_fail(context, SL_BAD_ARGUMENT, "there is no cell %u; cells are 0 to %u",
                       from >= count ? from : to, count - 1);
    return SL_OK;
}

sl_status sl_query_can_see(sl_context *context, sl_query *query, uint32_t from, uint32_t to,
                           bool *out) {
    const sl_visibility *v = query->visibility;
    SL_TRY(check_rows(context, query, from, to));
    *out = query->backwards ? row_holds(query, &v->pvs, &v->doors, to, from)
                            : row_holds(query, &v->pvs, &v->doors, from, to);
    return SL_OK;
}

sl_status sl_query_row(sl_context *context, sl_query *query, uint32_t cell, bool mirrored,
                       uint64_t *cells) {
    const sl_visibility *v = query->visibility;
    SL_TRY(check_rows(context, query, cell, cell));
    const sl_pvs *pvs = mirrored ? &v->mirrored : &v->pvs;
    const sl_door_sets *doors = mirrored ? &v->mirrored_doors : &v->doors;
    if (mirrored && has_mirrors(query))
        SL_TRY(refuse_living(context, query, "no sets by mirror are kept of"));
    memset(cells, 0, sl_eye_words(query->asked) * sizeof *cells);
    if (!pvs->cell_count) return SL_OK;
    if (!query->backwards) sli_row_add_open_to(pvs, doors, cell, shut_of(query), cells);
    for (uint32_t from = 0; query->backwards && from < pvs->cell_count; from++)
        if (row_holds(query, pvs, doors, from, cell)) sl_bits_add(cells, from);
    return SL_OK;
}

sl_status sl_query_space(sl_context *context, sl_query *query, const sl_space **space,
                         const uint32_t **parents) {
    SL_TRY(make_layers(context, query));
    if (parents) *parents = NULL;
    *space = &query->sight.space;
    if (!has_blocks(query)) return SL_OK;
    SL_TRY(make_moving(context, query));
    *space = sli_moving_space(query->moving, parents);
    return SL_OK;
}

sl_status sl_query_copy_space(sl_context *context, sl_query *query, sl_point eye, sl_space *out) {
    SL_TRY(refuse_living(context, query, "no copies are made of the space of"));
    SL_TRY(make_ready(context, query));
    const sli_filtered_space filtered = {.shut = query->shut, .eye = &eye};
    return sli_filtered_space_make(context, query->sight.base, &filtered, NULL, out);
}

sl_status sl_query_outline(sl_context *context, sl_query *query, const sl_outline **out) {
    SL_TRY(make_layers(context, query));
    return make_outline(context, query, out);
}

sl_status sl_query_prepare(sl_context *context, sl_query *query) {
    const sl_outline *outline;
    SL_TRY(sl_query_outline(context, query, &outline));
    return query->map->mirror_count ? make_mirrors(context, query, outline) : SL_OK;
}

/// What boxes do to the line between two points. Where it only touches some, the cut space knows.
static sli_between between(const sl_query *q, sl_point eye, sl_point point) {
    if (!has_blocks(q)) return SLI_CLEAR;
    const sli_between by_boxes = sli_boxes_between(q->boxes, q->box_count, eye, point);
    return by_boxes == SLI_TOUCHED && q->rows.sight == SL_OPEN ? SLI_HIDDEN : by_boxes;
}

sl_status sl_query_sees(sl_context *context, sl_query *query, sl_point eye, sl_point point,
                        bool *out) {
    const sl_outline *outline;
    bool sees = false;
    SL_TRY(make_layers(context, query));
    const sl_sight sight = query->rows.sight;
    const sli_between by_boxes = between(query, eye, point);
    SL_TRY(by_boxes == SLI_TOUCHED ? make_outline(context, query, &outline)
                                   : make_bare_outline(context, query, &outline));
    if (by_boxes != SLI_HIDDEN) SL_TRY(sli_sees(context, outline, eye, point, sight, &sees));
    if (sees && query->range > 0)
        sees = sli_distance_compare(eye, point, query->range) < (sight == SL_CLOSED ? 1 : 0);
    *out = sees;
    return SL_OK;
}

sl_status sl_query_cast(sl_context *context, sl_query *query, sl_point eye, sl_point through,
                        sl_hit *out) {
    const sl_outline *outline;
    SL_TRY(sl_query_outline(context, query, &outline));
    return sli_ray_cast(context, outline, eye, through, out);
}

sl_view sl_query_view(const sl_query *query, sl_point eye, double heading, double fov) {
    const sl_box b = query->asked->bounds;
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

static sl_status look_in_line(sl_context *context, sl_query *q, const sl_view *view,
                              const sl_eye_method *method, uint64_t *cells,
                              sl_eye_account *account) {
    sl_space space;
    sli_eye_search *search = NULL;
    SL_TRY(sl_query_copy_space(context, q, view->eye, &space));
    sl_status status = sli_eye_search_create(context, &space, &q->rows, &search);
    if (status == SL_OK) {
        search->shut = shut_of(q);
        search->in_line = true;
        sli_eye_search_set_range(search, q->range);
        status = method->cull(context, search, view, cells, account);
    }
    sli_eye_search_destroy(context, search);
    sl_space_destroy(context, &space);
    return status;
}

static sl_status look_past_in_line(sl_context *context, sl_query *q, const sl_view *view,
                                   uint64_t *cells, bool *seen, sl_eye_account *account) {
    sl_space space;
    sli_moving *moving = NULL;
    SL_TRY(sl_query_copy_space(context, q, view->eye, &space));
    sl_status status = sli_moving_create(context, &space, &q->rows, &moving);
    if (status == SL_OK) status = sli_moving_set_boxes(context, moving, q->boxes, q->box_count);
    if (status == SL_OK) {
        sli_moving_set_shut(moving, shut_of(q));
        sli_moving_set_in_line(moving);
        sli_moving_set_range(moving, q->range);
        status = sli_moving_look(context, moving, view, cells, seen, account);
    }
    sli_moving_destroy(context, moving);
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
        status = sli_moving_look_mirrored(context, q->moving, view, cells, all, account);
    else
        status = sli_moving_look(context, q->moving, view, cells, all, account);
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

/// Whether some point of a cell is in range. The nearest one is on a side that faces the eye, or is
/// the eye.
static bool is_in_range(const sl_space *space, const sl_cell *cell, sl_point eye, double range) {
    const sl_point *corners = space->vertices + cell->first_vertex;
    bool inside = true;
    for (uint32_t i = 0; i < cell->vertex_count; i++) {
        const sl_point a = corners[i], b = corners[i + 1 < cell->vertex_count ? i + 1 : 0];
        if (sli_orient(a, b, eye) >= 0) continue;
        const sli_glance glance = {.eye.at = eye, .from.at = b, .to.at = a, .right = b, .left = a};
        if (sli_nearest_compare(&glance, range) <= 0) return true;
        inside = false;
    }
    return inside;
}

void sl_query_drop_far(const sl_query *query, sl_point eye, uint64_t *cells) {
    const sl_space *space = query->asked;
    for (uint32_t c = 0; query->range > 0 && c < space->cell_count; c++)
        if (sl_eye_sees(cells, c) && !is_in_range(space, &space->cells[c], eye, query->range))
            cells[c / 64] &= ~((uint64_t)1 << c % 64);
}

sl_status sl_query_look_mirrored(sl_context *context, sl_query *query, const sl_view *view,
                                 const sl_eye_method *method, uint64_t *cells,
                                 sl_eye_account *account) {
    if (!method) method = exact_method();
    if (!has_mirrors(query)) {
        memset(cells, 0, sl_eye_words(query->asked) * sizeof *cells);
        if (account) *account = (sl_eye_account){0};
        return SL_OK;
    }
    if (!method->mirrored)
        return sl_fail(context, SL_UNSUPPORTED, "the method '%s' does not know mirrors",
                       method->name);
    SL_TRY(method == exact_method()
               ? check_mirrors(context, query)
               : refuse_living(context, query, "no sets by mirror are kept of"));
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
    if (mirrored && has_mirrors(query)) SL_TRY(check_mirrors(context, query));
    if (lists_will_do(query, view->eye))
        return seen ? look_by_lists(context, query, view, seen) : SL_OK;
    uint64_t *cells = sl_alloc_array(context, sl_eye_words(query->asked), sizeof *cells);
    if (!cells) return SL_NO_MEMORY;
    sl_status status = seen ? look_past(context, query, view, false, cells, seen, &account) : SL_OK;
    if (status == SL_OK && mirrored && has_mirrors(query))
        status = look_past(context, query, view, true, cells, mirrored, &account);
    sl_free(context, cells);
    return status;
}

sl_status sl_query_region(sl_context *context, sl_query *query, const sl_view *view,
                          sl_region *out) {
    const sl_outline *outline;
    SL_TRY(make_layers(context, query));
    const bool blocks = has_blocks(query);
    if (blocks && sli_boxes_touch(query->boxes, query->box_count, view->eye)) {
        SL_TRY(make_outline(context, query, &outline));
        return sli_region_make(context, outline, view, query->range, out);
    }
    SL_TRY(make_bare_outline(context, query, &outline));
    return sli_region_make_past(context, outline, query->boxes, blocks ? query->box_count : 0, view,
                                query->range, out);
}

sl_status sl_query_mirrored_region_to(sl_context *context, sl_query *query, const sl_view *view,
                                      uint32_t depth, sl_mirrored_region *out) {
    const sl_outline *outline;
    if (query->map->mirror_count && depth) SL_TRY(check_mirrors(context, query));
    SL_TRY(sl_query_outline(context, query, &outline));
    SL_TRY(make_mirrors(context, query, outline));
    return sli_mirrored_region_make(context, query->mirrors, view, query->range, depth, out);
}

sl_status sl_query_mirrored_region(sl_context *context, sl_query *query, const sl_view *view,
                                   sl_mirrored_region *out) {
    return sl_query_mirrored_region_to(context, query, view, query->mirror_depth, out);
}

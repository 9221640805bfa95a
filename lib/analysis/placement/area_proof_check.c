/// The check of placements among given places (place_proof.h), by other code than that which found
/// them. It trusts the map, and the places and the area that are asked about; nothing of the claim.
///
/// Lower bound: who sees a witness is asked of an eye at each place (proof_sight.h). Witnesses are
/// where as many places as they demand see all around them, or all of a sector there
/// (area_proof_sector.c). So whoever sees all that the places can see, sees them. The set cover
/// that comes of it is bounded in whole numbers (sl_cover_check).
///
/// Upper bound: as in proof_check.c, each corner of the arrangement is looked at in all directions.
/// What chosen places leave falls into faces of the arrangement. Borders of cells count as lines,
/// so in each cell a face lies in the box of its corners. If a place sees some of what is left,
/// then the lowest point of this part is a corner: of that arrangement, or with lines of the place.
/// So these are looked at for each place, within the boxes.
#include "analysis/placement/area_proof.h"
#include "analysis/placement/nearby.h"
#include "analysis/placement/proof_outline.h"
#include "analysis/placement/proof_view.h"
#include "geometry/orient.h"

/// What is left in a cell beside a corner.
typedef struct left_over {
    sli_meet p;
    uint32_t cell;
} left_over;

typedef struct checker {
    sl_context *context;
    sl_query *query;
    const sl_space *space;
    const sl_place_area *area;
    const sl_area_placement *claim;
    sl_place_area_verdict *out;
    int digits; ///< of coordinates in messages
    uint32_t cover;
    bool *chosen, *fixed; ///< by place
    sli_proof_scene scene;
    // What the chosen places see.
    sli_eye *eyes;
    sli_proof_view *views;
    uint32_t view_count;
    sli_ray_parts parts, near; ///< near: those that are where something is left
    sl_box *cell_boxes;
    sli_directions around;
    SL_ARRAY(left_over) left;
    sl_box *left_boxes; ///< by cell, of what is left there
    bool *has_left;
    // One place after the other.
    const sli_proof_view *other; ///< NULL while the chosen ones are looked at
    sli_ray_parts own;
    bool *sees; ///< by witness: the eye does
    uint32_t *sure,
        *held; ///< by witness: places that see all around it, and fixed ones that see it
    SL_ARRAY(size_t) ends;
    SL_ARRAY(uint32_t) entries;
} checker;

// --- the area

static sl_status add_line(checker *c, sl_point a, sl_point b, sli_part_kind kind) {
    return sli_ray_add(c->context, sli_ray_between(a, b, UINT32_MAX, kind), &c->parts);
}

/// Borders of cells, walls, and the outline of what is to be seen.
static sl_status add_lines(checker *c) {
    const sl_space *s = c->space;
    const sl_box *b = &s->bounds;
    const sl_point box[] = {b->min, {b->max.x, b->min.y}, b->max, {b->min.x, b->max.y}};
    for (uint32_t i = 0; i < s->portal_count; i++)
        SL_TRY(add_line(c, s->portals[i].left, s->portals[i].right, SLI_PART_BORDER));
    for (int i = 0; i < 4; i++) SL_TRY(add_line(c, box[i], box[(i + 1) % 4], SLI_PART_BORDER));
    for (uint32_t i = 0; i < c->scene.wall_count; i++)
        SL_TRY(add_line(c, c->scene.walls[i].a, c->scene.walls[i].b, SLI_PART_WALL));
    return sli_outline_add_parts(c->context, c->area->see, UINT32_MAX - 1, &c->parts);
}

// --- corners

static sl_status find_directions(checker *c, uint32_t cell, const sli_meet *p) {
    c->around.count = 0;
    SL_TRY(sli_directions_add_cell(c->context, c->space, cell, p, &c->around));
    for (uint32_t i = 0; i < c->view_count; i++)
        SL_TRY(sli_proof_view_add_directions(c->context, &c->scene, &c->views[i], p, &c->around));
    if (c->other)
        SL_TRY(sli_proof_view_add_directions(c->context, &c->scene, c->other, p, &c->around));
    SL_TRY(sli_outline_add_directions(c->context, c->area->see, p, &c->around));
    if (!c->around.count)
        SL_TRY(
            sli_directions_add(c->context, c->scene.bounds.min, c->scene.bounds.max, &c->around));
    sli_directions_sort(&c->around);
    return SL_OK;
}

/// Whether chosen places leave a sector that is to be seen.
static bool is_left(const checker *c, const sl_cell *k, const sli_meet *p,
                    const sli_direction *sector) {
    uint32_t seen = 0;
    const sl_point *corners = c->space->vertices + k->first_vertex;
    if (!sli_polygon_has_sector(corners, k->vertex_count, p, sector) ||
        !sli_outline_has_sector(&c->scene, c->area->see, p, sector))
        return false;
    for (uint32_t i = 0; i < c->view_count && seen < c->cover; i++)
        seen += sli_proof_view_sees_sector(&c->scene, &c->views[i], p, sector);
    return seen < c->cover;
}

static sl_status note_left(checker *c, uint32_t cell, const sli_meet *p) {
    SL_TRY(SL_ARRAY_ROOM(c->context, &c->left, 1));
    c->left.items[c->left.count++] = (left_over){*p, cell};
    if (!c->has_left[cell]) c->left_boxes[cell] = (sl_box){p->at, p->at};
    c->has_left[cell] = true;
    sli_box_widen(&c->left_boxes[cell], p);
    c->out->sees_all = false;
    return SL_OK;
}

/// Looks in all directions around a corner of a cell: notes what is left; or, for another place,
/// what it sees of that.
static sl_status look_around(checker *c, uint32_t cell, const sli_meet *p) {
    const sl_cell *k = &c->space->cells[cell];
    SL_TRY(find_directions(c, cell, p));
    for (size_t i = 0; i < c->around.count; i++) {
        const sli_direction sector[] = {c->around.items[i],
                                        c->around.items[(i + 1) % c->around.count]};
        if (c->other && !sli_proof_view_sees_sector(&c->scene, c->other, p, sector)) continue;
        if (!is_left(c, k, p, sector)) continue;
        if (!c->other) return note_left(c, cell, p);
        c->out->sees_as_all = false;
        c->out->unseen = p->at;
        return SL_OK;
    }
    return SL_OK;
}

static bool may_be_left(const checker *c, uint32_t cell, const sli_meet *p) {
    return !c->other || (c->has_left[cell] && sli_box_may_hold(&c->left_boxes[cell], p));
}

static sl_status visit(void *data, const sli_meet *p, int32_t wall, uint32_t group) {
    checker *c = data;
    uint32_t seen = 0;
    (void)wall;
    (void)group;
    if (!c->out->sees_as_all) return SL_OK;
    c->out->corners++;
    for (uint32_t i = 0; i < c->view_count && seen < c->cover; i++)
        seen += sli_proof_view_sees_around(&c->scene, &c->views[i], p);
    for (uint32_t k = 0; k < c->space->cell_count && seen < c->cover; k++)
        if (may_be_left(c, k, p) && sli_cell_has_meet(c->space, k, &c->cell_boxes[k], p))
            SL_TRY(look_around(c, k, p));
    return SL_OK;
}

static sl_status visit_point(checker *c, sl_point at) {
    const sli_meet p = sli_meet_point(at);
    return visit(c, &p, SLI_NO_WALL, 0);
}

/// The corners of polygons. Edges of one polygon that follow each other meet there.
static sl_status visit_edges(checker *c, const sli_ray_parts *parts) {
    for (size_t i = 0; i < parts->count; i++) {
        if (parts->items[i].kind != SLI_PART_EDGE) continue;
        SL_TRY(visit_point(c, parts->items[i].from));
        SL_TRY(visit(c, &parts->items[i].to, SLI_NO_WALL, 0));
    }
    return SL_OK;
}

static sl_status check_chosen(checker *c) {
    const sl_space *s = c->space;
    SL_TRY(add_lines(c));
    for (uint32_t i = 0; i < c->view_count; i++)
        SL_TRY(sli_proof_view_add_parts(c->context, &c->scene, &c->views[i], i, &c->parts));
    for (uint32_t k = 0; k < s->cell_count; k++)
        for (uint32_t i = 0; s->cells[k].inside && i < s->cells[k].vertex_count; i++)
            SL_TRY(visit_point(c, s->vertices[s->cells[k].first_vertex + i]));
    for (uint32_t i = 0; i < c->scene.corner_count; i++)
        SL_TRY(visit_point(c, c->scene.corners[i].at));
    for (uint32_t i = 0; i < c->view_count; i++) SL_TRY(visit_point(c, c->views[i].eye->at));
    SL_TRY(visit_edges(c, &c->parts));
    return sli_rays_visit(c->context, &c->scene, &c->parts, visit, c);
}

// --- what the other places see of the rest

/// Whether something is left in a box.
static bool is_near(const checker *c, const sl_box *box) {
    for (uint32_t k = 0; k < c->space->cell_count; k++)
        if (c->has_left[k] && sli_boxes_meet(box, &c->left_boxes[k])) return true;
    return false;
}

static sl_status find_near(checker *c) {
    for (size_t i = 0; i < c->parts.count; i++)
        if (is_near(c, &c->parts.items[i].box))
            SL_TRY(sli_ray_add(c->context, c->parts.items[i], &c->near));
    return SL_OK;
}

/// Ends of a part, and its crossings with those of the chosen places and the lines.
static sl_status check_part(checker *c, const sli_ray_part *part) {
    sli_meet p;
    if (!is_near(c, &part->box)) return SL_OK;
    SL_TRY(visit(c, &part->to, SLI_NO_WALL, 0));
    SL_TRY(visit_point(c, part->from));
    for (size_t i = 0; i < c->near.count; i++) {
        const sli_ray_part *s = &c->near.items[i];
        if (s->box.min.x > part->box.max.x) break;
        if (s->box.max.x >= part->box.min.x && sli_rays_cross(&c->scene, part, s, &p))
            SL_TRY(visit(c, &p, SLI_NO_WALL, 0));
    }
    return SL_OK;
}

/// Its own rays and edges cross each other, too.
static sl_status check_own(checker *c) {
    sli_meet p;
    for (size_t i = 0; i < c->own.count; i++) {
        const sli_ray_part *r = &c->own.items[i];
        SL_TRY(check_part(c, r));
        for (size_t k = 0; k < i && r->kind == SLI_PART_EDGE; k++)
            if (sli_rays_cross(&c->scene, r, &c->own.items[k], &p))
                SL_TRY(visit(c, &p, SLI_NO_WALL, 0));
    }
    return SL_OK;
}

static sl_status check_other(checker *c, uint32_t place, const sli_eye *eye, sl_box box) {
    sli_proof_view view;
    if (!is_near(c, &box)) return SL_OK;
    SL_TRY(sli_proof_view_make(c->context, c->query, &c->area->places[place], eye, box,
                               SLI_VIEW_LESS, &view));
    sl_status status = SL_OK;
    if (is_near(c, &view.box)) {
        c->other = &view;
        c->own.count = 0;
        for (size_t i = 0; status == SL_OK && i < c->left.count && c->out->sees_as_all; i++)
            if (sli_box_may_hold(&view.box, &c->left.items[i].p))
                status = look_around(c, c->left.items[i].cell, &c->left.items[i].p);
        if (status == SL_OK) status = visit_point(c, eye->at);
        if (status == SL_OK)
            status = sli_proof_view_add_parts(c->context, &c->scene, &view, c->view_count, &c->own);
        if (status == SL_OK) status = check_own(c);
        if (!c->out->sees_as_all) c->out->place = place;
        c->other = NULL;
    }
    sli_proof_view_destroy(c->context, &view);
    return status;
}

// --- the lower bound

static sl_status ask_eye(checker *c, const sli_eye *eye, bool *around) {
    const uint32_t rows = c->claim->proof.row_count;
    SL_TRY(sl_check_cancelled(c->context));
    for (uint32_t w = 0; w < rows; w++) {
        const sli_meet p = sli_meet_point(c->claim->witnesses[w]);
        c->sees[w] = sli_eye_sees(&c->scene, eye, &p);
        around[w] = c->sees[w] && sli_eye_sees_around(&c->scene, eye, &p);
    }
    return SL_OK;
}

/// The column of a place. Fixed ones have none: they are taken.
static sl_status add_column(checker *c, uint32_t place, const sli_eye *eye, const bool *around) {
    const uint32_t rows = c->claim->proof.row_count;
    sli_proof_view view;
    SL_TRY(sli_proof_view_make(c->context, c->query, &c->area->places[place], eye, (sl_box){0},
                               SLI_VIEW_BARE, &view));
    SL_TRY(SL_ARRAY_ROOM(c->context, &c->entries, rows));
    for (uint32_t w = 0; w < rows; w++) {
        const sl_point at = c->claim->witnesses[w];
        if (!c->sees[w] || !sli_proof_view_holds(&view, at, false)) continue;
        if (c->fixed[place])
            c->held[w]++;
        else
            c->entries.items[c->entries.count++] = w;
        c->sure[w] += around[w] && sli_proof_view_holds(&view, at, true);
    }
    SL_TRY(SL_ARRAY_ROOM(c->context, &c->ends, 1));
    c->ends.items[c->ends.count++] = c->entries.count;
    return SL_OK;
}

/// All places, those at one point together.
static sl_status check_places(checker *c) {
    const sl_place_area *t = c->area;
    bool *around = sl_alloc_array(c->context, c->claim->proof.row_count, sizeof *around), on_wall;
    sl_status status = around ? SL_OK : SL_NO_MEMORY;
    for (uint32_t i = 0; status == SL_OK && i < t->place_count;) {
        const sl_point at = t->places[i].at;
        sli_eye eye = {0};
        sl_report(c->context, "place", "places", i, t->place_count);
        status = sli_eye_make(c->context, &c->scene, at, &eye, &on_wall);
        if (status == SL_OK) status = ask_eye(c, &eye, around);
        const sl_box box = status == SL_OK ? sli_box_of_eye(&c->scene, &eye) : (sl_box){0};
        for (; status == SL_OK && i < t->place_count && sli_same_point(t->places[i].at, at); i++) {
            status = add_column(c, i, &eye, around);
            if (status == SL_OK && !c->out->sees_all && c->out->sees_as_all && !c->chosen[i])
                status = check_other(c, i, &eye, box);
        }
        sli_eye_destroy(c->context, &eye);
    }
    sl_free(c->context, around);
    return status;
}

/// At least how many places see one sector at a witness, of those in its row and the fixed ones.
static sl_status find_sector(checker *c, uint32_t witness, uint32_t *most) {
    uint32_t *which = sl_alloc_array(c->context, c->area->place_count, sizeof *which), count = 0;
    if (!which) return SL_NO_MEMORY;
    for (uint32_t i = 0; i < c->area->place_count; i++) {
        bool sees = c->fixed[i];
        for (size_t k = i ? c->ends.items[i - 1] : 0; k < c->ends.items[i] && !sees; k++)
            sees = c->entries.items[k] == witness;
        if (sees) which[count++] = i;
    }
    const sl_status status =
        sli_area_proof_sector(c->context, c->query, &c->scene, c->area->places, which, count,
                              c->claim->witnesses[witness], most);
    sl_free(c->context, which);
    return status;
}

static sl_status check_lower(checker *c) {
    const sl_area_placement *claim = c->claim;
    uint64_t fixed = 0, rest = 0;
    for (uint32_t w = 0; w < claim->proof.row_count; w++) {
        const uint32_t demand = claim->columns.demands[w];
        if (!demand) continue;
        const uint64_t least = (uint64_t)demand + c->held[w];
        if (c->sure[w] < least && least <= c->cover) SL_TRY(find_sector(c, w, &c->sure[w]));
        if (least <= c->sure[w] && least <= c->cover &&
            sli_outline_holds(&c->scene, c->area->see, claim->witnesses[w]))
            continue;
        c->out->weak = w;
        return SL_OK;
    }
    const sl_cover_problem problem = {.row_count = claim->proof.row_count,
                                      .column_count = c->area->place_count,
                                      .ends = c->ends.items,
                                      .entries = c->entries.items,
                                      .costs = c->area->costs,
                                      .demands = claim->columns.demands};
    SL_TRY(sl_cover_check(c->context, &problem, &claim->proof, &rest));
    for (uint32_t i = 0; i < c->area->fixed_count; i++)
        fixed += c->area->costs ? c->area->costs[c->area->fixed[i]] : 1;
    c->out->lower = rest || !claim->proof.row_count ? fixed + rest : 0;
    return SL_OK;
}

// --- both

static sl_status check_claim(checker *c) {
    const sl_place_area *t = c->area;
    const sl_area_placement *claim = c->claim;
    for (uint32_t i = 0; i < claim->count; i++) {
        if (claim->chosen[i] >= t->place_count || c->chosen[claim->chosen[i]])
            return sl_fail(c->context, SL_BAD_ARGUMENT,
                           "chosen place %u is none of the %u, or is chosen twice", i + 1,
                           t->place_count);
        c->chosen[claim->chosen[i]] = true;
        c->out->upper += t->costs ? t->costs[claim->chosen[i]] : 1;
    }
    for (uint32_t i = 0; i < t->fixed_count; i++) {
        if (t->fixed[i] >= t->place_count || c->fixed[t->fixed[i]])
            return sl_fail(c->context, SL_BAD_ARGUMENT, "a fixed place is none, or is named twice");
        c->fixed[t->fixed[i]] = true;
        if (!c->chosen[t->fixed[i]])
            return sl_fail(c->context, SL_BAD_ARGUMENT, "a fixed place is not chosen");
    }
    for (uint32_t w = 0; w < claim->proof.row_count; w++) {
        const sl_point at = claim->witnesses[w];
        if (!sl_space_is_inside(c->space, at))
            return sl_fail(c->context, SL_BAD_ARGUMENT, "witness %u at (%.*g, %.*g) is not inside",
                           w + 1, c->digits, at.x, c->digits, at.y);
    }
    return SL_OK;
}

static sl_status make(checker *c, const sl_map *map) {
    const uint32_t places = c->area->place_count, rows = c->claim->proof.row_count;
    const sl_space *s = c->space;
    SL_TRY(sli_proof_scene_make(c->context, s, map, &c->scene));
    c->chosen = sl_alloc_array(c->context, places, sizeof *c->chosen);
    c->fixed = sl_alloc_array(c->context, places, sizeof *c->fixed);
    c->eyes = sl_alloc_array(c->context, c->claim->count, sizeof *c->eyes);
    c->views = sl_alloc_array(c->context, c->claim->count, sizeof *c->views);
    c->cell_boxes = sl_alloc_array(c->context, s->cell_count, sizeof *c->cell_boxes);
    c->left_boxes = sl_alloc_array(c->context, s->cell_count, sizeof *c->left_boxes);
    c->has_left = sl_alloc_array(c->context, s->cell_count, sizeof *c->has_left);
    c->sees = sl_alloc_array(c->context, rows, sizeof *c->sees);
    c->sure = sl_alloc_array(c->context, rows, sizeof *c->sure);
    c->held = sl_alloc_array(c->context, rows, sizeof *c->held);
    if (!c->chosen || !c->fixed || !c->eyes || !c->views || !c->cell_boxes || !c->left_boxes ||
        !c->has_left || !c->sees || !c->sure || !c->held)
        return SL_NO_MEMORY;
    for (uint32_t k = 0; k < s->cell_count; k++) c->cell_boxes[k] = sli_box_of_cell(s, k);
    return SL_OK;
}

static sl_status make_views(checker *c) {
    bool on_wall;
    for (uint32_t i = 0; i < c->claim->count; i++) {
        const sl_viewpoint *v = &c->area->places[c->claim->chosen[i]];
        SL_TRY(sli_eye_make(c->context, &c->scene, v->at, &c->eyes[i], &on_wall));
        SL_TRY(sli_proof_view_make(c->context, c->query, v, &c->eyes[i],
                                   sli_box_of_eye(&c->scene, &c->eyes[i]), SLI_VIEW_WHOLE,
                                   &c->views[i]));
        c->view_count++;
    }
    return SL_OK;
}

static void clear(checker *c) {
    for (uint32_t i = 0; c->eyes && i < c->claim->count; i++)
        sli_eye_destroy(c->context, &c->eyes[i]);
    for (uint32_t i = 0; i < c->view_count; i++) sli_proof_view_destroy(c->context, &c->views[i]);
    sl_free(c->context, c->chosen);
    sl_free(c->context, c->fixed);
    sl_free(c->context, c->eyes);
    sl_free(c->context, c->views);
    sl_free(c->context, c->cell_boxes);
    sl_free(c->context, c->left_boxes);
    sl_free(c->context, c->has_left);
    sl_free(c->context, c->sees);
    sl_free(c->context, c->sure);
    sl_free(c->context, c->held);
    sl_free(c->context, c->parts.items);
    sl_free(c->context, c->near.items);
    sl_free(c->context, c->own.items);
    sl_free(c->context, c->around.items);
    sl_free(c->context, c->left.items);
    sl_free(c->context, c->ends.items);
    sl_free(c->context, c->entries.items);
    sli_proof_scene_destroy(c->context, &c->scene);
}

sl_status sl_place_area_proof_check(sl_context *context, sl_query *query, const sl_place_area *area,
                                    const sl_area_placement *claim, sl_place_area_verdict *out) {
    const sl_map *map = sl_query_map(query);
    checker c = {.context = context,
                 .query = query,
                 .area = area,
                 .claim = claim,
                 .out = out,
                 .digits = sl_map_digits(map),
                 .cover = area->cover ? area->cover : 1};
    *out = (sl_place_area_verdict){.sees_all = true, .sees_as_all = true, .weak = UINT32_MAX};
    SL_TRY(sli_area_proof_refuse(context, query, area));
    SL_TRY(sl_query_space(context, query, &c.space, NULL));
    sl_status status = make(&c, map);
    if (status == SL_OK) status = check_claim(&c);
    if (status == SL_OK) status = make_views(&c);
    if (status == SL_OK) status = check_chosen(&c);
    if (status == SL_OK) status = find_near(&c);
    if (status == SL_OK) status = check_places(&c);
    if (status == SL_OK) status = check_lower(&c);
    clear(&c);
    return status;
}

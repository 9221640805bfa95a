/// From near one point to near another: the runtime header's beams from box to box.
///
/// The space of the query is written as a baked file in memory, without rows of visible sets, and
/// the runtime header reads it. So the library, games and servers share one search.
///
/// On foot, a point reaches the cells that its own cells join by portals near enough:
///
///     +-------+-------+     The way to portal q, by way of p, is at least as long as the way to p
///     |  a .  p ---   |     and then from p to q, and at least as the crow flies. Dijkstra's
///     |       |    q  |     algorithm on these lengths, which are rounded down, never leaves out a
///     +-------+----+--+     cell that is reached.
#include "sightline/reach.h"

#define SL_RUNTIME_API static inline // most calls are not asked here
#define SIGHTLINE_RUNTIME_IMPLEMENTATION
#include "runtime/sightline_runtime.h"

#include "geometry/length.h"
#include "sightline/bake.h"
#include "sightline/support.h"

#include <math.h>

enum { PORTALS_MOST = 64, BOXES_MOST = PORTALS_MOST + 32 };

struct sl_reach {
    sl_query *query;
    const sl_space *space;
    const sl_map *map;
    sl_bytes file;
    sl_runtime runtime;
    uint32_t *scratch;
    unsigned char *shut; ///< by door
};

// --- the file

/// Rows of visible sets in which each cell sees itself.
static sl_status make_rows(sl_context *context, uint32_t cells, sl_pvs *out) {
    enum { ROW_MOST = 6 };
    *out = (sl_pvs){.cell_count = cells};
    out->offsets = sl_alloc_array(context, (size_t)cells + 1, sizeof *out->offsets);
    out->bytes = sl_alloc_array(context, (size_t)cells, ROW_MOST);
    if (!out->offsets || !out->bytes) return SL_NO_MEMORY;
    uint64_t at = 0;
    for (uint32_t c = 0; c < cells; c++) {
        uint32_t before = c;
        for (; before > 0x7f; before >>= 7) out->bytes[at++] = (uint8_t)(before | 0x80);
        out->bytes[at++] = (uint8_t)before;
        out->bytes[at++] = 1;
        out->offsets[c + 1] = at;
    }
    return SL_OK;
}

static sl_status write_file(sl_context *context, sl_reach *r) {
    sl_baked baked = {.map = *r->map, .space = *r->space, .method = "none"};
    baked.map.mirror_count = 0;
    sl_status status = make_rows(context, r->space->cell_count, &baked.visibility.pvs);
    if (status == SL_OK) status = sl_baked_print(context, &baked, &r->file);
    sl_pvs_destroy(context, &baked.visibility.pvs);
    return status;
}

static sl_status fill(sl_context *context, sl_reach *r) {
    if (!r->map) return sl_fail(context, SL_BAD_ARGUMENT, "reach needs the map of the space");
    if (r->space->loose)
        return sl_fail(context, SL_UNSUPPORTED, "reach needs a space without gaps: bake it again");
    SL_TRY(write_file(context, r));
    if (sl_runtime_open(r->file.data, r->file.size, &r->runtime) != SL_RUNTIME_OK)
        return sl_fail(context, SL_BAD_ARGUMENT, "reach: the space is not one that games read");
    r->scratch = sl_alloc_array(context, sl_runtime_scratch_count(&r->runtime), sizeof *r->scratch);
    r->shut = sl_alloc_array(context, r->map->door_count + 1, sizeof *r->shut);
    return r->scratch && r->shut ? SL_OK : SL_NO_MEMORY;
}

sl_status sl_reach_create(sl_context *context, sl_query *query, sl_reach **out) {
    sl_reach *r = sl_alloc_array(context, 1, sizeof *r);
    if (!r) return SL_NO_MEMORY;
    r->query = query;
    r->space = sl_query_asked(query);
    r->map = sl_query_map(query);
    const sl_status status = fill(context, r);
    if (status == SL_OK)
        *out = r;
    else
        sl_reach_destroy(context, r);
    return status;
}

void sl_reach_destroy(sl_context *context, sl_reach *reach) {
    if (!reach) return;
    sl_free(context, reach->file.data);
    sl_free(context, reach->scratch);
    sl_free(context, reach->shut);
    sl_free(context, reach);
}

// --- on foot

/// A portal that ways lead to.
typedef struct step {
    sl_point a, b;
    uint32_t portal, cell; ///< the cell behind it
    double least;          ///< no way to it is shorter
    bool done;
} step;

/// What is within reach of a point, as boxes.
typedef struct walker {
    const sl_reach *reach;
    sl_point from;
    double radius;
    sl_runtime_box square;
    step steps[PORTALS_MOST];
    uint32_t step_count;
    sl_runtime_box boxes[BOXES_MOST];
    uint32_t cells[BOXES_MOST], box_count;
    bool many; ///< more portals or cells than there is room for
} walker;

static double away_from_segment(sl_point p, sl_point a, sl_point b) {
    const sl_point way = {b.x - a.x, b.y - a.y}, to = {p.x - a.x, p.y - a.y};
    const double square = sli_dot(way, way);
    const double t = square > 0 ? fmin(1, fmax(0, sli_dot(way, to) / square)) : 0;
    return sli_length(to.x - t * way.x, to.y - t * way.y);
}

/// Two portals of a cell do not cross, so an end of one is nearest to the other.
static double apart(const step *p, const step *q) {
    return fmin(fmin(away_from_segment(p->a, q->a, q->b), away_from_segment(p->b, q->a, q->b)),
                fmin(away_from_segment(q->a, p->a, p->b), away_from_segment(q->b, p->a, p->b)));
}

static bool is_shut(const sl_reach *r, uint32_t portal) {
    size_t count;
    const sl_seam_portal *on = sl_space_seams_of(r->space, portal, &count);
    for (size_t i = 0; i < count; i++) {
        const sl_seam *seam = &r->space->seams[on[i].seam];
        if (seam->kind == SL_SEAM_DOOR && r->shut[seam->number]) return true;
    }
    return false;
}

/// Takes the box of what the square has of a cell. False if it was there before.
static bool add_cell(walker *w, uint32_t number) {
    const sl_space *space = w->reach->space;
    const sl_cell *cell = &space->cells[number];
    sl_runtime_box box = {INFINITY, INFINITY, -INFINITY, -INFINITY, false};
    for (uint32_t i = 0; i < w->box_count; i++)
        if (w->cells[i] == number) return false;
    if (w->box_count == BOXES_MOST) {
        w->many = true;
        return false;
    }
    for (uint32_t i = 0; i < cell->vertex_count; i++) {
        const sl_point p = space->vertices[cell->first_vertex + i];
        box.min_x = fmin(box.min_x, p.x), box.min_y = fmin(box.min_y, p.y);
        box.max_x = fmax(box.max_x, p.x), box.max_y = fmax(box.max_y, p.y);
    }
    box.min_x = fmax(box.min_x, w->square.min_x), box.min_y = fmax(box.min_y, w->square.min_y);
    box.max_x = fmin(box.max_x, w->square.max_x), box.max_y = fmin(box.max_y, w->square.max_y);
    w->cells[w->box_count] = number;
    w->boxes[w->box_count++] = box;
    return true;
}

/// The ways out of a cell: by portal `from`, or from the start.
static void open_portals(walker *w, uint32_t number, const step *from) {
    const sl_reach *r = w->reach;
    const sl_cell *cell = &r->space->cells[number];
    for (uint32_t k = 0; k < cell->directed_count; k++) {
        const sl_directed_portal *d = &r->space->directed[cell->first_directed + k];
        step s = {.a = d->right, .b = d->left, .portal = d->portal, .cell = d->cell};
        s.least = away_from_segment(w->from, s.a, s.b);
        if (from) s.least = fmax(s.least, from->least + apart(from, &s));
        s.least *= 1 - 0x1p-40;
        if (!(s.least <= w->radius) || is_shut(r, s.portal)) continue;
        uint32_t i = 0;
        while (i < w->step_count && (w->steps[i].portal != s.portal || w->steps[i].cell != s.cell))
            i++;
        if (i < w->step_count) {
            if (!w->steps[i].done && s.least < w->steps[i].least) w->steps[i].least = s.least;
        } else if (i == PORTALS_MOST)
            w->many = true;
        else
            w->steps[w->step_count++] = s;
    }
}

static step *next_step(walker *w) {
    step *next = NULL;
    for (uint32_t i = 0; i < w->step_count; i++)
        if (!w->steps[i].done && (!next || w->steps[i].least < next->least)) next = &w->steps[i];
    return next;
}

/// Begins in each cell that the point is in or on.
static bool begin(void *context, uint32_t cell) {
    walker *w = context;
    const double box[4] = {w->from.x, w->from.y, w->from.x, w->from.y};
    if (!slrt_meets_box(&w->reach->runtime, cell, box) || w->reach->space->cells[cell].solid)
        return true;
    if (add_cell(w, cell)) open_portals(w, cell, NULL);
    return true;
}

static void walk(const sl_reach *r, sl_point from, double radius, walker *w) {
    const double box[4] = {from.x, from.y, from.x, from.y};
    *w = (walker){.reach = r, .from = from, .radius = radius};
    w->square = slrt_square(from.x, from.y, radius);
    slrt_visit_near(&r->runtime, box, begin, w);
    for (step *s; !w->many && (s = next_step(w));) {
        s->done = true;
        add_cell(w, s->cell);
        open_portals(w, s->cell, s);
    }
}

// --- the question

/// Whether a beam in a cell comes to what is within reach there.
static bool meet_reached(slrt_beams *b, uint32_t cell, const slrt_beam *beam) {
    const walker *to = b->context;
    for (uint32_t i = 0; i < to->box_count; i++) {
        const sl_runtime_box *box = &to->boxes[i];
        const double target[4] = {box->min_x, box->min_y, box->max_x, box->max_y};
        double bounds[4], part[4];
        if (to->cells[i] != cell || !slrt_meets_box(b->rt, cell, target)) continue;
        slrt_bounds_of(b->rt, &b->cell, bounds);
        slrt_part_in(bounds, target, part);
        if (!slrt_is_beam_beside(beam, part) && !slrt_is_out_of_range(b, part)) return true;
    }
    return false;
}

/// Whether a portal and a box have a point in common, or may have one.
static bool may_meet(const sl_directed_portal *d, const double box[4]) {
    return fmin(d->left.x, d->right.x) <= box[2] && fmax(d->left.x, d->right.x) >= box[0] &&
           fmin(d->left.y, d->right.y) <= box[3] && fmax(d->left.y, d->right.y) >= box[1];
}

/// Looks from a box in the cell that it was reached in. Beams leave out what passes a portal within
/// the box: that is looked at from the cell behind it, and so on, but not across walls.
static bool look_from_cell(const sl_reach *r, slrt_origin *o, uint32_t first) {
    uint32_t cells[PORTALS_MOST] = {first}, count = 1;
    for (uint32_t i = 0; i < count; i++) {
        const sl_cell *cell = &r->space->cells[cells[i]];
        if (!slrt_look_from_cell(o, cells[i])) return true;
        for (uint32_t k = 0; k < cell->directed_count; k++) {
            const sl_directed_portal *d = &r->space->directed[cell->first_directed + k];
            uint32_t at = 0;
            if (!may_meet(d, o->beams.box) || is_shut(r, d->portal)) continue;
            while (at < count && cells[at] != d->cell) at++;
            if (at == PORTALS_MOST) return true; // too many to tell
            if (at == count) cells[count++] = d->cell;
        }
    }
    return false;
}

/// Whether some place in reach of one sees some place in reach of the other, both on foot.
static bool sees_on_foot(const sl_reach *r, const walker *from, walker *to) {
    double target[4] = {INFINITY, INFINITY, -INFINITY, -INFINITY};
    slrt_origin o;
    for (uint32_t i = 0; i < to->box_count; i++) {
        const sl_runtime_box *box = &to->boxes[i];
        target[0] = fmin(target[0], box->min_x), target[1] = fmin(target[1], box->min_y);
        target[2] = fmax(target[2], box->max_x), target[3] = fmax(target[3], box->max_y);
    }
    slrt_start_origin(&o, &r->runtime, r->shut, sl_query_range(r->query), r->scratch);
    o.beams.target = target;
    o.beams.meet = meet_reached;
    o.beams.context = to;
    for (uint32_t i = 0; to->box_count && i < from->box_count; i++) {
        if (!slrt_box_in_map(&r->runtime, &from->boxes[i], 0, o.beams.box)) continue;
        memset(o.beams.past, 0xff, sizeof o.beams.past);
        o.beams.patience = SLRT_BEAM_PATIENCE * ((uint64_t)r->runtime.directed_count + 1024);
        o.count = 0;
        if (look_from_cell(r, &o, from->cells[i])) return true;
    }
    return false;
}

static bool sees_straight(const sl_reach *r, const sl_runtime_box *from, const sl_runtime_box *to) {
    slrt_origin o;
    double target[4];
    if (!slrt_box_in_map(&r->runtime, to, 0, target)) return false;
    slrt_start_origin(&o, &r->runtime, r->shut, sl_query_range(r->query), r->scratch);
    o.beams.target = target;
    o.beams.meet = slrt_meet_target;
    return slrt_look_from_box(&o, from, 0);
}

sl_status sl_reach_sees_within(sl_context *context, sl_reach *reach, sl_point a, double radius0,
                               sl_point b, double radius1, sl_reach_kind kind, bool *out) {
    walker from, to;
    *out = false;
    if (!(radius0 >= 0 && radius1 >= 0 && isfinite(radius0 + radius1)))
        return sl_fail(context, SL_BAD_ARGUMENT, "a reach must be 0 or more, and finite");
    if (!isfinite(a.x + a.y + b.x + b.y))
        return sl_fail(context, SL_BAD_ARGUMENT, "reach from a point that is not finite");
    for (size_t i = 0; i < reach->map->door_count; i++)
        reach->shut[i] = !sl_query_door_is_open(reach->query, i);
    if (kind == SL_REACH_ON_FOOT) {
        walk(reach, a, radius0, &from);
        walk(reach, b, radius1, &to);
        if (!from.many && !to.many) {
            *out = sees_on_foot(reach, &from, &to);
            return SL_OK;
        }
    }
    const sl_runtime_box squares[2] = {slrt_square(a.x, a.y, radius0),
                                       slrt_square(b.x, b.y, radius1)};
    *out = sees_straight(reach, &squares[0], &squares[1]);
    return SL_OK;
}

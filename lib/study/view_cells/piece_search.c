/// The search from a piece of a room within a quadrant of directions: depth first over portal
/// sequences, as in multipass, each tested by the funnel.
///
/// While no side of the piece has a direction within a sector, the lines of the sector that meet
/// the piece are those that pass between two of its corners, the utmost left and the utmost right:
///
///            left o----.       The piece stands in the sequence as a portal between these two
///                /      .     corners, so no coordinate is computed. The quadrant is cut into
///     lines ->  /  piece o     sectors at the directions of the piece's oblique sides. A box
///               .       /     needs one sector.
///                .---o right
///
/// The search goes on where all candidates have been seen, because all sequences to an object are
/// needed to know from where in the piece it is seen. That is read from the funnel's polygon of
/// lines: the extreme place along an axis belongs to a corner of the polygon, or to where the
/// bounds of the sector cut it. It is rounded and decides no visibility, only where cutting may
/// pay.
///
/// Cost: one test for each portal of each room entered, among the candidates alone.
#include "geometry/length.h"
#include "stab/funnel.h"
#include "study/view_cells/pieces.h"

#include <string.h>

typedef struct step {
    uint32_t room, next;       ///< side to try next, from 0
    sli_direction_sector cone; ///< directions that cross all portals so far
} step;

struct sli_view_searcher {
    const sli_view_pieces *pieces;
    sl_context *context;     ///< the thread's
    sli_view_searcher *next; ///< idle ones are a list
    sl_view_work work;
    void *solver;
    SL_ARRAY(step) steps;
    uint32_t *allowed, *entered;    ///< by room: the number of the list, or search, that has it
    uint32_t *asked, *seen, *place; ///< by object: the same, and its place in the list of objects
    uint32_t allowing, current;
    uint64_t candidates;
    SL_ARRAY(sl_line) bounds; ///< of the sectors within a quadrant
};

static void destroy(sl_context *context, sli_view_searcher *me) {
    sl_funnel()->destroy(context, me->solver);
    sl_free(context, me->steps.items);
    sl_free(context, me->allowed);
    sl_free(context, me->entered);
    sl_free(context, me->asked);
    sl_free(context, me->seen);
    sl_free(context, me->place);
    sl_free(context, me->bounds.items);
    sl_free(context, me);
}

static sl_status create(sl_context *context, const sli_view_pieces *pieces, sli_view_searcher *me) {
    const size_t rooms = pieces->rooms.count, objects = pieces->rooms.object_count;
    me->allowed = sl_alloc_array(context, rooms, sizeof *me->allowed);
    me->entered = sl_alloc_array(context, rooms, sizeof *me->entered);
    me->asked = sl_alloc_array(context, objects, sizeof *me->asked);
    me->seen = sl_alloc_array(context, objects, sizeof *me->seen);
    me->place = sl_alloc_array(context, objects, sizeof *me->place);
    if (!me->allowed || !me->entered || !me->asked || !me->seen || !me->place) return SL_NO_MEMORY;
    return sl_funnel()->create(context, pieces->rooms.bounds, &me->solver);
}

sl_status sli_view_searcher_take(sl_context *context, sli_view_pieces *pieces,
                                 sli_view_searcher **out) {
    pthread_mutex_lock(&pieces->lock);
    sli_view_searcher *me = pieces->idle;
    if (me) pieces->idle = me->next;
    pthread_mutex_unlock(&pieces->lock);
    if (!me) {
        me = sl_alloc_array(context, 1, sizeof *me);
        if (!me) return SL_NO_MEMORY;
        const sl_status status = create(context, pieces, me);
        if (status != SL_OK) {
            destroy(context, me);
            return status;
        }
    }
    me->pieces = pieces;
    me->context = context;
    *out = me;
    return SL_OK;
}

void sli_view_searcher_give(sli_view_pieces *pieces, sli_view_searcher *me) {
    pthread_mutex_lock(&pieces->lock);
    me->next = pieces->idle;
    pieces->idle = me;
    pthread_mutex_unlock(&pieces->lock);
}

void sli_view_searchers_destroy(sl_context *context, sli_view_pieces *pieces) {
    while (pieces->idle) {
        sli_view_searcher *me = pieces->idle;
        pieces->idle = me->next;
        destroy(context, me);
    }
}

sl_view_work sli_view_searcher_work(sli_view_searcher *me) {
    const sl_view_work work = me->work;
    me->work = (sl_view_work){0};
    return work;
}

sli_direction_sector sli_view_quadrant(int quadrant) {
    static const sl_point ways[SLI_VIEW_QUADRANTS] = {{1, 0}, {0, 1}, {-1, 0}, {0, -1}};
    const sl_point zero = {0, 0};
    return (sli_direction_sector){{zero, ways[quadrant]},
                                  {zero, ways[(quadrant + 1) % SLI_VIEW_QUADRANTS]}};
}

// --- candidates

void sli_view_search_begin(sli_view_searcher *me) {
    me->allowing++;
    me->candidates = 0;
}

void sli_view_search_allow(sli_view_searcher *me, uint32_t room) {
    if (me->allowed[room] == me->allowing) return;
    me->allowed[room] = me->allowing;
    me->candidates++;
}

// --- from where in the piece

/// Adds the part of a line within the piece, which the line meets, but for rounding.
static void add_line(const sli_view_piece *piece, sl_point a, sl_point b, sli_view_extent *out) {
    double t0 = -INFINITY, t1 = INFINITY;
    const double dx = b.x - a.x, dy = b.y - a.y;
    sl_point p = piece->corners.items[piece->corners.count - 1];
    for (size_t i = 0; i < piece->corners.count; i++) {
        const sl_point q = piece->corners.items[i];
        const double nx = q.y - p.y, ny = p.x - q.x; // outwards
        sli_keep_below(nx * (a.x - p.x) + ny * (a.y - p.y), nx * dx + ny * dy, &t0, &t1);
        p = q;
    }
    const double ends[2] = {t0, t1};
    for (int i = 0; i < 2; i++) {
        if (!isfinite(ends[i])) continue;
        const double at[2] = {a.x + ends[i] * dx, a.y + ends[i] * dy};
        for (int axis = 0; axis < 2; axis++) {
            const double v = sli_within(at[axis], piece->box.low[axis], piece->box.high[axis]);
            if (v < out->low[axis]) out->low[axis] = v;
            if (v > out->high[axis]) out->high[axis] = v;
        }
    }
}

/// The extent within the piece of the lines of the current sequence.
static sli_view_extent find_extent(const sli_view_searcher *me, const sli_view_piece *piece,
                                   sli_direction_sector sector) {
    const uint32_t count = sli_funnel_corner_count(me->solver);
    sli_view_extent extent = sli_view_no_extent();
    if (!count) return piece->box;
    const sl_point ways[2] = {
        {sector.right.b.x - sector.right.a.x, sector.right.b.y - sector.right.a.y},
        {sector.left.b.x - sector.left.a.x, sector.left.b.y - sector.left.a.y}};
    sli_funnel_corner last = sli_funnel_corner_at(me->solver, count - 1);
    sl_point from = {last.to.x - last.from.x, last.to.y - last.from.y};
    for (uint32_t i = 0; i < count; i++) {
        const sli_funnel_corner c = sli_funnel_corner_at(me->solver, i);
        const sl_point to = {c.to.x - c.from.x, c.to.y - c.from.y};
        add_line(piece, c.from, c.to, &extent);
        for (int k = 0; k < 2; k++)
            if (sli_cross(ways[k], from) * sli_cross(ways[k], to) < 0)
                add_line(piece, last.pivot,
                         (sl_point){last.pivot.x + ways[k].x, last.pivot.y + ways[k].y}, &extent);
        last = c;
        from = to;
    }
    return extent.low[0] <= extent.high[0] ? extent : piece->box;
}

// --- the search

/// One search of a quadrant.
typedef struct search {
    const sli_view_pieces *pieces;
    sli_view_searcher *me;
    const sli_view_piece *piece;
    sli_direction_sector sector;
    bool east, north; ///< where the quadrant's directions go
    bool limited;     ///< to the objects that are asked for
    sli_view_directed *out;
} search;

static sl_status add_object(search *s, uint32_t object) {
    sli_view_searcher *me = s->me;
    sli_view_directed *out = s->out;
    if (me->seen[object] != me->current) {
        SL_TRY(SL_ARRAY_ROOM(s->me->context, &out->objects, 1));
        me->seen[object] = me->current;
        me->place[object] = (uint32_t)out->objects.count;
        out->objects.items[out->objects.count++] =
            (sli_view_sight){.object = object, .from = sli_view_no_extent()};
    }
    sli_view_extent *from = &out->objects.items[me->place[object]].from;
    if (memcmp(from, &s->piece->box, sizeof *from) == 0) return SL_OK; // it cannot grow
    sli_view_extent more = find_extent(me, s->piece, s->sector);
    for (int axis = 0; axis < 2; axis++) {
        more.low[axis] = sli_view_rooms_snap(&s->pieces->rooms, axis, more.low[axis]);
        more.high[axis] = sli_view_rooms_snap(&s->pieces->rooms, axis, more.high[axis]);
    }
    sli_view_extent_join(from, &more);
    return SL_OK;
}

static sl_status add_room(search *s, uint32_t room) {
    sli_view_searcher *me = s->me;
    if (me->entered[room] == me->current) return SL_OK;
    me->entered[room] = me->current;
    SL_TRY(SL_ARRAY_ROOM(s->me->context, &s->out->rooms, 1));
    s->out->rooms.items[s->out->rooms.count++] = room;
    return SL_OK;
}

/// Whether lines of the sequence and the sector pass a side too. The caller pops it after SL_OK.
static sl_status push_side(search *s, const sli_room_side *side, const sli_direction_sector *cone,
                           bool *seen) {
    sl_context *context = s->me->context;
    sl_stab_verdict verdict;
    if (++s->me->work.tests % 64 == 0) SL_TRY(sl_check_cancelled(context));
    SL_TRY(sl_funnel()->push(context, s->me->solver, side->left, side->right, &verdict));
    if (verdict != SL_HIDDEN)
        SL_TRY(sl_funnel()->toward(context, s->me->solver, cone->right, cone->left, &verdict));
    *seen = verdict == SL_STABBED || (verdict == SL_GRAZING && s->pieces->sight == SL_CLOSED);
    return SL_OK;
}

static sl_status enter(search *s, step to) {
    SL_TRY(SL_ARRAY_ROOM(s->me->context, &s->me->steps, 1));
    s->me->steps.items[s->me->steps.count++] = to;
    return SL_OK;
}

/// Whether a portal of the piece's own room is behind the whole piece in the quadrant. A line along
/// both would reach it, but backwards.
static bool is_behind(const search *s, const sli_room_side *side) {
    const sli_view_extent *box = &s->piece->box;
    const bool behind_x = s->east ? fmax(side->left.x, side->right.x) < box->low[0]
                                  : fmin(side->left.x, side->right.x) > box->high[0];
    const bool behind_y = s->north ? fmax(side->left.y, side->right.y) < box->low[1]
                                   : fmin(side->left.y, side->right.y) > box->high[1];
    return behind_x || behind_y;
}

static sl_status try_side(search *s, const sli_room_side *side) {
    sli_view_searcher *me = s->me;
    step to = me->steps.items[me->steps.count - 1];
    const sl_directed_portal portal = {.left = side->left, .right = side->right};
    if (me->steps.count == 1 && is_behind(s, side)) return SL_OK;
    if (side->room != SLI_NO_ROOM && me->allowed[side->room] != me->allowing) return SL_OK;
    if (side->room == SLI_NO_ROOM) {
        // A piece sees all walls of its own room. sli_view_piece_add_to adds them.
        if (me->steps.count == 1) return SL_OK;
        if (s->limited && me->asked[side->object] != me->current) return SL_OK;
    }
    if (!sli_direction_sector_cut(&to.cone, &portal)) return SL_OK;
    bool seen;
    SL_TRY(push_side(s, side, &to.cone, &seen));
    if (seen && side->object != SLI_NO_OBJECT) SL_TRY(add_object(s, side->object));
    if (!seen || side->room == SLI_NO_ROOM) {
        sl_funnel()->pop(me->solver);
        return SL_OK;
    }
    SL_TRY(add_room(s, side->room));
    to.room = side->room;
    to.next = 0;
    return enter(s, to);
}

/// The utmost corner to the left (or right), which is the same for all directions of the sector.
static sl_point utmost(const sli_view_piece *piece, sli_direction_sector sector, int side) {
    sl_point best = piece->corners.items[0];
    for (size_t i = 1; i < piece->corners.count; i++) {
        const sl_point p = piece->corners.items[i];
        if (sli_turn(sector.right.a, sector.right.b, best, p) == side ||
            sli_turn(sector.left.a, sector.left.b, best, p) == side)
            best = p;
    }
    return best;
}

static sl_status search_sector(search *s) {
    sli_view_searcher *me = s->me;
    const sli_view_rooms *rooms = &s->pieces->rooms;
    const sl_point left = utmost(s->piece, s->sector, 1), right = utmost(s->piece, s->sector, -1);
    sl_stab_verdict verdict;
    me->steps.count = 0;
    SL_TRY(sl_funnel()->push(s->me->context, me->solver, left, right, &verdict));
    SL_TRY(enter(s, (step){.room = s->piece->room, .cone = s->sector}));
    while (me->steps.count) {
        step *last = &me->steps.items[me->steps.count - 1];
        const uint32_t first = rooms->first_side[last->room];
        if (last->next < rooms->first_side[last->room + 1] - first) {
            SL_TRY(try_side(s, &rooms->sides[first + last->next++]));
        } else {
            me->steps.count--;
            sl_funnel()->pop(me->solver);
        }
    }
    return SL_OK;
}

/// Adds a direction to the bounds, in order, if it lies strictly between the first and the last.
static sl_status add_bound(sl_context *context, sli_view_searcher *me, sl_line way) {
    SL_TRY(SL_ARRAY_ROOM(context, &me->bounds, 1));
    sl_line *bounds = me->bounds.items;
    const size_t count = me->bounds.count;
    if (sli_turn(bounds[0].a, bounds[0].b, way.a, way.b) <= 0 ||
        sli_turn(way.a, way.b, bounds[count - 1].a, bounds[count - 1].b) <= 0)
        return SL_OK;
    size_t at = 1;
    while (sli_turn(bounds[at].a, bounds[at].b, way.a, way.b) > 0) at++;
    if (sli_turn(bounds[at].a, bounds[at].b, way.a, way.b) == 0) return SL_OK;
    memmove(bounds + at + 1, bounds + at, (count - at) * sizeof *bounds);
    bounds[at] = way;
    me->bounds.count++;
    return SL_OK;
}

/// Cuts a quadrant at the directions of the piece's sides.
static sl_status find_sectors(sl_context *context, sli_view_searcher *me,
                              const sli_view_piece *piece, int quadrant) {
    const sli_direction_sector all = sli_view_quadrant(quadrant);
    me->bounds.count = 0;
    SL_TRY(SL_ARRAY_ROOM(context, &me->bounds, 2));
    me->bounds.items[me->bounds.count++] = all.right;
    me->bounds.items[me->bounds.count++] = all.left;
    sl_point p = piece->corners.items[piece->corners.count - 1];
    for (size_t i = 0; i < piece->corners.count; i++) {
        const sl_point q = piece->corners.items[i];
        if (p.x != q.x && p.y != q.y) {
            SL_TRY(add_bound(context, me, (sl_line){p, q}));
            SL_TRY(add_bound(context, me, (sl_line){q, p}));
        }
        p = q;
    }
    return SL_OK;
}

sl_status sli_view_search(sli_view_searcher *me, const sli_view_piece *piece, int quadrant,
                          const sli_view_directed *objects, sli_view_directed *out) {
    me->current++;
    if (objects)
        for (size_t i = 0; i < objects->objects.count; i++)
            me->asked[objects->objects.items[i].object] = me->current;
    SL_TRY(find_sectors(me->context, me, piece, quadrant));
    search s = {.pieces = me->pieces,
                .me = me,
                .piece = piece,
                .east = quadrant == 0 || quadrant == 3,
                .north = quadrant < 2,
                .limited = objects != NULL,
                .out = out};
    for (size_t i = 0; i + 1 < me->bounds.count; i++) {
        s.sector = (sli_direction_sector){me->bounds.items[i], me->bounds.items[i + 1]};
        SL_TRY(search_sector(&s));
    }
    me->work.looks++;
    me->work.candidates += me->candidates;
    me->work.relations += out->rooms.count;
    return SL_OK;
}

/// Discs that move: how far, and along what.

// A disc of radius r moves as its middle does, if walls and all else that stops it have grown by r.
// The distance to a segment changes along a straight way as a convex function does. So Newton's
// steps from the start come to the first place where the distance is r, and never behind it:
//
//      .--___                 The disc then slides: what is left of the way, without its part
//     | o ---> ''--.          toward the nearest place of the segment. It ends in a corner, where
//      '--....--____|_        it would go back.
//      =================
//
// All that is within reach of the way is in the cells that open portals within reach lead to: the
// nearest of it has no other before it.
//
// Distances are rounded. So three limits lie apart by more than rounding can do (`slack`): r
// itself; r + 2 slack, from where a way is free; r + 3 slack, where a disc comes to rest. No rest
// is therefore nearer than r, and none is stuck to what it rests at. Whether a way crosses
// something is exact.

/// A disc on a straight way.
typedef struct slrt_disc {
    slrt_polygon p; ///< its search is from where the disc is
    double radius, slack, from[2], to[2];
    double along[2], length; ///< the way's direction and length
    bool is_near;            ///< something is nearer to the way than it may
    double stop;             ///< how far along the way the disc comes
    double normal[2];        ///< if that is not all of it: away from what stops it
    double push;             ///< how far the disc is nearer to that than at rest
} slrt_disc;

/// The square of the distance from a point to the segment from a to b. `away` leads to the point
/// from the nearest place: right across the segment, but at its ends. Its direction is exact but
/// for rounding even where it is short, so that small discs slide along walls and not into them.
static double slrt_away_from(const double *point, const double *a, const double *b, double *away) {
    const double side[2] = {b[0] - a[0], b[1] - a[1]};
    const double to[2] = {point[0] - a[0], point[1] - a[1]};
    const double square = slrt_dot(side, side), part = slrt_dot(to, side);
    double at = part > 0 ? part / square : 0;
    if (!(at < 1)) at = 1;
    if (!(square > 0)) at = 0;
    away[0] = to[0] - at * side[0];
    away[1] = to[1] - at * side[1];
    if (at > 0 && at < 1) {
        const double across = (side[0] * to[1] - side[1] * to[0]) / square;
        away[0] = -across * side[1];
        away[1] = across * side[0];
    }
    return slrt_dot(away, away);
}

/// Whether a segment is nearer to the way than a limit, or crosses it.
static bool slrt_is_near(const slrt_disc *d, const double *a, const double *b, double limit) {
    const double square = limit * limit;
    double away[2];
    int i;
    for (i = 0; i < 2; i++) {
        const double *low = d->from[i] < d->to[i] ? d->from : d->to;
        const double *high = d->from[i] < d->to[i] ? d->to : d->from;
        if (low[i] - a[i] >= limit && low[i] - b[i] >= limit) return false;
        if (a[i] - high[i] >= limit && b[i] - high[i] >= limit) return false;
    }
    return !(slrt_away_from(d->from, a, b, away) >= square &&
             slrt_away_from(d->to, a, b, away) >= square &&
             slrt_away_from(a, d->from, d->to, away) >= square &&
             slrt_away_from(b, d->from, d->to, away) >= square) ||
           slrt_meets(d->from, d->to, a, b);
}

/// Has a segment stop the disc. One that the disc is nearer to than it may, but moves away from,
/// does not.
static void slrt_stop_at(slrt_disc *d, const double *a, const double *b) {
    const double rest = d->radius + 3 * d->slack;
    double at = 0, gap = 0, rate = 0, distance = 0;
    double place[2], away[2] = {0, 0};
    int i;
    if (!slrt_is_near(d, a, b, d->radius + 2 * d->slack)) return;
    d->is_near = true;
    for (i = 0; i < 40; i++) { // slow where the way grazes an end
        place[0] = d->from[0] + at * d->along[0];
        place[1] = d->from[1] + at * d->along[1];
        distance = slrt_root(slrt_away_from(place, a, b, away));
        gap = distance - rest;
        rate = -slrt_dot(away, d->along) / distance;
        if (!(gap > 0 && rate > 0)) break;
        at += gap / rate;
    }
    if (!(at < d->stop) ||
        (!(rate > 0) && (at > 0 || slrt_away_from(d->to, a, b, place) >= distance * distance)))
        return;
    d->stop = at;
    d->normal[0] = away[0] / distance;
    d->normal[1] = away[1] / distance;
    d->push = gap < 0 ? -gap : 0;
}

/// Has the sides of the boxes in a cell stop the disc.
static void slrt_stop_at_boxes(slrt_disc *d, uint32_t cell) {
    const sl_runtime_boxes *boxes = d->p.s.boxes;
    uint32_t at = boxes ? *slrt_first_entry(boxes, cell) : SLRT_NO_ENTRY;
    for (; at != SLRT_NO_ENTRY; at = slrt_entry(boxes, at)[SLRT_ENTRY_IN_CELL]) {
        const uint32_t number = slrt_entry(boxes, at)[SLRT_ENTRY_BOX];
        const sl_runtime_box *box = &boxes->boxes[number];
        const double corners[5][2] = {{box->min_x, box->min_y},
                                      {box->max_x, box->min_y},
                                      {box->max_x, box->max_y},
                                      {box->min_x, box->max_y},
                                      {box->min_x, box->min_y}};
        int k;
        for (k = 0; k < 4 && box->blocks && number != d->p.s.except; k++)
            slrt_stop_at(d, corners[k], corners[k + 1]);
    }
}

/// Notes that a disc may get to the cell behind a way out of a cell.
static void slrt_reach_across(slrt_disc *d, const double *a, const double *b, uint32_t to) {
    if (slrt_is_near(d, a, b, d->radius + 4 * d->slack) && !slrt_is_listed(&d->p.s, to))
        slrt_list(&d->p.s, to);
}

/// The next wall along a piece of a cell's boundary that steps pass, from a place on: passage_count
/// for none. A piece is one wall, or axial.
static uint32_t slrt_next_gap(const sl_runtime *rt, uint32_t cell, const double *from,
                              const slrt_piece *piece, slrt_piece *gap) {
    uint32_t i = slrt_next_way(rt, cell, slrt_first_passage(rt, cell)), found = rt->passage_count;
    for (; i < rt->passage_count; i = slrt_next_way(rt, cell, i + 1)) {
        slrt_piece at;
        slrt_read_passage(rt, i, at.a, at.b);
        if (rt->neighbours ? !slrt_same_place(at.a, piece->a) || !slrt_same_place(at.b, piece->b)
                           : !slrt_is_on(from, piece->b, at.a) || !slrt_is_on(from, piece->b, at.b))
            continue;
        if (found < rt->passage_count && !slrt_is_on(from, gap->a, at.a)) continue;
        found = i;
        *gap = at;
    }
    return found;
}

/// Has the walls of a piece that stop steps, and shut doors on others, stop the disc; the rest
/// leads on.
static void slrt_stop_at_walls(slrt_disc *d, uint32_t cell, const slrt_piece *piece) {
    const sl_runtime *rt = d->p.s.rt;
    double from[2] = {piece->a[0], piece->a[1]};
    uint32_t left = rt->passage_count;
    for (; left; left--) {
        slrt_piece gap;
        const uint32_t passage = slrt_next_gap(rt, cell, from, piece, &gap);
        if (passage == rt->passage_count) break;
        if (!slrt_same_place(from, gap.a)) slrt_stop_at(d, from, gap.a);
        if (slrt_is_passage_barred(&d->p.s, passage))
            slrt_stop_at(d, gap.a, gap.b);
        else
            slrt_reach_across(d, gap.a, gap.b,
                              slrt_u32(rt->passages + (size_t)passage * SLRT_PASSAGE_BYTES + 8));
        from[0] = gap.b[0], from[1] = gap.b[1];
        if (slrt_same_place(from, piece->b)) return;
    }
    slrt_stop_at(d, from, piece->b);
}

/// Goes through the cells within reach of the disc's way, and has what is there stop it.
static void slrt_stop_within(slrt_disc *d) {
    slrt_search *s = &d->p.s;
    uint32_t at;
    slrt_list(s, s->eye_cell);
    for (at = 0; at < s->own_count; at++) {
        slrt_walk w;
        slrt_piece piece;
        slrt_stop_at_boxes(d, s->path[at]);
        slrt_walk_around(&d->p, &w, s->path[at], 1);
        while (slrt_walk_next(&d->p, &w, &piece)) {
            if (piece.directed == SLRT_NONE)
                slrt_stop_at_walls(d, s->path[at], &piece);
            else if (slrt_is_blocked(s, piece.directed))
                slrt_stop_at(d, piece.a, piece.b);
            else
                slrt_reach_across(d, piece.a, piece.b, slrt_cell_across(s->rt, piece.directed));
        }
    }
}

/// Puts a disc at the start of a way, and finds how far it comes. False for nowhere.
static bool slrt_move_disc(slrt_disc *d, const sl_runtime *rt, const sl_runtime_walker *walker,
                           const double *from, const double *to, uint32_t *scratch) {
    slrt_search *s = &d->p.s;
    memset(d, 0, sizeof *d);
    if (rt->loose || !slrt_place_eye(s, rt, from[0], from[1], walker->shut) ||
        !slrt_is_coordinate(to[0]) || !slrt_is_coordinate(to[1]))
        return false;
    if (walker->boxes) slrt_heed_boxes(s, walker->boxes, walker->own_box);
    s->on_foot = true;
    s->path = scratch;
    s->marks = (unsigned char *)(scratch + 6 * (size_t)rt->cell_count);
    s->patience = (uint64_t)16 * ((uint64_t)rt->directed_count + rt->vertex_count + 16);
    d->radius = walker->radius > 0 ? walker->radius : 0;
    d->slack =
        1e-14 * (slrt_larger(rt->min_x, rt->max_x) + slrt_larger(rt->min_y, rt->max_y) + d->radius);
    d->from[0] = s->x, d->from[1] = s->y;
    d->to[0] = slrt_no_dust(to[0]), d->to[1] = slrt_no_dust(to[1]);
    d->along[0] = d->to[0] - d->from[0];
    d->along[1] = d->to[1] - d->from[1];
    d->length = d->stop = slrt_root(slrt_dot(d->along, d->along));
    if (d->length > 0) d->along[0] /= d->length, d->along[1] /= d->length;
    slrt_stop_within(d);
    return !d->p.broken;
}

SL_RUNTIME_API bool sl_runtime_can_walk_wide(const sl_runtime *runtime,
                                             const sl_runtime_walker *walker, double x0, double y0,
                                             double x1, double y1, uint32_t *scratch) {
    const double from[2] = {x0, y0}, to[2] = {x1, y1};
    slrt_disc d;
    return slrt_move_disc(&d, runtime, walker, from, to, scratch) &&
           (!d.is_near || !(walker->radius > 0)) && slrt_can_step(&d.p.s, x1, y1);
}

/// Turns a way along what stops a disc, which is `at` that. False if nothing is left of the way, or
/// if it would go back.
static bool slrt_turn_along(const slrt_disc *d, const double *at, const double *first,
                            double *goal) {
    const double into = slrt_dot(d->along, d->normal), left = d->length - d->stop;
    const double most = 4 * d->slack, push = d->push < most ? d->push : most;
    double rest[2];
    int i;
    for (i = 0; i < 2; i++) {
        rest[i] = left * (d->along[i] - into * d->normal[i]);
        goal[i] = at[i] + rest[i] + push * d->normal[i];
    }
    return slrt_dot(rest, rest) > most * most && slrt_dot(rest, first) > 0;
}

SL_RUNTIME_API bool sl_runtime_walk(const sl_runtime *runtime, const sl_runtime_walker *walker,
                                    double x0, double y0, double x1, double y1, uint32_t *scratch,
                                    double *x, double *y) {
    enum { TURNS = 4 };
    double at[2] = {x0, y0}, goal[2] = {x1, y1}, first[2];
    int turn;
    for (turn = 0; turn < TURNS; turn++) {
        slrt_disc d;
        double next[2];
        bool all;
        if (!slrt_move_disc(&d, runtime, walker, at, goal, scratch)) break;
        if (!turn) memcpy(first, d.along, sizeof first);
        all = !(d.stop < d.length) || (!turn && !(d.radius > 0) && slrt_can_step(&d.p.s, x1, y1));
        next[0] = all ? goal[0] : at[0] + d.stop * d.along[0];
        next[1] = all ? goal[1] : at[1] + d.stop * d.along[1];
        if (!slrt_can_step(&d.p.s, next[0], next[1])) break;
        memcpy(at, next, sizeof at);
        if (all || !slrt_turn_along(&d, at, first, goal)) break;
    }
    *x = at[0], *y = at[1];
    return *x == x1 && *y == y1;
}

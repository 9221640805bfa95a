/// Fans: what lies round each end of a portal, for the sweep to turn its line about.
///
///     cell 2  |  cell 1
///     --------v#### wall        The fan of v: cells 1, 2, 3 and 4, counter-clockwise from one
///     cell 3  |  cell 4         side of the wall to its other side.
///
/// A walk from portal to portal finds each fan. It starts at a wall and ends at the next wall, or
/// goes all round. With one-way glass a fan also ends where the glass is blocked.
///
/// Each cell must be looked at from one of its corners: a fan there "covers" the cell. Which fans
/// cover which cells is a greedy set cover. The candidate with the most gain for its cost comes
/// first. Cost: linear in the number of directed portals. The set cover goes over all fans once for
/// each different gain.
#include "cell_to_cell/sweep/fans.h"
#include "effects/filtered.h"

#include "base/base.h"
#include "cell_to_cell/methods.h"
#include "geometry/orient.h"
#include "sightline/support.h"

#include <math.h>
#include <string.h>

void sli_fans_destroy(sl_context *context, sli_fans *fans) {
    sl_free(context, fans->first_directed);
    sl_free(context, fans->directed);
    sl_free(context, fans->middles);
    sl_free(context, fans->ends.items);
    sl_free(context, fans->fans.items);
    sl_free(context, fans->cells.items);
    *fans = (sli_fans){0};
}

uint64_t sli_fans_bytes(const sli_fans *fans) {
    const uint64_t directed = fans->first_directed[fans->cell_count];
    return ((uint64_t)fans->cell_count + 1) * sizeof *fans->first_directed +
           fans->cell_count * sizeof *fans->middles +
           fans->ends.capacity * sizeof *fans->ends.items + directed * sizeof *fans->directed +
           fans->fans.capacity * sizeof *fans->fans.items +
           fans->cells.capacity * sizeof *fans->cells.items;
}

// --- directed portals

typedef struct walker {
    const sl_space *space;
    sli_fans *fans;
    uint32_t *of_space;     ///< by directed portal: its number in the space
    const sl_bits *blocked; ///< directed portals that end a fan; NULL for none
} walker;

/// `blocked`: NULL, or a set that gets the directed portals whose glass is blocked.
static sl_status copy_directed(sl_context *context, walker *w, const sl_see_options *options,
                               sl_bits *blocked) {
    const sl_space *space = w->space;
    sli_fans *fans = w->fans;
    const uint32_t count = space->cell_count;
    fans->cell_count = count;
    fans->first_directed = sl_alloc_array(context, (size_t)count + 1, sizeof *fans->first_directed);
    fans->directed = sl_alloc_array(context, space->directed_count, sizeof *fans->directed);
    w->of_space = sl_alloc_array(context, space->directed_count, sizeof *w->of_space);
    uint32_t *of_portal = sl_alloc_array(context, space->portal_count, sizeof *of_portal);
    if (!fans->first_directed || !fans->directed || !w->of_space || !of_portal) {
        sl_free(context, of_portal);
        return SL_NO_MEMORY;
    }
    memset(of_portal, 0xff, space->portal_count * sizeof *of_portal);
    uint32_t at = 0;
    for (uint32_t cell = 0; cell < count; cell++) {
        fans->first_directed[cell] = at;
        const uint32_t first = space->cells[cell].first_directed;
        for (uint32_t i = first; i < first + space->cells[cell].directed_count; i++) {
            const sl_directed_portal *e = &space->directed[i];
            if (!sli_looks_from(space, options->inside_only, cell) ||
                !sli_looks_from(space, options->inside_only, e->cell))
                continue;
            uint32_t *other = &of_portal[e->portal];
            fans->directed[at] =
                (sli_walk_portal){.left = UINT32_MAX, .cell = e->cell, .twin = *other};
            w->of_space[at] = i;
            if (*other == UINT32_MAX)
                *other = at;
            else
                fans->directed[*other].twin = at;
            if (blocked && sli_portal_is_blocked(space, cell, i)) sl_bits_add(blocked, at);
            at++;
        }
    }
    fans->first_directed[count] = at;
    sl_free(context, of_portal);
    return SL_OK;
}

/// For glass that is turned round: blocks the twins of the blocked directed portals instead.
static void turn_round(const sli_fans *fans, sl_bits *blocked) {
    for (uint32_t i = 0; i < fans->first_directed[fans->cell_count]; i++) {
        const uint32_t twin = fans->directed[i].twin;
        if (twin < i || sl_bits_has(blocked, i) == sl_bits_has(blocked, twin)) continue;
        sl_bits_flip(blocked, i);
        sl_bits_flip(blocked, twin);
    }
}

static void block_directed(sli_fans *fans, const sl_bits *blocked) {
    for (uint32_t i = 0; i < fans->first_directed[fans->cell_count]; i++)
        if (sl_bits_has(blocked, i)) fans->directed[i].cell = SL_NO_CELL;
}

// --- walking round

static bool is_blocked(const walker *w, uint32_t directed) {
    return w->blocked && sl_bits_has(w->blocked, directed);
}

static sl_point left_of(const walker *w, uint32_t directed) {
    return w->space->directed[w->of_space[directed]].left;
}

static sl_point right_of(const walker *w, uint32_t directed) {
    return w->space->directed[w->of_space[directed]].right;
}

/// The next and the previous directed portal of a cell, all round.
static uint32_t portal_after(const sli_fans *fans, uint32_t cell, uint32_t directed) {
    return directed + 1 < fans->first_directed[cell + 1] ? directed + 1
                                                         : fans->first_directed[cell];
}

static uint32_t portal_before(const sli_fans *fans, uint32_t cell, uint32_t directed) {
    return (directed > fans->first_directed[cell] ? directed : fans->first_directed[cell + 1]) - 1;
}

/// The corner of a cell that follows a point of its boundary, counter-clockwise or (`back`)
/// clockwise.
static sl_point corner_beside(const sl_space *space, uint32_t cell, sl_point at, bool back) {
    const uint32_t count = space->cells[cell].vertex_count;
    const sl_point *corners = space->vertices + space->cells[cell].first_vertex;
    for (uint32_t i = 0; i < count; i++)
        if (sli_same_point(corners[i], at)) return corners[(back ? i + count - 1 : i + 1) % count];
    for (uint32_t i = 0; i < count; i++) {
        const sl_point a = corners[i], b = corners[(i + 1) % count];
        if (sli_orient(a, b, at) == 0 && sli_opposite(at, a, b)) return back ? a : b;
    }
    return at; // no point of the boundary: not in a space that keeps its promises
}

// --- ends

static uint32_t add_end(sli_fans *fans, sl_point end) {
    sl_box *box = &fans->bounds;
    if (!fans->ends.count) *box = (sl_box){end, end};
    if (end.x < box->min.x) box->min.x = end.x;
    if (end.y < box->min.y) box->min.y = end.y;
    if (end.x > box->max.x) box->max.x = end.x;
    if (end.y > box->max.y) box->max.y = end.y;
    fans->ends.items[fans->ends.count] = end;
    return (uint32_t)fans->ends.count++;
}

/// Gives the left ends of all directed portals round a point one number.
static void number_round(const walker *w, uint32_t directed, uint32_t number) {
    const sli_fans *fans = w->fans;
    const sl_point at = left_of(w, directed);
    uint32_t i = directed;
    do {
        fans->directed[i].left = number;
        i = portal_before(fans, fans->directed[i].cell, fans->directed[i].twin);
        if (i == directed) return;
    } while (sli_same_point(left_of(w, i), at));
    for (i = directed;;) {
        const uint32_t cell = fans->directed[fans->directed[i].twin].cell;
        const uint32_t next = portal_after(fans, cell, i);
        if (!sli_same_point(right_of(w, next), at)) return;
        i = fans->directed[next].twin;
        fans->directed[i].left = number;
    }
}

static sl_status number_ends(sl_context *context, const walker *w) {
    sli_fans *fans = w->fans;
    const uint32_t count = fans->first_directed[fans->cell_count];
    SL_TRY(SL_ARRAY_ROOM(context, &fans->ends, count));
    for (uint32_t i = 0; i < count; i++)
        if (fans->directed[i].left == UINT32_MAX) number_round(w, i, add_end(fans, left_of(w, i)));
    for (uint32_t i = 0; i < count; i++)
        fans->directed[i].right = fans->directed[fans->directed[i].twin].left;
    return SL_OK;
}

/// Whether all coordinates are whole numbers below 2^50 once they are multiplied.
static bool is_grid(const sli_fans *fans, double scale) {
    const double most = 0x1p50;
    for (size_t i = 0; i < fans->ends.count; i++) {
        const double x = fans->ends.items[i].x * scale, y = fans->ends.items[i].y * scale;
        if (!(fabs(x) < most && fabs(y) < most)) return false;
        if (x != (double)(int64_t)x || y != (double)(int64_t)y) return false;
    }
    return true;
}

/// Finds the grid of the map, if it has one. Most maps are drawn on whole numbers, or on binary
/// fractions with the digits of a node builder. The horizon needs some more digits.
static double find_grid(const sli_fans *fans) {
    const double scales[] = {1, 0x1p6, 0x1p22};
    for (size_t i = 0; i < sizeof scales / sizeof *scales; i++)
        if (is_grid(fans, scales[i])) return scales[i];
    return 0;
}

/// Adds the two ends of the horizon: far to the right and far to the left of everything, and below.
/// From every end the directions above them are a little more than half a turn.
static sl_status add_horizon(sl_context *context, sli_fans *fans) {
    enum { FAR = 64 };
    const sl_box box = fans->bounds;
    const double width = box.max.x - box.min.x, height = box.max.y - box.min.y;
    const double size = width > height ? width : height;
    const double below = box.min.y - size / FAR;
    const sl_point right = {box.max.x + FAR * size, below}, left = {box.min.x - FAR * size, below};
    fans->has_horizon = isfinite(right.x) && isfinite(left.x) && isfinite(below) &&
                        right.x > box.max.x && left.x < box.min.x && below < box.min.y;
    if (!fans->has_horizon) return SL_OK;
    SL_TRY(SL_ARRAY_ROOM(context, &fans->ends, 2));
    add_end(fans, right);
    add_end(fans, left);
    return SL_OK;
}

static sl_status find_middles(sl_context *context, sli_fans *fans) {
    fans->middles = sl_alloc_array(context, fans->cell_count, sizeof *fans->middles);
    if (!fans->middles) return SL_NO_MEMORY;
    for (uint32_t cell = 0; cell < fans->cell_count; cell++) {
        const uint32_t first = fans->first_directed[cell], end = fans->first_directed[cell + 1];
        sl_point sum = {0, 0};
        for (uint32_t i = first; i < end; i++) {
            const sl_point left = fans->ends.items[fans->directed[i].left];
            const sl_point right = fans->ends.items[fans->directed[i].right];
            sum.x += left.x + right.x;
            sum.y += left.y + right.y;
        }
        const double share = end > first ? 0.5 / (end - first) : 0;
        fans->middles[cell] = (sl_point){share * sum.x, share * sum.y};
    }
    return SL_OK;
}

// --- fans

static sl_status add_cell(sl_context *context, sli_fans *fans, sli_fan_cell cell) {
    SL_TRY(SL_ARRAY_ROOM(context, &fans->cells, 1));
    fans->cells.items[fans->cells.count++] = cell;
    return SL_OK;
}

/// Adds the edge with which a fan ends at a wall, or at glass.
static sl_status end_beside(sl_context *context, const walker *w, uint32_t cell, sl_point at,
                            bool back, uint32_t *edge) {
    SL_TRY(SL_ARRAY_ROOM(context, &w->fans->ends, 1));
    *edge = add_end(w->fans, corner_beside(w->space, cell, at, back));
    return SL_OK;
}

/// Says for each edge on which side it lies of half a turn from the first edge, and from the last.
/// Angles only grow, and a sector is half a turn at most. So one orientation test is enough.
static void measure(const sli_fan *fan, const sl_point *ends, sli_fan_cell *cells) {
    const sl_point first = ends[cells[0].edge], last = ends[cells[fan->count].edge];
    int past = -1;
    for (uint32_t i = 1; i <= fan->count; i++) {
        past = past >= 0 ? 1 : -sli_orient(fan->at, first, ends[cells[i].edge]);
        cells[i].past_half = (int8_t)past;
    }
    cells[0].past_half = -1;
    past = 1;
    for (uint32_t i = fan->count; i-- > 0;) {
        past = past <= 0 ? -1 : sli_orient(fan->at, ends[cells[i].edge], last);
        cells[i].past_rest = (int8_t)past;
    }
    cells[fan->count].past_rest = 1;
}

/// Adds the fan of the cells from its first one on, the last edge being there too.
static sl_status add_fan(sl_context *context, sli_fans *fans, sli_fan fan) {
    const sl_point *ends = fans->ends.items;
    sli_fan_cell *cells = fans->cells.items + fan.first;
    fan.count = (uint32_t)fans->cells.count - fan.first - 1;
    measure(&fan, ends, cells);
    const sl_point first = ends[cells[0].edge], last = ends[cells[fan.count].edge];
    const int neighbour = sli_orient(fan.at, first, last);
    const bool same = neighbour == 0 && !sli_opposite(fan.at, first, last);
    fan.wide = !fan.full_turn && cells[fan.count].past_half > 0;
    fan.back_to_back = fan.wide && same;
    SL_TRY(SL_ARRAY_ROOM(context, &fans->fans, 1));
    fans->fans.items[fans->fans.count++] = fan;
    return SL_OK;
}

/// Walks the fan whose point is the left end of a directed portal `at`, from the cell that it
/// leaves. A full turn ends where it starts. If it is `cut` there, a line rotates beside its first
/// edge.
static sl_status walk_round(sl_context *context, walker *w, uint32_t cell, uint32_t at,
                            bool full_turn, bool cut, sl_bits *walked) {
    sli_fans *fans = w->fans;
    const sli_walk_portal *directed = fans->directed;
    const sli_fan fan = {
        .at = left_of(w, at), .first = (uint32_t)fans->cells.count, .full_turn = full_turn && !cut};
    const uint32_t start = at;
    uint32_t begin = portal_after(fans, cell, at), edge = directed[begin].left;
    if (!full_turn) SL_TRY(end_beside(context, w, cell, fan.at, false, &edge));
    for (;;) {
        if (!cut) sl_bits_add(walked, at);
        SL_TRY(add_cell(context, fans, (sli_fan_cell){.cell = cell, .begin = begin, .edge = edge}));
        cell = directed[at].cell;
        begin = directed[at].twin;
        edge = directed[begin].left;
        at = portal_before(fans, cell, begin);
        if (at == start) break;
        if (!sli_same_point(left_of(w, at), fan.at) || is_blocked(w, at)) {
            SL_TRY(add_cell(context, fans,
                            (sli_fan_cell){.cell = cell, .begin = begin, .edge = edge}));
            SL_TRY(end_beside(context, w, cell, fan.at, true, &edge));
            break;
        }
    }
    SL_TRY(add_cell(context, fans, (sli_fan_cell){.cell = UINT32_MAX, .edge = edge}));
    return add_fan(context, fans, fan);
}

/// Between walls, and glass that is blocked to whoever goes round counter-clockwise.
static sl_status walk_between(sl_context *context, walker *w, sl_bits *walked) {
    const sli_fans *fans = w->fans;
    for (uint32_t cell = 0; cell < fans->cell_count; cell++)
        for (uint32_t e = fans->first_directed[cell]; e < fans->first_directed[cell + 1]; e++) {
            const uint32_t next = portal_after(fans, cell, e);
            const bool starts = !sli_same_point(right_of(w, next), left_of(w, e)) ||
                                is_blocked(w, fans->directed[next].twin);
            if (starts && !sl_bits_has(walked, e) && !is_blocked(w, e))
                SL_TRY(walk_round(context, w, cell, e, false, false, walked));
        }
    return SL_OK;
}

/// The remaining fans go all round. With glass that is blocked clockwise, a line that passes its
/// end on one side cannot go on to pass it on the other.
static sl_status walk_all_round(sl_context *context, walker *w, sl_bits *walked) {
    const sli_fans *fans = w->fans;
    for (uint32_t cell = 0; cell < fans->cell_count; cell++)
        for (uint32_t e = fans->first_directed[cell]; e < fans->first_directed[cell + 1]; e++) {
            if (sl_bits_has(walked, e) || is_blocked(w, e)) continue;
            if (!w->blocked || is_blocked(w, portal_after(fans, cell, e)))
                SL_TRY(walk_round(context, w, cell, e, true, w->blocked != NULL, walked));
        }
    return SL_OK;
}

// --- which fan covers which cell

/// A fan, as a candidate to cover cells.
typedef struct candidate {
    uint32_t each; ///< the gain of one cell, less where looking costs more
    uint32_t gain; ///< of all its cells that no fan covers yet
} candidate;

/// Grows with a direction's angle, from 0 to 4: by 1 a quarter turn.
static double quarters(sl_point at, sl_point to) {
    const double x = to.x - at.x, y = to.y - at.y, size = fabs(x) + fabs(y);
    if (y >= 0) return x >= 0 ? y / size : 1 - x / size;
    return x < 0 ? 2 - y / size : 3 + x / size;
}

/// How much of a half turn a fan's point looks at for cells that it covers: what lies above the
/// horizon, and is not looked at for a rotating line anyway.
static double share_above(const sli_fans *fans, const sli_fan *fan) {
    const sli_fan_cell *cells = fans->cells.items + fan->first;
    if (fan->full_turn) return 1;
    double first = quarters(fan->at, fans->ends.items[cells[0].edge]);
    double last = quarters(fan->at, fans->ends.items[cells[fan->count].edge]);
    if (last <= first) last += 4;
    if (fan->wide) {
        const double rest = first + 2;
        first = last > 6 ? last - 6 : last - 2;
        last = last > 6 ? rest - 4 : rest;
    }
    const double above = fmax(fmin(last, 2) - first, 0), above_again = fmax(fmin(last, 6) - 4, 0);
    return (above + above_again) / 2;
}

/// The gain of one cell falls with the cost: the share of a half turn that is looked at.
static uint32_t gain_of_each(const sli_fans *fans, const sli_fan *fan) {
    enum { MOST = 4 };
    return (uint32_t)(MOST / (1 + share_above(fans, fan)));
}

static uint32_t gain_of(const sli_fans *fans, const sli_fan *fan, uint32_t each,
                        const sl_bits *covered) {
    uint32_t waiting = 0;
    for (uint32_t i = 0; i < fan->count; i++)
        waiting += !sl_bits_has(covered, fans->cells.items[fan->first + i].cell);
    return waiting * each;
}

static void cover(sli_fans *fans, sli_fan *fan, sl_bits *covered) {
    for (uint32_t i = 0; i < fan->count; i++) {
        sli_fan_cell *c = &fans->cells.items[fan->first + i];
        c->covered = !sl_bits_has(covered, c->cell);
        fan->covers |= c->covered;
        sl_bits_add(covered, c->cell);
    }
}

/// Greedy set cover: the candidate with the most gain comes first. Gains only fall. So a fan whose
/// gain turns out to be less than that of the round waits for a later round.
static void share_out_by(sli_fans *fans, candidate *candidates, sl_bits *covered) {
    const size_t count = fans->fans.count;
    uint32_t most = 0;
    for (size_t i = 0; i < count; i++) {
        sli_fan *fan = &fans->fans.items[i];
        // Around a single wall, only the cells that the rotating line touches still need expanding.
        if (fan->back_to_back) cover(fans, fan, covered);
        candidates[i].each = gain_of_each(fans, fan);
        candidates[i].gain = gain_of(fans, fan, candidates[i].each, covered);
        if (candidates[i].gain > most) most = candidates[i].gain;
    }
    for (uint32_t now = most; now > 0;) {
        uint32_t next = 0;
        for (size_t i = 0; i < count; i++) {
            candidate *c = &candidates[i];
            sli_fan *fan = &fans->fans.items[i];
            if (c->gain >= now) c->gain = gain_of(fans, fan, c->each, covered);
            if (c->gain >= now) {
                cover(fans, fan, covered);
                c->gain = 0;
            }
            if (c->gain > next) next = c->gain;
        }
        now = next < now ? next : now - 1;
    }
}

static sl_status share_out(sl_context *context, sli_fans *fans) {
    candidate *candidates = sl_alloc_array(context, fans->fans.count, sizeof *candidates);
    sl_bits *covered = sl_alloc_array(context, sl_bits_words(fans->cell_count), sizeof *covered);
    const bool room = candidates && covered;
    if (room) share_out_by(fans, candidates, covered);
    sl_free(context, candidates);
    sl_free(context, covered);
    return room ? SL_OK : SL_NO_MEMORY;
}

/// Drops the fans from which nothing is looked at, and their cells. Cells stand in the order of
/// fans.
static void drop_idle(sl_context *context, sli_fans *fans, sli_fan_way way) {
    sli_fan_cell *cells = fans->cells.items;
    size_t kept = 0, kept_cells = 0;
    for (size_t i = 0; i < fans->fans.count; i++) {
        sli_fan fan = fans->fans.items[i];
        const bool turns = fan.wide && way != SLI_FANS_COVERING;
        if (!turns && !fan.covers) continue;
        memmove(cells + kept_cells, cells + fan.first, ((size_t)fan.count + 1) * sizeof *cells);
        fan.first = (uint32_t)kept_cells;
        kept_cells += (size_t)fan.count + 1;
        fans->fans.items[kept++] = fan;
    }
    fans->fans.count = kept;
    fans->cells.count = kept_cells;
    sli_shrink(context, &fans->fans.items, &fans->fans.capacity, kept, sizeof *fans->fans.items);
    sli_shrink(context, &fans->cells.items, &fans->cells.capacity, kept_cells, sizeof *cells);
}

/// `blocked`: of the space's directed portals, zeroed; NULL for SLI_FANS_MUTUAL.
static sl_status find(sl_context *context, walker *w, const sl_see_options *options,
                      sli_fan_way way, sl_bits *blocked, sl_bits *walked) {
    sli_fans *fans = w->fans;
    SL_TRY(copy_directed(context, w, options, blocked));
    if (way == SLI_FANS_BACK) turn_round(fans, blocked);
    w->blocked = way == SLI_FANS_COVERING ? NULL : blocked;
    SL_TRY(number_ends(context, w));
    SL_TRY(sl_check_cancelled(context));
    SL_TRY(find_middles(context, fans));
    SL_TRY(walk_between(context, w, walked));
    SL_TRY(walk_all_round(context, w, walked));
    SL_TRY(sl_check_cancelled(context));
    if (fans->ends.count) SL_TRY(add_horizon(context, fans));
    fans->grid = find_grid(fans);
    if (way == SLI_FANS_MUTUAL || way == SLI_FANS_COVERING) SL_TRY(share_out(context, fans));
    SL_TRY(sl_check_cancelled(context));
    drop_idle(context, fans, way);
    if (blocked) block_directed(fans, blocked);
    return SL_OK;
}

sl_status sli_fans_find(sl_context *context, const sl_space *space, const sl_see_options *options,
                        sli_fan_way way, sli_fans *fans) {
    walker w = {.space = space, .fans = fans};
    const bool has_blocked = way != SLI_FANS_MUTUAL;
    const size_t words = sl_bits_words(space->directed_count);
    sl_bits *blocked = has_blocked ? sl_alloc_array(context, words, sizeof *blocked) : NULL;
    sl_bits *walked = sl_alloc_array(context, words, sizeof *walked);
    sl_status status = walked && (blocked || !has_blocked) ? SL_OK : SL_NO_MEMORY;
    if (status == SL_OK) status = find(context, &w, options, way, blocked, walked);
    sl_free(context, w.of_space);
    sl_free(context, blocked);
    sl_free(context, walked);
    return status;
}

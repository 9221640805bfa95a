/// Candidates: places to look from.
#include "analysis/placement/placer.h"

#include "geometry/crossing.h"
#include "geometry/length.h"
#include "geometry/orient.h"

#include <math.h>

enum { COARSE_ITERATIONS = 4000, ROWS_AN_ITERATION = 4 };

sl_status sli_try_seeing(sli_placer *p, size_t number, uint32_t witness) {
    sli_candidate *c = &p->candidates.items[number];
    const sl_point at = p->witnesses.items[witness].eye;
    if (!sli_box_holds(&c->look.bounds, at) || !sli_look_holds(&c->look, at)) return SL_OK;
    SL_TRY(SL_ARRAY_ROOM(p->context, &c->sees, 1));
    c->sees.items[c->sees.count++] = witness;
    return SL_OK;
}

sl_status sli_add_candidate(sli_placer *p, sl_point at, uint32_t *number) {
    bool clean;
    at = sli_coordinates(at);
    SL_TRY(sli_nearby_find_at(p->context, &p->candidate_bounds, at));
    for (size_t i = 0; i < p->candidate_bounds.found.count; i++) {
        *number = p->candidate_bounds.found.items[i];
        if (sli_same_point(p->candidates.items[*number].look.eye, at)) return SL_OK;
    }
    SL_TRY(SL_ARRAY_ROOM(p->context, &p->candidates, 1));
    sli_candidate *c = &p->candidates.items[p->candidates.count];
    *c = (sli_candidate){0};
    *number = UINT32_MAX;
    if (p->listed || !sl_space_is_inside(p->ground.space, at)) return SL_OK;
    SL_TRY(sli_look_make(p->context, p->query, &p->memory, at, &c->look, &clean));
    if (!clean) return SL_OK;
    *number = (uint32_t)p->candidates.count++;
    SL_TRY(sli_nearby_add(p->context, &p->candidate_bounds, c->look.bounds));
    SL_TRY(sli_nearby_find(p->context, &p->witness_points, c->look.bounds));
    for (size_t i = 0; i < p->witness_points.found.count; i++)
        SL_TRY(sli_try_seeing(p, *number, p->witness_points.found.items[i]));
    return sli_try_germs(p, *number);
}

const sli_look *sli_chosen_look(const sli_placer *p, size_t i) {
    return &p->candidates.items[p->chosen.items[i]].look;
}

sl_status sli_is_seen(sli_placer *p, sl_point at, bool *seen) {
    const sli_box_list *found = &p->chosen_bounds.found;
    *seen = false;
    SL_TRY(sli_nearby_find_at(p->context, &p->chosen_bounds, at));
    for (size_t i = 0; i < found->count && !*seen; i++)
        *seen = sli_look_holds(sli_chosen_look(p, found->items[i]), at);
    return SL_OK;
}

void sli_choose_none(sli_placer *p) {
    p->chosen.count = 0;
    p->gaps_of = 0;
    sli_nearby_clear(p->context, &p->chosen_bounds);
}

sl_status sli_choose(sli_placer *p, uint32_t candidate) {
    SL_TRY(SL_ARRAY_ROOM(p->context, &p->chosen, 1));
    p->chosen.items[p->chosen.count++] = candidate;
    return sli_nearby_add(p->context, &p->chosen_bounds,
                          p->candidates.items[candidate].look.bounds);
}

sl_status sli_add_corners(sli_placer *p) {
    uint32_t number;
    for (size_t i = 0; i < p->witnesses.count; i++)
        for (uint32_t w = 0; w < p->witnesses.items[i].window_count; w++)
            SL_TRY(sli_add_candidate(p, p->witnesses.items[i].windows[w].apex, &number));
    return SL_OK;
}

static uint32_t count_seers(const sli_placer *p, sl_point at, const uint32_t *entries,
                            size_t count) {
    uint32_t seers = 0;
    for (size_t i = 0; i < count; i++)
        seers += sli_look_holds(&p->witnesses.items[p->active.items[entries[i]]], at);
    return seers;
}

/// A point that sees the witnesses of a column, or as many as can be found.
static sl_point place_of(const sli_placer *p, const sli_place_columns *c, uint32_t column) {
    static const double depths[] = {1,    0.5,  0.25, 0.1,  0.03,  0.01,
                                    1e-3, 1e-4, 1e-6, 1e-8, 1e-11, 0};
    static const double shares[] = {0.5, 0.3, 0.7, 0.1, 0.9, 0, 1};
    const sli_window_part part = c->places.items[column];
    const sli_look *look = &p->witnesses.items[p->active.items[part.look]];
    if (part.window == SLI_NO_WINDOW) return look->eye;
    const size_t first = column ? c->ends.items[column - 1] : 0;
    const size_t count = c->ends.items[column] - first;
    const sli_track t = sli_track_of(look, part.window);
    const double length =
        (part.to - part.from) * sli_length(t.line.b.x - t.line.a.x, t.line.b.y - t.line.a.y);
    sl_point best = t.line.b;
    uint32_t most = count_seers(p, best, c->entries.items + first, count);
    if (most == count) most--; // a corner only if nothing else does
    for (size_t d = 0; d < sizeof depths / sizeof *depths && most < count; d++)
        for (size_t s = 0; s < sizeof shares / sizeof *shares && most < count; s++) {
            const sl_point at = sli_coordinates(sli_track_beside(
                &t, part.from + shares[s] * (part.to - part.from), 1, depths[d] * length));
            if (!sl_space_is_inside(p->ground.space, at)) continue;
            const uint32_t seers = count_seers(p, at, c->entries.items + first, count);
            if (seers > most) most = seers, best = at;
        }
    return best;
}

sl_status sli_add_column(sli_placer *p, const sli_place_columns *c, uint32_t column,
                         uint32_t *number) {
    return sli_add_candidate(p, place_of(p, c, column), number);
}

// --- places on the lines of walls

// Often a viewpoint must stand exactly in line with a wall, as in a door of a wall without
// thickness, or with two corners. Then the places of the lower bound come ever nearer to that line.

/// The wall that a gap's apex hides: of those that end there, the one beyond the window that turns
/// least from it. False where there is none.
static bool find_hidden(const sli_placer *p, const sli_window_part *gap, sl_segment *out) {
    const sli_window *w = &sli_chosen_look(p, gap->look)->windows[gap->window];
    const sl_point eye = sli_chosen_look(p, gap->look)->eye;
    bool found = false;
    size_t count;
    const sli_wall_end *walls = sli_ground_walls_at(&p->ground, w->apex, &count);
    for (size_t i = 0; i < count; i++) {
        const sl_point other = walls[i].other;
        if (sli_orient(eye, w->apex, other) != -w->seen) continue;
        if (found && sli_orient(w->apex, out->b, other) != w->seen) continue;
        *out = (sl_segment){w->apex, other};
        found = true;
    }
    return found;
}

static sl_point foot_of(sl_point at, const sl_segment *line) {
    const sl_point way = {line->b.x - line->a.x, line->b.y - line->a.y};
    const double share =
        sli_dot((sl_point){at.x - line->a.x, at.y - line->a.y}, way) / sli_dot(way, way);
    return (sl_point){line->a.x + share * way.x, line->a.y + share * way.y};
}

/// Where two lines meet, if that is nearer to a point than a share of its distance from the apex.
static bool meet_near(sl_point eye, const sl_segment *s, const sl_segment *t, sl_point *out) {
    const double share = 0.1;
    const sl_point u = {s->b.x - s->a.x, s->b.y - s->a.y}, v = {t->b.x - t->a.x, t->b.y - t->a.y};
    const sl_point apex = {s->a.x - eye.x, s->a.y - eye.y};
    const double off_line = sli_cross((sl_point){t->a.x - eye.x, t->a.y - eye.y}, v);
    const double near = share * share * sli_dot(apex, apex);
    // Most lines pass far from the eye, with a margin for rounding: this shows it soon.
    if (off_line * off_line > 2 * near * sli_dot(v, v)) return false;
    if (sli_turn(s->a, s->b, t->a, t->b) == 0) return false;
    const double along =
        sli_cross((sl_point){t->a.x - s->a.x, t->a.y - s->a.y}, v) / sli_cross(u, v);
    const sl_point off = {s->a.x + along * u.x - eye.x, s->a.y + along * u.y - eye.y};
    if (!(sli_dot(off, off) < near)) return false;
    *out = sli_crossing(*s, *t);
    return true;
}

/// The point of a line nearest to another one; where that is not on the line as rounded, one near
/// it whose share of the way has few bits, which may be.
static sl_point foot_on(sl_point at, const sl_segment *line) {
    const sl_point foot = foot_of(at, line);
    const sl_point way = {line->b.x - line->a.x, line->b.y - line->a.y};
    const double share =
        sli_dot((sl_point){at.x - line->a.x, at.y - line->a.y}, way) / sli_dot(way, way);
    if (sli_orient(line->a, line->b, foot) == 0) return foot;
    for (double bits = 0x1p30; bits >= 0x1p4; bits /= 4) {
        const double few = rint(share * bits) / bits;
        const sl_point on = {line->a.x + few * way.x, line->a.y + few * way.y};
        if (sli_orient(line->a, line->b, on) == 0) return on;
    }
    return foot;
}

/// Remembers a line.
static sl_status keep_line(sli_placer *p, sl_segment line) {
    SL_TRY(sli_nearby_find_at(p->context, &p->line_starts, line.a));
    for (size_t i = 0; i < p->line_starts.found.count; i++)
        if (sli_same_point(p->lines.items[p->line_starts.found.items[i]].b, line.b)) return SL_OK;
    SL_TRY(SL_ARRAY_ROOM(p->context, &p->lines, 1));
    p->lines.items[p->lines.count++] = line;
    return sli_nearby_add(p->context, &p->line_starts, (sl_box){line.a, line.a});
}

/// Whether a window ends nearly in a corner of its wall: then the viewpoint may have to stand in
/// line with both corners.
static bool ends_at(const sli_look *look, const sli_window *w, sl_point corner) {
    const double few = 1e-3;
    const sl_point a = {w->apex.x - look->eye.x, w->apex.y - look->eye.y};
    const sl_point b = {corner.x - w->apex.x, corner.y - w->apex.y};
    const double along = sli_dot(a, b);
    return along > 0 && fabs(sli_cross(a, b)) < few * along;
}

/// Of the lines so far, those that matter begin at an apex that a look may see: by its bounds.
static sl_status add_on_line(sli_placer *p, const sli_look *look, sl_segment line) {
    sl_point meet;
    uint32_t number;
    SL_TRY(sli_add_candidate(p, foot_on(look->eye, &line), &number));
    SL_TRY(sli_nearby_find(p->context, &p->line_starts, look->bounds));
    for (size_t k = 0; k < p->line_starts.found.count; k++)
        if (meet_near(look->eye, &line, &p->lines.items[p->line_starts.found.items[k]], &meet))
            SL_TRY(sli_add_candidate(p, meet, &number));
    return keep_line(p, line);
}

sl_status sli_add_in_line(sli_placer *p) {
    for (size_t i = 0; i < p->gaps.count && !p->listed; i++) {
        const sli_look look = *sli_chosen_look(p, p->gaps.items[i].look);
        const sli_window w = look.windows[p->gaps.items[i].window];
        sl_segment line;
        SL_TRY(sl_check_cancelled(p->context));
        if (find_hidden(p, &p->gaps.items[i], &line)) SL_TRY(add_on_line(p, &look, line));
        const sl_point corners[] = {w.wall.a, w.wall.b};
        for (int k = 0; k < 2; k++)
            if (!sli_same_point(corners[k], w.apex) && ends_at(&look, &w, corners[k]))
                SL_TRY(add_on_line(p, &look, (sl_segment){w.apex, corners[k]}));
    }
    return SL_OK;
}

// --- choosing

sl_cover_options sli_cover_options(const sli_placer *p) {
    sl_cover_options options = sl_cover_options_default();
    options.program = p->options->program;
    options.nodes = p->coarse ? 0 : p->options->nodes;
    // Prices of more rows take longer to settle.
    if (p->coarse) options.iterations = COARSE_ITERATIONS + p->active.count / ROWS_AN_ITERATION;
    // Rows are only added, so earlier bounds hold.
    options.known_lower = p->out->lower;
    return options;
}

sl_status sli_fail_unseen(const sli_placer *p, sl_point at) {
    const int digits = sl_map_digits(sl_query_map(p->query));
    return sl_fail(p->context, SL_BAD_ARGUMENT, "(%.*g, %.*g) is seen from none of the places",
                   digits, at.x, digits, at.y);
}

/// Candidates for witnesses that none of them sees.
static sl_status complete(sli_placer *p) {
    bool *seen = sl_alloc_array(p->context, p->witnesses.count, sizeof *seen);
    sl_status status = seen ? SL_OK : SL_NO_MEMORY;
    for (size_t i = 0; seen && i < p->candidates.count; i++)
        for (size_t k = 0; k < p->candidates.items[i].sees.count; k++)
            seen[p->candidates.items[i].sees.items[k]] = true;
    const size_t count = p->witnesses.count;
    for (size_t i = 0; status == SL_OK && i < count; i++) {
        uint32_t number;
        if (seen[i]) continue;
        const sl_point at = p->witnesses.items[i].eye;
        status = p->listed ? sli_fail_unseen(p, at) : sli_add_candidate(p, at, &number);
    }
    sl_free(p->context, seen);
    return status;
}

sl_status sli_choose_fewest(sli_placer *p, sl_cover_problem *problem, sl_cover_result *cover) {
    SL_TRY(complete(p));
    size_t entries = 0;
    const uint32_t witnesses = (uint32_t)p->witnesses.count;
    for (size_t i = 0; i < p->candidates.count; i++)
        entries += p->candidates.items[i].sees.count + p->candidates.items[i].germs.count;
    size_t *ends = sl_alloc_array(p->context, p->candidates.count, sizeof *ends);
    uint32_t *all = sl_alloc_array(p->context, entries, sizeof *all);
    *problem = (sl_cover_problem){
        witnesses + (uint32_t)p->germs.count, (uint32_t)p->candidates.count, ends, all, NULL, NULL};
    if (!ends || !all) return SL_NO_MEMORY;
    entries = 0;
    for (size_t i = 0; i < p->candidates.count; i++) {
        for (size_t k = 0; k < p->candidates.items[i].sees.count; k++)
            all[entries++] = p->candidates.items[i].sees.items[k];
        for (size_t k = 0; k < p->candidates.items[i].germs.count; k++)
            all[entries++] = witnesses + p->candidates.items[i].germs.items[k];
        ends[i] = entries;
    }
    sl_cover_options options = sli_cover_options(p);
    if (p->coarse) options.program = NULL; // a bound of these candidates bounds nothing
    SL_TRY(sl_cover_solve(p->context, problem, &options, cover));
    sli_choose_none(p);
    for (uint32_t i = 0; i < cover->count; i++) SL_TRY(sli_choose(p, cover->columns[i]));
    return SL_OK;
}

void sli_choice_destroy(sl_context *context, sl_cover_problem *problem, sl_cover_result *cover) {
    sl_free(context, (void *)(uintptr_t)problem->ends);
    sl_free(context, (void *)(uintptr_t)problem->entries);
    sl_cover_result_destroy(context, cover);
}

/// Adds to counts how many of the chosen ones see a witness, or a germ: by `sign`.
static void count_seen(const sli_candidate *c, int sign, int *witnesses, int *germs) {
    for (size_t k = 0; k < c->sees.count; k++) witnesses[c->sees.items[k]] += sign;
    for (size_t k = 0; k < c->germs.count; k++) germs[c->germs.items[k]] += sign;
}

/// Whether others see all that a chosen one does.
static bool is_redundant(const sli_candidate *c, const int *witnesses, const int *germs) {
    bool redundant = true;
    for (size_t k = 0; k < c->sees.count && redundant; k++)
        redundant = witnesses[c->sees.items[k]] > 1;
    for (size_t k = 0; k < c->germs.count && redundant; k++)
        redundant = germs[c->germs.items[k]] > 1;
    return redundant;
}

sl_status sli_drop_redundant(sli_placer *p, bool *dropped) {
    const size_t before = p->chosen.count;
    int *witnesses = sl_alloc_array(p->context, p->witnesses.count, sizeof *witnesses);
    int *germs = sl_alloc_array(p->context, p->germs.count, sizeof *germs);
    uint32_t *all = sl_alloc_array(p->context, before, sizeof *all);
    sl_status status = witnesses && germs && all ? SL_OK : SL_NO_MEMORY;
    for (size_t i = 0; status == SL_OK && i < before; i++) {
        all[i] = p->chosen.items[i];
        count_seen(&p->candidates.items[all[i]], 1, witnesses, germs);
    }
    if (status == SL_OK) sli_choose_none(p);
    for (size_t i = 0; status == SL_OK && i < before; i++) {
        const sli_candidate *c = &p->candidates.items[all[i]];
        if (is_redundant(c, witnesses, germs))
            count_seen(c, -1, witnesses, germs);
        else
            status = sli_choose(p, all[i]);
    }
    *dropped = p->chosen.count < before;
    sl_free(p->context, witnesses);
    sl_free(p->context, germs);
    sl_free(p->context, all);
    return status;
}

/// Germs: what a gap leaves unseen where no double is. Just beyond a window there is always some
/// room, but it may be thinner than the distance of doubles, as where a viewpoint must stand in
/// line with two walls. No witness fits in there, and none is needed for the upper bound: a germ is
/// "what is just beyond this window, there", and spans tell exactly who sees it.
///
/// Where the window's apex stands as a viewpoint, it looks along the window and sees the germ. So
/// candidates that see all germs can always be found.
#include "analysis/placement/placer.h"

#include "base/heap.h"
#include "geometry/length.h"
#include "geometry/orient.h"
#include "space/index.h"

#include <math.h>

/// Notes a germ where a candidate sees it. Its middle is rounded, so this is only nearly exact:
/// what is unseen in the end, gaps tell.
static sl_status try_germ(sli_placer *p, size_t number, uint32_t germ) {
    const sli_germ *g = &p->germs.items[germ];
    sli_candidate *c = &p->candidates.items[number];
    bool sees = false;
    if (!sli_box_holds(&c->look.bounds, g->at)) return SL_OK;
    SL_TRY(sli_track_spans(p->context, &g->track, &c->look, true, &p->spans));
    for (size_t i = 0; i < p->spans.count && !sees; i++)
        sees = sli_spot_share(&p->spans.items[i].from) <= g->share &&
               sli_spot_share(&p->spans.items[i].to) >= g->share;
    if (!sees) return SL_OK;
    SL_TRY(SL_ARRAY_ROOM(p->context, &c->germs, 1));
    c->germs.items[c->germs.count++] = germ;
    return SL_OK;
}

sl_status sli_try_germs(sli_placer *p, size_t candidate) {
    const sl_box bounds = p->candidates.items[candidate].look.bounds;
    SL_TRY(sli_nearby_find(p->context, &p->germ_points, bounds));
    for (size_t i = 0; i < p->germ_points.found.count; i++)
        SL_TRY(try_germ(p, candidate, p->germ_points.found.items[i]));
    return SL_OK;
}

sl_status sli_add_germ(sli_placer *p, const sli_window_part *gap, bool *added) {
    sli_germ germ = {.track = sli_track_of(sli_chosen_look(p, gap->look), gap->window),
                     .share = gap->from + (gap->to - gap->from) / 2};
    uint32_t number;
    germ.at = sli_track_at(&germ.track, germ.share);
    *added = false;
    SL_TRY(sli_nearby_find_at(p->context, &p->germ_points, germ.at));
    for (size_t i = 0; i < p->germ_points.found.count; i++) {
        const sli_germ *g = &p->germs.items[p->germ_points.found.items[i]];
        if (g->share == germ.share && g->track.seen == germ.track.seen &&
            sli_same_point(g->track.line.a, germ.track.line.a) &&
            sli_same_point(g->track.line.b, germ.track.line.b))
            return SL_OK;
    }
    if (!p->listed) SL_TRY(sli_add_candidate(p, germ.track.line.b, &number));
    SL_TRY(SL_ARRAY_ROOM(p->context, &p->germs, 1));
    p->germs.items[p->germs.count] = germ;
    SL_TRY(sli_nearby_find_at(p->context, &p->candidate_bounds, germ.at));
    for (size_t i = 0; i < p->candidate_bounds.found.count; i++) {
        const uint32_t candidate = p->candidate_bounds.found.items[i];
        const size_t before = p->candidates.items[candidate].germs.count;
        SL_TRY(try_germ(p, candidate, (uint32_t)p->germs.count));
        *added = *added || p->candidates.items[candidate].germs.count > before;
    }
    if (!*added) return SL_OK;
    p->germs.count++;
    return sli_nearby_add(p->context, &p->germ_points, (sl_box){germ.at, germ.at});
}

/// How many unseen germs a candidate sees at most: those seen since then are not yet taken off.
typedef struct gain {
    size_t germs;
    uint32_t candidate;
} gain;

static bool is_greater(const gain *a, const gain *b) {
    return a->germs != b->germs ? a->germs > b->germs : a->candidate < b->candidate;
}

SLI_HEAP(gain_heap, gain, is_greater)

/// Greedy: the candidate that sees most of the germs from `first` on that are not seen, as long as
/// there is one. Gains only fall, so one at the top of the heap that is up to date is the greatest
/// (Minoux 1978).
static sl_status choose_for(sli_placer *p, size_t first, bool *seen, gain_heap *heap) {
    for (uint32_t i = 0; i < p->candidates.count; i++) {
        const sli_candidate *c = &p->candidates.items[i];
        const size_t count = c->germs.count;
        if (count && c->germs.items[count - 1] >= first)
            SL_TRY(gain_heap_push(p->context, heap, ((gain){count, i})));
    }
    while (heap->count) {
        SL_TRY(sl_check_cancelled(p->context));
        const gain top = gain_heap_pop(heap);
        const sli_candidate *c = &p->candidates.items[top.candidate];
        size_t germs = 0;
        for (size_t k = c->germs.count; k && c->germs.items[k - 1] >= first; k--)
            germs += !seen[c->germs.items[k - 1]];
        if (germs < top.germs) {
            if (germs) SL_TRY(gain_heap_push(p->context, heap, ((gain){germs, top.candidate})));
        } else if (germs) {
            SL_TRY(sli_choose(p, top.candidate));
            for (size_t k = 0; k < c->germs.count; k++) seen[c->germs.items[k]] = true;
        }
    }
    return SL_OK;
}

/// Chooses a candidate, if it is one, and not chosen. *number as in sli_add_candidate().
static sl_status choose_place(sli_placer *p, sl_point at, bool *is_new, uint32_t *number) {
    SL_TRY(sli_add_candidate(p, at, number));
    *is_new = *number != UINT32_MAX;
    for (size_t k = 0; k < p->chosen.count; k++) *is_new = *is_new && p->chosen.items[k] != *number;
    return *is_new ? sli_choose(p, *number) : SL_OK;
}

static sl_status choose_new(sli_placer *p, sl_point at, bool *is_new) {
    uint32_t number;
    return choose_place(p, at, is_new, &number);
}

/// Chooses the middle of a cell at a gap, if one is not chosen. Else none of what is beyond the gap
/// is unseen: a cell is seen from its middle. *closed: each cell there has one. SLACK, of the map's
/// size, is far more than what rounding moves a spot by; cells beside those at the gap cost
/// viewpoints at most.
static sl_status choose_near_cell(sli_placer *p, const sli_track *track, const sli_window_part *gap,
                                  bool *closed) {
    static const double SLACK = 1e-6;
    const sl_space *space = p->ground.space;
    const sl_box *all = &space->bounds;
    const double slack = SLACK * fmax(all->max.x - all->min.x, all->max.y - all->min.y);
    sl_box box = sli_box_around(sli_track_at(track, gap->from), sli_track_at(track, gap->to));
    box = sli_box_with(box, (sl_point){box.min.x - slack, box.min.y - slack});
    box = sli_box_with(box, (sl_point){box.max.x + slack, box.max.y + slack});
    bool done = false;
    for (uint32_t c = 0; c < space->cell_count && !done; c++) {
        const sl_box cell = sli_box_of_cell(space, c);
        if (!space->cells[c].inside || !sli_boxes_meet(&box, &cell)) continue;
        uint32_t number;
        SL_TRY(choose_place(p, sl_space_middle(space, c), &done, &number));
        if (number == UINT32_MAX) *closed = false;
    }
    return SL_OK;
}

/// Chooses the apex of a gap. One that is chosen, or cannot be, stands behind walls that meet
/// there: then what is beyond the gap. Where no double is there, places before it, ever farther
/// off; and at last, or at once where the gap ends where it begins but for rounding, the middle of
/// a cell.
static sl_status choose_at_gap(sli_placer *p, const sli_window_part *gap, bool *closed) {
    static const double depths[] = {0, 1e-9, 1e-6, 1e-3, 0.1};
    const sli_track track = sli_track_of(sli_chosen_look(p, gap->look), gap->window);
    const sl_point apex = track.line.b;
    const double length = sli_length(track.far.x - apex.x, track.far.y - apex.y);
    const double middle = (gap->from + gap->to) / 2;
    bool done;
    SL_TRY(choose_new(p, apex, &done));
    if (done) return SL_OK;
    const bool thin = nextafter(gap->from, gap->to) >= gap->to;
    if (!thin) SL_TRY(sli_add_beyond(p, gap, &done));
    if (done) SL_TRY(choose_new(p, p->witnesses.items[p->witnesses.count - 1].eye, &done));
    for (size_t i = 0; i < sizeof depths / sizeof *depths && !thin && !done; i++)
        SL_TRY(choose_new(p, sli_track_beside(&track, middle, 1, depths[i] * length), &done));
    return done ? SL_OK : choose_near_cell(p, &track, gap, closed);
}

sl_status sli_choose_for_gaps(sli_placer *p, bool *more, bool *closed) {
    const size_t before = p->chosen.count, first = p->germs.count;
    bool one;
    *closed = true;
    for (size_t i = 0; i < p->gaps.count; i++) SL_TRY(sli_add_germ(p, &p->gaps.items[i], &one));
    bool *seen = sl_alloc_array(p->context, p->germs.count, sizeof *seen);
    if (!seen) return SL_NO_MEMORY;
    gain_heap heap = {0};
    sl_status status = choose_for(p, first, seen, &heap);
    sl_free(p->context, heap.items);
    sl_free(p->context, seen);
    // Gaps that had germs before.
    for (size_t i = 0; status == SL_OK && p->chosen.count == before && i < p->gaps.count; i++)
        status = choose_at_gap(p, &p->gaps.items[i], closed);
    *more = p->chosen.count > before;
    return status;
}

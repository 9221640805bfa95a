/// Gaps: is everything seen?
///
/// The border of what nobody sees runs along walls and windows. So where some of a part of the plan
/// is seen, all of it is if nothing is unseen just beyond any window. On the window's line that is
/// a union of spans:
///
///      apex ===[ seen by 2 ]====[  seen by 5  ]------ gap ------ far
///
/// Spans that meet in one spot leave nothing out but that. Walls along the window, and what is not
/// inside, need not be seen.
///
/// More looks only see more: of windows that were looked at before, those with gaps are enough.
#include "analysis/placement/gaps.h"

#include "geometry/orient.h"

typedef struct gap_finder {
    sl_context *context;
    const sli_ground *ground;
    const sli_look *const *looks;
    uint32_t count;
    sli_spans spans, one;
    sli_nearby *near;   ///< bounds of looks
    sli_box_list found; ///< walls or cells near a window
    sli_window_parts *out;
} gap_finder;

static sl_status add_span(gap_finder *g, const sl_segment *line, sli_spot a, sli_spot b) {
    SL_TRY(SL_ARRAY_ROOM(g->context, &g->spans, 1));
    g->spans.items[g->spans.count++] =
        sli_spot_order(line, &a, &b) < 0 ? (sli_span){a, b} : (sli_span){b, a};
    return SL_OK;
}

/// A wall along a window is a border of what is beyond.
static sl_status add_wall_spans(gap_finder *g, const sli_track *track) {
    const sl_segment *line = &track->line;
    const sl_box box = sli_track_box(track, &g->ground->space->bounds);
    SL_TRY(sli_box_tree_find(g->context, &g->ground->walls, &box, &g->found));
    for (size_t i = 0; i < g->found.count; i++) {
        const sl_wall *w = &g->ground->space->walls[g->found.items[i]];
        if (sli_orient(line->a, line->b, w->a) || sli_orient(line->a, line->b, w->b)) continue;
        SL_TRY(add_span(g, line, sli_spot_of_point(line, w->a), sli_spot_of_point(line, w->b)));
    }
    return SL_OK;
}

/// The part of a track beyond which a cell is: none where the cell is not at that side.
static sl_status add_cell_span(gap_finder *g, const sli_track *track, const sl_cell *cell) {
    const sl_segment *line = &track->line;
    const sl_point *corners = g->ground->space->vertices + cell->first_vertex;
    sli_spot ends[2];
    int count = 0;
    bool beyond = false;
    for (uint32_t i = 0; i < cell->vertex_count; i++) {
        const sl_point p = corners[i], q = corners[(i + 1) % cell->vertex_count];
        const int at = sli_orient(line->a, line->b, p), next = sli_orient(line->a, line->b, q);
        beyond = beyond || at == -track->seen;
        if (at != 0 && at * next >= 0) continue;
        const sli_spot spot =
            at ? sli_spot_of_line(line, (sl_segment){p, q}) : sli_spot_of_point(line, p);
        if (count == 2 && sli_spot_order(line, &spot, &ends[0]) < 0)
            ends[0] = spot;
        else if (count == 2 && sli_spot_order(line, &spot, &ends[1]) > 0)
            ends[1] = spot;
        else if (count < 2)
            ends[count++] = spot;
        if (count == 2 && sli_spot_order(line, &ends[0], &ends[1]) > 0) {
            const sli_spot swap = ends[0];
            ends[0] = ends[1];
            ends[1] = swap;
        }
    }
    return beyond && count == 2 ? add_span(g, line, ends[0], ends[1]) : SL_OK;
}

/// What is not inside need not be seen.
static sl_status add_outside_spans(gap_finder *g, const sli_track *track) {
    const sl_space *space = g->ground->space;
    const sl_box box = sli_track_box(track, &space->bounds);
    SL_TRY(sli_box_tree_find(g->context, &g->ground->outside, &box, &g->found));
    for (size_t i = 0; i < g->found.count; i++)
        SL_TRY(add_cell_span(g, track, &space->cells[g->ground->outer[g->found.items[i]]]));
    return SL_OK;
}

static void sort_spans(const sl_segment *line, sli_spans *spans) {
    for (size_t i = 1; i < spans->count; i++) {
        const sli_span span = spans->items[i];
        size_t k = i;
        for (; k && sli_spot_order(line, &spans->items[k - 1].from, &span.from) > 0; k--)
            spans->items[k] = spans->items[k - 1];
        spans->items[k] = span;
    }
}

/// Lists what the spans leave of a track; where the part names no look, only tells if there is any.
static sl_status list_gaps(gap_finder *g, const sli_track *track, sli_window_part part, bool *any) {
    const sl_segment *line = &track->line;
    sli_spot reached = track->start;
    sort_spans(line, &g->spans);
    *any = false;
    for (size_t i = 0; i <= g->spans.count; i++) {
        const sli_spot *next = i < g->spans.count ? &g->spans.items[i].from : &track->end;
        if (sli_spot_order(line, next, &track->end) > 0) next = &track->end;
        if (sli_spot_order(line, next, &reached) > 0) {
            *any = true;
            if (part.look == UINT32_MAX) return SL_OK;
            SL_TRY(SL_ARRAY_ROOM(g->context, g->out, 1));
            part.from = sli_spot_share(&reached);
            part.to = sli_spot_share(next);
            g->out->items[g->out->count++] = part;
        }
        if (i < g->spans.count && sli_spot_order(line, &g->spans.items[i].to, &reached) > 0)
            reached = g->spans.items[i].to;
    }
    return SL_OK;
}

static sl_status check_window(gap_finder *g, uint32_t mine, uint32_t window) {
    const sli_track track = sli_track_of(g->looks[mine], window);
    bool any;
    g->spans.count = 0;
    SL_TRY(sli_nearby_find(g->context, g->near, sli_track_box(&track, &g->ground->space->bounds)));
    for (size_t k = 0; k < g->near->found.count; k++) {
        const uint32_t j = g->near->found.items[k];
        if (j == mine) continue;
        SL_TRY(sli_track_spans(g->context, &track, g->looks[j], true, &g->one));
        SL_TRY(SL_ARRAY_ROOM(g->context, &g->spans, g->one.count));
        for (size_t i = 0; i < g->one.count; i++)
            g->spans.items[g->spans.count++] = g->one.items[i];
    }
    SL_TRY(list_gaps(g, &track, (sli_window_part){UINT32_MAX, 0, 0, 0}, &any));
    if (!any) return SL_OK;
    SL_TRY(add_wall_spans(g, &track));
    SL_TRY(add_outside_spans(g, &track));
    return list_gaps(g, &track, (sli_window_part){mine, window, 0, 0}, &any);
}

static sl_status find_gaps(gap_finder *g, uint32_t known, const sli_window_parts *before) {
    for (size_t i = 0; i < before->count; i++) {
        const sli_window_part *gap = &before->items[i];
        if (i && gap->look == gap[-1].look && gap->window == gap[-1].window) continue;
        SL_TRY(check_window(g, gap->look, gap->window));
    }
    for (uint32_t i = known; i < g->count; i++) {
        SL_TRY(sl_check_cancelled(g->context));
        for (uint32_t w = 0; w < g->looks[i]->window_count; w++) SL_TRY(check_window(g, i, w));
    }
    return SL_OK;
}

sl_status sli_gaps_find(sl_context *context, const sli_ground *ground, const sli_look *const *looks,
                        uint32_t count, sli_nearby *bounds, uint32_t known,
                        sli_window_parts *gaps) {
    sli_window_parts before = *gaps;
    if (known && known == count) return SL_OK;
    *gaps = (sli_window_parts){0};
    if (!known) before.count = 0;
    gap_finder g = {.context = context,
                    .ground = ground,
                    .looks = looks,
                    .count = count,
                    .near = bounds,
                    .out = gaps};
    const sl_status status = find_gaps(&g, known, &before);
    sl_free(context, before.items);
    sl_free(context, g.spans.items);
    sl_free(context, g.one.items);
    sl_free(context, g.found.items);
    return status;
}

/// Lines to be seen, each point of them: routes, doors.
///
///      o---------+======+======+-----o    line
///                 \     |  B  /
///                  \    | /  /
///                 A \   /   /
///                    o     o
///
/// Borders of views, ranges and dead zones cut a line into pieces. Within a piece it does not
/// change who sees it, so its middle is the row of a set cover, and there are no other rows.
///
/// Where they cut is rounded; who sees a middle is exact, up to the true ranges. Pieces that are
/// thinner than rounding are left out (path_cut.h). One place must see a point, so a piece counts
/// only where no piece that came just before is seen by fewer.
#include "analysis/placement/path_cut.h"
#include "analysis/placement/place_area.h"

#include <math.h>
#include <stdlib.h>

typedef struct liner {
    sli_area *a;
    size_t line;
    size_t first_row; ///< of the line
    SL_ARRAY(sl_blind_spot) blind;
} liner;

bool sli_area_has_only_lines(const sli_area *a) {
    return a->task->line_count && !a->task->see;
}

/// Whether a place may reach the box of a segment.
static bool may_reach(const sli_area *a, uint32_t place, sl_point p, sl_point q) {
    sl_box box = a->boxes[place];
    const sl_point at = a->task->places[place].at;
    const double range = a->ranges[place];
    if (range > 0) box = (sl_box){{at.x - range, at.y - range}, {at.x + range, at.y + range}};
    return fmin(p.x, q.x) <= box.max.x && fmax(p.x, q.x) >= box.min.x &&
           fmin(p.y, q.y) <= box.max.y && fmax(p.y, q.y) >= box.min.y;
}

static sl_status cut(sli_path_cut *c, sl_point p, sl_point q) {
    const sli_area *a = ((liner *)c->of)->a;
    const sl_shape walls = sli_view_shape(&a->shapes, 0);
    SL_TRY(sli_cut_by_shape(c, p, q, &walls));
    for (uint32_t i = 0; i < a->task->place_count; i++) {
        const sl_viewpoint *place = &a->task->places[i];
        if (!may_reach(a, i, p, q)) continue;
        const sl_shape shape = sli_view_shape(&a->shapes, i + 1);
        SL_TRY(sli_cut_by_shape(c, p, q, &shape));
        SL_TRY(sli_cut_by_circle(c, p, q, place->at, a->ranges[i]));
        SL_TRY(sli_cut_by_circle(c, p, q, place->at, place->nearest));
    }
    return SL_OK;
}

/// Whether all places of one ascending list are in another.
static bool holds_all(const uint32_t *list, size_t count, const uint32_t *of, size_t of_count) {
    size_t k = 0;
    for (size_t i = 0; i < of_count; i++) {
        while (k < count && list[k] < of[i]) k++;
        if (k == count || list[k] != of[i]) return false;
    }
    return true;
}

/// Makes a->row a row, unless all that see the last one see this. Drops the last one if all that
/// see this see it.
static sl_status add_row(liner *l, sl_point at, double length) {
    sli_area *a = l->a;
    const size_t rows = a->row_ends.count;
    if (a->cover == 1 && !a->task->count && rows > l->first_row) {
        const size_t from = rows > 1 ? a->row_ends.items[rows - 2] : 0;
        const uint32_t *last = a->entries.items + from;
        const size_t count = a->entries.count - from;
        if (holds_all(a->row.items, a->row.count, last, count)) return SL_OK;
        if (holds_all(last, count, a->row.items, a->row.count)) {
            a->entries.count = from;
            a->row_ends.count--;
            a->witnesses.count--;
        }
    }
    SL_TRY(sli_area_add_row(a, at));
    if (!a->task->count) return SL_OK;
    const double weight = a->task->line_weights ? a->task->line_weights[l->line] : 1;
    SL_TRY(SL_ARRAY_ROOM(a->context, &a->lengths, 1));
    a->lengths.items[a->lengths.count++] = weight * length;
    return SL_OK;
}

/// Makes the piece with this middle a row, if somebody sees it. *blind: too few do.
static sl_status look_at(sli_path_cut *c, sl_point at, bool *blind) {
    liner *l = c->of;
    sli_area *a = l->a;
    *blind = false;
    if (!sl_space_is_inside(a->space, at)) return SL_OK;
    SL_TRY(sli_area_look(a, at));
    // Pieces end at the true range, so what is beyond its chords is as sure.
    for (size_t i = 0; i < a->row.count; i++) a->row.items[i] &= ~SLI_WIDE;
    a->out->line_lengths[l->line] += c->piece;
    *blind = a->row.count < a->cover;
    return a->row.count ? add_row(l, at, c->piece) : SL_OK;
}

static sl_status add_blind(liner *l, const sl_path_part *part) {
    const sl_point p = part->start, q = part->end;
    SL_TRY(SL_ARRAY_ROOM(l->a->context, &l->blind, 1));
    l->blind.items[l->blind.count++] = (sl_blind_spot){
        .area = part->to - part->from,
        .at = {p.x + (q.x - p.x) / 2, p.y + (q.y - p.y) / 2},
        .bounds = {{fmin(p.x, q.x), fmin(p.y, q.y)}, {fmax(p.x, q.x), fmax(p.y, q.y)}}};
    return SL_OK;
}

static sl_status add_line(liner *l) {
    sli_area *a = l->a;
    const sl_segment *line = &a->task->lines[l->line];
    const sl_point ends[2] = {line->a, line->b};
    sli_path_cut c = {
        .context = a->context, .space = a->space, .cut = cut, .holds = look_at, .of = l};
    sl_path_parts parts;
    l->first_row = a->row_ends.count;
    SL_TRY(sli_path_parts(&c, ends, 2, &parts));
    sl_status status = SL_OK;
    for (size_t i = 0; i < parts.count && status == SL_OK; i++)
        status = add_blind(l, &parts.parts[i]);
    sl_path_parts_destroy(a->context, &parts);
    return status;
}

static sl_status add_lines(liner *l) {
    sli_area *a = l->a;
    sl_area_placement *out = a->out;
    out->line_lengths = sl_alloc_array(a->context, a->task->line_count, sizeof *out->line_lengths);
    if (!out->line_lengths) return SL_NO_MEMORY;
    double length = 0;
    for (l->line = 0; l->line < a->task->line_count; l->line++) {
        sl_report(a->context, "views", "lines", l->line, a->task->line_count);
        SL_TRY(add_line(l));
        const double weight = a->task->line_weights ? a->task->line_weights[l->line] : 1;
        length += weight * out->line_lengths[l->line];
    }
    if (!(length > 0))
        return sl_fail(a->context, SL_BAD_ARGUMENT, "nothing of the lines to be seen is inside");
    if (!sli_area_has_only_lines(a)) return SL_OK;
    if (l->blind.count)
        qsort(l->blind.items, l->blind.count, sizeof *l->blind.items, sli_blind_spots_compare);
    for (size_t i = 0; i < l->blind.count; i++) out->blind_area += l->blind.items[i].area;
    out->blind = l->blind.items;
    out->blind_count = (uint32_t)l->blind.count;
    l->blind.items = NULL;
    out->area = length;
    out->seen = length - out->blind_area;
    return SL_OK;
}

sl_status sli_area_lines(sli_area *a) {
    liner l = {.a = a};
    const sl_status status = add_lines(&l);
    sl_free(a->context, l.blind.items);
    return status;
}

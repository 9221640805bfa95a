/// Hatching by clips: programs hatch an area with long oblique lines, and a clip shows them within
/// the area alone. One line that leaves its clip may be a wall at the edge of a page. So hatching
/// is a set of lines side by side, one after the other in the file. They share a clip, or each has
/// its own, smaller than the page and the plan.
///
/// Each line that may belong to such a set gets the group of hatching as it is drawn, in a run of
/// its own. Once all is drawn, lines of no set go back to their own groups.
#include "geometry/length.h"
#include "geometry/orient.h"
#include "io/svg/svg.h"

#include <math.h>

/// So many lines side by side are hatching, and so far their directions may differ, as a sine.
enum { FEWEST = 3 };
#define PARALLEL 0x1p-8

/// Whether a shape may be a piece of hatching: an oblique line or bar, half as long as its clip at
/// least, that goes out of it; a bar at both ends. `along`: the longest side.
static bool may_be_hatching(const sl_map *map, const sl_box *clip, size_t first, sl_point *along) {
    const double least = sli_length(clip->max.x - clip->min.x, clip->max.y - clip->min.y) / 2;
    double longest = 0;
    size_t within = 0;
    for (size_t i = first; i < map->wall_count; i++) {
        const sl_point a = map->walls[i].a, b = map->walls[i].b;
        const double length = sli_length(b.x - a.x, b.y - a.y);
        if (a.x == b.x || a.y == b.y) return false;
        within += sli_box_holds(clip, a) + sli_box_holds(clip, b);
        if (length <= longest) continue;
        longest = length;
        const double right = b.x > a.x ? length : -length;
        *along = (sl_point){(b.x - a.x) / right, (b.y - a.y) / right};
    }
    const bool line = map->wall_count == first + 1;
    return longest > 0 && longest >= least && within <= (line ? 1 : 0);
}

sl_status sli_svg_end_shape(sli_svg *s, const sl_box *clip, size_t first, uint32_t group) {
    static const char name[] = "hatching in clips";
    sli_svg_hatch piece = {.clip = *clip, .group = group};
    uint32_t hatching;
    if (!may_be_hatching(s->pen.map, clip, first, &piece.along))
        return sli_contents_end(&s->contents, &s->pen, group);
    SL_TRY(sli_contents_group(&s->contents, (sli_word){name, sizeof name - 1}, &hatching));
    s->contents.apart = true;
    const sl_status status = sli_contents_end(&s->contents, &s->pen, hatching);
    s->contents.apart = false;
    SL_TRY(status);
    SL_TRY(SL_ARRAY_ROOM(s->context, &s->hatches, 1));
    piece.run = s->contents.runs.count - 1;
    s->hatches.items[s->hatches.count++] = piece;
    return SL_OK;
}

static double area_of(const sl_box *box) {
    return fmax(box->max.x - box->min.x, 0) * fmax(box->max.y - box->min.y, 0);
}

/// Whether a clip is no smaller than half of the page, or of all that is drawn.
static bool is_page(const sl_map *map, double plan, const sl_box *clip) {
    const double page = area_of(&map->source.page);
    return 2 * area_of(clip) >= (page > 0 ? fmin(page, plan) : plan);
}

/// Whether two pieces are side by side: parallel, in one clip or in clips that meet.
static bool are_beside(const sli_svg_hatch *a, const sli_svg_hatch *b) {
    return fabs(a->along.x * b->along.y - a->along.y * b->along.x) <= PARALLEL &&
           a->clip.min.x <= b->clip.max.x && b->clip.min.x <= a->clip.max.x &&
           a->clip.min.y <= b->clip.max.y && b->clip.min.y <= a->clip.max.y;
}

void sli_svg_settle_hatching(sli_svg *s) {
    const sli_svg_hatch *all = s->hatches.items;
    const sl_box drawn = sl_map_bounds(s->pen.map);
    const double plan = area_of(&drawn);
    for (size_t first = 0, end; first < s->hatches.count; first = end) {
        for (end = first + 1; end < s->hatches.count && are_beside(&all[end - 1], &all[end]);)
            end++;
        for (size_t i = first; i < end; i++)
            if (end - first < FEWEST || is_page(s->pen.map, plan, &all[i].clip))
                sli_contents_move(&s->contents, all[i].run, all[i].group);
    }
}

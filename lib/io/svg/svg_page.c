/// The page, as its viewBox says. What lies beside it: programs that show a drawing cut it there,
/// so nobody sees it. It is often a store of symbols or patterns. But a plan may leave its page,
/// too, when somebody draws on and does not look at the page. So shapes beside the page are passed
/// over only where none crosses its edge, and fewer shapes are beside it than on it.
///
/// A box as large as the page is its frame, or its paper with a border, and no wall: half of its
/// line is beside the page. But a hall may be as large as its page. So it is a frame only beside
/// more shapes, one of which is large, and where no more than one, a title, touches it.
#include "io/svg/svg.h"
#include "space/index.h"

#include <math.h>

/// A frame differs from the page by up to such a share; so many shapes are in it at least, and so
/// many may touch it.
#define FRAME 0.01
enum { LEAST_FRAMED = 8, MOST_TITLES = 1 };
/// More boxes as large as the page are no frames: each is held against all that is drawn.
enum { MOST_FRAMES = 16 };

static sl_box box_of(const sl_map *map, const sli_group_run *run) {
    sl_box box = sli_box_around(map->walls[run->first].a, map->walls[run->first].a);
    for (size_t i = run->first; i < run->end; i++)
        box = sli_box_with(sli_box_with(box, map->walls[i].a), map->walls[i].b);
    return box;
}

static bool are_apart(const sl_box *a, const sl_box *b) {
    return a->max.x < b->min.x || a->min.x > b->max.x || a->max.y < b->min.y || a->min.y > b->max.y;
}

static double width_of(const sl_box *box) {
    return box->max.x - box->min.x;
}

static double height_of(const sl_box *box) {
    return box->max.y - box->min.y;
}

static bool is_along(double a, double b, double edge, double off) {
    return fmax(fabs(a - edge), fabs(b - edge)) <= off;
}

/// Whether a shape runs along the four edges of the page.
static bool is_frame(const sl_map *map, const sli_group_run *run) {
    const sl_box *page = &map->source.page;
    const double off = FRAME * fmax(width_of(page), height_of(page));
    bool sides[4] = {false};
    for (size_t i = run->first; i < run->end; i++) {
        const sl_point a = map->walls[i].a, b = map->walls[i].b;
        const bool along[4] = {
            is_along(a.x, b.x, page->min.x, off), is_along(a.x, b.x, page->max.x, off),
            is_along(a.y, b.y, page->min.y, off), is_along(a.y, b.y, page->max.y, off)};
        if (!along[0] && !along[1] && !along[2] && !along[3]) return false;
        for (int k = 0; k < 4; k++) sides[k] |= along[k];
    }
    const sl_box box = box_of(map, run);
    return sides[0] && sides[1] && sides[2] && sides[3] &&
           width_of(&box) >= width_of(page) - 2 * off &&
           height_of(&box) >= height_of(page) - 2 * off;
}

/// Whether an end of a wall of a shape lies on the sides of a box.
static bool touches(const sl_map *map, const sli_group_run *run, const sl_box *box) {
    const double near = FRAME / 10 * fmax(width_of(box), height_of(box));
    for (size_t i = run->first; i < run->end; i++)
        for (int k = 0; k < 2; k++) {
            const sl_point at = k ? map->walls[i].b : map->walls[i].a;
            if (at.x <= box->min.x + near || at.x >= box->max.x - near ||
                at.y <= box->min.y + near || at.y >= box->max.y - near)
                return true;
        }
    return false;
}

/// Whether the page's frame is about a plan: see above.
static bool holds_plan(const sli_svg *s, const sl_box *frame) {
    const sl_map *map = s->pen.map;
    const sl_box *page = &map->source.page;
    size_t within = 0, titles = 0;
    bool large = false;
    for (size_t i = 0; i < s->contents.runs.count; i++) {
        const sli_group_run *run = &s->contents.runs.items[i];
        const sl_box box = box_of(map, run);
        if (is_frame(map, run)) continue;
        within++;
        titles += touches(map, run, frame);
        large |= 2 * width_of(&box) >= width_of(page) && 2 * height_of(&box) >= height_of(page);
    }
    return within >= LEAST_FRAMED && titles <= MOST_TITLES && large;
}

/// Passes over frames of the page that lines draw, and whose names say nothing.
static sl_status settle_frame(sli_svg *s) {
    static const char name[] = "frame of the page";
    const sli_group_run *runs = s->contents.runs.items;
    size_t frames[MOST_FRAMES], count = 0;
    uint32_t group;
    for (size_t i = 0; s->contents.has_looks && i < s->contents.runs.count; i++) {
        if (!s->contents.looks.items.items[runs[i].look].ink.line ||
            !is_frame(s->pen.map, &runs[i]) ||
            sli_contents_means(&s->contents, runs[i].group) != SLI_MEANS_NOTHING)
            continue;
        if (count == MOST_FRAMES) return SL_OK;
        frames[count++] = i;
    }
    for (size_t i = 0; i < count; i++) {
        const sl_box box = box_of(s->pen.map, &runs[frames[i]]);
        if (!holds_plan(s, &box)) continue;
        SL_TRY(sli_contents_group(&s->contents, (sli_word){name, sizeof name - 1}, &group));
        sli_contents_move(&s->contents, frames[i], group);
    }
    return SL_OK;
}

/// Passes over what lies beside the page.
static sl_status settle_beside(sli_svg *s) {
    static const char name[] = "hidden beside the page";
    const sl_map *map = s->pen.map;
    const sl_box *page = &map->source.page;
    const size_t count = s->contents.runs.count;
    size_t on = 0, beside = 0;
    for (size_t i = 0; i < count; i++) {
        const sl_box box = box_of(map, &s->contents.runs.items[i]);
        on += sli_box_holds(page, box.min) && sli_box_holds(page, box.max);
        beside += are_apart(&box, page);
    }
    if (!beside || beside >= on || on + beside < count) return SL_OK;
    uint32_t hidden;
    SL_TRY(sli_contents_group(&s->contents, (sli_word){name, sizeof name - 1}, &hidden));
    for (size_t i = 0; i < count; i++) {
        const sl_box box = box_of(map, &s->contents.runs.items[i]);
        if (are_apart(&box, page)) sli_contents_move(&s->contents, i, hidden);
    }
    return SL_OK;
}

sl_status sli_svg_settle_page(sli_svg *s) {
    const sl_box *page = &s->pen.map->source.page;
    if (!(page->max.x > page->min.x) || sli_contents_said(&s->contents)) return SL_OK;
    SL_TRY(settle_frame(s));
    return settle_beside(s);
}

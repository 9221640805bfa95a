/// What lies beside the page, as its viewBox says: programs that show a drawing cut it there, so
/// nobody sees it. It is often a store of symbols or patterns. But a plan may leave its page, too,
/// when somebody draws on and does not look at the page. So shapes beside the page are passed over
/// only where none crosses its edge, and fewer shapes are beside it than on it.
#include "io/svg/svg.h"
#include "space/index.h"

static sl_box box_of(const sl_map *map, const sli_group_run *run) {
    sl_box box = sli_box_around(map->walls[run->first].a, map->walls[run->first].a);
    for (size_t i = run->first; i < run->end; i++)
        box = sli_box_with(sli_box_with(box, map->walls[i].a), map->walls[i].b);
    return box;
}

static bool are_apart(const sl_box *a, const sl_box *b) {
    return a->max.x < b->min.x || a->min.x > b->max.x || a->max.y < b->min.y || a->min.y > b->max.y;
}

sl_status sli_svg_settle_page(sli_svg *s) {
    static const char name[] = "hidden beside the page";
    const sl_map *map = s->pen.map;
    const sl_box *page = &map->source.page;
    const size_t count = s->contents.runs.count;
    size_t on = 0, beside = 0;
    if (!(page->max.x > page->min.x) || sli_contents_said(&s->contents)) return SL_OK;
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

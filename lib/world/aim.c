/// Which wanted cells a search over portal sequences can still come to.
///
///                last
///     first     .|'      Lines that cross both portals are, behind the last one, between two of
///        |  .  ' |       them: from the right end of the first one to the left end of the last
///        |'  .   |       one, and the other way round.
///            ' . |
///               '|.
///
/// A search that wants few cells goes on only while one of these lies partly between the two
/// lines, and partly behind the last portal. The signs are exact, and what touches counts.
#include "world/aim.h"

#include "geometry/orient.h"

/// With more targets, the search comes to most of them anyway.
enum { MOST_TARGETS = 16 };

sl_status sli_aim(sl_context *context, sli_world_rows *r) {
    r->targets.count = 0;
    if (!r->wanted_count) return SL_OK;
    SL_TRY(SL_ARRAY_ROOM(context, &r->targets, r->changed.count));
    for (size_t i = 0; i < r->changed.count; i++)
        if (r->wanted.items[i]) r->targets.items[r->targets.count++] = r->changed.items[i];
    return SL_OK;
}

/// Where lines are that cross two portals, behind the last one: on the left of up to three lines.
typedef struct range {
    sl_segment sides[3];
    int count;
} range;

/// Adds the line from `from` to `to`, if what both portals have lies on its two sides as drawn
/// above. `sign`: 1 for what is on its left, -1 for its right.
static void add_side(range *out, sl_point from, sl_point to, sl_point before, sl_point behind,
                     int sign) {
    if (sign * sli_orient(from, to, before) > 0 || sign * sli_orient(from, to, behind) < 0) return;
    out->sides[out->count++] = sign > 0 ? (sl_segment){from, to} : (sl_segment){to, from};
}

static range range_behind(const sl_directed_portal *first, const sl_directed_portal *last) {
    range out = {.sides = {{last->left, last->right}}, .count = 1};
    add_side(&out, first->right, last->left, first->left, last->right, -1);
    add_side(&out, first->left, last->right, first->right, last->left, 1);
    return out;
}

static bool meets(const range *where, const sl_space *s, uint32_t number) {
    const sl_cell *cell = &s->cells[number];
    const sl_point *corners = s->vertices + cell->first_vertex;
    for (int i = 0; i < where->count; i++) {
        uint32_t k = 0;
        while (k < cell->vertex_count &&
               sli_orient(where->sides[i].a, where->sides[i].b, corners[k]) < 0)
            k++;
        if (k == cell->vertex_count) return false;
    }
    return true;
}

bool sli_aim_may_hit(sli_world_rows *r, const sl_directed_portal *first,
                     const sl_directed_portal *last) {
    if (!r->wanted_count || r->wanted_count > MOST_TARGETS) return true;
    const range where = range_behind(first, last);
    for (size_t i = 0; i < r->targets.count; i++) {
        const uint32_t cell = r->targets.items[i];
        if (r->marks[cell] == r->now) {
            r->targets.items[i--] = r->targets.items[--r->targets.count];
            continue;
        }
        if (!meets(&where, r->search.space, cell)) continue;
        // The next portals mostly lead there, too.
        r->targets.items[i] = r->targets.items[0];
        r->targets.items[0] = cell;
        return true;
    }
    return false;
}

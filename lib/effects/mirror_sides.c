/// Finds the pieces of cells' boundaries that lie on mirrors, side by side and mirror by mirror.
#include "effects/mirrors.h"

#include "geometry/orient.h"
#include "sightline/support.h"

#include <math.h>

/// A side of a cell, counter-clockwise.
typedef struct side {
    uint32_t cell, vertex; ///< of the space's
    sl_point from, to;
} side;

static bool in_line(sl_point a, sl_point b, sl_point p, sl_point q) {
    return sli_orient(a, b, p) == 0 && sli_orient(a, b, q) == 0;
}

/// Whether the side is on the mirror's line: itself, or what the space tells of its wall.
static bool is_on_line(const sl_space *space, const side *s, const sl_segment *mirror) {
    if (!space->neighbour) return in_line(mirror->a, mirror->b, s->from, s->to);
    const uint32_t what = space->neighbour[s->vertex];
    if (what >= SL_NEIGHBOUR_BORDER) return false;
    const sl_wall *wall = &space->walls[what & ~SL_NEIGHBOUR_RIGHT];
    return in_line(wall->a, wall->b, mirror->a, mirror->b);
}

double sli_mirror_along(sl_point from, sl_point to, sl_point p) {
    if (fabs(to.x - from.x) >= fabs(to.y - from.y)) return to.x > from.x ? p.x : -p.x;
    return to.y > from.y ? p.y : -p.y;
}

bool sli_mirror_covers(const sl_glass *mirror, sl_point from, sl_point to, sl_point *right,
                       sl_point *left) {
    const sl_segment *at = &mirror->segment;
    const double a = sli_mirror_along(from, to, at->a), b = sli_mirror_along(from, to, at->b);
    const bool same_way = a < b;
    if (mirror->one_sided && !same_way) return false;
    const sl_point low = same_way ? at->a : at->b, high = same_way ? at->b : at->a;
    *right = sli_mirror_along(from, to, low) > sli_mirror_along(from, to, from) ? low : from;
    *left = sli_mirror_along(from, to, high) < sli_mirror_along(from, to, to) ? high : to;
    return sli_mirror_along(from, to, *right) < sli_mirror_along(from, to, *left);
}

static side side_of(const sl_space *space, uint32_t cell, uint32_t number) {
    const sl_cell *c = &space->cells[cell];
    const sl_point *v = space->vertices + c->first_vertex;
    return (side){cell, c->first_vertex + number, v[number],
                  v[number + 1 == c->vertex_count ? 0 : number + 1]};
}

/// What of a side lies on a mirror, if the mirror reflects there.
static bool reflects(const sl_space *space, const sl_map *map, const side *s, uint32_t mirror,
                     sli_mirror_side *out) {
    const sl_glass *glass = &map->mirrors[mirror];
    *out = (sli_mirror_side){.cell = s->cell, .mirror = mirror};
    return is_on_line(space, s, &glass->segment) &&
           sli_mirror_covers(glass, s->from, s->to, &out->right, &out->left);
}

bool sli_mirror_side_of(const sl_space *space, const sl_map *map, uint32_t cell, uint32_t mirror,
                        sli_mirror_side *out) {
    for (uint32_t k = 0; k < space->cells[cell].vertex_count; k++) {
        const side s = side_of(space, cell, k);
        if (reflects(space, map, &s, mirror, out)) return true;
    }
    return false;
}

typedef struct finder {
    sl_context *context;
    const sl_space *space;
    const sl_map *map;
    SL_ARRAY(sli_mirror_side) sides;
} finder;

static sl_status add_mirror_side(finder *f, const side *s, uint32_t number) {
    sli_mirror_side found;
    if (!reflects(f->space, f->map, s, number, &found)) return SL_OK;
    SL_TRY(SL_ARRAY_ROOM(f->context, &f->sides, 1));
    f->sides.items[f->sides.count++] = found;
    return SL_OK;
}

static sl_status find(finder *f, uint32_t *first) {
    for (uint32_t i = 0; i < f->space->cell_count; i++) {
        first[i] = (uint32_t)f->sides.count;
        if (i % 256 == 0) SL_TRY(sl_check_cancelled(f->context));
        for (uint32_t k = 0; k < f->space->cells[i].vertex_count; k++) {
            const side s = side_of(f->space, i, k);
            for (uint32_t m = 0; m < f->map->mirror_count; m++) SL_TRY(add_mirror_side(f, &s, m));
        }
    }
    first[f->space->cell_count] = (uint32_t)f->sides.count;
    return SL_OK;
}

sl_status sli_mirror_sides_find(sl_context *context, const sl_space *space, const sl_map *map,
                                sli_mirror_sides *out) {
    finder f = {.context = context, .space = space, .map = map};
    uint32_t *first = sl_alloc_array(context, (size_t)space->cell_count + 1, sizeof *first);
    const sl_status status = first ? find(&f, first) : SL_NO_MEMORY;
    if (status == SL_OK) {
        *out = (sli_mirror_sides){f.sides.items, first};
        return SL_OK;
    }
    sl_free(context, f.sides.items);
    sl_free(context, first);
    return status;
}

void sli_mirror_sides_destroy(sl_context *context, sli_mirror_sides *sides) {
    sl_free(context, sides->sides);
    sl_free(context, sides->first);
    *sides = (sli_mirror_sides){0};
}

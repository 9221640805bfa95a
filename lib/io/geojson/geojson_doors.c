/// Openings and doors of GeoJSON, cut out of the walls that they stand in.
///
/// Rooms are outlines that nothing interrupts; an opening is a line along them, or a point on them.
/// Two rooms often have an outline each, with the thickness of a wall between. So an opening of
/// length L cuts all walls that run along it (within 1 in 5) no farther away than L / 3:
///
///      room      .            .
///     -----------p0          q0----------    each outline is cut from p to q, and its ends are
///                 |  p---q   |               joined: the opening leads through the wall
///     -----------p1          q1----------
///      room      .            .
///
/// Cost: doors times walls.
#include "io/geojson/geojson.h"
#include "map/scan.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

/// The usual width of a door in metres, where a point is all that a file has.
#define USUAL_WIDTH 0.9

/// A piece that an opening takes out of a wall: s along the opening, t to its left, in the map's
/// unit.
typedef struct cut {
    size_t wall;
    size_t number; ///< of those of its opening, by wall
    double s0, s1, t;
    sl_point p, q; ///< where s is s0 and s1
    bool kept;
} cut;

typedef struct opening {
    sl_point p, q;
    double length;
    const char *name;
    bool open;
    bool in_gap; ///< walls end a little within it
    uint32_t item;
    SL_ARRAY(cut) cuts;  ///< by wall
    SL_ARRAY(cut) lines; ///< those that are kept, from side to side: one for each line of walls
} opening;

static bool same(sl_point a, sl_point b) {
    return a.x == b.x && a.y == b.y;
}

static sl_point between(sl_point a, sl_point b, double part) {
    return (sl_point){a.x + (b.x - a.x) * part, a.y + (b.y - a.y) * part};
}

static double along(const opening *o, sl_point at) {
    return ((at.x - o->p.x) * (o->q.x - o->p.x) + (at.y - o->p.y) * (o->q.y - o->p.y)) / o->length;
}

static double beside(const opening *o, sl_point at) {
    return ((o->q.x - o->p.x) * (at.y - o->p.y) - (o->q.y - o->p.y) * (at.x - o->p.x)) / o->length;
}

/// What an opening takes out of a wall, if it runs along it.
static bool find_cut(const opening *o, const sl_wall *wall, cut *found) {
    const double reach = o->length / 3, near = o->length * 1e-3;
    sl_point a = wall->a, b = wall->b;
    if (along(o, a) > along(o, b)) a = wall->b, b = wall->a;
    const double sa = along(o, a), sb = along(o, b), ta = beside(o, a), tb = beside(o, b);
    if (!(sb - sa > near) || fabs(tb - ta) > (sb - sa) / 5) return false;
    const double s0 = fmax(sa, 0), s1 = fmin(sb, o->length);
    const double first = (s0 - sa) / (sb - sa), last = (s1 - sa) / (sb - sa);
    const bool before = s0 - sa > near, behind = sb - s1 > near;
    found->s0 = s0;
    found->s1 = s1;
    found->t = ta + (tb - ta) * (first + last) / 2;
    found->p = before ? between(a, b, first) : a;
    found->q = behind ? between(a, b, last) : b;
    return s1 - s0 > near && fabs(found->t) <= reach;
}

/// Takes a piece out of its wall, which may leave two: the wall and one that is added. Without a
/// piece it has no length. Ends that are nearly met are met.
static sl_status cut_wall(sli_geo *geo, const opening *o, const cut *c) {
    sl_map *map = geo->map;
    const sl_wall wall = map->walls[c->wall];
    const bool back = along(o, wall.a) > along(o, wall.b);
    const sl_point a = back ? wall.b : wall.a, b = back ? wall.a : wall.b;
    const bool before = !same(a, c->p), behind = !same(b, c->q);
    map->walls[c->wall].a = before ? a : c->q;
    map->walls[c->wall].b = before ? c->p : behind ? b : c->q;
    if (before && behind) return sl_map_add_wall(geo->context, map, c->q, b, wall.line);
    return SL_OK;
}

static int compare_cuts(const void *left, const void *right) {
    const cut *a = left, *b = right;
    if (a->t != b->t) return a->t < b->t ? -1 : 1;
    return (a->s0 > b->s0) - (a->s0 < b->s0);
}

/// Whether two cuts lie in one line: as far apart sideways as 1/50 of the opening.
static bool in_line(const opening *o, const cut *a, const cut *b) {
    return b->t - a->t <= o->length / 50;
}

/// Keeps cuts that take a quarter of the opening or more out of the walls in one line. Others only
/// end a little within it, where a door that is drawn as an area fills the gap between them.
static void keep_long(opening *o) {
    size_t kept = 0;
    for (size_t i = 0, end; i < o->lines.count; i = end) {
        const cut first = o->lines.items[i];
        double length = 0;
        for (end = i; end < o->lines.count && in_line(o, &first, &o->lines.items[end]); end++)
            length += o->lines.items[end].s1 - o->lines.items[end].s0;
        for (size_t k = i; k < end && length >= o->length / 4; k++) {
            o->cuts.items[o->lines.items[k].number].kept = true;
            o->lines.items[kept++] = o->lines.items[k];
        }
    }
    o->lines.count = kept;
}

/// Cuts that lie in one line become one.
static void join_lines(opening *o) {
    size_t kept = 0;
    for (size_t i = 0; i < o->lines.count; i++) {
        const cut next = o->lines.items[i];
        cut *last = kept ? &o->lines.items[kept - 1] : NULL;
        if (!last || !in_line(o, last, &next)) {
            o->lines.items[kept++] = next;
            continue;
        }
        if (next.s0 < last->s0) last->s0 = next.s0, last->p = next.p;
        if (next.s1 > last->s1) last->s1 = next.s1, last->q = next.q;
    }
    o->lines.count = kept;
}

static sl_status find_cuts(sli_geo *geo, opening *o) {
    for (size_t i = 0; i < geo->map->wall_count; i++) {
        cut found = {.wall = i, .number = o->cuts.count};
        if (i % 65536 == 0) SL_TRY(sl_check_cancelled(geo->context));
        if (!find_cut(o, &geo->map->walls[i], &found)) continue;
        SL_TRY(SL_ARRAY_ROOM(geo->context, &o->cuts, 1));
        o->cuts.items[o->cuts.count++] = found;
    }
    return SL_OK;
}

/// Cuts the walls along an opening, and finds the lines that it goes through.
static sl_status make_cuts(sli_geo *geo, opening *o) {
    SL_TRY(find_cuts(geo, o));
    const size_t count = o->cuts.count;
    o->in_gap = count > 0;
    if (!count) return SL_OK;
    SL_TRY(SL_ARRAY_ROOM(geo->context, &o->lines, count));
    memcpy(o->lines.items, o->cuts.items, count * sizeof *o->cuts.items);
    o->lines.count = count;
    qsort(o->lines.items, count, sizeof *o->lines.items, compare_cuts);
    keep_long(o);
    for (size_t i = 0; i < count; i++)
        if (o->cuts.items[i].kept) SL_TRY(cut_wall(geo, o, &o->cuts.items[i]));
    join_lines(o);
    return SL_OK;
}

/// What fills the opening: a door, or a wall where it is shut and doors are not asked for.
static sl_status fill(sli_geo *geo, const opening *o, sl_point p, sl_point q) {
    if (same(p, q)) return SL_OK;
    if (geo->options->doors)
        return sl_map_add_door(geo->context, geo->map, o->name, (sl_segment){p, q}, o->open,
                               o->item);
    return o->open ? SL_OK : sl_map_add_wall(geo->context, geo->map, p, q, o->item);
}

static sl_status add_opening(sli_geo *geo, opening *o) {
    o->length = hypot(o->q.x - o->p.x, o->q.y - o->p.y);
    SL_TRY(make_cuts(geo, o));
    if (!o->lines.count) {
        geo->no_walls += !o->in_gap;
        return fill(geo, o, o->p, o->q);
    }
    geo->cuts++;
    for (size_t i = 0; i < o->lines.count; i++) {
        const cut *c = &o->lines.items[i];
        SL_TRY(fill(geo, o, c->p, c->q));
        if (!i) continue;
        SL_TRY(sl_map_add_wall(geo->context, geo->map, c[-1].p, c->p, o->item));
        SL_TRY(sl_map_add_wall(geo->context, geo->map, c[-1].q, c->q, o->item));
    }
    return SL_OK;
}

// --- where an opening is

/// A number, or a text that begins with one: "0.9 m".
static double width_of(const sli_geo *geo, const sli_geo_feature *feature) {
    const json_t *value = sli_geo_property(feature, "width");
    const char *text = sli_geo_text(feature, "width");
    double width = json_is_number(value) ? json_number_value(value) : 0;
    if (*text) (void)sl_number_read(text, strcspn(text, " m"), &width);
    return width > 0 && width < SL_COORDINATE_MAX ? width
           : strcmp(geo->map->unit, "m") == 0     ? USUAL_WIDTH
                                                  : 0;
}

/// How far a point is from a wall, squared.
static double distance_2(const sl_wall *wall, sl_point at) {
    const double dx = wall->b.x - wall->a.x, dy = wall->b.y - wall->a.y, all = dx * dx + dy * dy;
    const double part = all > 0 ? ((at.x - wall->a.x) * dx + (at.y - wall->a.y) * dy) / all : 0;
    const sl_point near = between(wall->a, wall->b, fmax(0, fmin(1, part)));
    return (at.x - near.x) * (at.x - near.x) + (at.y - near.y) * (at.y - near.y);
}

/// Along the longest wall of those that a point is on; false if it is on none. On a corner the
/// longer side has the door, as far as it goes.
static bool find_on_wall(const sli_geo *geo, sl_point at, double width, opening *o) {
    const sl_wall *found = NULL;
    double longest = 0;
    for (size_t i = 0; i < geo->map->wall_count; i++) {
        const sl_wall *wall = &geo->map->walls[i];
        const double length = hypot(wall->b.x - wall->a.x, wall->b.y - wall->a.y);
        if (!(length > longest) || !(distance_2(wall, at) <= width * width / 9)) continue;
        longest = length;
        found = wall;
    }
    if (!found) return false;
    const double half = width / 2 / longest;
    const sl_point step = {(found->b.x - found->a.x) * half, (found->b.y - found->a.y) * half};
    o->p = (sl_point){at.x - step.x, at.y - step.y};
    o->q = (sl_point){at.x + step.x, at.y + step.y};
    return true;
}

/// The longest side of a line, put through the middle of a ring.
static void find_along(const sli_geo *geo, const sli_geo_line *line, opening *o) {
    const sl_point *points = geo->points.items + line->first;
    const bool ring = line->count > 3 && same(points[0], points[line->count - 1]);
    double longest = -1;
    sl_point middle = {0, 0};
    if (!ring) {
        o->p = points[0];
        o->q = points[line->count - 1];
        return;
    }
    for (size_t i = 0; i + 1 < line->count; i++) {
        const double length = hypot(points[i + 1].x - points[i].x, points[i + 1].y - points[i].y);
        middle.x += points[i].x / (double)(line->count - 1);
        middle.y += points[i].y / (double)(line->count - 1);
        if (length <= longest) continue;
        longest = length;
        o->p = points[i];
        o->q = points[i + 1];
    }
    const double x = middle.x - (o->p.x + o->q.x) / 2, y = middle.y - (o->p.y + o->q.y) / 2;
    o->p = (sl_point){o->p.x + x, o->p.y + y};
    o->q = (sl_point){o->q.x + x, o->q.y + y};
}

static sl_status add_door(sli_geo *geo, size_t number) {
    const sli_geo_feature *feature = &geo->features.items[number];
    const json_t *open = sli_geo_property(feature, "open");
    const char *name = sli_geo_text(feature, "name");
    char numbered[32];
    snprintf(numbered, sizeof numbered, "door%zu", number + 1);
    for (size_t i = 0; i < feature->count; i++) {
        const sli_geo_line *line = &geo->lines.items[feature->first + i];
        opening o = {.name = sli_name_usable(name, strlen(name)) ? name : numbered,
                     .open = !json_is_false(open),
                     .item = (uint32_t)number + 1};
        if (!line->count) continue;
        if (line->count > 1)
            find_along(geo, line, &o);
        else if (!find_on_wall(geo, geo->points.items[line->first], width_of(geo, feature), &o))
            o.q = o.p;
        sl_status status = SL_OK;
        if (same(o.p, o.q))
            geo->no_walls++;
        else
            status = add_opening(geo, &o);
        sl_free(geo->context, o.cuts.items);
        sl_free(geo->context, o.lines.items);
        SL_TRY(status);
    }
    return SL_OK;
}

sl_status sli_geo_add_doors(sli_geo *geo) {
    for (size_t i = 0; i < geo->features.count; i++) {
        const sli_geo_feature *feature = &geo->features.items[i];
        if (feature->taken && feature->means == SLI_GEO_DOOR) SL_TRY(add_door(geo, i));
    }
    return SL_OK;
}

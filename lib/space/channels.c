/// The search for channels.
///
/// A disc gets stuck between two places on walls that are no farther apart than it is wide. Of all
/// such pairs those count that have no other wall in the circle over them, as p and q or p and f:
///
///          p   .---.               p                     ends p and q, and the wall's
///          | /       \          .--|--.                  foot f of the end p
///          ||         q  ,     (   |   )
///            \       /          `--f--´
///              `---´           =========
///
/// Two ends p and q like these are a side of the Delaunay triangulation of the walls (Gabriel and
/// Sokal 1969). An end and a foot need a search. From each side of each wall it goes on through the
/// triangles, straight away from the wall. So each triangle comes up at most once for each stretch
/// of the wall that it lies above. An end r that was passed limits what may come behind it: the
/// circle over f and p does not hold r. So the height of p over the wall is at most h + d²/h, where
/// h is that of r, and d the distance between their feet. The search stops where triangles are
/// higher.
///
/// Walls, cut at the feet, and channels are triangulated anew. Whoever goes from triangle to
/// triangle without crossing a wall or a channel of width w goes where a disc wider than w goes,
/// and the other way round: a way that crosses no channel keeps a distance of w/2 from all walls.
#include "space/channels.h"

#include "geometry/crossing.h"
#include "geometry/length.h"
#include "map/source.h"
#include "space/index.h"

#include <stdlib.h>
#include <string.h>

/// What rounding may add to a length before a bound counts.
#define SLACK (1 + 0x1p-40)
/// How much smaller a circle is that a wall clearly goes into.
#define CLEARLY (1 + 0x1p-20)

/// With more places than this, those that only look narrow would cost seconds.
enum { CROWDED = 1 << 13 };

/// Beyond this, triangulating takes minutes, and lines that dense are no walls of rooms.
enum { MOST_CROSSINGS = 1 << 20 };

/// A half-edge by which the search goes on, and the stretch of the wall below it.
typedef struct step {
    uint32_t half;
    double low, high;
} step;

/// The place of a foot on an edge, to cut it there.
typedef struct foot {
    uint32_t edge;
    double along;
    sl_point at;
} foot;

typedef struct finder {
    sl_context *context;
    double most;
    sli_planar walls;
    sli_triangulation t; ///< of the walls
    sli_box_tree boxes;  ///< of the edges of `walls`
    bool crowded;        ///< so many places come up that each is looked at
    SL_ARRAY(step) steps;
    SL_ARRAY(foot) feet;
    sli_channels *out;
} finder;

// --- ends

static sl_point at(const finder *f, uint32_t point) {
    return f->t.points.items[point];
}

static uint32_t from(const finder *f, uint32_t half) {
    return f->t.halves.items[half].from;
}

static uint32_t to(const finder *f, uint32_t half) {
    return sli_half_end(&f->t, half);
}

static uint32_t next(const finder *f, uint32_t half) {
    return f->t.halves.items[half].next;
}

/// Whether a point is the end of a wall; corners of the box are not.
static bool is_end(const finder *f, uint32_t point) {
    return point < f->walls.point_count;
}

static double apart(sl_point a, sl_point b) {
    return sli_length(b.x - a.x, b.y - a.y);
}

static sl_status add_channel(finder *f, sl_segment at, sl_segment wall) {
    SL_TRY(SL_ARRAY_ROOM(f->context, &f->out->items, 1));
    f->out->items.items[f->out->items.count++] = (sli_channel){at, wall, apart(at.a, at.b)};
    return SL_OK;
}

/// A search for a wall in a circle.
typedef struct circle {
    const finder *f;
    sl_point middle;
    double radius; ///< 0 as soon as a wall is in it
} circle;

static void look_at_wall(void *user, uint32_t edge) {
    circle *c = user;
    const sl_segment wall = sli_planar_at(&c->f->walls, 2 * edge);
    if (sli_away_from(wall.a, wall.b, c->middle) < c->radius) c->radius = 0;
}

/// Whether a wall goes through the circle over a pair of places, in a crowded plan. Where it merely
/// touches it, but for a rounding, it does not.
static bool is_barred(const finder *f, sl_segment at) {
    if (!f->crowded) return false;
    circle c = {
        f, {at.a.x / 2 + at.b.x / 2, at.a.y / 2 + at.b.y / 2}, apart(at.a, at.b) / 2 / CLEARLY};
    sli_box_tree_near(&f->boxes, c.middle, &c.radius, look_at_wall, &c);
    return c.radius == 0;
}

/// Whether the point opposite a half-edge lies in the circle over it.
static bool circle_holds(const finder *f, uint32_t half) {
    if (sli_half_is_outside(&f->t, half)) return false;
    const uint32_t apex = to(f, next(f, half));
    if (!is_end(f, apex)) return false;
    const sl_point p = at(f, from(f, half)), q = at(f, to(f, half)), r = at(f, apex);
    return (p.x - r.x) * (q.x - r.x) + (p.y - r.y) * (q.y - r.y) < 0;
}

static sl_status find_between_ends(finder *f) {
    for (uint32_t half = 0; half < f->t.halves.count; half += 2) {
        const uint32_t a = from(f, half), b = to(f, half);
        if (f->t.labels[half / 2] || !is_end(f, a) || !is_end(f, b)) continue;
        if (apart(at(f, a), at(f, b)) > f->most * SLACK) continue;
        const sl_segment pair = {at(f, a), at(f, b)};
        if (circle_holds(f, half) || circle_holds(f, half ^ 1) || is_barred(f, pair)) continue;
        SL_TRY(add_channel(f, pair, (sl_segment){pair.b, pair.b}));
    }
    return SL_OK;
}

// --- feet

/// Places as seen from a wall: along it, and above its left side.
typedef struct frame {
    sl_point a, b, along; ///< `along` has length 1
    double length;
    uint32_t edge;
} frame;

static double along(const frame *w, sl_point p) {
    return sli_dot((sl_point){p.x - w->a.x, p.y - w->a.y}, w->along);
}

static double above(const frame *w, sl_point p) {
    return sli_cross(w->along, (sl_point){p.x - w->a.x, p.y - w->a.y});
}

static sl_status add_foot(finder *f, const frame *w, sl_point p, double place) {
    sl_point end = {w->a.x + place * w->along.x, w->a.y + place * w->along.y};
    if (w->a.x == w->b.x) end = (sl_point){w->a.x, p.y};
    if (w->a.y == w->b.y) end = (sl_point){p.x, w->a.y};
    if (is_barred(f, (sl_segment){p, end})) return SL_OK;
    SL_TRY(SL_ARRAY_ROOM(f->context, &f->feet, 1));
    const bool turned = sli_compare_points(w->a, w->b) > 0;
    f->feet.items[f->feet.count++] = (foot){w->edge, turned ? w->length - place : place, end};
    return add_channel(f, (sl_segment){p, end}, (sl_segment){w->a, w->b});
}

/// The greatest height over a stretch that an end leaves to what lies behind it.
static double room_behind(const finder *f, const frame *w, uint32_t point, double low,
                          double high) {
    const double height = above(w, at(f, point)), place = along(w, at(f, point));
    if (!is_end(f, point) || !(height > 0)) return INFINITY;
    const double far = fmax(fabs(place - low), fabs(place - high));
    return height + far * far / height;
}

/// Goes on through a side of a triangle, if it can be crossed straight away from the wall.
static sl_status go_on(finder *f, const frame *w, const step *by, uint32_t side) {
    const uint32_t a = from(f, side ^ 1), b = to(f, side ^ 1);
    const double left = along(w, at(f, a)), right = along(w, at(f, b));
    if (f->t.labels[side / 2] || sli_half_is_outside(&f->t, side ^ 1) || !(left < right))
        return SL_OK;
    const double low = fmax(by->low, left), high = fmin(by->high, right);
    if (!(low < high)) return SL_OK;
    const double rise = (above(w, at(f, b)) - above(w, at(f, a))) / (right - left);
    const double first = above(w, at(f, a)) + (low - left) * rise;
    const double least = fmin(first, first + (high - low) * rise);
    const double room =
        fmin(f->most, fmin(room_behind(f, w, a, low, high), room_behind(f, w, b, low, high)));
    if (least > room * SLACK) return SL_OK;
    SL_TRY(SL_ARRAY_ROOM(f->context, &f->steps, 1));
    f->steps.items[f->steps.count++] = (step){side ^ 1, low, high};
    return SL_OK;
}

/// Finds the channels above one side of a wall.
static sl_status find_above(finder *f, uint32_t half) {
    const sl_point a = at(f, from(f, half)), b = at(f, to(f, half));
    frame w = {.a = a, .b = b, .length = apart(a, b), .edge = f->t.labels[half / 2] - 1};
    w.along = (sl_point){(b.x - a.x) / w.length, (b.y - a.y) / w.length};
    SL_TRY(SL_ARRAY_ROOM(f->context, &f->steps, 1));
    f->steps.items[f->steps.count++] = (step){half, 0, w.length};
    while (f->steps.count) {
        const step by = f->steps.items[--f->steps.count];
        const uint32_t right = next(f, by.half), left = next(f, right), apex = from(f, left);
        const double place = along(&w, at(f, apex));
        if (is_end(f, apex) && place > by.low && place < by.high &&
            above(&w, at(f, apex)) <= f->most * SLACK)
            SL_TRY(add_foot(f, &w, at(f, apex), place));
        SL_TRY(go_on(f, &w, &by, right));
        SL_TRY(go_on(f, &w, &by, left));
    }
    return SL_OK;
}

static sl_status find_feet(finder *f) {
    for (uint32_t half = 0; half < f->t.halves.count; half++) {
        if (half % 4096 == 0) SL_TRY(sl_check_cancelled(f->context));
        if (f->t.labels[half / 2] && !sli_half_is_outside(&f->t, half)) SL_TRY(find_above(f, half));
    }
    return SL_OK;
}

// --- walls, cut at feet, and channels

static int compare_feet(const void *left, const void *right) {
    const foot *a = left, *b = right;
    if (a->edge != b->edge) return a->edge < b->edge ? -1 : 1;
    if (a->along != b->along) return a->along < b->along ? -1 : 1;
    return sli_compare_points(a->at, b->at);
}

/// Lists the parts of walls between feet; then the channels.
static sl_status list_parts(finder *f, sli_mesh_lines *lines) {
    const foot *feet = f->feet.items;
    size_t cut = 0;
    if (f->feet.count) qsort(f->feet.items, f->feet.count, sizeof *feet, compare_feet);
    for (uint32_t i = 0; i < f->walls.edge_count; i++) {
        const sl_segment whole = sli_planar_at(&f->walls, 2 * i);
        sl_point last = whole.a;
        for (; cut < f->feet.count && feet[cut].edge == i; cut++) {
            if (!sli_same_point(last, feet[cut].at))
                SL_TRY(sli_mesh_add_line(f->context, lines, (sl_segment){last, feet[cut].at}));
            last = feet[cut].at;
        }
        if (!sli_same_point(last, whole.b))
            SL_TRY(sli_mesh_add_line(f->context, lines, (sl_segment){last, whole.b}));
    }
    lines->wall_count = lines->items.count;
    for (size_t i = 0; i < f->out->items.count; i++)
        SL_TRY(sli_mesh_add_line(f->context, lines, f->out->items.items[i].at));
    return SL_OK;
}

/// Says of each edge of the graph what it is.
static sl_status label_graph(const finder *f, const sli_planar *graph, size_t walls,
                             uint32_t **out) {
    const sli_channel *channels = f->out->items.items;
    uint32_t *label = *out = sl_alloc_array(f->context, graph->edge_count + 1, sizeof *label);
    if (!label) return SL_NO_MEMORY;
    memset(label, 0xff, graph->edge_count * sizeof *label);
    for (size_t k = graph->first[0]; k < graph->first[walls]; k++)
        label[graph->links[k] / 2] = SLI_WALL;
    for (uint32_t i = 0; i < f->out->items.count; i++)
        for (size_t k = graph->first[walls + i]; k < graph->first[walls + i + 1]; k++) {
            uint32_t *own = &label[graph->links[k] / 2];
            if (*own == SLI_FREE || (*own != SLI_WALL && channels[i].width < channels[*own].width))
                *own = i;
        }
    return SL_OK;
}

static sl_status take_labels(finder *f, const sli_planar *graph, size_t walls) {
    sli_channels *c = f->out;
    const sli_triangulation *t = &c->triangles;
    uint32_t *of_graph;
    SL_TRY(label_graph(f, graph, walls, &of_graph));
    c->label = sl_alloc_array(f->context, t->halves.count / 2, sizeof *c->label);
    c->solid = sl_alloc_array(f->context, sl_bits_words(t->points.count), sizeof *c->solid);
    const bool room = c->label && c->solid;
    for (size_t i = 0; room && i < t->halves.count / 2; i++) {
        c->label[i] = t->labels[i] ? of_graph[t->labels[i] - 1] : SLI_FREE;
        if (c->label[i] != SLI_WALL) continue;
        sl_bits_add(c->solid, t->halves.items[2 * i].from);
        sl_bits_add(c->solid, t->halves.items[2 * i + 1].from);
    }
    sl_free(f->context, of_graph);
    return room ? SL_OK : SL_NO_MEMORY;
}

static sl_status triangulate_again(finder *f, const char *source, double weld) {
    sli_mesh_lines lines = {0};
    sli_planar graph = {0};
    sl_status status = list_parts(f, &lines);
    if (status == SL_OK)
        status = sli_planar_make_up_to(f->context, source, lines.items.items, lines.items.count,
                                       weld, MOST_CROSSINGS, &graph);
    if (status == SL_OK)
        status = sli_triangulate(f->context, &graph, &f->out->box, &f->out->triangles);
    if (status == SL_OK) status = take_labels(f, &graph, lines.wall_count);
    sli_planar_destroy(f->context, &graph);
    sl_free(f->context, lines.items.items);
    return status;
}

// --- all of it

/// Walls that stop steps, doors, and entrances that are found, as segments.
static sl_status list_walls(sl_context *context, const sl_map *map, sli_mesh_lines *lines) {
    for (size_t i = 0; i < map->wall_count; i++)
        SL_TRY(sli_mesh_add_line(context, lines, (sl_segment){map->walls[i].a, map->walls[i].b}));
    for (size_t i = 0; i < map->door_count; i++) {
        const sl_door *door = &map->doors[i];
        for (size_t k = 0; k < door->part_count; k++)
            SL_TRY(sli_mesh_add_line(context, lines, door->parts[k]));
        if (!door->parts) SL_TRY(sli_mesh_add_line(context, lines, door->segment));
    }
    for (size_t i = 0; i < map->seam_count; i++)
        if (map->seams[i].entrance || map->seams[i].stops & SL_STOPS_STEPS)
            SL_TRY(sli_mesh_add_line(context, lines, map->seams[i].segment));
    return SL_OK;
}

static sl_status make_boxes(finder *f) {
    const size_t count = f->walls.edge_count;
    sl_box *boxes = sl_alloc_array(f->context, count, sizeof *boxes);
    if (!boxes) return SL_NO_MEMORY;
    for (uint32_t i = 0; i < count; i++) {
        const sl_segment wall = sli_planar_at(&f->walls, 2 * i);
        boxes[i] = sli_box_around(wall.a, wall.b);
    }
    const sl_status status = sli_box_tree_create(f->context, boxes, count, &f->boxes);
    sl_free(f->context, boxes);
    return status;
}

/// Finds ends and feet; once more, and stricter, where there are too many.
static sl_status find_places(finder *f) {
    SL_TRY(find_between_ends(f));
    SL_TRY(find_feet(f));
    if (f->out->items.count <= CROWDED) return SL_OK;
    f->crowded = true;
    f->out->items.count = f->feet.count = 0;
    SL_TRY(make_boxes(f));
    SL_TRY(find_between_ends(f));
    return find_feet(f);
}

static sl_status find(finder *f, const sl_map *map, sli_mesh_lines *lines) {
    const char *source = sli_map_name(map);
    const sl_box bounds = sl_map_bounds(map);
    const double weld = sli_planar_tolerance(&bounds);
    const double size = fmax(bounds.max.x - bounds.min.x, bounds.max.y - bounds.min.y);
    f->out->box = (sl_box){{bounds.min.x - size, bounds.min.y - size},
                           {bounds.max.x + size, bounds.max.y + size}};
    SL_TRY(list_walls(f->context, map, lines));
    SL_TRY(sli_planar_make(f->context, source, lines->items.items, lines->items.count, weld,
                           &f->walls));
    SL_TRY(sli_triangulate(f->context, &f->walls, &f->out->box, &f->t));
    SL_TRY(find_places(f));
    return triangulate_again(f, source, weld);
}

sl_status sli_channels_make(sl_context *context, const sl_map *map, double most,
                            sli_channels *out) {
    sli_channels channels = {0};
    finder f = {.context = context, .most = most, .out = &channels};
    sli_mesh_lines lines = {0};
    const sl_status status = find(&f, map, &lines);
    sli_planar_destroy(context, &f.walls);
    sli_triangulation_destroy(context, &f.t);
    sli_box_tree_destroy(context, &f.boxes);
    sl_free(context, f.steps.items);
    sl_free(context, f.feet.items);
    sl_free(context, lines.items.items);
    if (status == SL_OK)
        *out = channels;
    else
        sli_channels_destroy(context, &channels);
    return status;
}

void sli_channels_destroy(sl_context *context, sli_channels *channels) {
    sl_free(context, channels->items.items);
    sli_triangulation_destroy(context, &channels->triangles);
    sl_free(context, channels->label);
    sl_free(context, channels->solid);
    *channels = (sli_channels){0};
}

bool sli_channel_stops(const sli_channel *channel, double width) {
    if (channel->width < width / SLACK) return true;
    if (channel->width > width * SLACK) return false;
    const sl_segment w = channel->wall;
    if (sli_same_point(w.a, w.b)) return sli_distance_compare(channel->at.a, w.a, width) <= 0;
    const bool left = sli_orient(channel->at.a, w.a, w.b) > 0;
    const sl_point first = left ? w.a : w.b, last = left ? w.b : w.a;
    const sli_glance glance = {
        .eye.at = channel->at.a, .from.at = first, .to.at = last, .right = first, .left = last};
    return sli_nearest_compare(&glance, width) <= 0;
}

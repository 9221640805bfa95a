/// Openings and doors of a drawing: what swings, bars and layers of doors cut out of walls, and the
/// doors that stand there.
#include "io/parts/choice.h"

#include "geometry/length.h"
#include "map/plans.h"

#include <math.h>
#include <stdint.h>

// --- openings over walls

/// Where the lines of a shape end that begins with a wall: those that the file has one behind
/// another, from end to end, till they are back at the first.
static size_t end_of_shape(const sli_choice *c, const sli_group_run *run, size_t first) {
    const sl_wall *walls = c->map->walls;
    size_t end = first + 1;
    while (end < run->end && walls[end].line == walls[first].line &&
           walls[end].a.x == walls[end - 1].b.x && walls[end].a.y == walls[end - 1].b.y &&
           (walls[end].a.x != walls[first].a.x || walls[end].a.y != walls[first].a.y))
        end++;
    return end;
}

/// A shape that may be an opening: one line or four.
static sl_status add_openings_of_run(sli_choice *c, const sli_group_run *run, double wide,
                                     bool bar) {
    const sl_box bounds = sl_map_bounds(c->map);
    const double size = fmax(bounds.max.x - bounds.min.x, bounds.max.y - bounds.min.y);
    const double longest = sli_choice_longest_door(c);
    for (size_t i = run->first, end; i < run->end; i = end) {
        end = end_of_shape(c, run, i);
        if (sli_choice_gone(c, i)) continue;
        SL_TRY(sli_openings_add(c->contents->context, c->map->walls + i, end - i, wide, size / 400,
                                longest, bar ? i : c->map->wall_count, i, &c->openings));
    }
    return SL_OK;
}

sl_status sli_choice_find_ground(sli_choice *c, double *ground) {
    const sli_group_run *runs = c->contents->runs.items;
    const size_t count = c->contents->runs.count;
    sli_look_shape *shapes = sl_alloc_array(c->contents->context, count, sizeof *shapes);
    if (!shapes) return SL_NO_MEMORY;
    for (size_t i = 0; i < count; i++)
        shapes[i] = (sli_look_shape){runs[i].first, runs[i].end, runs[i].look};
    *ground = sli_looks_ground(c->map, shapes, count, &c->contents->looks);
    sl_free(c->contents->context, shapes);
    return SL_OK;
}

/// Shapes in the colour of the paper, that no name tells of: bars over what is beneath them.
static sl_status find_bars(sli_choice *c, sl_bits *bars) {
    const sli_group_run *runs = c->contents->runs.items;
    const size_t count = c->contents->runs.count;
    sli_looks *looks = &c->contents->looks;
    double ground;
    if (!c->contents->has_looks) return SL_OK;
    SL_TRY(sli_choice_find_ground(c, &ground));
    for (size_t i = 0; i < count; i++) {
        const sli_meaning means = c->contents->groups.items[runs[i].group].means;
        const sli_ink *ink = &looks->items.items[runs[i].look].ink;
        if ((means != SLI_MEANS_NOTHING && means != SLI_MEANS_WALL) ||
            !sli_ink_is_ground(ink, ground))
            continue;
        sl_bits_add(bars, i);
        SL_TRY(add_openings_of_run(c, &runs[i], ink->line ? ink->width : 0, true));
    }
    return SL_OK;
}

/// A door that is drawn open over its wall: from hinge to latch.
static sl_status add_swing_opening(sli_choice *c, sl_point hinge, sl_point latch, double radius) {
    const sl_wall door = {.a = hinge, .b = latch};
    return sli_openings_add(c->contents->context, &door, 1, 0.4 * radius, 0, INFINITY,
                            c->map->wall_count, SIZE_MAX, &c->openings);
}

/// The openings from `first` on are doors, beyond doubt: says how thick the wall may be whose faces
/// each lies between.
static void mark_doors(sli_choice *c, size_t first) {
    const double metre = sli_choice_sure_metre(c), most = metre > 0 ? 0.6 * metre : INFINITY;
    for (size_t i = first; i < c->openings.items.count; i++) {
        sli_opening *door = &c->openings.items.items[i];
        const double length = sli_length(door->to.x - door->from.x, door->to.y - door->from.y);
        door->core = fmin(length / 2, most);
    }
}

/// Half the width of the thinnest line that draws a wall; 0 where none is known.
static double pen_of_walls(const sli_choice *c, const sl_bits *kept) {
    double width = INFINITY;
    for (size_t i = 0; c->contents->has_looks && i < c->contents->runs.count; i++) {
        const sli_group_run *run = &c->contents->runs.items[i];
        const sli_ink *ink = &c->contents->looks.items.items[run->look].ink;
        if (ink->line && sl_bits_has(kept, run->first)) width = fmin(width, ink->width);
    }
    return width < INFINITY ? width / 2 : 0;
}

/// The openings from `first` on may lie at the edge of a wall's line, as wide as it is drawn, if
/// they are no wider: a leaf beside the wall is. Of a shape of several boxes the longest is the
/// door, and the others are its jambs.
static void mark_pen(sli_choice *c, size_t first, double pen) {
    sli_opening *items = c->openings.items.items;
    for (size_t i = first, end; i < c->openings.items.count; i = end) {
        const uint32_t line = c->map->walls[items[i].shape].line;
        double longest = 0;
        for (end = i; end < c->openings.items.count; end++) {
            const sli_opening *o = &items[end];
            if (c->map->walls[o->shape].line != line) break;
            longest = fmax(longest, sli_length(o->to.x - o->from.x, o->to.y - o->from.y));
        }
        for (size_t k = i; k < end; k++) {
            const sli_opening *o = &items[k];
            const double length = sli_length(o->to.x - o->from.x, o->to.y - o->from.y);
            if (o->box && o->half <= pen && length >= 0.9 * longest) items[k].pen = pen;
        }
    }
}

static sl_status add_swing_openings(sli_choice *c) {
    const size_t first = c->openings.items.count;
    for (size_t i = 0; i < c->symbols.swings.count; i++) {
        const sli_swing *swing = &c->symbols.swings.items[i];
        SL_TRY(add_swing_opening(c, swing->hinge, swing->latch, swing->radius));
    }
    mark_doors(c, first);
    for (size_t i = 0; i < c->symbols.unsure.count; i++) {
        const sli_swing *swing = &c->symbols.unsure.items[i];
        SL_TRY(add_swing_opening(c, swing->hinge, swing->latch, swing->radius));
        SL_TRY(add_swing_opening(c, swing->hinge, swing->tip, swing->radius));
    }
    return SL_OK;
}

// --- doors that open nothing

/// What the ends of a door touch: a wall, and one away from its ends.
typedef struct touching {
    bool any[2], amid[2];
} touching;

static void touch(const sl_wall *door, const sl_wall *wall, touching *t) {
    const double length = sli_length(door->b.x - door->a.x, door->b.y - door->a.y);
    for (int i = 0; i < 2; i++) {
        const sl_point end = i ? door->b : door->a, at = sli_nearest_on(wall->a, wall->b, end);
        if (sli_length(at.x - end.x, at.y - end.y) > 0.05 * length) continue;
        t->any[i] = true;
        t->amid[i] |= sli_length(at.x - wall->a.x, at.y - wall->a.y) > 0.3 * length &&
                      sli_length(at.x - wall->b.x, at.y - wall->b.y) > 0.3 * length;
    }
}

/// Whether a line stands at a wall away from its ends, and leads to no other wall: a leaf stands
/// at the end of a wall, and a door in a gap between two.
static bool opens_nothing(const sli_choice *c, size_t door) {
    touching t = {.any = {false}};
    for (size_t i = 0; i < c->map->wall_count; i++)
        if (!sli_choice_gone(c, i) && sli_choice_takes(c, c->means[i]))
            touch(&c->map->walls[door], &c->map->walls[i], &t);
    return (t.amid[0] && !t.any[1]) || (t.amid[1] && !t.any[0]);
}

/// How many lines on layers of doors open nothing, where no door is drawn open and none lies over a
/// wall. Time doors x walls; 0 for very many.
static size_t count_shut(const sli_choice *c) {
    enum { MOST = 10000000 };
    size_t doors = 0, shut = 0;
    if (c->symbols.doors || c->cuts || sli_contents_said(c->contents)) return 0;
    for (size_t i = 0; i < c->contents->runs.count; i++) {
        const sli_group_run *run = &c->contents->runs.items[i];
        if (c->contents->groups.items[run->group].means != SLI_MEANS_DOOR) continue;
        doors += run->end - run->first;
        if (doors > MOST / c->map->wall_count) return 0;
        for (size_t k = run->first; k < run->end; k++) shut += opens_nothing(c, k);
    }
    return shut;
}

// --- all openings

sl_status sli_choice_find_openings(sli_choice *c) {
    sl_context *context = c->contents->context;
    const sli_group_run *runs = c->contents->runs.items;
    const size_t count = c->contents->runs.count;
    sl_bits *bars = sl_alloc_array(context, sl_bits_words(count), sizeof *bars);
    sl_bits *kept = sl_alloc_array(context, sl_bits_words(c->map->wall_count), sizeof *kept);
    sl_status status = bars && kept ? find_bars(c, bars) : SL_NO_MEMORY;
    const size_t first_door = c->first_door = c->openings.items.count;
    for (size_t i = 0; i < first_door; i++)
        c->openings.items.items[i].window = c->symbols.doors > 0;
    if (status == SL_OK) status = add_swing_openings(c);
    const size_t first_of_layer = c->openings.items.count;
    for (size_t i = 0; status == SL_OK && i < count; i++)
        if (c->contents->groups.items[runs[i].group].means == SLI_MEANS_DOOR)
            status = add_openings_of_run(c, &runs[i], 0, false);
    mark_doors(c, first_of_layer);
    for (size_t i = 0; status == SL_OK && i < count; i++)
        for (size_t k = runs[i].first; k < runs[i].end && !sl_bits_has(bars, i); k++)
            if (!sli_choice_gone(c, k) && sli_choice_takes(c, c->means[k]) &&
                c->means[k] != SLI_MEANS_WINDOW)
                sl_bits_add(kept, k);
    if (status == SL_OK) mark_pen(c, first_of_layer, pen_of_walls(c, kept));
    if (status == SL_OK) status = sli_openings_cut(context, c->map, kept, &c->openings);
    for (size_t i = 0; status == SL_OK && i < c->openings.items.count; i++) {
        const sli_opening *o = &c->openings.items.items[i];
        if (!o->cuts) continue;
        c->cuts += !o->window;
        c->glazed += o->window;
        if (i >= first_door) continue;
        for (size_t k = o->shape; k < c->map->wall_count; k++) {
            const sl_wall *wall = &c->map->walls[k];
            if (wall->line != c->map->walls[o->shape].line || k > o->shape + 3) break;
            c->kept -= !sli_choice_gone(c, k) && sli_choice_takes(c, c->means[k]);
            sl_bits_add(c->symbols.gone, k);
        }
    }
    if (status == SL_OK) c->shut = count_shut(c);
    sl_free(context, bars);
    sl_free(context, kept);
    return status;
}

// --- doors

/// The ends of doors, each with the end of a wall that is next to it.
typedef struct joints {
    sl_point *at, *to;
    double *reach; ///< how far the end of a wall may be; the distance to the nearest one
    sl_point end;  ///< of the wall at hand
} joints;

static void join(void *user, size_t number) {
    joints *j = user;
    const double away = sli_length(j->at[number].x - j->end.x, j->at[number].y - j->end.y);
    if (away >= j->reach[number]) return;
    j->reach[number] = away;
    j->to[number] = j->end;
}

/// Moves hinges and latches to the walls that they stand at, across the frame: a shut door leaves
/// no slit.
static sl_status join_doors(sli_choice *c, joints *j, size_t count, double reach) {
    sl_context *context = c->contents->context;
    sli_near near = {0};
    sl_status status = sli_near_make(context, j->at, count, reach, &near);
    for (size_t i = 0; status == SL_OK && i < c->map->wall_count; i++) {
        if (i % 4096 == 0) status = sl_check_cancelled(context);
        if (sli_choice_gone(c, i) || !sli_choice_takes(c, c->means[i])) continue;
        j->end = c->map->walls[i].a;
        sli_near_each(&near, j->end, j, join);
        j->end = c->map->walls[i].b;
        sli_near_each(&near, j->end, j, join);
    }
    sli_near_destroy(context, &near);
    return status;
}

static sl_status add_door(sli_choice *c, sl_point a, sl_point b, bool open) {
    char name[32];
    if (a.x == b.x && a.y == b.y) return SL_OK;
    snprintf(name, sizeof name, "door%zu", c->map->door_count + 1);
    c->doors++;
    return sl_map_add_door(c->contents->context, c->map, name, (sl_segment){a, b}, open, 0);
}

static sl_status add_swings(sli_choice *c) {
    sl_context *context = c->contents->context;
    const size_t count = c->symbols.swings.count;
    joints j = {.at = sl_alloc_array(context, 2 * count + 1, sizeof *j.at),
                .to = sl_alloc_array(context, 2 * count + 1, sizeof *j.to),
                .reach = sl_alloc_array(context, 2 * count + 1, sizeof *j.reach)};
    sl_status status = j.at && j.to && j.reach ? SL_OK : SL_NO_MEMORY;
    double widest = 0;
    for (size_t i = 0; status == SL_OK && i < count; i++) {
        const sli_swing *swing = &c->symbols.swings.items[i];
        j.at[2 * i] = j.to[2 * i] = swing->hinge;
        j.at[2 * i + 1] = j.to[2 * i + 1] = swing->latch;
        j.reach[2 * i] = j.reach[2 * i + 1] = 0.15 * swing->radius;
        widest = fmax(widest, swing->radius);
    }
    if (status == SL_OK && count) status = join_doors(c, &j, 2 * count, 0.15 * widest);
    for (size_t i = 0; status == SL_OK && i < count; i++)
        status = add_door(c, j.to[2 * i], j.to[2 * i + 1], true);
    sl_free(context, j.at);
    sl_free(context, j.to);
    sl_free(context, j.reach);
    return status;
}

static sl_point between(sl_point a, sl_point b) {
    return (sl_point){a.x / 2 + b.x / 2, a.y / 2 + b.y / 2};
}

/// A door of a layer without swings: a line by itself, or the middle line of a closed outline of
/// four corners.
static sl_status add_drawn(sli_choice *c, const sl_wall *walls, size_t count) {
    const sl_wall first = walls[0], second = walls[count > 1];
    if (count == 1) return add_door(c, first.a, first.b, true);
    if (count != 4 || walls[3].b.x != first.a.x || walls[3].b.y != first.a.y) return SL_OK;
    const bool along = sli_length(first.b.x - first.a.x, first.b.y - first.a.y) >=
                       sli_length(second.b.x - second.a.x, second.b.y - second.a.y);
    const sl_point corners[5] = {first.a, first.b, second.b, walls[3].a, first.a};
    const int at = along ? 1 : 0;
    return add_door(c, between(corners[at], corners[at + 1]),
                    between(corners[at + 2], corners[(at + 3) % 4]), true);
}

/// Adds doors where the shapes of one entity cut walls, a door a shape. *next: the opening to look
/// at first, as both come in the order of the file.
static sl_status add_cutting(sli_choice *c, size_t first, size_t end, size_t *next, bool *any) {
    size_t last = SIZE_MAX;
    for (; *next < c->openings.items.count; ++*next) {
        const sli_opening *o = &c->openings.items.items[*next];
        if (o->shape == SIZE_MAX) continue;
        if (o->shape >= end) break;
        if (!o->cuts || o->shape < first || o->shape == last) continue;
        last = o->shape;
        *any = true;
        SL_TRY(add_door(c, o->at.a, o->at.b, true));
    }
    return SL_OK;
}

static sl_status add_doors_of_run(sli_choice *c, const sli_group_run *run, size_t *next) {
    const sl_wall *walls = c->map->walls;
    for (size_t i = run->first; i < run->end; i++)
        if (sli_choice_gone(c, i)) return SL_OK;
    for (size_t i = run->first, entity, end; i < run->end; i = entity) {
        bool cuts = false;
        entity = i + 1;
        while (entity < run->end && walls[entity].line == walls[i].line) entity++;
        SL_TRY(add_cutting(c, i, entity, next, &cuts));
        for (; i < entity && !cuts; i = end) {
            end = end_of_shape(c, run, i);
            SL_TRY(add_drawn(c, walls + i, end - i));
        }
    }
    return SL_OK;
}

sl_status sli_choice_add_doors(sli_choice *c) {
    if (!c->contents->options->doors) return SL_OK;
    SL_TRY(add_swings(c));
    size_t next = c->first_door;
    for (size_t i = 0; !c->symbols.doors && i < c->contents->runs.count; i++) {
        const sli_group_run *run = &c->contents->runs.items[i];
        if (c->contents->groups.items[run->group].means == SLI_MEANS_DOOR)
            SL_TRY(add_doors_of_run(c, run, &next));
    }
    return SL_OK;
}

// --- doors between parts of the drawing

/// Which plan of a sheet a place belongs to; their count for none.
static size_t plan_at(const sli_sheet *sheet, sl_point at, double near) {
    size_t i = 0;
    for (; i < sheet->count; i++) {
        const sl_box b = sheet->plans[i].bounds;
        if (at.x >= b.min.x - near && at.x <= b.max.x + near && at.y >= b.min.y - near &&
            at.y <= b.max.y + near)
            break;
    }
    return i;
}

sl_status sli_choice_join_plans(const sli_choice *c) {
    sli_sheet sheet;
    if (!c->openings.items.count) return SL_OK;
    SL_TRY(sli_sheet_find(c->contents->context, c->map, &sheet));
    for (size_t i = 0; i < c->openings.items.count && sheet.count; i++) {
        const sli_opening *door = &c->openings.items.items[i];
        const double length = sli_length(door->to.x - door->from.x, door->to.y - door->from.y);
        const size_t from = plan_at(&sheet, door->from, length / 10);
        const size_t to = plan_at(&sheet, door->to, length / 10);
        c->map->source.joined |= from != to && from < sheet.count && to < sheet.count;
    }
    return SL_OK;
}

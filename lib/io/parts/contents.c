/// Which layers of a drawing are walls.
///
/// Names decide first. Where none says what is a wall, the looks of shapes do (drawn_looks.h). If
/// some layer is named as walls, these layers are the walls, windows are windows, and all else is
/// passed over. Else layers are passed over that are named as something else. Symbols are taken out
/// of what is left: swings of doors, hatching, steps.
///
/// Three walls enclose the least room. A choice that leaves fewer is none: then all visible layers
/// are walls. The note names every layer that is passed over, and the option that chooses.
#include "io/parts/contents.h"

#include "geometry/length.h"
#include "io/parts/choice.h"
#include "io/parts/plan_doubt.h"

#include <math.h>
#include <stdint.h>
#include <strings.h>

// --- groups and their walls

/// So many names are told apart; each is held against some thousand words.
enum { MOST_GROUPS = 4096, LEAST_WALLS = 3 };

void sli_contents_destroy(sli_contents *contents) {
    for (size_t i = 0; i < contents->groups.count; i++)
        sl_free(contents->context, contents->groups.items[i].name);
    sl_free(contents->context, contents->groups.items);
    sl_free(contents->context, contents->runs.items);
    sl_free(contents->context, contents->table);
    sl_free(contents->context, contents->looks.items.items);
}

static bool is_named(const sli_group *group, sli_word name) {
    return group->length == name.length && strncasecmp(group->name, name.at, name.length) == 0;
}

static sl_status add_group(sli_contents *contents, sli_word name) {
    SL_TRY(SL_ARRAY_ROOM(contents->context, &contents->groups, 1));
    char *copy = sl_copy_text(contents->context, name.at, name.length);
    if (!copy) return SL_NO_MEMORY;
    sli_meaning means = sli_meaning_of(name);
    sli_roles_find(contents->roles, name, &means);
    contents->groups.items[contents->groups.count++] =
        (sli_group){.name = copy, .length = name.length, .means = means};
    return SL_OK;
}

sl_status sli_contents_group(sli_contents *contents, sli_word name, uint32_t *group) {
    *group = 0;
    if (!contents->table) {
        contents->table_size = (size_t)2 * MOST_GROUPS;
        contents->table =
            sl_alloc_array(contents->context, contents->table_size, sizeof *contents->table);
        if (!contents->table) return SL_NO_MEMORY;
    }
    if (!contents->groups.count) SL_TRY(add_group(contents, (sli_word){"", 0}));
    if (!name.length) return SL_OK;
    if (is_named(&contents->groups.items[contents->last], name)) {
        *group = contents->last;
        return SL_OK;
    }
    sl_random hash = {0};
    for (size_t i = 0; i < name.length; i++)
        hash.state = hash.state * 0x100000001b3u + ((unsigned char)name.at[i] | 0x20u);
    size_t at = (size_t)sl_random_next(&hash) % contents->table_size;
    for (; contents->table[at]; at = (at + 1) % contents->table_size)
        if (is_named(&contents->groups.items[contents->table[at]], name)) break;
    if (!contents->table[at]) {
        if (contents->groups.count == MOST_GROUPS) return SL_OK;
        SL_TRY(add_group(contents, name));
        contents->table[at] = (uint32_t)(contents->groups.count - 1);
    }
    *group = contents->last = contents->table[at];
    return SL_OK;
}

bool sli_contents_asks(const sli_contents *contents) {
    return !sli_contents_said(contents) || contents->options->doors;
}

void sli_contents_begin(sli_contents *contents, sli_pen *pen) {
    contents->first = pen->map->wall_count;
    contents->finest = pen->finest;
    pen->finest = 0;
}

sl_status sli_contents_end(sli_contents *contents, sli_pen *pen, uint32_t group) {
    if (!contents->groups.count) SL_TRY(add_group(contents, (sli_word){"", 0}));
    sli_group *of = &contents->groups.items[group];
    const size_t end = pen->map->wall_count, count = contents->runs.count;
    sli_keep_finest(&of->finest, pen->finest);
    pen->finest = contents->finest;
    if (end == contents->first) return SL_OK;
    of->shapes++;
    of->walls += end - contents->first;
    sli_group_run *last = count ? &contents->runs.items[count - 1] : NULL;
    if (!contents->has_looks && last && last->group == group && last->end == contents->first) {
        last->end = end;
        return SL_OK;
    }
    SL_TRY(SL_ARRAY_ROOM(contents->context, &contents->runs, 1));
    contents->runs.items[contents->runs.count++] =
        (sli_group_run){contents->first, end, group, contents->look};
    return SL_OK;
}

void sli_contents_cut(sli_contents *contents, size_t first, const size_t *ends) {
    for (size_t i = contents->runs.count; i-- > 0 && contents->runs.items[i].end > first;) {
        sli_group_run *run = &contents->runs.items[i];
        size_t *walls = &contents->groups.items[run->group].walls;
        *walls -= run->end - run->first;
        if (run->first > first) run->first = ends[run->first - first - 1];
        run->end = ends[run->end - first - 1];
        *walls += run->end - run->first;
    }
}

// --- the choice

static sl_status find_symbols(sli_choice *c) {
    const bool said = sli_contents_said(c->contents);
    c->means = sl_alloc(c->contents->context, c->map->wall_count);
    if (!c->means) return SL_NO_MEMORY;
    memset(c->means, SLI_MEANS_OTHER, c->map->wall_count); // walls of layers of our own
    for (size_t i = 0; i < c->contents->runs.count; i++) {
        const sli_group_run *run = &c->contents->runs.items[i];
        memset(c->means + run->first, (int)c->contents->groups.items[run->group].means,
               run->end - run->first);
        sli_meaning role;
        const sli_looks *looks = &c->contents->looks;
        if (!c->contents->roles || !c->contents->has_looks) continue;
        const char *look = looks->items.items[run->look].name;
        if (sli_roles_find(c->contents->roles, (sli_word){look, strlen(look)}, &role))
            memset(c->means + run->first, (int)role, run->end - run->first);
    }
    size_t named = 0;
    for (size_t i = 0; i < c->map->wall_count; i++) named += c->means[i] == SLI_MEANS_WALL;
    const sli_meaning walls = named >= LEAST_WALLS ? SLI_MEANS_WALL : SLI_MEANS_NOTHING;
    return sli_symbols_find(c->contents->context, c->map, c->means, said ? SLI_MEANINGS : walls,
                            said, c->metre, &c->symbols);
}

static bool is_taken(const sli_choice *c, sli_meaning means) {
    if (sli_contents_said(c->contents)) return means != SLI_MEANS_DOOR;
    return means == SLI_MEANS_WALL || means == SLI_MEANS_WINDOW ||
           (means == SLI_MEANS_NOTHING && !c->walls_named);
}

static void count_named(sli_choice *c) {
    size_t named = 0;
    for (size_t i = 0; i < c->map->wall_count; i++)
        named += c->means[i] == SLI_MEANS_WALL && !sli_choice_gone(c, i);
    c->walls_named = named >= LEAST_WALLS;
}

/// Among shapes that no name tells apart, those that do not look like walls get another meaning.
static sl_status choose_looks(sli_choice *c) {
    const sli_group_run *runs = c->contents->runs.items;
    const size_t count = c->contents->runs.count;
    if (!c->contents->has_looks || c->walls_named || sli_contents_said(c->contents)) return SL_OK;
    sli_look_shape *shapes = sl_alloc_array(c->contents->context, count, sizeof *shapes);
    sl_bits *taken = sl_alloc_array(c->contents->context, sl_bits_words(count), sizeof *taken);
    size_t used = 0;
    for (size_t i = 0; shapes && i < count; i++)
        if (c->means[runs[i].first] == SLI_MEANS_NOTHING && !sli_choice_gone(c, runs[i].first))
            shapes[used++] = (sli_look_shape){runs[i].first, runs[i].end, runs[i].look};
    if (used && taken)
        c->share = sli_looks_choose(c->map, shapes, used, &c->contents->looks, taken, &c->by_looks);
    for (size_t i = 0; i < used && c->by_looks; i++) {
        if (sl_bits_has(taken, i)) continue;
        memset(c->means + shapes[i].first, SLI_MEANS_OTHER, shapes[i].end - shapes[i].first);
        c->contents->left_out++;
        c->words += c->contents->looks.items.items[shapes[i].look].taken;
    }
    const bool room = shapes && taken;
    sl_free(c->contents->context, shapes);
    sl_free(c->contents->context, taken);
    return room ? SL_OK : SL_NO_MEMORY;
}

/// Marks the groups that are taken. False where the choice is none, or changes nothing.
static bool choose_groups(sli_choice *c) {
    bool changes = c->by_looks || c->symbols.leaves + c->symbols.lines > 0;
    for (size_t i = 0; i < c->contents->groups.count; i++) {
        sli_group *group = &c->contents->groups.items[i];
        group->taken = is_taken(c, group->means);
        const bool window = group->means == SLI_MEANS_WINDOW && !sli_contents_said(c->contents);
        changes |= group->walls && (!group->taken || window);
    }
    for (size_t i = 0; i < c->contents->runs.count; i++) {
        const sli_group_run *run = &c->contents->runs.items[i];
        for (size_t j = run->first; j < run->end; j++) {
            const bool kept = !sli_choice_gone(c, j) && is_taken(c, c->means[j]);
            c->kept += kept;
            c->contents->groups.items[run->group].taken |= kept; // by the role of its look
            changes |= c->contents->roles && !kept;
        }
    }
    return changes && (c->kept >= LEAST_WALLS || sli_contents_said(c->contents));
}

/// Where neither names nor looks say what is a wall: finds what is no wall by its shape, among what
/// is taken.
static sl_status find_parts(sli_choice *c) {
    sl_context *context = c->contents->context;
    if (c->walls_named || c->by_looks || sli_contents_said(c->contents)) return SL_OK;
    const size_t count = c->map->wall_count;
    sl_map taken = {0};
    size_t *number = sl_alloc_array(context, count, sizeof *number);
    taken.walls = sl_alloc_array(context, count, sizeof *taken.walls);
    sl_status status = number && taken.walls ? SL_OK : SL_NO_MEMORY;
    for (size_t i = 0; status == SL_OK && i < count; i++) {
        if (sli_choice_gone(c, i) || !is_taken(c, c->means[i])) continue;
        number[taken.wall_count] = i;
        taken.walls[taken.wall_count++] = c->map->walls[i];
    }
    if (status == SL_OK)
        status = sli_plan_parts_find(context, &taken, sli_choice_metre(c), &c->parts);
    for (size_t i = 0; status == SL_OK && c->parts.gone && i < taken.wall_count; i++)
        if (sl_bits_has(c->parts.gone, i)) sl_bits_add(c->symbols.gone, number[i]);
    c->kept -= sli_plan_parts_count(&c->parts);
    sl_free(context, number);
    sl_free(context, taken.walls);
    return status;
}

// --- what layers are taken for

/// What most walls of a layer are taken for; those that a symbol is made of do not count.
typedef struct tally {
    size_t shapes, walls[SLI_MEANINGS];
} tally;

static sl_status list_one(const sli_choice *c, const char *name, size_t length, const tally *t,
                          sl_drawing_layers *out) {
    if (!length || !t->shapes) return SL_OK;
    char *copy = sl_copy_text(c->contents->context, name, length);
    if (!copy) return SL_NO_MEMORY;
    sli_meaning most = SLI_MEANS_NOTHING;
    for (int i = 0; i < SLI_MEANINGS; i++)
        if (t->walls[i] > t->walls[most]) most = (sli_meaning)i;
    const bool wall = most == SLI_MEANS_NOTHING && is_taken(c, most);
    out->items[out->count++] =
        (sl_drawing_layer){copy, t->shapes, true, sli_role_name(wall ? SLI_MEANS_WALL : most)};
    return SL_OK;
}

static void count_one(const sli_choice *c, const sli_group_run *run, tally *t) {
    t->shapes++;
    for (size_t i = run->first; i < run->end; i++) t->walls[c->means[i]]++;
}

static sl_status list_all(sli_choice *c, sl_drawing_layers *out) {
    const sli_contents *contents = c->contents;
    sl_context *context = contents->context;
    const size_t groups = contents->groups.count, looks = contents->looks.items.count;
    tally *tallies = sl_alloc_array(context, groups + looks + 1, sizeof *tallies);
    out->items = sl_alloc_array(context, groups + looks + 1, sizeof *out->items);
    sl_status status = tallies && out->items ? SL_OK : SL_NO_MEMORY;
    for (size_t i = 0; i < contents->runs.count && status == SL_OK; i++) {
        const sli_group_run *run = &contents->runs.items[i];
        count_one(c, run, &tallies[run->group]);
        if (contents->has_looks) count_one(c, run, &tallies[groups + run->look]);
    }
    for (size_t i = 0; i < groups && status == SL_OK; i++) {
        const sli_group *group = &contents->groups.items[i];
        tallies[i].shapes = group->shapes;
        status = list_one(c, group->name, group->length, &tallies[i], out);
    }
    for (size_t i = 0; i < looks && status == SL_OK; i++) {
        const char *name = contents->looks.items.items[i].name;
        status = list_one(c, name, strlen(name), &tallies[groups + i], out);
    }
    sl_free(context, tallies);
    return status;
}

sl_status sli_contents_list(sli_contents *contents, sl_map *map, double metre,
                            sl_drawing_layers *out) {
    sli_choice c = {.contents = contents, .map = map, .metre = metre};
    sl_status status = find_symbols(&c);
    if (status == SL_OK) count_named(&c);
    if (status == SL_OK) status = choose_looks(&c);
    if (status == SL_OK) status = list_all(&c, out);
    sl_free(contents->context, c.means);
    sli_symbols_destroy(contents->context, &c.symbols);
    return status;
}

const char *sli_contents_role(const sl_drawing_layers *list, sli_word name) {
    for (size_t i = 0; i < list->count; i++)
        if (strlen(list->items[i].name) == name.length &&
            strncasecmp(list->items[i].name, name.at, name.length) == 0)
            return list->items[i].taken_for;
    return sli_role_name(SLI_MEANS_OTHER);
}

// --- openings over walls

/// A shape that may be an opening: one line or four, that the file has one behind another.
static sl_status add_openings_of_run(sli_choice *c, const sli_group_run *run, double wide,
                                     bool bar) {
    const sl_box bounds = sl_map_bounds(c->map);
    const double size = fmax(bounds.max.x - bounds.min.x, bounds.max.y - bounds.min.y);
    for (size_t i = run->first, end; i < run->end; i = end) {
        const sl_wall *walls = c->map->walls;
        for (end = i + 1; end < run->end; end++)
            if (walls[end].line != walls[i].line || walls[end].a.x != walls[end - 1].b.x ||
                walls[end].a.y != walls[end - 1].b.y)
                break;
        if (sli_choice_gone(c, i)) continue;
        SL_TRY(sli_openings_add(c->contents->context, walls + i, end - i, wide, size / 400,
                                sli_choice_longest_door(c), bar ? i : c->map->wall_count, i,
                                &c->openings));
    }
    return SL_OK;
}

/// Shapes in the colour of the paper, that no name tells of: bars over what is beneath them.
static sl_status find_bars(sli_choice *c, sl_bits *bars) {
    const sli_group_run *runs = c->contents->runs.items;
    const size_t count = c->contents->runs.count;
    sli_looks *looks = &c->contents->looks;
    if (!c->contents->has_looks) return SL_OK;
    sli_look_shape *shapes = sl_alloc_array(c->contents->context, count, sizeof *shapes);
    if (!shapes) return SL_NO_MEMORY;
    for (size_t i = 0; i < count; i++)
        shapes[i] = (sli_look_shape){runs[i].first, runs[i].end, runs[i].look};
    const double ground = sli_looks_ground(c->map, shapes, count, looks);
    sl_free(c->contents->context, shapes);
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

static sl_status add_swing_openings(sli_choice *c) {
    for (size_t i = 0; i < c->symbols.swings.count; i++) {
        const sli_swing *swing = &c->symbols.swings.items[i];
        SL_TRY(add_swing_opening(c, swing->hinge, swing->latch, swing->radius));
    }
    for (size_t i = 0; i < c->symbols.unsure.count; i++) {
        const sli_swing *swing = &c->symbols.unsure.items[i];
        SL_TRY(add_swing_opening(c, swing->hinge, swing->latch, swing->radius));
        SL_TRY(add_swing_opening(c, swing->hinge, swing->tip, swing->radius));
    }
    return SL_OK;
}

/// Finds the openings that lie over walls. Bars that cut are no walls themselves. Where doors are
/// drawn as doors, other bars are windows.
static sl_status find_openings(sli_choice *c) {
    sl_context *context = c->contents->context;
    const sli_group_run *runs = c->contents->runs.items;
    const size_t count = c->contents->runs.count;
    sl_bits *bars = sl_alloc_array(context, sl_bits_words(count), sizeof *bars);
    sl_bits *kept = sl_alloc_array(context, sl_bits_words(c->map->wall_count), sizeof *kept);
    sl_status status = bars && kept ? find_bars(c, bars) : SL_NO_MEMORY;
    const size_t first_door = c->openings.items.count;
    for (size_t i = 0; i < first_door; i++)
        c->openings.items.items[i].window = c->symbols.doors > 0;
    if (status == SL_OK) status = add_swing_openings(c);
    for (size_t i = 0; status == SL_OK && i < count; i++)
        if (c->contents->groups.items[runs[i].group].means == SLI_MEANS_DOOR)
            status = add_openings_of_run(c, &runs[i], 0, false);
    for (size_t i = 0; status == SL_OK && i < count; i++)
        for (size_t k = runs[i].first; k < runs[i].end && !sl_bits_has(bars, i); k++)
            if (!sli_choice_gone(c, k) && is_taken(c, c->means[k]) &&
                c->means[k] != SLI_MEANS_WINDOW)
                sl_bits_add(kept, k);
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
            c->kept -= !sli_choice_gone(c, k) && is_taken(c, c->means[k]);
            sl_bits_add(c->symbols.gone, k);
        }
    }
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
        if (sli_choice_gone(c, i) || !is_taken(c, c->means[i])) continue;
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

static sl_status add_doors_of_run(sli_choice *c, const sli_group_run *run) {
    for (size_t i = run->first; i < run->end; i++)
        if (sli_choice_gone(c, i)) return SL_OK;
    for (size_t i = 0; i < c->openings.items.count; i++) {
        const sli_opening *o = &c->openings.items.items[i];
        if (o->cuts && o->shape >= run->first && o->shape < run->end)
            return add_door(c, o->at.a, o->at.b, true);
    }
    for (size_t i = run->first, end; i < run->end; i = end) {
        const sl_wall *walls = c->map->walls;
        for (end = i + 1; end < run->end; end++)
            if (walls[end].line != walls[i].line || walls[end].a.x != walls[end - 1].b.x ||
                walls[end].a.y != walls[end - 1].b.y)
                break;
        SL_TRY(add_drawn(c, walls + i, end - i));
    }
    return SL_OK;
}

static sl_status add_doors(sli_choice *c) {
    if (!c->contents->options->doors) return SL_OK;
    SL_TRY(add_swings(c));
    for (size_t i = 0; !c->symbols.doors && i < c->contents->runs.count; i++) {
        const sli_group_run *run = &c->contents->runs.items[i];
        if (c->contents->groups.items[run->group].means == SLI_MEANS_DOOR)
            SL_TRY(add_doors_of_run(c, run));
    }
    return SL_OK;
}

// --- walls and windows

/// Puts what openings leave of a wall behind the others. Returns how many pieces that is.
static size_t put_pieces(const sli_choice *c, size_t wall, size_t *cut, sl_wall *out) {
    const sli_openings *openings = &c->openings;
    sl_wall rest = c->map->walls[wall];
    size_t count = 0;
    double done = 0;
    while (*cut < openings->cuts.count && openings->cuts.items[*cut].wall < wall) ++*cut;
    for (; *cut < openings->cuts.count && openings->cuts.items[*cut].wall == wall; ++*cut) {
        const sli_opening_cut *taken = &openings->cuts.items[*cut];
        if (taken->begin > done) {
            out[count] = rest;
            out[count++].b = taken->at.a;
        }
        if (taken->end <= done) continue;
        done = taken->end;
        rest.a = taken->at.b;
    }
    if (done < 1) out[count++] = rest;
    return count;
}

/// Whether a door cuts a part of what a bar cuts out of the same wall.
static bool has_door(const sli_choice *c, size_t number) {
    const sli_opening_cut *cuts = c->openings.cuts.items, *own = &cuts[number];
    for (size_t i = number; i-- > 0 && cuts[i].wall == own->wall;)
        if (!c->openings.items.items[cuts[i].opening].window && cuts[i].end > own->begin)
            return true;
    for (size_t i = number + 1; i < c->openings.cuts.count && cuts[i].wall == own->wall; i++)
        if (!c->openings.items.items[cuts[i].opening].window && cuts[i].begin < own->end)
            return true;
    return false;
}

/// Adds the glazed pieces of walls to the windows. Returns how many there are then.
static size_t add_glazed(const sli_choice *c, sl_wall *windows, size_t count) {
    for (size_t i = 0; i < c->openings.cuts.count; i++) {
        const sli_opening_cut *cut = &c->openings.cuts.items[i];
        if (!c->openings.items.items[cut->opening].window || has_door(c, i)) continue;
        windows[count] = c->map->walls[cut->wall];
        windows[count].a = cut->at.a;
        windows[count++].b = cut->at.b;
    }
    return count;
}

/// Keeps the walls that are chosen, without what openings take out of them, and makes windows of
/// the rest.
static sl_status keep_walls(sli_choice *c) {
    sl_context *context = c->contents->context;
    sl_map *map = c->map;
    const bool said = sli_contents_said(c->contents);
    const size_t room = map->wall_count + c->openings.cuts.count;
    sl_wall *windows = sl_alloc_array(context, room, sizeof *windows);
    sl_wall *walls = sl_alloc_array(context, room, sizeof *walls);
    sl_wall *low = sl_alloc_array(context, room, sizeof *low);
    if (!windows || !walls || !low) {
        sl_free(context, windows);
        sl_free(context, walls);
        sl_free(context, low);
        return SL_NO_MEMORY;
    }
    size_t kept = 0, count = 0, low_count = 0, run = 0, cut = 0;
    for (size_t i = 0; i < map->wall_count; i++) {
        while (run < c->contents->runs.count && c->contents->runs.items[run].end <= i) run++;
        const bool own = run == c->contents->runs.count || i < c->contents->runs.items[run].first;
        if (!own && c->means[i] == SLI_MEANS_LOW) low[low_count++] = map->walls[i];
        if (!own && (sli_choice_gone(c, i) || !is_taken(c, c->means[i]))) continue;
        if (!own && c->means[i] == SLI_MEANS_WINDOW && !said)
            windows[count++] = map->walls[i];
        else
            kept += put_pieces(c, i, &cut, walls + kept);
    }
    count = add_glazed(c, windows, count);
    map->wall_count = 0;
    sl_status status = sl_map_add_walls(context, map, walls, kept);
    if (status == SL_OK)
        status = sl_map_add_walls(context, map, c->openings.jambs.items, c->openings.jambs.count);
    kept = map->wall_count;
    if (status == SL_OK) status = sl_map_add_walls(context, map, windows, count);
    if (status == SL_OK && count)
        status = sl_map_walls_stop(context, map, kept, SL_STOPS_STEPS | SL_STOPS_SOUND);
    kept = map->wall_count;
    if (status == SL_OK) status = sl_map_add_walls(context, map, low, low_count);
    if (status == SL_OK && low_count)
        status = sl_map_walls_stop(context, map, kept, SL_STOPS_STEPS);
    sl_free(context, walls);
    sl_free(context, windows);
    sl_free(context, low);
    return status;
}

/// Measures what stays, and what is passed over though its name says nothing.
static void measure(sli_choice *c) {
    for (size_t i = 0; i < c->contents->runs.count; i++) {
        const sli_group_run *run = &c->contents->runs.items[i];
        const sli_group *group = &c->contents->groups.items[run->group];
        for (size_t k = run->first; k < run->end; k++) {
            const sl_wall *wall = &c->map->walls[k];
            const double length = sli_length(wall->b.x - wall->a.x, wall->b.y - wall->a.y);
            if (sli_choice_gone(c, k)) continue;
            if (is_taken(c, c->means[k])) c->kept_length += length;
            if (group->taken || group->means != SLI_MEANS_NOTHING) continue;
            c->unknown++;
            c->unknown_length += length;
        }
    }
}

// --- all

static sl_status choose(sli_choice *c, sli_pen *pen) {
    SL_TRY(find_symbols(c));
    count_named(c);
    SL_TRY(choose_looks(c));
    bool chosen = choose_groups(c);
    SL_TRY(find_parts(c));
    chosen |= sli_plan_parts_count(&c->parts) > 0;
    SL_TRY(find_openings(c));
    chosen |= c->cuts + c->glazed > 0;
    for (size_t i = 0; i < c->contents->groups.count; i++) {
        const sli_group *group = &c->contents->groups.items[i];
        if (!chosen || group->taken) sli_keep_finest(&pen->finest, group->finest);
        if (chosen && !group->taken) c->contents->left_out += group->shapes;
    }
    if (!sli_contents_said(c->contents)) sli_choice_note_long_doors(c);
    if (!chosen) {
        sli_choice_note_all(c);
        return SL_OK;
    }
    SL_TRY(add_doors(c));
    measure(c);
    SL_TRY(keep_walls(c));
    for (size_t i = 0; i < c->contents->groups.count; i++)
        pen->walls -= c->contents->groups.items[i].walls;
    pen->walls += c->kept;
    sli_choice_note(c);
    return SL_OK;
}

/// Takes small pieces out of what was chosen, and says so.
static sl_status keep_large(sli_contents *contents, double metre, sli_pen *pen) {
    sli_plan_look look;
    SL_TRY(sli_plan_keep_large(contents->context, pen->map, metre, &look));
    const size_t gone = look.walls - pen->map->wall_count;
    pen->walls -= gone;
    if (look.crowded)
        sl_note(contents->context, "%s: %zu lines are too many, or too dense, for --layers %s",
                contents->file, look.walls, SLI_LAYERS_LARGE);
    else
        sl_note(contents->context,
                "%s: --layers %s leaves out %zu line%s, in small closed pieces that touch nothing",
                contents->file, SLI_LAYERS_LARGE, gone, gone == 1 ? "" : "s");
    return SL_OK;
}

sl_status sli_contents_choose(sli_contents *contents, double metre, sli_pen *pen) {
    sli_choice c = {.contents = contents, .map = pen->map, .metre = metre};
    sl_status status = contents->runs.count ? choose(&c, pen) : SL_OK;
    contents->doors = c.symbols.swings.count;
    contents->door = sli_choice_door(&c);
    if (status == SL_OK && contents->large) status = keep_large(contents, metre, pen);
    if (status == SL_OK && !contents->options->all_layers)
        status = sli_plan_tell(contents->context, contents->file, contents->options->layers,
                               pen->map, metre, 0);
    sl_free(contents->context, c.means);
    sli_symbols_destroy(contents->context, &c.symbols);
    sli_openings_destroy(contents->context, &c.openings);
    sli_plan_parts_destroy(contents->context, &c.parts);
    return status;
}

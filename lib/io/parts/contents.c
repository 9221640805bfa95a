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
#include "io/parts/plan_unit.h"

#include <stdint.h>
#include <strings.h>

// --- groups and their walls

/// So many names are told apart; each is held against some thousand words.
enum { MOST_GROUPS = 4096, LEAST_WALLS = 3, LEAST_DOORS = 3, LEAST_LONG = 2, MOST_OUTLINES = 3 };

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
    const sli_meaning guess = sli_meaning_of(name);
    sli_meaning means = guess;
    const bool said = sli_roles_find(contents->roles, name, &means);
    const bool both =
        (guess == SLI_MEANS_WINDOW || guess == SLI_MEANS_DOOR) && sli_meaning_is_wall_too(name);
    contents->groups.items[contents->groups.count++] =
        (sli_group){.name = copy,
                    .length = name.length,
                    .means = means,
                    .guess = guess,
                    .said = said,
                    .beside = both ? guess : SLI_MEANS_NOTHING};
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
    return !contents->options->all_layers || contents->options->doors;
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
    if (!contents->has_looks && !contents->apart && last && last->group == group &&
        last->end == contents->first) {
        last->end = end;
        return SL_OK;
    }
    SL_TRY(SL_ARRAY_ROOM(contents->context, &contents->runs, 1));
    contents->runs.items[contents->runs.count++] =
        (sli_group_run){contents->first, end, group, contents->look};
    return SL_OK;
}

void sli_contents_move(sli_contents *contents, size_t run, uint32_t group) {
    sli_group_run *moved = &contents->runs.items[run];
    sli_group *from = &contents->groups.items[moved->group], *to = &contents->groups.items[group];
    const size_t walls = moved->end - moved->first;
    sli_keep_finest(&to->finest, from->finest);
    from->shapes--;
    from->walls -= walls;
    to->shapes++;
    to->walls += walls;
    moved->group = group;
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

/// Takes the meanings of groups for their walls.
static void set_means(sli_choice *c) {
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
}

/// Layers that the options name are walls, whatever their names say; but doors stay doors, where
/// `doors`.
static void take_named(sli_choice *c, bool doors) {
    for (size_t i = 0; c->contents->options->layers && i < c->contents->groups.count; i++) {
        sli_group *group = &c->contents->groups.items[i];
        if (group->means != SLI_MEANS_WALL && !(doors && group->means == SLI_MEANS_DOOR))
            group->means = SLI_MEANS_NOTHING;
    }
    set_means(c);
}

static sl_status find_symbols_of(sli_choice *c, sli_meaning walls) {
    const bool all = c->contents->options->all_layers;
    sli_symbols_destroy(c->contents->context, &c->symbols);
    c->symbols = (sli_symbols){0};
    return sli_symbols_find(c->contents->context, c->map, c->means, all ? SLI_MEANINGS : walls, all,
                            c->metre, &c->symbols);
}

/// Where no layer is named as walls, and doors are drawn open on layers that are named as something
/// else alone ("details"), these say nothing: they have the plan.
static sl_status take_layers_of_doors(sli_choice *c) {
    const sli_group_run *runs = c->contents->runs.items;
    sli_group *groups = c->contents->groups.items;
    const size_t count = c->contents->groups.count, walls = c->map->wall_count;
    size_t most = 0, *swings = sl_alloc_array(c->contents->context, count, sizeof *swings);
    if (!swings) return SL_NO_MEMORY;
    for (size_t i = 0; i < walls; i++)
        if (c->means[i] == SLI_MEANS_OTHER) c->means[i] = SLI_MEANS_NOTHING;
    sl_status status = find_symbols_of(c, SLI_MEANS_NOTHING);
    for (size_t i = 0; status == SL_OK && i < c->contents->runs.count; i++)
        for (size_t k = runs[i].first; k < runs[i].end; k++)
            swings[runs[i].group] += sli_choice_gone(c, k);
    for (size_t i = 0; i < count; i++) most = swings[i] > most ? swings[i] : most;
    for (size_t i = 0; c->symbols.doors >= LEAST_DOORS && i < count; i++)
        if (groups[i].means == SLI_MEANS_OTHER && !groups[i].said && 2 * swings[i] >= most)
            groups[i].means = SLI_MEANS_NOTHING;
    sl_free(c->contents->context, swings);
    memset(c->means, SLI_MEANS_OTHER, walls);
    set_means(c);
    return status == SL_OK ? find_symbols_of(c, SLI_MEANS_NOTHING) : status;
}

static sl_status find_symbols(sli_choice *c) {
    c->means = sl_alloc_array(c->contents->context, c->map->wall_count, 1);
    if (!c->means) return SL_NO_MEMORY;
    memset(c->means, SLI_MEANS_OTHER, c->map->wall_count); // walls of layers of our own
    take_named(c, true);
    size_t named = 0, others = 0;
    for (size_t i = 0; i < c->contents->groups.count; i++) {
        const sli_group *group = &c->contents->groups.items[i];
        named += group->guess == SLI_MEANS_WALL ? group->walls : 0;
        others += group->guess == SLI_MEANS_OTHER ? group->walls : 0;
    }
    SL_TRY(find_symbols_of(c, named >= LEAST_WALLS ? SLI_MEANS_WALL : SLI_MEANS_NOTHING));
    if (named < LEAST_WALLS && others && !c->symbols.doors && !sli_contents_said(c->contents))
        SL_TRY(take_layers_of_doors(c));
    take_named(c, c->contents->options->doors);
    return SL_OK;
}

/// Whether names say what is a wall. What the user says of some layers changes nothing for others.
static void count_named(sli_choice *c) {
    size_t named = 0;
    for (size_t i = 0; i < c->contents->runs.count; i++) {
        const sli_group_run *run = &c->contents->runs.items[i];
        if (c->contents->groups.items[run->group].guess != SLI_MEANS_WALL) continue;
        for (size_t k = run->first; k < run->end; k++) named += !sli_choice_gone(c, k);
    }
    c->walls_named = named >= LEAST_WALLS;
}

static sli_word name_of_group(const sli_group *group) {
    return (sli_word){group->name, group->length};
}

static bool is_rooms(const sli_group *group) {
    return group->means == SLI_MEANS_NOTHING && !group->said && group->length &&
           sli_meaning_is_rooms(name_of_group(group));
}

/// How long the lines of each group are, and those of layers of doors that are longer than doors.
static void measure_groups(sli_choice *c) {
    const double most = sli_choice_longest_door(c);
    for (size_t i = 0; i < c->contents->runs.count; i++) {
        const sli_group_run *run = &c->contents->runs.items[i];
        sli_group *group = &c->contents->groups.items[run->group];
        for (size_t k = run->first; k < run->end; k++) {
            const sl_wall *wall = &c->map->walls[k];
            const double length = sli_length(wall->b.x - wall->a.x, wall->b.y - wall->a.y);
            if (sli_choice_gone(c, k)) continue;
            group->length_left += length;
            if (group->means != SLI_MEANS_DOOR || group->said || !(length > most)) continue;
            group->long_ones++;
            group->long_length += length;
        }
    }
}

/// Where lines longer than doors are the most of a layer of doors by length, the layer is one of
/// walls with doors in them, such as partitions.
static void take_walls_on_doors(sli_choice *c) {
    const double most = sli_choice_longest_door(c);
    bool changes = false;
    if (!c->walls_named || !(sli_choice_metre(c) > 0 && most > sli_choice_metre(c))) return;
    for (size_t i = 0; i < c->contents->groups.count; i++) {
        sli_group *group = &c->contents->groups.items[i];
        if (group->long_ones < LEAST_LONG || 2 * group->long_length < group->length_left) continue;
        group->means = SLI_MEANS_WALL;
        changes = true;
    }
    if (changes) set_means(c);
}

/// Where walls have a small part of the lines that outlines of rooms have, these are walls too.
static void take_outlines_of_rooms(sli_choice *c) {
    double walls = 0, outlines = 0;
    if (!c->walls_named) return;
    for (size_t i = 0; i < c->contents->groups.count; i++) {
        const sli_group *group = &c->contents->groups.items[i];
        if (group->means == SLI_MEANS_WALL) walls += group->length_left;
        if (is_rooms(group)) outlines += group->length_left;
    }
    if (MOST_OUTLINES * walls > outlines) return;
    for (size_t i = 0; i < c->contents->groups.count; i++) {
        sli_group *group = &c->contents->groups.items[i];
        if (!is_rooms(group)) continue;
        group->means = SLI_MEANS_WALL;
        c->outlined = true;
    }
    if (c->outlined) set_means(c);
}

/// Beside the nodes of a route graph, layers of edges have no walls.
static void leave_edges(sli_choice *c) {
    bool nodes = false, changes = false;
    for (size_t i = 0; i < c->contents->groups.count; i++)
        nodes |= sli_meaning_is_nodes(name_of_group(&c->contents->groups.items[i]));
    for (size_t i = 0; nodes && i < c->contents->groups.count; i++) {
        sli_group *group = &c->contents->groups.items[i];
        if (group->means || group->said || !sli_meaning_is_edges(name_of_group(group))) continue;
        group->means = SLI_MEANS_GRID;
        changes = true;
    }
    if (changes) set_means(c);
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

/// What each wall means.
static sl_status find_means(sli_choice *c) {
    if (!sli_contents_said(c->contents)) sli_choice_take_both(c);
    SL_TRY(find_symbols(c));
    count_named(c);
    if (!sli_contents_said(c->contents)) {
        leave_edges(c);
        measure_groups(c);
        take_walls_on_doors(c);
        take_outlines_of_rooms(c);
    }
    return choose_looks(c);
}

/// Marks the groups that are taken. False where the choice is none, or changes nothing.
static bool choose_groups(sli_choice *c) {
    bool changes = c->by_looks || c->symbols.leaves + c->symbols.lines > 0;
    for (size_t i = 0; i < c->contents->groups.count; i++) {
        sli_group *group = &c->contents->groups.items[i];
        group->taken = sli_choice_takes(c, group->means);
        const bool window = group->means == SLI_MEANS_WINDOW && !sli_contents_said(c->contents);
        changes |= group->walls && (!group->taken || window);
    }
    for (size_t i = 0; i < c->contents->runs.count; i++) {
        const sli_group_run *run = &c->contents->runs.items[i];
        for (size_t j = run->first; j < run->end; j++) {
            const bool kept = !sli_choice_gone(c, j) && sli_choice_takes(c, c->means[j]);
            c->kept += kept;
            c->contents->groups.items[run->group].taken |= kept; // by the role of its look
            changes |= c->contents->roles && !kept;
        }
    }
    return changes && (c->kept >= LEAST_WALLS || sli_contents_said(c->contents));
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
    const bool wall = most == SLI_MEANS_NOTHING && sli_choice_takes(c, most);
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
    sl_status status = find_means(&c);
    if (status == SL_OK) status = sli_choice_find_left_out(&c);
    if (status == SL_OK) status = list_all(&c, out);
    sl_free(contents->context, c.means);
    sl_free(contents->context, c.left.items);
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
        if (!own && (sli_choice_gone(c, i) || !sli_choice_takes(c, c->means[i]))) continue;
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
            if (sli_choice_takes(c, c->means[k])) c->kept_length += length;
            if (c->by_looks && sli_choice_takes(c, c->means[k]))
                c->contents->looks.items.items[run->look].kept = true;
            if (group->taken || group->means != SLI_MEANS_NOTHING) continue;
            c->unknown++;
            c->unknown_length += length;
        }
    }
}

// --- all

static sl_status choose(sli_choice *c, sli_pen *pen) {
    SL_TRY(find_means(c));
    bool chosen = choose_groups(c);
    SL_TRY(sli_choice_find_parts(c));
    chosen |= sli_plan_parts_count(&c->parts) > 0;
    if (chosen) SL_TRY(sli_choice_find_left_out(c));
    SL_TRY(sli_choice_find_openings(c));
    chosen |= c->cuts + c->glazed > 0;
    for (size_t i = 0; i < c->contents->groups.count; i++) {
        const sli_group *group = &c->contents->groups.items[i];
        if (!chosen || group->taken || group->glazed) sli_keep_finest(&pen->finest, group->finest);
        if (chosen && !group->taken) c->contents->left_out += group->shapes;
    }
    c->contents->left_out -= c->shown;
    if (!sli_contents_said(c->contents)) sli_choice_note_long_doors(c);
    if (!chosen) {
        sli_choice_note_all(c);
        sli_choice_note_both(c);
        return SL_OK;
    }
    SL_TRY(sli_choice_add_doors(c));
    measure(c);
    SL_TRY(keep_walls(c));
    for (size_t i = 0; i < c->contents->groups.count; i++)
        pen->walls -= c->contents->groups.items[i].walls;
    pen->walls += c->kept;
    sli_choice_note(c);
    return SL_OK;
}

/// Whether all walls that are kept are of one layer and one look.
static bool are_alike(const sli_choice *c) {
    const sli_group_run *first = NULL;
    if (c->kept < LEAST_WALLS) return false;
    for (size_t i = 0; i < c->contents->runs.count; i++) {
        const sli_group_run *run = &c->contents->runs.items[i];
        bool kept = false;
        for (size_t k = run->first; k < run->end; k++)
            kept |= !sli_choice_gone(c, k) && sli_choice_takes(c, c->means[k]);
        if (!kept) continue;
        if (!first) first = run;
        if (run->group != first->group || run->look != first->look) return false;
    }
    return true;
}

sl_status sli_contents_choose(sli_contents *contents, double metre, sli_pen *pen) {
    sli_choice c = {.contents = contents, .map = pen->map, .metre = metre};
    sl_status status = contents->runs.count ? choose(&c, pen) : SL_OK;
    if (status == SL_OK) status = sli_choice_join_plans(&c);
    contents->doors = c.symbols.swings.count;
    contents->door = sli_choice_door(&c);
    contents->walls_named = c.walls_named;
    sli_plan_unit_entrance(pen->map, contents->door, contents->doors);
    pen->map->entrance_may_be_wide = contents->runs.count > 0;
    if (status == SL_OK && contents->large) status = sli_choice_keep_large(&c, pen);
    if (status == SL_OK && !contents->options->all_layers)
        status = sli_plan_tell(contents->context, contents->file, contents->options->layers,
                               are_alike(&c), pen->map, metre, 0);
    sl_free(contents->context, c.means);
    sl_free(contents->context, c.left.items);
    sli_symbols_destroy(contents->context, &c.symbols);
    sli_openings_destroy(contents->context, &c.openings);
    sli_plan_parts_destroy(contents->context, &c.parts);
    return status;
}

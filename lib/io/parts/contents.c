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
#include "io/parts/names.h"
#include "io/parts/plan_doubt.h"
#include "io/parts/plan_parts.h"
#include "io/parts/symbols.h"

#include <math.h>
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
    contents->groups.items[contents->groups.count++] =
        (sli_group){.name = copy, .length = name.length, .means = sli_meaning_of(name)};
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

static sl_status list_one(sl_context *context, const char *name, size_t length, size_t shapes,
                          sl_drawing_layers *out) {
    if (!length || !shapes) return SL_OK;
    char *copy = sl_copy_text(context, name, length);
    if (!copy) return SL_NO_MEMORY;
    out->items[out->count++] = (sl_drawing_layer){copy, shapes, true};
    return SL_OK;
}

sl_status sli_contents_list(const sli_contents *contents, sl_drawing_layers *out) {
    sl_context *context = contents->context;
    const size_t groups = contents->groups.count, looks = contents->looks.items.count;
    size_t *shapes = sl_alloc_array(context, looks + 1, sizeof *shapes);
    out->items = sl_alloc_array(context, groups + looks + 1, sizeof *out->items);
    sl_status status = shapes && out->items ? SL_OK : SL_NO_MEMORY;
    for (size_t i = 0; i < groups && status == SL_OK; i++) {
        const sli_group *group = &contents->groups.items[i];
        status = list_one(context, group->name, group->length, group->shapes, out);
    }
    for (size_t i = 0; i < contents->runs.count && contents->has_looks && status == SL_OK; i++)
        shapes[contents->runs.items[i].look]++;
    for (size_t i = 0; i < looks && status == SL_OK; i++) {
        const char *name = contents->looks.items.items[i].name;
        status = list_one(context, name, strlen(name), shapes[i], out);
    }
    sl_free(context, shapes);
    return status;
}

// --- the choice

typedef struct choice {
    sli_contents *contents;
    sl_map *map;
    unsigned char *means; ///< by wall
    double metre;         ///< in the map's unit, 0 for unknown
    sli_symbols symbols;
    sli_plan_parts parts;
    size_t kept;      ///< walls and windows that stay
    bool walls_named; ///< some layer is named as walls
    bool by_looks;    ///< some shapes are passed over by their looks
    double share;     ///< of walls by their looks in all long lines
    size_t words;     ///< shapes that look like walls, but are lettering or the page
    size_t doors;     ///< made
} choice;

static sl_status find_symbols(choice *c) {
    const bool said = sli_contents_said(c->contents);
    c->means = sl_alloc(c->contents->context, c->map->wall_count);
    if (!c->means) return SL_NO_MEMORY;
    memset(c->means, SLI_MEANS_OTHER, c->map->wall_count); // walls of layers of our own
    for (size_t i = 0; i < c->contents->runs.count; i++) {
        const sli_group_run *run = &c->contents->runs.items[i];
        memset(c->means + run->first, (int)c->contents->groups.items[run->group].means,
               run->end - run->first);
    }
    size_t named = 0;
    for (size_t i = 0; i < c->contents->groups.count; i++)
        if (c->contents->groups.items[i].means == SLI_MEANS_WALL)
            named += c->contents->groups.items[i].walls;
    const sli_meaning walls = named >= LEAST_WALLS ? SLI_MEANS_WALL : SLI_MEANS_NOTHING;
    return sli_symbols_find(c->contents->context, c->map, c->means, said ? SLI_MEANINGS : walls,
                            said, c->metre, &c->symbols);
}

static bool is_gone(const choice *c, size_t wall) {
    return sl_bits_has(c->symbols.gone, wall);
}

static bool is_taken(const choice *c, sli_meaning means) {
    if (sli_contents_said(c->contents)) return means != SLI_MEANS_DOOR;
    return means == SLI_MEANS_WALL || means == SLI_MEANS_WINDOW ||
           (means == SLI_MEANS_NOTHING && !c->walls_named);
}

static void count_named(choice *c) {
    size_t named = 0;
    for (size_t i = 0; i < c->map->wall_count; i++)
        named += c->means[i] == SLI_MEANS_WALL && !is_gone(c, i);
    c->walls_named = named >= LEAST_WALLS;
}

/// Among shapes that no name tells apart, those that do not look like walls get another meaning.
static sl_status choose_looks(choice *c) {
    const sli_group_run *runs = c->contents->runs.items;
    const size_t count = c->contents->runs.count;
    if (!c->contents->has_looks || c->walls_named || sli_contents_said(c->contents)) return SL_OK;
    sli_look_shape *shapes = sl_alloc_array(c->contents->context, count, sizeof *shapes);
    sl_bits *taken = sl_alloc_array(c->contents->context, sl_bits_words(count), sizeof *taken);
    size_t used = 0;
    for (size_t i = 0; shapes && i < count; i++)
        if (c->means[runs[i].first] == SLI_MEANS_NOTHING && !is_gone(c, runs[i].first))
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
static bool choose_groups(choice *c) {
    bool changes = c->by_looks || c->symbols.leaves + c->symbols.lines > 0;
    for (size_t i = 0; i < c->contents->groups.count; i++) {
        sli_group *group = &c->contents->groups.items[i];
        group->taken = is_taken(c, group->means);
        const bool window = group->means == SLI_MEANS_WINDOW && !sli_contents_said(c->contents);
        changes |= group->walls && (!group->taken || window);
    }
    for (size_t i = 0; i < c->contents->runs.count; i++) {
        const sli_group_run *run = &c->contents->runs.items[i];
        if (!c->contents->groups.items[run->group].taken) continue;
        for (size_t j = run->first; j < run->end; j++)
            c->kept += !is_gone(c, j) && is_taken(c, c->means[j]);
    }
    return changes && (c->kept >= LEAST_WALLS || sli_contents_said(c->contents));
}

/// A metre by the doors, which are 0.6 to 1.2 m wide, where the unit does not fit them.
static double metre_by_doors(const choice *c) {
    const size_t count = c->symbols.swings.count;
    double sum = 0;
    for (size_t i = 0; i < count; i++) sum += log(c->symbols.swings.items[i].radius);
    const double radius = count ? exp(sum / (double)count) : 0;
    if (!(radius > 0) || (radius > 0.5 * c->metre && radius < 1.6 * c->metre)) return c->metre;
    return radius / 0.85;
}

/// Where neither names nor looks say what is a wall: finds what is no wall by its shape, among what
/// is taken.
static sl_status find_parts(choice *c) {
    sl_context *context = c->contents->context;
    if (c->walls_named || c->by_looks || sli_contents_said(c->contents)) return SL_OK;
    const size_t count = c->map->wall_count;
    sl_map taken = {0};
    size_t *number = sl_alloc_array(context, count, sizeof *number);
    taken.walls = sl_alloc_array(context, count, sizeof *taken.walls);
    sl_status status = number && taken.walls ? SL_OK : SL_NO_MEMORY;
    for (size_t i = 0; status == SL_OK && i < count; i++) {
        if (is_gone(c, i) || !is_taken(c, c->means[i])) continue;
        number[taken.wall_count] = i;
        taken.walls[taken.wall_count++] = c->map->walls[i];
    }
    if (status == SL_OK)
        status = sli_plan_parts_find(context, &taken, metre_by_doors(c), &c->parts);
    for (size_t i = 0; status == SL_OK && c->parts.gone && i < taken.wall_count; i++)
        if (sl_bits_has(c->parts.gone, i)) sl_bits_add(c->symbols.gone, number[i]);
    c->kept -= sli_plan_parts_count(&c->parts);
    sl_free(context, number);
    sl_free(context, taken.walls);
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
static sl_status join_doors(choice *c, joints *j, size_t count, double reach) {
    sl_context *context = c->contents->context;
    sli_near near = {0};
    sl_status status = sli_near_make(context, j->at, count, reach, &near);
    for (size_t i = 0; status == SL_OK && i < c->map->wall_count; i++) {
        if (i % 4096 == 0) status = sl_check_cancelled(context);
        if (is_gone(c, i) || !is_taken(c, c->means[i])) continue;
        j->end = c->map->walls[i].a;
        sli_near_each(&near, j->end, j, join);
        j->end = c->map->walls[i].b;
        sli_near_each(&near, j->end, j, join);
    }
    sli_near_destroy(context, &near);
    return status;
}

static sl_status add_door(choice *c, sl_point a, sl_point b, bool open) {
    char name[32];
    if (a.x == b.x && a.y == b.y) return SL_OK;
    snprintf(name, sizeof name, "door%zu", c->map->door_count + 1);
    c->doors++;
    return sl_map_add_door(c->contents->context, c->map, name, (sl_segment){a, b}, open, 0);
}

static sl_status add_swings(choice *c) {
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
static sl_status add_drawn(choice *c, const sl_wall *walls, size_t count) {
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

static sl_status add_doors_of_run(choice *c, const sli_group_run *run) {
    for (size_t i = run->first; i < run->end; i++)
        if (is_gone(c, i)) return SL_OK;
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

static sl_status add_doors(choice *c) {
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

/// Keeps the walls that are chosen, and makes windows of the rest.
static sl_status keep_walls(choice *c) {
    sl_context *context = c->contents->context;
    sl_map *map = c->map;
    const bool said = sli_contents_said(c->contents);
    sl_wall *windows = sl_alloc_array(context, map->wall_count, sizeof *windows);
    if (!windows) return SL_NO_MEMORY;
    size_t kept = 0, count = 0, run = 0;
    for (size_t i = 0; i < map->wall_count; i++) {
        while (run < c->contents->runs.count && c->contents->runs.items[run].end <= i) run++;
        const bool own = run == c->contents->runs.count || i < c->contents->runs.items[run].first;
        if (!own && (is_gone(c, i) || !is_taken(c, c->means[i]))) continue;
        if (!own && c->means[i] == SLI_MEANS_WINDOW && !said)
            windows[count++] = map->walls[i];
        else
            map->walls[kept++] = map->walls[i];
    }
    map->wall_count = kept;
    sl_status status = sl_map_add_walls(context, map, windows, count);
    if (status == SL_OK && count)
        status = sl_map_walls_stop(context, map, kept, SL_STOPS_STEPS | SL_STOPS_SOUND);
    sl_free(context, windows);
    return status;
}

// --- the note

/// The names of groups, taken or not, that mean this (or any of what is passed over, where it is
/// SLI_MEANINGS); with their kinds.
static void list_groups(const choice *c, bool taken, sli_meaning means, sli_name_list *list) {
    for (size_t i = 0; i < c->contents->groups.count; i++) {
        const sli_group *group = &c->contents->groups.items[i];
        const bool same =
            means == SLI_MEANINGS ? group->means != SLI_MEANS_DOOR : group->means == means;
        char shown[80];
        if (!group->walls || group->taken != taken || !same) continue;
        const char *name = group->length ? sli_show((sli_word){group->name, group->length}).text
                                         : "shapes without a layer";
        if (means == SLI_MEANINGS && group->means)
            snprintf(shown, sizeof shown, "%.50s (%s)", name, sli_meaning_text(group->means));
        else
            snprintf(shown, sizeof shown, "%.60s", name);
        sli_name_list_add(list, (sli_word){shown, strlen(shown)});
    }
}

static void add_part(char *text, size_t size, const char *format, ...) SL_PRINTF(3, 4);
static void add_part(char *text, size_t size, const char *format, ...) {
    const size_t used = strlen(text);
    if (used && used + 3 < size) strcat(text, "; ");
    va_list arguments;
    va_start(arguments, format);
    vsnprintf(text + strlen(text), size - strlen(text), format, arguments);
    va_end(arguments);
}

/// The looks that are taken or not, with how many shapes they have; those with most long lines
/// first.
static void list_looks(const choice *c, bool taken, sli_name_list *list) {
    const size_t count = c->contents->looks.items.count;
    double below = INFINITY;
    for (int shown = 0; shown < 6; shown++) {
        const sli_look *next = NULL;
        for (size_t i = 0; i < count; i++) {
            const sli_look *look = &c->contents->looks.items.items[i];
            const bool fits = look->shapes && look->taken == taken && look->around < below;
            if (fits && (!next || look->around > next->around)) next = look;
        }
        if (!next) return;
        char text[80];
        snprintf(text, sizeof text, "%s: %zu shape%s", next->name, next->shapes,
                 next->shapes == 1 ? "" : "s");
        sli_name_list_add(list, (sli_word){text, strlen(text)});
        below = next->around;
    }
}

static void add_kind(char *text, size_t size, size_t lines, const char *what) {
    const size_t used = strlen(text);
    snprintf(text + used, size - used, "%s%zu line%s %s", used ? ", " : "", lines,
             lines == 1 ? "" : "s", what);
}

/// What was found by its shape.
static void note_parts(const sli_plan_parts *parts, char *text, size_t size) {
    if (!sli_plan_parts_count(parts)) return;
    char shown[300] = "";
    if (parts->frame) add_kind(shown, sizeof shown, parts->frame, "of frames");
    if (parts->dimensions) add_kind(shown, sizeof shown, parts->dimensions, "of dimensions");
    if (parts->across) add_kind(shown, sizeof shown, parts->across, "across walls (axes, wires)");
    if (parts->beside) add_kind(shown, sizeof shown, parts->beside, "beside the plan");
    if (parts->loose)
        add_kind(shown, sizeof shown, parts->loose, "that touch no wall (furniture, symbols)");
    add_part(text, size, "no walls by their shape: %s", shown);
}

static void note_choice(const choice *c) {
    const char *file = c->contents->file;
    sli_name_list walls = {.full = false}, windows = walls, doors = walls, over = walls;
    char text[900] = "";
    if (c->by_looks)
        list_looks(c, true, &walls);
    else
        list_groups(c, true, c->walls_named ? SLI_MEANS_WALL : SLI_MEANS_NOTHING, &walls);
    if (!c->walls_named) list_groups(c, true, SLI_MEANS_WALL, &walls);
    list_groups(c, true, SLI_MEANS_WINDOW, &windows);
    list_groups(c, false, SLI_MEANS_DOOR, &doors);
    if (c->by_looks) list_looks(c, false, &over);
    list_groups(c, false, SLI_MEANINGS, &over);
    if (*walls.text) add_part(text, sizeof text, "walls from %.200s", walls.text);
    if (*windows.text)
        add_part(text, sizeof text, "windows, which are seen through, from %.120s", windows.text);
    if (*doors.text) add_part(text, sizeof text, "doors from %.120s", doors.text);
    if (c->symbols.doors)
        add_part(text, sizeof text, "%zu door%s drawn open%s", c->symbols.doors,
                 c->symbols.doors == 1 ? " is" : "s are",
                 c->contents->options->doors ? "" : ": gaps (--doors keeps doors)");
    if (c->symbols.lines)
        add_part(text, sizeof text, "%zu lines of hatching or steps are no walls",
                 c->symbols.lines);
    if (c->words)
        add_part(text, sizeof text, "%zu shape%s of these, lettering or a page, %s no walls",
                 c->words, c->words == 1 ? "" : "s", c->words == 1 ? "is" : "are");
    note_parts(&c->parts, text, sizeof text);
    if (*over.text) add_part(text, sizeof text, "passed over: %.250s", over.text);
    sl_note(c->contents->context, "%s: %s: %s (--layers A,B chooses, --layers '*' takes all)", file,
            c->by_looks ? "layers, and looks where no name says what is a wall" : "layers", text);
    if (c->contents->options->doors && c->doors < c->symbols.doors)
        sl_note(c->contents->context,
                "%s: %zu of the doors stay gaps: both sides of their swings are drawn", file,
                c->symbols.doors - c->doors);
}

/// Walls by their looks, where others may be walls as well as they.
static void note_share(const choice *c) {
    const sli_look *taken = NULL, *other = NULL;
    for (size_t i = 0; i < c->contents->looks.items.count; i++) {
        const sli_look *look = &c->contents->looks.items.items[i],
                       **best = look->taken ? &taken : &other;
        if (!*best || look->length > (*best)->length) *best = look;
    }
    if (!taken || !other || c->share >= 0.4) return;
    sl_note(
        c->contents->context,
        "%s: what looks like walls has only %.0f %% of the long lines: if other looks are walls, "
        "name all that are: --layers '%s,%s'",
        c->contents->file, 100 * c->share, taken->name, other->name);
}

/// Layers that are passed over though their names say nothing, and that hold more than the walls.
static void note_doubt(const choice *c) {
    sli_name_list names = {.full = false};
    size_t unknown = 0;
    for (size_t i = 0; i < c->contents->runs.count; i++) {
        const sli_group_run *run = &c->contents->runs.items[i];
        const sli_group *group = &c->contents->groups.items[run->group];
        if (group->taken || group->means != SLI_MEANS_NOTHING) continue;
        for (size_t j = run->first; j < run->end; j++) unknown += !is_gone(c, j);
    }
    if (unknown <= c->kept) return;
    list_groups(c, false, SLI_MEANS_NOTHING, &names);
    sl_note(c->contents->context,
            "%s: %.300s: more lines than the walls have; if walls are among them, name all layers "
            "of walls by --layers",
            c->contents->file, names.text);
}

/// What is left and not drawn as the walls are.
static void note_rest(const choice *c) {
    if (c->parts.rest <= 0.3) return;
    sl_note(
        c->contents->context,
        "%s: %.0f %% of what is left, by length, is not drawn by pairs of lines as the walls are: "
        "wires, counters or steps? sightline info %s lists the layers, --layers A,B takes those "
        "of walls",
        c->contents->file, 100 * c->parts.rest, c->contents->file);
}

/// Lines on layers of doors that are far longer than doors.
static void note_long_doors(const choice *c) {
    const sl_box bounds = sl_map_bounds(c->map);
    const double size = fmax(bounds.max.x - bounds.min.x, bounds.max.y - bounds.min.y);
    const double metre = metre_by_doors(c);
    const double most = metre > 0 && size > 4 * metre && size < 400 * metre ? 3 * metre : size / 8;
    size_t count = 0;
    sli_name_list names = {.full = false};
    for (size_t i = 0; i < c->contents->groups.count; i++)
        c->contents->groups.items[i].long_ones = 0;
    for (size_t i = 0; i < c->contents->runs.count; i++) {
        const sli_group_run *run = &c->contents->runs.items[i];
        sli_group *group = &c->contents->groups.items[run->group];
        if (group->means != SLI_MEANS_DOOR) continue;
        for (size_t k = run->first; k < run->end; k++) {
            const sl_wall *wall = &c->map->walls[k];
            const double length = sli_length(wall->b.x - wall->a.x, wall->b.y - wall->a.y);
            group->long_ones += length > most && !is_gone(c, k);
        }
    }
    for (size_t i = 0; i < c->contents->groups.count; i++) {
        const sli_group *group = &c->contents->groups.items[i];
        count += group->long_ones;
        if (group->long_ones) sli_name_list_add(&names, (sli_word){group->name, group->length});
    }
    if (count < 2) return;
    sl_note(c->contents->context,
            "%s: %.120s: %zu lines on layers of doors are longer than doors: if they are walls, "
            "--layers A,B names all layers of walls",
            c->contents->file, names.text, count);
}

// --- all

static sl_status choose(choice *c, sli_pen *pen) {
    SL_TRY(find_symbols(c));
    count_named(c);
    SL_TRY(choose_looks(c));
    bool chosen = choose_groups(c);
    SL_TRY(find_parts(c));
    chosen |= sli_plan_parts_count(&c->parts) > 0;
    for (size_t i = 0; i < c->contents->groups.count; i++) {
        const sli_group *group = &c->contents->groups.items[i];
        if (!chosen || group->taken) sli_keep_finest(&pen->finest, group->finest);
        if (chosen && !group->taken) c->contents->left_out += group->shapes;
    }
    if (!sli_contents_said(c->contents)) note_long_doors(c);
    if (!chosen) return SL_OK;
    SL_TRY(add_doors(c));
    SL_TRY(keep_walls(c));
    for (size_t i = 0; i < c->contents->groups.count; i++)
        pen->walls -= c->contents->groups.items[i].walls;
    pen->walls += c->kept;
    note_choice(c);
    note_rest(c);
    if (c->walls_named && !sli_contents_said(c->contents)) note_doubt(c);
    if (c->by_looks) note_share(c);
    return SL_OK;
}

sl_status sli_contents_choose(sli_contents *contents, double metre, sli_pen *pen) {
    choice c = {.contents = contents, .map = pen->map, .metre = metre};
    if (!contents->runs.count) return SL_OK;
    sl_status status = choose(&c, pen);
    if (status == SL_OK && !c.walls_named && !sli_contents_said(contents))
        status = sli_plan_tell(contents->context, contents->file, pen->map, metre, 0);
    sl_free(contents->context, c.means);
    sli_symbols_destroy(contents->context, &c.symbols);
    sli_plan_parts_destroy(contents->context, &c.parts);
    return status;
}

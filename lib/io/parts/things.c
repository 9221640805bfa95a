/// Starts and doors of games' maps: which objects are starts or doors by their names, and what
/// becomes of them in the map. Where a door is among the squares finds things_place.c.
///
/// Objects are gathered while a file is read, in pixels with y down. Squares of tiles that are
/// doors are joined to rectangles first. When all walls are made, each start and each door with a
/// place goes into the map. What has none is left out, and the notes say so.
#include "io/parts/things.h"

#include "geometry/length.h"
#include "io/parts/game_names.h"
#include "sightline/support.h"

#include <math.h>
#include <stdlib.h>
#include <strings.h>

// --- what objects say

sli_says sli_says_of(const char *name, const char *class_name) {
    const char *texts[] = {class_name ? class_name : "", name ? name : ""};
    // A trigger that is named for the door where it lies.
    if (sli_game_says_other(texts[0])) return (sli_says){0};
    for (size_t i = 0; i < 2; i++) {
        const char *own = *texts[1] ? texts[1] : texts[0];
        if (sli_says_door(texts[i])) {
            const sli_door_state state = sli_says_state(texts[1]);
            return (sli_says){.kind = SLI_THING_DOOR,
                              .state = state ? state : sli_says_state(texts[0]),
                              .name = own};
        }
        if (!sli_says_start(texts[i])) continue;
        // A spawn that is named for a goblin.
        if (i == 0 && sli_game_says_other(texts[1])) return (sli_says){0};
        return (sli_says){.kind = SLI_THING_START, .name = own};
    }
    return (sli_says){0};
}

void sli_says_add(sli_says *says, const char *property, bool value) {
    if (sli_says_door_alone(property)) {
        if (value && says->kind == SLI_THING_NONE)
            says->kind = SLI_THING_DOOR, says->name = property;
        else if (!value && says->kind == SLI_THING_DOOR)
            says->kind = SLI_THING_NONE;
        return;
    }
    const sli_door_state state = sli_says_state_alone(property);
    if (state == SLI_DOOR_OPEN) {
        says->state = value ? SLI_DOOR_OPEN : SLI_DOOR_SHUT;
        says->rank = 2;
    } else if (state == SLI_DOOR_SHUT && value && says->rank < 2) {
        says->state = SLI_DOOR_SHUT;
        says->rank = 1;
    } else if (state == SLI_DOOR_SHUT && !says->rank) {
        says->state = SLI_DOOR_OPEN;
    }
}

void sli_says_add_text(sli_says *says, const char *property, const char *value) {
    const bool by_word = sli_says_state_by_word(property);
    const bool yes = strcasecmp(value, "true") == 0 || strcmp(value, "1") == 0;
    const bool no = strcasecmp(value, "false") == 0 || strcmp(value, "0") == 0;
    if (sli_says_state_alone(property) != SLI_DOOR_UNSAID && (yes || no)) {
        sli_says_add(says, property, yes);
        return;
    }
    const sli_door_state state = by_word ? sli_says_state(value) : SLI_DOOR_UNSAID;
    if (state != SLI_DOOR_UNSAID)
        sli_says_add(says, state == SLI_DOOR_OPEN ? "open" : "shut", true);
    else if (*value && (by_word || sli_says_state_alone(property) != SLI_DOOR_UNSAID))
        says->unclear = property;
}

double sli_heading_of(double clockwise) {
    double heading = fmod(-clockwise, 360);
    if (heading < 0) heading += 360;
    return sl_coordinate_usable(heading) && heading < 360 ? heading + 0.0 : 0;
}

static bool is_named(sli_word word, const char *name) {
    return name && strlen(name) == word.length && strncasecmp(name, word.at, word.length) == 0;
}

static bool takes_none(const sli_things *things) {
    const char *names = things->options->start_names;
    return names && (!*names || strcmp(names, "none") == 0);
}

static void add_name(sli_name_text *names, const char *name) {
    char quoted[128];
    snprintf(quoted, sizeof quoted, "'%s'", sli_show((sli_word){name, strlen(name)}).text);
    if (strstr(names->text, quoted)) return;
    const size_t used = strlen(names->text);
    if (++names->count <= SLI_NAMES_SHOWN && used + strlen(quoted) + 8 < sizeof names->text)
        snprintf(names->text + used, sizeof names->text - used, "%s%s", used ? ", " : "", quoted);
    else if (!strstr(names->text, "..."))
        snprintf(names->text + used, sizeof names->text - used, " ...");
}

void sli_things_leave(sli_things *things, const char *name) {
    if (!*name) return;
    add_name(&things->left, name);
    if (sli_mentions_door(name)) add_name(&things->doubt, name);
}

static sl_status remember(sli_things *things, const char *name) {
    if (!name || !*name || things->seen_count == SLI_NAMES_SHOWN) return SL_OK;
    for (size_t i = 0; i < things->seen_count; i++)
        if (strcmp(things->seen[i], name) == 0) return SL_OK;
    char *copy = sl_copy_text(things->context, name, strlen(name));
    if (!copy) return SL_NO_MEMORY;
    things->seen[things->seen_count++] = copy;
    return SL_OK;
}

/// Tells of a property of a door that is not understood, once for all doors of one name.
static void tell_unclear(sli_things *things, const sli_says *says) {
    char both[128];
    const size_t before = things->unclear.count;
    snprintf(both, sizeof both, "%s' of door '%s",
             sli_show((sli_word){says->unclear, strlen(says->unclear)}).text,
             sli_show((sli_word){says->name, strlen(says->name)}).text);
    add_name(&things->unclear, both);
    if (things->unclear.count == before || before >= SLI_NAMES_SHOWN) return;
    sl_note(things->context, "%s: property '%s' is not understood", things->file, both);
}

sl_status sli_things_ask(sli_things *things, const char *name, const char *class_name,
                         sli_says *says) {
    const char *names = things->options->start_names;
    if (says->kind == SLI_THING_DOOR && says->unclear) tell_unclear(things, says);
    // In goblin.tmx, "spawn_goblin" is where one starts that is met there.
    const bool other =
        (name && sli_game_says_passing(name)) || (class_name && sli_game_says_other(class_name));
    if (!says->kind && name && !other && sli_says_start_at(name, sl_path_name(things->file)))
        *says = (sli_says){.kind = SLI_THING_START, .name = name};
    if (!names) return SL_OK;
    if (says->kind == SLI_THING_START) *says = (sli_says){0};
    if (takes_none(things)) return SL_OK;
    SL_TRY(remember(things, name));
    SL_TRY(remember(things, class_name));
    for (sli_word word; sli_layers_next(&names, &word);) {
        const char *own = is_named(word, name)         ? name
                          : is_named(word, class_name) ? class_name
                                                       : NULL;
        if (own) *says = (sli_says){.kind = SLI_THING_START, .name = own};
    }
    return SL_OK;
}

// --- gathering

void sli_things_destroy(sli_things *things) {
    for (size_t i = 0; i < things->items.count; i++)
        sl_free(things->context, things->items.items[i].name);
    for (size_t i = 0; i < things->seen_count; i++) sl_free(things->context, things->seen[i]);
    sl_free(things->context, things->items.items);
    sl_free(things->context, things->runs.items);
    *things = (sli_things){0};
}

sl_status sli_things_add(sli_things *things, const char *name, sli_thing thing) {
    SL_TRY(SL_ARRAY_ROOM(things->context, &things->items, 1));
    thing.name = sl_copy_text(things->context, name, strlen(name));
    if (!thing.name) return SL_NO_MEMORY;
    things->items.items[things->items.count++] = thing;
    return SL_OK;
}

static bool same_door(const sli_door_run *run, const sli_says *says) {
    return run->state == says->state && strcmp(run->name, says->name) == 0;
}

sl_status sli_things_add_square(sli_things *things, const sli_says *says, size_t column,
                                size_t row) {
    const size_t count = things->runs.count;
    sli_door_run *last = count ? &things->runs.items[count - 1] : NULL;
    if (last && last->top == row && last->right == column && same_door(last, says)) {
        last->right++;
        return SL_OK;
    }
    SL_TRY(SL_ARRAY_ROOM(things->context, &things->runs, 1));
    things->runs.items[things->runs.count++] = (sli_door_run){.name = says->name,
                                                              .state = says->state,
                                                              .left = column,
                                                              .right = column + 1,
                                                              .top = row,
                                                              .bottom = row + 1,
                                                              .root = count};
    return SL_OK;
}

/// Joins runs that lie on one another. Runs are in the order of rows, then columns, so what is
/// above is found by a second walk through the same order.
static void join_rows(sli_things *things) {
    sli_door_run *runs = things->runs.items;
    size_t above = 0;
    for (size_t i = 0; i < things->runs.count; i++) {
        sli_door_run *run = &runs[i];
        while (above < i && (runs[above].top + 1 < run->top ||
                             (runs[above].top + 1 == run->top && runs[above].left < run->left)))
            above++;
        const sli_door_run *other = &runs[above];
        const sli_says says = {.state = run->state, .name = run->name};
        if (other->top + 1 != run->top || other->left != run->left || other->right != run->right ||
            !same_door(other, &says))
            continue;
        run->root = other->root;
        runs[run->root].bottom = run->bottom;
    }
}

sl_status sli_things_end_block(sli_things *things, sl_point corner, sl_point step) {
    join_rows(things);
    sl_status status = SL_OK;
    for (size_t i = 0; status == SL_OK && i < things->runs.count; i++) {
        const sli_door_run *run = &things->runs.items[i];
        if (run->root != i) continue;
        const sl_point half = {(double)(run->right - run->left) * step.x / 2,
                               (double)(run->bottom - run->top) * step.y / 2};
        const sli_thing door = {.kind = SLI_THING_DOOR,
                                .middle = {corner.x + (double)run->left * step.x + half.x,
                                           corner.y + (double)run->top * step.y + half.y},
                                .of_tiles = true,
                                .u = {half.x, 0},
                                .v = {0, half.y},
                                .open = run->state != SLI_DOOR_SHUT};
        status = sli_things_add(things, run->name, door);
    }
    things->runs.count = 0;
    return status;
}

// --- into the map

/// Notes of one kind, beyond which only their number is told.
#define MOST_NOTES 5

/// So many walls are held against rays from doors and no more, so that reading stays fast.
#define MOST_CASTS ((size_t)1 << 28)

/// Where a ray from a door's middle meets the nearest wall, if that is near the door's edge: from
/// 0.5 to 1.5 times `half`. On an axis the place is exact.
static bool cast(const sl_map *map, size_t count, sl_point from, sl_point half, sl_point *hit) {
    double least = 1.5;
    bool found = false;
    for (size_t i = 0; i < count; i++) {
        const sl_point a = map->walls[i].a, b = map->walls[i].b;
        const sl_point d = {b.x - a.x, b.y - a.y}, w = {a.x - from.x, a.y - from.y};
        const double area = half.x * d.y - half.y * d.x;
        if (area == 0) continue;
        const double t = (w.x * d.y - w.y * d.x) / area, s = (w.x * half.y - w.y * half.x) / area;
        if (!(t >= 0 && t <= least && s >= 0 && s <= 1)) continue;
        found = true;
        least = t;
        *hit =
            (sl_point){d.x == 0 ? a.x : from.x + t * half.x, d.y == 0 ? a.y : from.y + t * half.y};
        if (half.x == 0) hit->x = from.x;
        if (half.y == 0) hit->y = from.y;
    }
    return found && least >= 0.5;
}

/// Whether walls of shapes stand at both ends of the door, which then runs from one to the other.
static bool find_walls(sli_things *things, const sl_map *map, const sli_thing *door, sl_point half,
                       sl_segment *out) {
    const sl_point from = {door->middle.x, things->top - door->middle.y};
    if (things->casts > MOST_CASTS || (half.x == 0 && half.y == 0)) return false;
    things->casts += 2 * things->shapes;
    return cast(map, things->shapes, from, (sl_point){-half.x, half.y}, &out->a) &&
           cast(map, things->shapes, from, (sl_point){half.x, -half.y}, &out->b);
}

/// A door that no squares tell the place of: between walls that stand at its edges, else as it is
/// drawn, along its longer side.
static bool place_in_open(sli_things *things, const sl_map *map, sli_thing *door) {
    const double along = sli_length(door->u.x, door->u.y),
                 across = sli_length(door->v.x, door->v.y);
    sl_segment by_u, by_v;
    if (door->placed) return true;
    if ((things->grids && !door->inside) || door->solid) return false;
    const bool u = !door->is_line && find_walls(things, map, door, door->u, &by_u);
    const bool v = !door->is_line && find_walls(things, map, door, door->v, &by_v);
    if (u != v) {
        door->at = u ? by_u : by_v;
        return door->placed = true;
    }
    if (along == across) return false;
    const sl_point half = along > across ? door->u : door->v;
    door->at = (sl_segment){{door->middle.x - half.x, things->top - (door->middle.y - half.y)},
                            {door->middle.x + half.x, things->top - (door->middle.y + half.y)}};
    return door->placed = true;
}

/// Whether a wall of solid ground crosses a door between the ends of both, so that a part of the
/// door would stand in the ground. Ends that are rounded onto the wall do not.
static bool is_crossed(const sl_wall *wall, const sl_segment *door) {
    const double end = 1e-9;
    const sl_point d = {door->b.x - door->a.x, door->b.y - door->a.y};
    const sl_point e = {wall->b.x - wall->a.x, wall->b.y - wall->a.y};
    const sl_point w = {wall->a.x - door->a.x, wall->a.y - door->a.y};
    const double area = d.x * e.y - d.y * e.x;
    if (area == 0) return false;
    const double t = (w.x * e.y - w.y * e.x) / area, s = (w.x * d.y - w.y * d.x) / area;
    return t > end && t < 1 - end && s > 0 && s < 1;
}

/// Whether the next wall of the ground at the right of a place, or at its left, has solid ground at
/// this hand. No open place has.
static bool is_in_ground(const sl_map *map, sl_point at, bool right) {
    double least = INFINITY;
    bool solid = false;
    for (size_t i = 0; i < map->wall_count; i++) {
        const sl_wall *wall = &map->walls[i];
        const bool up = wall->a.y < wall->b.y;
        const sl_point low = up ? wall->a : wall->b, high = up ? wall->b : wall->a;
        if (!wall->ground || at.y < low.y || at.y >= high.y) continue;
        const double x = low.x + (at.y - low.y) / (high.y - low.y) * (high.x - low.x);
        const double away = right ? x - at.x : at.x - x;
        const uint32_t facing = up == right ? SL_SOLID_LEFT : SL_SOLID_RIGHT;
        if (away < 0 || away > least) continue;
        solid = (away == least && solid) || (wall->ground & facing);
        least = away;
    }
    return solid;
}

static bool runs_into_ground(sli_things *things, const sl_map *map, const sl_segment *door) {
    const sl_point middle = {(door->a.x + door->b.x) / 2, (door->a.y + door->b.y) / 2};
    if (things->casts > MOST_CASTS) return false;
    things->casts += 3 * map->wall_count;
    for (size_t i = 0; i < map->wall_count; i++)
        if (map->walls[i].ground && is_crossed(&map->walls[i], door)) return true;
    return is_in_ground(map, middle, true) || is_in_ground(map, middle, false);
}

static bool is_usable(sl_point point) {
    return sl_coordinate_usable(sli_coordinate(point.x)) &&
           sl_coordinate_usable(sli_coordinate(point.y));
}

static void tell_left_out(const sli_things *things, const sli_thing *thing, size_t *count,
                          const char *why) {
    if (++*count > MOST_NOTES) return;
    char where[32] = "", x[SL_NUMBER_TEXT], y[SL_NUMBER_TEXT];
    if (thing->line) snprintf(where, sizeof where, ":%lu", (unsigned long)thing->line);
    const sl_point at =
        things->shown.xx != 0 ? sli_affine_apply(things->shown, thing->middle) : thing->middle;
    sl_number_write(at.x, x);
    sl_number_write(at.y, y);
    sl_note(things->context, "%s%s: %s '%s' at %s %s in the file is %s: %s", things->file, where,
            thing->kind == SLI_THING_DOOR ? "door" : "start",
            sli_show((sli_word){thing->name, strlen(thing->name)}).text, x, y,
            thing->is_wall ? "taken as a wall" : "left out", why);
}

static void tell_more(const sli_things *things, size_t count, const char *what) {
    if (count > MOST_NOTES)
        sl_note(things->context, "%s: so %s %zu more %s%s", things->file,
                count - MOST_NOTES == 1 ? "is" : "are", count - MOST_NOTES, what,
                count - MOST_NOTES == 1 ? "" : "s");
}

/// SL_BAD_ARGUMENT where a name that is asked for is that of no object.
static sl_status check_names(const sli_things *things) {
    const char *names = things->options->start_names;
    if (!names || takes_none(things)) return SL_OK;
    for (sli_word word; sli_layers_next(&names, &word);) {
        bool found = false;
        for (size_t i = 0; i < things->items.count && !found; i++)
            found = things->items.items[i].kind == SLI_THING_START &&
                    is_named(word, things->items.items[i].name);
        if (found) continue;
        sli_name_text seen = {0};
        for (size_t i = 0; i < things->seen_count; i++) add_name(&seen, things->seen[i]);
        return sl_fail(things->context, SL_BAD_ARGUMENT,
                       "--start-names: %s has no object '%s'; its objects: %s", things->file,
                       sli_show(word).text, *seen.text ? seen.text : "none has a name");
    }
    return SL_OK;
}

sl_point sli_thing_place(const sli_things *things, size_t number) {
    const sl_point middle = things->items.items[number].middle;
    return (sl_point){middle.x, things->top - middle.y};
}

static sl_status add_starts(const sli_things *things, sl_map *map) {
    const sl_box bounds = sl_map_bounds(map);
    size_t count = 0, moved = 0, left_out = 0;
    sli_name_text names = {0};
    for (size_t i = 0; i < things->items.count; i++) {
        const sli_thing *start = &things->items.items[i];
        if (start->kind != SLI_THING_START) continue;
        const sl_point at = sli_thing_place(things, i);
        const bool in_bounds = at.x >= bounds.min.x && at.x <= bounds.max.x &&
                               at.y >= bounds.min.y && at.y <= bounds.max.y;
        if (!is_usable(at) || !(things->grids ? start->inside : in_bounds)) {
            tell_left_out(things, start, &left_out, "it is outside the map");
            continue;
        }
        if (start->doubt) {
            tell_left_out(things, start, &left_out, start->doubt);
            continue;
        }
        if (start->solid) {
            tell_left_out(things, start, &left_out, "it stands on solid ground");
            continue;
        }
        SL_TRY(sl_map_add_start(things->context, map, at, start->heading, start->line));
        add_name(&names, start->name);
        moved += start->moved;
        count++;
    }
    tell_more(things, left_out, "start");
    char also[96] = "";
    if (moved)
        snprintf(also, sizeof also, "; %zu of them moved from the edge of a solid square", moved);
    if (count)
        sl_note(things->context, "%s: taken: %zu start%s, from %s%s", things->file, count,
                count == 1 ? "" : "s", names.text, also);
    return SL_OK;
}

static int compare_names(const void *left, const void *right) {
    const sli_thing *const *a = left, *const *b = right;
    const int order = strcmp((*a)->name, (*b)->name);
    return order ? order : (*a > *b) - (*a < *b);
}

/// Makes a name one word of the map text, without what a list of names has between them, and
/// without the ':' that numbers of doors have before them.
static sl_status make_word(sl_context *context, char **name) {
    for (char *at = *name; *at; at++)
        if ((unsigned char)*at <= ' ' || strchr("#,:\x7f", *at)) *at = '_';
    if (sli_name_usable(*name, strlen(*name))) return SL_OK;
    char *other = sl_copy_text(context, "door", 4);
    if (!other) return SL_NO_MEMORY;
    sl_free(context, *name);
    *name = other;
    return SL_OK;
}

/// Doors of one name: the second gets ":2", the third ":3".
static sl_status number_name(sl_context *context, sli_thing *door, size_t number) {
    const size_t length = strlen(door->name);
    char *name = sl_alloc(context, length + 24);
    if (!name) return SL_NO_MEMORY;
    snprintf(name, length + 24, "%s:%zu", door->name, number);
    sl_free(context, door->name);
    door->name = name;
    return SL_OK;
}

static sl_status name_doors(const sli_things *things, sli_thing **doors, size_t count) {
    sl_status status = SL_OK;
    size_t renamed = 0;
    for (size_t i = 0; i < count && status == SL_OK; i++) {
        const char *name = doors[i]->name;
        const sli_shown was = sli_show((sli_word){name, strlen(name)});
        if (sli_name_usable(name, strlen(name)) && !strpbrk(name, "#,:")) continue;
        status = make_word(things->context, &doors[i]->name);
        if (status == SL_OK && ++renamed <= MOST_NOTES)
            sl_note(things->context, "%s: door '%s' is named %s here: names are one word each",
                    things->file, was.text, doors[i]->name);
    }
    if (status == SL_OK && count) qsort(doors, count, sizeof *doors, compare_names);
    // The first of a name keeps it, so that the others can be held against it.
    for (size_t i = 0, first = 0, number = 1; i < count && status == SL_OK; i++) {
        if (i == first || strcmp(doors[i]->name, doors[first]->name) != 0) {
            first = i;
            number = 1;
        } else if (!doors[i]->goes_on) {
            status = number_name(things->context, doors[i], ++number);
        } else if (number > 1) {
            status = number_name(things->context, doors[i], number);
        }
    }
    return status;
}

/// Draws a door without a place that its layer says is solid.
static sl_status add_outline(const sli_things *things, const sli_thing *door, sl_map *map) {
    const double signs[5][2] = {{-1, -1}, {1, -1}, {1, 1}, {-1, 1}, {-1, -1}};
    sl_point before = {0};
    for (size_t i = 0; i < (door->is_line ? 2 : 5); i++) {
        const double u = signs[i][0], v = signs[i][1];
        const sl_point at = {door->middle.x + u * door->u.x + v * door->v.x,
                             things->top - (door->middle.y + u * door->u.y + v * door->v.y)};
        const bool draws = i && (at.x != before.x || at.y != before.y);
        if (draws && is_usable(at) && is_usable(before))
            SL_TRY(sl_map_add_wall(things->context, map, before, at, door->line));
        before = at;
    }
    return SL_OK;
}

static void tell_doors(const sli_things *things, size_t open, size_t shut) {
    if (!open && !shut) return;
    char states[64] = "";
    if (open && shut) snprintf(states, sizeof states, " (%zu open, %zu shut)", open, shut);
    const char *state = !shut ? "open " : !open ? "shut " : "";
    sl_note(things->context, "%s: taken: %zu %sdoor%s%s", things->file, open + shut, state,
            open + shut == 1 ? "" : "s", states);
}

/// Whether a door has a place where it can stand.
static bool stands(sli_things *things, const sl_map *map, sli_thing *door) {
    if (!place_in_open(things, map, door) || door->buried || !is_usable(door->at.a) ||
        !is_usable(door->at.b) || (door->at.a.x == door->at.b.x && door->at.a.y == door->at.b.y))
        return false;
    door->in_ground = runs_into_ground(things, map, &door->at);
    return !door->in_ground;
}

static const char *why_not(const sli_things *things, const sli_thing *door) {
    if (things->grids && !door->inside) return "it is outside the map";
    if (door->placed && door->buried) return "another layer is solid on both of its sides";
    return door->in_ground ? "it runs into solid ground" : "no passage is found there";
}

static sl_status add_doors(sli_things *things, sl_map *map) {
    sli_thing **doors = sl_alloc_array(things->context, things->items.count, sizeof *doors);
    if (!doors) return SL_NO_MEMORY;
    size_t count = 0, left_out = 0, open = 0, shut = 0;
    sl_status status = SL_OK;
    for (size_t i = 0; i < things->items.count && status == SL_OK; i++) {
        sli_thing *door = &things->items.items[i];
        if (i % 64 == 0) status = sl_check_cancelled(things->context);
        if (door->kind != SLI_THING_DOOR || door->again) continue;
        door->goes_on = door->goes_on && things->items.items[i - 1].placed;
        if (stands(things, map, door)) {
            doors[count++] = door;
            continue;
        }
        tell_left_out(things, door, &left_out, why_not(things, door));
        door->placed = false;
        if (status == SL_OK && door->is_wall) status = add_outline(things, door, map);
    }
    tell_more(things, left_out, "door");
    if (status == SL_OK) status = name_doors(things, doors, count);
    sl_free(things->context, doors);
    for (size_t i = 0; i < things->items.count && status == SL_OK; i++) {
        const sli_thing *door = &things->items.items[i];
        if (door->kind != SLI_THING_DOOR || !door->placed) continue;
        *(door->open ? &open : &shut) += !door->goes_on;
        status =
            sl_map_add_door(things->context, map, door->name, door->at, door->open, door->line);
    }
    if (status == SL_OK) tell_doors(things, open, shut);
    return status;
}

sl_status sli_things_finish(sli_things *things, sl_map *map) {
    SL_TRY(check_names(things));
    if (things->left.count)
        sl_note(things->context, "%s: objects left out: %s%s%s", things->file, things->left.text,
                things->doubt.count ? "; name or type 'door' what is a door: " : "",
                things->doubt.text);
    if (!things->items.count) return SL_OK;
    SL_TRY(add_starts(things, map));
    return add_doors(things, map);
}

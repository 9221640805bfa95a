/// What is said of the choice: what was taken, by what, and which option changes it; then each
/// doubt with its next step.
#include "io/parts/choice.h"

#include "geometry/length.h"
#include "io/parts/names.h"

#include <math.h>

/// How many times lighter a look may be than walls, and be doubted. How many walls thick lines
/// have, how many shapes the thin ones beside them, and how many times as wide the thick ones are.
enum { LIGHT = 10, LEAST_THICK = 8, LEAST_THIN = 24 };
#define THICK 2.5

// --- measures

double sli_choice_door(const sli_choice *c) {
    const size_t count = c->symbols.swings.count;
    double sum = 0;
    for (size_t i = 0; i < count; i++) sum += log(c->symbols.swings.items[i].radius);
    return count ? exp(sum / (double)count) : 0;
}

double sli_choice_metre(const sli_choice *c) {
    const double radius = sli_choice_door(c);
    if (!(radius > 0) || (radius > 0.5 * c->metre && radius < 1.6 * c->metre)) return c->metre;
    return radius / 0.85;
}

/// The longer side of all that is drawn.
static double size_of(const sli_choice *c) {
    const sl_box bounds = sl_map_bounds(c->map);
    return fmax(bounds.max.x - bounds.min.x, bounds.max.y - bounds.min.y);
}

double sli_choice_sure_metre(const sli_choice *c) {
    const double size = size_of(c), metre = sli_choice_metre(c);
    return size > 4 * metre && size < 400 * metre ? metre : 0;
}

double sli_choice_longest_door(const sli_choice *c) {
    const double metre = sli_choice_sure_metre(c);
    return metre > 0 ? 3 * metre : size_of(c) / 8;
}

// --- the note

/// The names of groups, taken or not, that mean this (or any of what is passed over, where it is
/// SLI_MEANINGS); with their kinds.
static void list_groups(const sli_choice *c, bool taken, sli_meaning means, sli_name_list *list) {
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
static void list_looks(const sli_choice *c, bool taken, sli_name_list *list) {
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
    if (parts->tiles) add_kind(shown, sizeof shown, parts->tiles, "of tiles");
    add_part(text, size, "no walls by their shape: %s", shown);
}

static void note_choice(const sli_choice *c) {
    const char *file = c->contents->file;
    sli_name_list walls = {.full = false}, windows = walls, doors = walls, over = walls;
    char text[900] = "";
    if (c->by_looks)
        list_looks(c, true, &walls);
    else
        list_groups(c, true, c->walls_named ? SLI_MEANS_WALL : SLI_MEANS_NOTHING, &walls);
    if (!c->walls_named) list_groups(c, true, SLI_MEANS_WALL, &walls);
    if (c->walls_named && sli_contents_said(c->contents))
        list_groups(c, true, SLI_MEANS_NOTHING, &walls);
    list_groups(c, true, SLI_MEANS_WINDOW, &windows);
    list_groups(c, false, SLI_MEANS_DOOR, &doors);
    if (c->by_looks) list_looks(c, false, &over);
    list_groups(c, false, SLI_MEANINGS, &over);
    if (*walls.text) add_part(text, sizeof text, "walls from %s", sli_name_list_cut(&walls, 200));
    if (*windows.text)
        add_part(text, sizeof text, "windows, which are seen through, from %s",
                 sli_name_list_cut(&windows, 120));
    if (*doors.text) add_part(text, sizeof text, "doors from %s", sli_name_list_cut(&doors, 120));
    if (c->symbols.doors)
        add_part(text, sizeof text, "%zu door%s drawn open%s", c->symbols.doors,
                 c->symbols.doors == 1 ? " is" : "s are",
                 c->contents->options->doors ? "" : ": gaps (--doors keeps doors)");
    if (c->cuts)
        add_part(text, sizeof text, "%zu door%s or bar%s over walls %s", c->cuts,
                 c->cuts == 1 ? "" : "s", c->cuts == 1 ? "" : "s",
                 c->cuts == 1 ? "is a gap" : "are gaps");
    if (c->glazed)
        add_part(text, sizeof text, "%zu bar%s over walls %s", c->glazed, c->glazed == 1 ? "" : "s",
                 c->glazed == 1 ? "is a window" : "are windows");
    if (c->symbols.lines)
        add_part(text, sizeof text, "%zu lines of hatching or steps are no walls",
                 c->symbols.lines);
    if (c->words)
        add_part(text, sizeof text, "%zu shape%s of these, lettering or a page, %s no walls",
                 c->words, c->words == 1 ? "" : "s", c->words == 1 ? "is" : "are");
    note_parts(&c->parts, text, sizeof text);
    if (*over.text) add_part(text, sizeof text, "passed over: %s", sli_name_list_cut(&over, 250));
    sl_note(c->contents->context, "%s: %s: %s (--layers A,B chooses, --layers '*' takes all)", file,
            c->by_looks ? "layers, and looks where no name says what is a wall" : "layers", text);
    if (c->contents->options->doors && c->doors < c->symbols.doors)
        sl_note(c->contents->context,
                "%s: %zu of the doors stay gaps: both sides of their swings are drawn", file,
                c->symbols.doors - c->doors);
}

void sli_choice_note_all(const sli_choice *c) {
    sli_name_list names = {.full = false};
    size_t count = 0;
    for (size_t i = 0; i < c->contents->groups.count; i++)
        count += c->contents->groups.items[i].walls && c->contents->groups.items[i].length;
    if (count < 2 || c->contents->has_looks || sli_contents_said(c->contents)) return;
    list_groups(c, true, SLI_MEANINGS, &names);
    sl_note(c->contents->context, "%s: layers: all are walls: %s (--layers A,B chooses)",
            c->contents->file, sli_name_list_cut(&names, 300));
}

/// How large an area the shapes of a look enclose, one with another.
static double area_of_each(const sli_look *look) {
    return look->shapes ? look->area / (double)look->shapes : 0;
}

/// Names of looks, as --layers takes them.
typedef struct look_names {
    char text[400];
    size_t used;
} look_names;

static void add_look(look_names *names, const sli_look *look) {
    if (!look->shapes || names->used + 2 * SLI_LOOK_NAME >= sizeof names->text) return;
    names->used += (size_t)snprintf(names->text + names->used, sizeof names->text - names->used,
                                    "%s%s", names->used ? "," : "", look->name);
}

/// Adds the looks that are taken, but for lettering and lines up to so wide.
static void add_taken(const sli_choice *c, double width, look_names *names) {
    for (size_t i = 0; i < c->contents->looks.items.count; i++) {
        const sli_look *look = &c->contents->looks.items.items[i];
        if (look->kept && !(look->ink.line && look->ink.width <= width)) add_look(names, look);
    }
}

/// Adds a look that has rooms, and those of thicker lines that enclose areas of a fifth of its at
/// least.
static void add_rooms(const sli_choice *c, const sli_look *rooms, look_names *names) {
    for (size_t i = 0; i < c->contents->looks.items.count; i++) {
        const sli_look *look = &c->contents->looks.items.items[i];
        const bool thicker = look->ink.line && look->ink.width > rooms->ink.width &&
                             5 * area_of_each(look) >= area_of_each(rooms);
        if (!look->taken && (look == rooms || thicker)) add_look(names, look);
    }
}

/// Walls by lines of two widths, of which the thin ones have most: tiles of floors are drawn so.
static void note_thin(const sli_choice *c) {
    const sli_look *items = c->contents->looks.items.items, *most = NULL, *thick = NULL;
    look_names names = {0};
    for (size_t i = 0; i < c->contents->looks.items.count; i++) {
        if (!items[i].taken || !items[i].ink.line) continue;
        if (!most || items[i].length > most->length) most = &items[i];
        if (!thick || items[i].ink.width > thick->ink.width) thick = &items[i];
    }
    if (!thick || thick->ink.width < THICK * most->ink.width || thick->walls < LEAST_THICK ||
        most->shapes < LEAST_THIN)
        return;
    add_taken(c, thick->ink.width / THICK, &names);
    sl_note(c->contents->context,
            "%s: walls are drawn by thin lines (%s), and by thick ones: if the thin ones are tiles "
            "of a floor: --layers '%s'",
            c->contents->file, most->name, names.text);
}

/// Walls by their looks, where others may be walls as well as they: no look of a tenth of the
/// weight is.
static void note_share(const sli_choice *c) {
    const sli_look *taken = NULL, *other = NULL, *rooms = NULL;
    const char *file = c->contents->file;
    look_names names = {0};
    for (size_t i = 0; i < c->contents->looks.items.count; i++) {
        const sli_look *look = &c->contents->looks.items.items[i];
        if (look->taken && (!taken || look->length > taken->length)) taken = look;
        if (look->taken || !look->shapes) continue;
        if (!other || sli_look_likeness(look) > sli_look_likeness(other)) other = look;
        if (look->rooms >= 3 && look->room_area >= 0.04 &&
            (!rooms || look->room_area > rooms->room_area))
            rooms = look;
    }
    if (!taken || !other) return;
    const bool doubtful = c->share < 0.4 && LIGHT * other->weight >= taken->weight;
    if (!doubtful && !rooms) return;
    add_taken(c, 0, &names);
    if (doubtful)
        add_look(&names, other);
    else
        add_rooms(c, rooms, &names);
    if (doubtful)
        sl_note(c->contents->context,
                "%s: what looks like walls has only %.0f %% of the long lines: if other looks are "
                "walls, name all that are: --layers '%s'",
                file, 100 * c->share, names.text);
    else
        sl_note(c->contents->context,
                "%s: %s: %zu shapes as large as rooms are passed over: if these are walls: "
                "--layers '%s'",
                file, rooms->name, rooms->rooms, names.text);
}

/// Whether a group is to be named for its walls: one of those that are taken, of doors with lines
/// that are longer than doors, or else one that says nothing.
static bool has_walls(const sli_group *group, bool doors) {
    if (!group->walls) return false;
    if (group->taken) return group->means != SLI_MEANS_WINDOW;
    return doors ? group->long_ones > 0 : group->means == SLI_MEANS_NOTHING;
}

bool sli_choice_add_name(sli_word name, const char *role, char *text, size_t size) {
    const size_t used = strlen(text);
    if (!name.length || used + name.length + strlen(role) + 2 >= size) return false;
    for (size_t k = 0; k < name.length; k++)
        if ((unsigned char)name.at[k] < ' ' || strchr("',\x7f", name.at[k])) return false;
    snprintf(text + used, size - used, "%s%.*s%s", used ? "," : "", (int)name.length, name.at,
             role);
    return true;
}

static bool add_layer(const sli_group *group, char *text, size_t size) {
    return sli_choice_add_name((sli_word){group->name, group->length}, "", text, size);
}

/// Adds layers, those with the longest lines first, down to a tenth of the longest.
static void add_longest(const sli_choice *c, bool taken, bool doors, char *text, size_t size) {
    double below = INFINITY, longest = 0;
    for (;;) {
        const sli_group *next = NULL;
        for (size_t i = 0; i < c->contents->groups.count; i++) {
            const sli_group *group = &c->contents->groups.items[i];
            if (group->taken != taken || !has_walls(group, doors) || group->length_left >= below)
                continue;
            if (!next || group->length_left > next->length_left) next = group;
        }
        if (!next || next->length_left < longest / 10 || !add_layer(next, text, size)) return;
        below = next->length_left;
        longest = fmax(longest, below);
    }
}

/// The layers of walls and those that may have some, as --layers takes them; those with the longest
/// lines where they are too many; "A,B" where looks say what is a wall, or no name is to be typed.
static void say_layers(const sli_choice *c, bool doors, char *text, size_t size) {
    bool all = !c->by_looks;
    text[0] = '\0';
    for (size_t i = 0; all && i < c->contents->groups.count; i++) {
        const sli_group *group = &c->contents->groups.items[i];
        all = !has_walls(group, doors) || add_layer(group, text, size);
    }
    if (all) return;
    text[0] = '\0';
    if (!c->by_looks) add_longest(c, true, doors, text, size);
    if (!c->by_looks) add_longest(c, false, doors, text, size);
    if (!*text) snprintf(text, size, "A,B");
}

/// Layers that are passed over though their names say nothing, and that hold more than the walls.
static void note_doubt(const sli_choice *c) {
    sli_name_list names = {.full = false};
    char layers[300];
    if (c->unknown <= c->kept && c->unknown_length <= c->kept_length) return;
    list_groups(c, false, SLI_MEANS_NOTHING, &names);
    say_layers(c, false, layers, sizeof layers);
    sl_note(c->contents->context,
            "%s: %.300s: more or longer lines than the walls have; if walls are among them, name "
            "all layers of walls by --layers, as in: --layers '%s'",
            c->contents->file, names.text, layers);
}

/// Rooms that have no door though doors are drawn.
static void note_shut_doors(const sli_choice *c) {
    if (c->shut < 2) return;
    sl_note(c->contents->context,
            "%s: %zu lines on layers of doors stand at walls without a gap: rooms are shut there; "
            "sightline convert %s -o map.map writes a map to which doors can be added",
            c->contents->file, c->shut, c->contents->file);
}

/// What is left and not drawn as the walls are.
static void note_rest(const sli_choice *c) {
    if (c->parts.rest <= 0.3) return;
    sl_note(
        c->contents->context,
        "%s: %.0f %% of what is left, by length, is not drawn by pairs of lines as the walls are: "
        "wires, counters or steps? sightline info %s lists the layers, --layers A,B takes those "
        "of walls",
        c->contents->file, 100 * c->parts.rest, c->contents->file);
}

void sli_choice_note_long_doors(const sli_choice *c) {
    size_t count = 0, walls = 0;
    sli_name_list names = {.full = false}, taken = {.full = false};
    for (size_t i = 0; i < c->contents->groups.count; i++) {
        const sli_group *group = &c->contents->groups.items[i];
        const bool door = group->means == SLI_MEANS_DOOR;
        if (!group->long_ones) continue;
        *(door ? &count : &walls) += group->long_ones;
        sli_name_list_add(door ? &names : &taken, (sli_word){group->name, group->length});
    }
    if (walls)
        sl_note(c->contents->context,
                "%s: %.120s: named as doors, but most of its lines are longer than doors (%zu): "
                "they are walls; --layers NAME=door takes a layer for doors",
                c->contents->file, taken.text, walls);
    if (count < 2) return;
    char layers[300];
    say_layers(c, true, layers, sizeof layers);
    sl_note(c->contents->context,
            "%s: %.120s: %zu lines on layers of doors are longer than doors: if they are walls, "
            "name all layers of walls: --layers '%s'",
            c->contents->file, names.text, count, layers);
}

void sli_choice_note(const sli_choice *c) {
    note_choice(c);
    sli_choice_note_both(c);
    sli_choice_note_left_out(c);
    if (c->outlined)
        sl_note(c->contents->context,
                "%s: layers named for walls have few lines, so layers of rooms give walls, too: "
                "their outlines; --layers NAME=ignore leaves one out",
                c->contents->file);
    note_shut_doors(c);
    note_rest(c);
    if (c->walls_named && !sli_contents_said(c->contents)) note_doubt(c);
    if (c->by_looks) note_thin(c);
    if (c->by_looks) note_share(c);
}

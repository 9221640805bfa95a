/// Windows and walls among what is left out though no name says what it is (left_out.h): by layers
/// where some layer is named as walls, by looks where looks say what is a wall.
///
/// Glass in the gaps of outer walls becomes windows. A layer or look most of which parts rooms is
/// taken as walls, if what is inside is plain with it and in doubt without it. Else a note names
/// it.
#include "io/parts/choice.h"

#include "io/parts/left_out.h"
#include "io/parts/plan_inside.h"
#include "io/parts/plan_unit.h"

#include <math.h>

/// With more walls it is not tried what is inside: at once, and in all tries.
enum { MOST_TRIED = 20000, MOST_IN_ALL = 200000 };

// --- what is looked at

/// Of each wall that is drawn, and of the doors.
typedef struct drawn {
    sl_bits *walls; ///< that are taken
    uint32_t *kinds;
    double *pens;
    sl_segment *doors;
    size_t door_count;
    bool looked, plain; ///< whether what is inside is plain by the walls that are taken
    size_t tried;       ///< walls, in all tries of what is inside
} drawn;

/// The name of a kind of shapes that are left out, as --layers takes it.
static sli_word name_of_kind(const sli_choice *c, uint32_t kind) {
    const sli_group *group = &c->contents->groups.items[kind - 1];
    if (!c->by_looks) return (sli_word){group->name, group->length};
    const char *look = c->contents->looks.items.items[kind - 1].name;
    return (sli_word){look, strlen(look)};
}

/// Whether the user says what the layer or the look of a run is.
static bool is_said(const sli_choice *c, const sli_group_run *run) {
    const sli_contents *contents = c->contents;
    sli_meaning role;
    if (contents->groups.items[run->group].said || !contents->has_looks)
        return contents->groups.items[run->group].said;
    const char *look = contents->looks.items.items[run->look].name;
    return sli_roles_find(contents->roles, (sli_word){look, strlen(look)}, &role);
}

/// The kind of the walls of a run that may be windows or walls; 0 for none. Lines at entrances are
/// neither, nor are the edges of what covers up other shapes, in the colour of the ground.
static uint32_t kind_of(const sli_choice *c, const sli_group_run *run, double ground) {
    const sli_group *group = &c->contents->groups.items[run->group];
    if (group->means != SLI_MEANS_NOTHING || is_said(c, run)) return 0;
    const sli_ink *ink =
        c->contents->has_looks ? &c->contents->looks.items.items[run->look].ink : NULL;
    if (ink && !ink->line && sli_ink_is_ground(ink, ground)) return 0;
    if (sli_meaning_is_way_in((sli_word){group->name, group->length})) return 0;
    return 1 + (c->by_looks ? run->look : run->group);
}

static void add_door(drawn *d, sl_point a, sl_point b) {
    d->doors[d->door_count++] = (sl_segment){a, b};
}

static void fill(const sli_choice *c, double ground, drawn *d) {
    const sli_contents *contents = c->contents;
    for (size_t i = 0; i < contents->runs.count; i++) {
        const sli_group_run *run = &contents->runs.items[i];
        const sli_ink *ink =
            contents->has_looks ? &contents->looks.items.items[run->look].ink : NULL;
        const uint32_t kind = kind_of(c, run, ground);
        for (size_t k = run->first; k < run->end; k++) {
            if (ink && ink->line) d->pens[k] = ink->width / 2;
            if (sli_choice_gone(c, k)) continue;
            if (sli_choice_takes(c, c->means[k]))
                sl_bits_add(d->walls, k);
            else if (c->means[k] == SLI_MEANS_DOOR)
                add_door(d, c->map->walls[k].a, c->map->walls[k].b);
            else
                d->kinds[k] = kind;
        }
    }
    for (size_t i = 0; i < c->symbols.swings.count; i++)
        add_door(d, c->symbols.swings.items[i].hinge, c->symbols.swings.items[i].latch);
    for (size_t i = 0; i < c->symbols.unsure.count; i++) {
        const sli_swing *swing = &c->symbols.unsure.items[i];
        add_door(d, swing->hinge, swing->latch);
        add_door(d, swing->hinge, swing->tip);
    }
}

// --- what is found

/// Makes windows of the glass.
static void take_glass(sli_choice *c, const sli_left_out *left) {
    uint32_t line = 0;
    c->gaps = left->gaps;
    for (size_t i = 0; i < c->contents->runs.count; i++) {
        const sli_group_run *run = &c->contents->runs.items[i];
        for (size_t k = run->first; k < run->end; k++) {
            if (!sl_bits_has(left->glass, k)) continue;
            sli_group *group = &c->contents->groups.items[run->group];
            c->means[k] = SLI_MEANS_WINDOW;
            group->glazed = true;
            if (c->by_looks) c->contents->looks.items.items[run->look].glazed = true;
            c->kept++;
            group->shown += c->map->walls[k].line != line;
            c->shown += c->map->walls[k].line != line;
            line = c->map->walls[k].line;
        }
    }
}

/// Whether what is inside is plain by the walls that are taken, and by those of a kind, too; 0 for
/// none.
static sl_status is_plain(const sli_choice *c, drawn *d, uint32_t with, bool *plain) {
    sl_context *context = c->contents->context;
    const size_t count = c->map->wall_count;
    sl_map map = {.entrance_may_be_wide = true};
    sl_wall *walls = sl_alloc_array(context, count, sizeof *walls);
    size_t taken = 0;
    if (!walls) return SL_NO_MEMORY;
    for (size_t i = 0; i < count; i++)
        if (sl_bits_has(d->walls, i) || (with && d->kinds[i] == with))
            walls[taken++] = c->map->walls[i];
    sl_status status = sl_map_add_walls(context, &map, walls, taken);
    memcpy(map.unit, c->map->unit, sizeof map.unit);
    sli_plan_unit_entrance(&map, sli_choice_door(c), c->symbols.swings.count);
    *plain = false;
    if (status == SL_OK && taken <= MOST_TRIED && d->tried + taken <= MOST_IN_ALL) {
        d->tried += taken;
        status = sli_plan_inside(context, &map, plain);
    }
    sl_map_destroy(context, &map);
    sl_free(context, walls);
    return status;
}

/// Takes a kind as walls.
static void take_kind(sli_choice *c, const drawn *d, uint32_t kind) {
    for (size_t i = 0; i < c->contents->runs.count; i++) {
        const sli_group_run *run = &c->contents->runs.items[i];
        bool any = false;
        for (size_t k = run->first; k < run->end; k++) {
            if (d->kinds[k] != kind || sl_bits_has(d->walls, k)) continue;
            any = true;
            c->means[k] = SLI_MEANS_WALL;
            sl_bits_add(d->walls, k);
            c->kept++;
        }
        c->shown += any && c->by_looks;
    }
    if (c->by_looks) {
        c->contents->looks.items.items[kind - 1].taken = true;
    } else {
        sli_group *group = &c->contents->groups.items[kind - 1];
        group->means = SLI_MEANS_WALL;
        group->taken = true;
        c->shown -= group->shown; // all shapes of what is taken count
    }
}

/// Whether a kind may be one of walls: it has a name, and a look is not far lighter than walls, nor
/// one of what is filled.
static bool may_be_walls(const sli_choice *c, uint32_t kind) {
    enum { LIGHT = 10 };
    const sli_look *looks = c->contents->looks.items.items;
    double heaviest = 0;
    if (!c->by_looks) return name_of_kind(c, kind).length > 0;
    for (size_t i = 0; i < c->contents->looks.items.count; i++)
        if (looks[i].taken) heaviest = fmax(heaviest, looks[i].weight);
    return looks[kind - 1].ink.line && LIGHT * looks[kind - 1].weight >= heaviest;
}

/// Looks for walls of one kind.
static sl_status look_for_walls(sli_choice *c, sli_left_out *left, drawn *d, uint32_t kind) {
    sl_context *context = c->contents->context;
    bool with = false;
    size_t count;
    SL_TRY(sli_left_out_walls(left, kind, &count));
    if (!count) return SL_OK;
    if (!d->looked) SL_TRY(is_plain(c, d, 0, &d->plain));
    d->looked = true;
    if (!d->plain) SL_TRY(is_plain(c, d, kind, &with));
    SL_TRY(SL_ARRAY_ROOM(context, &c->left, 1));
    c->left.items[c->left.count++] = (sli_left_kind){kind, count, with};
    if (with) take_kind(c, d, kind);
    d->plain |= with;
    return SL_OK;
}

static sl_status look(sli_choice *c, drawn *d) {
    const sli_contents *contents = c->contents;
    sli_left_out left = {.context = contents->context,
                         .map = c->map,
                         .walls = d->walls,
                         .kinds = d->kinds,
                         .pens = d->pens,
                         .metre = sli_choice_metre(c),
                         .thin = c->by_looks,
                         .doors = d->doors,
                         .door_count = d->door_count};
    const size_t kinds = c->by_looks ? contents->looks.items.count : contents->groups.count;
    bool fits;
    sl_status status = sli_left_out_make(&left, &fits);
    if (status == SL_OK && fits) status = sli_left_out_glass(&left);
    if (status == SL_OK && fits) take_glass(c, &left);
    for (uint32_t kind = 1; status == SL_OK && fits && kind <= kinds; kind++)
        if (may_be_walls(c, kind)) status = look_for_walls(c, &left, d, kind);
    sli_left_out_destroy(&left);
    return status;
}

sl_status sli_choice_find_left_out(sli_choice *c) {
    sl_context *context = c->contents->context;
    const size_t count = c->map->wall_count, words = sl_bits_words(count);
    const size_t doors = count + c->symbols.swings.count + 2 * c->symbols.unsure.count;
    if (sli_contents_said(c->contents) || !(c->walls_named || c->by_looks)) return SL_OK;
    drawn d = {.walls = sl_alloc_array(context, words, sizeof *d.walls),
               .kinds = sl_alloc_array(context, count, sizeof *d.kinds),
               .pens = sl_alloc_array(context, count, sizeof *d.pens),
               .doors = sl_alloc_array(context, doors, sizeof *d.doors)};
    double ground = 1;
    sl_status status = d.walls && d.kinds && d.pens && d.doors ? SL_OK : SL_NO_MEMORY;
    if (status == SL_OK && c->contents->has_looks) status = sli_choice_find_ground(c, &ground);
    if (status == SL_OK) {
        fill(c, ground, &d);
        status = look(c, &d);
    }
    sl_free(context, d.walls);
    sl_free(context, d.kinds);
    sl_free(context, d.pens);
    sl_free(context, d.doors);
    return status;
}

// --- what is said

/// The glass, and what leaves it out.
static void note_glass(const sli_choice *c) {
    const size_t kinds = c->by_looks ? c->contents->looks.items.count : c->contents->groups.count;
    char names[300] = "";
    bool all = true;
    if (!c->gaps) return;
    for (uint32_t kind = 1; kind <= kinds; kind++) {
        const bool glazed = c->by_looks ? c->contents->looks.items.items[kind - 1].glazed
                                        : c->contents->groups.items[kind - 1].glazed;
        if (glazed)
            all &= sli_choice_add_name(name_of_kind(c, kind), "=ignore", names, sizeof names);
    }
    sl_note(c->contents->context,
            "%s: lines side by side close %zu gap%s of outer walls: windows, which are seen "
            "through; --layers '%s' leaves them out",
            c->contents->file, c->gaps, c->gaps == 1 ? "" : "s", all ? names : "NAME=ignore");
}

void sli_choice_note_left_out(const sli_choice *c) {
    sl_context *context = c->contents->context;
    const char *file = c->contents->file;
    note_glass(c);
    for (size_t i = 0; i < c->left.count; i++) {
        const sli_left_kind *kind = &c->left.items[i];
        const sli_word name = name_of_kind(c, kind->kind);
        const char *role = kind->taken ? "=ignore" : "=wall";
        char typed[200] = "";
        if (!sli_choice_add_name(name, role, typed, sizeof typed))
            snprintf(typed, sizeof typed, "NAME%s", role);
        if (kind->taken)
            sl_note(context,
                    "%s: %.80s: %zu lines part rooms, and with them it is plain what is inside: "
                    "taken as walls; --layers '%s' leaves them out",
                    file, sli_show(name).text, kind->lines, typed);
        else
            sl_note(context,
                    "%s: %.80s: passed over, but %zu of its lines stand as walls do: if they are "
                    "walls: --layers '%s'",
                    file, sli_show(name).text, kind->lines, typed);
    }
}

/// The choice among what is drawn: shared by contents.c, which makes it, contents_doors.c,
/// contents_parts.c, and contents_note.c, which tells of it.
#ifndef SL_CHOICE_H
#define SL_CHOICE_H

#include "io/parts/contents.h"
#include "io/parts/openings.h"
#include "io/parts/plan_parts.h"
#include "io/parts/symbols.h"

/// A layer or a look that is left out, though its lines stand as walls do.
typedef struct sli_left_kind {
    uint32_t kind; ///< of the looks, or of the groups: the number behind its own
    size_t lines;
    bool taken; ///< as walls, after all
} sli_left_kind;

typedef struct sli_choice {
    sli_contents *contents;
    sl_map *map;
    unsigned char *means; ///< by wall
    double metre;         ///< in the map's unit, 0 for unknown
    sli_symbols symbols;
    sli_plan_parts parts;
    size_t kept;    ///< walls and windows that stay
    size_t unknown; ///< walls that are passed over though their names say nothing
    double kept_length, unknown_length;
    bool walls_named; ///< some layer is named as walls
    bool outlined;    ///< layers of rooms are walls, too
    bool by_looks;    ///< some shapes are passed over by their looks
    double share;     ///< of walls by their looks in all long lines
    size_t words;     ///< shapes that look like walls, but are lettering or the page
    size_t doors;     ///< made
    size_t gaps;      ///< of outer walls that are windows by what is drawn there
    size_t shown;     ///< shapes that windows in gaps and walls are made of, though left out before
    SL_ARRAY(sli_left_kind) left;
    sli_openings openings;
    size_t first_door;   ///< of the openings: those before it are bars
    size_t cuts, glazed; ///< openings that cut walls: doors, and windows
    size_t
        shut; ///< lines on layers of doors that stand at walls without a gap, where no door opens
} sli_choice;

static inline bool sli_choice_gone(const sli_choice *c, size_t wall) {
    return sl_bits_has(c->symbols.gone, wall);
}

/// Whether what means this is taken.
static inline bool sli_choice_takes(const sli_choice *c, sli_meaning means) {
    if (sli_contents_said(c->contents)) return means != SLI_MEANS_DOOR;
    return means == SLI_MEANS_WALL || means == SLI_MEANS_WINDOW ||
           (means == SLI_MEANS_NOTHING && !c->walls_named);
}

/// The usual width of doors that are drawn open; 0 where none are.
double sli_choice_door(const sli_choice *c);
/// A metre by the doors, which are 0.6 to 1.2 m wide, where the unit does not fit them.
double sli_choice_metre(const sli_choice *c);
/// The same where the plan is as large as a building by it; else 0.
double sli_choice_sure_metre(const sli_choice *c);
/// The longest that a door may be.
double sli_choice_longest_door(const sli_choice *c);

/// Says which layers are walls whose names say windows or doors as well (contents_both.c).
void sli_choice_take_both(const sli_choice *c);
/// Notes these layers, and what they are taken for.
void sli_choice_note_both(const sli_choice *c);

/// Where no name says what is a wall: finds what is no wall by its shape, among what is taken
/// (contents_parts.c).
sl_status sli_choice_find_parts(sli_choice *c);
/// Takes small pieces out of the walls, as --layers large asks; says so.
sl_status sli_choice_keep_large(const sli_choice *c, sli_pen *pen);

/// How light what shapes with looks lie on is: sli_looks_ground().
sl_status sli_choice_find_ground(sli_choice *c, double *ground);
/// Finds the openings that lie over walls: bars, doors of layers and swings (contents_doors.c).
/// Bars that cut are no walls themselves. Where doors are drawn as doors, other bars are windows.
sl_status sli_choice_find_openings(sli_choice *c);
/// Sets sl_map_source.joined, once the walls are chosen: some door leads from one part of the
/// drawing to another.
sl_status sli_choice_join_plans(const sli_choice *c);
/// Adds the doors to the map, with the option doors.
sl_status sli_choice_add_doors(sli_choice *c);

/// Looks among what is left out for windows and walls, once the choice is made (contents_left.c).
sl_status sli_choice_find_left_out(sli_choice *c);
/// Notes these.
void sli_choice_note_left_out(const sli_choice *c);

/// Adds a name to a list as --layers takes it, with a role, or "". False where it does not fit, or
/// is not to be typed.
bool sli_choice_add_name(sli_word name, const char *role, char *text, size_t size);
/// Notes lines on layers of doors that are far longer than doors.
void sli_choice_note_long_doors(const sli_choice *c);
/// Notes the layers of a drawing all of which are walls, where there are several.
void sli_choice_note_all(const sli_choice *c);
/// Notes what was chosen, and what is doubtful about it.
void sli_choice_note(const sli_choice *c);

#endif

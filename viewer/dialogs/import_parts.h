/// What the files of the import dialog share: its state, its widgets, and what each of them does.
#ifndef VIEWER_IMPORT_PARTS_H
#define VIEWER_IMPORT_PARTS_H

#include "dialogs/import_dialog.h"
#include "sightline/faults.h"
#include "sightline/io.h"

typedef enum field_name {
    FIELD_SLICE,
    FIELD_LAYERS,
    FIELD_STARTS,
    FIELD_TOLERANCE,
    FIELD_UNIT,
    FIELD_THRESHOLD,
    FIELD_WELD,
    FIELD_START,
    FIELD_ENTRANCE,
    FIELDS
} field_name;

/// What a layer of a drawing is taken for, by the names of the option (sl_import_options.layers).
typedef enum layer_role {
    ROLE_WALL,
    ROLE_DOOR,
    ROLE_WINDOW,
    ROLE_FURNITURE,
    ROLE_IGNORE,
    ROLES,
} layer_role;

/// What the next click in the plan is for.
typedef enum import_pick { PICK_NONE, PICK_INSIDE, PICK_FIRST, PICK_SECOND } import_pick;

typedef struct import_state {
    void (*then)(desk_state *desk, const document_source *source);
    document_source source; ///< as chosen so far, but for what fields and lists hold
    document_source first;  ///< as it was when the dialog opened
    bool beside;            ///< it stands beside the plan, which follows each choice
    sl_map_choice choice;
    dialog_list maps, layers;    ///< the latter has those that the filter leaves
    bool *taken;                 ///< by layer, where layers have no roles
    layer_role *roles, *guessed; ///< by layer of a drawing
    size_t *shown;               ///< by row of the list: the layer
    sl_drawing_layers drawn;     ///< of a drawing: its layers, with what is on them
    text_field filter;
    bool more, doors, cells;
    bool all_listed; ///< a role is that of all layers that the filter leaves
    bool unitless;   ///< the file does not say its unit: a unit that is typed is that of the file
    char unit[16];   ///< such a unit, as the option has it
    text_field fields[FIELDS];
    char *list;        ///< of layers, as the option has it; NULL: none
    char problem[512]; ///< "" for none
    char failed[512];  ///< why the choice that was read last was refused; "" if it was not
    double due;        ///< the clock's time at which the plan follows what was typed; 0: it has

    task *task; ///< that looks for a tolerance; NULL: none
    struct weld_job {
        document_source source;
        double weld;
    } * weld;

    import_pick pick;
    sl_segment line; ///< that is measured
    int line_ends;   ///< how many of its ends are there
    text_field length;
    task *leak_task; ///< that looks for leaks of the open map; NULL: none
    struct leak_job *leak_job;
    sl_segment *leaks; ///< of the map that is shown, the narrowest first
    double *widths;
    dialog_list leak_list;
    bool scales;                            ///< the map that is read next has a new scale
    double share_before;                    ///< of the inside in the plan, in the scale before
    char said_scale[320], said_sealed[320]; ///< of the inside; "" for nothing
    uint32_t leaks_of;                      ///< document->read, of which they are; 0: none
    bool has_start;
} import_state;

enum {
    FILTER = IMPORT_TYPES_INTO,
    MAPS,
    LAYERS_LIST,
    DOORS,
    CELLS,
    MORE,
    SUGGEST,
    ALL_LISTED,
    MEASURE,
    LENGTH,
    SET_LENGTH,
    INSIDE,
    LEAKS,
    CLOSE,
    CLOSE_ALL,
    REOPEN,
    FIRST_ROLE,
    FIRST_FIELD = FIRST_ROLE + ROLES
};

/// Writes a number into a field, or nothing.
void import_set_number(text_field *field, bool given, double value);
/// Writes a place into a field, and reads one, as "3,4.5"; false where the text is none.
void import_set_place(text_field *field, sl_point at);
bool import_read_place(const char *text, sl_point *at);
/// The sign of a unit that was typed; NULL where there is no such unit.
const char *import_sign(const char *text);
/// Says what is wrong with a choice; returns false.
bool import_complain(import_state *s, const char *what, const char *why);
/// The plan follows what was chosen. Not where the dialog is not beside it.
void import_preview(desk_state *desk, import_state *s);
/// Where typing goes by itself; Tab goes on from the widget `from`, or from there (0).
void import_focus_home(desk_state *desk, import_state *s, int from);

// --- import_layers.c: the list of layers

/// Finds the layers of a drawing, and makes the lists for all formats.
sl_status import_layers_begin(sl_context *context, import_state *s, bool all);
void import_layers_end(sl_context *context, import_state *s);
/// Whether the list is there.
bool import_asks_layers(const import_state *s);
/// Whether it has a filter: a long one, and one of roles.
bool import_has_filter(const import_state *s);
/// Whether layers have roles.
bool import_has_roles(const import_state *s);
void import_layers_filter(import_state *s);
/// A click on a row, a role, or "all that are listed". Returns whether layers are taken otherwise.
bool import_layers_act(import_state *s, int id);
/// The option that the list stands for, in s->list. False where a name cannot be written.
bool import_layers_join(sl_context *context, import_state *s);
/// How high it is without its rows, in plain texts.
double import_layers_height(const import_state *s);
double import_layers_draw(desk_state *desk, import_state *s, sl_box box, double y, double high);

// --- import_plan.c: scale, inside, leaks

void import_plan_end(sl_context *context, import_state *s);
void import_plan_act(desk_state *desk, import_state *s, int id);
/// Finds leaks of the map that is open now, in the background.
void import_plan_follow(desk_state *desk, import_state *s);
double import_plan_height(desk_state *desk, const import_state *s);
void import_plan_draw(desk_state *desk, import_state *s, sl_box box, double y);
/// Takes the length that was typed as that of the measured line.
void import_plan_scale(desk_state *desk, import_state *s);

#endif

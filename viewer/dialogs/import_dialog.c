/// The dialog of how a file is read. A format has only the rows that it has a use for. An empty
/// field stands for the usual, which it shows in grey.
#include "dialogs/import_parts.h"

#include "document/drawings.h"
#include "sightline/draw.h"
#include "sightline/support.h"

#include <math.h>
#include <string.h>

static const struct {
    const char *label, *hint;
    unsigned takes; ///< of sl_import_takes; 0: every format
} fields[FIELDS] = {
    [FIELD_SLICE] = {"Cut at the height", "the middle of the model", SL_TAKES_SLICE},
    [FIELD_LAYERS] = {"Layers", "the format's own choice; else NAME,NAME", SL_TAKES_LAYERS},
    [FIELD_STARTS] = {"Names of starts", "player, spawn, start ...; none: no starts",
                      SL_TAKES_STARTS},
    [FIELD_TOLERANCE] = {"Error of curves", "the usual", SL_TAKES_TOLERANCE},
    [FIELD_UNIT] = {"Unit", "the file's own; else mm cm m km in ft yd", SL_TAKES_UNIT},
    [FIELD_THRESHOLD] = {"Dark from", "0.5; up to 1", SL_TAKES_THRESHOLD},
    [FIELD_WELD] = {"Weld ends within", "rounding only", 0},
    [FIELD_START] = {"Start of the eye", "the map's own; else X,Y", 0},
    [FIELD_ENTRANCE] = {"Widest entrance", "the map's own, or found from the plan", 0},
};

/// Before the unit of a file that does not say its own.
#define ONE "1="

void import_destroy(desk_state *desk) {
    import_state *s = desk->dialog.import;
    if (!s) return;
    if (s->task) {
        task_drop(desk->context, s->task);
        document_source_destroy(desk->context, &s->weld->source);
        sl_free(desk->context, s->weld);
    }
    document_source_destroy(desk->context, &s->source);
    document_source_destroy(desk->context, &s->first);
    sl_map_choice_destroy(desk->context, &s->choice);
    import_layers_end(desk->context, s);
    import_plan_end(desk->context, s);
    sl_free(desk->context, s);
    desk->dialog.import = NULL;
}

void import_set_number(text_field *field, bool given, double value) {
    char text[SL_NUMBER_TEXT] = "";
    if (given) sl_number_write(value, text);
    field_set(field, text);
}

void import_set_place(text_field *field, sl_point at) {
    char text[2 * SL_NUMBER_TEXT + 1], x[SL_NUMBER_TEXT], y[SL_NUMBER_TEXT];
    sl_number_write(at.x, x);
    sl_number_write(at.y, y);
    snprintf(text, sizeof text, "%s,%s", x, y);
    field_set(field, text);
}

bool import_read_place(const char *text, sl_point *at) {
    const char *comma = strchr(text, ',');
    const char *second = comma ? comma + 1 + strspn(comma + 1, " ") : NULL;
    return comma && sl_number_read(text, (size_t)(comma - text), &at->x) &&
           sl_number_read(second, strlen(second), &at->y);
}

static void fill_fields(import_state *s) {
    const sl_import_options *o = &s->source.options;
    import_set_number(&s->fields[FIELD_SLICE], o->has_slice, o->slice);
    // Where there is a list, the field is for what the list cannot say.
    const bool listed = s->choice.layers.count && o->layers && !strchr(o->layers, ':');
    field_set(&s->fields[FIELD_LAYERS], o->layers && !listed ? o->layers : "");
    field_set(&s->fields[FIELD_STARTS], o->start_names ? o->start_names : "");
    import_set_number(&s->fields[FIELD_TOLERANCE], o->tolerance > 0, o->tolerance);
    s->unitless = o->unit && strncmp(o->unit, ONE, strlen(ONE)) == 0;
    field_set(&s->fields[FIELD_UNIT], o->unit ? o->unit + (s->unitless ? strlen(ONE) : 0) : "");
    import_set_number(&s->fields[FIELD_THRESHOLD], o->threshold > 0, o->threshold);
    import_set_number(&s->fields[FIELD_WELD], s->source.has_weld, s->source.weld);
    field_set(&s->fields[FIELD_START], "");
    if (s->source.has_start) import_set_place(&s->fields[FIELD_START], s->source.start);
    import_set_number(&s->fields[FIELD_ENTRANCE], o->entrance > 0, o->entrance);
    s->doors = o->doors;
    s->cells = o->cells;
}

static bool asks_map(const import_state *s) {
    return s->choice.maps.count > 1;
}

sl_status import_open(desk_state *desk, const document_source *source, sl_map_choice *choice,
                      bool all, void (*then)(desk_state *desk, const document_source *source)) {
    import_destroy(desk);
    import_state *s = sl_alloc_array(desk->context, 1, sizeof *s);
    if (!s) return SL_NO_MEMORY;
    desk->dialog.import = s;
    SL_TRY(document_source_copy(desk->context, source, &s->source));
    SL_TRY(document_source_copy(desk->context, source, &s->first));
    s->choice = *choice;
    *choice = (sl_map_choice){.format = choice->format};
    s->beside = drawing_is(source->path) && s->choice.maps.count < 2;
    SL_TRY(import_layers_begin(desk->context, s, all));
    s->then = then;
    s->more = all && !s->beside;
    s->maps = (dialog_list){.count = s->choice.maps.count};
    for (size_t i = 0; source->options.map && i < s->maps.count; i++)
        if (strcmp(s->choice.maps.names[i], s->source.options.map) == 0) s->maps.at = i;
    fill_fields(s);
    dialog_push(&desk->dialog, DIALOG_IMPORT,
                asks_map(s)                                     ? MAPS
                : import_asks_layers(s) && import_has_filter(s) ? FILTER
                : import_asks_layers(s)                         ? LAYERS_LIST
                                                                : DIALOG_MAIN);
    if (s->beside) import_focus_home(desk, s, 0);
    return SL_OK;
}

void import_focus_home(desk_state *desk, import_state *s, int from) {
    desk->dialog.tab_from = from;
    desk->dialog.focus[desk->dialog.depth - 1] =
        import_asks_layers(s) && import_has_filter(s) ? FILTER : FIRST_FIELD + FIELD_UNIT;
}

// --- from the fields to the source

bool import_complain(import_state *s, const char *what, const char *why) {
    snprintf(s->problem, sizeof s->problem, "%.200s: %s", what, why);
    return false;
}

/// A number of at least `low` and at most `high`; *given is false for an empty field.
static bool read_number(import_state *s, field_name name, double low, double high, bool *given,
                        double *value) {
    const char *text = s->fields[name].text;
    *given = *text != '\0';
    if (!*given) return true;
    if (sl_number_read(text, strlen(text), value) && *value >= low && *value <= high) return true;
    return import_complain(s, fields[name].label,
                           high == 1 ? "a number over 0, at most 1, is needed"
                           : low > 0 ? "a number over 0 is needed"
                           : low < 0 ? "a number is needed"
                                     : "0 or a number over 0 is needed");
}

static bool read_start(import_state *s, document_source *out) {
    const char *text = s->fields[FIELD_START].text;
    out->has_start = *text != '\0';
    if (!*text) return true;
    if (import_read_place(text, &out->start) && fabs(out->start.x) <= SL_COORDINATE_MAX &&
        fabs(out->start.y) <= SL_COORDINATE_MAX)
        return true;
    return import_complain(s, fields[FIELD_START].label, "a place is needed, as 3,4.5");
}

/// The text of a field; NULL for an empty one and for one that the format has no use for.
static const char *given_text(const import_state *s, field_name name) {
    const char *text = s->fields[name].text;
    const bool measured = name == FIELD_UNIT && s->beside;
    return *text && (measured || s->source.takes & fields[name].takes) ? text : NULL;
}

/// The source as the fields have it; its texts stay theirs. False where a field is wrong.
static bool read_source(sl_context *context, import_state *s, document_source *out) {
    sl_import_options *o = &out->options;
    bool given;
    *out = s->source;
    s->problem[0] = '\0';
    o->layers = given_text(s, FIELD_LAYERS);
    if (import_asks_layers(s) && !o->layers) {
        if (!import_layers_join(context, s)) return false;
        o->layers = s->list;
    }
    o->start_names = given_text(s, FIELD_STARTS);
    o->unit = given_text(s, FIELD_UNIT);
    if (s->unitless && o->unit && import_sign(o->unit)) {
        snprintf(s->unit, sizeof s->unit, ONE "%s", o->unit);
        o->unit = s->unit;
    }
    o->doors = s->doors;
    o->cells = s->cells;
    if (asks_map(s) && s->maps.at < s->maps.count) o->map = s->choice.maps.names[s->maps.at];
    if (!read_number(s, FIELD_SLICE, -1e150, 1e150, &given, &o->slice)) return false;
    // A model is cut in its middle if no height is given.
    if (!given) o->slice = s->source.lowest + (s->source.highest - s->source.lowest) / 2;
    o->has_slice = (s->source.takes & SL_TAKES_SLICE) != 0;
    o->tolerance = o->threshold = o->entrance = 0;
    return read_number(s, FIELD_TOLERANCE, 1e-300, 1e300, &given, &o->tolerance) &&
           read_number(s, FIELD_THRESHOLD, 1e-300, 1, &given, &o->threshold) &&
           read_number(s, FIELD_ENTRANCE, SL_COORDINATE_MIN, SL_COORDINATE_MAX, &given,
                       &o->entrance) &&
           read_number(s, FIELD_WELD, 0, 1e150, &out->has_weld, &out->weld) && read_start(s, out);
}

// --- the tolerance that fits

static sl_status find_weld(sl_context *context, void *data) {
    struct weld_job *job = data;
    sl_map map = {0};
    SL_TRY(sl_map_read(context, job->source.path, &job->source.options, &map));
    const sl_status status = sl_suggest_weld(context, &map, &job->weld);
    sl_map_destroy(context, &map);
    return status;
}

static void suggest(desk_state *desk, import_state *s) {
    document_source source;
    if (s->task || !read_source(desk->context, s, &source)) return;
    s->weld = sl_alloc_array(desk->context, 1, sizeof *s->weld);
    sl_status status =
        s->weld ? document_source_copy(desk->context, &source, &s->weld->source) : SL_NO_MEMORY;
    if (status == SL_OK)
        status = task_start(desk->context, find_weld, s->weld, NULL, NULL, &s->task);
    if (status == SL_OK) return;
    snprintf(s->problem, sizeof s->problem, "%s", sl_context_message(desk->context));
    if (s->weld) document_source_destroy(desk->context, &s->weld->source);
    sl_free(desk->context, s->weld);
    s->weld = NULL;
}

/// Takes over what was found.
static void take_weld(desk_state *desk, import_state *s) {
    if (!s->task || (!desk->ui->steady && !task_done(s->task))) return;
    const sl_status status = task_end(desk->context, s->task);
    s->task = NULL;
    if (status != SL_OK)
        snprintf(s->problem, sizeof s->problem, "%s", sl_context_message(desk->context));
    else if (s->weld->weld > 0) {
        import_set_number(&s->fields[FIELD_WELD], true, s->weld->weld);
        desk->dialog.focus[desk->dialog.depth - 1] = DIALOG_MAIN;
    } else
        snprintf(s->problem, sizeof s->problem, "No gaps of rounding were found.");
    document_source_destroy(desk->context, &s->weld->source);
    sl_free(desk->context, s->weld);
    s->weld = NULL;
}

// --- what it does

/// What is typed settles for so long before the plan follows.
#define SETTLED_SECONDS 0.4

void import_preview(desk_state *desk, import_state *s) {
    document_source source;
    s->due = 0;
    s->failed[0] = '\0';
    if (!s->beside || !read_source(desk->context, s, &source)) return;
    const char *open = desk->document->source.path;
    source.again = open && strcmp(open, source.path) == 0;
    s->then(desk, &source);
}

bool import_is_beside(const desk_state *desk) {
    for (int i = 0; i < desk->dialog.depth; i++)
        if (desk->dialog.stack[i] == DIALOG_IMPORT) return desk->dialog.import->beside;
    return false;
}

bool import_take_failure(desk_state *desk, const char *message) {
    import_state *s = desk->dialog.import;
    if (!s || !s->beside || dialog_open_now(&desk->dialog) != DIALOG_IMPORT) return false;
    snprintf(s->failed, sizeof s->failed, "%s", message);
    snprintf(s->problem, sizeof s->problem, "%s", message);
    return true;
}

/// Beside the plan all is read already, but for what was typed just now.
static void accept(desk_state *desk, import_state *s) {
    document_source source;
    if (!read_source(desk->context, s, &source)) return;
    if (s->beside && s->due > 0) import_preview(desk, s);
    if (s->failed[0]) {
        // It was refused: the plan has another one, so the dialog does not go away with it.
        snprintf(s->problem, sizeof s->problem, "%s", s->failed);
        return;
    }
    if (s->beside && !desk->ui->steady) drawing_remember(desk->context, &source);
    dialog_pop(&desk->dialog);
    if (s->beside) {
        import_destroy(desk);
        return;
    }
    // What it opens may open this dialog once more.
    void (*const then)(desk_state *, const document_source *) = s->then;
    document_source chosen;
    const sl_status status = document_source_copy(desk->context, &source, &chosen);
    ui_report(desk->ui, desk->context, status);
    import_destroy(desk);
    if (status != SL_OK) return;
    then(desk, &chosen);
    document_source_destroy(desk->context, &chosen);
}

/// Puts back what was chosen before.
static void cancel(desk_state *desk, import_state *s) {
    document_source source;
    const bool changed = !s->beside || s->due > 0 || !read_source(desk->context, s, &source) ||
                         !document_source_same(&source, &s->first);
    dialog_pop(&desk->dialog);
    if (s->beside && changed) {
        s->first.again = true;
        s->then(desk, &s->first);
    }
    import_destroy(desk);
}

void import_act(desk_state *desk, int id) {
    import_state *s = desk->dialog.import;
    switch (id) {
    case DIALOG_CANCEL:
        cancel(desk, s);
        return;
    case DIALOG_MAIN:
    case MAPS:
        accept(desk, s);
        return;
    case DOORS:
        s->doors = !s->doors;
        break;
    case CELLS:
        s->cells = !s->cells;
        break;
    case MORE:
        s->more = true;
        desk->dialog.focus[desk->dialog.depth - 1] = DIALOG_MAIN;
        break;
    case SUGGEST:
        suggest(desk, s);
        break;
    default:
        if (id == LAYERS_LIST || id == ALL_LISTED || (id >= FIRST_ROLE && id < FIRST_FIELD)) {
            if (!import_layers_act(s, id)) break;
            import_preview(desk, s);
        } else {
            import_plan_act(desk, s, id);
        }
        break;
    }
    if (id == DOORS || id == CELLS) import_preview(desk, s);
    // Letters that are typed next are meant for the list, and never press a button.
    const bool stays = id == LAYERS_LIST || id == MEASURE || (id == INSIDE && s->pick != PICK_NONE);
    if (s->beside && !stays) import_focus_home(desk, s, id == SET_LENGTH ? MEASURE : id);
}

void import_edited(desk_state *desk, int id) {
    import_state *s = desk->dialog.import;
    s->problem[0] = '\0';
    if (id == FILTER) import_layers_filter(s);
    if (s->beside && id >= FIRST_FIELD) s->due = sl_seconds() + SETTLED_SECONDS;
}

bool import_key(desk_state *desk, const char *key) {
    import_state *s = desk->dialog.import;
    if (strcmp(key, "Return") != 0 || desk->dialog.focus[desk->dialog.depth - 1] != LENGTH)
        return false;
    import_plan_scale(desk, s);
    return true;
}

// --- the picture

static bool is_shown(const import_state *s, field_name name) {
    if (s->beside && !s->more) return name == FIELD_UNIT || name == FIELD_ENTRANCE;
    if (name == FIELD_UNIT && s->beside) return true; // a unit can be measured in all formats
    return s->more && (!fields[name].takes || s->source.takes & fields[name].takes);
}

/// Rows of the sheet without its lists.
static int count_rows(const import_state *s) {
    int rows = 0;
    for (int i = 0; i < FIELDS; i++) rows += is_shown(s, (field_name)i);
    rows += s->more && s->source.takes & SL_TAKES_DOORS;
    rows += s->more && s->source.takes & SL_TAKES_CELLS;
    return rows;
}

static double draw_maps(desk_state *desk, import_state *s, sl_box box, double y, double high) {
    ui_state *ui = desk->ui;
    const double t = ui->text;
    const sl_box frame = {{box.min.x, y + 1.8 * t}, {box.max.x, y + 1.8 * t + high}};
    ui_text(ui, box.min.x, y + 1.2 * t, 1, false, ui->palette.ink,
            s->choice.format ? "Which of its maps?" : "Which of its storeys?");
    dialog_list_frame(&desk->dialog, MAPS, frame, &s->maps);
    for (size_t i = s->maps.first; i < s->maps.count && i < s->maps.first + s->maps.page; i++) {
        const sl_box row = dialog_list_row(&desk->dialog, MAPS, frame, &s->maps, i);
        ui_text(ui, row.min.x + 0.6 * t, row.min.y + 1.2 * t, 1, false, ui->palette.ink,
                s->choice.maps.names[i]);
    }
    return frame.max.y + 0.7 * t;
}

static double draw_field(desk_state *desk, import_state *s, sl_box box, double y, field_name name) {
    ui_state *ui = desk->ui;
    const double t = ui->text, left = box.min.x + (s->beside ? 9.5 : 12) * t;
    const bool weld = name == FIELD_WELD;
    const dialog_label button = {SUGGEST, s->task ? "Looking ..." : "Suggest"};
    const double wide = weld ? dialog_buttons_width(&desk->dialog, &button, 1) + 0.6 * t : 0;
    char hint[160], label[96];
    snprintf(hint, sizeof hint, "%s", fields[name].hint);
    snprintf(label, sizeof label, "%s", fields[name].label);
    if (name == FIELD_LAYERS && s->choice.layers.count)
        snprintf(hint, sizeof hint,
                 import_has_roles(s) ? "instead of the list: NAME,NAME; *: all"
                                     : "instead of the list: NAME,NAME:TILE+TILE");
    if (name == FIELD_UNIT && !(s->source.takes & SL_TAKES_UNIT))
        snprintf(hint, sizeof hint, "not known; measure a line, or 0.01=m");
    if (name == FIELD_SLICE)
        snprintf(label, sizeof label, "Cut, %.5g to %.5g", s->source.lowest, s->source.highest);
    ui_text(ui, box.min.x, y + 1.25 * t, 1, false, ui->palette.ink, label);
    dialog_field(&desk->dialog, FIRST_FIELD + name,
                 (sl_box){{left, y}, {box.max.x - wide, y + 1.8 * t}}, &s->fields[name], hint);
    if (weld) dialog_buttons(&desk->dialog, box.max.x, y, &button, 1);
    return y + DIALOG_ROW * t;
}

static double draw_options(desk_state *desk, import_state *s, sl_box box, double y) {
    const double t = desk->ui->text;
    for (int i = 0; i < FIELDS; i++)
        if (is_shown(s, (field_name)i)) y = draw_field(desk, s, box, y, (field_name)i);
    if (s->more && s->source.takes & SL_TAKES_DOORS) {
        dialog_check(&desk->dialog, DOORS, (sl_box){{box.min.x, y}, {box.max.x, y + 1.8 * t}},
                     "Doors as doors; else as they are when the map begins", s->doors);
        y += DIALOG_ROW * t;
    }
    if (s->more && s->source.takes & SL_TAKES_CELLS) {
        dialog_check(&desk->dialog, CELLS, (sl_box){{box.min.x, y}, {box.max.x, y + 1.8 * t}},
                     "The cells that the file brings along", s->cells);
        y += DIALOG_ROW * t;
    }
    return y;
}

/// Rows that a list has room for, from 4 to 12, where all else takes `rest` plain texts.
static double rows_with_room(const import_state *s, double room, double lists) {
    const double most = fmin(fmax(floor((room / fmax(lists, 1) - 2.7) / 1.7), 4), 12);
    return fmin(fmax(fmax((double)s->maps.count, (double)s->choice.layers.count), 3), most);
}

static void draw_beside(desk_state *desk, import_state *s) {
    static const dialog_label buttons[] = {
        {MORE, "More options"}, {DIALOG_CANCEL, "Cancel"}, {DIALOG_MAIN, "Done"}};
    ui_state *ui = desk->ui;
    char title[320];
    snprintf(title, sizeof title, "How to read %.290s", files_base(s->source.path));
    const double rest = 6.4 + DIALOG_ROW * count_rows(s) + import_plan_height(desk, s) +
                        dialog_problem_height(&desk->dialog, IMPORT_WIDE - 2, s->problem) +
                        (import_asks_layers(s) ? import_layers_height(s) : 0);
    const double text = fmin(ui->text, box_width(desk->dialog.dock) / IMPORT_WIDE);
    const double high =
        1.7 * rows_with_room(s, box_height(desk->dialog.dock) / text - rest, 1) + 0.2;
    const sl_box box = dialog_begin_beside(&desk->dialog, IMPORT_WIDE,
                                           rest + (import_asks_layers(s) ? high : 0), title);
    const double t = ui->text;
    double y = box.min.y;
    if (import_asks_layers(s)) y = import_layers_draw(desk, s, box, y, high * t);
    y = draw_options(desk, s, box, y);
    import_plan_draw(desk, s, box, y);
    dialog_problem(&desk->dialog, (sl_point){box.min.x, box.max.y - 2.3 * t}, box_width(box),
                   s->problem);
    const int from = s->more ? 1 : 0;
    dialog_buttons(&desk->dialog, box.max.x, box.max.y - 1.8 * t, buttons + from, 3 - from);
    dialog_end(&desk->dialog);
}

static void draw_over_all(desk_state *desk, import_state *s) {
    static const dialog_label buttons[] = {
        {MORE, "More options"}, {DIALOG_CANCEL, "Cancel"}, {DIALOG_MAIN, "Open"}};
    ui_state *ui = desk->ui;
    char title[320];
    snprintf(title, sizeof title, "Open %.300s", files_base(s->source.path));
    const double lists = asks_map(s) + import_asks_layers(s);
    const double rest = 8.8 + DIALOG_ROW * count_rows(s) +
                        (import_asks_layers(s) && import_has_filter(s) ? 2.2 : 0) +
                        dialog_problem_height(&desk->dialog, 48, s->problem);
    const double text = fmin(ui->text, (ui->width - 12) / 50.0);
    const double high = 1.7 * rows_with_room(s, (ui->height - 12) / text - rest, lists) + 0.2;
    const sl_box box = dialog_begin(&desk->dialog, 50, rest + lists * (high + 2.5), title);
    const double t = ui->text;
    double y = box.min.y;
    if (asks_map(s)) y = draw_maps(desk, s, box, y, high * t);
    if (import_asks_layers(s)) y = import_layers_draw(desk, s, box, y, high * t);
    draw_options(desk, s, box, y);
    dialog_problem(&desk->dialog, (sl_point){box.min.x, box.max.y - 2.5 * t}, box_width(box),
                   s->problem);
    const int from = s->more || !s->choice.format ? 1 : 0;
    dialog_buttons(&desk->dialog, box.max.x, box.max.y - 1.8 * t, buttons + from, 3 - from);
    dialog_end(&desk->dialog);
}

void import_draw(desk_state *desk) {
    import_state *s = desk->dialog.import;
    take_weld(desk, s);
    if (s->due > 0 && (desk->ui->steady || sl_seconds() > s->due)) import_preview(desk, s);
    if (s->beside) import_plan_follow(desk, s);
    if (s->beside)
        draw_beside(desk, s);
    else
        draw_over_all(desk, s);
}

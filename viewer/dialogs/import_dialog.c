/// The dialog of how a file is read. A format has only the rows that it has a use for. An empty
/// field stands for the usual, which it shows in grey.
#include "dialogs/import_dialog.h"

#include "document/files.h"
#include "sightline/draw.h"
#include "sightline/faults.h"
#include "sightline/io.h"
#include "sightline/support.h"

#include <math.h>
#include <string.h>
#include <strings.h>

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

typedef struct import_state {
    void (*then)(desk_state *desk, const document_source *source);
    document_source source;
    sl_map_choice choice;
    dialog_list maps, layers; ///< the latter has those that the filter leaves
    bool *taken;              ///< by layer
    size_t *shown;            ///< by row of the list: the layer
    sl_drawing_layers drawn;  ///< of a drawing: its layers, with what is on them
    text_field filter;
    bool more, doors, cells;
    text_field fields[FIELDS];
    char problem[512]; ///< "" for none

    task *task; ///< that looks for a tolerance; NULL: none
    struct weld_job {
        document_source source;
        double weld;
    } * weld;
} import_state;

enum { MAPS = DIALOG_OWN, LAYERS_LIST, DOORS, CELLS, MORE, SUGGEST, FILTER, FIRST_FIELD };

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

void import_destroy(desk_state *desk) {
    import_state *s = desk->dialog.import;
    if (!s) return;
    if (s->task) {
        task_drop(desk->context, s->task);
        document_source_destroy(desk->context, &s->weld->source);
        sl_free(desk->context, s->weld);
    }
    document_source_destroy(desk->context, &s->source);
    sl_map_choice_destroy(desk->context, &s->choice);
    sl_drawing_layers_destroy(desk->context, &s->drawn);
    sl_free(desk->context, s->taken);
    sl_free(desk->context, s->shown);
    sl_free(desk->context, s);
    desk->dialog.import = NULL;
}

static void set_number(text_field *field, bool given, double value) {
    char text[SL_NUMBER_TEXT] = "";
    if (given) sl_number_write(value, text);
    field_set(field, text);
}

static void fill_fields(import_state *s) {
    const sl_import_options *o = &s->source.options;
    set_number(&s->fields[FIELD_SLICE], o->has_slice, o->slice);
    // Where there is a list, the field is for what the list cannot say.
    const bool listed = s->choice.layers.count && o->layers && !strchr(o->layers, ':');
    field_set(&s->fields[FIELD_LAYERS], o->layers && !listed ? o->layers : "");
    field_set(&s->fields[FIELD_STARTS], o->start_names ? o->start_names : "");
    set_number(&s->fields[FIELD_TOLERANCE], o->tolerance > 0, o->tolerance);
    field_set(&s->fields[FIELD_UNIT], o->unit ? o->unit : "");
    set_number(&s->fields[FIELD_THRESHOLD], o->threshold > 0, o->threshold);
    set_number(&s->fields[FIELD_WELD], s->source.has_weld, s->source.weld);
    char text[2 * SL_NUMBER_TEXT + 1] = "", x[SL_NUMBER_TEXT], y[SL_NUMBER_TEXT];
    if (s->source.has_start) {
        sl_number_write(s->source.start.x, x);
        sl_number_write(s->source.start.y, y);
        snprintf(text, sizeof text, "%s,%s", x, y);
    }
    field_set(&s->fields[FIELD_START], text);
    set_number(&s->fields[FIELD_ENTRANCE], o->entrance > 0, o->entrance);
    s->doors = o->doors;
    s->cells = o->cells;
}

/// The layers that the option names; at first none.
static void fill_layers(import_state *s) {
    const char *list = s->source.options.layers;
    for (size_t i = 0; list && i < s->choice.layers.count; i++) {
        const char *name = s->choice.layers.names[i];
        for (const char *at = list; *at;) {
            const size_t length = strcspn(at, ",");
            s->taken[i] |= strlen(name) == length && strncmp(at, name, length) == 0;
            at += length + (at[length] == ',');
        }
    }
}

// --- the list of layers

/// Whether a name holds a part, in capitals or not.
static bool holds(const char *name, const char *part) {
    const size_t length = strlen(part);
    for (; *name && strncasecmp(name, part, length) != 0; name++)
        ;
    return *name || !length;
}

/// Lists the layers that the filter leaves.
static void filter_layers(import_state *s) {
    size_t count = 0;
    for (size_t i = 0; i < s->choice.layers.count; i++)
        if (holds(s->choice.layers.names[i], s->filter.text)) s->shown[count++] = i;
    s->layers.count = count;
    s->layers.at = s->layers.first = 0;
}

/// A long list has a filter.
static bool has_filter(const import_state *s) {
    return s->choice.layers.count > 8;
}

/// The layers of a drawing, which its format does not list by itself.
static sl_status list_drawn(sl_context *context, import_state *s) {
    const char *name = s->choice.format ? s->choice.format->name : "";
    const bool dxf = strcmp(name, "dxf") == 0;
    sl_bytes bytes;
    if (s->choice.layers.count || (!dxf && strcmp(name, "svg") != 0)) return SL_OK;
    SL_TRY(sl_file_read(context, s->source.path, &bytes));
    sl_status status =
        dxf ? sl_drawing_layers_dxf(context, s->source.path, bytes.data, bytes.size, &s->drawn)
            : sl_drawing_layers_svg(context, s->source.path, bytes.data, bytes.size, &s->drawn);
    sl_free(context, bytes.data);
    for (size_t i = 0; i < s->drawn.count && status == SL_OK; i++)
        status = sl_map_list_add(context, &s->choice.layers, s->drawn.items[i].name,
                                 strlen(s->drawn.items[i].name));
    return status;
}

static bool asks_map(const import_state *s) {
    return s->choice.maps.count > 1;
}

/// The list of layers takes the place of the field.
static bool asks_layers(const import_state *s) {
    return s->choice.layers.count > 0 && (s->more || s->choice.layers_unsaid);
}

sl_status import_open(desk_state *desk, const document_source *source, sl_map_choice *choice,
                      bool all, void (*then)(desk_state *desk, const document_source *source)) {
    import_destroy(desk);
    import_state *s = sl_alloc_array(desk->context, 1, sizeof *s);
    if (!s) return SL_NO_MEMORY;
    desk->dialog.import = s;
    SL_TRY(document_source_copy(desk->context, source, &s->source));
    s->choice = *choice;
    *choice = (sl_map_choice){.format = choice->format};
    if (all) SL_TRY(list_drawn(desk->context, s));
    const size_t layers = s->choice.layers.count;
    s->taken = sl_alloc_array(desk->context, layers + 1, sizeof *s->taken);
    s->shown = sl_alloc_array(desk->context, layers + 1, sizeof *s->shown);
    if (!s->taken || !s->shown) return SL_NO_MEMORY;
    s->then = then;
    s->more = all;
    s->maps = (dialog_list){.count = s->choice.maps.count};
    for (size_t i = 0; source->options.map && i < s->maps.count; i++)
        if (strcmp(s->choice.maps.names[i], s->source.options.map) == 0) s->maps.at = i;
    s->layers = (dialog_list){.acts = true, .marks = true};
    filter_layers(s);
    fill_fields(s);
    fill_layers(s);
    dialog_push(&desk->dialog, DIALOG_IMPORT,
                asks_map(s)                       ? MAPS
                : asks_layers(s) && has_filter(s) ? FILTER
                : asks_layers(s)                  ? LAYERS_LIST
                                                  : DIALOG_MAIN);
    return SL_OK;
}

// --- from the fields to the source

static bool complain(import_state *s, const char *what, const char *why) {
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
    return complain(s, fields[name].label,
                    high == 1 ? "a number over 0, at most 1, is needed"
                    : low > 0 ? "a number over 0 is needed"
                    : low < 0 ? "a number is needed"
                              : "0 or a number over 0 is needed");
}

static bool read_start(import_state *s, document_source *out) {
    const char *text = s->fields[FIELD_START].text, *comma = strchr(text, ',');
    out->has_start = *text != '\0';
    if (!*text) return true;
    const char *second = comma ? comma + 1 + strspn(comma + 1, " ") : NULL;
    if (comma && sl_number_read(text, (size_t)(comma - text), &out->start.x) &&
        sl_number_read(second, strlen(second), &out->start.y) &&
        fabs(out->start.x) <= SL_COORDINATE_MAX && fabs(out->start.y) <= SL_COORDINATE_MAX)
        return true;
    return complain(s, fields[FIELD_START].label, "a place is needed, as 3,4.5");
}

/// The text of a field; NULL for an empty one and for one that the format has no use for.
static const char *given_text(const import_state *s, field_name name) {
    const char *text = s->fields[name].text;
    return *text && s->source.takes & fields[name].takes ? text : NULL;
}

/// The names of the layers that are chosen, with commas.
static bool join_layers(import_state *s, char *text, size_t room) {
    size_t length = 0;
    text[0] = '\0';
    for (size_t i = 0; i < s->choice.layers.count; i++) {
        const char *name = s->choice.layers.names[i];
        if (!s->taken[i]) continue;
        if (strchr(name, ','))
            return complain(s, name, "a layer with a comma in its name cannot be chosen");
        if (length + strlen(name) + 2 > room) return complain(s, "Layers", "there are too many");
        length += (size_t)snprintf(text + length, room - length, "%s%s", length ? "," : "", name);
    }
    return true;
}

/// The source as the fields have it; its texts stay theirs. False where a field is wrong.
static bool read_source(import_state *s, document_source *out, char layers[FIELD_TEXT]) {
    sl_import_options *o = &out->options;
    bool given;
    *out = s->source;
    s->problem[0] = '\0';
    o->layers = given_text(s, FIELD_LAYERS);
    if (asks_layers(s) && !o->layers) {
        if (!join_layers(s, layers, FIELD_TEXT)) return false;
        o->layers = *layers ? layers : NULL;
    }
    o->start_names = given_text(s, FIELD_STARTS);
    o->unit = given_text(s, FIELD_UNIT);
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
    char layers[FIELD_TEXT];
    if (s->task || !read_source(s, &source, layers)) return;
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
        set_number(&s->fields[FIELD_WELD], true, s->weld->weld);
        desk->dialog.focus[desk->dialog.depth - 1] = DIALOG_MAIN;
    } else
        snprintf(s->problem, sizeof s->problem, "No gaps of rounding were found.");
    document_source_destroy(desk->context, &s->weld->source);
    sl_free(desk->context, s->weld);
    s->weld = NULL;
}

// --- what it does

static void accept(desk_state *desk, import_state *s) {
    document_source source;
    char layers[FIELD_TEXT];
    if (!read_source(s, &source, layers)) return;
    dialog_pop(&desk->dialog);
    s->then(desk, &source);
    import_destroy(desk);
}

void import_act(desk_state *desk, int id) {
    import_state *s = desk->dialog.import;
    switch (id) {
    case DIALOG_CANCEL:
        dialog_pop(&desk->dialog);
        import_destroy(desk);
        break;
    case DIALOG_MAIN:
    case MAPS:
        accept(desk, s);
        break;
    case LAYERS_LIST:
        if (s->layers.at < s->layers.count) s->taken[s->shown[s->layers.at]] ^= true;
        break;
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
        break;
    }
}

void import_edited(desk_state *desk, int id) {
    if (id == FILTER) filter_layers(desk->dialog.import);
    desk->dialog.import->problem[0] = '\0';
}

// --- the picture

static bool is_shown(const import_state *s, field_name name) {
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
    ui_text(ui, box.min.x, y + 1.2 * t, 1, false, ui->palette.ink, "Which of its maps?");
    dialog_list_frame(&desk->dialog, MAPS, frame, &s->maps);
    for (size_t i = s->maps.first; i < s->maps.count && i < s->maps.first + s->maps.page; i++) {
        const sl_box row = dialog_list_row(&desk->dialog, MAPS, frame, &s->maps, i);
        ui_text(ui, row.min.x + 0.6 * t, row.min.y + 1.2 * t, 1, false, ui->palette.ink,
                s->choice.maps.names[i]);
    }
    return frame.max.y + 0.7 * t;
}

static double draw_layers(desk_state *desk, import_state *s, sl_box box, double y, double high) {
    ui_state *ui = desk->ui;
    const double t = ui->text;
    const sl_box frame = {{box.min.x, y + 1.8 * t}, {box.max.x, y + 1.8 * t + high}};
    ui_text(
        ui, box.min.x, y + 1.2 * t, 1, false, ui->palette.ink,
        s->choice.layers_unsaid
            ? "Which layers are solid? The file does not say. None: by their names, if these tell"
        : s->drawn.count ? "Layers that are walls; none: those whose names or looks say so"
                         : "Solid layers; none: those that the file marks");
    if (has_filter(s)) {
        dialog_field(
            &desk->dialog, FILTER,
            (sl_box){{box.min.x, frame.max.y + 0.4 * t}, {box.max.x, frame.max.y + 2.2 * t}},
            &s->filter, "A part of a name leaves those layers in the list");
    }
    dialog_list_frame(&desk->dialog, LAYERS_LIST, frame, &s->layers);
    for (size_t i = s->layers.first; i < s->layers.count && i < s->layers.first + s->layers.page;
         i++) {
        const sl_box row = dialog_list_row(&desk->dialog, LAYERS_LIST, frame, &s->layers, i);
        const size_t layer = s->shown[i];
        char count[SL_COUNT_TEXT + 8] = "";
        if (layer < s->drawn.count) {
            char number[SL_COUNT_TEXT];
            sl_text_count(s->drawn.items[layer].entities, "", number);
            snprintf(count, sizeof count, "%s%s", number, s->drawn.items[layer].on ? "" : ", off");
        }
        ui_check(ui, row, s->choice.layers.names[layer], *count ? count : NULL, s->taken[layer],
                 -1);
        ui_hit(ui, HIT_DIALOG, LAYERS_LIST | ((int)i + 1) << 8, row);
    }
    return frame.max.y + (has_filter(s) ? 2.9 : 0.7) * t;
}

static double draw_field(desk_state *desk, import_state *s, sl_box box, double y, field_name name) {
    ui_state *ui = desk->ui;
    const double t = ui->text, left = box.min.x + 12 * t;
    const bool weld = name == FIELD_WELD;
    const dialog_label button = {SUGGEST, s->task ? "Looking ..." : "Suggest"};
    const double wide = weld ? dialog_buttons_width(&desk->dialog, &button, 1) + 0.6 * t : 0;
    char hint[160], label[96];
    snprintf(hint, sizeof hint, "%s", fields[name].hint);
    snprintf(label, sizeof label, "%s", fields[name].label);
    if (name == FIELD_LAYERS && s->choice.layers.count)
        snprintf(hint, sizeof hint,
                 s->drawn.count ? "instead of the list: NAME,NAME; *: all"
                                : "instead of the list: NAME,NAME:TILE+TILE");
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

void import_draw(desk_state *desk) {
    static const dialog_label buttons[] = {
        {MORE, "More options"}, {DIALOG_CANCEL, "Cancel"}, {DIALOG_MAIN, "Open"}};
    import_state *s = desk->dialog.import;
    ui_state *ui = desk->ui;
    char title[320];
    take_weld(desk, s);
    snprintf(title, sizeof title, "Open %.300s", files_base(s->source.path));
    const int rows = count_rows(s);
    // Lists have 4 to 12 rows, as there is room.
    const double lists = asks_map(s) + asks_layers(s);
    const double rest = 8.8 + DIALOG_ROW * rows + (asks_layers(s) && has_filter(s) ? 2.2 : 0);
    const double text = fmin(ui->text, (ui->width - 12) / 50.0);
    const double room = ((ui->height - 12) / text - rest) / fmax(lists, 1) - 2.7;
    const double most = fmin(fmax(floor(room / 1.7), 4), 12);
    const double list_rows =
        fmin(fmax(fmax((double)s->maps.count, (double)s->layers.count), 3), most);
    const double high = 1.7 * list_rows + 0.2;
    const sl_box box = dialog_begin(&desk->dialog, 50, rest + lists * (high + 2.5), title);
    const double t = ui->text;
    double y = box.min.y;
    if (asks_map(s)) y = draw_maps(desk, s, box, y, high * t);
    if (asks_layers(s)) y = draw_layers(desk, s, box, y, high * t);
    draw_options(desk, s, box, y);
    dialog_problem(&desk->dialog, (sl_point){box.min.x, box.max.y - 2.5 * t}, box_width(box),
                   s->problem);
    const int from = s->more ? 1 : 0;
    dialog_buttons(&desk->dialog, box.max.x, box.max.y - 1.8 * t, buttons + from, 3 - from);
    dialog_end(&desk->dialog);
}

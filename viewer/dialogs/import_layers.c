/// The list of a file's layers. Those of a drawing have roles: what each is taken for. Others are
/// solid or not.
#include "dialogs/import_parts.h"

#include "sightline/draw.h"
#include "sightline/support.h"

#include <math.h>
#include <string.h>
#include <strings.h>

/// The names of roles are those of the option.
static const char *const role_names[ROLES] = {[ROLE_WALL] = "wall",
                                              [ROLE_DOOR] = "door",
                                              [ROLE_WINDOW] = "window",
                                              [ROLE_FURNITURE] = "furniture",
                                              [ROLE_IGNORE] = "ignore"};

bool import_asks_layers(const import_state *s) {
    return s->choice.layers.count > 0 && (s->more || s->beside || s->choice.layers_unsaid);
}

bool import_has_roles(const import_state *s) {
    return s->roles != NULL;
}

bool import_has_filter(const import_state *s) {
    return s->choice.layers.count > 8 || import_has_roles(s);
}

// --- from the option to the list

static layer_role role_named(const char *name, size_t length) {
    for (int i = 0; i < ROLES; i++)
        if (strlen(role_names[i]) == length && strncasecmp(name, role_names[i], length) == 0)
            return (layer_role)i;
    return ROLES;
}

/// The length of a word of the option without its role; *role is ROLES where it has none.
static size_t split_role(const char *word, size_t length, layer_role *role) {
    size_t at = length;
    while (at > 0 && word[at - 1] != '=') at--;
    *role = at ? role_named(word + at, length - at) : ROLES;
    return *role < ROLES ? at - 1 : length;
}

static bool list_has_roles(const char *list) {
    layer_role role = ROLES;
    for (const char *at = list; *at && role == ROLES;) {
        const size_t length = strcspn(at, ",");
        split_role(at, length, &role);
        at += length + (at[length] == ',');
    }
    return role < ROLES;
}

/// Layers that are named are taken, or have their roles. A drawing's others are ignored where the
/// list has no roles.
static void fill_layers(import_state *s) {
    const char *list = s->source.options.layers;
    if (!list) return;
    const bool roles = list_has_roles(list);
    for (size_t i = 0; i < s->choice.layers.count; i++) {
        const char *name = s->choice.layers.names[i];
        if (s->roles && !roles) s->roles[i] = ROLE_IGNORE;
        for (const char *at = list; *at;) {
            const size_t length = strcspn(at, ",");
            layer_role role;
            const size_t own = split_role(at, length, &role);
            const size_t named = s->roles ? own : length;
            if (strlen(name) == named && strncasecmp(at, name, named) == 0) {
                s->taken[i] = true;
                if (s->roles) s->roles[i] = role < ROLES ? role : ROLE_WALL;
            }
            at += length + (at[length] == ',');
        }
    }
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

sl_status import_layers_begin(sl_context *context, import_state *s, bool all) {
    if (all || s->beside) SL_TRY(list_drawn(context, s));
    const size_t count = s->choice.layers.count;
    s->taken = sl_alloc_array(context, count + 1, sizeof *s->taken);
    s->shown = sl_alloc_array(context, count + 1, sizeof *s->shown);
    if (!s->taken || !s->shown) return SL_NO_MEMORY;
    if (s->drawn.count) {
        s->roles = sl_alloc_array(context, count, sizeof *s->roles);
        s->guessed = sl_alloc_array(context, count, sizeof *s->guessed);
        if (!s->roles || !s->guessed) return SL_NO_MEMORY;
        for (size_t i = 0; i < count; i++) {
            const char *role = s->drawn.items[i].taken_for;
            s->roles[i] = s->guessed[i] = role_named(role, strlen(role));
        }
    }
    s->layers = (dialog_list){.acts = !s->roles, .marks = true};
    fill_layers(s);
    import_layers_filter(s);
    return SL_OK;
}

void import_layers_end(sl_context *context, import_state *s) {
    sl_drawing_layers_destroy(context, &s->drawn);
    sl_free(context, s->taken);
    sl_free(context, s->shown);
    sl_free(context, s->roles);
    sl_free(context, s->guessed);
    sl_free(context, s->list);
}

// --- from the list to the option

bool import_layers_join(sl_context *context, import_state *s) {
    size_t room = 1, length = 0;
    for (size_t i = 0; i < s->choice.layers.count; i++)
        room += strlen(s->choice.layers.names[i]) + 16;
    sl_free(context, s->list);
    s->list = NULL;
    char *text = sl_alloc_array(context, room, 1);
    if (!text) return import_complain(s, "Layers", "out of memory");
    for (size_t i = 0; i < s->choice.layers.count; i++) {
        const char *name = s->choice.layers.names[i];
        if (s->roles ? s->roles[i] == s->guessed[i] : !s->taken[i]) continue;
        if (strchr(name, ',')) {
            sl_free(context, text);
            return import_complain(s, name, "a layer with a comma in its name cannot be chosen");
        }
        length +=
            (size_t)snprintf(text + length, room - length, "%s%s%s%s", length ? "," : "", name,
                             s->roles ? "=" : "", s->roles ? role_names[s->roles[i]] : "");
    }
    if (length)
        s->list = text;
    else
        sl_free(context, text);
    return true;
}

// --- the filter, and clicks

/// Whether a name holds a part, in capitals or not.
static bool holds(const char *name, const char *part) {
    const size_t length = strlen(part);
    for (; *name && strncasecmp(name, part, length) != 0; name++)
        ;
    return *name || !length;
}

void import_layers_filter(import_state *s) {
    size_t count = 0;
    for (size_t i = 0; i < s->choice.layers.count; i++)
        if (holds(s->choice.layers.names[i], s->filter.text)) s->shown[count++] = i;
    s->layers.count = count;
    s->layers.at = s->layers.first = 0;
}

/// Gives the chosen layer a role, or all that are listed.
static bool give_role(import_state *s, layer_role role) {
    bool any = false;
    for (size_t i = 0; i < s->layers.count; i++) {
        if (!s->all_listed && i != s->layers.at) continue;
        any |= s->roles[s->shown[i]] != role;
        s->roles[s->shown[i]] = role;
    }
    return any;
}

bool import_layers_act(import_state *s, int id) {
    const size_t at = s->layers.at;
    if (id == ALL_LISTED) s->all_listed = !s->all_listed;
    if (id >= FIRST_ROLE) return give_role(s, (layer_role)(id - FIRST_ROLE));
    if (id != LAYERS_LIST || at >= s->layers.count) return false;
    if (s->roles) {
        const bool all = s->all_listed;
        s->all_listed = false;
        give_role(s, (layer_role)((s->roles[s->shown[at]] + 1) % ROLES));
        s->all_listed = all;
    } else {
        s->taken[s->shown[at]] ^= true;
    }
    return true;
}

// --- the picture

double import_layers_height(const import_state *s) {
    return 2.5 + (import_has_filter(s) ? 2.2 : 0) + (s->roles ? 2 * DIALOG_ROW : 0);
}

static sl_colour role_colour(const sl_palette *palette, layer_role role) {
    const sl_colour colours[ROLES] = {[ROLE_WALL] = palette->wall,
                                      [ROLE_DOOR] = palette->door,
                                      [ROLE_WINDOW] = palette->glass,
                                      [ROLE_FURNITURE] = palette->object,
                                      [ROLE_IGNORE] = palette->page};
    return colours[role];
}

/// A row: what the layer is taken for as a colour and a word, its name, and how much is on it. What
/// was not guessed is set in ink.
static void draw_role_row(ui_state *ui, const import_state *s, sl_box row, size_t layer) {
    const double t = ui->text, base = row.min.y + 1.2 * t;
    const layer_role role = s->roles[layer];
    const sl_box swatch = {{row.min.x + 0.4 * t, row.min.y + 0.3 * t},
                           {row.min.x + 1.5 * t, row.min.y + 1.4 * t}};
    char number[SL_COUNT_TEXT], count[SL_COUNT_TEXT + 8];
    sl_text_count(s->drawn.items[layer].entities, "", number);
    snprintf(count, sizeof count, "%s%s", number, s->drawn.items[layer].on ? "" : ", off");
    ui_fill(ui, swatch, role_colour(&ui->palette, role));
    ui_outline(ui, swatch, 0.08 * t, ui->palette.faint);
    const bool guessed = role == s->guessed[layer];
    ui_text_right(ui, row.max.x - 0.4 * t, base, 0.95,
                  guessed ? ui->palette.faint : ui->palette.ink, role_names[role]);
    ui_text_right(ui, row.max.x - 6 * t, base, 0.9, ui->palette.faint, count);
    ui_text_within(ui, row.min.x + 2 * t, base, box_width(row) - 12 * t, 1, ui->palette.ink,
                   s->choice.layers.names[layer]);
}

static double draw_roles(desk_state *desk, import_state *s, sl_box box, double y) {
    static const dialog_label buttons[] = {{FIRST_ROLE + ROLE_WALL, "Wall"},
                                           {FIRST_ROLE + ROLE_DOOR, "Door"},
                                           {FIRST_ROLE + ROLE_WINDOW, "Window"},
                                           {FIRST_ROLE + ROLE_FURNITURE, "Furniture"},
                                           {FIRST_ROLE + ROLE_IGNORE, "Ignore"}};
    const double t = desk->ui->text;
    const double wide = dialog_buttons_width(&desk->dialog, buttons, ROLES);
    dialog_buttons(&desk->dialog, box.min.x + wide, y, buttons, ROLES);
    y += DIALOG_ROW * t;
    dialog_check(&desk->dialog, ALL_LISTED, (sl_box){{box.min.x, y}, {box.max.x, y + 1.8 * t}},
                 "For all layers that are listed", s->all_listed);
    return y + DIALOG_ROW * t;
}

double import_layers_draw(desk_state *desk, import_state *s, sl_box box, double y, double high) {
    ui_state *ui = desk->ui;
    const double t = ui->text, filter = import_has_filter(s) ? 2.2 * t : 0;
    const char *lead = s->roles ? "What is each layer?"
                       : s->choice.layers_unsaid
                           ? "Which layers are solid? The file does not say. None: by their names, "
                             "if these tell"
                           : "Solid layers; none: those that the file marks";
    ui_text_within(ui, box.min.x, y + 1.2 * t, box_width(box), 1, ui->palette.ink, lead);
    y += 1.8 * t;
    if (filter > 0)
        dialog_field(&desk->dialog, FILTER, (sl_box){{box.min.x, y}, {box.max.x, y + 1.8 * t}},
                     &s->filter, "A part of a name leaves those layers in the list");
    const sl_box frame = {{box.min.x, y + filter}, {box.max.x, y + filter + high}};
    dialog_list_frame(&desk->dialog, LAYERS_LIST, frame, &s->layers);
    for (size_t i = s->layers.first; i < s->layers.count && i < s->layers.first + s->layers.page;
         i++) {
        const sl_box row = dialog_list_row(&desk->dialog, LAYERS_LIST, frame, &s->layers, i);
        const size_t layer = s->shown[i];
        if (s->roles) {
            draw_role_row(ui, s, row, layer);
            continue;
        }
        ui_check(ui, row, s->choice.layers.names[layer], NULL, s->taken[layer], -1);
        ui_hit(ui, HIT_DIALOG, LAYERS_LIST | ((int)i + 1) << 8, row);
    }
    y = frame.max.y + 0.7 * t;
    return s->roles ? draw_roles(desk, s, box, y) : y;
}

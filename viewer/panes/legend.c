/// The legend: what the plan shows now, each row with a sample that is drawn as in the plan. It
/// stands in the panel; over the plan where there is no panel.

#include "panes/panel.h"
#include "panes/panes.h"

#include "draw/marks.h" // private: samples are the marks of the plan
#include "plan/compare.h"
#include "plan/from_line.h"
#include "plan/heat.h"
#include "plan/line_map.h"
#include "plan/view_cells.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

enum { LEGEND_MOST = 32 };

// --- rows

static legend_row tone_row_of(tone which, bool fills) {
    return (legend_row){.label = tone_table()[which].label,
                        .mark = fills ? LEGEND_AREA : LEGEND_LINE,
                        .which = which};
}

static int add_culling(const view_state *view, legend_row *rows, bool fills) {
    size_t count;
    const sl_eye_method *methods = sl_eye_methods(&count);
    int at = 0;
    rows[at] = tone_row_of(TONE_KEPT, fills);
    snprintf(rows[at].value, sizeof rows[at].value, "%.20s", methods[view->method].name);
    ui_spaces(rows[at].value);
    at++;
    if (view->compare == COMPARE_DIFFERENCE)
        rows[at++] = tone_row_of(TONE_ADDED, fills);
    else if (fills && view->compare == COMPARE_OFF && view->method > 0)
        rows[at++] = tone_row_of(layers_method_tone(0, view->method), fills);
    if (view->document->map.mirror_count) rows[at++] = tone_row_of(TONE_KEPT_MIRRORED, fills);
    return at;
}

/// Layers whose rows follow from what they show.
static int add_layers(const view_state *view, legend_row *rows) {
    const unsigned fill = layers_fill(view);
    const bool mirrors = view->document->map.mirror_count > 0;
    int at = 0;
    if (!view->seen.valid) return 0;
    if (layers_shows(view, LAYER_CULL)) at += add_culling(view, rows + at, fill == LAYER_CULL);
    if (layers_shows(view, LAYER_PVS)) {
        rows[at++] = tone_row_of(TONE_SET, fill == LAYER_PVS);
        if (mirrors) rows[at++] = tone_row_of(TONE_SET_MIRRORED, fill == LAYER_PVS);
    }
    if (layers_shows(view, LAYER_REGION)) {
        rows[at++] = tone_row_of(TONE_REGION, fill == LAYER_REGION);
        if (mirrors) rows[at++] = tone_row_of(TONE_REGION_MIRRORED, fill == LAYER_REGION);
    }
    if (layers_shows(view, LAYER_NODES)) at += layer_nodes_legend(view, rows + at);
    if (layers_shows(view, LAYER_WATCH)) at += layer_watch_legend(view, rows + at);
    return at;
}

static legend_row stroke_row(const char *label, sl_colour colour, bool dashed) {
    return (legend_row){
        .label = label, .mark = dashed ? LEGEND_DASHED : LEGEND_STROKE, .colour = colour};
}

/// Whether cells are neither inside nor solid ground: they are hatched.
static bool has_outside(const view_state *view) {
    const sl_space *space = &view->document->baked->space;
    return space->inside_count + view->document->solid < space->cell_count;
}

/// What is seen from a line, with its area.
static int add_from_line(const view_state *view, legend_row *rows) {
    static const char *const labels[] = {"seen from some point", "seen from all points"};
    const from_line *layer = from_line_seen(view);
    if (view->mode != MODE_PLAN || view->tool != TOOL_FROM_LINE || !layer) return 0;
    for (int i = 0; i < 2; i++) {
        rows[i] = (legend_row){.label = labels[i],
                               .mark = LEGEND_PLAIN,
                               .colour = sl_coverage_colour(&view->ui->palette, i ? 3 : 1)};
        snprintf(rows[i].value, sizeof rows[i].value, "%.4g", layer->seen[i].area);
    }
    return 2;
}

/// Writes what is shown now, and how. Returns the number of rows.
static int list_rows(const view_state *view, legend_row rows[LEGEND_MOST]) {
    const sl_palette *palette = &view->ui->palette;
    const sl_map *map = &view->document->map;
    if (!view->document->baked) return 0;
    int at = add_layers(view, rows);
    at += add_from_line(view, rows + at);
    if (compare_shown(view)) {
        rows[at++] =
            stroke_row("wall of the other plan alone", compare_colour(view->ui, true), false);
        rows[at++] = stroke_row("wall of this plan alone", compare_colour(view->ui, false), true);
    }
    if (layers_shows(view, LAYER_VIEWS) && view_layer_shown(view->views))
        rows[at++] = stroke_row("border of a view cell", palette->wall, false);
    const heat_graph *graph;
    if (heat_layer_values(view, &graph) && layers_fill(view) != LAYER_HEAT)
        rows[at++] = stroke_row("between levels of the heat map", palette->wall, false);
    if (layers_shows(view, LAYER_SPLITS)) rows[at++] = stroke_row("split", palette->path, false);
    if (layers_shows(view, LAYER_TREE) && view->seen.valid)
        rows[at++] = stroke_row("stab tree", palette->tree, false);
    if (layers_shows(view, LAYER_PORTALS)) rows[at++] = stroke_row("portal", palette->portal, true);
    if (layers_shows(view, LAYER_STARTS) && map->path_count)
        rows[at++] = stroke_row("path", palette->path, true);
    const bool eye = view->mode != MODE_QUIZ && view->mode != MODE_CAMERAS &&
                     !(view->mode == MODE_PLAN && tool_paints(view->tool));
    if (map->range > 0 && eye) rows[at++] = stroke_row("view range", palette->start, true);
    const struct {
        const char *label;
        bool shown;
        enum legend_mark mark;
    } marks[] = {{"start", layers_shows(view, LAYER_STARTS) && map->start_count, LEGEND_START},
                 {"the eye", eye, LEGEND_EYE},
                 {"door", map->door_count > 0, LEGEND_DOOR},
                 {"mirror", map->mirror_count > 0, LEGEND_MIRROR},
                 {"one-way glass", map->oneway_count > 0, LEGEND_ONEWAY},
                 {"object", layers_shows(view, LAYER_STARTS) && map->object_count, LEGEND_OBJECT},
                 {"outside", has_outside(view), LEGEND_OUTSIDE}};
    for (size_t i = 0; i < sizeof marks / sizeof *marks; i++)
        if (marks[i].shown)
            rows[at++] = (legend_row){.label = marks[i].label, .mark = marks[i].mark};
    if (view->document->solid)
        rows[at++] =
            (legend_row){.label = "solid ground", .mark = LEGEND_PLAIN, .colour = palette->solid};
    return at;
}

// --- samples

static void draw_object(ui_state *ui, sl_box box, const sli_pens *pens) {
    const double in = 0.2 * box_height(box);
    cairo_rectangle(ui->cairo, box.min.x + in, box.min.y + in, box_width(box) - 2 * in,
                    box_height(box) - 2 * in);
    sli_pen_object(ui->cairo, &ui->palette, pens);
}

static void draw_outside(ui_state *ui, sl_box box) {
    ui_fill(ui, box, ui->palette.ground);
    sli_mark_hatch(ui->cairo, &ui->palette, box, 9 * ui_scale(ui), 0);
}

/// The mark of a thing, as the plan draws it.
static void draw_mark(ui_state *ui, sl_box box, enum legend_mark mark) {
    const double unit = ui_scale(ui), middle = (box.min.y + box.max.y) / 2;
    const sli_pens pens = {.wall = 2.5 * unit, .portal = 1.4 * unit, .mark = 10 * unit};
    const sl_point a = {box.min.x + 0.15 * box_width(box), middle};
    const sl_point b = {box.max.x - 0.15 * box_width(box), middle};
    const sl_frame frame = {.scale = 1,
                            .left = box.min.x,
                            .top = box.min.y,
                            .width = box_width(box),
                            .height = box_height(box),
                            .unit = unit};
    const sl_point centre = {box_width(box) / 2, box_height(box) / 2};
    if (mark == LEGEND_START)
        sli_mark_start(ui->cairo, &ui->palette, (sl_point){(a.x + b.x) / 2, middle}, 0,
                       0.45 * box_height(box));
    else if (mark == LEGEND_EYE)
        sl_draw_eye_mark(ui->cairo, &ui->palette, &frame, centre, 0, 0.3 * box_height(box));
    else if (mark == LEGEND_DOOR)
        sli_mark_door(ui->cairo, &ui->palette, &pens, a, b, false);
    else if (mark == LEGEND_MIRROR)
        sli_mark_mirror(ui->cairo, &ui->palette, &pens, a, b);
    else if (mark == LEGEND_OBJECT)
        draw_object(ui, box, &pens);
    else if (mark == LEGEND_OUTSIDE)
        draw_outside(ui, box);
    else
        sli_mark_oneway(ui->cairo, &ui->palette, &pens, a, b);
}

void legend_swatch(ui_state *ui, sl_box box, const legend_row *row) {
    cairo_t *cairo = ui->cairo;
    const double middle = (box.min.y + box.max.y) / 2, unit = ui_scale(ui);
    cairo_save(cairo);
    cairo_rectangle(cairo, box.min.x, box.min.y, box_width(box), box_height(box));
    cairo_clip(cairo);
    if (row->mark != LEGEND_PLAIN) ui_fill(ui, box, ui->palette.floor[0]);
    cairo_rectangle(cairo, box.min.x, box.min.y, box_width(box), box_height(box));
    if (row->mark == LEGEND_AREA)
        tone_fill(cairo, ui->dark, row->which, unit, box.min);
    else if (row->mark == LEGEND_PLAIN) {
        sl_set_colour(cairo, row->colour);
        cairo_fill(cairo);
    } else if (row->mark >= LEGEND_START) {
        cairo_new_path(cairo);
        draw_mark(ui, box, row->mark);
    } else {
        cairo_new_path(cairo);
        cairo_move_to(cairo, box.min.x, middle);
        cairo_line_to(cairo, box.max.x, middle);
        if (row->mark == LEGEND_LINE)
            tone_line(cairo, &ui->palette, row->which, 3 * unit);
        else
            tone_cased(cairo, &ui->palette, row->colour, 1.8 * unit,
                       row->mark == LEGEND_DASHED ? 2.5 : 0);
    }
    cairo_restore(cairo);
}

#define LABEL_LEFT 2.8 ///< plain texts

/// Whether the value has room beside the label.
static bool is_beside(ui_state *ui, double width, const legend_row *row, double *value) {
    *value = *row->value ? ui_text_width(ui, 0.95, false, row->value) + 0.6 * ui->text : 0;
    return width - LABEL_LEFT * ui->text - *value > 7 * ui->text;
}

static double legend_row_height(ui_state *ui, double width, const legend_row *row) {
    double value;
    const bool beside = is_beside(ui, width, row, &value);
    const double room = width - LABEL_LEFT * ui->text - (beside ? value : 0);
    return ui_lines_height(ui, room, 0.95, false, row->label) + 0.15 * ui->text +
           (beside ? 0 : ui_lines_height(ui, room, 0.95, false, row->value));
}

/// A row with its sample; returns the lower edge.
static double draw_row(ui_state *ui, double left, double right, double y, const legend_row *row) {
    double value;
    const bool beside = is_beside(ui, right - left, row, &value);
    const double t = ui->text, words = left + LABEL_LEFT * t;
    const double room = right - words - (beside ? value : 0);
    legend_swatch(ui, (sl_box){{left, y + 0.25 * t}, {left + 2.2 * t, y + 1.3 * t}}, row);
    double end = ui_lines(ui, words, y + 1.1 * t, room, 0.95, false, ui->palette.ink, row->label);
    if (value > 0 && beside)
        ui_text_right(ui, right, y + 1.1 * t, 0.95, ui->palette.faint, row->value);
    else if (value > 0)
        end = ui_lines(ui, words, end, room, 0.95, false, ui->palette.faint, row->value);
    return end - 0.95 * t;
}

// --- keys of layers that are coloured by values

enum { KEYS_MOST = 3 };

/// The keys of the layers that are shown.
static int list_keys(const view_state *view, legend_key keys[KEYS_MOST]) {
    int count = 0;
    if (!view->seen.valid) return 0;
    count += view_layer_key(view, &keys[count]);
    count += heat_layer_key(view, &keys[count]);
    count += line_map_key(view, &keys[count]);
    return count;
}

/// The ramp between its ends.
static void draw_ramp(ui_state *ui, const legend_key *key, double left, double right, double base) {
    const double t = ui->text;
    ui_text(ui, left, base, 0.95, false, ui->palette.ink, key->least);
    ui_text_right(ui, right, base, 0.95, ui->palette.ink, key->most);
    const double side = 0.4 * t + fmax(ui_text_width(ui, 0.95, false, key->least),
                                       ui_text_width(ui, 0.95, false, key->most));
    const double from = left + side, wide = (right - left - 2 * side) / RAMP_STEPS;
    for (int step = 0; step < RAMP_STEPS; step++)
        ui_fill(ui, (sl_box){{from + wide * step, base - 0.8 * t}, {right - side, base + 0.1 * t}},
                ramp_colour(ui, key->ramp, step));
}

/// Draws a key, or finds its lower edge alone. A narrow key has values below their labels.
static double put_key(ui_state *ui, const legend_key *key, double left, double right, double y,
                      bool draw) {
    const double t = ui->text, wide = right - left;
    for (int i = 0; i < key->count; i++) {
        const char *label = key->rows[i].label, *text = key->rows[i].text;
        const double value = *text ? ui_text_width(ui, 0.95, false, text) + 0.6 * t : 0;
        const bool beside = ui_text_width(ui, 0.95, false, label) + value <= wide;
        const double below = y + 1.1 * t + ui_lines_height(ui, wide, 0.95, i == 0, label);
        const double end = beside ? below : below + ui_lines_height(ui, wide, 0.95, false, text);
        if (draw) ui_lines(ui, left, y + 1.1 * t, wide, 0.95, i == 0, ui->palette.ink, label);
        if (draw && beside)
            ui_text_right(ui, right, y + 1.1 * t, 0.95, ui->palette.ink, text);
        else if (draw)
            ui_lines(ui, left, below, wide, 0.95, false, ui->palette.faint, text);
        y = end - 0.95 * t;
    }
    if (draw && key->ramp) draw_ramp(ui, key, left, right, y + 1.1 * t);
    return y + (key->ramp ? 1.6 : 0.2) * t;
}

/// Draws the keys of such layers in a column; returns the lower edge.
static double draw_key_column(view_state *view, double left, double right, double y) {
    legend_key keys[KEYS_MOST];
    const int count = list_keys(view, keys);
    for (int i = 0; i < count; i++)
        y = put_key(view->ui, &keys[i], left, right, y + 0.4 * view->ui->text, true);
    return y;
}

/// A page with a rim, over the plan.
static void fill_framed(ui_state *ui, sl_box box) {
    const sl_box rim = {{box.min.x - 1, box.min.y - 1}, {box.max.x + 1, box.max.y + 1}};
    ui_fill_round(ui, rim, 0.3 * ui->text, ui->palette.faint);
    ui_fill_round(ui, box, 0.3 * ui->text, ui->palette.page);
}

// --- over the plan

/// Whether a box of the page has something of the map below it.
static bool covers_map(const view_state *view, const sl_frame *frame, sl_box box) {
    const sl_box bounds = view->document->baked->space.bounds;
    const sl_point low = sl_frame_point(frame, bounds.min);
    const sl_point high = sl_frame_point(frame, bounds.max);
    return box.min.x < high.x && box.max.x > low.x && box.min.y < low.y && box.max.y > high.y;
}

/// A presentation has the map free: a legend that would cover it is a button, until that is
/// pressed.
static void fold_to_button(ui_state *ui, double left, double bottom) {
    ui->legend_folded = true;
    ui_button(ui, left, bottom - 1.6 * ui->text, 1.6 * ui->text, "Legend (F7)", false,
              ui_action_find(ui, "legend"));
}

/// A legend that is higher than three quarters of the plan is left to the panel. Returns its box;
/// one without a size where it is not drawn.
static sl_box draw_over_plan(view_state *view, const sl_frame *frame, bool vector) {
    ui_state *ui = view->ui;
    legend_row rows[LEGEND_MOST];
    const int count = list_rows(view, rows);
    const double t = ui->text, gap = 0.6 * t;
    const double wide = fmin(20 * t, frame->width - 2 * gap);
    double high = gap;
    for (int i = 0; i < count; i++) high += legend_row_height(ui, wide - 2 * gap, &rows[i]);
    const double lowest = frame->top + frame->height;
    const sl_box none = {{frame->left, lowest}, {frame->left, lowest}};
    if (!count || high > 0.75 * frame->height || wide < 8 * t) return none;
    const double left = frame->left + gap, bottom = frame->top + frame->height - gap;
    double y = bottom - high;
    if (ui->presents && !ui->legend_over &&
        covers_map(view, frame, (sl_box){{left, y}, {left + wide, bottom}})) {
        if (!vector) fold_to_button(view->ui, left, bottom);
        return none;
    }
    fill_framed(ui, (sl_box){{left, y}, {left + wide, bottom}});
    y += 0.1 * t;
    for (int i = 0; i < count; i++) y = draw_row(ui, left + gap, left + wide - gap, y, &rows[i]);
    return (sl_box){{left, bottom - high}, {left + wide, bottom}};
}

/// The keys at the lower right, one over the other, as far as they have room: beside the legend, or
/// over it.
static void draw_keys_over_plan(view_state *view, const sl_frame *frame, const sl_box *legend) {
    ui_state *ui = view->ui;
    legend_key keys[KEYS_MOST];
    const int count = list_keys(view, keys);
    const double t = ui->text, wide = 19 * t, right = frame->left + frame->width - t;
    const bool beside = right - wide > legend->max.x + 0.5 * t;
    double bottom = beside ? frame->top + frame->height - t : legend->min.y - 0.5 * t;
    for (int i = 0; i < count && wide <= frame->width - 2 * t; i++) {
        const double high =
            put_key(ui, &keys[i], right - wide + 0.6 * t, right - 0.6 * t, 0, false) + 0.4 * t;
        const sl_box box = {{right - wide, bottom - high}, {right, bottom}};
        if (box.min.y < frame->top + 0.25 * frame->height) return;
        fill_framed(ui, box);
        put_key(ui, &keys[i], box.min.x + 0.6 * t, box.max.x - 0.6 * t, box.min.y + 0.2 * t, true);
        bottom = box.min.y - 0.5 * t;
    }
}

void legend_over_plan(view_state *view, const sl_frame *frame, bool vector) {
    view->ui->legend_folded = false;
    if (ui_has_panel(view->ui)) return;
    const double lowest = frame->top + frame->height;
    sl_box legend = {{frame->left, lowest}, {frame->left, lowest}};
    if (view->mode != MODE_QUIZ && view->ui->legend) legend = draw_over_plan(view, frame, vector);
    draw_keys_over_plan(view, frame, &legend);
}

// --- in a panel

void column_legend(view_state *view, column *c) {
    legend_row rows[LEGEND_MOST];
    char text[96];
    const int count = list_rows(view, rows);
    if (!count) return;
    column_heading(view->ui, c, "Legend", NULL);
    for (int i = 0; i < count; i++) c->y = draw_row(view->ui, c->left, c->right, c->y, &rows[i]);
    c->y = draw_key_column(view, c->left, c->right, c->y);
    if (layer_nodes_words(view, text))
        column_words(view->ui, c, 0.9, view->ui->palette.faint, text);
}

void column_layers(view_state *view, column *c) {
    column_heading(view->ui, c, "Layers", "key");
    for (unsigned i = 0; i < LAYER_COUNT; i++)
        if (layers_lists(view, i)) column_check(view->ui, c, layer_table()[i].name);
}

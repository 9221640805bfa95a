/// Areas that scroll, what a pointer or key finds in them, and tooltips.
///
/// Widgets are drawn anew in each frame and register their boxes in order. The pointer finds the
/// topmost box. Keys walk through the boxes in that order; the focused one is known by its kind,
/// its value and the number of its like before it, so that it is found again in the next frame.
/// What scrolled out of sight is registered too: keys reach it, and its area scrolls to it.
#include "ui/ui.h"

#include <math.h>
#include <string.h>

#define TIP_DELAY 0.6 ///< seconds

static sl_box meet(sl_box a, sl_box b) {
    return (sl_box){{fmax(a.min.x, b.min.x), fmax(a.min.y, b.min.y)},
                    {fmin(a.max.x, b.max.x), fmin(a.max.y, b.max.y)}};
}

static sl_box whole_page(const ui_state *ui) {
    return (sl_box){{0, 0}, {ui->width, ui->height}};
}

void ui_begin(ui_state *ui) {
    ui->hit_count = ui->copies = ui->spot_count = 0;
    ui->area = ui->clip = whole_page(ui);
    ui->scrolling = -1;
}

bool box_has(sl_box box, sl_point at) {
    return at.x >= box.min.x && at.x < box.max.x && at.y >= box.min.y && at.y < box.max.y;
}

// --- what a pointer finds

void ui_hit(ui_state *ui, hit_kind kind, int value, sl_box box) {
    if (ui->hit_count == HITS_MOST) return;
    ui->hits[ui->hit_count++] = (hit_area){kind, value, box, ui->clip};
    if (kind != ui->focus.kind || value != ui->focus.value || ui->copies++ != ui->focus.copy)
        return;
    if (!ui->reveal || ui->scrolling < 0) return;
    ui_scroll *scroll = &ui->scrolls[ui->scrolling];
    if (box.min.y < ui->clip.min.y) scroll->at -= ui->clip.min.y - box.min.y;
    if (box.max.y > ui->clip.max.y) scroll->at += box.max.y - ui->clip.max.y;
    ui->reveal = false;
}

hit_area ui_find(const ui_state *ui, sl_point at) {
    for (int i = ui->hit_count; i-- > 0;) {
        const hit_area *hit = &ui->hits[i];
        if (hit->kind != HIT_SCROLL && box_has(hit->box, at) && box_has(hit->clip, at)) return *hit;
    }
    return (hit_area){0};
}

int ui_scroll_at(const ui_state *ui, sl_point at) {
    for (int i = ui->hit_count; i-- > 0;) {
        const hit_area *hit = &ui->hits[i];
        if (!box_has(hit->box, at)) continue;
        if (hit->kind == HIT_SCROLL) return hit->value;
        if (hit->kind == HIT_PANEL && hit->value == PANEL_SHEET) return -1;
    }
    return -1;
}

// --- areas

void ui_begin_area(ui_state *ui, sl_box box) {
    cairo_save(ui->cairo);
    cairo_rectangle(ui->cairo, box.min.x, box.min.y, box_width(box), box_height(box));
    cairo_clip(ui->cairo);
    ui->area = box;
    ui->clip = meet(box, whole_page(ui));
    ui_fill(ui, box, ui->palette.page);
    ui_hit(ui, HIT_PANEL, PANEL_PLAIN, box);
}

void ui_end_area(ui_state *ui) {
    cairo_restore(ui->cairo);
    ui->area = ui->clip = whole_page(ui);
}

double ui_bar_width(const ui_state *ui) {
    return fmax(0.7 * ui->text, 8);
}

void ui_scroll_by(ui_scroll *scroll, double by) {
    scroll->at = fmin(fmax(scroll->at + by, 0), fmax(scroll->length - scroll->room, 0));
}

double ui_begin_scroll(ui_state *ui, int number, sl_box box) {
    ui_scroll *scroll = &ui->scrolls[number];
    scroll->room = box_height(box);
    ui_scroll_by(scroll, 0);
    cairo_save(ui->cairo);
    cairo_rectangle(ui->cairo, box.min.x, box.min.y, box_width(box), box_height(box));
    cairo_clip(ui->cairo);
    ui->clip = meet(box, whole_page(ui));
    ui->scrolling = number;
    ui_hit(ui, HIT_SCROLL, number, box);
    return box.min.y - round(scroll->at);
}

void ui_end_scroll(ui_state *ui, sl_box box, double bottom) {
    const int number = ui->scrolling;
    ui_scroll *scroll = &ui->scrolls[number];
    scroll->length = bottom - (box.min.y - round(scroll->at));
    cairo_restore(ui->cairo);
    ui->scrolling = -1;
    if (scroll->length > scroll->room + 1) {
        const double wide = ui_bar_width(ui), left = box.max.x - wide;
        const double high = box_height(box), share = scroll->room / scroll->length;
        const double size = fmin(fmax(high * share, 2.5 * wide), high);
        const double top = box.min.y + (high - size) * scroll->at / (scroll->length - scroll->room);
        const sl_box thumb = {{left + 0.25 * wide, top}, {left + 0.8 * wide, top + size}};
        ui_fill_round(ui, thumb, 0.25 * wide, ui->palette.faint);
        ui_hit(ui, HIT_BAR, number, (sl_box){{left, box.min.y}, box.max});
    }
    ui->clip = meet(ui->area, whole_page(ui));
}

sl_box ui_begin_sheet(ui_state *ui, double width, double height, const char *title, double *top) {
    const double t = ui->text;
    ui->area = ui->clip = whole_page(ui);
    ui_hit(ui, HIT_PANEL, PANEL_SHEET, ui->area);
    const sl_colour dim = ui->palette.dark ? ui->palette.page : ui->palette.ink;
    cairo_set_source_rgba(ui->cairo, dim.red, dim.green, dim.blue, 0.45);
    cairo_paint(ui->cairo);
    const double rim = fmin(t, 0.03 * ui->width);
    const double w = fmin(width, ui->width - 2 * rim), h = fmin(height, ui->height - 2 * rim);
    const sl_box sheet = {{floor((ui->width - w) / 2), floor((ui->height - h) / 2)},
                          {floor((ui->width + w) / 2), floor((ui->height + h) / 2)}};
    ui_fill_round(ui,
                  (sl_box){{sheet.min.x - 1, sheet.min.y - 1}, {sheet.max.x + 1, sheet.max.y + 1}},
                  0.6 * t, ui->palette.faint);
    ui_fill_round(ui, sheet, 0.6 * t, ui->palette.page);
    cairo_save(ui->cairo);
    cairo_rectangle(ui->cairo, sheet.min.x, sheet.min.y, w, h);
    cairo_clip(ui->cairo);
    ui->area = ui->clip = sheet;
    // Texts under the sheet are not read with those on it.
    *top = ui_lines(ui, sheet.min.x + 1.2 * t, sheet.min.y + 2 * t, w - 2.4 * t, 1.3, true,
                    ui->palette.ink, title) -
           0.9 * t;
    return sheet;
}

// --- focus

static bool takes_focus(const hit_area *hit) {
    return hit->kind != HIT_PANEL && hit->kind != HIT_SCROLL && hit->kind != HIT_BAR;
}

/// The first widget that keys reach: those under a sheet are out of reach.
static int first_reached(const ui_state *ui) {
    int first = 0;
    for (int i = 0; i < ui->hit_count; i++)
        if (ui->hits[i].kind == HIT_PANEL && ui->hits[i].value == PANEL_SHEET) first = i + 1;
    return first;
}

/// Its place among the hits of the last frame; -1: none.
static int place_of_focus(const ui_state *ui) {
    int copy = 0;
    if (ui->focus.kind == HIT_NONE) return -1;
    for (int i = 0; i < ui->hit_count; i++)
        if (ui->hits[i].kind == ui->focus.kind && ui->hits[i].value == ui->focus.value &&
            copy++ == ui->focus.copy)
            return i;
    return -1;
}

hit_area ui_focused(const ui_state *ui) {
    const int at = place_of_focus(ui);
    return at < first_reached(ui) ? (hit_area){0} : ui->hits[at];
}

static void focus_at(ui_state *ui, int place) {
    const hit_area *hit = &ui->hits[place];
    ui->focus = (ui_focus){hit->kind, hit->value, 0};
    for (int i = 0; i < place; i++)
        ui->focus.copy += ui->hits[i].kind == hit->kind && ui->hits[i].value == hit->value;
    ui->reveal = true;
    ui->hover_is_focus = true;
    ui->hovered = *hit;
    ui->hover_seconds = 0;
}

void ui_focus_move(ui_state *ui, bool back) {
    const int first = first_reached(ui), count = ui->hit_count - first;
    const int at = place_of_focus(ui);
    int from = at >= first ? at - first : back ? 0 : count - 1;
    for (int i = 0; i < count; i++) {
        from = (from + (back ? count - 1 : 1)) % count;
        if (!takes_focus(&ui->hits[first + from])) continue;
        focus_at(ui, first + from);
        return;
    }
}

// --- tooltips

static bool is_same(const hit_area *a, const hit_area *b) {
    return a->kind == b->kind && a->value == b->value &&
           memcmp(&a->box, &b->box, sizeof a->box) == 0;
}

void ui_tick(ui_state *ui, double seconds) {
    const hit_area over = ui_find(ui, ui->pointer);
    if (!ui->hover_is_focus && !is_same(&over, &ui->hovered)) {
        ui->hovered = over;
        ui->hover_seconds = 0;
    }
    ui->hover_seconds += seconds;
    ui->message_seconds += seconds;
}

hit_area ui_tip_of(const ui_state *ui) {
    const hit_area focused = ui_focused(ui);
    if (ui->hover_seconds < TIP_DELAY) return (hit_area){0};
    if (ui->hover_is_focus) return focused;
    return ui->hovered;
}

void ui_tip(ui_state *ui, sl_box beside, const char *text) {
    const double t = ui->text, most = fmin(26 * t, ui->width - 3 * t);
    const double wide = fmin(ui_text_width(ui, 0.95, false, text) + 0.1 * t, most);
    const double high = ui_lines_height(ui, wide, 0.95, false, text) + 0.5 * t;
    const double left = fmin(fmax(beside.min.x, 0.4 * t), ui->width - wide - 1.6 * t);
    const double under = beside.max.y + 0.3 * t, over = beside.min.y - high - 0.3 * t;
    // Beside a large box there is no room: then it stands in it.
    const double top = under + high <= ui->height ? under : over >= 0 ? over : beside.min.y + t;
    const sl_box box = {{left, top}, {left + wide + 1.2 * t, top + high}};
    ui->area = ui->clip = whole_page(ui);
    const double rim = 1;
    ui_fill_round(ui,
                  (sl_box){{box.min.x - rim, box.min.y - rim}, {box.max.x + rim, box.max.y + rim}},
                  0.35 * t, ui->palette.page);
    ui_fill_round(ui, box, 0.3 * t, ui->palette.ink);
    ui_lines(ui, left + 0.6 * t, top + 1.15 * t, wide, 0.95, false, ui->palette.page, text);
}

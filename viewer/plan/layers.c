/// Which layers are shown, and the shapes that they are drawn with.
#include "plan/layers.h"

#include "sightline/draw.h"
#include "sightline/support.h"

#include <math.h>
#include <stdio.h>

#define ROW(NAME, name, key, label, help, modes, calls) {name, modes, calls},
static const layer_row rows[] = {LAYERS(ROW)};
#undef ROW

const layer_row *layer_table(void) {
    return rows;
}

bool layers_lists(const view_state *view, unsigned layer) {
    const unsigned calls = rows[layer].calls;
    const sl_baked *baked = view->document->baked;
    if (layer == LAYER_SPLITS && baked && !baked->space.node_count) return false;
    if (view->mode == MODE_PLAN && tool_paints(view->tool) && SHOW_FILLS >> layer & 1) return false;
    return rows[layer].modes >> view->mode & 1 &&
           (!calls || calls & sl_plan_make(&view->document->map).effects);
}

bool layers_shows(const view_state *view, unsigned layer) {
    return view->show >> layer & 1 && layers_lists(view, layer);
}

unsigned layers_fill(const view_state *view) {
    unsigned last = LAYER_COUNT;
    for (unsigned i = 0; i < LAYER_COUNT; i++)
        if (SHOW_FILLS >> i & 1 && layers_shows(view, i) &&
            (last == LAYER_COUNT || view->filled[i] >= view->filled[last]))
            last = i;
    return last;
}

void layers_set_fill(view_state *view, unsigned layer) {
    if (layer < LAYER_COUNT) view->filled[layer] = ++view->last_filled;
}

void layers_toggle(view_state *view, unsigned layer) {
    view->show ^= 1u << layer;
    if (view->show & SHOW_FILLS & 1u << layer) layers_set_fill(view, layer);
}

void layers_clip_inside(const document_state *document, cairo_t *cairo, const sl_frame *frame) {
    const sl_space *space = &document->baked->space;
    for (uint32_t i = 0; i < space->cell_count; i++) {
        const sl_cell *c = &space->cells[i];
        if (c->inside)
            sl_path_polygon(cairo, frame, space->vertices + c->first_vertex, c->vertex_count);
    }
    cairo_clip(cairo);
}

// --- sets of cells

static bool in_set(const uint64_t *cells, const uint64_t *without, uint32_t cell) {
    return cells[cell / 64] >> (cell % 64) & 1 &&
           !(without && without[cell / 64] >> (cell % 64) & 1);
}

/// Where on the side from a to b a point lies, from 0 to 1; NAN: beside it.
static double place_on(sl_point a, sl_point b, sl_point p) {
    const double x = b.x - a.x, y = b.y - a.y, length = x * x + y * y;
    const double off = x * (p.y - a.y) - y * (p.x - a.x);
    return fabs(off) <= 1e-9 * length ? ((p.x - a.x) * x + (p.y - a.y) * y) / length : NAN;
}

/// Adds a side of a cell but for its portals to other cells of the set.
static void add_side(view_state *view, const sl_frame *frame, const uint64_t *cells,
                     const uint64_t *without, const sl_cell *c, sl_point a, sl_point b) {
    const sl_space *space = &view->document->baked->space;
    double at = 0;
    while (at < 1) {
        // The next portal from here on.
        double from = 1, to = 1;
        for (uint32_t i = 0; i < c->directed_count; i++) {
            const sl_directed_portal *d = &space->directed[c->first_directed + i];
            const double u = place_on(a, b, d->left), v = place_on(a, b, d->right);
            if (!in_set(cells, without, d->cell) || isnan(u) || isnan(v)) continue;
            if (fmax(u, v) > at + 1e-9 && fmin(u, v) < from) {
                from = fmin(u, v);
                to = fmax(u, v);
            }
        }
        if (from > at + 1e-9) {
            const double end = fmin(from, 1);
            sl_path_segment(view->ui->cairo, frame,
                            (sl_point){a.x + (b.x - a.x) * at, a.y + (b.y - a.y) * at},
                            (sl_point){a.x + (b.x - a.x) * end, a.y + (b.y - a.y) * end});
        }
        at = fmax(to, at + 1e-9);
    }
}

/// Adds the border of the set: sides of its cells that no other cell of it is behind.
static void add_border(view_state *view, const sl_frame *frame, const uint64_t *cells,
                       const uint64_t *without) {
    const sl_space *space = &view->document->baked->space;
    for (uint32_t cell = 0; cell < space->cell_count; cell++) {
        const sl_cell *c = &space->cells[cell];
        if (!in_set(cells, without, cell)) continue;
        for (uint32_t i = 0; i < c->vertex_count; i++)
            add_side(view, frame, cells, without, c, space->vertices[c->first_vertex + i],
                     space->vertices[c->first_vertex + (i + 1) % c->vertex_count]);
    }
}

void layers_draw_portals(const view_state *view, cairo_t *cairo, const sl_frame *frame,
                         const uint64_t *cells, const uint64_t *without) {
    const sl_space *space = &view->document->baked->space;
    const sl_palette *palette = &view->ui->palette;
    cairo_new_path(cairo);
    for (uint32_t cell = 0; cell < space->cell_count; cell++) {
        const sl_cell *c = &space->cells[cell];
        if (cells ? !in_set(cells, without, cell) : !c->inside) continue;
        for (uint32_t i = 0; i < c->directed_count; i++) {
            const sl_directed_portal *d = &space->directed[c->first_directed + i];
            const bool twice = d->cell < cell && (!cells || in_set(cells, without, d->cell));
            if (!twice) sl_path_segment(cairo, frame, d->left, d->right);
        }
    }
    cairo_save(cairo);
    cairo_set_antialias(cairo, CAIRO_ANTIALIAS_FAST);
    tone_cased(cairo, palette, palette->portal, 1.4 * frame->unit, 3);
    cairo_restore(cairo);
}

/// Patterns are fixed to the map.
static sl_point origin_of(const sl_frame *frame) {
    return sl_frame_point(frame, (sl_point){0, 0});
}

void layers_draw_set(view_state *view, const sl_frame *frame, const uint64_t *cells,
                     const uint64_t *without, tone which, bool fills) {
    const sl_space *space = &view->document->baked->space;
    cairo_t *cairo = view->ui->cairo;
    cairo_new_path(cairo);
    if (!fills) {
        cairo_save(cairo);
        cairo_set_antialias(cairo, CAIRO_ANTIALIAS_FAST);
        add_border(view, frame, cells, without);
        // Wider than walls: it shows on both sides of them.
        tone_line(cairo, &view->ui->palette, which, 6 * frame->unit);
        cairo_restore(cairo);
        return;
    }
    for (uint32_t cell = 0; cell < space->cell_count; cell++) {
        const sl_cell *c = &space->cells[cell];
        if (in_set(cells, without, cell))
            sl_path_polygon(cairo, frame, space->vertices + c->first_vertex, c->vertex_count);
    }
    tone_fill(cairo, view->ui->dark, which, frame->unit, origin_of(frame));
    const bool solid = tone_table()[which].pattern == PATTERN_SOLID;
    if (solid && layers_shows(view, LAYER_PORTALS))
        layers_draw_portals(view, cairo, frame, cells, without);
}

void layers_draw_cell(view_state *view, const sl_frame *frame, uint32_t cell, tone which) {
    const sl_space *space = &view->document->baked->space;
    const sl_cell *c = &space->cells[cell];
    cairo_new_path(view->ui->cairo);
    sl_path_polygon(view->ui->cairo, frame, space->vertices + c->first_vertex, c->vertex_count);
    tone_fill(view->ui->cairo, view->ui->dark, which, frame->unit, origin_of(frame));
    sl_draw_cell(view->ui->cairo, space, frame, cell, tone_colour(view->ui->dark, which), 0,
                 2 * frame->unit);
}

// --- regions

/// Arcs are as fine as the eye can tell.
void layers_draw_region(view_state *view, const sl_frame *frame, const sl_region *region,
                        tone which, bool fills) {
    cairo_t *cairo = view->ui->cairo;
    const double tolerance = fmax(0.2 / frame->scale, 1e-5 * region->range);
    const size_t count = sl_region_flatten(region, tolerance, NULL, 0);
    sl_point *points = sl_alloc_array(view->context, count, sizeof *points);
    if (!points) return;
    sl_region_flatten(region, tolerance, points, count);
    cairo_new_path(cairo);
    if (count >= 3) {
        sl_path_polygon(cairo, frame, points, count);
        if (fills)
            tone_fill(cairo, view->ui->dark, which, frame->unit, origin_of(frame));
        else
            tone_line(cairo, &view->ui->palette, which, 2.2 * frame->unit);
    }
    sl_free(view->context, points);
}

// --- tones of methods, and of values

tone layers_method_tone(size_t method, size_t chosen) {
    return method == chosen ? TONE_KEPT : (tone)(TONE_LOOSER + method % 4);
}

int ramp_step(double value, double least, double most) {
    const double share = most > least ? (value - least) / (most - least) : 0;
    return (int)fmin(fmax(share, 0) * RAMP_STEPS, RAMP_STEPS - 1);
}

sl_colour ramp_colour(const ui_state *ui, ramp_kind kind, int step) {
    const double place = (step + 0.5) / RAMP_STEPS;
    if (kind == RAMP_CHANGES) return sl_palette_changes(ui->dark, place);
    return sl_palette_ramp(ui->dark, kind == RAMP_LINES ? 0.2 + 0.8 * place : place);
}

void legend_key_add(legend_key *key, const char *label, const char *text) {
    snprintf(key->rows[key->count].label, sizeof key->rows->label, "%s", label);
    snprintf(key->rows[key->count++].text, sizeof key->rows->text, "%s", text);
}

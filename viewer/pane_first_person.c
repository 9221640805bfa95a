/// What the eye sees, in first person: in each column of pixels the nearest wall of the cells that
/// the chosen method keeps.
#include "modes.h"

#include "sightline/canvas.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>

#define RADIANS (3.14159265358979323846 / 180)

enum { COLUMNS_MOST = 4096 };

typedef struct column {
    float nearness; ///< 1 / depth; 0 for nothing
    uint32_t wall;
    float light;
} column;

typedef struct viewer {
    sl_point eye;
    double c, s;  ///< of the heading
    double focal; ///< columns for a slope of 1
    int columns;
    column *seen;
    uint32_t pieces; ///< walls handed on
} viewer;

/// Depth and slope (to the right) of a point.
static sl_point turn(const viewer *v, sl_point p) {
    const double x = p.x - v->eye.x, y = p.y - v->eye.y;
    return (sl_point){x * v->c + y * v->s, x * v->s - y * v->c};
}

static void cut_near(sl_point *a, sl_point b, double near) {
    if (a->x >= near) return;
    const double share = (near - a->x) / (b.x - a->x);
    *a = (sl_point){near, a->y + (b.y - a->y) * share};
}

static void add_wall(viewer *v, sl_point from, sl_point to, uint32_t wall, double near) {
    sl_point a = turn(v, from), b = turn(v, to);
    v->pieces++;
    if (a.x < near && b.x < near) return;
    cut_near(&a, b, near);
    cut_near(&b, a, near);
    const double half = v->columns / 2.0;
    const double xa = half + v->focal * a.y / a.x, xb = half + v->focal * b.y / b.x;
    const int first = (int)fmin(fmax(ceil(fmin(xa, xb) - 0.5), 0), v->columns);
    const int last = (int)fmin(fmax(floor(fmax(xa, xb) - 0.5), -1), v->columns - 1);
    const double length = hypot(to.x - from.x, to.y - from.y);
    const float light = (float)(length > 0 ? fabs(to.y - from.y) / length : 0);
    for (int x = first; x <= last; x++) {
        // 1 / depth is linear across the page.
        const double share = xb != xa ? (x + 0.5 - xa) / (xb - xa) : 0;
        const float nearness = (float)(1 / a.x + (1 / b.x - 1 / a.x) * share);
        if (nearness > v->seen[x].nearness) v->seen[x] = (column){nearness, wall, light};
    }
}

static void add_room(viewer *v, const sl_outline *outline, uint32_t room, double near) {
    const uint32_t first = outline->first[room], end = outline->first[room + 1];
    for (uint32_t i = first; i < end; i++) {
        if (sl_side_is_portal(&outline->sides[i])) continue;
        const uint32_t next = i + 1 < end ? i + 1 : first;
        add_wall(v, outline->sides[i].start, outline->sides[next].start,
                 outline->sides[i].neighbour, near);
    }
}

/// Adds the walls of rooms with a part in a visible cell, each room once.
static void add_cells(const view_state *view, viewer *v, double near) {
    const sl_outline *outline = view->present.outline;
    const seen_method *method = &view->seen.methods[view->method];
    bool *added = calloc(outline->room_count, sizeof *added);
    if (!added) return;
    for (uint32_t cell = 0; cell < outline->space->cell_count; cell++) {
        if (!sl_eye_sees(method->cells, view->present.parents ? view->present.parents[cell] : cell))
            continue;
        for (uint32_t i = outline->first_part[cell]; i < outline->first_part[cell + 1]; i++) {
            const uint32_t room = outline->parts[i];
            if (added[room]) continue;
            added[room] = true;
            add_room(v, outline, room, near);
        }
    }
    free(added);
}

/// Columns of one wall make one shape: its upper and lower edges are straight.
static void draw_columns(ui_state *ui, const viewer *v, sl_box box, double high, double wide) {
    cairo_t *cairo = ui->cairo;
    const sl_palette *palette = &ui->palette;
    const double middle = (box.min.y + box.max.y) / 2;
    for (int first = 0, end; first < v->columns; first = end) {
        for (end = first + 1; end < v->columns && v->seen[end].wall == v->seen[first].wall &&
                              v->seen[end].light == v->seen[first].light &&
                              (v->seen[end].nearness > 0) == (v->seen[first].nearness > 0);)
            end++;
        if (!(v->seen[first].nearness > 0)) continue;
        const double a = high * v->seen[first].nearness, b = high * v->seen[end - 1].nearness;
        const double x0 = box.min.x + first * wide, x1 = box.min.x + end * wide;
        cairo_move_to(cairo, x0, middle - a);
        cairo_line_to(cairo, x1, middle - b);
        cairo_line_to(cairo, x1, middle + b);
        cairo_line_to(cairo, x0, middle + a);
        cairo_close_path(cairo);
        const double far = fmin(fmax(1 - 5 * (a + b) / 2 / box_height(box), 0), 1);
        const sl_colour lit =
            sl_colour_mix(palette->floor[2], palette->glass, 0.16 + 0.3 * v->seen[first].light);
        sl_set_colour(cairo, sl_colour_mix(lit, palette->ground, 0.75 * far));
        cairo_fill_preserve(cairo);
        cairo_set_source_rgba(cairo, palette->wall.red, palette->wall.green, palette->wall.blue,
                              0.35);
        cairo_set_line_width(cairo, 0.8);
        cairo_stroke(cairo);
    }
}

static void draw_count(app_state *app, const viewer *v, sl_box box) {
    char text[160];
    const uint32_t all = app->view.present.outline->side_count;
    uint32_t walls = 0;
    for (uint32_t i = 0; i < all; i++)
        walls += !sl_side_is_portal(&app->view.present.outline->sides[i]);
    size_t count;
    snprintf(text, sizeof text, "%u of %u wall pieces drawn, %.1f %% culled by %s", v->pieces,
             walls, walls ? 100.0 * (walls - v->pieces) / walls : 0,
             sl_eye_methods(&count)[app->view.method].name);
    if (app_is_solid(app, app->view.eye.at))
        snprintf(text, sizeof text, "The eye is in solid ground and sees nothing.");
    const double t = app->ui.text;
    const double width = fmin(ui_text_width(&app->ui, 0.95, false, text), box_width(box) - 2.6 * t);
    const sl_box ground = {{box.min.x + 0.7 * t, box.max.y - 2.3 * t},
                           {box.min.x + 1.9 * t + width, box.max.y - 0.6 * t}};
    ui_fill_round(&app->ui, ground, 0.3 * t, app->ui.palette.page);
    sl_text_show_within(app->ui.cairo, app->ui.palette.ink, ground.min.x + 0.6 * t,
                        ground.max.y - 0.5 * t, width, 0.95 * t, false, text);
}

void pane_first_person(app_state *app, sl_box box) {
    ui_state *ui = &app->ui;
    const sl_palette *palette = &ui->palette;
    const double middle = (box.min.y + box.max.y) / 2;
    ui_hit(ui, HIT_PANEL, 0, box);
    cairo_save(ui->cairo);
    cairo_rectangle(ui->cairo, box.min.x, box.min.y, box_width(box), box_height(box));
    cairo_clip(ui->cairo);
    ui_fill(ui, box, sl_colour_mix(palette->page, palette->glass, 0.10));
    ui_fill(ui, (sl_box){{box.min.x, middle}, box.max},
            sl_colour_mix(palette->page, palette->object, 0.22));
    static const double widest = 110;
    const double fov = fmin(app->view.eye.fov, widest) * RADIANS;
    viewer v = {.eye = app->view.eye.at,
                .c = cos(app->view.eye.heading * RADIANS),
                .s = sin(app->view.eye.heading * RADIANS),
                .columns = (int)fmin(box_width(box), COLUMNS_MOST)};
    v.focal = v.columns / 2.0 / tan(fov / 2);
    column seen[COLUMNS_MOST] = {0};
    v.seen = seen;
    if (app->document.baked && app->view.seen.valid &&
        app->view.seen.methods[app->view.method].known) {
        const double size = sqrt(app->document.area / fmax(app->document.counted, 1));
        add_cells(&app->view, &v, 1e-3 * size);
        draw_columns(&app->ui, &v, box, 0.22 * size * v.focal, box_width(box) / v.columns);
        draw_count(app, &v, box);
    }
    ui_line(ui, box.min.x, box.min.y + 0.5, box.max.x, box.min.y + 0.5, palette->outline);
    cairo_restore(ui->cairo);
}

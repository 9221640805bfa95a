/// What the eye sees, in first person: in each column of pixels the nearest wall of the cells that
/// the chosen method keeps.
///
/// A mirror shows the parts of the visible region that the library finds in it: their walls where
/// they seem to be, straight behind the mirror (Foley et al. call that the image). They are drawn
/// first, and the mirror over them. So there is one row of columns for each number of reflections.
/// A shut door is a leaf, an open one a frame. One-way glass is dark from its dark side, and tinted
/// from the other.
#include "panes/panes.h"
#include "plan/effects.h"

#include "sightline/draw.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>

#define RADIANS (3.14159265358979323846 / 180)

/// What lies on a wall is drawn before it.
#define BEFORE 1.002f

enum { COLUMNS_MOST = 4096, LEVELS = MIRROR_DEPTH_MOST + 1, OVERLAYS_MOST = 256 };

typedef enum surface {
    SURFACE_NONE,
    SURFACE_WALL,
    SURFACE_MIRROR,
    SURFACE_LEAF,
    SURFACE_DARK
} surface;

typedef struct column {
    float nearness; ///< 1 / depth; 0 for nothing
    float light;
    uint32_t wall; ///< columns of one wall make one shape
    uint32_t part; ///< of what is seen in mirrors; SL_NO_PART: directly
    surface surface;
} column;

/// What is seen through: an open door or glass.
typedef struct overlay {
    sl_point from, to; ///< in mirrored space
    uint32_t part;
    int level;
    bool glass;
    double nearness; ///< of its middle
} overlay;

typedef struct viewer {
    sl_point eye;
    double c, s;  ///< of the heading
    double focal; ///< columns for a slope of 1
    double near;  ///< what is nearer is cut off
    double range; ///< what is on walls and in portals is shown up to there; 0: no limit
    int columns;
    column *levels[LEVELS]; ///< by the number of reflections
    int level_count;
    overlay overlays[OVERLAYS_MOST];
    int overlay_count;
    uint32_t pieces; ///< walls handed on
} viewer;

/// The columns that a segment covers, and its nearness in each.
typedef struct span {
    int first, last;
    double xa, xb, na, nb;
} span;

// --- columns

/// Depth and slope (to the right) of a point.
static sl_point turned_to_eye(const viewer *v, sl_point p) {
    const double x = p.x - v->eye.x, y = p.y - v->eye.y;
    return (sl_point){x * v->c + y * v->s, x * v->s - y * v->c};
}

static void cut_near(sl_point *a, sl_point b, double near) {
    if (a->x >= near) return;
    const double share = (near - a->x) / (b.x - a->x);
    *a = (sl_point){near, a->y + (b.y - a->y) * share};
}

/// False for a segment that is behind the eye.
static bool find_span(const viewer *v, sl_point from, sl_point to, span *out) {
    sl_point a = turned_to_eye(v, from), b = turned_to_eye(v, to);
    if (a.x < v->near && b.x < v->near) return false;
    cut_near(&a, b, v->near);
    cut_near(&b, a, v->near);
    const double half = v->columns / 2.0;
    out->xa = half + v->focal * a.y / a.x;
    out->xb = half + v->focal * b.y / b.x;
    out->na = 1 / a.x;
    out->nb = 1 / b.x;
    out->first = (int)fmin(fmax(ceil(fmin(out->xa, out->xb) - 0.5), 0), v->columns);
    out->last = (int)fmin(fmax(floor(fmax(out->xa, out->xb) - 0.5), -1), v->columns - 1);
    return true;
}

/// 1 / depth is linear across the page.
static double nearness_at(const span *s, double x) {
    const double share = s->xb != s->xa ? (x - s->xa) / (s->xb - s->xa) : 0;
    return s->na + (s->nb - s->na) * share;
}

/// Whether a thing in a column is within the view range, and in a level of reflections belongs to
/// the part there and is behind the mirror that shows it.
static bool can_show(const viewer *v, int level, uint32_t part, int x, float nearness) {
    const double slope = (x + 0.5 - v->columns / 2.0) / v->focal;
    if (v->range > 0 && hypot(1, slope) > v->range * nearness) return false;
    if (!level) return true;
    const column *at = &v->levels[level][x];
    return at->nearness > 0 && at->part == part && nearness < v->levels[level - 1][x].nearness;
}

static void add_surface(viewer *v, int level, sl_point from, sl_point to, column what) {
    span s;
    if (!find_span(v, from, to, &s)) return;
    const double length = hypot(to.x - from.x, to.y - from.y);
    const float bias = what.surface == SURFACE_WALL ? 1 : BEFORE;
    what.light = (float)(length > 0 ? fabs(to.y - from.y) / length : 0);
    for (int x = s.first; x <= s.last; x++) {
        column *at = &v->levels[level][x];
        what.nearness = (float)nearness_at(&s, x + 0.5) * bias;
        // A wall claims its columns; what lies on walls has to be seen there.
        const bool claims = what.surface == SURFACE_WALL;
        if (!claims && !can_show(v, level, what.part, x, what.nearness)) continue;
        if (what.nearness > at->nearness) *at = what;
    }
}

// --- walls seen directly

static void add_room(viewer *v, const sl_outline *outline, uint32_t room) {
    const uint32_t first = outline->first[room], end = outline->first[room + 1];
    for (uint32_t i = first; i < end; i++) {
        if (sl_side_is_portal(&outline->sides[i])) continue;
        const uint32_t next = i + 1 < end ? i + 1 : first;
        v->pieces++;
        add_surface(v, 0, outline->sides[i].start, outline->sides[next].start,
                    (column){.wall = outline->sides[i].neighbour,
                             .part = SL_NO_PART,
                             .surface = SURFACE_WALL});
    }
}

/// Adds the walls of rooms with a part in a visible cell, each room once.
static void add_cells(const view_state *view, viewer *v) {
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
            add_room(v, outline, room);
        }
    }
    free(added);
}

// --- what is on walls and in portals, directly or in mirrors

/// A part of what is seen, or all that is seen directly, and the eye's image in the map.
typedef struct look {
    const view_state *view;
    sl_point eye;
    uint32_t part;
    int level;
} look;

static sl_segment mirrored_place(const look *l, sl_segment s) {
    const sl_map *map = sl_query_map(l->view->present.query);
    const sl_mirrored_region *seen = &l->view->seen.in_mirrors;
    if (l->part == SL_NO_PART) return s;
    return (sl_segment){sl_mirror_part_place(map, seen, l->part, s.a),
                        sl_mirror_part_place(map, seen, l->part, s.b)};
}

/// Positive where a point is at the left of a segment.
static double side_of(sl_segment s, sl_point p) {
    return (s.b.x - s.a.x) * (p.y - s.a.y) - (s.b.y - s.a.y) * (p.x - s.a.x);
}

/// Whether nothing nearer hides what is seen through.
static bool is_open_to(const viewer *v, int level, uint32_t part, int x, float nearness) {
    return nearness > v->levels[level][x].nearness && can_show(v, level, part, x, nearness);
}

static void add_overlay(viewer *v, const look *l, sl_segment at, bool glass) {
    const sl_point middle = {(at.a.x + at.b.x) / 2, (at.a.y + at.b.y) / 2};
    bool shown = false;
    span s;
    if (v->overlay_count == OVERLAYS_MOST || !find_span(v, at.a, at.b, &s)) return;
    for (int x = s.first; x <= s.last && !shown; x++)
        shown = is_open_to(v, l->level, l->part, x, (float)nearness_at(&s, x + 0.5) * BEFORE);
    if (!shown) return;
    v->overlays[v->overlay_count++] =
        (overlay){.from = at.a,
                  .to = at.b,
                  .part = l->part,
                  .level = l->level,
                  .glass = glass,
                  .nearness = 1 / fmax(turned_to_eye(v, middle).x, v->near)};
}

static void add_effects(viewer *v, const sl_map *map, const look *l) {
    for (size_t i = 0; i < map->mirror_count; i++)
        if (!map->mirrors[i].one_sided || side_of(map->mirrors[i].segment, l->eye) > 0) {
            const sl_segment at = mirrored_place(l, map->mirrors[i].segment);
            add_surface(v, l->level, at.a, at.b,
                        (column){.wall = (uint32_t)i, .part = l->part, .surface = SURFACE_MIRROR});
        }
    for (size_t i = 0; i < map->door_count; i++) {
        const sl_segment at = mirrored_place(l, map->doors[i].segment);
        if (map->doors[i].open)
            add_overlay(v, l, at, false);
        else
            add_surface(v, l->level, at.a, at.b,
                        (column){.wall = (uint32_t)i, .part = l->part, .surface = SURFACE_LEAF});
    }
    for (size_t i = 0; i < map->oneway_count; i++) {
        const sl_segment at = mirrored_place(l, map->oneways[i].segment);
        if (side_of(map->oneways[i].segment, l->eye) > 0)
            add_surface(v, l->level, at.a, at.b,
                        (column){.wall = (uint32_t)i, .part = l->part, .surface = SURFACE_DARK});
        else
            add_overlay(v, l, at, true);
    }
}

/// Adds the walls of a part of what is seen in mirrors, where they seem to be.
static void add_part(viewer *v, const sl_mirror_part *part, uint32_t number) {
    const sl_region *r = &part->region;
    for (size_t i = 0; i < r->count; i++)
        if (r->edges[i].kind == SL_EDGE_WALL || r->edges[i].kind == SL_EDGE_BORDER)
            add_surface(
                v, (int)part->depth, part->image[i], part->image[i + 1 < r->count ? i + 1 : 0],
                (column){.wall = r->edges[i].wall, .part = number, .surface = SURFACE_WALL});
}

/// Parts come after their parents, so the mirrors that show them are there before them.
static void add_parts(viewer *v, const view_state *view, const sl_map *map) {
    const sl_mirrored_region *seen = &view->seen.in_mirrors;
    for (uint32_t i = 0; i < seen->part_count; i++) {
        const sl_mirror_part *part = &seen->parts[i];
        if ((int)part->depth >= v->level_count) continue;
        add_part(v, part, i);
        add_effects(v, map, &(look){view, part->region.view.eye, i, (int)part->depth});
    }
}

// --- drawing

typedef struct page {
    view_state *view;
    sl_box box;
    double high; ///< half the height of a wall at depth 1
    double wide; ///< pixels for a column
} page;

/// A shape over columns, from a share of the height below the middle to one above it.
static void add_shape(const page *p, double first, double end, double na, double nb, double low,
                      double top) {
    cairo_t *cairo = p->view->ui->cairo;
    const double middle = (p->box.min.y + p->box.max.y) / 2;
    const double x0 = p->box.min.x + first * p->wide, x1 = p->box.min.x + end * p->wide;
    cairo_move_to(cairo, x0, middle - top * p->high * na);
    cairo_line_to(cairo, x1, middle - top * p->high * nb);
    cairo_line_to(cairo, x1, middle - low * p->high * nb);
    cairo_line_to(cairo, x0, middle - low * p->high * na);
    cairo_close_path(cairo);
}

static void set_faded(cairo_t *cairo, sl_colour c, double opacity) {
    cairo_set_source_rgba(cairo, c.red, c.green, c.blue, opacity);
}

/// The farther, the more a colour fades into the ground's.
static sl_colour dimmed(const page *p, sl_colour colour, double nearness) {
    const double far = fmin(fmax(1 - 5 * p->high * nearness / box_height(p->box), 0), 1);
    return sl_colour_mix(colour, p->view->ui->palette.ground, 0.75 * far);
}

static sl_colour colour_of(const page *p, const column *c) {
    const sl_palette *palette = &p->view->ui->palette;
    if (c->surface == SURFACE_LEAF) return sl_colour_mix(palette->door, palette->wall, 0.25);
    if (c->surface == SURFACE_DARK) return sl_colour_mix(palette->wall, palette->glass, 0.25);
    if (c->surface == SURFACE_MIRROR) return palette->seen[0];
    return sl_colour_mix(palette->floor[2], palette->glass, 0.16 + 0.3 * c->light);
}

/// A door's leaf has two panels, if it is wide enough to show them.
static void draw_panels(const page *p, int first, int end, double na, double nb) {
    const sl_palette *palette = &p->view->ui->palette;
    const double inset = 0.14 * (end - first);
    if ((end - first) * p->wide < 14) return;
    const double step = (nb - na) / (end - first), n0 = na + inset * step, n1 = nb - inset * step;
    add_shape(p, first + inset, end - inset, n0, n1, -0.8, -0.1);
    add_shape(p, first + inset, end - inset, n0, n1, 0.1, 0.85);
    set_faded(p->view->ui->cairo, palette->page, 0.3);
    cairo_fill(p->view->ui->cairo);
}

/// Whether something is seen in the mirror at a column.
static bool shows_image(const viewer *v, int level, int x) {
    return level + 1 < v->level_count && v->levels[level + 1][x].nearness > 0;
}

/// Columns of one wall make one shape: its upper and lower edges are straight.
static void draw_level(const page *p, const viewer *v, int level) {
    cairo_t *cairo = p->view->ui->cairo;
    const sl_palette *palette = &p->view->ui->palette;
    const column *seen = v->levels[level];
    for (int first = 0, end; first < v->columns; first = end) {
        const bool image = shows_image(v, level, first);
        for (end = first + 1; end < v->columns && seen[end].wall == seen[first].wall &&
                              seen[end].surface == seen[first].surface &&
                              seen[end].part == seen[first].part &&
                              shows_image(v, level, end) == image && seen[end].nearness > 0;)
            end++;
        if (!(seen[first].nearness > 0)) continue;
        const double a = seen[first].nearness, b = seen[end - 1].nearness;
        add_shape(p, first, end, a, b, -1, 1);
        const sl_colour colour = dimmed(p, colour_of(p, &seen[first]), (a + b) / 2);
        // What a mirror shows is drawn already: the mirror only tints it.
        if (image)
            set_faded(cairo, palette->seen[0], 0.22);
        else
            sl_set_colour(cairo, colour);
        cairo_fill_preserve(cairo);
        const bool framed = seen[first].surface != SURFACE_WALL;
        set_faded(cairo,
                  framed && seen[first].surface != SURFACE_LEAF ? palette->glass : palette->wall,
                  framed ? 0.9 : 0.35);
        cairo_set_line_width(cairo, framed ? fmin(2, 0.5 + 0.05 * (end - first)) : 0.8);
        cairo_stroke(cairo);
        if (seen[first].surface == SURFACE_LEAF) draw_panels(p, first, end, a, b);
    }
}

/// One run of columns in which an open door or glass is seen. `s` is all of it: a door has posts at
/// its ends alone.
static void draw_run(const page *p, const span *s, int first, int end, bool glass) {
    cairo_t *cairo = p->view->ui->cairo;
    const sl_palette *palette = &p->view->ui->palette;
    const double na = nearness_at(s, first), nb = nearness_at(s, end);
    if (glass) {
        add_shape(p, first, end, na, nb, -1, 1);
        set_faded(cairo, palette->glass, 0.22);
        cairo_fill_preserve(cairo);
        set_faded(cairo, palette->glass, 0.9);
        cairo_set_line_width(cairo, 1.4);
        cairo_stroke(cairo);
        return;
    }
    const double low = fmin(s->xa, s->xb), high = fmax(s->xa, s->xb);
    const double post = fmax(0.06 * (high - low), 1.5);
    const double left = fmin(low + post, end), right = fmax(high - post, first);
    add_shape(p, first, end, na, nb, 0.72, 1);
    if (left > first) add_shape(p, first, left, na, nearness_at(s, left), -1, 1);
    if (right < end) add_shape(p, right, end, nearness_at(s, right), nb, -1, 1);
    sl_set_colour(cairo,
                  dimmed(p, sl_colour_mix(palette->door, palette->wall, 0.25), (na + nb) / 2));
    cairo_fill(cairo);
}

/// Draws what is seen through, in the columns where nothing nearer hides it. Returns how many.
static uint32_t draw_overlay(const page *p, const viewer *v, const overlay *o) {
    uint32_t shown = 0;
    span s;
    if (!find_span(v, o->from, o->to, &s)) return 0;
    for (int x = s.first, first = s.first; x <= s.last + 1; x++) {
        const float nearness = (float)nearness_at(&s, x + 0.5) * BEFORE;
        const bool visible = x <= s.last && is_open_to(v, o->level, o->part, x, nearness);
        if (visible) {
            shown++;
            continue;
        }
        if (x > first) draw_run(p, &s, first, x, o->glass);
        first = x + 1;
    }
    return shown;
}

static int compare_overlays(const void *a, const void *b) {
    const overlay *x = a, *y = b;
    return (x->nearness > y->nearness) - (x->nearness < y->nearness);
}

/// Draws from the most reflections to none; within that from far to near. Counts columns.
static void draw_all(const page *p, viewer *v, first_person_counts *counts) {
    qsort(v->overlays, (size_t)v->overlay_count, sizeof *v->overlays, compare_overlays);
    for (int level = v->level_count; level-- > 0;) {
        draw_level(p, v, level);
        for (int i = 0; i < v->overlay_count; i++) {
            const overlay *o = &v->overlays[i];
            if (o->level == level)
                *(o->glass ? &counts->tinted : &counts->frames) += draw_overlay(p, v, o);
        }
        for (int x = 0; x < v->columns; x++) {
            const column *at = &v->levels[level][x];
            if (!(at->nearness > 0)) continue;
            counts->reflected += level > 0;
            counts->mirrors += at->surface == SURFACE_MIRROR;
            counts->leaves += at->surface == SURFACE_LEAF;
            counts->dark += at->surface == SURFACE_DARK;
        }
    }
}

static void draw_count(view_state *view, const viewer *v, sl_box box) {
    char text[160];
    const uint32_t all = view->present.outline->side_count;
    uint32_t walls = 0;
    for (uint32_t i = 0; i < all; i++)
        walls += !sl_side_is_portal(&view->present.outline->sides[i]);
    size_t count;
    snprintf(text, sizeof text, "%u of %u wall pieces drawn, %.1f %% culled by %s", v->pieces,
             walls, walls ? 100.0 * (walls - v->pieces) / walls : 0,
             sl_eye_methods(&count)[view->method].name);
    if (view_is_solid(view, view->eye.at))
        snprintf(text, sizeof text, "The eye is in solid ground and sees nothing.");
    const double t = view->ui->text;
    const double width = fmin(ui_text_width(view->ui, 0.95, false, text), box_width(box) - 2.6 * t);
    const sl_box ground = {{box.min.x + 0.7 * t, box.max.y - 2.3 * t},
                           {box.min.x + 1.9 * t + width, box.max.y - 0.6 * t}};
    ui_fill_round(view->ui, ground, 0.3 * t, view->ui->palette.page);
    sl_text_show_within(view->ui->cairo, view->ui->palette.ink, ground.min.x + 0.6 * t,
                        ground.max.y - 0.5 * t, width, 0.95 * t, false, text);
}

/// Room for all levels, or false.
static bool make_levels(viewer *v, const view_state *view) {
    const sl_mirrored_region *seen = &view->seen.in_mirrors;
    v->level_count = 1;
    for (size_t i = 0; i < seen->part_count; i++)
        if ((int)seen->parts[i].depth >= v->level_count && seen->parts[i].depth < LEVELS)
            v->level_count = (int)seen->parts[i].depth + 1;
    column *all = calloc((size_t)v->level_count * (size_t)v->columns, sizeof *all);
    for (int i = 0; i < v->level_count; i++)
        v->levels[i] = all ? all + (size_t)i * (size_t)v->columns : NULL;
    return all != NULL;
}

static void draw_view(view_state *view, sl_box box, viewer *v) {
    const double size = sqrt(view->document->area / fmax(view->document->counted, 1));
    const page p = {view, box, 0.22 * size * v->focal, box_width(box) / v->columns};
    const look straight = {view, v->eye, SL_NO_PART, 0};
    v->near = 1e-3 * size;
    v->range = view->document->map.range;
    if (!make_levels(v, view)) return;
    add_cells(view, v);
    add_effects(v, &view->document->map, &straight);
    add_parts(v, view, &view->document->map);
    draw_all(&p, v, &view->first_person);
    view->first_person.pieces = v->pieces;
    free(v->levels[0]);
    draw_count(view, v, box);
}

void pane_first_person(learn_state *learn, sl_box box) {
    view_state *view = learn->view;
    ui_state *ui = view->ui;
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
    const double fov = fmin(view->eye.fov, widest) * RADIANS;
    viewer v = {.eye = view->eye.at,
                .c = cos(view->eye.heading * RADIANS),
                .s = sin(view->eye.heading * RADIANS),
                .columns = (int)fmin(box_width(box), COLUMNS_MOST)};
    v.focal = v.columns / 2.0 / tan(fov / 2);
    view->first_person = (first_person_counts){0};
    if (view->document->baked && view->seen.valid && v.columns > 0 &&
        view->seen.methods[view->method].known)
        draw_view(view, box, &v);
    ui_line(ui, box.min.x, box.min.y + 0.5, box.max.x, box.min.y + 0.5, palette->outline);
    cairo_restore(ui->cairo);
}

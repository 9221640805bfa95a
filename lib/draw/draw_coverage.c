/// Pictures of what several viewpoints see together: classes of coverage, and each viewpoint in a
/// colour of its own.
#include "draw/marks.h"
#include "draw/page.h"
#include "sightline/support.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

enum { CLASSES = SL_COVERAGE_CLASSES, NAME_TEXT = 48 };

typedef struct picture {
    sl_scene scene;
    const sl_drawn_coverage *coverage;
    const char *caption;
} picture;

sl_colour sl_coverage_colour(const sl_palette *palette, uint32_t class) {
    static const sl_colour light[CLASSES] = {
        {0.965, 0.735, 0.600}, {0.835, 0.910, 0.945}, {0.610, 0.790, 0.880}, {0.370, 0.630, 0.780}};
    static const sl_colour dark[CLASSES] = {
        {0.560, 0.290, 0.170}, {0.130, 0.240, 0.320}, {0.150, 0.350, 0.470}, {0.200, 0.480, 0.620}};
    return palette->dark ? dark[class] : light[class];
}

/// Okabe and Ito 2008, without yellow and with a deeper sky; then mixed with the ink.
sl_colour sl_viewpoint_colour(const sl_palette *palette, size_t viewpoint) {
    static const sl_colour kinds[] = {
        {0.000, 0.447, 0.698}, {0.835, 0.369, 0.000}, {0.000, 0.520, 0.380}, {0.720, 0.360, 0.580},
        {0.550, 0.420, 0.000}, {0.180, 0.520, 0.720}, {0.420, 0.250, 0.620}};
    enum { KINDS = sizeof kinds / sizeof *kinds };
    const double share = viewpoint / KINDS % 2 ? 0.45 : 0;
    const sl_colour own = sl_colour_mix(kinds[viewpoint % KINDS], palette->ink, share);
    return palette->dark ? sl_colour_mix(own, (sl_colour){1, 1, 1}, 0.45) : own;
}

static uint32_t class_of(const sl_drawn_coverage *c, uint32_t piece) {
    return c->counts[piece] < CLASSES ? c->counts[piece] : CLASSES - 1;
}

/// Pieces of one class make one path. A thin stroke covers the seams between them, which there are
/// only where edges are smooth.
sl_status sl_draw_coverage_areas(sl_context *context, cairo_t *cairo, const sl_palette *palette,
                                 const sl_drawn_coverage *coverage, const sl_frame *frame) {
    const sl_space *pieces = coverage->pieces;
    for (uint32_t class = 0; class < CLASSES; class ++) {
        SL_TRY(sl_check_cancelled(context));
        for (uint32_t i = 0; i < pieces->cell_count; i++)
            if (pieces->cells[i].inside && class_of(coverage, i) == class)
                sl_path_polygon(cairo, frame, pieces->vertices + pieces->cells[i].first_vertex,
                                pieces->cells[i].vertex_count);
        sl_set_colour(cairo, sl_coverage_colour(palette, class));
        if (cairo_get_antialias(cairo) == CAIRO_ANTIALIAS_NONE) {
            cairo_fill(cairo);
            continue;
        }
        cairo_fill_preserve(cairo);
        cairo_set_line_width(cairo, 0.6);
        cairo_stroke(cairo);
    }
    return SL_OK;
}

void sl_draw_coverage_borders(cairo_t *cairo, const sl_palette *palette,
                              const sl_drawn_coverage *coverage, const sl_frame *frame) {
    for (size_t v = 0; v < coverage->count; v++) {
        const sl_shape *shape = &coverage->regions[v];
        for (size_t i = 0, from = 0; i < shape->count; from = shape->ends[i++])
            sl_path_polygon(cairo, frame, shape->points + from, shape->ends[i] - from);
        sli_pen_stroke(cairo, sl_viewpoint_colour(palette, v), 1.1 * frame->unit);
    }
}

/// The borders of its cone, short, or nothing.
static void draw_cone(cairo_t *cairo, const sl_frame *frame, const sl_viewpoint *v,
                      sl_colour colour) {
    if (!(v->fov < 360)) return;
    const sl_point at = sl_frame_point(frame, v->at);
    const double reach = 22 * frame->unit, degree = SLI_FULL_TURN / 360;
    const double low = (v->heading - v->fov / 2) * degree, high = low + v->fov * degree;
    cairo_move_to(cairo, at.x, at.y);
    cairo_arc_negative(cairo, at.x, at.y, reach, -low, -high); // the page's y runs down
    cairo_close_path(cairo);
    sl_set_colour(cairo, colour);
    cairo_fill(cairo);
}

// --- marks

/// A disc with a text in it, wider where the text is long. Those that would lie on others stand
/// beside their places, each joined with its own by a line.
typedef struct mark {
    char text[NAME_TEXT];
    sl_point place, at; ///< on the page; the middle of the disc is `at`
    double wide;        ///< of the text
    sl_colour ground, ink;
} mark;

#define MARK_TEXT(frame) (11 * (frame)->unit)
#define MARK_HALF        0.75 ///< of a disc, as a multiple of the size of its text

static double half_width(const mark *m, double size) {
    return fmax(m->wide / 2 + 0.3 * size, MARK_HALF * size);
}

static bool covers(const mark *a, const mark *b, double size) {
    const double apart = 0.2 * size;
    return fabs(a->at.x - b->at.x) < half_width(a, size) + half_width(b, size) + apart &&
           fabs(a->at.y - b->at.y) < 2 * MARK_HALF * size + apart;
}

static bool is_free(const mark *marks, size_t i, const sl_frame *frame, double size) {
    const mark *m = &marks[i];
    const double half = half_width(m, size);
    const bool moved = m->at.x != m->place.x || m->at.y != m->place.y;
    if (moved && (m->at.x < frame->left + half || m->at.x > frame->left + frame->width - half ||
                  m->at.y < frame->top + size || m->at.y > frame->top + frame->height - size))
        return false;
    for (size_t k = 0; k < i; k++)
        if (covers(&marks[k], m, size)) return false;
    return true;
}

/// Puts a mark where none of those before it lies: at its place, else on rings about it.
static void put_mark(mark *marks, size_t i, const sl_frame *frame) {
    enum { RINGS = 8, WAYS = 8 };
    static const int ways[WAYS][2] = {{1, 0},  {0, -1},  {-1, 0}, {0, 1},
                                      {1, -1}, {-1, -1}, {-1, 1}, {1, 1}};
    mark *m = &marks[i];
    const double size = MARK_TEXT(frame);
    m->at = m->place;
    for (int k = 0; !is_free(marks, i, frame, size); k++) {
        if (k == RINGS * WAYS) {
            m->at = m->place;
            return;
        }
        const double ring = 2 * MARK_HALF * size * (k / WAYS + 1.2);
        const int *way = ways[k % WAYS];
        m->at = (sl_point){m->place.x + way[0] * (ring + half_width(m, size) - size),
                           m->place.y + way[1] * ring};
    }
}

static void join_mark(cairo_t *cairo, const sl_palette *palette, const mark *m,
                      const sl_frame *frame) {
    if (m->at.x == m->place.x && m->at.y == m->place.y) return;
    cairo_move_to(cairo, m->place.x, m->place.y);
    cairo_line_to(cairo, m->at.x, m->at.y);
    sli_pen_stroke(cairo, palette->ink, 1.1 * frame->unit);
    cairo_new_sub_path(cairo);
    cairo_arc(cairo, m->place.x, m->place.y, 2.5 * frame->unit, 0, SLI_FULL_TURN);
    sl_set_colour(cairo, palette->ink);
    cairo_fill(cairo);
}

static void draw_mark(cairo_t *cairo, const mark *m, const sl_frame *frame) {
    const double size = MARK_TEXT(frame), half = half_width(m, size), high = MARK_HALF * size;
    cairo_new_sub_path(cairo);
    cairo_arc(cairo, m->at.x + half - high, m->at.y, high, -SLI_FULL_TURN / 4, SLI_FULL_TURN / 4);
    cairo_arc(cairo, m->at.x - half + high, m->at.y, high, SLI_FULL_TURN / 4, -SLI_FULL_TURN / 4);
    cairo_close_path(cairo);
    sl_set_colour(cairo, m->ground);
    cairo_fill_preserve(cairo);
    sli_pen_stroke(cairo, m->ink, 0.9 * frame->unit);
    sl_text_font(cairo, size, true);
    sl_text_show(cairo, m->ink, m->at.x - m->wide / 2, m->at.y + 0.36 * size, m->text);
}

static void draw_path(cairo_t *cairo, const picture *p, const sl_frame *frame) {
    const sl_drawn_coverage *c = p->coverage;
    const sl_palette *palette = &p->scene.palette;
    for (size_t i = 0; i < c->path_count; i++) {
        const sl_point at = sl_frame_point(frame, c->path[i]);
        if (i)
            cairo_line_to(cairo, at.x, at.y);
        else
            cairo_move_to(cairo, at.x, at.y);
    }
    sli_pen_stroke(cairo, palette->ink, 1.4 * frame->unit);
    for (size_t i = 0; i < c->unseen_count; i++) {
        const sl_point a = sl_frame_point(frame, c->unseen[i].a),
                       b = sl_frame_point(frame, c->unseen[i].b);
        cairo_move_to(cairo, a.x, a.y);
        cairo_line_to(cairo, b.x, b.y);
    }
    cairo_set_line_cap(cairo, CAIRO_LINE_CAP_ROUND);
    sli_pen_stroke(cairo, sl_viewpoint_colour(palette, 1), 4 * frame->unit);
}

/// Viewpoints come first: blind spots make room for them.
static void fill_mark(const sl_palette *palette, const sl_drawn_coverage *c, const sl_frame *frame,
                      size_t i, mark *m) {
    if (i >= c->count) {
        snprintf(m->text, sizeof m->text, "blind %zu", i - c->count + 1);
        m->place = sl_frame_point(frame, c->blind[i - c->count]);
        m->ground = palette->page;
        m->ink = palette->ink;
        return;
    }
    const char *name = c->names ? c->names[i] : NULL;
    if (name)
        sli_text_copy(name, strlen(name), m->text, sizeof m->text);
    else
        snprintf(m->text, sizeof m->text, "%zu", i + 1);
    m->place = sl_frame_point(frame, c->viewpoints[i].at);
    m->ground = sl_viewpoint_colour(palette, i);
    m->ink = palette->page;
}

sl_status sl_draw_coverage_marks(sl_context *context, cairo_t *cairo, const sl_palette *palette,
                                 const sl_drawn_coverage *coverage, const sl_frame *frame) {
    const size_t count = coverage->count + coverage->blind_count;
    mark *marks = sl_alloc_array(context, count, sizeof *marks);
    if (!marks) return SL_NO_MEMORY;
    for (size_t i = 0; i < count; i++) {
        fill_mark(palette, coverage, frame, i, &marks[i]);
        sl_text_font(cairo, MARK_TEXT(frame), true);
        marks[i].wide = sl_text_width(cairo, marks[i].text);
        put_mark(marks, i, frame);
    }
    for (size_t i = 0; i < coverage->count; i++)
        draw_cone(cairo, frame, &coverage->viewpoints[i], sl_viewpoint_colour(palette, i));
    for (size_t i = 0; i < count; i++) join_mark(cairo, palette, &marks[i], frame);
    for (size_t i = count; i-- > 0;) draw_mark(cairo, &marks[i], frame);
    sl_free(context, marks);
    return SL_OK;
}

static sl_status draw_plan(sl_context *context, cairo_t *cairo, const void *what,
                           const sl_frame *frame) {
    const picture *p = what;
    const sl_palette *palette = &p->scene.palette;
    SL_TRY(sl_draw_plan(context, cairo, &p->scene, p->scene.options.layers, frame));
    SL_TRY(sl_draw_coverage_areas(context, cairo, palette, p->coverage, frame));
    sli_draw_solid(cairo, &p->scene, frame);
    sl_draw_coverage_borders(cairo, palette, p->coverage, frame);
    SL_TRY(sl_draw_walls(context, cairo, &p->scene, frame));
    draw_path(cairo, p, frame);
    return sl_draw_coverage_marks(context, cairo, palette, p->coverage, frame);
}

// --- the page

/// The classes that there are, in one line as the width allows.
static double draw_key(cairo_t *cairo, const picture *p, sl_point at, double width, double size,
                       bool paint) {
    static const char *const texts[CLASSES] = {"not seen", "seen by 1", "by 2", "by 3 or more"};
    const sl_palette *palette = &p->scene.palette;
    const sl_space *pieces = p->coverage->pieces;
    bool used[CLASSES] = {false};
    for (uint32_t i = 0; i < pieces->cell_count; i++)
        used[class_of(p->coverage, i)] |= pieces->cells[i].inside;
    sli_key key = sli_key_at(at, width, size);
    for (uint32_t class = 0; class < CLASSES; class ++) {
        if (!used[class]) continue;
        const sl_point entry = sli_key_entry(cairo, palette->ink, &key, texts[class], paint);
        if (!paint) continue;
        cairo_rectangle(cairo, entry.x, entry.y + 0.22 * size, 2 * size, 1.2 * size);
        sl_set_colour(cairo, sl_coverage_colour(palette, class));
        cairo_fill(cairo);
    }
    return sli_key_end(&key) - at.y;
}

static void set_page(cairo_t *cairo, const void *what, sli_page *page, bool paint) {
    const picture *p = what;
    const sl_palette *palette = &p->scene.palette;
    const double top = sli_page_heading(cairo, page, palette, p->scene.options.title, NULL, paint);
    if (!paint) sli_page_place_plan(page, p->scene.baked->space.bounds, top, SLI_PAGE_TALLEST);
    double y = page->key;
    y += draw_key(cairo, p, (sl_point){page->margin, y}, page->inner, page->text, paint);
    y += sli_draw_ground_key(cairo, &p->scene, (sl_point){page->margin, y}, page->text, paint);
    y += sli_page_caption(cairo, page, palette, y, p->caption, paint);
    page->height = ceil(y + 0.7 * page->margin);
}

sl_status sli_draw_coverage(sl_context *context, const sl_baked *baked,
                            const sl_drawn_coverage *coverage, const char *caption,
                            const sl_draw_options *options, sli_page_target *target) {
    picture p = {.coverage = coverage, .caption = caption};
    const sli_page_parts parts = {.set = set_page, .draw_plan = draw_plan, .what = &p};
    return sli_page_draw_map(context, baked, options, SL_LAYER_WALLS, &p.scene, parts, target);
}

sl_status sl_draw_coverage_file(sl_context *context, const sl_baked *baked,
                                const sl_drawn_coverage *coverage, const char *caption,
                                const sl_draw_options *options, const char *path) {
    return sli_draw_coverage(context, baked, coverage, caption, options,
                             &(sli_page_target){.path = path});
}

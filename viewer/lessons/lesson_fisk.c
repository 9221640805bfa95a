/// The lesson of Fisk's colouring: ears are cut off the polygon one by one, then put back in
/// reverse order, each tip in the colour that is left. The smallest class guards everything. A map
/// that is no polygon without holes has one step, which says why.
#include "lessons/learn.h"
#include "sightline/draw.h"
#include "sightline/support.h"

#include <math.h>
#include <stdio.h>

// --- what the proof is about

static bool overlap(double a, double b, double c, double d) {
    return fmax(a, b) > fmin(c, d) && fmax(c, d) > fmin(a, b);
}

/// Whether a wall lies along a side of a triangle.
static bool lies_along(sl_segment w, sl_point p, sl_point q) {
    if (sl_orient(p, q, w.a) != 0 || sl_orient(p, q, w.b) != 0) return false;
    return overlap(w.a.x, w.b.x, p.x, q.x) || overlap(w.a.y, w.b.y, p.y, q.y);
}

/// Whether a wall goes through the inside of a triangle: no line of a side, and not its own, parts
/// them. Exact.
static bool goes_through(sl_segment w, const sl_point t[3]) {
    int left = 0, right = 0;
    for (int i = 0; i < 3; i++) {
        const sl_point p = t[i], q = t[(i + 1) % 3];
        const int side = sl_orient(w.a, w.b, p);
        left += side > 0;
        right += side < 0;
        if (sl_orient(p, q, w.a) <= 0 && sl_orient(p, q, w.b) <= 0) return false;
    }
    return left && right;
}

/// Whether a wall stands in the polygon: in a triangle, or on a cut.
static bool has_wall(const lesson_state *lesson, sl_segment w) {
    const sl_fisk *f = &lesson->fisk;
    const sl_point *at = lesson->outline.points;
    for (uint32_t i = 0; i < f->ear_count; i++) {
        const sl_ear *e = &f->ears[i];
        const sl_point t[3] = {at[e->before], at[e->tip], at[e->after]};
        const bool cut = i + 1 < f->ear_count; // the last one is cut off from nothing
        if (goes_through(w, t) || (cut && lies_along(w, t[0], t[2]))) return true;
    }
    return false;
}

static sl_status record(sl_context *context, lesson_state *lesson, const document_state *document,
                        uint32_t source) {
    (void)source;
    const sl_space *space = &document->baked->space;
    lesson->refused[0] = '\0';
    SL_TRY(sl_shape_of_inside(context, space, &lesson->outline));
    const sl_status status = sl_fisk_colour(context, &lesson->outline, &lesson->fisk);
    if (status == SL_NO_MEMORY || status == SL_CANCELLED) return status;
    if (status != SL_OK)
        snprintf(lesson->refused, SENTENCE, "%s. Holes are pillars and blocks of rooms.",
                 sl_context_message(context));
    for (uint32_t i = 0; i < space->wall_count && !lesson->refused[0]; i++)
        if (has_wall(lesson, (sl_segment){space->walls[i].a, space->walls[i].b}))
            snprintf(lesson->refused, SENTENCE,
                     "Fisk's proof needs a polygon: here a wall stands inside, seen from both "
                     "sides.");
    return SL_OK;
}

// --- steps: the polygon, ears, the same ears back with a colour, the guards

typedef struct place {
    enum { WHOLE, CUTS, COLOURS, GUARDS } part;
    uint32_t ear;
} place;

static size_t length(const lesson_state *lesson) {
    return lesson->refused[0] ? 1 : 2 + 2 * (size_t)lesson->fisk.ear_count;
}

static place place_of(const lesson_state *lesson) {
    const size_t ears = lesson->fisk.ear_count, at = lesson->at;
    if (at == 0 || lesson->refused[0]) return (place){WHOLE, 0};
    if (at <= ears) return (place){CUTS, (uint32_t)(at - 1)};
    if (at <= 2 * ears) return (place){COLOURS, (uint32_t)(2 * ears - at)};
    return (place){GUARDS, 0};
}

static const char *const names[] = {"blue", "orange", "green"};

static void say(const lesson_state *lesson, const document_state *document, char text[SENTENCE]) {
    (void)document;
    const sl_fisk *f = &lesson->fisk;
    const place p = place_of(lesson);
    const sl_ear *e = f->ears ? &f->ears[p.ear] : NULL;
    if (lesson->refused[0])
        snprintf(text, SENTENCE, "%s", lesson->refused);
    else if (p.part == WHOLE)
        snprintf(text, SENTENCE,
                 "A polygon with %u corners and no holes: %u guards are enough (a third of %u).",
                 f->corner_count, f->corner_count / 3, f->corner_count);
    else if (p.part == CUTS && p.ear + 1 == f->ear_count)
        snprintf(text, SENTENCE, "One triangle is left: the polygon is %u triangles.",
                 f->ear_count);
    else if (p.part == CUTS)
        snprintf(text, SENTENCE,
                 "Corner %u is the tip of an ear: no corner lies in its triangle. It is cut off.",
                 e->tip + 1);
    else if (p.part == COLOURS && p.ear + 1 == f->ear_count)
        snprintf(text, SENTENCE, "The corners of the last triangle get three colours.");
    else if (p.part == COLOURS)
        snprintf(text, SENTENCE,
                 "Back comes the ear of corner %u. Its neighbours are %s and %s, so it is %s.",
                 e->tip + 1, names[f->colours[e->before]], names[f->colours[e->after]],
                 names[f->colours[e->tip]]);
    else
        snprintf(text, SENTENCE,
                 "%u corners are %s, the fewest. Each triangle has one, so guards there see "
                 "everything: %u, and a third of %u is %u.",
                 f->guard_count, names[f->least], f->guard_count, f->corner_count,
                 f->corner_count / 3);
}

static const char *const lines[] = {
    "while the polygon has more than three corners:",
    "    find an ear: a triangle of neighbours, no corner in it",
    "    cut it off",
    "colour the last triangle with three colours",
    "for each ear, the last one first:",
    "    put it back",
    "    its tip gets the colour that is left",
    "guards = the corners of the rarest colour",
};

static const char *const *code(const lesson_state *lesson, const document_state *document,
                               size_t *count, size_t *lit) {
    (void)document;
    const place p = place_of(lesson);
    const bool last = p.ear + 1 == lesson->fisk.ear_count;
    *count = sizeof lines / sizeof *lines;
    *lit = p.part == WHOLE     ? 0
           : p.part == CUTS    ? (last ? 0 : 2)
           : p.part == COLOURS ? (last ? 3 : 6)
                               : 7;
    return lines;
}

static void account(const lesson_state *lesson, char text[SENTENCE]) {
    const sl_fisk *f = &lesson->fisk;
    const place p = place_of(lesson);
    uint32_t sizes[3] = {0};
    if (lesson->refused[0]) {
        snprintf(text, SENTENCE, "The lesson of the exact method takes any map.");
        return;
    }
    if (p.part < COLOURS) {
        snprintf(text, SENTENCE, "%u of %u triangles cut off.", p.part == CUTS ? p.ear + 1 : 0,
                 f->ear_count);
        return;
    }
    const uint32_t from = p.part == GUARDS ? 0 : p.ear;
    for (uint32_t i = from; i < f->ear_count; i++) sizes[f->colours[f->ears[i].tip]]++;
    const sl_ear *last = &f->ears[f->ear_count - 1];
    sizes[f->colours[last->before]]++;
    sizes[f->colours[last->after]]++;
    snprintf(text, SENTENCE, "%u corners are %s, %u %s, %u %s.", sizes[0], names[0], sizes[1],
             names[1], sizes[2], names[2]);
}

// --- the picture

static void draw_triangle(learn_state *learn, const sl_frame *frame, uint32_t ear, double opacity,
                          double width) {
    const lesson_state *lesson = &learn->lesson;
    const sl_ear *e = &lesson->fisk.ears[ear];
    const sl_point *at = lesson->outline.points;
    const sl_point t[3] = {at[e->before], at[e->tip], at[e->after]};
    cairo_t *cairo = learn->ui->cairo;
    const sl_colour colour = learn->ui->palette.glass;
    sl_path_polygon(cairo, frame, t, 3);
    cairo_set_source_rgba(cairo, colour.red, colour.green, colour.blue, opacity);
    cairo_fill(cairo);
    for (int i = 0; i < 3; i++)
        sl_draw_line(cairo, frame, t[i], t[(i + 1) % 3], learn->ui->palette.faint, width);
}

static void below(learn_state *learn, const sl_frame *frame) {
    const lesson_state *lesson = &learn->lesson;
    const place p = place_of(lesson);
    if (lesson->refused[0] || p.part == WHOLE) return;
    const uint32_t from = p.part == COLOURS ? p.ear : 0;
    const uint32_t to = p.part == CUTS ? p.ear + 1 : lesson->fisk.ear_count;
    for (uint32_t i = from; i < to; i++) draw_triangle(learn, frame, i, 0.16, frame->unit);
    if (p.part != GUARDS) draw_triangle(learn, frame, p.ear, 0.4, 2 * frame->unit);
}

static void draw_corner(learn_state *learn, const sl_frame *frame, uint32_t corner) {
    const lesson_state *lesson = &learn->lesson;
    const sl_colour colour = sl_viewpoint_colour(&learn->ui->palette, lesson->fisk.colours[corner]);
    // A ring as wide as its radius is a disc.
    sl_draw_ring(learn->ui->cairo, frame, lesson->outline.points[corner], 3 * frame->unit, colour,
                 6 * frame->unit);
}

static void above(learn_state *learn, const sl_frame *frame) {
    const lesson_state *lesson = &learn->lesson;
    const sl_fisk *f = &lesson->fisk;
    const place p = place_of(lesson);
    if (lesson->refused[0] || p.part < COLOURS) return;
    const sl_ear *last = &f->ears[f->ear_count - 1];
    draw_corner(learn, frame, last->before);
    draw_corner(learn, frame, last->after);
    for (uint32_t i = p.part == GUARDS ? 0 : p.ear; i < f->ear_count; i++)
        draw_corner(learn, frame, f->ears[i].tip);
    for (uint32_t i = 0; p.part == GUARDS && i < f->guard_count; i++)
        sl_draw_ring(learn->ui->cairo, frame, lesson->outline.points[f->guards[i]],
                     11 * frame->unit, learn->ui->palette.ink, 2.5 * frame->unit);
}

/// The first step that colours, and the guards.
static bool finds(const lesson_state *lesson, size_t step) {
    const size_t ears = lesson->fisk.ear_count;
    return !lesson->refused[0] && (step == ears + 1 || step == 2 * ears + 1);
}

const subject_row lesson_fisk = {
    .title = "n/3 guards (Fisk)",
    .record = record,
    .length = length,
    .sentence = say,
    .code = code,
    .account = account,
    .finds = finds,
    .found = "Part",
    .below = below,
    .above = above,
};

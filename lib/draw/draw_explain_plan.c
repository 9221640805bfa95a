/// What the picture of an explanation draws over the plan, mark by mark.
///
/// Those are the two cells, the portals of a sequence with their ends, and the line that passes
/// them. For a hidden pair it is the nearest miss and what stops it. That is a portal that turns
/// back; or two hulls, of left and of right ends, that meet: then no line has all left ends at its
/// left and all right ends at its right. Names and badges take the place where they cover least.
#include "draw/draw_explain.h"

#include "geometry/length.h"
#include "sightline/support.h"
#include "space/index.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

/// Radii, in units of the frame.
#define BADGE     11.0
#define MINOR_END 3.4
#define MAJOR_END 6.2

/// A place on the page that is taken.
typedef struct spot {
    sl_point at;
    double radius;
} spot;

typedef struct overlay {
    cairo_t *cairo;
    const sli_explained *pic;
    const sl_space *space;
    const sl_frame *frame;
    double unit;
    SL_ARRAY(spot) spots;
    sl_segment lines[2]; ///< that names and badges keep off
    int line_count;
} overlay;

// --- marks

static void stroke_cased(cairo_t *cairo, sl_colour casing, double around, sl_colour colour,
                         double width) {
    cairo_set_line_join(cairo, CAIRO_LINE_JOIN_ROUND);
    sli_set_faded(cairo, casing, 0.85);
    cairo_set_line_width(cairo, width + around);
    cairo_stroke_preserve(cairo);
    sli_pen_stroke(cairo, colour, width);
}

/// The pens stroke the path: the line that sees, directly or by mirror; the way of a sequence that
/// does not; a portal of the sequence; the portal that stops it.
static void pen_seen(cairo_t *cairo, const sli_explained *pic, sl_colour colour, double unit) {
    cairo_set_line_cap(cairo, CAIRO_LINE_CAP_BUTT);
    stroke_cased(cairo, pic->scene.palette.page, 3 * unit, colour, 2.4 * unit);
}

static void pen_way(cairo_t *cairo, const sli_explained *pic, double unit) {
    const double dashes[2] = {0, 4.6 * unit};
    cairo_set_line_cap(cairo, CAIRO_LINE_CAP_ROUND);
    cairo_set_line_join(cairo, CAIRO_LINE_JOIN_ROUND);
    cairo_set_dash(cairo, dashes, 2, 0);
    cairo_set_line_width(cairo, 2.4 * unit);
    sl_set_colour(cairo, pic->scene.palette.faint);
    cairo_stroke(cairo);
    cairo_set_dash(cairo, NULL, 0, 0);
}

static void pen_crossed(cairo_t *cairo, const sli_explained *pic, double unit) {
    const sl_palette *palette = &pic->scene.palette;
    cairo_set_line_cap(cairo, CAIRO_LINE_CAP_BUTT);
    stroke_cased(cairo, palette->page, 2 * unit, palette->portal, 3.2 * unit);
}

static void pen_stop(cairo_t *cairo, const sli_explained *pic, double unit) {
    const sl_palette *palette = &pic->scene.palette;
    cairo_set_line_cap(cairo, CAIRO_LINE_CAP_BUTT);
    stroke_cased(cairo, palette->ink, 3 * unit, palette->page, 3 * unit);
}

static void mark_end(cairo_t *cairo, const sli_explained *pic, sl_point at, bool left,
                     double radius) {
    sli_path_portal_end(cairo, at, left, radius);
    cairo_set_line_join(cairo, CAIRO_LINE_JOIN_MITER);
    cairo_set_line_width(cairo, 0.6 * radius);
    sl_set_colour(cairo, pic->scene.palette.page);
    cairo_stroke_preserve(cairo);
    sl_set_colour(cairo, left ? pic->left : pic->right);
    cairo_fill(cairo);
}

/// A number (from 1) in a disc; 0 for the cross of a portal that stops a sequence.
static void mark_badge(cairo_t *cairo, const sli_explained *pic, sl_point at, double radius,
                       unsigned number) {
    const sl_palette *palette = &pic->scene.palette;
    cairo_new_sub_path(cairo);
    cairo_arc(cairo, at.x, at.y, radius, 0, SLI_FULL_TURN);
    sl_set_colour(cairo, number ? palette->page : palette->ink);
    cairo_fill_preserve(cairo);
    sli_pen_stroke(cairo, number ? palette->portal : palette->page, 0.16 * radius);
    if (number) {
        char text[16];
        snprintf(text, sizeof text, "%u", number);
        sl_text_font(cairo, (number > 99 ? 0.8 : 1.15) * radius, true);
        sl_text_show(cairo, palette->ink, at.x - sl_text_width(cairo, text) / 2,
                     at.y + (number > 99 ? 0.29 : 0.42) * radius, text);
        return;
    }
    const double arm = 0.42 * radius;
    cairo_move_to(cairo, at.x - arm, at.y - arm);
    cairo_line_to(cairo, at.x + arm, at.y + arm);
    cairo_move_to(cairo, at.x - arm, at.y + arm);
    cairo_line_to(cairo, at.x + arm, at.y - arm);
    cairo_set_line_width(cairo, 0.3 * radius);
    cairo_set_line_cap(cairo, CAIRO_LINE_CAP_ROUND);
    cairo_stroke(cairo);
}

/// An arrow head at `tip` of a stroke that comes from `from`.
static void draw_head(const overlay *o, sl_point from, sl_point tip) {
    const double dx = tip.x - from.x, dy = tip.y - from.y, length = hypot(dx, dy);
    if (!(length > 0)) return;
    const double size = 9 * o->unit, ux = dx / length * size, uy = dy / length * size;
    cairo_move_to(o->cairo, tip.x + 0.6 * ux, tip.y + 0.6 * uy);
    cairo_line_to(o->cairo, tip.x - 0.6 * ux - 0.55 * uy, tip.y - 0.6 * uy + 0.55 * ux);
    cairo_line_to(o->cairo, tip.x - 0.6 * ux + 0.55 * uy, tip.y - 0.6 * uy - 0.55 * ux);
    cairo_close_path(o->cairo);
    sl_set_colour(o->cairo, o->pic->scene.palette.ink);
    cairo_fill(o->cairo);
}

// --- places

static sl_point place(const overlay *o, sl_point p) {
    return sl_frame_point(o->frame, p);
}

static const sl_directed_portal *directed_at(const overlay *o, uint32_t number) {
    return &o->space->directed[o->pic->sequence->directed[number]];
}

static sl_point middle(sl_point a, sl_point b) {
    return (sl_point){a.x + (b.x - a.x) / 2, a.y + (b.y - a.y) / 2};
}

/// Room for all spots was made before.
static void take_spot(overlay *o, sl_point at, double radius) {
    o->spots.items[o->spots.count++] = (spot){at, radius};
}

/// How much a disc there would cover of places that are taken; 0 for nothing.
static double crowding(const overlay *o, sl_point at, double radius) {
    const double gap = 1.5 * o->unit;
    double sum = 0;
    for (size_t i = 0; i < o->spots.count; i++) {
        const spot *s = &o->spots.items[i];
        sum += fmax(0, radius + s->radius + gap - hypot(at.x - s->at.x, at.y - s->at.y));
    }
    for (int i = 0; i < o->line_count; i++)
        sum += fmax(0, radius + 2 * gap - sli_away_from(o->lines[i].a, o->lines[i].b, at));
    const sl_frame *v = o->frame;
    const bool inside = at.x - radius > v->left && at.x + radius < v->left + v->width &&
                        at.y - radius > v->top && at.y + radius < v->top + v->height;
    return inside ? sum : sum + 4 * radius;
}

// --- the steps

static void draw_sequence(const overlay *o) {
    const sl_sequence *sequence = o->pic->sequence;
    const uint32_t last = sequence->directed_count - 1;
    for (uint32_t i = 0; i <= last; i++) {
        sl_path_segment(o->cairo, o->frame, directed_at(o, i)->left, directed_at(o, i)->right);
        if (o->pic->miss && i == last)
            pen_stop(o->cairo, o->pic, o->unit);
        else
            pen_crossed(o->cairo, o->pic, o->unit);
    }
}

static sl_point portal_middle(const sl_directed_portal *directed) {
    return middle(directed->left, directed->right);
}

/// The control point of a stroke that crosses a portal at right angles: from the portal's middle
/// into the cell, along its normal. `sign` is 1 in the direction of the directed portal.
static sl_point bend(const overlay *o, uint32_t cell, const sl_directed_portal *directed,
                     double sign, double reach) {
    const sl_point at = portal_middle(directed);
    const double along_x = directed->left.x - directed->right.x,
                 along_y = directed->left.y - directed->right.y;
    const double width = hypot(along_x, along_y);
    const sl_point forward = {sign * along_y / width, -sign * along_x / width};
    const double length = fmin(reach, 0.9 * sli_ray_length(o->space, cell, at, forward));
    return (sl_point){at.x + forward.x * length, at.y + forward.y * length};
}

/// From the middle of the first cell from portal to portal, as far as the sequence goes.
static void draw_way(const overlay *o) {
    uint32_t cell = o->pic->explanation->from;
    sl_point start = sl_space_middle(o->space, cell), leave = start;
    for (uint32_t i = 0; i < o->pic->sequence->directed_count; i++) {
        const sl_directed_portal *directed = directed_at(o, i);
        const sl_point end = portal_middle(directed);
        const double reach = 0.4 * hypot(end.x - start.x, end.y - start.y);
        if (i > 0) leave = bend(o, cell, directed_at(o, i - 1), 1, reach);
        const sl_point controls[4] = {start, leave, bend(o, cell, directed, -1, reach), end};
        sli_path_curve(o->cairo, o->frame, controls);
        start = end;
        cell = directed->cell;
    }
    pen_way(o->cairo, o->pic, o->unit);
}

static void draw_line(overlay *o) {
    const sl_segment line = o->pic->explanation->shown;
    const sl_point from = place(o, line.a), to = place(o, line.b);
    o->lines[o->line_count++] = (sl_segment){from, to};
    cairo_move_to(o->cairo, from.x, from.y);
    cairo_line_to(o->cairo, to.x, to.y);
    pen_seen(o->cairo, o->pic, o->pic->scene.palette.ink, o->unit);
    draw_head(o, from, to);
}

/// The line that sees by mirror, from bend to bend.
static void draw_bent(const overlay *o) {
    const sl_bent_sightline *bent = &o->pic->explanation->bent;
    if (!bent->bends) return;
    for (uint32_t i = 0; i < bent->mirrors + 2; i++) {
        const sl_point at = place(o, bent->bends[i]);
        cairo_line_to(o->cairo, at.x, at.y);
    }
    pen_seen(o->cairo, o->pic, o->pic->scene.palette.mirrored, o->unit);
    draw_head(o, place(o, bent->bends[bent->mirrors]), place(o, bent->bends[bent->mirrors + 1]));
}

/// Which way a portal is crossed: an arrow through its middle.
static void draw_crossing(const overlay *o, uint32_t number) {
    const sl_directed_portal *directed = directed_at(o, number);
    const sl_point left = place(o, directed->left), right = place(o, directed->right);
    const sl_point at = middle(left, right);
    const double length = hypot(left.x - right.x, left.y - right.y), reach = 30 * o->unit;
    // On the page y runs down: forwards is from left to right, turned counter-clockwise as seen.
    const double dx = (right.y - left.y) / length * reach, dy = (left.x - right.x) / length * reach;
    const sl_point from = {at.x - dx, at.y - dy}, to = {at.x + dx, at.y + dy};
    cairo_move_to(o->cairo, from.x, from.y);
    cairo_line_to(o->cairo, to.x, to.y);
    pen_seen(o->cairo, o->pic, o->pic->scene.palette.ink, o->unit);
    draw_head(o, from, to);
}

/// The places of the ends of one side that decide. Returns how many.
static int deciding_places(const overlay *o, bool left, sl_point places[SL_CONFLICT_MOST]) {
    const sl_sequence *sequence = o->pic->sequence;
    int count = 0;
    for (uint32_t i = 0; i < sequence->end_count; i++)
        if (sequence->ends[i].left == left)
            places[count++] = place(o, sl_sequence_end(o->space, sequence, sequence->ends[i]));
    return count;
}

static void draw_hull(const overlay *o, bool left) {
    sl_point places[SL_CONFLICT_MOST], sum = {0, 0};
    const int count = deciding_places(o, left, places);
    for (int i = 0; i < count; i++) {
        sum.x += places[i].x / count;
        sum.y += places[i].y / count;
    }
    // Each of few corners is one of the hull's: by angle about their middle they go round it.
    for (int i = 1; i < count; i++)
        for (int k = i; k > 0 && atan2(places[k - 1].y - sum.y, places[k - 1].x - sum.x) >
                                     atan2(places[k].y - sum.y, places[k].x - sum.x);
             k--) {
            const sl_point swapped = places[k];
            places[k] = places[k - 1];
            places[k - 1] = swapped;
        }
    const sl_colour c = left ? o->pic->left : o->pic->right;
    for (int i = 0; i < count; i++) cairo_line_to(o->cairo, places[i].x, places[i].y);
    cairo_close_path(o->cairo);
    sli_set_faded(o->cairo, c, 0.22);
    cairo_fill_preserve(o->cairo);
    cairo_set_line_cap(o->cairo, CAIRO_LINE_CAP_ROUND);
    stroke_cased(o->cairo, o->pic->scene.palette.page, 2 * o->unit, c, 3 * o->unit);
}

/// A ring where the segments between the ends of either side cross.
static void draw_meeting(overlay *o) {
    sl_point a[SL_CONFLICT_MOST], b[SL_CONFLICT_MOST];
    if (deciding_places(o, true, a) != 2 || deciding_places(o, false, b) != 2) return;
    const double ax = a[1].x - a[0].x, ay = a[1].y - a[0].y;
    const double bx = b[1].x - b[0].x, by = b[1].y - b[0].y, turn = ax * by - ay * bx;
    const double share = ((b[0].x - a[0].x) * by - (b[0].y - a[0].y) * bx) / turn;
    if (!(share >= 0 && share <= 1)) return;
    const sl_point at = {a[0].x + share * ax, a[0].y + share * ay};
    cairo_new_sub_path(o->cairo);
    cairo_arc(o->cairo, at.x, at.y, 8 * o->unit, 0, SLI_FULL_TURN);
    stroke_cased(o->cairo, o->pic->scene.palette.page, 2.4 * o->unit, o->pic->scene.palette.ink,
                 1.8 * o->unit);
    take_spot(o, at, 8 * o->unit);
    o->lines[o->line_count++] = (sl_segment){a[0], a[1]};
    o->lines[o->line_count++] = (sl_segment){b[0], b[1]};
}

static void draw_ends(overlay *o) {
    const sl_sequence *sequence = o->pic->sequence;
    for (uint32_t i = 0; i < sequence->directed_count; i++) {
        const sl_point left = place(o, directed_at(o, i)->left),
                       right = place(o, directed_at(o, i)->right);
        mark_end(o->cairo, o->pic, left, true, MINOR_END * o->unit);
        mark_end(o->cairo, o->pic, right, false, MINOR_END * o->unit);
        take_spot(o, left, MINOR_END * o->unit);
        take_spot(o, right, MINOR_END * o->unit);
    }
    if (o->pic->miss && o->pic->miss->turns) return;
    for (uint32_t i = 0; i < sequence->end_count; i++) {
        const sl_point p = place(o, sl_sequence_end(o->space, sequence, sequence->ends[i]));
        // Where ends of both sides coincide the right one's corners look out behind the left one.
        const double radius = sequence->ends[i].left ? MAJOR_END : 1.1 * MAJOR_END;
        if (sequence->ends[i].left) continue;
        mark_end(o->cairo, o->pic, p, false, radius * o->unit);
        take_spot(o, p, radius * o->unit);
    }
    for (uint32_t i = 0; i < sequence->end_count; i++) {
        if (!sequence->ends[i].left) continue;
        const sl_point p = place(o, sl_sequence_end(o->space, sequence, sequence->ends[i]));
        mark_end(o->cairo, o->pic, p, true, MAJOR_END * o->unit);
        take_spot(o, p, MAJOR_END * o->unit);
    }
}

/// Puts a badge beside its portal, where it covers least.
static void draw_badge(overlay *o, uint32_t number) {
    const sl_directed_portal *directed = directed_at(o, number);
    const sl_point left = place(o, directed->left), right = place(o, directed->right);
    const sl_point at = middle(left, right);
    const double radius = BADGE * o->unit, half = hypot(left.x - right.x, left.y - right.y) / 2;
    const double ux = (left.x - at.x) / half, uy = (left.y - at.y) / half;
    sl_point best = at;
    double least = crowding(o, at, radius);
    for (int ring = 0; ring < 4; ring++)
        for (int side = 0; side < 8 && least > 0; side++) {
            // Beyond the ends, before and behind the portal, and between.
            const double away = (1.5 + 1.2 * ring) * radius, turn = side * SLI_FULL_TURN / 8;
            const double along = cos(turn) * (away + half * fabs(cos(turn)));
            const double across = sin(turn) * away;
            const sl_point tried = {at.x + along * ux - across * uy,
                                    at.y + along * uy + across * ux};
            // Rather before than behind, so that the badges of portals close together keep order.
            const double detour = (0.15 * ring + (across > 0 ? 0.1 : 0)) * radius;
            const double covered = crowding(o, tried, radius) + detour;
            if (covered >= least) continue;
            least = covered;
            best = tried;
        }
    if (sli_away_from(left, right, best) > 1.8 * radius) {
        cairo_move_to(o->cairo, best.x, best.y);
        cairo_line_to(o->cairo, at.x, at.y);
        sli_pen_stroke(o->cairo, o->pic->scene.palette.portal, o->unit);
    }
    const bool stops = o->pic->miss && number + 1 == o->pic->sequence->directed_count;
    mark_badge(o->cairo, o->pic, best, radius, stops ? 0 : number + 1);
    take_spot(o, best, radius);
}

static void draw_name(overlay *o, uint32_t cell, sl_colour colour) {
    char text[32];
    snprintf(text, sizeof text, "%u", cell);
    const double size = 17 * o->unit;
    sl_text_font(o->cairo, size, true);
    const double width = sl_text_width(o->cairo, text);
    const sl_point at = place(o, sl_space_middle(o->space, cell));
    // Below and above, where the middle is taken by the line or by a portal's marks.
    static const double steps[] = {0, 1.1, -1.1, 2.2, -2.2};
    double least = INFINITY;
    sl_point best = at;
    for (int i = 0; i < 5; i++) {
        const sl_point tried = {at.x, at.y + steps[i] * size};
        const double covered = crowding(o, tried, width / 2);
        if (covered >= least) continue;
        least = covered;
        best = tried;
    }
    cairo_move_to(o->cairo, best.x - width / 2, best.y + 0.36 * size);
    cairo_text_path(o->cairo, text);
    sl_set_colour(o->cairo, o->pic->scene.palette.page);
    cairo_set_line_width(o->cairo, 0.26 * size);
    cairo_set_line_join(o->cairo, CAIRO_LINE_JOIN_ROUND);
    cairo_stroke_preserve(o->cairo);
    sl_set_colour(o->cairo, colour);
    cairo_fill(o->cairo);
    take_spot(o, best, width / 2);
}

static void draw_sequence_marks(overlay *o) {
    const sli_explained *pic = o->pic;
    const sl_sequence *sequence = pic->sequence;
    draw_sequence(o);
    if (pic->miss)
        draw_way(o);
    else
        draw_line(o);
    if (pic->miss && pic->miss->turns) {
        draw_crossing(o, sequence->ends[0].portal);
        draw_crossing(o, sequence->directed_count - 1);
    } else if (pic->miss) {
        draw_hull(o, true);
        draw_hull(o, false);
        draw_meeting(o);
    }
    draw_ends(o);
}

sl_status sli_explained_over_plan(sl_context *context, cairo_t *cairo, const sli_explained *pic,
                                  const sl_frame *frame) {
    overlay o = {.cairo = cairo,
                 .pic = pic,
                 .space = &pic->scene.baked->space,
                 .frame = frame,
                 .unit = frame->unit};
    const sl_explanation *e = pic->explanation;
    const sl_sequence *sequence = pic->sequence;
    // Two names, a ring, and of each portal two ends, which may be marked twice, and a badge.
    const size_t spots =
        3 + (sequence ? 3 * (size_t)sequence->directed_count + SL_CONFLICT_MOST : 0);
    SL_TRY(SL_ARRAY_ROOM(context, &o.spots, spots));
    cairo_save(cairo);
    cairo_rectangle(cairo, frame->left, frame->top, frame->width, frame->height);
    if (pic->part) cairo_clip(cairo);
    cairo_new_path(cairo);
    const sl_status status =
        sl_draw_plan(context, cairo, &pic->scene, pic->scene.options.layers, frame);
    if (status == SL_OK) {
        if (sequence) draw_sequence_marks(&o);
        draw_bent(&o);
        draw_name(&o, e->from, pic->scene.palette.source_edge);
        if (e->from != e->to) draw_name(&o, e->to, pic->target);
        for (uint32_t i = 0; sequence && i < sequence->directed_count; i++) draw_badge(&o, i);
    }
    cairo_restore(cairo);
    sl_free(context, o.spots.items);
    return status;
}

void sli_explained_swatch(cairo_t *cairo, const sli_explained *pic, sli_swatch what, double left,
                          double middle, double size) {
    const double right = left + 2 * size, unit = size / 14;
    const sl_point at = {left + size, middle};
    if (what == SLI_LEFT_END || what == SLI_RIGHT_END) {
        mark_end(cairo, pic, at, what == SLI_LEFT_END, 0.42 * size);
        return;
    }
    cairo_move_to(cairo, left, middle);
    cairo_line_to(cairo, right, middle);
    if (what == SLI_SIGHTLINE) pen_seen(cairo, pic, pic->scene.palette.ink, unit);
    if (what == SLI_WAY) pen_way(cairo, pic, unit);
    if (what == SLI_BENT) pen_seen(cairo, pic, pic->scene.palette.mirrored, unit);
    if (what == SLI_CROSSED) pen_crossed(cairo, pic, unit);
    if (what == SLI_STOP) pen_stop(cairo, pic, unit);
    if (what == SLI_CROSSED || what == SLI_STOP)
        mark_badge(cairo, pic, at, 0.6 * size, what == SLI_CROSSED ? 1 : 0);
}

/// The places of a chart's labels.
///
/// Labels are placed one by one, each at the free place whose line to its mark is shortest: beside
/// the mark, or in rows over and under it. A place is free where the label overlaps no obstacle and
/// no label, and where lines cross nothing. The greedy order matters, so that labels which found no
/// room get the first turns in the next attempt; of all attempts the best is kept. Each attempt
/// costs labels x places x (obstacles + labels).
#include "draw/chart.h"

#include <math.h>
#include <stdint.h>

/// Labels take turns. Those before `turn` have their places, or found none.
typedef struct placing {
    const sli_label_room *room;
    sli_label *labels;
    size_t count, turn;
} placing;

static sli_label *label_at(const placing *p, size_t turn) {
    return &p->labels[p->labels[turn].turn];
}

static bool overlap(sl_box a, sl_box b, double gap) {
    return a.min.x < b.max.x + gap && b.min.x < a.max.x + gap && a.min.y < b.max.y + gap &&
           b.min.y < a.max.y + gap;
}

static bool holds(sl_box box, sl_point p) {
    return p.x >= box.min.x && p.x <= box.max.x && p.y >= box.min.y && p.y <= box.max.y;
}

/// Narrows [*from, *to] to where `start + t * step` lies in [low, high].
static void narrow(double start, double step, double low, double high, double *from, double *to) {
    if (step == 0) {
        if (start < low || start > high) *to = -1;
        return;
    }
    const double a = (low - start) / step, b = (high - start) / step;
    *from = fmax(*from, fmin(a, b));
    *to = fmin(*to, fmax(a, b));
}

static bool line_meets_box(sl_point p, sl_point q, sl_box box) {
    double from = 0, to = 1;
    narrow(p.x, q.x - p.x, box.min.x, box.max.x, &from, &to);
    narrow(p.y, q.y - p.y, box.min.y, box.max.y, &from, &to);
    return from <= to;
}

static sl_box grown(sl_box box, double by) {
    return (sl_box){{box.min.x - by, box.min.y - by}, {box.max.x + by, box.max.y + by}};
}

static double side(sl_point a, sl_point b, sl_point p) {
    return (b.x - a.x) * (p.y - a.y) - (b.y - a.y) * (p.x - a.x);
}

static bool lines_cross(sl_point a, sl_point b, sl_point c, sl_point d) {
    return side(a, b, c) * side(a, b, d) < 0 && side(c, d, a) * side(c, d, b) < 0;
}

/// Whether a label may stand where `tried` says.
static bool stands_free(const placing *p, const sli_label *tried) {
    const sli_label_room *room = p->room;
    const sl_box *frame = &room->frame, *box = &tried->box;
    if (box->min.x < frame->min.x || box->max.x > frame->max.x || box->min.y < frame->min.y ||
        box->max.y > frame->max.y)
        return false;
    for (size_t i = 0; i < room->obstacle_count; i++) {
        const sli_obstacle *o = &room->obstacles[i];
        if (overlap(*box, o->box, room->gap)) return false;
        if (!o->lines_cross && o->owner != p->labels[p->turn].turn &&
            !holds(o->box, tried->anchor) && line_meets_box(tried->anchor, tried->knee, o->box))
            return false;
    }
    for (size_t i = 0; i < p->turn; i++) {
        const sli_label *other = label_at(p, i);
        if (!other->placed) continue;
        if (overlap(*box, other->box, room->gap) ||
            line_meets_box(tried->anchor, tried->knee, other->box) ||
            line_meets_box(other->anchor, other->knee, grown(*box, room->gap / 2)) ||
            lines_cross(tried->anchor, tried->knee, other->anchor, other->knee))
            return false;
    }
    return true;
}

/// The label with its left edge at `left`, `away` over its anchor, or under it.
static sli_label put(const sli_label *label, double left, double away, bool over) {
    sli_label put = *label;
    put.placed = true;
    put.box.min.x = left;
    put.box.max.x = left + label->width;
    put.box.min.y = over ? label->anchor.y - away - label->height : label->anchor.y + away;
    put.box.max.y = put.box.min.y + label->height;
    const double inset = fmin(label->height, label->width) / 4;
    put.knee.x = fmin(fmax(label->anchor.x, put.box.min.x + inset), put.box.max.x - inset);
    put.knee.y = over ? put.box.max.y : put.box.min.y;
    return put;
}

/// At the anchor's own height, right or left of it.
static sli_label put_beside(const sli_label *label, double clearance, bool right) {
    const double x = label->anchor.x;
    sli_label beside =
        put(label, right ? x + clearance : x - clearance - label->width, -label->height / 2, true);
    beside.knee = (sl_point){right ? beside.box.min.x : beside.box.max.x, label->anchor.y};
    return beside;
}

typedef struct choice {
    sli_label label;
    double cost;
} choice;

static void consider(const placing *p, const sli_label *tried, double cost, choice *best) {
    if (cost >= best->cost || !stands_free(p, tried)) return;
    *best = (choice){*tried, cost};
}

/// How many labels without a place a box `away` from its anchor would shut in. Of those with
/// anchors within its width, half may go to the other side, and some fit between.
static double count_shut_in(const placing *p, const sl_box *box, double away) {
    const double height = box->max.y - box->min.y + p->room->gap;
    size_t within = 0;
    for (size_t i = p->turn + 1; i < p->count; i++) {
        const double x = label_at(p, i)->anchor.x;
        within += x > box->min.x - p->room->gap && x < box->max.x + p->room->gap;
    }
    return fmax(0, (double)within / 2 - floor((away - p->room->clearance) / height));
}

/// The left edges that a label may have: shifted by quarters of its width; like a flag, with an
/// upright line at one end; beside its anchor on either side.
enum { QUARTERS = 6, LEFTS = 2 * QUARTERS + 1 + 4 };

static void list_lefts(const sli_label *label, double clearance, double lefts[LEFTS]) {
    const double x = label->anchor.x, width = label->width, end = label->height / 4;
    for (int i = 0; i <= 2 * QUARTERS; i++) lefts[i] = x + ((i - QUARTERS) / 4.0 - 0.5) * width;
    lefts[LEFTS - 4] = x - end;
    lefts[LEFTS - 3] = x - width + end;
    lefts[LEFTS - 2] = x + clearance;
    lefts[LEFTS - 1] = x - width - clearance;
}

/// Tries all places, beside the anchor and in rows over and under it. Takes the free one with the
/// shortest line. Slanting lines cost more, and so does shutting others in.
static void place(const placing *p, sli_label *label) {
    const sl_box *frame = &p->room->frame;
    const double clearance = p->room->clearance, reach = frame->max.y - frame->min.y;
    const double step = fmax(label->height / 3, 1);
    double lefts[LEFTS];
    choice best = {*label, INFINITY};
    for (int right = 1; right >= 0; right--) {
        const sli_label tried = put_beside(label, clearance, right);
        consider(p, &tried, clearance + 0.1 * label->height, &best);
    }
    list_lefts(label, clearance, lefts);
    for (double away = clearance; away < reach && away < best.cost; away += step) {
        for (int i = 0; i < 2 * LEFTS; i++) {
            const sli_label tried = put(label, lefts[i / 2], away, i % 2 == 0);
            const double middle = (tried.box.min.x + tried.box.max.x) / 2;
            const double slant = fabs(tried.knee.x - label->anchor.x);
            const double off = fabs(middle - label->anchor.x) / label->width;
            const double shut_in = count_shut_in(p, &tried.box, away);
            const double cost = away + slant + (0.05 * off + 2 * shut_in) * label->height;
            consider(p, &tried, cost, &best);
        }
    }
    *label = best.label;
}

/// Returns how many found no room.
static size_t place_all(placing *p) {
    size_t left_out = 0;
    for (p->turn = 0; p->turn < p->count; p->turn++) {
        sli_label *label = label_at(p, p->turn);
        label->placed = false;
        place(p, label);
        left_out += !label->placed;
    }
    return left_out;
}

/// Gives the first turns to labels that found no room; else keeps the order.
static void promote_left_out(const placing *p) {
    size_t front = 0;
    for (size_t i = 0; i < p->count; i++) {
        const size_t number = p->labels[i].turn;
        if (p->labels[number].placed) continue;
        for (size_t k = i; k > front; k--) p->labels[k].turn = p->labels[k - 1].turn;
        p->labels[front++].turn = number;
    }
}

enum { ATTEMPTS = 24 };

bool sli_labels_place(sli_label *labels, size_t count, const sli_label_room *room) {
    placing p = {.room = room, .labels = labels, .count = count};
    size_t least = SIZE_MAX;
    for (size_t i = 0; i < count; i++) labels[i].turn = i;
    for (int attempt = 0; attempt < ATTEMPTS && least > 0; attempt++) {
        const size_t left_out = place_all(&p);
        if (left_out < least)
            for (size_t i = 0; i < count; i++) labels[i].best_turn = labels[i].turn;
        if (left_out < least) least = left_out;
        promote_left_out(&p);
    }
    if (least > 0) {
        for (size_t i = 0; i < count; i++) labels[i].turn = labels[i].best_turn;
        place_all(&p);
    }
    return least == 0;
}

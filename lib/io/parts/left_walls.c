/// Which lines of a layer or a look part rooms, and whether much of it does.
///
///     +--------------------+
///     |        |     ||    |
///     |        |     |+--  |
///     |  ---+  |     +---  |
///     |     |  |           |
///     +--------------------+
///
/// First goes what runs along walls (plaster, counters, wardrobes), and what crosses them (axes,
/// wires, dimensions). Then there are two ways to be walls:
///
/// 1. Chains of lines lead from wall to wall. They are what is left if rows of lines (steps, tiles)
///    are taken away, and lines with a free end, again and again. This finds plans without doors.
/// 2. Lines stand side by side, far longer than they are apart, and most at one distance, as the
///    faces of walls do. The ends of some walls that are taken stand at them.
///
/// A drawing has furniture, dimensions and wires that do so here and there. So a layer or look is
/// one of walls only if much of it is.
#include "io/parts/left_out.h"

/// How near to a wall lines along it are no walls, how far a chain leads that parts rooms, and how
/// far apart the faces of a wall are: in metres, and as shares of the drawing.
static const double BESIDE = 0.9, BESIDE_SHARE = 1.0 / 30;
static const double LONG = 1.5, LONG_SHARE = 1.0 / 20;
static const double FACES = 0.4, FACES_SHARE = 1.0 / 60;
/// Faces are so many times as long as they are apart.
static const double SLENDER = 3;
/// How much of a kind parts rooms: lengths as shares of the drawing's, and of all of the kind.
static const double LEAST = 0.3, CHAINS = 0.4, PAIRS = 0.5;
/// How much distances differ that are the same.
static const double SAME = 0.05;
enum {
    ROUNDS = 64,      ///< of taking away
    LEAST_CHAINS = 4, ///< lines
    LEAST_PAIRED = 8, ///< lines
    LEAST_ENDS = 3,   ///< of walls, at these
    BINS = 64,        ///< of distances
    MOST_NEAR = 1 << 22
};

/// Two lines that touch.
typedef struct joint {
    uint32_t line, other;
    bool end; ///< of `line`: its second one
} joint;

/// Of a wall that is drawn, if it is of the kind.
typedef struct line_look {
    bool plain;          ///< neither along walls nor across them
    bool alive;          ///< plain, in no row, and not taken away
    bool on[2], held[2]; ///< which ends are on walls, which on anything
    double apart;        ///< how far away its other face is; 0 for none
    double next[2];      ///< how far away the next line of its length is on each side
    sl_box box;          ///< of a piece: about the places where it touches walls
} line_look;

typedef struct finder {
    sli_left_out *left;
    SL_ARRAY(uint32_t) own; ///< the lines of the kind
    double all;             ///< how long these are
    line_look *lines;       ///< by wall
    uint32_t *pieces;       ///< disjoint sets of walls
    SL_ARRAY(joint) joints;
    size_t near; ///< walls that were near others
} finder;

static const sl_wall *wall_of(const finder *f, uint32_t number) {
    return &f->left->map->walls[number];
}

static double length_of(const finder *f, uint32_t number) {
    return sli_wall_length(wall_of(f, number));
}

/// Whether lines cross each other, farther from all ends than `off`.
static bool is_crossing(const sl_wall *p, const sl_wall *q, double off) {
    const sl_point u = {p->b.x - p->a.x, p->b.y - p->a.y};
    const sl_point v = {q->b.x - q->a.x, q->b.y - q->a.y};
    const sl_point from = {q->a.x - p->a.x, q->a.y - p->a.y};
    const double across = sli_cross(u, v), a = sli_wall_length(p), b = sli_wall_length(q);
    if (!(fabs(across) > SLI_LEFT_OUT_TURN * a * b)) return false;
    const double s = sli_cross(from, v) / across * a, t = sli_cross(from, u) / across * b;
    return s > off && s < a - off && t > off && t < b - off;
}

/// Keeps how far away the other face of a line is, and the next lines on both sides.
static void keep_beside(finder *f, uint32_t i, uint32_t other, double left, double both) {
    const double away = fabs(left), length = length_of(f, i), next = length_of(f, other);
    double *side = &f->lines[i].next[left > 0];
    if (both >= 0.8 * fmax(length, next) && !(*side > 0 && *side < away)) *side = away;
    if (away <= sli_left_out_scaled(f->left, FACES, FACES_SHARE) && both >= SLENDER * away &&
        2 * both >= fmin(length, next) && !(f->lines[i].apart > 0 && f->lines[i].apart < away))
        f->lines[i].apart = away;
}

/// Whether a line may be a wall by what is beside it.
static sl_status look_beside(finder *f, uint32_t i) {
    sli_left_out *left = f->left;
    const sl_wall *line = wall_of(f, i);
    const double beside = sli_left_out_scaled(left, BESIDE, BESIDE_SHARE);
    double covered = 0;
    size_t crossed = 0;
    SL_TRY(sli_walls_near(left->context, &left->index, (sl_segment){line->a, line->b}, beside));
    f->near += left->index.near.count;
    for (size_t k = 0; k < left->index.near.count; k++) {
        const uint32_t j = left->index.near.items[k];
        const bool wall = sl_bits_has(left->walls, j);
        double at = 0;
        if (j == i || (!wall && left->kinds[j] != left->kinds[i])) continue;
        // One wall crossed is enough, and two lines of the kind.
        if (is_crossing(line, wall_of(f, j), left->off + left->pens[j])) crossed += wall ? 2 : 1;
        const double both = sli_left_out_along(line, wall_of(f, j), &at);
        if (!(both > 0) || fabs(at) > beside) continue;
        if (wall)
            covered += both;
        else if (fabs(at) > left->off)
            keep_beside(f, i, j, at, both);
    }
    f->lines[i].plain = 2 * covered < length_of(f, i) && crossed < 2;
    return SL_OK;
}

static bool is_same(double a, double b) {
    return a > 0 && fabs(a - b) <= SAME * a;
}

/// Whether a line is of a row: it has lines on both sides at one distance, or it is the first or
/// last one beside such a line.
static sl_status is_in_row(finder *f, uint32_t i, bool *in) {
    sli_left_out *left = f->left;
    const double *own = f->lines[i].next, reach = fmax(own[0], own[1]);
    *in = is_same(own[0], own[1]);
    if (*in || !(reach > 0)) return SL_OK;
    const sl_segment at = {wall_of(f, i)->a, wall_of(f, i)->b};
    SL_TRY(sli_walls_near(left->context, &left->index, at, reach + left->off));
    f->near += left->index.near.count;
    for (size_t k = 0; k < left->index.near.count && !*in; k++) {
        const uint32_t j = left->index.near.items[k];
        const double *next = f->lines[j].next;
        double away = 0;
        if (left->kinds[j] != left->kinds[i] || !is_same(next[0], next[1])) continue;
        *in = sli_left_out_along(wall_of(f, i), wall_of(f, j), &away) > 0 &&
              is_same(next[0], fabs(away));
    }
    return SL_OK;
}

// --- chains from wall to wall

/// What an end touches: walls, and lines of the kind.
static sl_status look_at_end(finder *f, uint32_t i, int which) {
    sli_left_out *left = f->left;
    const sl_point end = which ? wall_of(f, i)->b : wall_of(f, i)->a;
    SL_TRY(sli_left_out_near(left, end));
    f->near += left->index.near.count;
    for (size_t k = 0; k < left->index.near.count; k++) {
        const uint32_t j = left->index.near.items[k];
        const bool wall = sl_bits_has(left->walls, j);
        const double off = left->off + (wall ? left->pens[j] : 0);
        if (j == i || (!wall && !f->lines[j].alive)) continue;
        if (sli_away_from(wall_of(f, j)->a, wall_of(f, j)->b, end) > off) continue;
        f->lines[i].on[which] |= wall;
        if (wall) continue;
        SL_TRY(SL_ARRAY_ROOM(left->context, &f->joints, 1));
        f->joints.items[f->joints.count++] = (joint){i, j, which};
    }
    return SL_OK;
}

/// Takes away what has a free end, again and again.
static void prune(finder *f) {
    bool changes = true;
    for (int round = 0; round < ROUNDS && changes; round++) {
        changes = false;
        for (size_t n = 0; n < f->own.count; n++)
            for (int k = 0; k < 2; k++)
                f->lines[f->own.items[n]].held[k] = f->lines[f->own.items[n]].on[k];
        for (size_t k = 0; k < f->joints.count; k++) {
            const joint *j = &f->joints.items[k];
            f->lines[j->line].held[j->end] |= f->lines[j->other].alive;
        }
        for (size_t n = 0; n < f->own.count; n++) {
            const uint32_t i = f->own.items[n];
            if (!f->lines[i].alive || (f->lines[i].held[0] && f->lines[i].held[1])) continue;
            f->lines[i].alive = false;
            changes = true;
        }
    }
}

/// Joins what touches to pieces, and puts boxes about the places where these touch walls.
static void find_pieces(finder *f) {
    for (size_t n = 0; n < f->own.count; n++) {
        const uint32_t i = f->own.items[n];
        f->pieces[i] = i;
        f->lines[i].box = (sl_box){{INFINITY, INFINITY}, {-INFINITY, -INFINITY}};
    }
    for (size_t k = 0; k < f->joints.count; k++) {
        const joint *j = &f->joints.items[k];
        if (!f->lines[j->line].alive || !f->lines[j->other].alive) continue;
        f->pieces[sl_root_of(f->pieces, j->line)] = sl_root_of(f->pieces, j->other);
    }
    for (size_t n = 0; n < f->own.count; n++) {
        const uint32_t i = f->own.items[n];
        sl_box *box = &f->lines[sl_root_of(f->pieces, i)].box;
        if (f->lines[i].alive && f->lines[i].on[0]) *box = sli_box_with(*box, wall_of(f, i)->a);
        if (f->lines[i].alive && f->lines[i].on[1]) *box = sli_box_with(*box, wall_of(f, i)->b);
    }
}

/// Whether a line is of a piece that leads far enough from wall to wall, or has a second face.
static bool parts_rooms(finder *f, uint32_t i) {
    if (!f->lines[i].alive) return false;
    const sl_box box = f->lines[sl_root_of(f->pieces, i)].box;
    const double wide = fmax(box.max.x - box.min.x, box.max.y - box.min.y);
    return wide >= sli_left_out_scaled(f->left, LONG, LONG_SHARE) ||
           (wide > 0 && f->lines[i].apart > 0);
}

/// Counts the lines of chains, where they are much of the kind.
static sl_status count_chains(finder *f, size_t *count) {
    double length = 0;
    size_t lines = 0;
    for (size_t n = 0; n < f->own.count && f->near <= MOST_NEAR; n++)
        for (int k = 0; f->lines[f->own.items[n]].alive && k < 2; k++)
            SL_TRY(look_at_end(f, f->own.items[n], k));
    if (f->near > MOST_NEAR) return SL_OK;
    prune(f);
    find_pieces(f);
    for (size_t n = 0; n < f->own.count; n++) {
        if (!parts_rooms(f, f->own.items[n])) continue;
        lines++;
        length += length_of(f, f->own.items[n]);
    }
    if (lines >= LEAST_CHAINS && length >= LEAST * f->left->size && length >= CHAINS * f->all)
        *count = lines;
    return SL_OK;
}

// --- pairs

/// Whether a point is on a line, away from its ends.
static bool is_amid(const sl_wall *line, sl_point at, double off) {
    const double length = sli_wall_length(line);
    return sli_away_from(line->a, line->b, at) <= off &&
           sli_length(line->a.x - at.x, line->a.y - at.y) > 0.05 * length &&
           sli_length(line->b.x - at.x, line->b.y - at.y) > 0.05 * length;
}

/// How many ends of walls that touch no other wall stand at paired lines of the kind.
static sl_status count_ends(finder *f, uint32_t kind, size_t *count) {
    sli_left_out *left = f->left;
    for (uint32_t i = 0; i < (uint32_t)left->map->wall_count; i++) {
        if (!sl_bits_has(left->walls, i) || !(length_of(f, i) > 0)) continue;
        for (int which = 0; which < 2 && f->near <= MOST_NEAR; which++) {
            const sl_point end = which ? wall_of(f, i)->b : wall_of(f, i)->a;
            bool free = true, at = false;
            SL_TRY(sli_left_out_near(left, end));
            f->near += left->index.near.count;
            for (size_t k = 0; k < left->index.near.count; k++) {
                const uint32_t j = left->index.near.items[k];
                const sl_wall *other = wall_of(f, j);
                if (j != i && sl_bits_has(left->walls, j))
                    free &= sli_away_from(other->a, other->b, end) > left->off + left->pens[j];
                else if (left->kinds[j] == kind && f->lines[j].plain && f->lines[j].apart > 0)
                    at |= is_amid(other, end, left->off + left->pens[i]);
            }
            *count += free && at;
        }
    }
    return SL_OK;
}

/// Counts lines side by side, where they are most of the kind, and most of them at one distance.
static sl_status count_pairs(finder *f, uint32_t kind, size_t *count) {
    const double faces = sli_left_out_scaled(f->left, FACES, FACES_SHARE);
    double bins[BINS + 2] = {0}, length = 0, most = 0;
    size_t lines = 0, ends = 0;
    for (size_t n = 0; n < f->own.count; n++) {
        const uint32_t i = f->own.items[n];
        if (!f->lines[i].plain || !(f->lines[i].apart > 0)) continue;
        lines++;
        length += length_of(f, i);
        bins[1 + (int)(f->lines[i].apart / faces * (BINS - 1))] += length_of(f, i);
    }
    for (int i = 1; i <= BINS; i++) most = fmax(most, bins[i - 1] + bins[i] + bins[i + 1]);
    if (lines < LEAST_PAIRED || length < LEAST * f->left->size || length < PAIRS * f->all ||
        2 * most < length)
        return SL_OK;
    SL_TRY(count_ends(f, kind, &ends));
    if (ends >= LEAST_ENDS && f->near <= MOST_NEAR) *count = lines;
    return SL_OK;
}

// --- all

static sl_status look_at_all(finder *f, uint32_t kind, size_t *count) {
    sl_context *context = f->left->context;
    for (size_t n = 0; n < f->own.count && f->near <= MOST_NEAR; n++) {
        if (n % 1024 == 0) SL_TRY(sl_check_cancelled(context));
        SL_TRY(look_beside(f, f->own.items[n]));
    }
    for (size_t n = 0; n < f->own.count && f->near <= MOST_NEAR; n++) {
        bool row = false;
        SL_TRY(is_in_row(f, f->own.items[n], &row));
        f->lines[f->own.items[n]].alive = f->lines[f->own.items[n]].plain && !row;
    }
    if (f->near <= MOST_NEAR) SL_TRY(count_chains(f, count));
    return !*count && f->near <= MOST_NEAR ? count_pairs(f, kind, count) : SL_OK;
}

static void destroy(finder *f) {
    sl_context *context = f->left->context;
    sl_free(context, f->own.items);
    sl_free(context, f->lines);
    sl_free(context, f->pieces);
    sl_free(context, f->joints.items);
}

/// Finds the lines of a kind that are not taken already, and measures them.
static sl_status find_own(finder *f, uint32_t kind) {
    for (uint32_t i = 0; i < (uint32_t)f->left->map->wall_count; i++) {
        if (f->left->kinds[i] != kind || sl_bits_has(f->left->walls, i) || !(length_of(f, i) > 0))
            continue;
        SL_TRY(SL_ARRAY_ROOM(f->left->context, &f->own, 1));
        f->own.items[f->own.count++] = i;
        f->all += length_of(f, i);
    }
    return SL_OK;
}

sl_status sli_left_out_walls(sli_left_out *left, uint32_t kind, size_t *count) {
    const size_t walls = left->map->wall_count;
    finder f = {.left = left};
    *count = 0;
    sl_status status = find_own(&f, kind);
    if (status == SL_OK && f.own.count >= LEAST_CHAINS && f.all >= LEAST * left->size) {
        f.lines = sl_alloc_array(left->context, walls, sizeof *f.lines);
        f.pieces = sl_alloc_array(left->context, walls, sizeof *f.pieces);
        status = f.lines && f.pieces ? look_at_all(&f, kind, count) : SL_NO_MEMORY;
    }
    destroy(&f);
    return status;
}

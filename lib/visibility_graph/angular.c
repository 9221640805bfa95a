/// Angular depth: the paths from each point to all others along a visibility graph that turn least
/// (depthmapX, vgaangular.cpp of its salalib; Dijkstra 1959).
///
/// A path turns at points beside walls, and where it has not turned so far. So only those points
/// are expanded. Neighbours that were seen from the point before are passed over:
///
///        p --------- u           The way p, q never turns more than p, u, q: the direction p to q
///          \        /            lies between p to u and u to q. So only neighbours of u that p
///            \    /              does not see can gain by u.
///              q
///
/// Most ways on turn too much. To see that takes one product: the cosine of the turn that is still
/// allowed comes from a table, and squares are compared. 64 points are passed over at once where
/// their largest turn so far is no more than that of the path to `u`, or where their box lies too
/// far aside. Turns are in single precision, and ties go to the lower number, as in depthmapX.
///
/// Cost: for each point, the words of the points that are expanded, and a heap operation for each
/// gain of such a point.
#include "visibility_graph/paths.h"

#include <string.h>

typedef struct entry {
    float key;
    uint32_t number; ///< of the point
    uint32_t slot, before;
} entry;

enum { STEPS = 512, KNOWN_BITS = 16 };

/// A turn that was computed. From one start to the next most turns are the same.
typedef struct known_turn {
    uint32_t before, at, to;
    float turn;
} known_turn;

typedef struct walker {
    const sli_vga_sights *sights;
    float *turn;       ///< by slot, in right angles: of its path so far; INFINITY: none
    float *most;       ///< by bundle: the largest of these
    sl_bits *done;     ///< points whose paths are final
    known_turn *known; ///< by hash
    SL_ARRAY(entry) heap;
    float cosines[2 * STEPS + 2]; ///< a little less than those of turns, by turn * STEPS
} walker;

// --- the heap

static bool is_before(entry a, entry b) {
    return a.key < b.key || (a.key == b.key && a.number < b.number);
}

static sl_status push(sl_context *context, walker *w, entry e) {
    SL_TRY(SL_ARRAY_ROOM(context, &w->heap, 1));
    size_t i = w->heap.count++;
    for (; i && is_before(e, w->heap.items[(i - 1) / 2]); i = (i - 1) / 2)
        w->heap.items[i] = w->heap.items[(i - 1) / 2];
    w->heap.items[i] = e;
    return SL_OK;
}

static entry pop(walker *w) {
    entry *items = w->heap.items;
    const entry first = items[0], moved = items[--w->heap.count];
    size_t i = 0;
    for (;;) {
        size_t child = 2 * i + 1;
        if (child >= w->heap.count) break;
        if (child + 1 < w->heap.count && is_before(items[child + 1], items[child])) child++;
        if (!is_before(items[child], moved)) break;
        items[i] = items[child];
        i = child;
    }
    items[i] = moved;
    return first;
}

// --- turns

/// Two steps of a path, and the least cosine of a turn between them that can gain.
typedef struct bend {
    float x, y, length2; ///< the first step, and the square of its length
    float least;
} bend;

static float least_cosine(const walker *w, float turn) {
    return turn < 2 ? w->cosines[(int)(turn * STEPS) + 1] : -2;
}

/// Whether a step turns too much.
static inline bool is_aside(const bend *b, float x, float y) {
    const float dot = b->x * x + b->y * y;
    const float square = b->least * b->least * b->length2 * (x * x + y * y);
    if (b->least >= 0) return dot <= 0 || dot * dot < square;
    return dot < 0 && dot * dot > square;
}

/// Whether all of a box is aside of a ray: it does not meet the ray, and no corner is ahead.
static bool is_box_aside(const bend *b, float x, float y, const sli_vga_box *box) {
    const float left = box->left - x, right = box->right - x;
    const float bottom = box->bottom - y, top = box->top - y;
    if (left <= 0 && right >= 0 && bottom <= 0 && top >= 0) return false;
    const float corners[4][2] = {{left, bottom}, {left, top}, {right, bottom}, {right, top}};
    int sides = 0;
    for (int i = 0; i < 4; i++) {
        if (!is_aside(b, corners[i][0], corners[i][1])) return false;
        const float cross = b->x * corners[i][1] - b->y * corners[i][0];
        const bool ahead = b->x * corners[i][0] + b->y * corners[i][1] > 0;
        sides |= cross > 0 ? 1 : cross < 0 ? 2 : 3;
        sides |= ahead ? 4 : 0;
    }
    return (sides & 3) != 3 || !(sides & 4);
}

static float turn_at(walker *w, uint32_t before, uint32_t at, uint32_t to) {
    const uint32_t hash = (at * 0x9e3779b1u ^ to * 0x85ebca6bu) + before * 0xc2b2ae35u;
    known_turn *known = &w->known[hash >> (32 - KNOWN_BITS)];
    if (known->before != before || known->at != at || known->to != to)
        *known =
            (known_turn){before, at, to, sli_vga_turn(sli_vga_cosine(w->sights, before, at, to))};
    return known->turn;
}

// --- paths

static sl_status try_point(sl_context *context, walker *w, const entry *at, uint32_t q) {
    const sli_vga_sights *s = w->sights;
    const float old = w->turn[q];
    float turn = 0;
    if (at->key >= old) return SL_OK;
    if (at->before != SLI_VGA_NONE) turn = turn_at(w, at->before, at->slot, q);
    if (at->key + turn >= old) return SL_OK;
    w->turn[q] = at->key + turn;
    // Only straight ahead, and beside walls, are points expanded.
    if (w->turn[q] > 0 && !sl_bits_has(s->turning, q)) return SL_OK;
    return push(context, w, (entry){w->turn[q], s->points[q], q, at->slot});
}

static float most_of(const float *turns) {
    float most[8] = {0};
    for (int i = 0; i < 64; i += 8)
        for (int k = 0; k < 8; k++) most[k] = turns[i + k] > most[k] ? turns[i + k] : most[k];
    for (int k = 1; k < 8; k++) most[0] = most[k] > most[0] ? most[k] : most[0];
    return most[0];
}

static sl_status try_word(sl_context *context, walker *w, const entry *at, bend *b, uint32_t bundle,
                          uint64_t points) {
    const sli_vga_sights *s = w->sights;
    const float x = s->x[at->slot], y = s->y[at->slot];
    bool gained = false;
    b->least = least_cosine(w, w->most[bundle] - at->key);
    if (at->before != SLI_VGA_NONE && is_box_aside(b, x, y, &s->boxes[bundle])) return SL_OK;
    for (; points; points &= points - 1) {
        const uint32_t q = bundle * 64 + (uint32_t)__builtin_ctzll(points);
        const float left = w->turn[q] - at->key;
        if (left <= 0) continue;
        b->least = least_cosine(w, left);
        if (at->before != SLI_VGA_NONE && is_aside(b, s->x[q] - x, s->y[q] - y)) continue;
        SL_TRY(try_point(context, w, at, q));
        gained = true;
    }
    if (gained) w->most[bundle] = most_of(w->turn + (size_t)bundle * 64);
    return SL_OK;
}

static sl_status expand(sl_context *context, walker *w, const entry *at) {
    const sli_vga_sights *s = w->sights;
    const sli_vga_word *words = s->words.items;
    bend b = {0};
    size_t k = 0, known_end = 0;
    if (at->before != SLI_VGA_NONE) {
        k = s->first[at->before];
        known_end = s->first[at->before + 1];
        b.x = s->x[at->slot] - s->x[at->before];
        b.y = s->y[at->slot] - s->y[at->before];
        b.length2 = b.x * b.x + b.y * b.y;
    }
    for (size_t i = s->first[at->slot]; i < s->first[at->slot + 1]; i++) {
        const uint32_t bundle = words[i].bundle;
        while (k < known_end && words[k].bundle < bundle) k++;
        uint64_t rest = words[i].seen & ~w->done[bundle];
        if (k < known_end && words[k].bundle == bundle) rest &= ~words[k].seen;
        if (rest && at->key < w->most[bundle]) SL_TRY(try_word(context, w, at, &b, bundle, rest));
    }
    return SL_OK;
}

static sl_status find_straightest(sl_context *context, walker *w, uint32_t from) {
    const sli_vga_sights *s = w->sights;
    const double radius = s->job->options->angular_radius;
    w->heap.count = 0;
    memset(w->done, 0, s->bundles * sizeof *w->done);
    for (uint32_t q = 0; q < s->count; q++)
        w->turn[q] = s->parts[q] == s->parts[from] ? INFINITY : -1; // never reached
    for (size_t k = 0; k < s->bundles; k++) w->most[k] = INFINITY;
    w->turn[from] = 0;
    SL_TRY(push(context, w, (entry){0, s->points[from], from, SLI_VGA_NONE}));
    while (w->heap.count) {
        const entry e = pop(w);
        if (radius > 0 && e.key > radius) break;
        if (e.key > w->turn[e.slot]) continue; // a better path has come since
        SL_TRY(expand(context, w, &e));
        sl_bits_add(w->done, e.slot);
        if (e.before != SLI_VGA_NONE) continue;
        for (size_t i = s->first[from]; i < s->first[from + 1]; i++) // all in sight are final
            w->done[s->words.items[i].bundle] |= s->words.items[i].seen;
    }
    return SL_OK;
}

static sl_status measure(sl_context *context, walker *w, uint32_t from) {
    const sli_vga_sights *s = w->sights;
    const double radius = s->job->options->angular_radius;
    double turn = 0, nodes = 0;
    SL_TRY(find_straightest(context, w, from));
    for (uint32_t p = 0; p < s->count; p++) {
        const float of_p = w->turn[s->slots[p]];
        if (of_p == INFINITY || of_p < 0 || (radius > 0 && of_p > radius)) continue;
        turn += of_p;
        nodes++;
    }
    sl_vga_measures *out = &s->job->measures[s->points[from]];
    out->angular_mean_depth = turn / nodes;
    out->angular_total_depth = turn;
    out->angular_node_count = nodes;
    return SL_OK;
}

// --- all points

static void end(sl_context *context, void *all, void *state) {
    (void)all;
    walker *w = state;
    void *parts[] = {w->turn, w->most, w->done, w->known, w->heap.items, w};
    for (size_t i = 0; i < sizeof parts / sizeof *parts; i++) sl_free(context, parts[i]);
}

static sl_status begin(sl_context *context, void *all, void **state) {
    const sli_vga_sights *s = all;
    const size_t slots = s->bundles * 64;
    walker *w = sl_alloc_array(context, 1, sizeof *w);
    if (!w) return SL_NO_MEMORY;
    w->sights = s;
    // Rounding, here and of squares in single precision, is below a millionth.
    for (int i = 0; i < 2 * STEPS + 2; i++)
        w->cosines[i] = (float)(cos(i * SLI_RIGHT_ANGLE / STEPS) - 4e-6);
    w->turn = sl_alloc_array(context, slots, sizeof *w->turn);
    w->most = sl_alloc_array(context, s->bundles, sizeof *w->most);
    w->done = sl_alloc_array(context, s->bundles, sizeof *w->done);
    w->known = sl_alloc_array(context, (size_t)1 << KNOWN_BITS, sizeof *w->known);
    if (!w->turn || !w->most || !w->done || !w->known) {
        end(context, all, w);
        return SL_NO_MEMORY;
    }
    *state = w;
    return SL_OK;
}

static sl_status measure_unit(sl_context *context, void *all, void *state, size_t unit) {
    const sli_vga_sights *s = all;
    for (size_t slot = unit * 64; slot < s->count && slot < unit * 64 + 64; slot++) {
        SL_TRY(sl_check_cancelled(context));
        SL_TRY(measure(context, state, (uint32_t)slot));
    }
    return SL_OK;
}

sl_status sli_vga_measure_angular(sl_context *context, const sli_vga_sights *sights) {
    sli_vga_sights mine = *sights;
    const sl_work work = {.job = &mine,
                          .begin = begin,
                          .unit = measure_unit,
                          .end = end,
                          .stage = "straightest paths",
                          .units = "bundles of points"};
    return sl_work_run(context, &work, sights->bundles, sights->job->options->threads);
}

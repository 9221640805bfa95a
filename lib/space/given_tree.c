/// The tree of given cells: lines of their sides, chosen so that few cells are on both sides.
#include "space/given.h"

#include <math.h>
#include <string.h>

/// Faces list[first .. end) that a place of the tree has to lead to.
typedef struct task {
    sl_bsp_spot place;
    size_t first, end;
} task;

typedef struct planter {
    sl_given *given;
    SL_ARRAY(uint32_t) list; ///< those of the last task stand at its end
    SL_ARRAY(task) tasks;
    size_t limit; ///< of nodes: with more, no face is led to twice any more
} planter;

/// Which sides of a line a face is on: 1 its left, 2 its right, 3 both.
static unsigned sides_of_line(const sl_bsp_sides *sides, sl_segment line) {
    unsigned found = 0;
    for (size_t i = 0; i < sides->count && found < 3; i++) {
        const int sign = sl_orient(line.a, line.b, sides->items[i].from);
        found |= sign > 0 ? 1u : sign < 0 ? 2u : 0;
    }
    return found;
}

static const sl_bsp_sides *face_sides(const planter *p, size_t at) {
    return &p->given->bsp.faces.items[p->list.items[at]].sides;
}

/// The share of a sample of the faces that is on the fuller side of a line, those on both sides
/// being on each.
static double cost_of(const planter *p, const task *t, sl_segment line) {
    enum { SAMPLE = 64 };
    const size_t count = t->end - t->first, asked = count < SAMPLE ? count : SAMPLE;
    size_t on[2] = {0, 0};
    for (size_t i = 0; i < asked; i++) {
        const unsigned found = sides_of_line(face_sides(p, t->first + i * count / asked), line);
        on[0] += (found & 1) != 0;
        on[1] += (found & 2) != 0;
    }
    const size_t fuller = on[0] > on[1] ? on[0] : on[1];
    return ((double)fuller + 0.5 * (double)(on[0] + on[1] - asked)) / (double)asked;
}

/// The least costly of the lines of some sides; of all of them where few faces are left.
static sl_segment choose_line(const planter *p, const task *t) {
    enum { CANDIDATES = 16, FEW = 4 };
    const size_t count = t->end - t->first, faces = count < CANDIDATES ? count : CANDIDATES;
    sl_segment best = {0};
    double least = HUGE_VAL;
    for (size_t i = 0; i < faces; i++) {
        const sl_bsp_sides *sides = face_sides(p, t->first + i * count / faces);
        const size_t step = count <= FEW ? 1 : sides->count;
        for (size_t k = count <= FEW ? 0 : i % sides->count; k < sides->count; k += step) {
            const sl_segment line = {sides->items[k].from, sl_side_end(sides, k)};
            const double cost = cost_of(p, t, line);
            if (cost >= least) continue;
            best = line;
            least = cost;
        }
    }
    return best;
}

/// As sides_of_line, but one side only.
static unsigned side_of_middle(const sl_bsp_sides *sides, sl_segment line) {
    sl_point middle = {0, 0};
    for (size_t i = 0; i < sides->count; i++) {
        middle.x += sides->items[i].from.x / (double)sides->count;
        middle.y += sides->items[i].from.y / (double)sides->count;
    }
    return sl_orient(line.a, line.b, middle) < 0 ? 2 : 1;
}

typedef enum dealing { BY_CORNERS, BY_MIDDLE, FIRST_ALONE } dealing;

static unsigned deal_one(const planter *p, const task *t, size_t at, sl_segment line, dealing how) {
    if (how == FIRST_ALONE) return at == t->first ? 1 : 2;
    const unsigned found = sides_of_line(face_sides(p, at), line);
    return found == 3 && how == BY_MIDDLE ? side_of_middle(face_sides(p, at), line) : found;
}

/// Deals the faces of a task out to the two sides of a line, behind each other at the list's end:
/// first what is right of it, then what is left. Where that gets nowhere (cells may overlap by
/// rounding), a face is told to be on one side only: locating a point walks on from there.
static sl_status deal(planter *p, const task *t, sl_segment line, size_t *rights) {
    sl_context *context = p->given->bsp.context;
    const size_t count = t->end - t->first;
    const bool spare = p->given->bsp.nodes.count > p->limit;
    for (dealing how = spare ? BY_MIDDLE : BY_CORNERS;; how++) {
        size_t on[2] = {0, 0};
        p->list.count = t->end;
        for (unsigned side = 2; side > 0; side--)
            for (size_t at = t->first; at < t->end; at++) {
                if (!(deal_one(p, t, at, line, how) & side)) continue;
                SL_TRY(SL_ARRAY_ROOM(context, &p->list, 1));
                p->list.items[p->list.count++] = p->list.items[at];
                on[side - 1]++;
            }
        *rights = on[1];
        if (how == FIRST_ALONE || (on[0] < count && on[1] < count)) return SL_OK;
    }
}

static void lead(sl_bsp *bsp, sl_bsp_spot place, int32_t child) {
    if (place.node < 0)
        bsp->root = child;
    else if (place.above)
        bsp->nodes.items[place.node].above = child;
    else
        bsp->nodes.items[place.node].below = child;
}

static sl_status add_node(sl_bsp *bsp, sl_bsp_spot place, sl_segment line, int32_t *node) {
    if (bsp->nodes.count >= INT32_MAX / 2) return sl_fail_memory(bsp->context);
    SL_TRY(SL_ARRAY_ROOM(bsp->context, &bsp->nodes, 1));
    SL_TRY(SL_ARRAY_ROOM(bsp->context, &bsp->lines, 1));
    *node = (int32_t)bsp->nodes.count;
    bsp->nodes.items[bsp->nodes.count++] = (sl_node){.axis = 2, .line = (int32_t)bsp->lines.count};
    bsp->lines.items[bsp->lines.count++] = line;
    lead(bsp, place, *node);
    return SL_OK;
}

static sl_status split(planter *p, task t) {
    sl_bsp *bsp = &p->given->bsp;
    const size_t count = t.end - t.first;
    if (count == 1) {
        lead(bsp, t.place, ~(int32_t)p->list.items[t.first]);
        p->list.count = t.first;
        return SL_OK;
    }
    const sl_segment line = choose_line(p, &t);
    int32_t node = -1;
    size_t rights = 0;
    SL_TRY(add_node(bsp, t.place, line, &node));
    SL_TRY(deal(p, &t, line, &rights));
    const size_t dealt = p->list.count - t.end;
    memmove(p->list.items + t.first, p->list.items + t.end, dealt * sizeof *p->list.items);
    p->list.count = t.first + dealt;
    SL_TRY(SL_ARRAY_ROOM(bsp->context, &p->tasks, 2));
    p->tasks.items[p->tasks.count++] =
        (task){.place = {.node = node}, .first = t.first, .end = t.first + rights};
    p->tasks.items[p->tasks.count++] = (task){
        .place = {.node = node, .above = true}, .first = t.first + rights, .end = p->list.count};
    return SL_OK;
}

static sl_status plant(planter *p) {
    sl_context *context = p->given->bsp.context;
    const size_t count = p->given->bsp.faces.count;
    SL_TRY(SL_ARRAY_ROOM(context, &p->list, count));
    for (size_t f = 0; f < count; f++) p->list.items[p->list.count++] = (uint32_t)f;
    SL_TRY(SL_ARRAY_ROOM(context, &p->tasks, 1));
    p->tasks.items[p->tasks.count++] = (task){.place = {.node = -1}, .end = count};
    while (p->tasks.count) {
        SL_TRY(sl_check_cancelled(context));
        SL_TRY(split(p, p->tasks.items[--p->tasks.count]));
    }
    return SL_OK;
}

sl_status sl_given_plant(sl_given *given) {
    planter p = {.given = given, .limit = 32 * given->bsp.faces.count};
    const sl_status status = plant(&p);
    sl_free(given->bsp.context, p.list.items);
    sl_free(given->bsp.context, p.tasks.items);
    return status;
}

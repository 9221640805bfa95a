/// Which rows of a bake still hold after some walls have changed.
///
/// A cell is unchanged if the new space has a cell with the same corners and the same directed
/// portals, and each of these leads to the same cell as before, or to a changed one. Let A be
/// unchanged, and let every cell that A saw be unchanged. Then A sees the same cells as before:
///
/// - Take a sequence from A that had a sightline. A saw all cells on it, so that all are unchanged.
///   The new space has the same sequence of directed portals, and the same line stabs it.
/// - Take a sequence from A that has a sightline now, and its first directed portal that leads to
///   another cell than before. Up to there the old space had the same sequence and the same line,
///   which went on through that portal. So A saw the cell behind it, and that cell is unchanged.
///   But then the portal would lead to it now as well.
///
/// So the row of A is the old one, whichever exact method found it. Pairs without such a cell are
/// looked for anew. A search passes over such sources. The sweep passes over a fan all of whose
/// cells are of this kind, and see only cells of this kind: a fan joins only cells that its own
/// cells see (sweep_finish.c).
///
/// The numbers of cells do not matter, nor does the subdivision: a split line that moves only makes
/// more cells count as changed.
///
/// The same holds with one-way glass, if an unchanged cell also has the same glass on its directed
/// portals; and with a view range that is the same, as the same line has the same length. Doors and
/// mirrors take no part: a baked file does not keep how many sets of doors and how many reflections
/// it was made with.
#include "cell_to_cell/methods.h"
#include "cell_to_cell/pvs_rows.h"
#include "effects/filtered.h"

#include <stdlib.h>
#include <string.h>

#define NO_CELL UINT32_MAX

typedef struct reusing {
    const sl_space *before, *space;
    const sl_pvs *seen;
    bool glass;        ///< there is one-way glass
    uint32_t *now;     ///< by cell of the space before: the same cell, or NO_CELL
    uint32_t *then;    ///< by cell of the space: the same cell before, or NO_CELL
    sl_bits *kept;     ///< cells whose rows are as they were
    sl_bits *enclosed; ///< those of them that see only such cells
    sl_bits *set;      ///< scratch
} reusing;

// --- the same cells

/// A cell with its corners at hand, for sorting.
typedef struct shape {
    const sl_point *corners;
    uint32_t count, cell;
} shape;

static int compare_shapes(const void *a, const void *b) {
    const shape *s = a, *t = b;
    if (s->count != t->count) return s->count < t->count ? -1 : 1;
    return memcmp(s->corners, t->corners, s->count * sizeof *s->corners);
}

static shape *sort_shapes(sl_context *context, const sl_space *space) {
    shape *shapes = sl_alloc_array(context, space->cell_count, sizeof *shapes);
    if (!shapes) return NULL;
    for (uint32_t i = 0; i < space->cell_count; i++) {
        const sl_cell *cell = &space->cells[i];
        shapes[i] = (shape){space->vertices + cell->first_vertex, cell->vertex_count, i};
    }
    qsort(shapes, space->cell_count, sizeof *shapes, compare_shapes);
    return shapes;
}

/// Whether no other one is like it.
static bool is_alone(const shape *shapes, uint32_t count, uint32_t i) {
    return (i == 0 || compare_shapes(&shapes[i - 1], &shapes[i]) != 0) &&
           (i + 1 == count || compare_shapes(&shapes[i], &shapes[i + 1]) != 0);
}

static bool same_directed(const reusing *c, uint32_t then, uint32_t now) {
    const sl_cell *a = &c->before->cells[then], *b = &c->space->cells[now];
    if (a->directed_count != b->directed_count || a->inside != b->inside || a->solid != b->solid)
        return false;
    for (uint32_t i = 0; i < a->directed_count; i++) {
        const sl_directed_portal *e = &c->before->directed[a->first_directed + i];
        const sl_directed_portal *f = &c->space->directed[b->first_directed + i];
        if (e->left.x != f->left.x || e->left.y != f->left.y || e->right.x != f->right.x ||
            e->right.y != f->right.y)
            return false;
        if (c->glass && sli_portal_is_blocked(c->before, then, a->first_directed + i) !=
                            sli_portal_is_blocked(c->space, now, b->first_directed + i))
            return false;
    }
    return true;
}

static void match(const reusing *c, const shape *old, const shape *new) {
    const uint32_t old_count = c->before->cell_count, new_count = c->space->cell_count;
    for (uint32_t i = 0, k = 0; i < old_count && k < new_count;) {
        const int order = compare_shapes(&old[i], &new[k]);
        if (order == 0 && is_alone(old, old_count, i) && is_alone(new, new_count, k) &&
            same_directed(c, old[i].cell, new[k].cell)) {
            c->now[old[i].cell] = new[k].cell;
            c->then[new[k].cell] = old[i].cell;
        }
        i += order <= 0;
        k += order >= 0;
    }
}

/// Whether each directed portal leads to the same cell as before, or to one that is none of the
/// same now.
static bool leads_the_same_way(const reusing *c, uint32_t then, uint32_t now) {
    const sl_cell *a = &c->before->cells[then], *b = &c->space->cells[now];
    for (uint32_t i = 0; i < a->directed_count; i++) {
        const uint32_t to = c->now[c->before->directed[a->first_directed + i].cell];
        if (to != NO_CELL && to != c->space->directed[b->first_directed + i].cell) return false;
    }
    return true;
}

static sl_status find_same_cells(sl_context *context, const reusing *c) {
    memset(c->now, 0xff, c->before->cell_count * sizeof *c->now);
    memset(c->then, 0xff, c->space->cell_count * sizeof *c->then);
    shape *old = sort_shapes(context, c->before), *new = sort_shapes(context, c->space);
    if (old && new) match(c, old, new);
    const sl_status status = old && new ? SL_OK : SL_NO_MEMORY;
    sl_free(context, old);
    sl_free(context, new);
    if (status != SL_OK) return status;
    // A cell that no longer counts as the same only makes others lead to a changed one.
    for (uint32_t then = 0; then < c->before->cell_count; then++) {
        const uint32_t now = c->now[then];
        if (now == NO_CELL || leads_the_same_way(c, then, now)) continue;
        c->now[then] = c->then[now] = NO_CELL;
    }
    return SL_OK;
}

// --- their rows

static bool saw_no_changed_cell(const reusing *c, uint32_t then) {
    for (sl_pvs_run run = sl_pvs_begin(c->seen, then); sl_pvs_next(&run);)
        for (uint32_t i = run.first; i < run.end; i++)
            if (c->now[i] == NO_CELL) return false;
    return true;
}

static bool saw_kept_cells_only(const reusing *c, uint32_t then) {
    for (sl_pvs_run run = sl_pvs_begin(c->seen, then); sl_pvs_next(&run);)
        for (uint32_t i = run.first; i < run.end; i++)
            if (!sl_bits_has(c->kept, c->now[i])) return false;
    return true;
}

static void find_kept(const reusing *c) {
    for (uint32_t now = 0; now < c->space->cell_count; now++)
        if (c->then[now] != NO_CELL && saw_no_changed_cell(c, c->then[now]))
            sl_bits_add(c->kept, now);
    for (uint32_t now = 0; now < c->space->cell_count; now++)
        if (sl_bits_has(c->kept, now) && saw_kept_cells_only(c, c->then[now]))
            sl_bits_add(c->enclosed, now);
}

static sl_status make_rows(sl_context *context, const reusing *c, sli_pvs_maker *maker,
                           sl_pvs *out) {
    const uint32_t count = c->space->cell_count;
    SL_TRY(sli_pvs_maker_create(context, count, count, maker));
    for (uint32_t now = 0; now < count; now++) {
        if (sl_bits_has(c->kept, now))
            for (sl_pvs_run run = sl_pvs_begin(c->seen, c->then[now]); sl_pvs_next(&run);)
                for (uint32_t i = run.first; i < run.end; i++)
                    sli_word_set_add(&maker->row, c->now[i]);
        SL_TRY(sli_pvs_maker_end_row(context, maker));
    }
    return sli_pvs_maker_finish(context, maker, out);
}

static sl_status take_rows(sl_context *context, const reusing *c, sl_partial *partial) {
    sli_pvs_maker maker;
    sl_pvs rows = {0};
    const sl_status status = make_rows(context, c, &maker, &rows);
    sli_pvs_maker_destroy(context, &maker);
    if (status != SL_OK) return status;
    sl_pvs_destroy(context, &partial->sure);
    partial->sure = rows;
    return SL_OK;
}

// --- all of it

/// A bake that looked from inside cells only left the others without rows.
static bool looked_from_the_same(const sl_space *space, const sl_pvs *seen, bool inside_only) {
    for (uint32_t i = 0; i < space->cell_count; i++) {
        const bool has_row = seen->offsets[i] < seen->offsets[i + 1];
        if (has_row != sli_looks_from(space, inside_only, i)) return false;
    }
    return true;
}

static sl_status check_same_question(sl_context *context, const sl_space *before,
                                     const sl_visibility *seen, const sl_see_method *method,
                                     const sl_see_options *options) {
    const sl_guarantee wanted =
        method->stabs && options->solver ? options->solver->guarantee : method->guarantee;
    if (!method->reuse || wanted != SL_EXACT)
        return sl_fail(context, SL_BAD_ARGUMENT,
                       "only what an exact method looks for can be taken over");
    const unsigned effects = options->plan ? options->plan->effects : 0;
    if (effects & ~(unsigned)(SL_EFFECT_ONEWAY | SL_EFFECT_RANGE))
        return sl_fail(context, SL_BAD_ARGUMENT,
                       "the map has doors or mirrors, and a baked file does not keep with how many "
                       "sets of doors and reflections it was made");
    if (effects && !method->stabs)
        return sl_fail(context, SL_BAD_ARGUMENT,
                       "with effects '%s' looks at the map as a whole; prune takes over cells",
                       method->name);
    if (seen->guarantee != SL_EXACT)
        return sl_fail(context, SL_BAD_ARGUMENT, "it is not exact, but %s",
                       sl_guarantee_name(seen->guarantee));
    if (seen->sight != options->sight)
        return sl_fail(context, SL_BAD_ARGUMENT, "it was baked with %s sight",
                       seen->sight == SL_OPEN ? "open" : "closed");
    if (seen->pvs.cell_count != before->cell_count ||
        !looked_from_the_same(before, &seen->pvs, options->inside_only))
        return sl_fail(context, SL_BAD_ARGUMENT, "it was not baked from %s",
                       options->inside_only ? "the inside alone" : "all cells");
    return SL_OK;
}

static sl_status allocate(sl_context *context, reusing *c) {
    const size_t words = sl_bits_words(c->space->cell_count);
    c->now = sl_alloc_array(context, c->before->cell_count, sizeof *c->now);
    c->then = sl_alloc_array(context, c->space->cell_count, sizeof *c->then);
    c->kept = sl_alloc_array(context, words, sizeof *c->kept);
    c->enclosed = sl_alloc_array(context, words, sizeof *c->enclosed);
    return c->now && c->then && c->kept && c->enclosed ? SL_OK : SL_NO_MEMORY;
}

static sl_status reuse_rows(sl_context *context, reusing *c, const sl_see_method *method,
                            const sl_see_options *options, sl_partial *partial) {
    SL_TRY(allocate(context, c));
    SL_TRY(find_same_cells(context, c));
    SL_TRY(sl_check_cancelled(context));
    find_kept(c);
    SL_TRY(method->reuse(context, c->space, options, c->kept, c->enclosed, partial));
    return take_rows(context, c, partial);
}

sl_status sl_partial_reuse(sl_context *context, const sl_space *before, const sl_visibility *seen,
                           const sl_space *space, const sl_see_method *method,
                           const sl_see_options *options, sl_partial *partial) {
    SL_TRY(check_same_question(context, before, seen, method, options));
    const bool glass = options->plan && options->plan->effects & SL_EFFECT_ONEWAY;
    reusing c = {.before = before, .space = space, .seen = &seen->pvs, .glass = glass};
    sl_partial reused = {0};
    const sl_status status = reuse_rows(context, &c, method, options, &reused);
    sl_free(context, c.now);
    sl_free(context, c.then);
    sl_free(context, c.kept);
    sl_free(context, c.enclosed);
    if (status == SL_OK)
        *partial = reused;
    else
        sl_partial_destroy(context, &reused);
    return status;
}

/// Local measures of a visibility graph, by the formulas of depthmapX (vgavisuallocal.cpp of its
/// salalib), after Turner et al. 2001: of the neighbours of a point and theirs.
///
/// Pairs of neighbours that see each other are counted for a group of up to 64 points near each
/// other (global.c). All of the group see most of what one of them sees:
///
///      . ' all   ' .      pairs(p) = pairs within `all`, counted once for the group
///     p q                           + 2 * those from a point of p's own to `all`
///      ' . own . '                  + pairs within p's own points
///
/// A neighbour that sees no other neighbour is in no such pair. It does not count for
/// controllability, as nobody leads back to it. They are few, and looked for one by one.
///
/// Cost: for a group, the tiles within `all`; for a point, the tiles within its own points. All of
/// them are of bundles that the group's bundle has tiles of, so no other is looked at. Points two
/// steps away are counted by the search for depths. In a directed graph, a group is one point.
#include "analysis/visibility_graph/graph_measures.h"
#include "geometry/length.h"

#include <math.h>
#include <string.h>

typedef struct local_job {
    const sli_vga_job *all;
    const sli_vga_tiles *tiles;
} local_job;

/// Sets are by slot. All but `next` are empty outside the bundles of `near`.
typedef struct scratch {
    const sli_vga_bundle *near; ///< of the group; NULL: none yet
    sl_bits *all, *own;         ///< seen by all of a group; by one of it, and not by all
    sl_bits *level;
    sl_bits *next, *bundles, *next_bundles; ///< in a directed graph; the others are by bundle
    sl_bits *alone;                         ///< of `all`: those that see none of it
    uint32_t
        *to_all; ///< by slot that one of the group sees, and not all: how many of `all` it sees
} scratch;

// --- pairs of neighbours

/// Ordered pairs of points of a set that see each other. Sight is mutual, so of two tiles with the
/// same pairs one is counted, twice.
static uint64_t count_pairs(const sli_vga_tiles *t, const sli_vga_bundle *near,
                            const sl_bits *set) {
    uint64_t count = 0;
    for (uint32_t k = 0; k < near->count; k++) {
        const uint32_t b = near->tiles[k].bundle;
        if (!set[b]) continue;
        for (uint32_t i = 0; i < t->of[b].count; i++) {
            const sli_vga_tile *tile = &t->of[b].tiles[i];
            const sl_bits others = set[tile->bundle] & tile->any;
            if (tile->bundle < b || !others) continue;
            uint64_t of_tile = 0;
            if (set[b] == UINT64_MAX && others == tile->any)
                of_tile = sli_vga_tile_pairs(&t->of[b], tile);
            else
                for (sli_vga_span span = sli_vga_spans(&t->of[b], tile); sli_vga_next_span(&span);)
                    of_tile += (uint64_t)sli_word_count(span.places & set[b]) *
                               sli_word_count(span.seen & others);
            count += tile->bundle == b ? of_tile : 2 * of_tile;
        }
    }
    return count;
}

/// Counts how many of `all` each of the other points sees. `others`: by bundle.
static void count_to_all(const sli_vga_tiles *t, scratch *s, const sl_bits *others) {
    for (uint32_t k = 0; k < s->near->count; k++) {
        const uint32_t b = s->near->tiles[k].bundle;
        uint32_t *counts = s->to_all + (size_t)b * 64;
        if (others[b]) memset(counts, 0, 64 * sizeof *counts);
        for (uint32_t i = 0; others[b] && i < t->of[b].count; i++) {
            const sli_vga_tile *tile = &t->of[b].tiles[i];
            const uint64_t seen = tile->any & s->all[tile->bundle];
            if (!seen) continue;
            for (sli_vga_span span = sli_vga_spans(&t->of[b], tile); sli_vga_next_span(&span);) {
                const uint32_t more = sli_word_count(span.seen & seen);
                uint64_t rest = more ? span.places & others[b] : 0;
                for (; rest; rest &= rest - 1) counts[__builtin_ctzll(rest)] += more;
            }
        }
    }
}

/// Takes out of `points`, which are of one bundle, those that see one of a set.
static uint64_t without_seeing(const sli_vga_bundle *of, uint64_t points, const sl_bits *set) {
    for (uint32_t i = 0; i < of->count && points; i++) {
        const uint64_t seen = of->tiles[i].any & set[of->tiles[i].bundle];
        if (!seen) continue;
        for (sli_vga_span span = sli_vga_spans(of, &of->tiles[i]); sli_vga_next_span(&span);)
            if (span.seen & seen) points &= ~span.places;
    }
    return points;
}

// --- a group

static void see_row(const sli_vga_bundle *of, unsigned place, sl_bits *row) {
    for (uint32_t i = 0; i < of->count; i++)
        row[of->tiles[i].bundle] = sli_vga_tile_row(of, &of->tiles[i], place);
}

/// Takes the sets from one group to the next.
static void begin_group(scratch *s, const sli_vga_bundle *near) {
    for (uint32_t k = 0; s->near && k < s->near->count; k++) {
        const uint32_t b = s->near->tiles[k].bundle;
        s->all[b] = s->own[b] = s->level[b] = s->alone[b] = 0;
    }
    s->near = near;
    for (uint32_t k = 0; k < near->count; k++) s->all[near->tiles[k].bundle] = UINT64_MAX;
}

/// What all of a group see, and how the rest of what they see is joined to that. Returns the pairs
/// within what all see.
static uint64_t see_all(const sli_vga_tiles *t, scratch *s, size_t bundle, uint64_t group) {
    const sli_vga_bundle *near = &t->of[bundle];
    begin_group(s, near);
    for (; group; group &= group - 1) {
        see_row(near, (unsigned)__builtin_ctzll(group), s->level);
        for (uint32_t k = 0; k < near->count; k++) {
            const uint32_t b = near->tiles[k].bundle;
            s->all[b] &= s->level[b];
            s->own[b] |= s->level[b];
        }
    }
    for (uint32_t k = 0; k < near->count; k++) {
        const uint32_t b = near->tiles[k].bundle;
        s->own[b] &= ~s->all[b];
        s->alone[b] = s->all[b] ? without_seeing(&t->of[b], s->all[b], s->all) : 0;
    }
    count_to_all(t, s, s->own);
    return count_pairs(t, near, s->all);
}

// --- a point

static void measure_neighbours(const local_job *l, const scratch *s, uint32_t point,
                               sl_vga_measures *out) {
    const sli_vga_job *j = l->all;
    const sl_point at = j->grid->points[point];
    out->point_first_moment = out->point_second_moment = out->visual_control = 0;
    for (uint32_t k = 0; k < s->near->count; k++) {
        const size_t b = s->near->tiles[k].bundle;
        for (sl_bits rest = s->level[b]; rest; rest &= rest - 1) {
            const uint32_t q = l->tiles->points[b * 64 + (size_t)__builtin_ctzll(rest)];
            const double distance =
                sli_length(j->grid->points[q].x - at.x, j->grid->points[q].y - at.y);
            out->point_first_moment += distance;
            out->point_second_moment += distance * distance;
            // Behind one-way glass a neighbour may see nothing.
            out->visual_control += j->degree[q] ? 1.0 / j->degree[q] : NAN;
        }
    }
    if (!j->degree[point]) out->visual_control = NAN;
}

/// All that the neighbours of a point see together. `alone`: neighbours that see no other.
static uint64_t count_together(const local_job *l, scratch *s, uint32_t point, uint64_t alone) {
    const sli_vga_tiles *t = l->tiles;
    const uint32_t degree = l->all->degree[point];
    if (!l->all->graph->directed) return degree ? 1 + degree - alone + l->all->second[point] : 0;
    const size_t bytes = sl_bits_words(t->bundles) * sizeof *s->bundles;
    memset(s->bundles, 0, bytes);
    memset(s->next_bundles, 0, bytes);
    memset(s->next, 0, t->bundles * sizeof *s->next);
    for (uint32_t k = 0; k < s->near->count; k++) {
        const uint32_t b = s->near->tiles[k].bundle;
        sl_bits_add(s->bundles, b);
        s->own[b] = 0;
    }
    sli_vga_tiles_step(t, s->bundles, s->level, s->own, s->next, s->next_bundles);
    return sli_bits_count(s->next, t->bundles);
}

/// `within`: pairs within what all of the group see.
static void measure_point(const local_job *l, scratch *s, size_t slot, uint64_t within) {
    const sli_vga_tiles *t = l->tiles;
    const uint32_t point = t->points[slot];
    const double degree = l->all->degree[point];
    sl_vga_measures *out = &l->all->measures[point];
    uint64_t pairs = within, alone = 0;
    see_row(s->near, slot % 64, s->level);
    measure_neighbours(l, s, point, out);
    for (uint32_t k = 0; k < s->near->count; k++) {
        const uint32_t b = s->near->tiles[k].bundle;
        s->own[b] = s->level[b] & ~s->all[b];
    }
    for (uint32_t k = 0; k < s->near->count; k++) {
        const size_t b = s->near->tiles[k].bundle;
        uint64_t left = s->alone[b];
        for (uint64_t rest = s->own[b]; rest; rest &= rest - 1) {
            const uint32_t more = s->to_all[b * 64 + (size_t)__builtin_ctzll(rest)];
            pairs += 2 * (uint64_t)more;
            if (!more) left |= rest & -rest;
        }
        if (left) alone += sli_word_count(without_seeing(&t->of[b], left, s->own));
    }
    pairs += count_pairs(t, s->near, s->own);
    if (degree > 1) out->visual_clustering_coefficient = (double)pairs / (degree * (degree - 1));
    const uint64_t together = count_together(l, s, point, alone);
    if (together) out->visual_controllability = degree / (double)together;
}

// --- all points

static void scratch_end(sl_context *context, void *all, void *state) {
    (void)all;
    scratch *s = state;
    void *parts[] = {s->all,    s->own,     s->level,        s->next, s->alone,
                     s->to_all, s->bundles, s->next_bundles, s};
    for (size_t i = 0; i < sizeof parts / sizeof *parts; i++) sl_free(context, parts[i]);
}

static sl_status scratch_begin(sl_context *context, void *all, void **state) {
    const size_t words = ((const local_job *)all)->tiles->bundles;
    scratch *s = sl_alloc_array(context, 1, sizeof *s);
    if (!s) return SL_NO_MEMORY;
    sl_bits **sets[] = {&s->all,   &s->own,     &s->level,       &s->next,
                        &s->alone, &s->bundles, &s->next_bundles};
    s->to_all = sl_alloc_array(context, words * 64, sizeof *s->to_all);
    bool room = s->to_all != NULL;
    for (size_t i = 0; i < sizeof sets / sizeof *sets; i++)
        room &= (*sets[i] = sl_alloc_array(context, words, sizeof **sets[i])) != NULL;
    if (!room) {
        scratch_end(context, all, s);
        return SL_NO_MEMORY;
    }
    *state = s;
    return SL_OK;
}

static sl_status measure_unit(sl_context *context, void *all, void *state, size_t unit) {
    const local_job *l = all;
    uint64_t places = sli_vga_places(l->all, l->tiles, unit);
    while (places) {
        const uint64_t group = sli_vga_choose_group(l->all, l->tiles, unit, places);
        const uint64_t within = see_all(l->tiles, state, unit, group);
        for (uint64_t rest = group; rest; rest &= rest - 1) {
            SL_TRY(sl_check_cancelled(context));
            measure_point(l, state, unit * 64 + (size_t)__builtin_ctzll(rest), within);
        }
        places &= ~group;
    }
    return SL_OK;
}

sl_status sli_vga_measure_local(sl_context *context, const sli_vga_job *job,
                                const sli_vga_tiles *tiles) {
    local_job mine = {job, tiles};
    const sl_work work = {.job = &mine,
                          .begin = scratch_begin,
                          .unit = measure_unit,
                          .end = scratch_end,
                          .stage = "measures",
                          .units = "bundles of points"};
    return sl_work_run(context, &work, tiles->bundles, job->options->threads);
}

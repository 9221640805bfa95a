/// The depth-first search for maps with doors, mirrors, one-way glass or a view range.
///
/// Each effect is a question about one more step of a sequence: which doors it has passed, whether
/// glass lets it through, how long its shortest sightline is, and where mirrored space it is. If a
/// sequence fails, all sequences that go on from it fail too. So the search stays exact.
///
/// Range: the part of a sightline that counts lies between the first portal and the last, as it is
/// 0 for neighbours. The shortest such part is compared with the range. A part within rounding of
/// the range counts as in range, and is counted.
///
/// Mirrors: a mirror is one more portal, which leads back into the cell before it. Behind it the
/// sequence goes on in a reflected copy of the map, in whose frame all portals are placed
/// (effects/mirrors.h). Where these places are rounded, open sight takes only lines that keep clear
/// of all ends by more than rounding moves them: it never sees what no line joins.
#include "cell_to_cell/search/dfs.h"
#include "effects/filtered.h"

#include "base/size.h"
#include "cell_to_cell/methods.h"
#include "cell_to_cell/search/directions.h"
#include "cell_to_cell/search/door_table.h"
#include "effects/mirrors.h"
#include "stab/funnel.h"

#include <string.h>

/// A step, and where mirrored space has what was crossed.
typedef struct step {
    sli_dfs_step dfs;
    sli_unfolded place;
} step;

struct sl_dfs_effects {
    const sl_plan *plan;
    bool doors, mirrors, oneway;
    size_t door_words;
    sli_mirror_sides sides;
    sl_bits *mirror_cells;                                         ///< cells with such sides
    sli_row_bytes *door_rows, *mirrored_rows, *mirrored_door_rows; ///< by source
    pthread_mutex_t *lock; ///< the search's, over the sums below
    uint64_t fallbacks, door_steps, mirror_steps, glass_tests;
    uint64_t range_tests, close_calls, rounded_places;
};

struct sl_dfs_effects_thread {
    SL_ARRAY(sl_bits) doors; ///< a set for each step
    sli_door_table direct, mirrored;
    uint64_t door_steps, mirror_steps, glass_tests, range_tests, close_calls, rounded_places;
    struct sl_dfs_effects *all;
};

typedef struct sl_dfs_effects effects;
typedef struct sl_dfs_effects_thread thread;

// --- one step

/// Makes the set of doors passed up to a portal: those before it and its own.
static sl_status pass_doors(sl_context *context, const sl_space *space, const effects *all,
                            thread *me, uint32_t portal, size_t depth) {
    const size_t words = all->door_words;
    if (!words) return SL_OK;
    me->door_steps++;
    SL_TRY(SL_ARRAY_ROOM(context, &me->doors, (depth + 1) * words));
    sl_bits *set = me->doors.items + depth * words;
    memcpy(set, set - words, words * sizeof *set);
    if (portal == UINT32_MAX) return SL_OK;
    size_t count;
    const sl_seam_portal *on = sl_space_seams_of(space, portal, &count);
    for (size_t i = 0; i < count; i++)
        if (space->seams[on[i].seam].kind == SL_SEAM_DOOR)
            sl_bits_add(set, space->seams[on[i].seam].number);
    return SL_OK;
}

static const sl_bits *doors_at(const effects *all, const thread *me, size_t depth) {
    return me->doors.items + depth * all->door_words;
}

/// Where a portal lies in the frame of the last place.
static sl_directed_portal unfold(thread *me, const sli_mirror_frame *frame, sl_point left,
                                 sl_point right) {
    bool rounded = false;
    const sl_directed_portal ends = sli_unfold(frame, left, right, &rounded);
    me->rounded_places += rounded;
    return ends;
}

/// Whether some direction crosses all portals up to a new place; sets its bounds.
static bool may_cross(const sli_dfs_thread *me, const step *from, sli_unfolded *to) {
    const step *steps = me->search.steps;
    return sli_unfolded_may_cross(&steps[from->place.least].place.ends,
                                  &steps[from->place.most].place.ends, &from->place,
                                  (uint32_t)me->search.count, to);
}

/// Whether the sequence has a sightline of which no more than the range lies between the cells.
static bool is_in_range(const effects *all, thread *me, const void *solver) {
    const double range = all->plan->range;
    if (!(range > 0)) return true;
    me->range_tests++;
    const double shortest = sli_funnel_shortest(solver), error = SLI_SHORTEST_ERROR * range;
    me->close_calls += shortest > range - error && shortest <= range + error;
    return shortest <= range + error;
}

/// Whether a set of wanted cells holds one of these.
static bool wants_one_of(const sli_dfs_thread *me, const sli_prune_set *set, const sl_bits *cells) {
    for (size_t i = set->begin; i < set->end; i++)
        if (me->wanted.words.items[i].bits & cells[me->wanted.words.items[i].word]) return true;
    return false;
}

/// Whether a set of wanted cells holds one that no subset of these doors is known to join to the
/// source.
static bool wants_unproved(const sli_dfs_thread *me, const sli_prune_set *set,
                           const sli_door_table *table, const sl_bits *doors) {
    for (size_t i = set->begin; i < set->end; i++) {
        const sli_prune_word *at = &me->wanted.words.items[i];
        if (at->bits & ~table->seen[at->word]) return true;
    }
    for (size_t i = set->begin; i < set->end; i++) {
        const sli_prune_word *at = &me->wanted.words.items[i];
        for (sl_bits open = at->bits & ~table->free[at->word]; open; open &= open - 1) {
            const uint32_t cell = 64 * at->word + (uint32_t)__builtin_ctzll(open);
            if (!sli_door_table_proves(table, cell, doors)) return true;
        }
    }
    return false;
}

/// Whether anything is left to be found beyond a directed portal of a step. That is a cell that the
/// bounds of all directed portals since the last mirror leave possible, and that is not known to be
/// seen through the doors passed. Where sight may go on in one more mirror, a cell with a mirror is
/// such a cell too.
static sl_status want(sl_context *context, const sli_dfs *all, sli_dfs_thread *me, const step *from,
                      uint32_t directed, bool *something) {
    *something = true;
    if (!all->prunes) return SL_OK;
    const effects *e = all->effects;
    const size_t depth = me->search.count;
    SL_TRY(sli_prune_step(context, &all->bounds, &me->wanted, depth, directed));
    const sli_prune_set *set = &me->wanted.sets.items[depth];
    if (set->all) return SL_OK;
    const uint32_t reflections = from->place.frame.depth;
    if (e->mirrors && reflections < e->plan->mirror_depth && wants_one_of(me, set, e->mirror_cells))
        return SL_OK;
    const sli_door_table *table = reflections ? &me->effects->mirrored : &me->effects->direct;
    *something = wants_unproved(me, set, table, doors_at(e, me->effects, depth));
    return SL_OK;
}

/// Whether a sequence that has a sightline in rounded places has one for certain: the middle line
/// keeps clear of all rounded ends, the one of `to` included.
static bool is_certain(const sli_dfs_thread *me, const sl_space *space, const step *to) {
    const sl_box b = space->bounds;
    const double size =
        fmax(fmax(fabs(b.min.x), fabs(b.max.x)), fmax(fabs(b.min.y), fabs(b.max.y)));
    const sl_line line = me->search.solver->witness(me->search.solver_state);
    for (const step *at = (const step *)me->search.steps + 1; at <= to; at++)
        if (at[-1].place.frame.rounded &&
            !sli_unfolded_is_clear(&at[-1].place.frame, &at->place.ends, line.a, line.b, size))
            return false;
    return true;
}

/// Tests the sequence with the portal or mirror of `to`, and enters the cell behind. `directed`: as
/// in a stab tree.
static sl_status enter(sl_context *context, const sli_dfs_job *job, const step *from, step *to,
                       uint32_t directed) {
    const sli_dfs *all = job->all;
    sli_dfs_thread *me = job->me;
    thread *e = me->effects;
    const uint32_t cell = to->dfs.at.cell;
    if (++me->account.tests % 64 == 0) SL_TRY(sli_dfs_check_going_on(context, all));
    sl_stab_verdict verdict;
    SL_TRY(sli_portal_search_push(context, &me->search, to->place.ends.left, to->place.ends.right,
                                  &verdict));
    if (verdict == SL_STABBED && from->place.frame.rounded && all->options->sight == SL_OPEN &&
        !is_certain(me, all->space, to))
        verdict = SL_GRAZING;
    to->dfs.grazing = verdict == SL_GRAZING || from->dfs.grazing;
    const bool hidden = verdict == SL_HIDDEN || (to->dfs.grazing && all->options->sight == SL_OPEN);
    if (hidden || !is_in_range(all->effects, e, me->search.solver_state)) {
        sli_portal_search_pop(&me->search);
        return SL_OK;
    }
    const bool mirrored = to->place.frame.depth > 0;
    SL_TRY(sli_door_table_add(context, mirrored ? &e->mirrored : &e->direct, cell,
                              doors_at(all->effects, e, me->search.count)));
    if (!mirrored) sl_bits_add(me->sure, cell);
    return sli_dfs_enter(context, all, me, &to->dfs, from->dfs.node, directed, true);
}

/// Whether the sequence has been in a cell since the last mirror. No line enters a cell twice. With
/// exact places the directions of portals already see to that. With rounded places they do not,
/// since a portal of the size of rounding may be turned any way.
static bool has_been_in(const sli_portal_search *search, uint32_t cell) {
    const step *steps = search->steps;
    for (size_t i = search->count; i-- > 0;) {
        if (steps[i].dfs.at.cell == cell) return true;
        if (steps[i].place.mirror != UINT32_MAX) return false;
    }
    return false;
}

SLI_VISIT sl_status cross(sl_context *context, void *visit, const void *last, void *next,
                          uint32_t number) {
    const sli_dfs_job *job = visit;
    const sli_dfs *all = job->all;
    sli_dfs_thread *me = job->me;
    thread *e = me->effects;
    const step *from = last;
    step *to = next;
    const sl_directed_portal *directed = &all->space->directed[number];
    if (all->options->inside_only && !all->space->cells[directed->cell].inside) return SL_OK;
    if (all->effects->oneway) {
        e->glass_tests++;
        if (sli_portal_is_blocked(all->space, from->dfs.at.cell, number)) return SL_OK;
    }
    if (from->place.frame.depth && has_been_in(&me->search, directed->cell)) return SL_OK;
    *to = (step){.dfs.at.cell = directed->cell,
                 .place = {.ends = unfold(e, &from->place.frame, directed->left, directed->right),
                           .frame = from->place.frame,
                           .mirror = UINT32_MAX}};
    if (!may_cross(me, from, &to->place)) return SL_OK;
    SL_TRY(pass_doors(context, all->space, all->effects, e, directed->portal, me->search.count));
    bool something;
    SL_TRY(want(context, all, me, from, number, &something));
    return something ? enter(context, job, from, to, number) : SL_OK;
}

static sl_status reflect(sl_context *context, void *visit, const void *last, void *next,
                         uint32_t number) {
    const sli_dfs_job *job = visit;
    const effects *shared = job->all->effects;
    thread *e = job->me->effects;
    const step *from = last;
    step *to = next;
    const sli_mirror_side *side = &shared->sides.sides[number];
    const sl_segment mirror = shared->plan->map->mirrors[side->mirror].segment;
    e->mirror_steps++;
    // Behind a mirror its own side is behind the line of sight, but for rounding.
    if (from->place.mirror == side->mirror || from->place.frame.depth == shared->plan->mirror_depth)
        return SL_OK;
    *to = (step){.dfs.at.cell = side->cell,
                 .place = {.ends = unfold(e, &from->place.frame, side->left, side->right),
                           .frame = sli_mirror_frame_reflect(&from->place.frame, mirror),
                           .mirror = side->mirror}};
    if (!may_cross(job->me, from, &to->place)) return SL_OK;
    SL_TRY(pass_doors(context, job->all->space, shared, e, UINT32_MAX, job->me->search.count));
    // Behind the mirror another line goes on: bounds before it no longer hold.
    if (job->all->prunes)
        SL_TRY(sli_prune_step_anew(context, &job->me->wanted, job->me->search.count));
    return enter(context, job, from, to, SL_STAB_MIRROR + side->mirror);
}

// --- one source

/// Whether pairs are found from the lower of their cells alone. What is seen by mirror is found
/// from both.
static bool is_halved(const sli_dfs *all) {
    return all->known && all->effects->plan->mutual && !all->effects->mirrors;
}

/// Sets what is wanted of a source: all cells, or those that it may see. Notes the cells that it
/// sees for certain.
static sl_status want_from(sl_context *context, const sli_dfs *all, sli_dfs_thread *me,
                           uint32_t source) {
    if (!all->known) return sli_prune_start(context, &me->wanted, 0);
    const uint32_t first = is_halved(all) ? source : 0;
    SL_TRY(sli_prune_start_with(context, &me->wanted, all->known->possible, source, first));
    sli_door_table *table = &me->effects->direct;
    sli_row_add_to(all->known->certain, source, me->sure);
    sli_row_add_to(all->known->certain, source, table->seen);
    sli_row_add_to(all->known->certain, source, table->free);
    return SL_OK;
}

static sl_status start(sl_context *context, const sli_dfs *all, sli_dfs_thread *me,
                       uint32_t source) {
    thread *e = me->effects;
    sli_door_table_clear(&e->direct);
    sli_door_table_clear(&e->mirrored);
    SL_TRY(SL_ARRAY_ROOM(context, &e->doors, all->effects->door_words + 1));
    memset(e->doors.items, 0, all->effects->door_words * sizeof *e->doors.items);
    SL_TRY(sli_door_table_add(context, &e->direct, source, e->doors.items));
    sl_bits_add(me->sure, source);
    if (all->prunes) SL_TRY(want_from(context, all, me, source));
    SL_TRY(sli_portal_search_start(context, &me->search, sizeof(step)));
    step *first = me->search.steps;
    *first = (step){.dfs.at.cell = source,
                    .place = {.frame = sli_mirror_frame_of_map(), .mirror = UINT32_MAX}};
    return sli_dfs_enter(context, all, me, &first->dfs, 0, UINT32_MAX, true);
}

static sl_status keep(sl_context *context, const sli_dfs *all, sli_dfs_thread *me,
                      uint32_t source) {
    effects *shared = all->effects;
    thread *e = me->effects;
    const uint32_t first = is_halved(all) ? source : 0;
    if (shared->doors)
        SL_TRY(sli_door_table_append(context, &e->direct, first, &shared->door_rows[source]));
    if (!shared->mirrors) return SL_OK;
    SL_TRY(sli_row_append(context, &shared->mirrored_rows[source], e->mirrored.seen,
                          all->space->cell_count));
    if (!shared->doors) return SL_OK;
    return sli_door_table_append(context, &e->mirrored, 0, &shared->mirrored_door_rows[source]);
}

sl_status sli_dfs_effects_search(sl_context *context, const sli_dfs *all, sli_dfs_thread *me,
                                 uint32_t source) {
    static const sli_portal_visitor visitor = {
        .step_size = sizeof(step), .cross = cross, .reflect = reflect};
    SL_TRY(start(context, all, me, source));
    me->search.mirrors = all->effects->mirrors ? &all->effects->sides : NULL;
    sli_dfs_job job = {all, me};
    SL_TRY(sli_portal_search_run(context, &me->search, &visitor, &job));
    return keep(context, all, me, source);
}

// --- begin and end

sl_status sli_dfs_effects_begin(sl_context *context, const sli_dfs *all, sli_dfs_thread *me) {
    me->effects = sl_alloc_array(context, 1, sizeof *me->effects);
    if (!me->effects) return SL_NO_MEMORY;
    const sl_plan *plan = all->effects->plan;
    const size_t doors = all->effects->doors ? plan->map->door_count : 0;
    const uint32_t cells = all->space->cell_count;
    me->effects->all = all->effects;
    SL_TRY(sli_door_table_create(context, cells, doors, plan->door_limit, &me->effects->direct));
    return sli_door_table_create(context, cells, doors, plan->door_limit, &me->effects->mirrored);
}

void sli_dfs_effects_end(sl_context *context, sli_dfs_thread *me) {
    thread *e = me->effects;
    if (!e) return;
    pthread_mutex_lock(e->all->lock);
    e->all->fallbacks += e->direct.fallbacks + e->mirrored.fallbacks;
    e->all->door_steps += e->door_steps;
    e->all->mirror_steps += e->mirror_steps;
    e->all->glass_tests += e->glass_tests;
    e->all->range_tests += e->range_tests;
    e->all->close_calls += e->close_calls;
    e->all->rounded_places += e->rounded_places;
    pthread_mutex_unlock(e->all->lock);
    sli_door_table_destroy(context, &e->direct);
    sli_door_table_destroy(context, &e->mirrored);
    sl_free(context, e->doors.items);
    sl_free(context, e);
    me->effects = NULL;
}

static sl_status find_mirrors(sl_context *context, const sl_space *space, effects *e) {
    SL_TRY(sli_mirror_sides_find(context, space, e->plan->map, &e->sides));
    e->mirror_cells = sl_alloc_array(context, sl_bits_words(space->cell_count), sizeof(sl_bits));
    if (!e->mirror_cells) return SL_NO_MEMORY;
    for (uint32_t c = 0; c < space->cell_count; c++)
        if (e->sides.first[c] < e->sides.first[c + 1]) sl_bits_add(e->mirror_cells, c);
    return SL_OK;
}

sl_status sli_dfs_effects_create(sl_context *context, sli_dfs *all) {
    const sl_plan *plan = all->options->plan;
    const uint32_t cells = all->space->cell_count;
    SL_TRY(sli_plan_check_solver(context, plan, all->options->solver));
    effects *e = all->effects = sl_alloc_array(context, 1, sizeof *e);
    if (!e) return SL_NO_MEMORY;
    e->plan = plan;
    e->lock = &all->lock;
    e->doors = plan->effects & SL_EFFECT_DOOR;
    e->mirrors = plan->effects & SL_EFFECT_MIRROR;
    e->oneway = plan->effects & SL_EFFECT_ONEWAY;
    e->door_words = e->doors ? sl_bits_words(plan->map->door_count) : 0;
    e->door_rows = sl_alloc_array(context, cells, sizeof *e->door_rows);
    e->mirrored_rows = sl_alloc_array(context, cells, sizeof *e->mirrored_rows);
    e->mirrored_door_rows = sl_alloc_array(context, cells, sizeof *e->mirrored_door_rows);
    if (!e->door_rows || !e->mirrored_rows || !e->mirrored_door_rows) return SL_NO_MEMORY;
    return e->mirrors ? find_mirrors(context, all->space, e) : SL_OK;
}

void sli_dfs_effects_destroy(sl_context *context, sli_dfs *all) {
    effects *e = all->effects;
    if (!e) return;
    sli_row_bytes *const rows[] = {e->door_rows, e->mirrored_rows, e->mirrored_door_rows};
    for (size_t i = 0; i < sizeof rows / sizeof *rows; i++) {
        for (uint32_t cell = 0; rows[i] && cell < all->space->cell_count; cell++)
            sl_free(context, rows[i][cell].items);
        sl_free(context, rows[i]);
    }
    sli_mirror_sides_destroy(context, &e->sides);
    sl_free(context, e->mirror_cells);
    sl_free(context, e);
    all->effects = NULL;
}

/// Rows of door sets are joined as those of visible sets are.
static sl_status join_doors(sl_context *context, sli_row_bytes *rows, uint32_t cells,
                            sl_door_sets *out) {
    sl_pvs joined = {0};
    SL_TRY(sli_pvs_join(context, rows, cells, &joined));
    *out = (sl_door_sets){joined.cell_count, joined.offsets, joined.bytes};
    return SL_OK;
}

static sl_status add_row_and_back(sl_context *context, const sl_pvs *rows, const sl_pvs *back,
                                  uint32_t cell, sl_bits *set, sli_row_bytes *out) {
    memset(set, 0, sl_bits_words(rows->cell_count) * sizeof *set);
    sli_row_add_to(rows, cell, set);
    sli_row_add_to(back, cell, set);
    return sli_row_append(context, out, set, rows->cell_count);
}

/// A sightline leads both ways. Rounded places may tell it from one end alone: then it counts from
/// both.
static sl_status add_ways_back(sl_context *context, sl_pvs *mirrored) {
    const uint32_t cells = mirrored->cell_count;
    sl_pvs back = {0}, both = {0};
    SL_TRY(sli_pvs_transpose(context, mirrored, &back));
    sl_bits *set = sl_alloc_array(context, sl_bits_words(cells), sizeof *set);
    sli_row_bytes *rows = sl_alloc_array(context, cells, sizeof *rows);
    sl_status status = set && rows ? SL_OK : SL_NO_MEMORY;
    for (uint32_t i = 0; i < cells && status == SL_OK; i++)
        status = add_row_and_back(context, mirrored, &back, i, set, &rows[i]);
    if (status == SL_OK)
        status = sli_pvs_join(context, rows, cells, &both);
    else if (rows)
        for (uint32_t i = 0; i < cells; i++) sl_free(context, rows[i].items);
    sl_free(context, set);
    sl_free(context, rows);
    sl_pvs_destroy(context, &back);
    SL_TRY(status);
    sl_pvs_destroy(context, mirrored);
    *mirrored = both;
    return SL_OK;
}

sl_status sli_dfs_effects_finish(sl_context *context, sli_dfs *all, sl_visibility *out) {
    effects *e = all->effects;
    const uint32_t cells = all->space->cell_count;
    out->account.effects.door_fallbacks = e->fallbacks;
    out->account.effects.door_steps = e->door_steps;
    out->account.effects.mirror_steps = e->mirror_steps;
    out->account.effects.glass_tests = e->glass_tests;
    out->account.effects.range_tests = e->range_tests;
    out->account.effects.close_calls = e->close_calls;
    out->account.effects.rounded_places = e->rounded_places;
    if (e->doors && is_halved(all)) SL_TRY(sli_door_rows_mirror(context, e->door_rows, cells));
    if (e->doors) SL_TRY(join_doors(context, e->door_rows, cells, &out->doors));
    if (!e->mirrors) return SL_OK;
    SL_TRY(sli_pvs_join(context, e->mirrored_rows, cells, &out->mirrored));
    // With doors each way has door sets of its own, and stays as it was found.
    if (e->rounded_places && e->plan->mutual && !e->doors)
        SL_TRY(add_ways_back(context, &out->mirrored));
    for (uint32_t i = 0; i < cells; i++)
        out->account.mirrored_pairs += sl_pvs_count(&out->mirrored, i);
    if (!e->doors) return SL_OK;
    return join_doors(context, e->mirrored_door_rows, cells, &out->mirrored_doors);
}

// --- in parts

sl_status sli_dfs_effects_hand_over(sl_context *context, sli_dfs *all, sl_partial *found) {
    effects *e = all->effects;
    const uint32_t cells = all->space->cell_count;
    if (!e) return SL_OK;
    found->effects = e->plan->effects;
    found->mirror_depth = e->plan->mirror_depth;
    found->door_limit = e->plan->door_limit;
    found->rounded = e->rounded_places > 0;
    if (e->doors) SL_TRY(join_doors(context, e->door_rows, cells, &found->doors));
    if (e->mirrors) SL_TRY(sli_pvs_join(context, e->mirrored_rows, cells, &found->mirrored));
    if (!e->doors || !e->mirrors) return SL_OK;
    return join_doors(context, e->mirrored_door_rows, cells, &found->mirrored_doors);
}

static sl_status copy_rows(sl_context *context, const sl_pvs *rows, sl_pvs *out) {
    const uint32_t count = rows->cell_count;
    if (!count) return SL_OK;
    out->offsets = sl_alloc_array(context, (size_t)count + 1, sizeof *out->offsets);
    out->bytes = sl_alloc(context, sli_size(rows->offsets[count] + 1));
    if (!out->offsets || !out->bytes) return SL_NO_MEMORY;
    memcpy(out->offsets, rows->offsets, ((size_t)count + 1) * sizeof *out->offsets);
    if (rows->offsets[count]) memcpy(out->bytes, rows->bytes, sli_size(rows->offsets[count]));
    out->cell_count = count;
    return SL_OK;
}

static sl_status copy_doors(sl_context *context, const sl_door_sets *sets, sl_door_sets *out) {
    const sl_pvs rows = {sets->cell_count, sets->offsets, sets->bytes, NULL};
    sl_pvs copy = {0};
    const sl_status status = copy_rows(context, &rows, &copy);
    *out = (sl_door_sets){copy.cell_count, copy.offsets, copy.bytes};
    return status;
}

sl_status sli_dfs_effects_settle(sl_context *context, const sl_plan *plan,
                                 const sl_partial *partial, sl_visibility *out) {
    SL_TRY(copy_rows(context, &partial->mirrored, &out->mirrored));
    SL_TRY(copy_doors(context, &partial->doors, &out->doors));
    SL_TRY(copy_doors(context, &partial->mirrored_doors, &out->mirrored_doors));
    // As of a search that is done in one go.
    const bool has_doors = plan->effects & SL_EFFECT_DOOR;
    if (partial->rounded && plan->mutual && !has_doors && out->mirrored.cell_count)
        SL_TRY(add_ways_back(context, &out->mirrored));
    return SL_OK;
}

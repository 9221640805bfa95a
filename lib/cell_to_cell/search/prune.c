/// The sets that keep a search short: upper bounds for directed portals, and what is still wanted.
///
/// Each step of a search has a set of wanted cells: those that its portal's upper bound and all
/// bounds before it leave possible. The sets of a way lie behind each other in one array, as sorted
/// words that have any bits. A step back takes the last set off.
///
/// Invariant: the set of a step is a subset of the set of the step before it.
#include "cell_to_cell/search/bounds.h"

#include "cell_to_cell/pvs_rows.h"

/// Bounds that would take no more than this as whole rows of bits are all kept.
#define MOST_ROW_BYTES ((size_t)64 << 20)

/// Else those of no more cells than so many: a bound that wide prunes little.
enum { MOST_CELLS = 256 };

// --- bounds

typedef struct bound_finder {
    const sl_space *space;
    const sl_see_options *options;
    const sl_pvs *possible; ///< by cell; NULL: not known
    uint32_t most;          ///< cells of a bound
    sl_bits *set;           ///< of those found through a directed portal
    uint32_t *found;        ///< they
    sli_word_set row;
} bound_finder;

static uint32_t most_cells(const sl_space *space) {
    const size_t bytes = sl_bits_words(space->cell_count) * sizeof(sl_bits);
    if (!bytes || space->directed_count <= MOST_ROW_BYTES / bytes) return space->cell_count;
    return MOST_CELLS;
}

/// Adds the cells that may be seen through a directed portal to the row, or none if they are too
/// many.
static void flood_portal(bound_finder *find, uint32_t directed) {
    const uint32_t count =
        sli_flood_through(find->space, find->options, &find->space->directed[directed], find->most,
                          find->set, find->found);
    for (uint32_t i = 0; i < count; i++) {
        find->set[find->found[i] / 64] = 0;
        if (count <= find->most) sli_word_set_add(&find->row, find->found[i]);
    }
}

static sl_status find_bound(sl_context *context, bound_finder *find, uint32_t directed,
                            sli_prune_bounds *out) {
    sli_word_set *row = &find->row;
    if (find->possible)
        sli_word_set_add_row(row, find->possible, find->space->directed[directed].cell);
    else
        flood_portal(find, directed);
    for (size_t word = sli_word_set_next(row, row->low); word < row->high;
         word = sli_word_set_next(row, word + 1)) {
        SL_TRY(SL_ARRAY_ROOM(context, &out->words, 1));
        out->words.items[out->words.count++] = (sli_prune_word){row->bits[word], (uint32_t)word};
    }
    sli_word_set_clear(row);
    out->offsets[directed + 1] = out->words.count;
    return SL_OK;
}

sl_status sli_prune_bounds_find(sl_context *context, const sl_space *space,
                                const sl_see_options *options, const sl_pvs *possible,
                                sli_prune_bounds *out) {
    const uint32_t count = space->cell_count;
    bound_finder find = {
        .space = space, .options = options, .possible = possible, .most = most_cells(space)};
    *out = (sli_prune_bounds){0};
    out->offsets = sl_alloc_array(context, (size_t)space->directed_count + 1, sizeof *out->offsets);
    find.set = sl_alloc_array(context, sl_bits_words(count), sizeof *find.set);
    find.found = sl_alloc_array(context, count, sizeof *find.found);
    sl_status status = sli_word_set_create(context, count, &find.row);
    if (!out->offsets || !find.set || !find.found) status = SL_NO_MEMORY;
    for (uint32_t i = 0; i < space->directed_count && status == SL_OK; i++) {
        status = find_bound(context, &find, i, out);
        if (status == SL_OK) status = sl_check_cancelled(context);
    }
    sl_free(context, find.set);
    sl_free(context, find.found);
    sli_word_set_destroy(context, &find.row);
    return status;
}

void sli_prune_bounds_destroy(sl_context *context, sli_prune_bounds *bounds) {
    sl_free(context, bounds->offsets);
    sl_free(context, bounds->words.items);
    *bounds = (sli_prune_bounds){0};
}

// --- what is wanted

sl_status sli_prune_start(sl_context *context, sli_prune_wanted *wanted, uint32_t first) {
    SL_TRY(SL_ARRAY_ROOM(context, &wanted->sets, 1));
    wanted->sets.count = 1;
    wanted->sets.items[0] = (sli_prune_set){.all = true};
    wanted->first = first;
    return SL_OK;
}

sl_status sli_prune_start_with(sl_context *context, sli_prune_wanted *wanted, const sl_pvs *pvs,
                               uint32_t cell, uint32_t first) {
    SL_TRY(sli_prune_start(context, wanted, first));
    sli_prune_set *set = &wanted->sets.items[0];
    *set = (sli_prune_set){0};
    for (sl_pvs_run run = sl_pvs_begin(pvs, cell); sl_pvs_next(&run);)
        for (uint32_t member = run.first > first ? run.first : first; member < run.end; member++) {
            const uint32_t word = member / 64;
            if (!set->end || wanted->words.items[set->end - 1].word != word) {
                wanted->words.count = set->end;
                SL_TRY(SL_ARRAY_ROOM(context, &wanted->words, 1));
                wanted->words.items[set->end++] = (sli_prune_word){.word = word};
            }
            wanted->words.items[set->end - 1].bits |= (sl_bits)1 << (member % 64);
        }
    set->top = set->end;
    return SL_OK;
}

sl_status sli_prune_start_among(sl_context *context, sli_prune_wanted *wanted,
                                const sli_word_set *set) {
    SL_TRY(sli_prune_start(context, wanted, 0));
    wanted->words.count = 0;
    for (size_t word = sli_word_set_next(set, set->low); word < set->high;
         word = sli_word_set_next(set, word + 1)) {
        SL_TRY(SL_ARRAY_ROOM(context, &wanted->words, 1));
        wanted->words.items[wanted->words.count++] =
            (sli_prune_word){set->bits[word], (uint32_t)word};
    }
    wanted->sets.items[0] = (sli_prune_set){.end = wanted->words.count, .top = wanted->words.count};
    return SL_OK;
}

/// A bound's words without cells below the first that is wanted.
static void take_from_first(const sli_prune_word *bound, size_t count, sli_prune_wanted *wanted,
                            sli_prune_set *set) {
    const uint32_t word = wanted->first / 64;
    const sl_bits kept = ~(sl_bits)0 << (wanted->first % 64);
    for (size_t i = 0; i < count; i++) {
        const sl_bits bits = bound[i].bits & (bound[i].word == word ? kept : ~(sl_bits)0);
        if (bound[i].word >= word && bits)
            wanted->words.items[set->end++] = (sli_prune_word){bits, bound[i].word};
    }
}

static void take_common(const sli_prune_word *bound, size_t count, const sli_prune_set *before,
                        sli_prune_wanted *wanted, sli_prune_set *set) {
    sli_prune_word *words = wanted->words.items;
    for (size_t i = 0, k = before->begin; i < count && k < before->end;) {
        if (bound[i].word == words[k].word) {
            const sl_bits bits = bound[i].bits & words[k].bits;
            if (bits) words[set->end++] = (sli_prune_word){bits, bound[i].word};
            i++;
            k++;
        } else if (bound[i].word < words[k].word) {
            i++;
        } else {
            k++;
        }
    }
}

sl_status sli_prune_step(sl_context *context, const sli_prune_bounds *bounds,
                         sli_prune_wanted *wanted, size_t step, uint32_t directed) {
    const size_t count = bounds->offsets[directed + 1] - bounds->offsets[directed];
    wanted->sets.count = step;
    SL_TRY(SL_ARRAY_ROOM(context, &wanted->sets, 1));
    const sli_prune_set before = wanted->sets.items[step - 1];
    sli_prune_set *set = &wanted->sets.items[wanted->sets.count++];
    *set = before;
    if (!count) return SL_OK;
    const sli_prune_word *bound = bounds->words.items + bounds->offsets[directed];
    wanted->words.count = before.top;
    SL_TRY(SL_ARRAY_ROOM(context, &wanted->words, count));
    *set = (sli_prune_set){.begin = before.top, .end = before.top};
    if (before.all)
        take_from_first(bound, count, wanted, set);
    else
        take_common(bound, count, &before, wanted, set);
    set->top = set->end;
    return SL_OK;
}

sl_status sli_prune_step_anew(sl_context *context, sli_prune_wanted *wanted, size_t step) {
    wanted->sets.count = step;
    SL_TRY(SL_ARRAY_ROOM(context, &wanted->sets, 1));
    const size_t top = wanted->sets.items[step - 1].top;
    wanted->sets.items[wanted->sets.count++] =
        (sli_prune_set){.begin = top, .end = top, .top = top, .all = true};
    return SL_OK;
}

/// Takes the words of the set before that the row has too.
static void take_from_row(const sli_sparse_row *row, const sli_prune_set *before,
                          sli_prune_wanted *wanted, sli_prune_set *set) {
    const uint32_t *index = row->count == SLI_ALL_WORDS ? NULL : sli_sparse_index(row);
    sli_prune_word *words = wanted->words.items;
    for (size_t i = 0, k = before->begin; k < before->end; k++) {
        const uint32_t word = words[k].word;
        while (index && i < row->count && index[i] < word) i++;
        if (index && i == row->count) break;
        if (index && index[i] != word) continue;
        const sl_bits bits = words[k].bits & row->words[index ? i : word];
        if (bits) words[set->end++] = (sli_prune_word){bits, word};
    }
}

sl_status sli_prune_step_within(sl_context *context, const sli_sparse_row *row,
                                sli_prune_wanted *wanted, size_t step) {
    wanted->sets.count = step;
    SL_TRY(SL_ARRAY_ROOM(context, &wanted->sets, 1));
    const sli_prune_set before = wanted->sets.items[step - 1];
    sli_prune_set *set = &wanted->sets.items[wanted->sets.count++];
    *set = before;
    if (!row->count) return SL_OK;
    wanted->words.count = before.top;
    SL_TRY(SL_ARRAY_ROOM(context, &wanted->words, before.end - before.begin));
    *set = (sli_prune_set){.begin = before.top, .end = before.top};
    take_from_row(row, &before, wanted, set);
    set->top = set->end;
    return SL_OK;
}

void sli_prune_wanted_destroy(sl_context *context, sli_prune_wanted *wanted) {
    sl_free(context, wanted->sets.items);
    sl_free(context, wanted->words.items);
    *wanted = (sli_prune_wanted){0};
}

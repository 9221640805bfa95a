/// Problems that stand for a part in its proof (cover_check.h): copies of columns, and cuts.
///
/// Cost: of copies, the entries of a column for each of its blocks; of cuts, their coefficients,
/// and by column a look at each cut between the first and the last one that it is in.
#include "analysis/placement/cover_check.h"

/// No honest proof has larger demands of cuts, or more entries.
enum { DEMAND_MOST = 1 << 16, ENTRIES_MOST = 1 << 26 };

void sli_made_destroy(sl_context *context, sli_made_problem *made) {
    sl_free(context, made->ends.items);
    sl_free(context, made->entries.items);
    sl_free(context, made->costs.items);
    sl_free(context, made->demands.items);
    *made = (sli_made_problem){0};
}

sl_cover_problem sli_made(const sli_made_problem *made) {
    return (sl_cover_problem){
        (uint32_t)made->demands.count, (uint32_t)made->ends.count, made->ends.items,
        made->entries.items,           made->costs.items,          made->demands.items};
}

static sl_status add_entry(sl_context *context, sli_made_problem *out, uint32_t row) {
    SL_TRY(SL_ARRAY_ROOM(context, &out->entries, 1));
    out->entries.items[out->entries.count++] = row;
    return SL_OK;
}

static sl_status end_column(sl_context *context, sli_made_problem *out, uint32_t cost) {
    SL_TRY(SL_ARRAY_ROOM(context, &out->ends, 1));
    SL_TRY(SL_ARRAY_ROOM(context, &out->costs, 1));
    out->ends.items[out->ends.count++] = out->entries.count;
    out->costs.items[out->costs.count++] = cost;
    return SL_OK;
}

static sl_status copy_demands(sl_context *context, const sl_cover_problem *part,
                              sli_made_problem *out) {
    SL_TRY(SL_ARRAY_ROOM(context, &out->demands, part->row_count));
    for (uint32_t r = 0; r < part->row_count; r++)
        out->demands.items[out->demands.count++] = part->demands[r];
    return SL_OK;
}

// --- copies

typedef SL_ARRAY(uint32_t) block_list;

static sl_status list_blocks(sl_context *context, const sl_cover_problem *part,
                             const sl_cover_split *split, uint32_t column, block_list *blocks) {
    blocks->count = 0;
    for (size_t i = sli_checked_begin(part, column); i < part->ends[column]; i++) {
        const uint32_t block = split->blocks[part->entries[i]];
        size_t k = 0;
        while (k < blocks->count && blocks->items[k] != block) k++;
        if (k < blocks->count) continue;
        SL_TRY(SL_ARRAY_ROOM(context, blocks, 1));
        blocks->items[blocks->count++] = block;
    }
    return SL_OK;
}

static sl_status copy_column(sl_context *context, const sl_cover_problem *part,
                             const sl_cover_split *split, uint32_t column, block_list *blocks,
                             sli_made_problem *out, bool *sense) {
    uint64_t cost = 0;
    SL_TRY(list_blocks(context, part, split, column, blocks));
    for (size_t k = 0; k < blocks->count && *sense; k++) {
        for (size_t i = sli_checked_begin(part, column); i < part->ends[column]; i++)
            if (split->blocks[part->entries[i]] == blocks->items[k])
                SL_TRY(add_entry(context, out, part->entries[i]));
        *sense = out->ends.count < split->cost_count && split->costs[out->ends.count];
        if (!*sense) break;
        cost += split->costs[out->ends.count];
        SL_TRY(end_column(context, out, split->costs[out->ends.count]));
    }
    *sense = *sense && cost <= (uint64_t)split->unit * part->costs[column];
    return SL_OK;
}

sl_status sli_make_copies(sl_context *context, const sl_cover_problem *part,
                          const sl_cover_split *split, sli_made_problem *out, bool *sense) {
    block_list blocks = {0};
    *sense = split->unit && split->row_count == part->row_count;
    sl_status status = copy_demands(context, part, out);
    for (uint32_t j = 0; j < part->column_count && *sense && status == SL_OK; j++)
        status = copy_column(context, part, split, j, &blocks, out, sense);
    *sense = *sense && out->ends.count == split->cost_count;
    sl_free(context, blocks.items);
    return status;
}

// --- cuts

/// By row, and cut as a row: the cuts that are made of it. And the sums of a column.
typedef struct users {
    size_t *first;  ///< one more than there are
    uint32_t *cuts; ///< ascending for each
    uint64_t *sums; ///< by row: 1 where the column has it; by cut as a row: of what it is made of
    size_t begin, end; ///< among cuts as rows: only these have sums
} users;

static sl_status list_users(sl_context *context, const sl_cover_cuts *cuts, users *out) {
    const size_t rows = (size_t)cuts->row_count + cuts->cut_count;
    const size_t count = cuts->cut_count ? cuts->ends[cuts->cut_count - 1] : 0;
    out->first = sl_alloc_array(context, rows + 2, sizeof *out->first);
    out->cuts = sl_alloc_array(context, count, sizeof *out->cuts);
    out->sums = sl_alloc_array(context, rows, sizeof *out->sums);
    if (!out->first || !out->cuts || !out->sums) return SL_NO_MEMORY;
    for (size_t k = 0; k < count; k++) out->first[cuts->rows[k] + 2]++;
    for (size_t r = 0; r < rows; r++) out->first[r + 2] += out->first[r + 1];
    for (uint32_t cut = 0; cut < cuts->cut_count; cut++)
        for (size_t k = cut ? cuts->ends[cut - 1] : 0; k < cuts->ends[cut]; k++)
            out->cuts[out->first[cuts->rows[k] + 1]++] = cut;
    return SL_OK;
}

/// Adds a row's coefficient to the sums of the cuts that are made of it.
static void add_up(users *u, uint32_t rows, uint32_t row, uint64_t coefficient) {
    for (size_t k = u->first[row]; k < u->first[row + 1]; k++) {
        const size_t cut = rows + (size_t)u->cuts[k];
        u->sums[cut] += coefficient;
        if (cut < u->begin) u->begin = cut;
        if (cut >= u->end) u->end = cut + 1;
    }
}

/// A column's coefficients in the cuts come after those of the rows: a cut has only earlier ones.
static sl_status raise_column(sl_context *context, const sl_cover_problem *part, uint32_t column,
                              users *u, sli_made_problem *out, bool *sense) {
    const uint32_t rows = part->row_count;
    u->begin = SIZE_MAX;
    u->end = 0;
    for (size_t i = sli_checked_begin(part, column); i < part->ends[column]; i++) {
        const uint32_t row = part->entries[i];
        if (!u->sums[row]) add_up(u, rows, row, 1);
        u->sums[row] = 1;
        SL_TRY(add_entry(context, out, row));
    }
    for (size_t i = sli_checked_begin(part, column); i < part->ends[column]; i++)
        u->sums[part->entries[i]] = 0;
    for (size_t cut = u->begin; cut < u->end; cut++) {
        const uint64_t half = (u->sums[cut] + 1) / 2, demand = out->demands.items[cut];
        const uint64_t coefficient = half < demand ? half : demand;
        u->sums[cut] = 0;
        if (coefficient) add_up(u, rows, (uint32_t)cut, coefficient);
        *sense = out->entries.count + coefficient <= ENTRIES_MOST;
        if (!*sense) return SL_OK;
        for (uint64_t n = 0; n < coefficient; n++) SL_TRY(add_entry(context, out, (uint32_t)cut));
    }
    *sense = out->entries.count <= ENTRIES_MOST;
    return end_column(context, out, part->costs[column]);
}

/// The demands of the cuts, behind those of the rows.
static sl_status raise_demands(sl_context *context, const sl_cover_cuts *cuts,
                               sli_made_problem *out, bool *sense) {
    for (uint32_t cut = 0; cut < cuts->cut_count && *sense; cut++) {
        const size_t first = cut ? cuts->ends[cut - 1] : 0;
        uint64_t sum = 0;
        *sense = first <= cuts->ends[cut];
        for (size_t k = first; k < cuts->ends[cut] && *sense; k++) {
            *sense = cuts->rows[k] < out->demands.count &&
                     (k == first || cuts->rows[k] > cuts->rows[k - 1]);
            if (*sense) sum += out->demands.items[cuts->rows[k]];
        }
        *sense = *sense && sum <= 2 * DEMAND_MOST;
        SL_TRY(SL_ARRAY_ROOM(context, &out->demands, 1));
        out->demands.items[out->demands.count++] = (uint32_t)((sum + 1) / 2);
    }
    return SL_OK;
}

sl_status sli_make_raised(sl_context *context, const sl_cover_problem *part,
                          const sl_cover_cuts *cuts, sli_made_problem *out, bool *sense) {
    *sense = cuts->row_count == part->row_count;
    if (!*sense) return SL_OK;
    SL_TRY(copy_demands(context, part, out));
    SL_TRY(raise_demands(context, cuts, out, sense));
    if (!*sense) return SL_OK;
    users u = {0};
    sl_status status = list_users(context, cuts, &u);
    for (uint32_t j = 0; j < part->column_count && *sense && status == SL_OK; j++)
        status = raise_column(context, part, j, &u, out, sense);
    sl_free(context, u.first);
    sl_free(context, u.cuts);
    sl_free(context, u.sums);
    return status;
}

/// Problems that stand for a part in its proof (cover_check.h): copies of columns, and cuts.
///
/// Cost: of copies, the entries of a column for each of its blocks; of cuts, their coefficients.
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

/// A column's coefficients in the cuts come after those of the rows: a cut has only earlier ones.
static sl_status raise_column(sl_context *context, const sl_cover_problem *part,
                              const sl_cover_cuts *cuts, uint32_t column, uint64_t *coefficients,
                              sli_made_problem *out, bool *sense) {
    const uint32_t rows = part->row_count;
    for (uint32_t r = 0; r < rows; r++) coefficients[r] = 0;
    for (size_t i = sli_checked_begin(part, column); i < part->ends[column]; i++) {
        coefficients[part->entries[i]] = 1;
        SL_TRY(add_entry(context, out, part->entries[i]));
    }
    for (uint32_t cut = 0; cut < cuts->cut_count; cut++) {
        uint64_t sum = 0;
        for (size_t k = cut ? cuts->ends[cut - 1] : 0; k < cuts->ends[cut]; k++)
            sum += coefficients[cuts->rows[k]];
        const uint64_t half = (sum + 1) / 2, demand = out->demands.items[rows + cut];
        coefficients[rows + cut] = half < demand ? half : demand;
        *sense = out->entries.count + coefficients[rows + cut] <= ENTRIES_MOST;
        if (!*sense) return SL_OK;
        for (uint64_t n = 0; n < coefficients[rows + cut]; n++)
            SL_TRY(add_entry(context, out, rows + cut));
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
    uint64_t *coefficients = sl_alloc_array(context, out->demands.count, sizeof *coefficients);
    if (!coefficients) return SL_NO_MEMORY;
    sl_status status = SL_OK;
    for (uint32_t j = 0; j < part->column_count && *sense && status == SL_OK; j++)
        status = raise_column(context, part, cuts, j, coefficients, out, sense);
    sl_free(context, coefficients);
    return status;
}

/// What units of the work have found, joined.
#include "cell_to_cell/findings.h"

#include "cell_to_cell/pvs_maker.h"

void sl_findings_destroy(sl_context *context, sl_findings *findings) {
    sl_free(context, findings->done);
    sl_pvs_destroy(context, &findings->sure);
    sl_pvs_destroy(context, &findings->doubtful);
    *findings = (sl_findings){0};
}

bool sl_findings_begun(const sl_findings *findings) {
    return findings->sure.cell_count != 0;
}

bool sl_findings_complete(const sl_findings *findings) {
    return sl_findings_begun(findings) && findings->done_count == findings->unit_count;
}

uint32_t sl_findings_left(const sl_findings *f) {
    uint32_t left = 0;
    for (uint32_t i = 0; i < f->unit_count; i++)
        left += sl_unit_is_of(f->shard, f->shard_count, i) && !sl_bits_has(f->done, i);
    return left;
}

static sl_status make_empty_rows(sl_context *context, uint32_t count, sl_pvs *pvs) {
    pvs->offsets = sl_alloc_array(context, (size_t)count + 1, sizeof *pvs->offsets);
    pvs->bytes = sl_alloc_array(context, 1, 1);
    pvs->cell_count = count;
    return pvs->offsets && pvs->bytes ? SL_OK : SL_NO_MEMORY;
}

static sl_status make_empty(sl_context *context, uint32_t cell_count, sl_findings *findings) {
    SL_TRY(make_empty_rows(context, cell_count, &findings->sure));
    SL_TRY(make_empty_rows(context, cell_count, &findings->doubtful));
    findings->done =
        sl_alloc_array(context, sl_bits_words(findings->unit_count), sizeof *findings->done);
    return findings->done ? SL_OK : SL_NO_MEMORY;
}

sl_status sl_findings_start(sl_context *context, const sl_space *space,
                            const sl_see_options *options, uint32_t unit_count,
                            sl_findings *findings) {
    if (options->shard_count ? !options->shard || options->shard > options->shard_count
                             : options->shard)
        return sl_fail(context, SL_BAD_ARGUMENT, "there is no shard %u of %u", options->shard,
                       options->shard_count);
    if (options->plan && options->plan->effects)
        return sl_fail(context, SL_UNSUPPORTED,
                       "a map with effects is baked in one go: leave them out, --without, or do "
                       "without parts");
    if (sl_findings_begun(findings)) {
        if (findings->sure.cell_count != space->cell_count || findings->unit_count != unit_count ||
            findings->inside_only != options->inside_only)
            return sl_fail(context, SL_BAD_ARGUMENT, "findings of another space or other options");
    } else {
        sl_findings empty = {.unit_count = unit_count, .inside_only = options->inside_only};
        const sl_status status = make_empty(context, space->cell_count, &empty);
        if (status != SL_OK) {
            sl_findings_destroy(context, &empty);
            return status;
        }
        *findings = empty;
    }
    findings->shard = options->shard;
    findings->shard_count = options->shard_count;
    return SL_OK;
}

static void count_done(sl_findings *findings) {
    findings->done_count = 0;
    for (size_t i = 0; i < sl_bits_words(findings->unit_count); i++)
        findings->done_count += (uint32_t)__builtin_popcountll(findings->done[i]);
}

void sl_findings_note(sl_findings *findings, const sl_bits *done) {
    for (size_t i = 0; i < sl_bits_words(findings->unit_count); i++) findings->done[i] |= done[i];
    count_done(findings);
}

void sl_findings_note_bytes(sl_findings *findings, const uint8_t *done) {
    for (uint32_t i = 0; i < findings->unit_count; i++)
        if (done[i]) sl_bits_add(findings->done, i);
    count_done(findings);
}

// --- joining

static sl_status make_union(sl_context *context, const sl_pvs *a, const sl_pvs *b,
                            sl_pvs_maker *maker, sl_pvs *out) {
    SL_TRY(sl_pvs_maker_create(context, a->cell_count, a->cell_count, maker));
    for (uint32_t cell = 0; cell < a->cell_count; cell++) {
        sl_pvs_maker_add(maker, a, cell);
        sl_pvs_maker_add(maker, b, cell);
        SL_TRY(sl_pvs_maker_end_row(context, maker));
    }
    return sl_pvs_maker_finish(context, maker, out);
}

static sl_status join_rows(sl_context *context, const sl_pvs *a, const sl_pvs *b, sl_pvs *out) {
    sl_pvs_maker maker;
    const sl_status status = make_union(context, a, b, &maker, out);
    sl_pvs_maker_destroy(context, &maker);
    return status;
}

sl_status sl_findings_join(sl_context *context, sl_findings *findings, const sl_findings *other) {
    if (findings->sure.cell_count != other->sure.cell_count ||
        findings->unit_count != other->unit_count || findings->inside_only != other->inside_only)
        return sl_fail(context, SL_BAD_ARGUMENT, "findings of another space or other options");
    sl_pvs sure = {0}, doubtful = {0};
    sl_status status = join_rows(context, &findings->sure, &other->sure, &sure);
    if (status == SL_OK)
        status = join_rows(context, &findings->doubtful, &other->doubtful, &doubtful);
    if (status != SL_OK) {
        sl_pvs_destroy(context, &sure);
        return status;
    }
    sl_pvs_destroy(context, &findings->sure);
    sl_pvs_destroy(context, &findings->doubtful);
    findings->sure = sure;
    findings->doubtful = doubtful;
    sl_findings_note(findings, other->done);
    return SL_OK;
}

sl_status sl_bit_rows_add_pvs(sl_context *context, sl_bit_rows *rows, const sl_pvs *pvs) {
    sl_word_set set;
    SL_TRY(sl_word_set_create(context, rows->count, &set));
    sl_status status = SL_OK;
    for (uint32_t cell = 0; cell < pvs->cell_count && status == SL_OK; cell++) {
        if (pvs->offsets[cell] == pvs->offsets[cell + 1]) continue;
        sl_word_set_add_row(&set, pvs, cell);
        status = sl_bit_rows_add(context, rows, cell, &set);
        sl_word_set_clear(&set);
    }
    sl_word_set_destroy(context, &set);
    return status;
}

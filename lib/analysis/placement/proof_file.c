/// Files of proofs for viewpoints anywhere (place_proof.h).
#include "sightline/place_proof.h"

#include "analysis/placement/proof_json.h"
#include "sightline/support.h"

#include <inttypes.h>
#include <math.h>
#include <string.h>

// --- writing

static void put_columns(FILE *f, const sl_cover_problem *all) {
    size_t at = 0;
    fprintf(f, ",\n\"columns\": [");
    for (uint32_t k = 0; k < all->column_count; k++) {
        fprintf(f, "%s\n[", k ? "," : "");
        for (size_t first = at; at < all->ends[k]; at++)
            fprintf(f, "%s%" PRIu32, at > first ? ", " : "", all->entries[at]);
        fprintf(f, "]");
    }
    fprintf(f, "]");
}

sl_status sl_place_proof_print(sl_context *context, sl_query *query, const sl_placement *p,
                               FILE *f) {
    const sl_space *space;
    SL_TRY(sl_query_space(context, query, &space, NULL));
    sli_proof_put_head(f, SLI_PROOF_ANYWHERE, space);
    fprintf(f, ",\n\"lower\": %" PRIu64 ",\n\"upper\": %" PRIu64, p->lower, p->upper);
    sli_proof_put_points(f, "viewpoints", p->viewpoints, sizeof *p->viewpoints, p->count);
    sli_proof_put_points(f, "witnesses", p->witnesses, sizeof *p->witnesses, p->witness_count);
    put_columns(f, &p->columns);
    sli_proof_put_cover(f, &p->proof);
    SL_TRY(sli_proof_put_program(context, f, &p->columns));
    fprintf(f, "}\n");
    return SL_OK;
}

sl_status sl_place_proof_write(sl_context *context, sl_query *query, const sl_placement *placement,
                               const char *path) {
    sl_output output;
    SL_TRY(sl_output_open(context, path, &output));
    return sl_output_close(context, &output,
                           sl_place_proof_print(context, query, placement, output.stream));
}

// --- reading

static sl_status read_viewpoints(sli_proof_reader *r, sl_placement *out) {
    sli_proof_points all = {0};
    sl_status status = sli_proof_read_points(r, "viewpoints", &all);
    if (status == SL_OK && all.count != out->upper)
        status = sli_proof_fail(r, "there are not as many as \"upper\" says");
    if (status == SL_OK) {
        out->viewpoints = sl_alloc_array(r->context, all.count, sizeof *out->viewpoints);
        if (!out->viewpoints) status = SL_NO_MEMORY;
    }
    for (size_t i = 0; status == SL_OK && i < all.count; i++)
        out->viewpoints[i] = (sl_viewpoint){.at = all.items[i], .fov = 360};
    if (status == SL_OK) out->count = (uint32_t)all.count;
    sl_free(r->context, all.items);
    return status;
}

static sl_status read_witnesses(sli_proof_reader *r, sl_placement *out) {
    sli_proof_points all = {0};
    sl_status status = sli_proof_read_points(r, "witnesses", &all);
    if (status == SL_OK) {
        out->witnesses = sl_alloc_array(r->context, all.count, sizeof *out->witnesses);
        if (!out->witnesses) status = SL_NO_MEMORY;
    }
    for (size_t i = 0; status == SL_OK && i < all.count; i++)
        out->witnesses[i] = (sl_witness){all.items[i], true};
    if (status == SL_OK) out->witness_count = (uint32_t)all.count;
    sl_free(r->context, all.items);
    return status;
}

static sl_status keep_columns(sli_proof_reader *r, const sli_proof_numbers *entries,
                              const sli_proof_numbers *ends, sl_placement *out) {
    size_t *all_ends = sl_alloc_array(r->context, ends->count, sizeof *all_ends);
    uint32_t *all = sl_alloc_array(r->context, entries->count, sizeof *all);
    out->columns =
        (sl_cover_problem){out->witness_count, (uint32_t)ends->count, all_ends, all, NULL, NULL};
    if (!all_ends || !all) return SL_NO_MEMORY;
    size_t at = 0;
    for (size_t k = 0; k < ends->count; k++)
        for (all_ends[k] = (size_t)ends->items[k]; at < all_ends[k]; at++) {
            const bool first = at == (k ? all_ends[k - 1] : 0);
            if (!first && entries->items[at] <= entries->items[at - 1])
                return sli_proof_fail(r, "witnesses of a column must ascend");
            all[at] = (uint32_t)entries->items[at];
        }
    return SL_OK;
}

static sl_status read_columns(sli_proof_reader *r, sl_placement *out) {
    sli_proof_numbers entries = {0}, ends = {0};
    const uint64_t most = out->witness_count ? out->witness_count - 1 : 0;
    sl_status status = sli_proof_table(r, "columns", 0, most, 0, &entries, &ends);
    if (status == SL_OK && entries.count && !out->witness_count)
        status = sli_proof_fail(r, "there are no witnesses");
    if (status == SL_OK) status = keep_columns(r, &entries, &ends, out);
    sl_free(r->context, entries.items);
    sl_free(r->context, ends.items);
    return status;
}

static sl_status read_all(sli_proof_reader *r, const sl_space *space, sl_placement *out) {
    SL_TRY(sli_proof_read_head(r, SLI_PROOF_ANYWHERE, space));
    SL_TRY(sli_proof_member(r, "lower", UINT64_MAX, &out->lower));
    SL_TRY(sli_proof_member(r, "upper", UINT32_MAX, &out->upper));
    SL_TRY(read_viewpoints(r, out));
    SL_TRY(read_witnesses(r, out));
    SL_TRY(read_columns(r, out));
    SL_TRY(sli_proof_read_cover(r, out->witness_count, &out->proof));
    return sli_proof_read_end(r);
}

sl_status sl_place_proof_parse(sl_context *context, sl_query *query, const char *path,
                               const char *text, size_t size, sl_placement *out) {
    const sl_space *space;
    sli_proof_reader r = sli_proof_reader_of(context, path, text, size);
    *out = (sl_placement){0};
    SL_TRY(sl_query_space(context, query, &space, NULL));
    const sl_status status = read_all(&r, space, out);
    if (status != SL_OK) sl_placement_destroy(context, out);
    return status;
}

sl_status sl_place_proof_read(sl_context *context, sl_query *query, const char *path,
                              sl_placement *out) {
    sl_bytes text;
    *out = (sl_placement){0};
    SL_TRY(sl_file_read(context, path, &text));
    const sl_status status = sl_place_proof_parse(context, query, path, text.data, text.size, out);
    sl_free(context, text.data);
    return status;
}

/// Files of proofs for placements among given places (place_proof.h).
#include "analysis/placement/area_proof.h"
#include "analysis/placement/proof_json.h"

#include <inttypes.h>

sl_status sli_area_proof_refuse(sl_context *context, sl_query *query, const sl_place_area *area) {
    const sl_map *map = sl_query_map(query);
    const char *what = area->network      ? "networks"
                       : area->count      ? "the most that a number of places sees"
                       : area->line_count ? "lines to be seen"
                       : area->scan_angle > 0 || area->scan_range > 0 ? "walls to scan"
                       : map->mirror_count                            ? "mirrors"
                       : map->oneway_count                            ? "one-way glass"
                       : sl_map_limited_walls(map)                    ? "limited walls"
                                                                      : NULL;
    return what ? sl_fail(context, SL_UNSUPPORTED, "proofs of placements do not support %s", what)
                : SL_OK;
}

/// A number for the places and the area. It keeps mistakes away, not forgers: the check itself asks
/// for both.
static uint64_t sum_of(const sl_query *query, const sl_place_area *a) {
    uint64_t sum = sli_proof_mix(a->place_count, a->cover > 1 ? a->cover : 1);
    sum = sli_proof_mix_real(sum, sl_query_range(query));
    for (uint32_t i = 0; i < a->place_count; i++) {
        const sl_viewpoint *v = &a->places[i];
        sum = sli_proof_mix_point(sum, v->at);
        sum = sli_proof_mix_point(sum, (sl_point){v->fov < 360 ? v->heading : 0, v->fov});
        sum = sli_proof_mix_point(sum, (sl_point){v->range, v->nearest});
        sum = sli_proof_mix(sum, a->costs ? a->costs[i] : 1);
    }
    for (uint32_t i = 0; i < a->fixed_count; i++) sum = sli_proof_mix(sum, a->fixed[i]);
    for (size_t l = 0, i = 0; a->see && l < a->see->count; l++)
        for (sum = sli_proof_mix(sum, a->see->ends[l]); i < a->see->ends[l]; i++)
            sum = sli_proof_mix_point(sum, a->see->points[i]);
    return sum;
}

// --- writing

sl_status sl_place_area_proof_print(sl_context *context, sl_query *query, const sl_place_area *area,
                                    const sl_area_placement *p, FILE *f) {
    const sl_space *space;
    sl_cover_problem program = p->columns;
    program.costs = area->costs;
    SL_TRY(sli_area_proof_refuse(context, query, area));
    SL_TRY(sl_query_space(context, query, &space, NULL));
    sli_proof_put_head(f, SLI_PROOF_AREA, space);
    fprintf(f, ",\n\"places\": %" PRIu32 ",\n\"places_sum\": %" PRIu64, area->place_count,
            sum_of(query, area));
    fprintf(f, ",\n\"lower\": %" PRIu64 ",\n\"upper\": %" PRIu64, p->lower, p->upper);
    sli_proof_put_numbers(f, "chosen", p->chosen, p->count);
    sli_proof_put_points(f, "witnesses", p->witnesses, sizeof *p->witnesses, p->columns.row_count);
    sli_proof_put_numbers(f, "demands", p->columns.demands, p->columns.row_count);
    sli_proof_put_cover(f, &p->proof);
    SL_TRY(sli_proof_put_program(context, f, &program));
    fprintf(f, "}\n");
    return SL_OK;
}

sl_status sl_place_area_proof_write(sl_context *context, sl_query *query, const sl_place_area *area,
                                    const sl_area_placement *placement, const char *path) {
    sl_output output;
    SL_TRY(sl_output_open(context, path, &output));
    return sl_output_close(
        context, &output,
        sl_place_area_proof_print(context, query, area, placement, output.stream));
}

// --- reading

static sl_status read_numbers(sli_proof_reader *r, const char *name, uint64_t most,
                              uint32_t **numbers, uint32_t *count) {
    sli_proof_numbers all = {0};
    sl_status status = sli_proof_key(r, name);
    if (status == SL_OK) status = sli_proof_list(r, most, 0, &all);
    if (status == SL_OK && all.count >= UINT32_MAX / 4)
        status = sli_proof_fail(r, "there are too many");
    if (status == SL_OK) {
        *numbers = sl_alloc_array(r->context, all.count, sizeof **numbers);
        if (!*numbers) status = SL_NO_MEMORY;
    }
    for (size_t i = 0; status == SL_OK && i < all.count; i++)
        (*numbers)[i] = (uint32_t)all.items[i];
    if (status == SL_OK) *count = (uint32_t)all.count;
    sl_free(r->context, all.items);
    return status;
}

static sl_status read_witnesses(sli_proof_reader *r, sl_area_placement *out) {
    sli_proof_points points = {0};
    uint32_t *demands = NULL, count = 0;
    sl_status status = sli_proof_read_points(r, "witnesses", &points);
    out->witnesses = points.items;
    if (status == SL_OK) status = read_numbers(r, "demands", UINT32_MAX, &demands, &count);
    out->columns.demands = demands;
    if (status == SL_OK && count != points.count)
        status = sli_proof_fail(r, "there must be one for each witness");
    if (status != SL_OK) return status;
    out->witness_count = out->columns.row_count = count;
    return SL_OK;
}

static sl_status read_all(sli_proof_reader *r, sl_query *query, const sl_place_area *area,
                          sl_area_placement *out) {
    const sl_space *space;
    uint64_t places, sum;
    SL_TRY(sl_query_space(r->context, query, &space, NULL));
    SL_TRY(sli_proof_read_head(r, SLI_PROOF_AREA, space));
    SL_TRY(sli_proof_member(r, "places", UINT64_MAX, &places));
    SL_TRY(sli_proof_member(r, "places_sum", UINT64_MAX, &sum));
    if (places != area->place_count)
        return sl_fail_at(r->context, r->path, r->line,
                          "this proof is of %" PRIu64 " places and headings, and these are %" PRIu32
                          ": ask as the one did who wrote it",
                          places, area->place_count);
    if (sum != sum_of(query, area))
        return sl_fail_at(r->context, r->path, r->line,
                          "this proof is of other places, or of another area to see: ask as the "
                          "one did who wrote it");
    SL_TRY(sli_proof_member(r, "lower", UINT64_MAX, &out->lower));
    SL_TRY(sli_proof_member(r, "upper", UINT64_MAX, &out->upper));
    SL_TRY(read_numbers(r, "chosen", UINT32_MAX, &out->chosen, &out->count));
    SL_TRY(read_witnesses(r, out));
    SL_TRY(sli_proof_read_cover(r, out->columns.row_count, &out->proof));
    return sli_proof_read_end(r);
}

sl_status sl_place_area_proof_parse(sl_context *context, sl_query *query, const sl_place_area *area,
                                    const char *path, const char *text, size_t size,
                                    sl_area_placement *out) {
    sli_proof_reader r = sli_proof_reader_of(context, path, text, size);
    *out = (sl_area_placement){0};
    SL_TRY(sli_area_proof_refuse(context, query, area));
    const sl_status status = read_all(&r, query, area, out);
    if (status != SL_OK) sl_area_placement_destroy(context, out);
    return status;
}

sl_status sl_place_area_proof_read(sl_context *context, sl_query *query, const sl_place_area *area,
                                   const char *path, sl_area_placement *out) {
    sl_bytes text;
    *out = (sl_area_placement){0};
    SL_TRY(sl_file_read(context, path, &text));
    const sl_status status =
        sl_place_area_proof_parse(context, query, area, path, text.data, text.size, out);
    sl_free(context, text.data);
    return status;
}

// The baked file: whatever is read is sound, and is written and read back the same.
#include "bake/export.h"
#include "slv_mutator.h"

static void check_trees(const sl_baked *baked) {
    const sl_space *space = &baked->space;
    const sl_stab_trees *trees = &baked->visibility.trees;
    for (uint32_t cell = 0; cell < trees->cell_count; cell++) {
        const sl_stab_node *nodes = trees->nodes + trees->offsets[cell];
        const uint64_t count = trees->offsets[cell + 1] - trees->offsets[cell];
        for (uint64_t i = 0; i < count; i++) {
            FUZZ_CHECK(nodes[i].cell < space->cell_count && nodes[i].parent <= i);
            if (sl_stab_is_mirror(&nodes[i])) {
                FUZZ_CHECK(nodes[i].directed - SL_STAB_MIRROR < baked->map.mirror_count);
                FUZZ_CHECK(nodes[nodes[i].parent].cell == nodes[i].cell);
            } else
                FUZZ_CHECK(i == 0 || space->directed[nodes[i].directed].cell == nodes[i].cell);
        }
    }
}

static void check_baked(sl_context *context, const sl_baked *baked) {
    const sl_space *space = &baked->space;
    const sl_pvs *pvs = &baked->visibility.pvs;
    FUZZ_CHECK(sl_space_check(context, space) == SL_OK);
    FUZZ_CHECK(pvs->cell_count == space->cell_count && !baked->map.wall_count);
    const sl_box *b = &space->bounds;
    FUZZ_CHECK(fabs(b->min.x) <= 2e150 && fabs(b->min.y) <= 2e150);
    FUZZ_CHECK(fabs(b->max.x) <= 2e150 && fabs(b->max.y) <= 2e150);
    for (uint32_t cell = 0; cell < space->cell_count; cell++) {
        FUZZ_CHECK(isfinite(sl_space_area(space, cell)));
        FUZZ_CHECK(sl_pvs_count(pvs, cell) <= space->cell_count);
        if (sl_baked_counts(baked, cell)) FUZZ_CHECK(sl_pvs_sees(pvs, cell, cell));
        const sl_point corner = space->vertices[space->cells[cell].first_vertex];
        // Several cells of a mesh hold their common corner; those of a loose space may leave
        // bounds.
        const uint32_t found = sl_space_locate(space, corner);
        const bool open = found != SL_NO_CELL && !space->cells[found].solid;
        // The border of solid ground is not solid.
        FUZZ_CHECK(open || space->cells[cell].solid || space->loose);
        if (!(open && space->cells[cell].solid))
            FUZZ_CHECK(space->neighbour ? found <= cell || space->loose : found == cell);
    }
    check_trees(baked);
    const sl_export_options none = {0};
    FUZZ_CHECK(sli_export_json(context, baked, &none, "/dev/null") == SL_OK);
}

/// Parses the file; true with its bytes as they are written again, for free(), where it is sound.
static bool parse(const uint8_t *data, size_t size, char **bytes, size_t *written) {
    sl_context *context = fuzz_context();
    sl_baked baked = {0};
    const sl_status status = sl_baked_parse(context, "input", data, size, &baked);
    if (status == SL_OK) {
        check_baked(context, &baked);
        *bytes = baked_bytes(context, &baked, written);
    } else {
        const sl_baked empty = {0};
        fuzz_refused(context, status, &baked.map);
        FUZZ_CHECK(memcmp(&baked, &empty, sizeof empty) == 0);
    }
    sl_baked_destroy(context, &baked);
    sl_context_destroy(context);
    return status == SL_OK;
}

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size) {
    char *first = NULL, *second = NULL, *from_text = NULL;
    size_t first_size = 0, second_size = 0;
    const bool is_text = !is_baked(data, size) && size;
    if (is_text) from_text = baked_text(data, size, &size);
    if (is_text && !from_text) return 0;
    const bool sound =
        parse(is_text ? (const uint8_t *)from_text : data, size, &first, &first_size);
    FUZZ_CHECK(sound || !is_text);
    if (sound) {
        FUZZ_CHECK(parse((const uint8_t *)first, first_size, &second, &second_size));
        FUZZ_CHECK(first_size == second_size && memcmp(first, second, first_size) == 0);
        if (is_text) FUZZ_CHECK(first_size == size && memcmp(first, from_text, size) == 0);
    }
    free(from_text);
    free(first);
    free(second);
    return 0;
}

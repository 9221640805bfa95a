// The runtime for games: no file makes it read or write out of bounds (the sanitizers watch) or
// come to no end, and of what the library reads it says what the library says.
#include "slv_mutator.h"

#include "runtime_calls.h"

static void check_located(const sl_runtime *r, const sl_space *s, sl_point p) {
    FUZZ_CHECK(sl_runtime_locate(r, p.x, p.y) == sl_space_locate(s, p));
}

/// The runtime opens whatever the library reads, and finds the same in it.
static void check_same(const uint8_t *bytes, size_t size, sl_runtime_status status,
                       const sl_runtime *r, sl_random *random) {
    sl_context *context = fuzz_context();
    sl_baked baked = {0};
    if (sl_baked_parse(context, "input", bytes, size, &baked) == SL_OK) {
        const sl_space *s = &baked.space;
        FUZZ_CHECK(status == SL_RUNTIME_OK && r->cell_count == s->cell_count);
        FUZZ_CHECK(r->door_count == baked.map.door_count && r->range == baked.map.range);
        FUZZ_CHECK(r->start_count == baked.map.start_count);
        for (uint32_t from = 0; from < s->cell_count; from++)
            for (uint32_t to = 0; to < s->cell_count; to++)
                FUZZ_CHECK(sl_runtime_can_see(r, from, to) ==
                           sl_pvs_sees(&baked.visibility.pvs, from, to));
        for (uint32_t i = 0; i < s->vertex_count; i++) {
            const sl_point a = s->vertices[i],
                           b = s->vertices[sl_random_below(random, s->vertex_count)];
            check_located(r, s, (sl_point){a.x, b.y});
        }
    }
    sl_baked_destroy(context, &baked);
    sl_context_destroy(context);
}

static void check_bytes(const uint8_t *data, size_t size) {
    sl_random random = {size};
    // A block of its own, anywhere: what is read beyond its end is found out.
    const size_t shift = size % 8;
    uint8_t *block = room(size + shift), *bytes = block + shift;
    if (size) memcpy(bytes, data, size);
    const sl_runtime empty = {0};
    sl_runtime r = empty;
    const sl_runtime_status status = sl_runtime_open(bytes, size, &r);
    if (status == SL_RUNTIME_OK)
        check_open(&r, 2, &random);
    else
        FUZZ_CHECK(memcmp(&r, &empty, sizeof r) == 0 && *sl_runtime_status_text(status));
    check_same(bytes, size, status, &r, &random);
    FUZZ_CHECK(!size || memcmp(bytes, data, size) == 0);
    free(block);
}

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size) {
    if (is_baked(data, size) || !size) {
        check_bytes(data, size);
        return 0;
    }
    size_t baked_size = 0;
    char *baked = baked_text(data, size, &baked_size);
    if (baked)
        check_bytes((const uint8_t *)baked, baked_size);
    else
        check_bytes(data, size);
    free(baked);
    return 0;
}

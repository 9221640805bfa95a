// Proofs of placements: whatever is read for a small room can be checked, never proves more than is
// true, and is written as the same claim.
#include "fuzz.h"

#include "sightline/place_proof.h"

#define ROOM                                                                                       \
    "sightline 1\nwall 0 0 10 0\nwall 10 0 10 10\nwall 10 10 0 10\nwall 0 10 0 0\nwall 5 0 5 10\n"

/// Two rooms need two viewpoints.
static void check(sl_context *context, sl_query *query, const sl_placement *claim) {
    sl_place_verdict verdict;
    FUZZ_CHECK(claim->upper == claim->count);
    const sl_status status = sl_place_proof_check(context, query, claim, &verdict);
    FUZZ_CHECK(status == SL_OK || status == SL_BAD_ARGUMENT || status == SL_NO_MEMORY);
    if (status != SL_OK) return;
    FUZZ_CHECK(verdict.lower <= 2);
    FUZZ_CHECK(!verdict.sees_all || claim->count >= 2);
}

static void write_again(sl_context *context, sl_query *query, const sl_placement *claim) {
    char *text = NULL;
    size_t length;
    sl_placement back;
    FILE *out = open_memstream(&text, &length);
    FUZZ_CHECK(out);
    FUZZ_CHECK(sl_place_proof_print(context, query, claim, out) == SL_OK && fclose(out) == 0);
    FUZZ_CHECK(sl_place_proof_parse(context, query, "back", text, length, &back) == SL_OK);
    FUZZ_CHECK(back.count == claim->count && back.lower == claim->lower);
    sl_placement_destroy(context, &back);
    free(text);
}

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size) {
    sl_context *context = fuzz_context();
    sl_map map = {0};
    sl_space space = {0};
    sl_query *query = NULL;
    sl_placement claim;
    FUZZ_CHECK(sli_map_read_text(context, "room", ROOM, strlen(ROOM), &map) == SL_OK);
    FUZZ_CHECK(sl_map_clean(context, &map, NULL, NULL) == SL_OK);
    FUZZ_CHECK(sl_subdivision_for(&map)->subdivide(context, &map, NULL, &space) == SL_OK);
    FUZZ_CHECK(sl_query_over(context, &space, &map, NULL, &query) == SL_OK);
    if (sl_place_proof_parse(context, query, "input", (const char *)data, size, &claim) == SL_OK) {
        check(context, query, &claim);
        write_again(context, query, &claim);
    } else {
        FUZZ_CHECK(strncmp(sl_context_message(context), "input:", 6) == 0);
    }
    sl_placement_destroy(context, &claim);
    sl_query_destroy(context, query);
    sl_space_destroy(context, &space);
    sl_map_destroy(context, &map);
    sl_context_destroy(context);
    return 0;
}

// Rows of bits, dense and sparse: against a matrix of bools, under a limit, without memory, and
// under the methods that keep them.
#include "testing.h"

#include "base/size.h"
#include "cell_to_cell/pvs_rows.h"
#include "cell_to_cell/rows.h"
#include "sightline/generate.h"
#include "sightline/support.h"

enum { MOST_CELLS = 700 };

typedef struct matrix {
    uint32_t count;
    bool sees[MOST_CELLS][MOST_CELLS];
} matrix;

/// Members close to each other and far apart, so that rows have few words, many, and all.
static void fill_set(sl_random *random, uint32_t count, uint32_t members, sli_word_set *set) {
    const uint32_t centre = (uint32_t)sl_random_below(random, count);
    for (uint32_t i = 0; i < members; i++) {
        const bool near = sl_random_below(random, 4) != 0;
        const uint64_t step = sl_random_below(random, near ? 20 : count);
        sli_word_set_add(set, (uint32_t)((centre + step) % count));
    }
}

static void fill(sl_context *context, uint64_t seed, uint32_t members, sli_bit_rows *rows,
                 matrix *truth) {
    sl_random random = {seed};
    sli_word_set set;
    assert_ok(context, sli_word_set_create(context, truth->count, &set));
    for (uint32_t i = 0; i < 3 * truth->count; i++) {
        const uint32_t cell = (uint32_t)sl_random_below(&random, truth->count);
        fill_set(&random, truth->count, members, &set);
        const uint32_t dropped = (uint32_t)sl_random_below(&random, truth->count);
        sli_word_set_drop(&set, dropped);
        for (uint32_t k = 0; k < truth->count; k++)
            truth->sees[cell][k] |= sl_bits_has(set.bits, k);
        assert_false(sl_bits_has(set.bits, dropped));
        assert_ok(context, sli_bit_rows_add(context, rows, cell, &set));
        sli_word_set_clear(&set);
        assert_int_equal(sli_word_set_next(&set, 0), 0);
        assert_true(sli_word_set_before(&set, rows->words) == SIZE_MAX);
        assert_ok(context, sli_bit_rows_add_one(context, rows, cell, dropped));
        truth->sees[cell][dropped] = true;
    }
    sli_word_set_destroy(context, &set);
}

static void mirror(matrix *truth, sli_mirroring how) {
    for (uint32_t a = 0; a < truth->count; a++)
        for (uint32_t b = 0; b < a; b++) {
            const bool one = truth->sees[a][b], other = truth->sees[b][a];
            const bool both = how == SLI_ADD_MIRRORED ? one || other : one && other;
            truth->sees[a][b] = truth->sees[b][a] = both;
        }
}

static void compare(const sl_visibility *seen, const matrix *truth) {
    uint64_t pairs = 0;
    assert_int_equal(seen->pvs.cell_count, truth->count);
    for (uint32_t a = 0; a < truth->count; a++)
        for (uint32_t b = 0; b < truth->count; b++) {
            assert_int_equal(sl_pvs_sees(&seen->pvs, a, b), truth->sees[a][b]);
            pairs += truth->sees[a][b];
        }
    assert_int_equal(seen->account.pairs, pairs);
}

static void check_rows(sl_context *context, uint32_t count, uint32_t members, sl_row_storage how,
                       sli_mirroring mirroring) {
    matrix *truth = calloc(1, sizeof *truth);
    assert_non_null(truth);
    truth->count = count;
    sl_see_options options = sl_see_options_default();
    options.rows = how;
    sli_bit_rows rows, fork;
    assert_ok(context, sli_bit_rows_create(context, count, &options, &rows));
    assert_int_equal(rows.bits != NULL, how == SL_ROWS_DENSE);
    fill(context, 2 * count + members, members, &rows, truth);
    assert_ok(context, sli_bit_rows_fork(context, &rows, &fork));
    fill(context, 3 * count + members, members, &fork, truth);
    sli_bit_rows_join(context, &rows, &fork);
    assert_ok(context, sli_bit_rows_mirror(context, &rows, mirroring));
    mirror(truth, mirroring);
    sl_visibility seen = {0};
    assert_ok(context, sli_bit_rows_encode(context, &rows, &seen));
    assert_ok(context, sli_pvs_check(context, &seen.pvs));
    compare(&seen, truth);
    sl_visibility_destroy(context, &seen);
    sli_bit_rows_destroy(context, &rows);
    free(truth);
}

static void rows_hold_what_is_added(void **state) {
    (void)state;
    static const uint32_t counts[] = {1, 63, 64, 65, 128, 321, MOST_CELLS};
    static const uint32_t members[] = {1, 5, 60};
    testing_memory memory = {0};
    sl_context *context = testing_context(&memory);
    const long live = memory.live;
    for (size_t i = 0; i < sizeof counts / sizeof *counts; i++)
        for (size_t k = 0; k < sizeof members / sizeof *members; k++)
            for (int how = SL_ROWS_DENSE; how <= SL_ROWS_SPARSE; how++)
                for (int mirroring = SLI_ADD_MIRRORED; mirroring <= SLI_KEEP_MUTUAL; mirroring++)
                    check_rows(context, counts[i], members[k], (sl_row_storage)how,
                               (sli_mirroring)mirroring);
    assert_int_equal(memory.live, live);
    sl_context_destroy(context);
}

/// Large sets of rows are sparse without being told, and take what they hold.
static void large_rows_are_sparse(void **state) {
    (void)state;
    sl_context *context = testing_context(NULL);
    const sl_see_options options = sl_see_options_default();
    sli_bit_rows rows;
    assert_ok(context, sli_bit_rows_create(context, 4000000, &options, &rows));
    assert_null(rows.bits);
    const uint32_t cells[] = {0, 3999999, 2000000};
    for (size_t i = 0; i < 3; i++)
        for (size_t k = 0; k < 3; k++)
            assert_ok(context, sli_bit_rows_add_one(context, &rows, cells[i], cells[k]));
    sl_visibility seen = {0};
    assert_ok(context, sli_bit_rows_encode(context, &rows, &seen));
    assert_int_equal(seen.account.pairs, 9);
    assert_true(sl_pvs_sees(&seen.pvs, 3999999, 2000000));
    sl_visibility_destroy(context, &seen);
    sli_bit_rows_destroy(context, &rows);
    sl_context_destroy(context);
}

// --- under the methods

/// The next method of the table that keeps rows; the first of all after NULL; NULL at the end.
static const sl_see_method *next_with_rows(const sl_see_method *method) {
    size_t count;
    const sl_see_method *methods = sl_see_methods(&count);
    for (method = method ? method + 1 : methods; method < methods + count; method++)
        if (method->keeps_rows) return method;
    return NULL;
}

static void generate_space(sl_context *context, uint64_t walls, sl_space *space) {
    size_t count;
    const sl_map_kind *kinds = sl_map_kinds(&count);
    sl_generate_options options = sl_generate_options_default();
    options.walls = walls;
    for (size_t i = 0; i < count; i++) {
        if (strcmp(kinds[i].name, "city") != 0) continue;
        sl_map map = {0};
        assert_ok(context, sl_generate(context, &kinds[i], &options, &map));
        testing_subdivide(context, &map, space);
        sl_map_destroy(context, &map);
        return;
    }
    fail_msg("no cities");
}

static void sparse_rows_give_the_same_bytes(void **state) {
    (void)state;
    sl_context *context = testing_context(NULL);
    sl_space space;
    generate_space(context, 1500, &space);
    for (const sl_see_method *method = NULL; (method = next_with_rows(method));) {
        sl_see_options options = sl_see_options_default();
        sl_visibility dense, sparse;
        options.rows = SL_ROWS_DENSE;
        options.threads = 1;
        options.solver = method->stabs ? sl_funnel() : NULL;
        assert_ok(context, method->see(context, &space, &options, &dense));
        options.rows = SL_ROWS_SPARSE;
        for (options.threads = 1; options.threads <= 4; options.threads += 3) {
            assert_ok(context, method->see(context, &space, &options, &sparse));
            const uint64_t bytes = dense.pvs.offsets[space.cell_count];
            assert_memory_equal(dense.pvs.offsets, sparse.pvs.offsets,
                                (space.cell_count + 1) * sizeof *dense.pvs.offsets);
            assert_memory_equal(dense.pvs.bytes, sparse.pvs.bytes, bytes);
            assert_int_equal(dense.account.pairs, sparse.account.pairs);
            sl_visibility_destroy(context, &sparse);
        }
        sl_visibility_destroy(context, &dense);
    }
    sl_space_destroy(context, &space);
    sl_context_destroy(context);
}

static void the_limit_is_kept_and_told(void **state) {
    (void)state;
    testing_memory memory = {0};
    sl_context *context = testing_context(&memory);
    sl_space space;
    generate_space(context, 1500, &space);
    const long live = memory.live;
    for (const sl_see_method *method = NULL; (method = next_with_rows(method));) {
        sl_see_options options = sl_see_options_default();
        sl_visibility seen = {0};
        options.rows = SL_ROWS_SPARSE;
        options.threads = 1; // the allocator that counts is one thread's
        options.row_bytes = 20000;
        options.solver = method->stabs ? sl_funnel() : NULL;
        assert_int_equal(method->see(context, &space, &options, &seen), SL_NO_MEMORY);
        assert_non_null(strstr(sl_context_message(context), "allow more memory"));
        assert_int_equal(memory.live, live);
    }
    sl_space_destroy(context, &space);
    sl_context_destroy(context);
}

static void lack_of_memory_leaves_nothing(void **state) {
    (void)state;
    testing_memory memory = {0};
    sl_context *context = testing_context(&memory);
    sl_map map = {0};
    sl_space space;
    testing_space(context, "walls 0 0 9 0 9 9 0 9 0 0\nwall 3 0 3 7\nwall 6 9 6 2\nwall 7 4 9 4\n",
                  &map, &space);
    const long live = memory.live;
    for (const sl_see_method *method = NULL; (method = next_with_rows(method));) {
        sl_status status = SL_NO_MEMORY;
        long calls = 0;
        for (long fail_at = 1; status == SL_NO_MEMORY; fail_at++, calls++) {
            sl_see_options options = sl_see_options_default();
            sl_visibility seen = {0};
            options.solver = method->stabs ? sl_funnel() : NULL;
            options.threads = 1;
            options.rows = SL_ROWS_SPARSE;
            memory.calls = 0;
            memory.fail_at = fail_at;
            status = method->see(context, &space, &options, &seen);
            memory.fail_at = 0;
            sl_visibility_destroy(context, &seen);
            assert_int_equal(memory.live, live);
        }
        assert_int_equal(status, SL_OK);
        assert_true(calls > 10);
    }
    sl_space_destroy(context, &space);
    sl_map_destroy(context, &map);
    sl_context_destroy(context);
}

/// No block of a gigabyte or more.
static void *small_blocks(void *user, void *block, size_t bytes) {
    (void)user;
    if (bytes) return bytes >> 30 ? NULL : realloc(block, bytes);
    free(block);
    return NULL;
}

/// Where sizes have 32 bits, the low ones of this sum are a block of 17 bytes. What is joined is
/// never looked at: the sum alone is refused.
static void rows_beyond_the_address_space_are_refused(void **state) {
    (void)state;
    assert_true(sli_size(0) == 0 && sli_size(UINT32_MAX) == UINT32_MAX);
    assert_true(sli_size(UINT64_MAX) == SIZE_MAX);
    assert_true(sli_size((uint64_t)UINT32_MAX + 18) > UINT32_MAX - 1);
    sl_context *context = sl_context_create(&(sl_hooks){.resize = small_blocks});
    sli_row_bytes rows[2];
    for (size_t i = 0; i < 2; i++) {
        rows[i] = (sli_row_bytes){.items = sl_alloc(context, 1), .count = (size_t)1 << 31 | 8};
        assert_non_null(rows[i].items);
    }
    sl_pvs joined = {0};
    assert_int_equal(sli_pvs_join(context, rows, 2, &joined), SL_NO_MEMORY);
    assert_null(joined.bytes);
    sl_context_destroy(context);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(rows_hold_what_is_added),
        cmocka_unit_test(large_rows_are_sparse),
        cmocka_unit_test(sparse_rows_give_the_same_bytes),
        cmocka_unit_test(the_limit_is_kept_and_told),
        cmocka_unit_test(lack_of_memory_leaves_nothing),
        cmocka_unit_test(rows_beyond_the_address_space_are_refused),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}

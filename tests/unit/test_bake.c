/// Visible sets, the depth-first search, the baked file: written, read back, damaged.
#include "testing.h"

#include "cell_to_cell/pvs_rows.h"
#include "map/scan.h"
#include "map/source.h"
#include "sightline/glpk.h"
#include "sightline/support.h"

#include <stdatomic.h>
#include <unistd.h>

static void rows_keep_their_sets(void **state) {
    (void)state;
    sl_context *context = testing_context(NULL);
    sl_random random = {4};
    for (uint32_t count = 1; count < 400; count += 1 + count / 7) {
        sli_row_bytes *rows = calloc(count, sizeof *rows);
        sl_bits *sets = calloc((size_t)count * sl_bits_words(count), sizeof *sets);
        assert_true(rows && sets);
        for (uint32_t i = 0; i < count; i++) {
            sl_bits *set = sets + i * sl_bits_words(count);
            const uint64_t density = sl_random_below(&random, 101);
            for (uint32_t j = 0; j < count; j++)
                if (sl_random_below(&random, 100) < density) sl_bits_add(set, j);
            assert_ok(context, sli_row_append(context, &rows[i], set, count));
        }
        sl_pvs pvs, transposed;
        assert_ok(context, sli_pvs_join(context, rows, count, &pvs));
        assert_ok(context, sli_pvs_check(context, &pvs));
        assert_ok(context, sli_pvs_transpose(context, &pvs, &transposed));
        assert_ok(context, sli_pvs_check(context, &transposed));
        for (uint32_t i = 0; i < count; i++) {
            uint32_t members = 0;
            for (uint32_t j = 0; j < count; j++) {
                const bool member = sl_bits_has(sets + i * sl_bits_words(count), j);
                members += member;
                assert_int_equal(sl_pvs_sees(&pvs, i, j), member);
                assert_int_equal(sl_pvs_sees(&transposed, j, i), member);
            }
            assert_int_equal(sl_pvs_count(&pvs, i), members);
        }
        sl_pvs_destroy(context, &pvs);
        sl_pvs_destroy(context, &transposed);
        free(rows);
        free(sets);
    }
    sl_context_destroy(context);
}

/// 6 x 6 pillars of 1 in a box, a unit apart: many sequences, doubtful pairs with closed sight.
static char *pillars(void) {
    char *text = NULL;
    size_t size = 0;
    FILE *stream = open_memstream(&text, &size);
    assert_non_null(stream);
    fputs("walls 0 0 7 0 7 7 0 7 0 0\nstart 0.5 0.5 45\n", stream);
    for (int i = 0; i < 3; i++)
        for (int j = 0; j < 3; j++) {
            const int x = 1 + 2 * i, y = 1 + 2 * j;
            fprintf(stream, "walls %d %d %d %d %d %d %d %d %d %d\n", x, y, x + 1, y, x + 1, y + 1,
                    x, y + 1, x, y);
        }
    assert_int_equal(fclose(stream), 0);
    return text;
}

static void bake(sl_context *context, const char *statements, const sl_see_options *options,
                 sl_baked *baked) {
    *baked = (sl_baked){.method = "dfs", .solver = "glpk"};
    testing_space(context, statements, &baked->map, &baked->space);
    size_t count;
    assert_ok(context,
              sl_see_methods(&count)->see(context, &baked->space, options, &baked->visibility));
}

static sl_see_options glpk_options(sl_sight sight) {
    sl_see_options options = sl_see_options_default();
    options.solver = sl_glpk_simplex();
    options.sight = sight;
    return options;
}

static void a_corner_hides_what_it_should(void **state) {
    (void)state;
    // Four rooms in a row; the doors lie low, high, low. Where they do not overlap in height
    // nothing passes; where they meet at one height only the line at that height does.
    const char *hidden = "walls 0 0 40 0 40 10 0 10 0 0\n"
                         "wall 10 4 10 10\nwall 20 0 20 6\nwall 30 4 30 10\n";
    const char *seen = "walls 0 0 40 0 40 10 0 10 0 0\n"
                       "wall 10 6 10 10\nwall 20 0 20 4\nwall 30 6 30 10\n";
    const char *grazed = "walls 0 0 40 0 40 10 0 10 0 0\n"
                         "wall 10 5 10 10\nwall 20 0 20 5\nwall 30 5 30 10\n";
    for (int sight = SL_CLOSED; sight <= SL_OPEN; sight++) {
        sl_context *context = testing_context(NULL);
        const sl_see_options options = glpk_options((sl_sight)sight);
        const char *maps[] = {hidden, seen, grazed};
        const bool sees[] = {false, true, sight == SL_CLOSED};
        for (int i = 0; i < 3; i++) {
            sl_baked baked;
            bake(context, maps[i], &options, &baked);
            const uint32_t first = sl_space_locate(&baked.space, (sl_point){5, 5});
            const uint32_t last = sl_space_locate(&baked.space, (sl_point){35, 5});
            assert_int_equal(sl_pvs_sees(&baked.visibility.pvs, first, last), sees[i]);
            assert_int_equal(sl_pvs_sees(&baked.visibility.pvs, last, first), sees[i]);
            assert_true(sl_pvs_sees(&baked.visibility.pvs, first, first));
            const bool doubtful = sl_pvs_sees(&baked.visibility.doubtful, first, last);
            assert_int_equal(doubtful, i == 2);
            sl_baked_destroy(context, &baked);
        }
        sl_context_destroy(context);
    }
}

static sl_bytes written(sl_context *context, const sl_baked *baked) {
    char path[] = "/tmp/sightline-test-XXXXXX";
    const int descriptor = mkstemp(path);
    assert_true(descriptor >= 0);
    close(descriptor);
    assert_ok(context, sl_baked_write(context, baked, path));
    sl_bytes bytes;
    assert_ok(context, sl_file_read(context, path, &bytes));
    unlink(path);
    return bytes;
}

static void threads_do_not_change_the_bytes(void **state) {
    (void)state;
    char *text = pillars();
    // A limit that leaves some trees out: which ones must not depend on the threads either.
    const uint64_t limits[] = {UINT64_C(1) << 30, 4000, 0};
    for (size_t limit = 0; limit < 3; limit++) {
        sl_bytes first = {0};
        sl_context *context = testing_context(NULL);
        for (unsigned threads = 1; threads <= 4; threads++) {
            sl_see_options options = glpk_options(SL_CLOSED);
            options.threads = threads;
            options.trees = true;
            options.tree_bytes = limits[limit];
            sl_baked baked;
            bake(context, text, &options, &baked);
            const uint32_t left_out = baked.visibility.trees.left_out;
            if (limit == 0) assert_int_equal(left_out, 0);
            if (limit == 1) assert_true(left_out >= 1 && left_out < baked.space.cell_count);
            if (limit == 2) assert_int_equal(left_out, baked.space.cell_count);
            sl_bytes bytes = written(context, &baked);
            if (threads == 1)
                first = bytes;
            else {
                assert_int_equal(bytes.size, first.size);
                assert_memory_equal(bytes.data, first.data, first.size);
                sl_free(context, bytes.data);
            }
            sl_baked_destroy(context, &baked);
        }
        sl_free(context, first.data);
        sl_context_destroy(context);
    }
    free(text);
}

static void a_baked_file_reads_back_the_same(void **state) {
    (void)state;
    char *text = pillars();
    sl_context *context = testing_context(NULL);
    sl_see_options options = glpk_options(SL_OPEN);
    options.trees = true;
    sl_baked baked, back = {0};
    bake(context, text, &options, &baked);
    assert_ok(context, sli_map_add_note(context, &baked.map, "a notice"));
    sl_bytes bytes = written(context, &baked);
    assert_ok(context, sl_baked_parse(context, "x.slv", bytes.data, bytes.size, &back));
    assert_int_equal(back.space.cell_count, baked.space.cell_count);
    assert_int_equal(back.visibility.trees.cell_count, baked.space.cell_count);
    assert_string_equal(back.method, "dfs");
    assert_int_equal(back.map.start_count, 1);
    assert_non_null(strstr(back.map.source.notes, "a notice"));
    sl_bytes again = written(context, &back);
    assert_int_equal(again.size, bytes.size);
    assert_memory_equal(again.data, bytes.data, bytes.size);
    sl_free(context, bytes.data);
    sl_free(context, again.data);
    sl_baked_destroy(context, &baked);
    sl_baked_destroy(context, &back);
    sl_context_destroy(context);
    free(text);
}

static void a_damaged_file_is_refused(void **state) {
    (void)state;
    sl_context *context = testing_context(NULL);
    const sl_see_options options = glpk_options(SL_CLOSED);
    sl_baked baked, back = {0};
    bake(context, "walls 0 0 9 0 9 9 0 9 0 0\nwall 4 0 4 5\n", &options, &baked);
    sl_bytes bytes = written(context, &baked);
    for (size_t size = 0; size < bytes.size; size++)
        assert_int_equal(sl_baked_parse(context, "x.slv", bytes.data, size, &back), SL_BAD_INPUT);
    for (size_t at = 0; at < bytes.size; at++) {
        bytes.data[at] ^= 0x10;
        assert_int_equal(sl_baked_parse(context, "x.slv", bytes.data, bytes.size, &back),
                         SL_BAD_INPUT);
        assert_ptr_equal(strstr(sl_context_message(context), "x.slv"), sl_context_message(context));
        bytes.data[at] ^= 0x10;
    }
    assert_ok(context, sl_baked_parse(context, "x.slv", bytes.data, bytes.size, &back));
    sl_free(context, bytes.data);
    sl_baked_destroy(context, &back);
    sl_baked_destroy(context, &baked);
    sl_context_destroy(context);
}

static void the_tree_is_the_search(void **state) {
    (void)state;
    char *text = pillars();
    sl_context *context = testing_context(NULL);
    sl_see_options options = glpk_options(SL_CLOSED);
    options.trees = true;
    sl_baked baked;
    bake(context, text, &options, &baked);
    const sl_stab_trees *trees = &baked.visibility.trees;
    assert_int_equal(trees->offsets[trees->cell_count], baked.visibility.account.nodes);
    for (uint32_t cell = 0; cell < trees->cell_count; cell++) {
        sl_bits *seen = calloc(sl_bits_words(trees->cell_count), sizeof *seen);
        assert_non_null(seen);
        for (uint64_t i = trees->offsets[cell]; i < trees->offsets[cell + 1]; i++)
            sl_bits_add(seen, trees->nodes[i].cell);
        // With closed sight a pair may be seen in the other direction only, by rounding.
        for (uint32_t to = 0; to < trees->cell_count; to++)
            if (!sl_pvs_sees(&baked.visibility.doubtful, cell, to))
                assert_int_equal(sl_bits_has(seen, to),
                                 sl_pvs_sees(&baked.visibility.pvs, cell, to));
        free(seen);
    }
    sl_baked_destroy(context, &baked);
    sl_context_destroy(context);
    free(text);
}

static void read_two_rooms(sl_context *context, sl_map *map) {
    static const char text[] = "sightline 1\nwalls 0 0 4 0 4 4 0 4 0 0\nwall 2 0 2 3\n";
    assert_ok(context, sli_map_read_text(context, "t", text, strlen(text), map));
}

/// The first half of a bake, without anybody who wants an account.
static void the_first_half_needs_no_account(void **state) {
    (void)state;
    sl_context *context = testing_context(NULL);
    sl_bake_options options = sl_bake_options_default();
    sl_map map = {0};
    sl_baked baked = {0};
    read_two_rooms(context, &map);
    assert_ok(context, sl_bake_space(context, &map, &options, &baked, NULL));
    assert_true(baked.space.cell_count > 1 && options.method);
    assert_int_equal(baked.visibility.pvs.cell_count, 0);
    sl_baked_destroy(context, &baked);
    sl_context_destroy(context);
}

/// What the functions of a bake by units are asked to do.
typedef struct units_trial {
    const sl_baked *before; ///< to take over; NULL for none
    sl_status between, join;
    bool leave_out; ///< the partial results are another process's
    int calls[2];
} units_trial;

static sl_status trial_between(sl_context *context, void *user, sl_bake_options *options,
                               const sl_baked *baked, sl_partial *known) {
    units_trial *t = user;
    t->calls[0]++;
    assert_true(baked->space.cell_count && options->method && options->see.plan);
    if (t->before)
        SL_TRY(sl_partial_reuse(context, &t->before->space, &t->before->visibility, &baked->space,
                                options->method, &options->see, known));
    return t->between == SL_OK ? SL_OK : sl_fail(context, t->between, "between");
}

static sl_status trial_join(sl_context *context, void *user, sl_status outcome,
                            sl_partial *partial) {
    units_trial *t = user;
    t->calls[1]++;
    assert_int_equal(outcome, SL_OK);
    if (t->leave_out) sl_partial_destroy(context, partial);
    return t->join == SL_OK ? SL_OK : sl_fail(context, t->join, "join");
}

static bool at_once(void *user) {
    return user == NULL;
}

static sl_status bake_by_units(sl_context *context, units_trial *trial, sl_bake_options options,
                               sl_baked *out, sl_bake_account *account) {
    sl_map map = {0};
    read_two_rooms(context, &map);
    options.by_units = true;
    options.user = trial;
    options.between = trial_between;
    options.join = trial_join;
    const sl_status status = sl_bake(context, &map, &options, out, account);
    sl_map_destroy(context, &map);
    return status;
}

static void same_pairs(const sl_baked *a, const sl_baked *b) {
    const sl_pvs *p = &a->visibility.pvs, *q = &b->visibility.pvs;
    assert_int_equal(p->cell_count, q->cell_count);
    assert_memory_equal(p->offsets, q->offsets, (p->cell_count + 1) * sizeof *p->offsets);
    assert_memory_equal(p->bytes, q->bytes, p->offsets[p->cell_count]);
}

/// By units a bake finds what it finds in one go, also from what is known and from shards.
static void units_make_the_same_sets(void **state) {
    (void)state;
    sl_context *context = testing_context(NULL);
    sl_bake_options options = sl_bake_options_default();
    sl_bake_account account;
    sl_map map = {0};
    sl_baked whole = {0}, other = {0}, shard = {0};
    read_two_rooms(context, &map);
    assert_ok(context, sl_bake(context, &map, NULL, &whole, &account));
    assert_null(account.work.units);
    units_trial trial = {0};
    assert_ok(context, bake_by_units(context, &trial, options, &other, &account));
    assert_true(trial.calls[0] == 1 && trial.calls[1] == 1);
    assert_string_equal(account.work.units, "corners");
    assert_true(account.work.count > 0 && account.work.known == 0);
    assert_int_equal(account.work.done, account.work.count);
    assert_false(sl_partial_begun(&other.partial));
    same_pairs(&other, &whole);
    sl_baked_destroy(context, &other);
    trial.before = &whole;
    assert_ok(context, bake_by_units(context, &trial, options, &other, &account));
    assert_int_equal(account.work.known, account.work.count);
    same_pairs(&other, &whole);
    sl_baked_destroy(context, &other);
    trial.before = NULL;
    options.see.shard_count = 2;
    options.see.shard = 1;
    assert_ok(context, bake_by_units(context, &trial, options, &other, &account));
    options.see.shard = 2;
    assert_ok(context, bake_by_units(context, &trial, options, &shard, &account));
    assert_true(sl_baked_is_shard(&other) && sl_baked_is_shard(&shard));
    assert_int_equal(shard.visibility.guarantee, SL_EXACT);
    assert_ok(context, sl_partial_merge(context, &other.partial, &shard.partial));
    assert_true(sl_partial_complete(&other.partial));
    sl_baked_destroy(context, &other);
    sl_baked_destroy(context, &shard);
    sl_baked_destroy(context, &whole);
    sl_context_destroy(context);
}

static void units_that_are_stopped_are_kept(void **state) {
    (void)state;
    testing_memory memory = {0};
    sl_context *context = testing_context(&memory);
    sl_bake_options options = sl_bake_options_default();
    sl_bake_account account;
    sl_baked baked = {0};
    units_trial trial = {0};
    options.see.enough = at_once;
    assert_ok(context, bake_by_units(context, &trial, options, &baked, &account));
    assert_true(sl_partial_begun(&baked.partial) && !sl_partial_complete(&baked.partial));
    assert_int_equal(baked.visibility.guarantee, SL_CONSERVATIVE);
    sl_baked_destroy(context, &baked);
    trial.leave_out = true;
    assert_ok(context, bake_by_units(context, &trial, options, &baked, &account));
    assert_false(sl_partial_begun(&baked.partial));
    assert_int_equal(baked.visibility.pvs.cell_count, 0);
    sl_baked_destroy(context, &baked);
    for (int i = 0; i < 3; i++) {
        trial =
            (units_trial){.between = i == 0 ? SL_CANCELLED : SL_OK, .join = i == 1 ? SL_IO : SL_OK};
        if (i == 2) options.method = sl_see_method_named("flood");
        assert_int_equal(bake_by_units(context, &trial, options, &baked, &account),
                         i == 0   ? SL_CANCELLED
                         : i == 1 ? SL_IO
                                  : SL_UNSUPPORTED);
        assert_int_equal(baked.space.cell_count, 0);
        assert_int_equal(trial.calls[1], i == 1);
    }
    sl_context_destroy(context);
    assert_int_equal(memory.live, 0);
}

static void inside_only_looks_at_inside_cells_only(void **state) {
    (void)state;
    sl_context *context = testing_context(NULL);
    sl_see_options options = glpk_options(SL_CLOSED);
    options.inside_only = true;
    sl_baked baked;
    bake(context, "walls 0 0 4 0 4 2 2 2 2 4 0 4 0 0\n", &options, &baked);
    assert_true(baked.space.inside_count >= 1 && baked.space.inside_count < baked.space.cell_count);
    for (uint32_t a = 0; a < baked.space.cell_count; a++)
        for (uint32_t b = 0; b < baked.space.cell_count; b++)
            if (!baked.space.cells[a].inside || !baked.space.cells[b].inside)
                assert_false(sl_pvs_sees(&baked.visibility.pvs, a, b));
            else
                assert_true(sl_pvs_sees(&baked.visibility.pvs, a, b));
    sl_baked_destroy(context, &baked);
    sl_context_destroy(context);
}

static bool cancel_after(void *user) {
    atomic_int *calls = user;
    return atomic_fetch_sub(calls, 1) <= 0;
}

static void a_search_can_be_interrupted(void **state) {
    (void)state;
    char *text = pillars();
    for (int calls = 0; calls < 24; calls += 3) {
        sl_context *plain = testing_context(NULL);
        sl_map map = {0};
        sl_space space;
        testing_space(plain, text, &map, &space);
        atomic_int left = calls;
        const sl_hooks hooks = {.user = &left, .cancelled = cancel_after};
        sl_context *context = sl_context_create(&hooks);
        assert_non_null(context);
        sl_see_options options = glpk_options(SL_CLOSED);
        options.trees = true;
        sl_visibility visibility = {0};
        size_t count;
        assert_int_equal(sl_see_methods(&count)->see(context, &space, &options, &visibility),
                         SL_CANCELLED);
        assert_null(visibility.pvs.bytes);
        sl_context_destroy(context);
        sl_space_destroy(plain, &space);
        sl_map_destroy(plain, &map);
        sl_context_destroy(plain);
    }
    free(text);
}

static void memory_may_fail_at_any_call(void **state) {
    (void)state;
    testing_memory memory = {0};
    sl_context *context = testing_context(&memory);
    sl_map map = {0};
    sl_space space;
    testing_space(context, "walls 0 0 9 0 9 9 0 9 0 0\nwall 4 0 4 5\nstart 1 1 0\n", &map, &space);
    const long before = memory.live;
    sl_status status = SL_NO_MEMORY;
    for (long at = 1; status == SL_NO_MEMORY; at++) {
        memory.calls = 0;
        memory.fail_at = at;
        sl_see_options options = glpk_options(SL_CLOSED);
        options.threads = 1;
        options.trees = true;
        sl_baked baked = {.space = space}, back = {0};
        size_t count;
        status = sl_see_methods(&count)->see(context, &space, &options, &baked.visibility);
        if (status == SL_OK) status = sl_baked_write(context, &baked, "/dev/null/none");
        // The target is no folder: the write gets as far as memory lets it, and no further.
        if (status == SL_IO) {
            memory.fail_at = 0;
            sl_bytes bytes = written(context, &baked);
            memory.fail_at = memory.calls + at;
            status = sl_baked_parse(context, "x", bytes.data, bytes.size, &back);
            sl_free(context, bytes.data);
        }
        sl_baked_destroy(context, &back);
        sl_visibility_destroy(context, &baked.visibility);
        assert_int_equal(memory.live, before);
        assert_true(at < 100000);
    }
    assert_int_equal(status, SL_OK);
    memory.fail_at = 0;
    sl_space_destroy(context, &space);
    sl_map_destroy(context, &map);
    sl_context_destroy(context);
    assert_int_equal(memory.live, 0);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(rows_keep_their_sets),
        cmocka_unit_test(a_corner_hides_what_it_should),
        cmocka_unit_test(threads_do_not_change_the_bytes),
        cmocka_unit_test(a_baked_file_reads_back_the_same),
        cmocka_unit_test(a_damaged_file_is_refused),
        cmocka_unit_test(the_tree_is_the_search),
        cmocka_unit_test(the_first_half_needs_no_account),
        cmocka_unit_test(units_make_the_same_sets),
        cmocka_unit_test(units_that_are_stopped_are_kept),
        cmocka_unit_test(inside_only_looks_at_inside_cells_only),
        cmocka_unit_test(a_search_can_be_interrupted),
        cmocka_unit_test(memory_may_fail_at_any_call),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}

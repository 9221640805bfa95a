// Proofs of placements: what is found is confirmed by other code, also on thin walls and with
// holes, and no change of a proof makes it prove more than is true.
#include "testing.h"

#include "sightline/generate.h"
#include "sightline/place_proof.h"
#include "sightline/support.h"

#include <math.h>
#include <string.h>

typedef struct plan {
    testing_memory memory;
    sl_context *context;
    sl_map map;
    sl_space space;
    sl_query *query;
    sl_placement placed;
} plan;

static void solve(plan *p) {
    assert_ok(p->context, sl_query_over(p->context, &p->space, &p->map, NULL, &p->query));
    assert_ok(p->context, sl_place(p->context, p->query, NULL, &p->placed));
}

static void begin_text(plan *p, const char *text) {
    *p = (plan){0};
    p->context = testing_context(&p->memory);
    testing_space(p->context, text, &p->map, &p->space);
    solve(p);
}

/// A polygon around the origin, scaled and moved.
static void begin_jagged(plan *p, uint64_t seed, int scale, double away) {
    sl_random random = {seed};
    sl_point corners[32];
    const size_t count = 12 + sl_random_below(&random, 20);
    *p = (plan){0};
    p->context = testing_context(&p->memory);
    for (size_t i = 0; i < count; i++) {
        const double angle =
            6.28318530717958 * ((double)i + 0.8 * sl_random_unit(&random)) / (double)count;
        const double r = 256 + 64 * (double)sl_random_below(&random, 60);
        corners[i] = (sl_point){ldexp(rint(r * cos(angle)) + away, scale),
                                ldexp(rint(r * sin(angle)) - 2 * away, scale)};
    }
    assert_ok(p->context, sl_map_add_open(p->context, &p->map, corners, count, 0));
    testing_subdivide(p->context, &p->map, &p->space);
    solve(p);
}

static void end(plan *p) {
    sl_placement_destroy(p->context, &p->placed);
    sl_query_destroy(p->context, p->query);
    sl_space_destroy(p->context, &p->space);
    sl_map_destroy(p->context, &p->map);
    sl_context_destroy(p->context);
    assert_int_equal(p->memory.live, 0);
}

static sl_place_verdict check(plan *p, const sl_placement *claim) {
    sl_place_verdict verdict;
    assert_ok(p->context, sl_place_proof_check(p->context, p->query, claim, &verdict));
    return verdict;
}

/// Other code confirms both bounds. Where the optimum is found, one viewpoint less does not see
/// everything; nor do all of them where slivers are left.
static void confirm(plan *p) {
    sl_placement claim = p->placed;
    sl_place_verdict verdict = check(p, &claim);
    assert_false(verdict.has_extra);
    assert_int_equal(verdict.lower, claim.lower);
    assert_int_equal(verdict.sees_all, claim.slivers == 0);
    if (claim.lower < claim.upper) return;
    claim.count--;
    for (uint32_t i = 0; i <= claim.count; i++) {
        const sl_viewpoint last = p->placed.viewpoints[claim.count];
        p->placed.viewpoints[claim.count] = p->placed.viewpoints[i];
        p->placed.viewpoints[i] = last;
        assert_false(check(p, &claim).sees_all);
    }
}

static char *print(plan *p, const sl_placement *placed, size_t *size) {
    char *text = NULL;
    FILE *stream = open_memstream(&text, size);
    assert_non_null(stream);
    assert_ok(p->context, sl_place_proof_print(p->context, p->query, placed, stream));
    assert_int_equal(fclose(stream), 0);
    return text;
}

static sl_status parse(plan *p, const char *text, size_t size, sl_placement *out) {
    return sl_place_proof_parse(p->context, p->query, "proof.json", text, size, out);
}

#define ROOM "wall 0 0 10 0\nwall 10 0 10 10\nwall 10 10 0 10\nwall 0 10 0 0\n"
static const char *const texts[] = {
    ROOM,
    ROOM "wall 5 0 5 6\n",
    ROOM "wall 5 0 5 10\n",
    ROOM "wall 5 0 5 4\nwall 5 6 5 10\n",
    ROOM "wall 5 0 5 4\nwall 5 6 5 10\nwall 0 5 4 5\nwall 6 5 10 5\n",
    ROOM "wall 5 0 5 4\nwall 5 6 5 10\ndoor a 5 4 5 6 shut\n",
    ROOM "solid 4 4 6 4 6 6 4 6\n",
    ROOM "solid 4 4 6 3 6 6 3 6\nwall 1 8 8 9\n",
    ROOM "wall 2 2 8 2\nwall 8 2 8 8\nwall 8 8 2 8\nwall 2 8 2 2\nstart 1 1 0\n",
};

static void other_code_confirms_plans(void **state) {
    (void)state;
    for (size_t i = 0; i < sizeof texts / sizeof *texts; i++) {
        plan p;
        begin_text(&p, texts[i]);
        confirm(&p);
        end(&p);
    }
}

static void other_code_confirms_polygons(void **state) {
    (void)state;
    const uint64_t seeds = testing_seeds(12);
    for (uint64_t seed = 0; seed < seeds; seed++)
        for (int kind = 0; kind < 4; kind++) {
            plan p;
            begin_jagged(&p, seed, kind == 1 ? 200 : kind == 2 ? -200 : 0, kind == 3 ? 0x1p38 : 0);
            confirm(&p);
            end(&p);
        }
}

/// Witnesses that others imply may go: the bounds stay, and so does their proof.
static void implied_witnesses_may_go(void **state) {
    (void)state;
    sl_place_options options = sl_place_options_default();
    sl_generate_options city = sl_generate_options_default();
    plan p = {0};
    p.context = testing_context(&p.memory);
    size_t kinds, k = 0;
    const sl_map_kind *all = sl_map_kinds(&kinds);
    while (strcmp(all[k].name, "city") != 0) k++;
    city.walls = SL_GENERATE_WALLS_LEAST;
    city.seed = 3;
    assert_ok(p.context, sl_generate(p.context, &all[k], &city, &p.map));
    testing_subdivide(p.context, &p.map, &p.space);
    solve(&p);
    sl_placement usual = p.placed;
    p.placed = (sl_placement){0};
    options.many_entries = 0;
    assert_ok(p.context, sl_place(p.context, p.query, &options, &p.placed));
    const sl_place_verdict verdict = check(&p, &p.placed);
    assert_true(verdict.sees_all);
    assert_int_equal(verdict.lower, usual.lower);
    assert_true(p.placed.witness_count < usual.witness_count);
    assert_int_equal(p.placed.lower, usual.lower);
    assert_int_equal(p.placed.upper, usual.upper);
    sl_placement_destroy(p.context, &usual);
    end(&p);
}

/// What is read back is what was written.
static void files_keep_it(void **state) {
    (void)state;
    plan p;
    sl_placement back;
    size_t size, again;
    begin_jagged(&p, 3, 0, 0);
    char *text = print(&p, &p.placed, &size);
    assert_ok(p.context, parse(&p, text, size, &back));
    assert_int_equal(check(&p, &back).lower, p.placed.lower);
    char *other = print(&p, &back, &again);
    assert_string_equal(text, other);
    sl_placement_destroy(p.context, &back);
    free(text);
    free(other);
    end(&p);
}

/// Editors put a byte order mark before a text.
static void files_may_begin_with_a_mark(void **state) {
    (void)state;
    plan p;
    sl_placement back;
    size_t size;
    char mark[] = "\xef\xbb\xbf";
    begin_jagged(&p, 3, 0, 0);
    char *text = print(&p, &p.placed, &size);
    char *marked = malloc(size + 3);
    memcpy(marked, mark, 3);
    memcpy(marked + 3, text, size);
    assert_ok(p.context, parse(&p, marked, size + 3, &back));
    assert_int_equal(check(&p, &back).lower, p.placed.lower);
    sl_placement_destroy(p.context, &back);
    assert_int_equal(parse(&p, mark, 3, &back), SL_BAD_INPUT);
    free(marked);
    free(text);
    end(&p);
}

/// So are splits, and a file that ends within one is refused.
static void files_keep_splits(void **state) {
    (void)state;
    plan p;
    sl_placement back, claim;
    size_t size, again;
    uint32_t blocks[] = {3, 0, 3}, costs[] = {1, 239}, parts[] = {0, 1, 1};
    begin_text(&p, texts[6]);
    sl_cover_proof rest = p.placed.proof, empty = {.denominator = 1};
    sl_cover_split splits[] = {{240, 3, blocks, 2, costs, &rest}, {1, 0, NULL, 0, NULL, &empty}};
    rest.row_count = 3;
    rest.parts = parts;
    claim = p.placed;
    claim.proof.split_count = 2;
    claim.proof.splits = splits;
    char *text = print(&p, &claim, &size);
    assert_ok(p.context, parse(&p, text, size, &back));
    assert_int_equal(back.proof.split_count, 2);
    assert_int_equal(back.proof.splits[0].costs[1], 239);
    char *other = print(&p, &back, &again);
    assert_string_equal(text, other);
    sl_placement_destroy(p.context, &back);
    const size_t from = (size_t)(strstr(text, "\"splits\"") - text);
    const size_t to = (size_t)(strstr(text, "\"program\"") - text);
    for (size_t length = from; length < to; length++)
        assert_int_equal(parse(&p, text, length, &back), SL_BAD_INPUT);
    free(text);
    free(other);
    end(&p);
}

/// So are cuts, beside splits or alone.
static void files_keep_cuts(void **state) {
    (void)state;
    plan p;
    sl_placement back, claim;
    size_t size, again, ends[] = {3, 5};
    uint32_t rows[] = {0, 1, 2, 2, 3}, parts[] = {0, 0, 0, 0, 0};
    begin_text(&p, texts[6]);
    sl_cover_proof rest = p.placed.proof;
    sl_cover_cuts raised = {3, 2, ends, rows, &rest};
    rest.row_count = 5;
    rest.parts = parts;
    claim = p.placed;
    claim.proof.raised_count = 1;
    claim.proof.raised = &raised;
    char *text = print(&p, &claim, &size);
    assert_ok(p.context, parse(&p, text, size, &back));
    assert_int_equal(back.proof.raised_count, 1);
    assert_int_equal(back.proof.raised[0].cut_count, 2);
    assert_int_equal(back.proof.raised[0].rows[4], 3);
    char *other = print(&p, &back, &again);
    assert_string_equal(text, other);
    sl_placement_destroy(p.context, &back);
    const size_t from = (size_t)(strstr(text, "\"raised\"") - text);
    const size_t to = (size_t)(strstr(text, "\"program\"") - text);
    for (size_t length = from; length < to; length++)
        assert_int_equal(parse(&p, text, length, &back), SL_BAD_INPUT);
    free(text);
    free(other);
    end(&p);
}

static void other_maps_are_refused(void **state) {
    (void)state;
    plan p, q;
    sl_placement claim;
    size_t size;
    begin_text(&p, texts[3]);
    begin_text(&q, ROOM "wall 5 0 5 4\nwall 5 6.5 5 10\n");
    char *text = print(&p, &p.placed, &size);
    assert_int_equal(parse(&q, text, size, &claim), SL_BAD_INPUT);
    assert_non_null(strstr(sl_context_message(q.context), "another map"));
    free(text);
    end(&p);
    end(&q);
}

/// A claim that is read and holds is true.
static bool is_more_than_true(plan *p, const char *text, size_t size, uint64_t optimum) {
    sl_placement claim;
    sl_place_verdict verdict;
    bool more = false;
    if (parse(p, text, size, &claim) != SL_OK) return false;
    if (sl_place_proof_check(p->context, p->query, &claim, &verdict) == SL_OK)
        more = verdict.lower > optimum || (verdict.sees_all && claim.upper < optimum);
    sl_placement_destroy(p->context, &claim);
    return more;
}

static void change_numbers(plan *p, size_t least) {
    size_t size, changed = 0;
    char *text = print(p, &p->placed, &size);
    assert_int_equal(p->placed.lower, p->placed.upper);
    const size_t end_at = (size_t)(strstr(text, "\"program\"") - text);
    for (size_t i = (size_t)(strstr(text, "\"lower\"") - text); i < end_at; i++) {
        if (text[i] < '0' || text[i] > '9') continue;
        const char was = text[i];
        text[i] = (char)('0' + (was - '0' + 1 + (int)(i % 9)) % 10);
        if (is_more_than_true(p, text, size, p->placed.upper))
            fail_msg("with '%c' at %zu it proves too much", text[i], i);
        text[i] = was;
        changed++;
    }
    assert_true(changed > least);
    free(text);
}

static void no_number_can_be_changed(void **state) {
    (void)state;
    for (size_t i = 3; i < 7; i++) {
        plan p;
        begin_text(&p, texts[i]);
        change_numbers(&p, 50);
        end(&p);
    }
}

static void no_set_can_be_swapped(void **state) {
    (void)state;
    plan p;
    begin_text(&p, texts[6]);
    const sl_cover_problem *all = &p.placed.columns;
    uint32_t *entries = (uint32_t *)(uintptr_t)all->entries;
    assert_true(all->row_count > 2);
    for (size_t i = 0; i < all->ends[all->column_count - 1]; i++) {
        const uint32_t was = entries[i];
        size_t size;
        entries[i] = (was + 1 + (uint32_t)i % (all->row_count - 1)) % all->row_count;
        char *text = print(&p, &p.placed, &size);
        assert_false(is_more_than_true(&p, text, size, p.placed.upper));
        free(text);
        entries[i] = was;
    }
    end(&p);
}

/// Of the columns, none can be left out that the bound rests on.
static void no_column_is_left_out(void **state) {
    (void)state;
    plan p;
    begin_text(&p, texts[6]);
    sl_placement claim = p.placed;
    claim.columns.column_count = 1;
    assert_true(p.placed.columns.column_count > 1);
    const sl_place_verdict verdict = check(&p, &claim);
    assert_true(verdict.has_extra);
    assert_int_equal(verdict.lower, 0);
    end(&p);
}

static void parts_of_files_are_refused(void **state) {
    (void)state;
    plan p;
    size_t size;
    begin_jagged(&p, 1, 0, 0);
    char *text = print(&p, &p.placed, &size);
    for (size_t length = 0; length + 2 < size; length++) {
        sl_placement claim;
        assert_int_equal(parse(&p, text, length, &claim), SL_BAD_INPUT);
        assert_null(claim.viewpoints);
        assert_true(strncmp(sl_context_message(p.context), "proof.json:", 11) == 0);
    }
    free(text);
    end(&p);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(other_code_confirms_plans),
        cmocka_unit_test(other_code_confirms_polygons),
        cmocka_unit_test(implied_witnesses_may_go),
        cmocka_unit_test(files_keep_it),
        cmocka_unit_test(files_may_begin_with_a_mark),
        cmocka_unit_test(files_keep_splits),
        cmocka_unit_test(files_keep_cuts),
        cmocka_unit_test(other_maps_are_refused),
        cmocka_unit_test(no_number_can_be_changed),
        cmocka_unit_test(no_set_can_be_swapped),
        cmocka_unit_test(no_column_is_left_out),
        cmocka_unit_test(parts_of_files_are_refused),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}

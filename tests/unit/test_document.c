/// Documents: pages begin where they must, the same blocks give the same bytes, and nothing is left
/// of a failure.
#include "test_draw_map.h"

#include "sightline/draw.h"
#include "sightline/support.h"

#include <string.h>

static int set_up(void **state) {
    draw_bench *b = draw_bench_make();
    if (!b) return -1;
    b->map = draw_map_make(b->context, DRAW_PLAIN);
    *state = b;
    return 0;
}

static sl_bytes make(draw_bench *b, const sl_document_block *blocks, size_t count) {
    const char *path = draw_path(b, "a.pdf");
    sl_bytes file;
    assert_ok(b->context, sl_draw_document_file(b->context, blocks, count, "A & b", path));
    assert_ok(b->context, sl_file_read(b->context, path, &file));
    unlink(path);
    return file;
}

static unsigned pages_of(draw_bench *b, const sl_document_block *blocks, size_t count) {
    sl_bytes file = make(b, blocks, count);
    unsigned pages = 0;
    const char *end = file.data + file.size;
    for (const char *at = file.data; at + 12 < end; at++)
        pages += memcmp(at, "/Type /Page ", 12) == 0;
    sl_free(b->context, file.data);
    return pages;
}

static const sl_document_block heading = {.kind = SL_BLOCK_HEADING, .text = "A heading"};
static const sl_document_block text = {.kind = SL_BLOCK_TEXT,
                                       .text = "Some words.\nMore, \xc3\xa9."};

static void blocks_fill_pages(void **state) {
    draw_bench *b = *state;
    const sl_document_block picture = {
        .kind = SL_BLOCK_PICTURE, .baked = &b->map.baked, .text = "Below"};
    sl_document_block blocks[40];
    assert_int_equal(pages_of(b, NULL, 0), 1);
    for (int i = 0; i < 40; i++) blocks[i] = text;
    assert_int_equal(pages_of(b, blocks, 10), 1);
    assert_int_equal(pages_of(b, blocks, 40), 2);
    blocks[0] = heading;
    blocks[1] = picture;
    assert_int_equal(pages_of(b, blocks, 2), 1);
    // Two pictures do not fit a page, and a heading stays with its own.
    blocks[2] = heading;
    blocks[3] = text;
    blocks[4] = picture;
    assert_int_equal(pages_of(b, blocks, 5), 2);
    assert_int_equal(pages_of(b, blocks, 4), 1);
}

static void a_table_goes_on_over_pages(void **state) {
    draw_bench *b = *state;
    static const char *cells[2 * 200];
    for (int i = 0; i < 400; i++) cells[i] = i % 2 ? "-12.5" : "a name";
    sl_document_block table = {.kind = SL_BLOCK_TABLE, .cells = cells, .columns = 2, .rows = 30};
    assert_int_equal(pages_of(b, &table, 1), 1);
    // 50 rows on the first page, 49 and the head again on each of the others.
    table.rows = 50 + 3 * 49;
    assert_int_equal(pages_of(b, &table, 1), 4);
    table.rows++;
    assert_int_equal(pages_of(b, &table, 1), 5);
    table.columns = 1; // a single column is the last one, too
    table.rows = 2;
    assert_int_equal(pages_of(b, &table, 1), 1);
}

/// Of any height: a tall thin map is drawn smaller, so that it fits a page.
static void a_tall_picture_fits_a_page(void **state) {
    draw_bench *b = *state;
    draw_map tall = draw_map_make(b->context, (draw_place){0, 0, 1, 100});
    const sl_document_block blocks[] = {{.kind = SL_BLOCK_PICTURE, .baked = &tall.baked}, text};
    assert_int_equal(pages_of(b, blocks, 1), 1);
    assert_int_equal(pages_of(b, blocks, 2), 2);
    sl_baked_destroy(b->context, &tall.baked);
}

static void the_same_blocks_give_the_same_bytes(void **state) {
    draw_bench *b = *state;
    double values[6] = {1, 2, 3, 4, 5, 6};
    const sl_field field = {
        .name = "area", .step = 10, .columns = 3, .rows = 2, .values = values, .unit = "m\xc2\xb2"};
    const sl_document_block blocks[] = {
        heading, text, {.kind = SL_BLOCK_PICTURE, .baked = &b->map.baked, .field = &field}};
    sl_bytes one = make(b, blocks, 3), other = make(b, blocks, 3);
    assert_int_equal(one.size, other.size);
    assert_memory_equal(one.data, other.data, one.size);
    values[5] = 7;
    sl_free(b->context, other.data);
    other = make(b, blocks, 3);
    assert_true(one.size != other.size || memcmp(one.data, other.data, one.size) != 0);
    sl_free(b->context, one.data);
    sl_free(b->context, other.data);
}

/// Names stand on the plan, inside the page.
static void a_plan_has_names(void **state) {
    draw_bench *b = *state;
    const sl_plan_label labels[] = {{"Hall", {10, 5}, 8}, {"A very long name", {30, 5}, 0.1}};
    sl_document_block picture = {.kind = SL_BLOCK_PICTURE, .baked = &b->map.baked};
    sl_bytes plain = make(b, &picture, 1);
    picture.labels = labels;
    picture.label_count = 2;
    sl_bytes named = make(b, &picture, 1);
    assert_true(plain.size != named.size);
    sl_free(b->context, plain.data);
    sl_free(b->context, named.data);
    assert_int_equal(pages_of(b, &picture, 1), 1);
}

static void what_is_no_document_is_refused(void **state) {
    draw_bench *b = *state;
    const char *const cell = "a";
    const sl_document_block bad[] = {
        {.kind = SL_BLOCK_TABLE, .cells = &cell, .columns = 0, .rows = 1},
        {.kind = SL_BLOCK_TABLE, .cells = &cell, .columns = 17, .rows = 1},
        {.kind = SL_BLOCK_TABLE, .cells = &cell, .columns = 1, .rows = 0}};
    for (int i = 0; i < 3; i++)
        assert_int_equal(sl_draw_document_file(b->context, &bad[i], 1, NULL, draw_path(b, "a.pdf")),
                         SL_BAD_ARGUMENT);
    assert_int_equal(sl_draw_document_file(b->context, &text, 1, NULL, draw_path(b, "a.svg")),
                     SL_BAD_ARGUMENT);
    assert_int_equal(sl_draw_document_file(b->context, &text, 1, NULL, draw_path(b, "pdf")),
                     SL_BAD_ARGUMENT);
    assert_int_equal(sl_draw_document_file(b->context, &text, 1, NULL, "/nowhere/a.pdf"), SL_IO);
    assert_int_equal(draw_files_in(b->directory), 0);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(blocks_fill_pages),
        cmocka_unit_test(a_table_goes_on_over_pages),
        cmocka_unit_test(a_tall_picture_fits_a_page),
        cmocka_unit_test(a_plan_has_names),
        cmocka_unit_test(the_same_blocks_give_the_same_bytes),
        cmocka_unit_test(what_is_no_document_is_refused),
    };
    return cmocka_run_group_tests(tests, set_up, draw_bench_end);
}

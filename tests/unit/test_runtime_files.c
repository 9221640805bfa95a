// What the runtime does with files that are cut, damaged, foreign, hostile; and with splits along
// oblique lines.
#define SIGHTLINE_RUNTIME_IMPLEMENTATION
// So little that a search is given up at all: files on which the usual patience ends are not known.
#define SLRT_PATIENCE 1
#include "runtime_maps.h"
#include "slv_file.h"

#include "base/random.h"

#include <math.h>

static const char *const rooms = "walls 0 0 9 0 9 9 0 9 0 0\nwall 4 0 4 5\nwall 4 6 9 6\n";

static sl_runtime_status open_bytes(const char *bytes, size_t size) {
    sl_runtime empty, runtime;
    memset(&empty, 0x5a, sizeof empty);
    memcpy(&runtime, &empty, sizeof empty);
    // In a block of its own size, where what is read beyond is found out.
    char *block = malloc(size ? size : 1);
    assert_non_null(block);
    memcpy(block, bytes, size);
    const sl_runtime_status status = sl_runtime_open(block, size, &runtime);
    if (status != SL_RUNTIME_OK) assert_memory_equal(&runtime, &empty, sizeof empty);
    free(block);
    return status;
}

static void every_length_and_every_bit_counts(void **state) {
    (void)state;
    sl_context *context = testing_context(NULL);
    baked_file f = baked_file_of_text(context, rooms);
    for (size_t size = 0; size < f.size; size++)
        assert_int_equal(open_bytes(f.bytes, size),
                         size < 8 ? SL_RUNTIME_NOT_BAKED : SL_RUNTIME_SIZE);
    for (size_t at = 0; at < f.size; at++)
        for (int bit = 0; bit < 8; bit++) {
            const sl_runtime_status expected = at < 8                ? SL_RUNTIME_NOT_BAKED
                                               : at < 12             ? SL_RUNTIME_VERSION
                                               : at < 16             ? SL_RUNTIME_BYTE_ORDER
                                               : at < 24 && at >= 16 ? SL_RUNTIME_SIZE
                                                                     : SL_RUNTIME_CHECKSUM;
            f.bytes[at] ^= (char)(1 << bit);
            assert_int_equal(open_bytes(f.bytes, f.size), expected);
            f.bytes[at] ^= (char)(1 << bit);
        }
    assert_int_equal(open_bytes(f.bytes, f.size), SL_RUNTIME_OK);
    assert_int_equal(sl_runtime_open(NULL, 0, &f.runtime), SL_RUNTIME_NOT_BAKED);
    assert_int_equal(sl_runtime_open(NULL, 100, &f.runtime), SL_RUNTIME_NOT_BAKED);
    baked_file_destroy(context, &f);
    sl_context_destroy(context);
}

static void the_other_byte_order_is_named(void **state) {
    (void)state;
    sl_context *context = testing_context(NULL);
    baked_file f = baked_file_of_text(context, rooms);
    // As written on such a machine: the version's bytes are turned round too.
    memcpy(f.bytes + 8, "\0\0\0\1\1\2\3\4", 8);
    assert_int_equal(open_bytes(f.bytes, f.size), SL_RUNTIME_BYTE_ORDER);
    baked_file_destroy(context, &f);
    sl_context_destroy(context);
}

static void every_status_has_words(void **state) {
    (void)state;
    for (int i = SL_RUNTIME_OK; i <= SL_RUNTIME_SHARD + 1; i++)
        for (int j = SL_RUNTIME_OK; j < i; j++)
            assert_string_not_equal(sl_runtime_status_text((sl_runtime_status)i),
                                    sl_runtime_status_text((sl_runtime_status)j));
}

static void a_lie_under_a_seal_is_refused(void **state) {
    (void)state;
    const double nan = NAN, far = 2.1e150, infinite = -INFINITY;
    const uint32_t one = 1, three = 3, most = UINT32_MAX, half = 0x80000000;
    const uint64_t much = UINT64_MAX;
    const struct {
        const char *tag;
        size_t offset, size;
        const void *bytes;
        sl_runtime_status status;
    } lies[] = {
        {"INFO", 0, 8, &nan, SL_RUNTIME_SPACE},
        {"INFO", 8, 8, &infinite, SL_RUNTIME_SPACE},
        {"INFO", 16, 8, &far, SL_RUNTIME_SPACE},
        {"INFO", 16, 8, "\0\0\0\0\0\0\0\0", SL_RUNTIME_SPACE},
        {"INFO", 24, 8, "\0\0\0\0\0\0\0\0", SL_RUNTIME_SPACE},
        {"INFO", 32, 4, &most, SL_RUNTIME_OK}, // a child -1 is cell 0
        {"INFO", 32, 4, &half, SL_RUNTIME_SPACE},
        {"INFO", 32, 4, "\377\0\0\0", SL_RUNTIME_SPACE},
        {"NODE", 0, 8, &nan, SL_RUNTIME_SPACE},
        {"NODE", offsetof(sl_node, axis), 4, &three, SL_RUNTIME_SPACE},
        {"NODE", offsetof(sl_node, axis), 4, &most, SL_RUNTIME_SPACE},
        {"NODE", offsetof(sl_node, axis), 4, "\2\0\0\0", SL_RUNTIME_SPACE},  // no lines
        {"NODE", offsetof(sl_node, below), 4, "\0\0\0\0", SL_RUNTIME_SPACE}, // itself
        {"NODE", offsetof(sl_node, above), 4, &half, SL_RUNTIME_SPACE},
        {"NODE", offsetof(sl_node, above), 4, "\377\0\0\0", SL_RUNTIME_SPACE},
        {"NODE", sizeof(sl_node) + offsetof(sl_node, below), 4, "\0\0\0\0", SL_RUNTIME_SPACE},
        {"CELL", offsetof(sl_cell, first_vertex), 4, &most, SL_RUNTIME_SPACE},
        {"CELL", offsetof(sl_cell, vertex_count), 4, &most, SL_RUNTIME_SPACE},
        {"CELL", offsetof(sl_cell, vertex_count), 4, "\2\0\0\0", SL_RUNTIME_SPACE},
        {"CELL", offsetof(sl_cell, first_exit), 4, &one, SL_RUNTIME_SPACE},
        {"CELL", offsetof(sl_cell, exit_count), 4, &most, SL_RUNTIME_SPACE},
        {"CELL", offsetof(sl_cell, exit_count), 4, "\0\0\0\0", SL_RUNTIME_SPACE},
        {"VERT", 8, 8, &infinite, SL_RUNTIME_SPACE},
        {"EXIT", offsetof(sl_exit, portal), 4, &most, SL_RUNTIME_SPACE},
        {"EXIT", offsetof(sl_exit, cell), 4, &most, SL_RUNTIME_SPACE},
        {"EXIT", offsetof(sl_exit, left), 8, &nan, SL_RUNTIME_SPACE},
        {"EXIT", offsetof(sl_exit, right) + 8, 8, &far, SL_RUNTIME_SPACE},
        {"PVSO", 0, 4, &one, SL_RUNTIME_ROW},
        {"PVSO", 8, 8, &much, SL_RUNTIME_ROW},
        {"PVSB", 0, 1, "\1", SL_RUNTIME_ROW},       // not its own cell
        {"PVSB", 1, 1, "\0", SL_RUNTIME_ROW},       // a run of none
        {"PVSB", 1, 1, "\177", SL_RUNTIME_ROW},     // more than there are
        {"PVSB", 0, 2, "\200\200", SL_RUNTIME_ROW}, // a number that does not end
    };
    sl_context *context = testing_context(NULL);
    baked_file f = baked_file_of_text(context, rooms);
    char *bytes = malloc(f.size);
    assert_non_null(bytes);
    for (size_t i = 0; i < sizeof lies / sizeof *lies; i++) {
        memcpy(bytes, f.bytes, f.size);
        memcpy(slv_items(bytes, lies[i].tag) + lies[i].offset, lies[i].bytes, lies[i].size);
        slv_seal(bytes, f.size);
        if (open_bytes(bytes, f.size) != lies[i].status)
            fail_msg("lie %zu in %s + %zu: %s", i, lies[i].tag, lies[i].offset,
                     sl_runtime_status_text(open_bytes(bytes, f.size)));
    }
    free(bytes);
    baked_file_destroy(context, &f);
    sl_context_destroy(context);
}

static void a_table_that_lies_is_refused(void **state) {
    (void)state;
    static const char *const tags[] = {"INFO", "NODE", "CELL", "VERT",
                                       "PORT", "EXIT", "PVSO", "PVSB"};
    sl_context *context = testing_context(NULL);
    baked_file f = baked_file_of_text(context, rooms);
    char *bytes = malloc(f.size);
    assert_non_null(bytes);
    for (size_t i = 0; i < sizeof tags / sizeof *tags; i++) {
        sl_slv_section s;
        memcpy(&s, slv_entry(f.bytes, tags[i]), sizeof s);
        const struct {
            uint32_t item_bytes;
            uint64_t offset, count;
        } lies[] = {
            {0, s.offset, s.count},
            {s.item_bytes + 1, s.offset, s.count},
            {s.item_bytes, f.size + 1, s.count},
            {s.item_bytes, f.size, s.count},
            {s.item_bytes, UINT64_MAX - 7, s.count},
            {s.item_bytes, s.offset, UINT64_MAX},
            {s.item_bytes, s.offset, UINT64_MAX / s.item_bytes - 1},
            {s.item_bytes, s.offset, (f.size - s.offset) / s.item_bytes + 1},
        };
        for (size_t k = 0; k < sizeof lies / sizeof *lies; k++) {
            memcpy(bytes, f.bytes, f.size);
            sl_slv_section lie = s;
            lie.item_bytes = lies[k].item_bytes;
            lie.offset = lies[k].offset;
            lie.count = lies[k].count;
            memcpy(slv_entry(bytes, tags[i]), &lie, sizeof lie);
            slv_seal(bytes, f.size);
            assert_int_equal(open_bytes(bytes, f.size), SL_RUNTIME_SECTION);
        }
        memcpy(bytes, f.bytes, f.size);
        memcpy(slv_entry(bytes, tags[i]), "????", 4);
        slv_seal(bytes, f.size);
        assert_int_equal(open_bytes(bytes, f.size), SL_RUNTIME_SECTION);
    }
    memcpy(bytes, f.bytes, f.size);
    memset(bytes + offsetof(sl_slv_header, section_count), 0xff, 4);
    slv_seal(bytes, f.size);
    assert_int_equal(open_bytes(bytes, f.size), SL_RUNTIME_SECTION);
    free(bytes);
    baked_file_destroy(context, &f);
    sl_context_destroy(context);
}

static void unknown_sections_are_passed_over(void **state) {
    (void)state;
    sl_context *context = testing_context(NULL);
    baked_file f = baked_file_of_text(context, rooms);
    size_t size = f.size, twice_size = f.size;
    char *more = slv_with(f.bytes, &size, "WHAT", "anything", 1, 8);
    assert_int_equal(open_bytes(more, size), SL_RUNTIME_OK);
    char *twice = slv_with(f.bytes, &twice_size, "PVSB", "", 1, 0);
    assert_int_equal(open_bytes(twice, twice_size), SL_RUNTIME_SECTION);
    free(more);
    free(twice);
    baked_file_destroy(context, &f);
    sl_context_destroy(context);
}

/// Every cell leads anywhere by portals that one line passes all of, each of another height: there
/// are more ways through them than can be tried.
static void make_tangle(baked_file *f) {
    const sl_runtime *r = &f->runtime;
    char *exits = slv_items(f->bytes, "EXIT");
    const double middle = r->min_y / 2 + r->max_y / 2, half = r->max_y - middle;
    sl_random random = {1};
    for (uint32_t i = 0; i < r->exit_count; i++) {
        const sl_exit exit = {
            .cell = (uint32_t)sl_random_below(&random, r->cell_count),
            .left = {r->max_x, middle + half * sl_random_unit(&random)},
            .right = {r->max_x, middle - half * sl_random_unit(&random)},
        };
        memcpy(exits + i * sizeof exit, &exit, sizeof exit);
    }
    slv_seal(f->bytes, f->size);
    baked_file_open(f);
}

static void a_search_without_end_is_given_up(void **state) {
    (void)state;
    sl_context *context = testing_context(NULL);
    baked_file f = baked_file_of(context, SIGHTLINE_SOURCE_DIR "/maps/pillars.map");
    make_tangle(&f);
    const uint32_t n = f.runtime.cell_count;
    uint32_t *scratch = malloc(sl_runtime_scratch_count(&f.runtime) * sizeof *scratch);
    uint32_t *cells = malloc(n * sizeof *cells), given_up = 0;
    assert_true(scratch && cells);
    for (uint32_t i = 0; i < f.runtime.vertex_count; i += 16) {
        sl_runtime_view view = sl_runtime_view_all_round(0, 0);
        sl_runtime_get_vertex(&f.runtime, i, &view.x, &view.y);
        const uint32_t cell = sl_runtime_locate(&f.runtime, view.x, view.y);
        const uint32_t count = sl_runtime_look(&f.runtime, &view, scratch, cells, n);
        const uint32_t whole = sl_runtime_row_count(&f.runtime, cell);
        assert_in_range(count, 1, whole);
        // A search that ends has left the path.
        const unsigned char *marks = (unsigned char *)(scratch + (size_t)6 * n);
        bool on_path = false;
        for (uint32_t k = 0; k < n; k++) on_path = on_path || marks[k] & SLRT_ON_PATH;
        if (on_path) assert_int_equal(count, whole);
        given_up += on_path;
    }
    assert_true(given_up > 0);
    free(scratch);
    free(cells);
    baked_file_destroy(context, &f);
    sl_context_destroy(context);
}

// --- oblique lines

/// The file with every split told by a line, moved by `tilt` at one end; for free().
static char *with_lines(const baked_file *f, double tilt, size_t *size) {
    const uint32_t count = f->runtime.node_count;
    sl_segment *lines = calloc(count, sizeof *lines);
    char *bytes = malloc(f->size);
    assert_true(lines && bytes);
    memcpy(bytes, f->bytes, f->size);
    char *nodes = slv_items(bytes, "NODE");
    for (uint32_t i = 0; i < count; i++) {
        sl_node node;
        memcpy(&node, nodes + i * sizeof node, sizeof node);
        const double at = node.position;
        const sl_box *b = &f->baked.space.bounds;
        // What is below lies at the right hand.
        lines[i] = node.axis ? (sl_segment){{b->min.x, at}, {b->max.x, at + tilt}}
                             : (sl_segment){{at, b->max.y}, {at + tilt, b->min.y}};
        node.axis = 2;
        node.line = (int32_t)i;
        memcpy(nodes + i * sizeof node, &node, sizeof node);
    }
    *size = f->size;
    slv_seal(bytes, f->size);
    assert_int_equal(open_bytes(bytes, f->size), SL_RUNTIME_SPACE); // axis 2 without lines
    char *out = slv_with(bytes, size, "LINE", lines, sizeof *lines, count);
    free(bytes);
    free(lines);
    return out;
}

static void lines_split_as_coordinates_do(void **state) {
    (void)state;
    static const char *const names[] = {"maps/office.map", "maps/spiral.map",
                                        "tests/cases/far_1e15.map", "tests/cases/scale_small.map",
                                        "tests/cases/slits_of_an_ulp.map"};
    sl_context *context = testing_context(NULL);
    for (size_t k = 0; k < sizeof names / sizeof *names; k++) {
        char path[1024];
        snprintf(path, sizeof path, "%s/%s", SIGHTLINE_SOURCE_DIR, names[k]);
        baked_file f = baked_file_of(context, path);
        size_t size;
        char *bytes = with_lines(&f, 0, &size);
        sl_runtime oblique;
        assert_int_equal(sl_runtime_open(bytes, size, &oblique), SL_RUNTIME_OK);
        assert_int_equal(oblique.line_count, f.runtime.node_count);
        sl_random random = {2};
        for (int i = 0; i < 5000; i++) {
            const sl_point *v = f.baked.space.vertices;
            const uint32_t count = f.baked.space.vertex_count;
            const double x = v[sl_random_below(&random, count)].x;
            const double y = v[sl_random_below(&random, count)].y;
            // On lines and where they cross; a step of rounding beside them; outside.
            for (int j = 0; j < 4; j++) {
                const double u = j & 1 ? nextafter(x, -INFINITY) : x;
                const double w = j & 2 ? nextafter(y, INFINITY) : y;
                assert_int_equal(sl_runtime_locate(&oblique, u, w),
                                 sl_runtime_locate(&f.runtime, u, w));
            }
        }
        free(bytes);
        baked_file_destroy(context, &f);
    }
    sl_context_destroy(context);
}

/// Splits that are off a little lead to a neighbour: from there the way goes on through exits.
static void the_way_goes_on_to_the_neighbour(void **state) {
    (void)state;
    sl_context *context = testing_context(NULL);
    baked_file f = baked_file_of_text(context, "walls 0 0 30 0 30 10 0 10 0 0\nwall 10 0 10 4\n"
                                               "wall 20 6 20 10\n");
    size_t size;
    char *bytes = with_lines(&f, 1e-3, &size);
    sl_runtime oblique;
    assert_int_equal(sl_runtime_open(bytes, size, &oblique), SL_RUNTIME_OK);
    uint32_t off = 0;
    for (int i = 0; i < 2000; i++) {
        // Beside the lines through x = 10 and x = 20, on either side, away from the walls.
        const double x = (i & 1 ? 10 : 20) + 1e-6 * (i - 1000), y = 5;
        const uint32_t is = sl_runtime_locate(&f.runtime, x, y);
        const uint32_t said = sl_runtime_locate(&oblique, x, y);
        // On the portal either cell will do.
        if (x != 10 && x != 20) assert_int_equal(said, is);
        int32_t at = oblique.root;
        while (at >= 0) {
            const unsigned char *node = oblique.nodes + (size_t)at * SLRT_NODE_BYTES;
            const unsigned char *line =
                oblique.lines + (size_t)slrt_u32(node + 20) * SLRT_LINE_BYTES;
            at = slrt_i32(node + (slrt_side_of_line(line, x, y) < 0 ? 12 : 16));
        }
        off += (uint32_t)~at != is;
    }
    assert_true(off > 100);
    free(bytes);
    baked_file_destroy(context, &f);
    sl_context_destroy(context);
}

static void lines_that_are_none_are_refused(void **state) {
    (void)state;
    sl_context *context = testing_context(NULL);
    baked_file f = baked_file_of_text(context, rooms);
    const double nan = NAN;
    size_t size;
    char *bytes = with_lines(&f, 0, &size);
    char *line = slv_items(bytes, "LINE"), *node = slv_items(bytes, "NODE");
    char kept[32];
    memcpy(kept, line, 32);
    memcpy(line + 16, line, 16); // a point
    slv_seal(bytes, size);
    assert_int_equal(open_bytes(bytes, size), SL_RUNTIME_SPACE);
    memcpy(line, kept, 32);
    memcpy(line + 8, &nan, 8);
    slv_seal(bytes, size);
    assert_int_equal(open_bytes(bytes, size), SL_RUNTIME_SPACE);
    memcpy(line, kept, 32);
    slv_seal(bytes, size);
    assert_int_equal(open_bytes(bytes, size), SL_RUNTIME_OK);
    const uint32_t numbers[] = {f.runtime.node_count, UINT32_MAX, 0x80000000};
    for (size_t i = 0; i < 3; i++) {
        memcpy(node + offsetof(sl_node, line), &numbers[i], 4);
        slv_seal(bytes, size);
        assert_int_equal(open_bytes(bytes, size), SL_RUNTIME_SPACE);
    }
    free(bytes);
    baked_file_destroy(context, &f);
    sl_context_destroy(context);
}

/// What is said of the walls on the sides of oblique cells.
static void sides_on_no_wall_are_refused(void **state) {
    (void)state;
    sl_context *context = testing_context(NULL);
    baked_file f = baked_file_of_text(context, "walls 0 0 9 0 9 9 0 9 0 0\nwall 2 2 6 5\n");
    assert_non_null(f.runtime.beyond);
    const double nan = NAN;
    const uint32_t walls = f.baked.space.wall_count;
    const uint32_t lies[] = {walls, walls | SL_BEYOND_RIGHT, SL_BEYOND_BORDER - 1};
    const uint32_t truths[] = {walls - 1, (walls - 1) | SL_BEYOND_RIGHT, SL_BEYOND_BORDER,
                               SL_BEYOND_EXIT};
    char *bytes = malloc(f.size);
    assert_non_null(bytes);
    memcpy(bytes, f.bytes, f.size);
    for (size_t i = 0; i < sizeof lies / sizeof *lies; i++) {
        memcpy(slv_items(bytes, "BEYO") + 4, &lies[i], 4);
        slv_seal(bytes, f.size);
        assert_int_equal(open_bytes(bytes, f.size), SL_RUNTIME_SPACE);
    }
    for (size_t i = 0; i < sizeof truths / sizeof *truths; i++) {
        memcpy(slv_items(bytes, "BEYO") + 4, &truths[i], 4);
        slv_seal(bytes, f.size);
        assert_int_equal(open_bytes(bytes, f.size), SL_RUNTIME_OK);
    }
    memcpy(slv_items(bytes, "WALL"), &nan, 8);
    slv_seal(bytes, f.size);
    assert_int_equal(open_bytes(bytes, f.size), SL_RUNTIME_SPACE);
    memcpy(bytes, f.bytes, f.size);
    memcpy(slv_entry(bytes, "WALL"), "????", 4);
    slv_seal(bytes, f.size);
    assert_int_equal(open_bytes(bytes, f.size), SL_RUNTIME_SPACE);
    memcpy(bytes, f.bytes, f.size);
    sl_slv_section few;
    memcpy(&few, slv_entry(bytes, "BEYO"), sizeof few);
    few.count--;
    memcpy(slv_entry(bytes, "BEYO"), &few, sizeof few);
    slv_seal(bytes, f.size);
    assert_int_equal(open_bytes(bytes, f.size), SL_RUNTIME_SPACE);
    free(bytes);
    baked_file_destroy(context, &f);
    sl_context_destroy(context);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(every_length_and_every_bit_counts),
        cmocka_unit_test(the_other_byte_order_is_named),
        cmocka_unit_test(every_status_has_words),
        cmocka_unit_test(a_lie_under_a_seal_is_refused),
        cmocka_unit_test(a_table_that_lies_is_refused),
        cmocka_unit_test(unknown_sections_are_passed_over),
        cmocka_unit_test(a_search_without_end_is_given_up),
        cmocka_unit_test(lines_split_as_coordinates_do),
        cmocka_unit_test(the_way_goes_on_to_the_neighbour),
        cmocka_unit_test(lines_that_are_none_are_refused),
        cmocka_unit_test(sides_on_no_wall_are_refused),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}

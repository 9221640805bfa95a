// What the runtime does with files that are cut, damaged, foreign, hostile.
#define SIGHTLINE_RUNTIME_IMPLEMENTATION
// So little that a search is given up at all: files on which the usual patience ends are not known.
#define SLRT_PATIENCE 1
#include "runtime_maps.h"
#include "slv_file.h"

#include "cell_to_cell/pvs_rows.h"
#include "sightline/support.h"

#include <fcntl.h>
#include <math.h>
#include <sys/mman.h>
#include <unistd.h>

static const char *const rooms = "walls 0 0 9 0 9 9 0 9 0 0\nwall 4 0 4 5\nwall 4 6 9 6\n";
static const char *const oblique = "walls 0 0 9 0 9 9 0 9 0 0\nwall 2 2 6 5\n";

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

static void check_lengths_and_bits(const char *statements) {
    sl_context *context = testing_context(NULL);
    baked_file f = baked_file_of_text(context, statements);
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

static void every_length_and_every_bit_counts(void **state) {
    (void)state;
    check_lengths_and_bits(rooms);
    check_lengths_and_bits(oblique);
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
    for (int i = SL_RUNTIME_OK; i <= SL_RUNTIME_OLD + 1; i++)
        for (int j = SL_RUNTIME_OK; j < i; j++)
            assert_string_not_equal(sl_runtime_status_text((sl_runtime_status)i),
                                    sl_runtime_status_text((sl_runtime_status)j));
}

typedef struct lie {
    const char *tag;
    size_t offset, size;
    const void *bytes;
    sl_runtime_status status;
} lie;

static void check_lies(const char *statements, const lie *lies, size_t count) {
    sl_context *context = testing_context(NULL);
    baked_file f = baked_file_of_text(context, statements);
    char *bytes = malloc(f.size);
    assert_non_null(bytes);
    for (size_t i = 0; i < count; i++) {
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

static void a_lie_under_a_seal_is_refused(void **state) {
    (void)state;
    const double nan = slv_f64(NAN), far = slv_f64(2.1e150), infinite = slv_f64(-INFINITY);
    const uint32_t one = slv_u32(1), three = slv_u32(3), most = UINT32_MAX;
    const uint32_t half = slv_u32(0x80000000);
    const uint64_t much = UINT64_MAX;
    const lie lies[] = {
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
        {"CELL", offsetof(sl_cell, first_directed), 4, &one, SL_RUNTIME_SPACE},
        {"CELL", offsetof(sl_cell, directed_count), 4, &most, SL_RUNTIME_SPACE},
        {"CELL", offsetof(sl_cell, directed_count), 4, "\0\0\0\0", SL_RUNTIME_SPACE},
        {"VERT", 8, 8, &infinite, SL_RUNTIME_SPACE},
        {"EXIT", offsetof(sl_directed_portal, portal), 4, &most, SL_RUNTIME_SPACE},
        {"EXIT", offsetof(sl_directed_portal, cell), 4, &most, SL_RUNTIME_SPACE},
        {"EXIT", offsetof(sl_directed_portal, left), 8, &nan, SL_RUNTIME_SPACE},
        {"EXIT", offsetof(sl_directed_portal, right) + 8, 8, &far, SL_RUNTIME_SPACE},
        {"PVSO", 0, 4, &one, SL_RUNTIME_ROW},
        {"PVSO", 8, 8, &much, SL_RUNTIME_ROW},
        {"PVSB", 0, 1, "\1", SL_RUNTIME_ROW},       // not its own cell
        {"PVSB", 1, 1, "\0", SL_RUNTIME_ROW},       // a run of none
        {"PVSB", 1, 1, "\177", SL_RUNTIME_ROW},     // more than there are
        {"PVSB", 0, 2, "\200\200", SL_RUNTIME_ROW}, // a number that does not end
        {"PVSP", 0, 1, "\0", SL_RUNTIME_ROW},
        {"PVSP", 7, 1, "\1", SL_RUNTIME_ROW},
    };
    check_lies(rooms, lies, sizeof lies / sizeof *lies);
}

static void a_lie_about_the_grid_over_the_tree_is_refused(void **state) {
    (void)state;
    const uint32_t none = 0, thousand = slv_u32(1000), most = UINT32_MAX;
    const uint32_t far = slv_u32(UINT32_MAX - 1000);
    const lie lies[] = {
        {"NODG", 0, 4, &none, SL_RUNTIME_SPACE}, {"NODG", 0, 4, &thousand, SL_RUNTIME_SPACE},
        {"NODG", 4, 4, &most, SL_RUNTIME_SPACE}, {"NODS", 0, 4, &thousand, SL_RUNTIME_SPACE},
        {"NODS", 12, 4, &far, SL_RUNTIME_SPACE}, {"NODS", 0, 4, "\0\0\0\200", SL_RUNTIME_SPACE},
        {"NODS", 0, 4, &most, SL_RUNTIME_OK}, // a cell, if another one
    };
    check_lies(rooms, lies, sizeof lies / sizeof *lies);
}

static void a_lie_about_the_grid_is_refused(void **state) {
    (void)state;
    const uint32_t none = 0, one = slv_u32(1), thousand = slv_u32(1000), most = UINT32_MAX;
    const size_t columns = offsetof(sli_slv_info, grid_columns);
    const size_t rows = offsetof(sli_slv_info, grid_rows);
    const lie lies[] = {
        {"INFO", columns, 4, &none, SL_RUNTIME_SPACE},
        {"INFO", columns, 4, &thousand, SL_RUNTIME_SPACE},
        {"INFO", rows, 4, &none, SL_RUNTIME_SPACE},
        {"INFO", rows, 4, &most, SL_RUNTIME_SPACE},
        {"INFO", offsetof(sli_slv_info, loose), 4, &one, SL_RUNTIME_OK},
        {"GRIO", 0, 4, &one, SL_RUNTIME_SPACE},
        {"GRIO", 4, 4, &most, SL_RUNTIME_SPACE},
        {"GRIO", 4, 4, &thousand, SL_RUNTIME_SPACE},
        {"GRIO", 8, 4, &none, SL_RUNTIME_SPACE}, // ends before it starts
        {"GRIC", 0, 4, &most, SL_RUNTIME_SPACE},
        {"GRIC", 0, 4, &thousand, SL_RUNTIME_SPACE},
    };
    check_lies(oblique, lies, sizeof lies / sizeof *lies);
}

static void a_lie_about_the_things_is_refused(void **state) {
    (void)state;
    const double nan = slv_f64(NAN), far = slv_f64(2.1e150), infinite = slv_f64(INFINITY);
    const double minus = slv_f64(-1), small = slv_f64(1e-151), whole = slv_f64(2);
    const uint32_t one = slv_u32(1), most = UINT32_MAX, eleven = slv_u32(11), five = slv_u32(5);
    const lie lies[] = {
        {"MAPI", 0, 8, &nan, SL_RUNTIME_TEXT},      {"MAPI", 0, 8, &minus, SL_RUNTIME_TEXT},
        {"MAPI", 0, 8, &infinite, SL_RUNTIME_TEXT}, {"MAPI", 0, 8, &far, SL_RUNTIME_OK},
        {"MAPI", 8, 8, &nan, SL_RUNTIME_TEXT},      {"MAPI", 16, 8, &far, SL_RUNTIME_TEXT},
        {"MAPI", 24, 8, &minus, SL_RUNTIME_TEXT},   {"MAPI", 24, 8, &small, SL_RUNTIME_TEXT},
        {"MAPI", 24, 8, &whole, SL_RUNTIME_OK},     {"MAPI", 24, 8, &infinite, SL_RUNTIME_TEXT},
        {"MAPI", 32, 1, "\1", SL_RUNTIME_OK},       {"MAPI", 32, 1, "\2", SL_RUNTIME_TEXT},
        {"MAPI", 36, 1, "\1", SL_RUNTIME_TEXT},     {"DOOR", 0, 4, &eleven, SL_RUNTIME_TEXT},
        {"DOOR", 0, 4, &one, SL_RUNTIME_OK},        {"DOOR", 4, 4, &most, SL_RUNTIME_TEXT},
        {"DOOR", 4, 1, "\0", SL_RUNTIME_TEXT},      {"STRT", 0, 8, &far, SL_RUNTIME_TEXT},
        {"STRT", 8, 8, &nan, SL_RUNTIME_TEXT},      {"STRT", 16, 8, &infinite, SL_RUNTIME_TEXT},
        {"STRT", 16, 8, &far, SL_RUNTIME_OK},       {"OBJE", 0, 4, &most, SL_RUNTIME_TEXT},
        {"OBJE", 4, 4, &eleven, SL_RUNTIME_TEXT},   {"OBJE", 8, 8, &nan, SL_RUNTIME_TEXT},
        {"OBJE", 32, 8, &far, SL_RUNTIME_TEXT},     {"PATH", 4, 4, &five, SL_RUNTIME_TEXT},
        {"PATH", 8, 4, &one, SL_RUNTIME_TEXT},      {"PATH", 8, 4, &most, SL_RUNTIME_TEXT},
        {"PATH", 12, 4, &five, SL_RUNTIME_TEXT},    {"PATH", 12, 4, &one, SL_RUNTIME_OK},
        {"PAPO", 24, 8, &nan, SL_RUNTIME_TEXT},     {"MIRR", 24, 8, &nan, SL_RUNTIME_TEXT},
    };
    check_lies("walls 0 0 9 0 9 9 0 9 0 0\ndoor wide 4 0 4 9\nrange 5\nstart 1 1 0\n"
               "object box 1 1 2 2\npath way 1 1 2 2\nmirror 6 2 6 5\n",
               lies, sizeof lies / sizeof *lies);
}

/// A seam names a door that the section of doors has not.
static void a_door_too_few_is_refused(void **state) {
    (void)state;
    sl_context *context = testing_context(NULL);
    baked_file f = baked_file_of_text(context, "walls 0 0 9 0 9 9 0 9 0 0\ndoor wide 4 0 4 9\n");
    memcpy(slv_entry(f.bytes, "DOOR"), "????", 4);
    slv_seal(f.bytes, f.size);
    assert_int_equal(open_bytes(f.bytes, f.size), SL_RUNTIME_TEXT);
    baked_file_destroy(context, &f);
    sl_context_destroy(context);
}

/// Cells in a bucket ascend.
static void a_bucket_without_order_is_refused(void **state) {
    (void)state;
    sl_context *context = testing_context(NULL);
    baked_file f = baked_file_of_text(context, oblique);
    const sl_cell_grid *g = &f.baked.space.grid;
    uint32_t bucket = 0;
    while (g->first[bucket + 1] < g->first[bucket] + 2) bucket++;
    const uint32_t a = slv_u32(g->cells[g->first[bucket]]);
    const uint32_t b = slv_u32(g->cells[g->first[bucket] + 1]);
    const uint32_t pairs[][2] = {{b, a}, {a, a}, {a, b}};
    for (int i = 0; i < 3; i++) {
        memcpy(slv_items(f.bytes, "GRIC") + (size_t)g->first[bucket] * 4, pairs[i], 8);
        slv_seal(f.bytes, f.size);
        assert_int_equal(open_bytes(f.bytes, f.size), i == 2 ? SL_RUNTIME_OK : SL_RUNTIME_SPACE);
    }
    baked_file_destroy(context, &f);
    sl_context_destroy(context);
}

static void check_table(const char *statements, const char *const *tags, size_t count,
                        sl_runtime_status missing) {
    sl_context *context = testing_context(NULL);
    baked_file f = baked_file_of_text(context, statements);
    char *bytes = malloc(f.size);
    assert_non_null(bytes);
    for (size_t i = 0; i < count; i++) {
        const sli_slv_section s = slv_section(slv_entry(f.bytes, tags[i]));
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
            sli_slv_section entry = s;
            entry.item_bytes = lies[k].item_bytes;
            entry.offset = lies[k].offset;
            entry.count = lies[k].count;
            slv_set_section(slv_entry(bytes, tags[i]), entry);
            slv_seal(bytes, f.size);
            assert_int_equal(open_bytes(bytes, f.size), SL_RUNTIME_SECTION);
        }
        memcpy(bytes, f.bytes, f.size);
        memcpy(slv_entry(bytes, tags[i]), "????", 4);
        slv_seal(bytes, f.size);
        assert_int_equal(open_bytes(bytes, f.size), missing);
    }
    memcpy(bytes, f.bytes, f.size);
    memset(bytes + offsetof(sli_slv_header, section_count), 0xff, 4);
    slv_seal(bytes, f.size);
    assert_int_equal(open_bytes(bytes, f.size), SL_RUNTIME_SECTION);
    free(bytes);
    baked_file_destroy(context, &f);
    sl_context_destroy(context);
}

static void a_table_that_lies_is_refused(void **state) {
    (void)state;
    static const char *const tags[] = {"INFO", "NODE", "CELL", "VERT",
                                       "PORT", "EXIT", "PVSO", "PVSB"};
    static const char *const grid[] = {"BEYO", "GRIO", "GRIC"};
    static const char *const over_tree[] = {"NODG", "NODS"};
    static const char *const things[] = {"STRT", "OBJE", "MIRR", "PVSP"};
    check_table(rooms, tags, 8, SL_RUNTIME_SECTION);
    check_table(oblique, grid, 3, SL_RUNTIME_SPACE);
    check_table(rooms, over_tree, 2, SL_RUNTIME_SPACE);
    check_table("walls 0 0 9 0 9 9 0 9 0 0\nstart 1 1 0\nobject box 1 1 2 2\nmirror 6 2 6 5\n",
                things, 4, SL_RUNTIME_OK);
}

/// A file of a tree is no file of a mesh, and the other way round it is a loose one.
static void the_version_says_what_locates_points(void **state) {
    (void)state;
    const uint32_t one = slv_u32(1), two = slv_u32(2);
    sl_context *context = testing_context(NULL);
    baked_file axial = baked_file_of_text(context, rooms);
    baked_file mesh = baked_file_of_text(context, oblique);
    memcpy(axial.bytes + offsetof(sli_slv_header, version), &two, 4);
    slv_seal(axial.bytes, axial.size);
    assert_int_equal(open_bytes(axial.bytes, axial.size), SL_RUNTIME_SPACE);
    memcpy(mesh.bytes + offsetof(sli_slv_header, version), &one, 4);
    slv_seal(mesh.bytes, mesh.size);
    assert_false(mesh.runtime.loose);
    baked_file_open(&mesh);
    assert_true(mesh.runtime.loose);
    assert_null(mesh.runtime.grid_cells);
    sl_random random = {3};
    for (int i = 0; i < 1000; i++) {
        const sl_point p = {-1 + 11 * sl_random_unit(&random), -1 + 11 * sl_random_unit(&random)};
        assert_int_equal(sl_runtime_locate(&mesh.runtime, p.x, p.y),
                         sl_space_locate(&mesh.baked.space, p));
    }
    baked_file_destroy(context, &mesh);
    baked_file_destroy(context, &axial);
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
    char *directed = slv_items(f->bytes, "EXIT");
    const double middle = r->min_y / 2 + r->max_y / 2, half = r->max_y - middle;
    sl_random random = {1};
    for (uint32_t i = 0; i < r->directed_count; i++) {
        sl_directed_portal portal = {
            .cell = (uint32_t)sl_random_below(&random, r->cell_count),
            .left = {r->max_x, middle + half * sl_random_unit(&random)},
            .right = {r->max_x, middle - half * sl_random_unit(&random)},
        };
        sli_slv_order("EXIT", sizeof portal, &portal, 1);
        memcpy(directed + i * sizeof portal, &portal, sizeof portal);
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
        assert_true(count >= 1 && count <= whole);
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

/// Both children of each node are the next one: a graph with two to the power of its depth ways.
static void a_tree_that_is_none_ends(void **state) {
    (void)state;
    sl_context *context = testing_context(NULL);
    baked_file f = baked_file_of(context, SIGHTLINE_SOURCE_DIR "/maps/maze.map");
    const sl_runtime *r = &f.runtime;
    assert_true(r->node_count > 100);
    char *nodes = slv_items(f.bytes, "NODE"), *starts = slv_items(f.bytes, "NODS");
    for (uint32_t i = 0; i < r->node_count; i++) {
        const uint32_t next = slv_u32(i + 1 < r->node_count ? i + 1 : UINT32_MAX);
        for (int k = 0; k < 2; k++) memcpy(nodes + 24 * (size_t)i + 12 + 4 * k, &next, sizeof next);
    }
    memset(slv_items(f.bytes, "INFO") + 32, 0, 4);
    for (size_t i = 0; i < (size_t)r->grid_columns * r->grid_rows; i++)
        memset(starts + 4 * i, 0, 4);
    slv_seal(f.bytes, f.size);
    baked_file_open(&f);
    uint32_t cells[4];
    const uint32_t found =
        sl_runtime_box_cells(r, r->min_x, r->min_y, r->max_x, r->max_y, cells, 4);
    assert_int_equal(found, r->cell_count);
    baked_file_destroy(context, &f);
    sl_context_destroy(context);
}

/// The file at the end of a page, with none behind it: who reads on ends there, in every build.
static sl_runtime_status open_before_a_gap(const char *bytes, size_t size) {
    const size_t page = (size_t)sysconf(_SC_PAGESIZE), whole = (size / page + 1) * page;
    const int nothing = open("/dev/zero", O_RDWR);
    assert_true(nothing >= 0);
    char *block = mmap(NULL, whole + page, PROT_READ | PROT_WRITE, MAP_PRIVATE, nothing, 0);
    close(nothing);
    assert_true(block != MAP_FAILED);
    assert_int_equal(mprotect(block + whole, page, PROT_NONE), 0);
    memcpy(block + whole - size, bytes, size);
    sl_runtime runtime;
    const sl_runtime_status status = sl_runtime_open(block + whole - size, size, &runtime);
    munmap(block, whole + page);
    return status;
}

/// Each section of the file without items, and at its very end.
static void an_empty_section_at_the_end_is_not_read(void **state) {
    (void)state;
    static const char *const tags[] = {"INFO", "NODE", "CELL", "VERT", "PORT", "EXIT",
                                       "PVSO", "PVSB", "PVSP", "NODG", "NODS", "VCIN",
                                       "VCEL", "VCPA", "VCRO", "VCRB"};
    sl_context *context = testing_context(NULL);
    baked_file f = baked_file_of_text(context, rooms);
    const uint32_t count = f.runtime.cell_count;
    uint32_t *views = calloc(count, sizeof *views), none = SL_RUNTIME_NO_CELL;
    assert_non_null(views);
    const sl_pvs *pvs = &f.baked.visibility.pvs;
    const uint64_t own = pvs->offsets[1];
    uint64_t *offsets = calloc(count + 1, sizeof *offsets);
    assert_non_null(offsets);
    for (uint32_t i = 1; i <= count; i++) offsets[i] = own;
    const uint32_t counts[2] = {1, 1};
    const struct {
        const char *tag;
        const void *items;
        uint32_t item_bytes;
        uint64_t count;
    } more[] = {{"VCIN", counts, 8, 1},
                {"VCEL", views, 4, count},
                {"VCPA", &none, 4, 1},
                {"VCRO", offsets, 8, count + 1},
                {"VCRB", pvs->bytes, 1, own}};
    char *bytes = f.bytes;
    size_t size = f.size;
    for (size_t i = 0; i < sizeof more / sizeof *more; i++) {
        char *longer =
            slv_with(bytes, &size, more[i].tag, more[i].items, more[i].item_bytes, more[i].count);
        if (bytes != f.bytes) free(bytes);
        bytes = longer;
    }
    slv_seal(bytes, size);
    assert_int_equal(open_before_a_gap(bytes, size), SL_RUNTIME_OK);
    for (size_t i = 0; i < sizeof tags / sizeof *tags; i++) {
        char *entry = slv_entry(bytes, tags[i]);
        assert_non_null(entry);
        const sli_slv_section was = slv_section(entry);
        sli_slv_section empty = was;
        empty.offset = size;
        empty.count = 0;
        slv_set_section(entry, empty);
        slv_seal(bytes, size);
        const sl_runtime_status status = open_before_a_gap(bytes, size);
        if (status == SL_RUNTIME_OK) fail_msg("a file without %s is opened", tags[i]);
        slv_set_section(entry, was);
    }
    free(bytes);
    free(views);
    free(offsets);
    baked_file_destroy(context, &f);
    sl_context_destroy(context);
}

/// Rows of any cells, and what is told of them.
typedef struct told_rows {
    sl_pvs pvs;
    uint64_t *offsets, *parts; ///< as in the file
    sl_runtime runtime;
} told_rows;

static void make_rows(sl_context *context, sl_random *random, uint32_t cells, told_rows *t) {
    sli_row_bytes *rows = calloc(cells, sizeof *rows);
    sl_bits *set = calloc(sl_bits_words(cells), sizeof *set);
    *t = (told_rows){.offsets = malloc((cells + 1) * sizeof *t->offsets),
                     .parts = malloc(cells * sizeof *t->parts)};
    assert_true(rows && set && t->offsets && t->parts);
    for (uint32_t i = 0; i < cells; i++) {
        memset(set, 0, sl_bits_words(cells) * sizeof *set);
        if (i % 5) sl_bits_add(set, i);
        for (uint64_t runs = i % 5; runs; runs--) {
            const uint64_t first = sl_random_below(random, cells);
            const uint64_t most = sl_random_below(random, 3) ? 3 : cells;
            for (uint64_t k = sl_random_below(random, most); k + 1; k--)
                if (first + k < cells) sl_bits_add(set, (uint32_t)(first + k));
        }
        assert_ok(context, sli_row_append(context, &rows[i], set, cells));
    }
    assert_ok(context, sli_pvs_join(context, rows, cells, &t->pvs));
    sli_pvs_parts(&t->pvs, t->parts);
    memcpy(t->offsets, t->pvs.offsets, (cells + 1) * sizeof *t->offsets);
    sli_slv_order("PVSO", 8, t->offsets, cells + 1);
    sli_slv_order("PVSP", 8, t->parts, cells);
    free(rows);
    free(set);
    t->runtime.cell_count = cells;
    t->runtime.row_offsets = (unsigned char *)t->offsets;
    t->runtime.row_bytes = t->pvs.bytes;
    const slrt_section section = {(unsigned char *)t->parts, cells};
    assert_true(slrt_take_parts(&t->runtime, &section));
}

/// Numbers of cells at which parts become longer: rows say the same of a pair with and without what
/// is told of them, and each bit of that is checked.
static void what_is_told_of_rows_changes_no_answer(void **state) {
    (void)state;
    static const uint32_t counts[] = {1, 2, 63, 64, 65, 128, 129, 200, 1025};
    sl_context *context = testing_context(NULL);
    sl_random random = {11};
    for (size_t i = 0; i < sizeof counts / sizeof *counts; i++) {
        const uint32_t n = counts[i];
        told_rows t;
        make_rows(context, &random, n, &t);
        sl_runtime *r = &t.runtime;
        const slrt_section few = {r->row_parts, n - 1};
        assert_false(
            slrt_take_parts(&(sl_runtime){.cell_count = n, .row_offsets = r->row_offsets}, &few));
        for (uint32_t a = 0; a < n; a++)
            for (uint32_t b = 0; b < n; b++)
                assert_int_equal(sl_runtime_can_see(r, a, b), sl_pvs_sees(&t.pvs, a, b));
        assert_false(sl_runtime_can_see(r, n - 1, n) || sl_runtime_can_see(r, n, n - 1) ||
                     sl_runtime_can_see(r, n - 1, SL_RUNTIME_NO_CELL) ||
                     sl_runtime_can_see(r, SL_RUNTIME_NO_CELL, n - 1));
        const uint64_t bytes = t.pvs.offsets[n];
        assert_true(slrt_rows_are_sound(r, bytes, true));
        for (int bit = 0; bit < 64; bit++) {
            t.parts[n / 2] ^= UINT64_C(1) << bit;
            assert_false(slrt_rows_are_sound(r, bytes, true));
            t.parts[n / 2] ^= UINT64_C(1) << bit;
        }
        free(t.offsets);
        free(t.parts);
        sl_pvs_destroy(context, &t.pvs);
    }
    sl_context_destroy(context);
}

/// Bounds of almost no size about an eye, with corners far outside.
static void no_polygon_has_a_point_that_is_no_number(void **state) {
    (void)state;
    sl_context *context = testing_context(NULL);
    baked_file f = baked_file_of_text(context, "wall 0 0 4 0\nwall 0 3 4 3\n");
    const double bounds[4] = {0, 0, slv_f64(0x1p-1073), slv_f64(0x1p-1042)};
    memcpy(slv_items(f.bytes, "INFO"), bounds, sizeof bounds);
    slv_seal(f.bytes, f.size);
    baked_file_open(&f);
    const sl_runtime_view view = sl_runtime_view_all_round(0x1p-1073, 0x1p-1043);
    uint32_t scratch[64];
    double points[256];
    assert_true(sl_runtime_scratch_count(&f.runtime) <= 64);
    const uint32_t count =
        sl_runtime_visible_polygon(&f.runtime, &view, NULL, 0x1p-1074, scratch, points, 128);
    assert_true(count <= 128);
    for (uint32_t i = 0; i < 2 * count; i++) assert_true(isfinite(points[i]));
    baked_file_destroy(context, &f);
    sl_context_destroy(context);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(every_length_and_every_bit_counts),
        cmocka_unit_test(the_other_byte_order_is_named),
        cmocka_unit_test(every_status_has_words),
        cmocka_unit_test(a_lie_under_a_seal_is_refused),
        cmocka_unit_test(a_lie_about_the_grid_over_the_tree_is_refused),
        cmocka_unit_test(a_lie_about_the_grid_is_refused),
        cmocka_unit_test(a_lie_about_the_things_is_refused),
        cmocka_unit_test(a_door_too_few_is_refused),
        cmocka_unit_test(a_bucket_without_order_is_refused),
        cmocka_unit_test(a_table_that_lies_is_refused),
        cmocka_unit_test(the_version_says_what_locates_points),
        cmocka_unit_test(unknown_sections_are_passed_over),
        cmocka_unit_test(a_search_without_end_is_given_up),
        cmocka_unit_test(a_tree_that_is_none_ends),
        cmocka_unit_test(an_empty_section_at_the_end_is_not_read),
        cmocka_unit_test(what_is_told_of_rows_changes_no_answer),
        cmocka_unit_test(no_polygon_has_a_point_that_is_no_number),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}

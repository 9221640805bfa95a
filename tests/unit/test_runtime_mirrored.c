/// The runtime's eye in maps with mirrors, against the library's exact eye: what is seen directly
/// is the same, and no cell that is seen by mirror is missed. Random axial maps with doors, glass
/// and ranges. SIGHTLINE_SEEDS in the environment: how many maps (64 by default).
#include "baked_bytes.h"
#include "runtime_maps.h"
#include "slv_file.h"

#include "oracle/random_effects.h"

#include "map/scan.h"
#include "sightline/bake.h"

enum { MAPS = 64, EYES = 12, CELLS_MOST = 128, DOORS_MOST = 64 };

typedef struct trial {
    sl_context *context;
    sl_random random;
    baked_file file;
    sl_query *query;
    unsigned char shut[DOORS_MOST];
    uint32_t *scratch;
    size_t by_mirror, left_out; ///< cells seen by mirror alone; cells that are not in the answer
} trial;

static void print_file(sl_context *context, baked_file *f) {
    f->bytes = baked_bytes(context, &f->baked, &f->size);
    baked_file_open(f);
}

static void begin(trial *t, uint64_t seed) {
    const uint32_t depth = 1 + (uint32_t)(seed % 3);
    const unsigned effects = SL_EFFECT_MIRROR | ((unsigned)seed & 1 ? SL_EFFECT_DOOR : 0) |
                             ((unsigned)seed & 2 ? SL_EFFECT_ONEWAY : 0) |
                             ((unsigned)seed & 4 ? SL_EFFECT_RANGE : 0);
    sl_bake_options options = sl_bake_options_default();
    sl_map map = {0};
    t->random = (sl_random){seed};
    t->file = (baked_file){.name = "random"};
    random_effects_map(t->context, &t->random, effects, 1, &map);
    options.mirror_depth = depth;
    assert_ok(t->context, sl_bake(t->context, &map, &options, &t->file.baked, NULL));
    print_file(t->context, &t->file);
    assert_ok(t->context, sl_query_create(t->context, &t->file.baked, &t->query));
    assert_ok(t->context, sl_query_set_mirror_depth(t->context, t->query, depth));
    t->scratch = malloc(sl_runtime_scratch_count(&t->file.runtime) * sizeof *t->scratch);
    assert_non_null(t->scratch);
    assert_true(t->file.runtime.cell_count <= CELLS_MOST);
    assert_true(t->file.runtime.door_count <= DOORS_MOST);
}

static void end(trial *t) {
    sl_query_destroy(t->context, t->query);
    free(t->scratch);
    baked_file_destroy(t->context, &t->file);
}

static void set_doors(trial *t) {
    const sl_map *map = &t->file.baked.map;
    for (size_t i = 0; i < map->door_count; i++) {
        const bool open = sl_random_below(&t->random, 2);
        assert_ok(t->context, sl_query_set_door(t->context, t->query, map->doors[i].name, open));
        for (size_t k = 0; k < map->door_count; k++)
            if (strcmp(map->doors[k].name, map->doors[i].name) == 0) t->shut[k] = !open;
    }
}

static double coordinate(trial *t) {
    const uint64_t steps = sl_random_below(&t->random, 2) ? 8 : 1;
    return (double)sl_random_below(&t->random, RANDOM_EFFECTS_SIZE * steps + 1) / (double)steps;
}

/// Often along walls, and opposite or the same when asked again.
static sl_point beside(trial *t, sl_point eye) {
    static const double ways[10][2] = {{1, 0},   {1, 1},  {0, 1},  {-1, 1}, {-1, 0},
                                       {-1, -1}, {0, -1}, {1, -1}, {1, 2},  {3, -1}};
    const double *way = ways[sl_random_below(&t->random, 10)];
    return (sl_point){eye.x + way[0], eye.y + way[1]};
}

static sl_view random_view(trial *t) {
    const sl_point eye = {coordinate(t), coordinate(t)};
    sl_view view = sl_view_all_round(eye);
    if (sl_random_below(&t->random, 2))
        view = (sl_view){eye, false, beside(t, eye), beside(t, eye)};
    return view;
}

static void fail_at(const sl_view *view, uint32_t cell, const char *what) {
    fail_msg("eye %g,%g%s: cell %u %s", view->eye.x, view->eye.y, view->full ? "" : " with a cone",
             cell, what);
}

/// Looks, and puts how each cell was found into `found`: 1 directly, 2 by mirror, 0 not at all.
static void look(trial *t, const sl_view *view, unsigned char *found) {
    const sl_runtime *r = &t->file.runtime;
    const sl_point eye = view->eye;
    const sl_runtime_view same = {eye.x,
                                  eye.y,
                                  view->full,
                                  {view->right.x - eye.x, view->right.y - eye.y},
                                  {view->left.x - eye.x, view->left.y - eye.y}};
    uint32_t cells[CELLS_MOST], past[CELLS_MOST], direct = 7;
    const uint32_t count =
        sl_runtime_look_mirrored(r, &same, t->shut, 0, t->scratch, cells, CELLS_MOST, &direct);
    memset(found, 0, CELLS_MOST);
    for (uint32_t i = 0; i < count; i++) {
        assert_int_equal(found[cells[i]], 0);
        found[cells[i]] = i < direct ? 1 : 2;
    }
    // What is seen directly is the answer of the plain call, in its order.
    assert_int_equal(sl_runtime_look_past(r, &same, t->shut, 0, t->scratch, past, CELLS_MOST),
                     direct);
    assert_memory_equal(past, cells, direct * sizeof *cells);
    assert_int_equal(sl_runtime_look_mirrored(r, &same, t->shut, 0, t->scratch, past, 1, &direct),
                     count);
}

/// Whether a row of a cell that touches the eye has a cell. What is seen directly along the line of
/// one-way glass, on which the eye is, may be behind shut doors in these rows: a line from the cell
/// would cross the glass from its dark side.
static bool is_in_rows(const trial *t, sl_point eye, uint32_t cell, bool direct) {
    const sl_runtime *r = &t->file.runtime;
    uint32_t own[CELLS_MOST];
    const uint32_t count = sl_runtime_box_cells(r, eye.x, eye.y, eye.x, eye.y, own, r->cell_count);
    for (uint32_t i = 0; i < count; i++)
        if (sl_runtime_can_see_mirrored(r, own[i], cell, t->shut) ||
            (direct && t->file.baked.map.oneway_count && sl_runtime_can_see(r, own[i], cell)))
            return true;
    return false;
}

static void try_eye(trial *t) {
    const sl_runtime *r = &t->file.runtime;
    const sl_view view = random_view(t);
    uint64_t seen[CELLS_MOST / 64 + 1], mirrored[CELLS_MOST / 64 + 1];
    unsigned char found[CELLS_MOST];
    const uint32_t from = sl_runtime_locate(r, view.eye.x, view.eye.y);
    set_doors(t);
    assert_ok(t->context, sl_query_look(t->context, t->query, &view, NULL, seen, NULL));
    assert_ok(t->context,
              sl_query_look_mirrored(t->context, t->query, &view, NULL, mirrored, NULL));
    look(t, &view, found);
    unsigned char bits[CELLS_MOST / 8];
    const uint32_t woken = sl_runtime_seen_from_mirrored(r, &from, 1, t->shut, bits);
    uint32_t in_bits = 0;
    for (uint32_t cell = 0; cell < r->cell_count; cell++) {
        const bool may = sl_runtime_can_see_mirrored(r, from, cell, t->shut);
        in_bits += may;
        if (may != (bits[cell / 8] >> cell % 8 & 1)) fail_at(&view, cell, "is woken or is not");
        // For a library eye on glass that mirrors go with, the side of the cell does not count.
        if (found[cell] == 1 && r->range == 0 && !sl_eye_sees(seen, cell) &&
            !t->file.baked.map.oneway_count)
            fail_at(&view, cell, "is not seen directly");
        if (sl_eye_sees(seen, cell) && found[cell] != 1 && !t->file.baked.map.oneway_count)
            fail_at(&view, cell, "is missed directly");
        if (sl_eye_sees(mirrored, cell) && !found[cell])
            fail_at(&view, cell, "is missed by mirror");
        if (found[cell] && !is_in_rows(t, view.eye, cell, found[cell] == 1))
            fail_at(&view, cell, "is not in the rows");
        if (sl_eye_sees(mirrored, cell)) t->by_mirror += found[cell] == 2;
        t->left_out += !found[cell];
    }
    assert_int_equal(in_bits, woken);
}

static void random_maps(void **state) {
    (void)state;
    trial t = {.context = testing_context(NULL)};
    const uint64_t maps = testing_seeds(MAPS);
    for (uint64_t seed = 1; seed <= maps; seed++) {
        begin(&t, seed);
        assert_int_equal(t.file.runtime.mirrors, SL_RUNTIME_MIRRORS_BAKED);
        for (int i = 0; i < EYES; i++) try_eye(&t);
        end(&t);
    }
    assert_true(t.by_mirror > maps / 4 && t.left_out > maps);
    sl_context_destroy(t.context);
}

/// The row by mirror is that of the library, cell by cell.
static void rows_are_the_librarys(void **state) {
    (void)state;
    trial t = {.context = testing_context(NULL)};
    begin(&t, 3);
    const sl_runtime *r = &t.file.runtime;
    const sl_pvs *rows = &t.file.baked.visibility.mirrored;
    size_t pairs = 0;
    for (uint32_t from = 0; from < r->cell_count; from++) {
        bool in_row[CELLS_MOST] = {false};
        sl_runtime_run run = sl_runtime_mirrored_row(r, from);
        while (sl_runtime_next(&run))
            for (uint32_t to = run.first; to < run.end; to++) in_row[to] = true;
        for (uint32_t to = 0; to < r->cell_count; to++) {
            assert_int_equal(in_row[to], sl_pvs_sees(rows, from, to));
            pairs += in_row[to];
        }
    }
    assert_true(pairs > 0);
    sl_runtime_run none = sl_runtime_mirrored_row(r, r->cell_count);
    assert_false(sl_runtime_next(&none));
    end(&t);
    sl_context_destroy(t.context);
}

static const char hall[] = "walls 0 0 20 0 20 10 0 10 0 0\nwall 10 0 10 8\n";

/// A map without mirrors has no flag, and the call is the plain one.
static void without_mirrors(void **state) {
    (void)state;
    sl_context *context = testing_context(NULL);
    baked_file f = baked_file_of_text(context, hall);
    const sl_runtime *r = &f.runtime;
    uint32_t scratch[256], cells[32], direct;
    unsigned char bits[4];
    const sl_runtime_view view = sl_runtime_view_all_round(2, 2);
    assert_int_equal(r->mirrors, SL_RUNTIME_NO_MIRRORS);
    assert_true(sl_runtime_scratch_count(r) <= 256 && r->cell_count <= 32);
    const uint32_t count = sl_runtime_look_mirrored(r, &view, NULL, 0, scratch, cells, 32, &direct);
    assert_int_equal(count, direct);
    assert_int_equal(count, sl_runtime_look(r, &view, scratch, cells, 32));
    sl_runtime_run none = sl_runtime_mirrored_row(r, 0);
    assert_false(sl_runtime_next(&none));
    for (uint32_t to = 0; to < r->cell_count; to++)
        assert_int_equal(sl_runtime_can_see_mirrored(r, 0, to, NULL), sl_runtime_can_see(r, 0, to));
    assert_int_equal(sl_runtime_seen_from_mirrored(r, cells, 1, NULL, bits),
                     sl_runtime_seen_from(r, cells, 1, NULL, bits));
    baked_file_destroy(context, &f);
    sl_context_destroy(context);
}

/// A bake that did not look into the map's mirrors says so. All cells count as seen.
static void not_baked(void **state) {
    (void)state;
    sl_context *context = testing_context(NULL);
    baked_file f = {.name = "text", .baked = {.method = "dfs", .solver = "funnel"}};
    char text[256];
    snprintf(text, sizeof text, "sightline 1\n%smirror 0 2 0 8\n", hall);
    assert_ok(context, sli_map_read_text(context, "text", text, strlen(text), &f.baked.map));
    assert_ok(context, sl_map_clean(context, &f.baked.map, NULL, NULL));
    baked_file_make(context, &f, false); // by the methods' defaults, so without effects
    const sl_runtime *r = &f.runtime;
    uint32_t scratch[256], cells[32], direct;
    unsigned char bits[4];
    const sl_runtime_view view = sl_runtime_view_toward(15, 2, 1, 0, 0.1);
    assert_int_equal(r->mirrors, SL_RUNTIME_MIRRORS_NOT_BAKED);
    assert_true(sl_runtime_scratch_count(r) <= 256 && r->cell_count <= 32 && r->cell_count > 1);
    assert_int_equal(sl_runtime_look_mirrored(r, &view, NULL, 0, scratch, cells, 32, &direct),
                     r->cell_count);
    assert_true(direct < r->cell_count);
    assert_true(sl_runtime_can_see_mirrored(r, 0, r->cell_count - 1, NULL));
    assert_false(sl_runtime_can_see_mirrored(r, 0, r->cell_count, NULL));
    assert_int_equal(sl_runtime_seen_from_mirrored(r, cells, 1, NULL, bits), r->cell_count);
    baked_file_destroy(context, &f);
    sl_context_destroy(context);
}

/// Rows by mirror are checked as all rows are.
static void damaged_rows_are_refused(void **state) {
    (void)state;
    trial t = {.context = testing_context(NULL)};
    const uint64_t much = UINT64_MAX;
    const struct {
        const char *tag;
        size_t offset, size;
        const void *bytes;
    } lies[] = {{"MIRO", 0, 1, "\1"},   {"MIRO", 8, 8, &much},      {"MIRB", 1, 1, "\0"},
                {"MIRB", 1, 1, "\177"}, {"MIRB", 0, 2, "\200\200"}, {"MDOO", 8, 8, &much},
                {"MDOB", 1, 1, "\0"},   {"MDOB", 0, 1, "\177"}};
    for (uint64_t seed = 1;; seed += 2) { // until some pair that is seen by mirror needs a door
        sli_slv_section doors = {0};
        begin(&t, seed);
        const char *entry = slv_entry(t.file.bytes, "MDOB");
        if (entry) doors = slv_section(entry);
        if (doors.count > 3) break;
        end(&t);
    }
    for (size_t i = 0; i < sizeof lies / sizeof *lies; i++) {
        char *bytes = malloc(t.file.size);
        sl_runtime r;
        assert_non_null(bytes);
        memcpy(bytes, t.file.bytes, t.file.size);
        memcpy(slv_items(bytes, lies[i].tag) + lies[i].offset, lies[i].bytes, lies[i].size);
        slv_seal(bytes, t.file.size);
        const sl_runtime_status status = sl_runtime_open(bytes, t.file.size, &r);
        if (status != SL_RUNTIME_ROW) fail_msg("lie %zu: %s", i, sl_runtime_status_text(status));
        free(bytes);
    }
    end(&t);
    sl_context_destroy(t.context);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(random_maps),
        cmocka_unit_test(rows_are_the_librarys),
        cmocka_unit_test(without_mirrors),
        cmocka_unit_test(not_baked),
        cmocka_unit_test(damaged_rows_are_refused),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}

// What fails once in what compares, measures, draws up and converts, at any allocation.
#include "one_failure.h"
#include "sight/eye_search.h"
#include "space/outline.h"

#include "map_same.h"
#include "sight/region.h"
#include "sightline/axial.h"
#include "sightline/explain.h"
#include "sightline/from_region.h"
#include "sightline/generate.h"
#include "sightline/io.h"
#include "sightline/stab.h"
#include "sightline/steps.h"
#include "sightline/vga.h"
#include "sightline/view.h"
#include "sightline/view_cells.h"
#include "sightline/walk.h"

static const char rooms[] = "walls 0 0 12 0 12 9 0 9 0 0\nwall 4 0 4 5\nwall 8 3 8 9\n"
                            "start 1 1 45\npath p 1 1 2 2 9 3\nobject o 1 1 2 2\n";
static const char effects[] =
    "walls 0 0 12 0 12 9 0 9 0 0\nwall 4 0 4 5\nwall 8 3 8 9\ndoor a 4 5 4 9 open\n"
    "door b 8 0 8 3 shut\nmirror 5 0 7 0\noneway 6 9 6 5\nrange 20\nstart 1 1 0\n";

#define MIX(on, value) one_failure_mix(on, &(value), sizeof(value))

// --- eyes

static sl_status outline_of(sl_context *context, one_failure *on) {
    sl_outline outline = {0};
    sl_region region = {0};
    bool sees = false;
    sl_hit hit = {0};
    const sl_point eye = {1, 1}, to = {5, 7};
    sl_status status = sli_outline_make(context, &on->baked.space, &outline);
    if (status == SL_OK) status = sli_sees(context, &outline, eye, to, SL_CLOSED, &sees);
    if (status == SL_OK) status = sli_ray_cast(context, &outline, eye, to, &hit);
    const sl_view view = sl_view_all_round(eye);
    if (status == SL_OK) status = sli_region_make(context, &outline, &view, 7, &region);
    one_failure_ends(on);
    const double area = status == SL_OK ? sl_region_area(&region) : 0;
    MIX(on, sees);
    MIX(on, hit.wall);
    MIX(on, area);
    sl_region_destroy(context, &region);
    sli_outline_destroy(context, &outline);
    return status;
}

/// Each culling method, by mirror too where it knows mirrors.
static sl_status cull(sl_context *context, one_failure *on) {
    sli_eye_search *search = NULL;
    sl_status status =
        sli_eye_search_create(context, &on->baked.space, &on->baked.visibility, &search);
    if (status == SL_OK) status = sli_eye_search_add_mirrors(context, search, &on->map, 2);
    const sl_view view = sl_view_cone((sl_point){1, 1}, 30, 90, 20);
    size_t count;
    const sl_eye_method *methods = sl_eye_methods(&count);
    for (size_t i = 0; i < count && status == SL_OK; i++) {
        uint64_t cells[8] = {0};
        sl_eye_account account = {0};
        status = methods[i].cull(context, search, &view, cells, &account);
        if (status == SL_OK) MIX(on, cells);
        if (status == SL_OK && methods[i].mirrored)
            status = methods[i].mirrored(context, search, &view, cells, &account);
        if (status == SL_OK) MIX(on, cells);
    }
    one_failure_ends(on);
    sli_eye_search_destroy(context, search);
    return status;
}

static sl_status explain(sl_context *context, one_failure *on) {
    const sl_space *space = &on->baked.space;
    const sl_explain_options options = sl_explain_options_default();
    const bool shut[] = {true, true};
    const sl_explain_state state = {.shut = on->map.door_count ? shut : NULL, .mirror_depth = 1};
    sl_explanation direct = {0};
    sl_effect_explanation all = {0};
    const uint32_t last = space->cell_count - 1;
    sl_status status = sl_explain(context, space, &options, 0, last, &direct);
    if (status == SL_OK)
        status = sl_explain_by_mirror(context, space, &on->map, &options, 2, &direct);
    if (status == SL_OK)
        status = sl_explain_effects(context, space, &on->map, &state, &options, 0, last, &all);
    one_failure_ends(on);
    MIX(on, direct.verdict);
    MIX(on, direct.tests);
    MIX(on, direct.bent.verdict);
    MIX(on, all.now.verdict);
    MIX(on, all.direct.decides);
    MIX(on, all.tests);
    sl_explanation_destroy(context, &direct);
    sl_effect_explanation_destroy(context, &all);
    return status;
}

static sl_status record_steps(sl_context *context, one_failure *on) {
    const sl_steps_options options = sl_steps_options_default();
    sl_steps steps = {0};
    const sl_status status = sl_steps_record(context, &on->baked.space, &options, 0, &steps);
    one_failure_ends(on);
    MIX(on, steps.count);
    sl_steps_destroy(context, &steps);
    return status;
}

// --- a walk, and view cells of others

static sl_status walk(sl_context *context, one_failure *on) {
    sl_hierarchy hierarchy = {0};
    size_t count;
    const sl_walk_method *methods = sl_walk_methods(&count);
    const sl_walk_options options = sl_walk_options_default();
    sl_status status = sl_hierarchy_make(context, &on->baked.space, &hierarchy);
    for (size_t i = 0; i < count && status == SL_OK; i++) {
        sl_walk *made = NULL;
        status = sl_walk_create(context, &hierarchy, &methods[i], &options, &made);
        for (int step = 0; step < 3 && status == SL_OK; step++) {
            const sl_view view = sl_view_cone((sl_point){1 + step, 1}, 30, 90, 20);
            sl_walk_frame frame = {0};
            status = sl_walk_step(context, made, &view, &frame);
            MIX(on, frame);
        }
        sl_walk_destroy(context, made);
    }
    one_failure_ends(on);
    sl_hierarchy_destroy(context, &hierarchy);
    return status;
}

static sl_status see_from_regions(sl_context *context, one_failure *on) {
    sl_from_region_scene_options kinds = sl_from_region_scene_options_default();
    kinds.grid = 3;
    sl_from_region_options options = sl_from_region_options_default();
    options.stab = sl_funnel();
    options.points = options.pixels = 8;
    options.threads = 1;
    sl_from_region_scene *scene = NULL;
    size_t count;
    const sl_from_region_method *methods = sl_from_region_methods(&count);
    sl_status status = sl_from_region_scene_create(context, &on->read, &kinds, &scene);
    for (size_t i = 0; i < count && status == SL_OK; i++) {
        sl_from_region_result made = {0};
        status = methods[i].see(context, scene, &options, &made);
        if (status == SL_OK)
            one_failure_mix(on, made.seen,
                            (size_t)made.view_cells * made.words * sizeof *made.seen);
        sl_from_region_result_destroy(context, &made);
    }
    one_failure_ends(on);
    sl_from_region_scene_destroy(context, scene);
    return status;
}

// --- view cells

typedef struct views {
    sl_outline outline;
    sl_view_places places;
    sl_view_segments segments;
    sl_view_tree tree;
    sl_view_sets sets;
    sl_view_hierarchy merged;
    sl_segment *borders;
    sl_shapes shapes;
} views;

static sl_status make_views(sl_context *context, one_failure *on, const sl_view_method *method,
                            views *v) {
    const sl_space *space = &on->baked.space;
    sl_view_sampling sampling = sl_view_sampling_default();
    sampling.objects = SL_VIEW_CELLS;
    sampling.samples = 60;
    sampling.threads = 1;
    sl_view_subdivision rules = sl_view_subdivision_default();
    rules.cells = 5;
    rules.threads = 1;
    SL_TRY(sli_outline_make(context, space, &v->outline));
    SL_TRY(sl_view_places_inside(context, space, &v->places));
    SL_TRY(sl_view_sample(context, &v->outline, &sampling, &v->segments));
    const sl_view_scene scene = {space, SL_VIEW_CELLS, sl_render_cost_default(), &v->places};
    SL_TRY(method->divide(context, &scene, &v->segments, &rules, &v->tree, NULL));
    SL_TRY(sl_view_sets_sample(context, &scene, &v->tree, &v->segments, 1, &v->sets));
    if (method->merges)
        SL_TRY(sl_view_hierarchy_make(context, &scene, &v->tree, &v->sets, true, &v->merged));
    else
        SL_TRY(sl_view_hierarchy_make(context, &scene, &v->tree, &v->sets, false, &v->merged));
    uint32_t cells = 1, view_cells[32], numbers[32];
    size_t count;
    assert_true(v->tree.cell_count <= 32);
    SL_TRY(sl_view_cut_by_cost(context, &v->merged, 0.1, &cells));
    SL_TRY(sl_view_cut_by_bytes(context, &v->merged, 1000, &cells));
    SL_TRY(sl_view_cut(context, &v->merged, cells, view_cells, numbers));
    SL_TRY(sl_view_borders(context, &v->tree, view_cells, &v->borders, &count));
    SL_TRY(sl_view_shapes(context, &v->tree, view_cells, cells, &v->shapes));
    one_failure_mix(on, v->merged.cost, (2 * v->merged.cell_count - 1) * sizeof *v->merged.cost);
    one_failure_mix(on, v->borders, count * sizeof *v->borders);
    return SL_OK;
}

static sl_status divide_view(sl_context *context, one_failure *on) {
    size_t count;
    const sl_view_method *methods = sl_view_methods(&count);
    sl_status status = SL_OK;
    for (size_t i = 0; i < count && status == SL_OK; i++) {
        views v = {0};
        status = make_views(context, on, &methods[i], &v);
        sl_view_shapes_destroy(context, &v.shapes);
        sl_free(context, v.borders);
        sl_view_hierarchy_destroy(context, &v.merged);
        sl_view_sets_destroy(context, &v.sets);
        sl_view_tree_destroy(context, &v.tree);
        sl_view_segments_destroy(context, &v.segments);
        sl_view_places_destroy(context, &v.places);
        sli_outline_destroy(context, &v.outline);
    }
    one_failure_ends(on);
    return status;
}

// --- space syntax

static sl_status measure_lines(sl_context *context, one_failure *on, const sl_outline *outline) {
    sl_axial_lines lines = {0};
    sl_line_graph graph = {0};
    sl_axial_measures measures[64] = {{0}};
    sl_segment_measures segments[64] = {{0}};
    const sl_axial_options options = {.radius = 3, .threads = 1};
    const sl_segment_options rules = {.metric_radius = 50, .threads = 1};
    sl_status status = sl_axial_all_lines(context, outline, 1, &lines);
    if (status == SL_OK) status = sl_axial_fewest(context, &lines, true);
    if (status == SL_OK) assert_true(lines.count <= 64);
    if (status == SL_OK) status = sl_line_graph_make(context, lines.lines, lines.count, &graph);
    if (status == SL_OK)
        status = sl_axial_measure(context, lines.lines, &graph, &options, measures);
    if (status == SL_OK)
        status = sl_segment_measure(context, lines.lines, lines.count, &rules, segments);
    if (status == SL_OK) MIX(on, measures);
    if (status == SL_OK) MIX(on, segments);
    sl_line_graph_destroy(context, &graph);
    sl_axial_lines_destroy(context, &lines);
    return status;
}

typedef sl_status measurer(sl_context *context, one_failure *on, const sl_outline *outline);

static sl_status in_outline(sl_context *context, one_failure *on, measurer *measure) {
    sl_outline outline = {0};
    sl_status status = sli_outline_make(context, &on->baked.space, &outline);
    if (status == SL_OK) status = measure(context, on, &outline);
    one_failure_ends(on);
    sli_outline_destroy(context, &outline);
    return status;
}

static sl_status lines(sl_context *context, one_failure *on) {
    return in_outline(context, on, measure_lines);
}

static sl_status measure_grid(sl_context *context, one_failure *on, const sl_outline *outline) {
    enum { MOST = 128 };
    const sl_point seed = {1, 1};
    const uint32_t from = 0;
    sl_vga_grid grid = {0};
    sl_vga_graph graph = {0};
    static sl_vga_measures measures[MOST];
    static sl_vga_depths depths[MOST];
    static uint32_t steps[MOST];
    static uint64_t visits[MOST];
    sl_vga_options options = sl_vga_options_default();
    options.parts = SL_VGA_LOCAL | SL_VGA_GLOBAL | SL_VGA_THROUGH | SL_VGA_METRIC | SL_VGA_ANGULAR;
    options.threads = 1;
    sl_vga_agents agents = sl_vga_agents_default();
    agents.agents = 5;
    agents.steps = 20;
    agents.threads = 1;
    sl_status status = sl_vga_grid_make(context, outline, 1.5, &seed, 1, &grid);
    if (status == SL_OK) assert_true(grid.count && grid.count <= MOST);
    if (status == SL_OK) status = sl_vga_graph_make(context, outline, &grid, 0, 1, &graph);
    if (status == SL_OK)
        status = sl_vga_measure(context, outline, &grid, &graph, &options, measures);
    if (status == SL_OK)
        status = sl_vga_depth(context, outline, &grid, &graph, NULL, 0,
                              SL_VGA_GLOBAL | SL_VGA_METRIC, &from, 1, depths);
    if (status == SL_OK) status = sl_vga_walk_agents(context, &grid, &graph, &agents, visits);
    if (status == SL_OK) status = sl_vga_step_depth(context, &graph, &from, 1, steps);
    if (status == SL_OK) status = sl_vga_graph_turn(context, &graph);
    if (status == SL_OK) {
        one_failure_mix(on, measures, grid.count * sizeof *measures);
        one_failure_mix(on, depths, grid.count * sizeof *depths);
        one_failure_mix(on, steps, grid.count * sizeof *steps);
        one_failure_mix(on, visits, grid.count * sizeof *visits);
    }
    sl_vga_graph_destroy(context, &graph);
    sl_vga_grid_destroy(context, &grid);
    return status;
}

static sl_status vga(sl_context *context, one_failure *on) {
    return in_outline(context, on, measure_grid);
}

// --- maps of others

static void mix_map_text(one_failure *on, const sl_map *map) {
    char *text = map_text(map);
    one_failure_mix(on, text, strlen(text));
    free(text);
}

static sl_status generate(sl_context *context, one_failure *on) {
    sl_generate_options options = sl_generate_options_default();
    options.walls = SL_GENERATE_WALLS_LEAST;
    size_t count;
    const sl_map_kind *kinds = sl_map_kinds(&count);
    sl_status status = SL_OK;
    for (size_t i = 0; i < count && status == SL_OK; i++) {
        sl_map map = {0};
        status = sl_generate(context, &kinds[i], &options, &map);
        if (status == SL_OK) mix_map_text(on, &map);
        if (status != SL_OK) assert_true(map_is_empty(&map));
        sl_map_destroy(context, &map);
    }
    one_failure_ends(on);
    return status;
}

/// A seed of the fuzzers by its name; what else a reader allocates is its library's own.
static sl_status read_seed(sl_context *context, one_failure *on, const char *name) {
    char path[4096];
    snprintf(path, sizeof path, "%s/tests/fuzz/seeds/%s", SIGHTLINE_SOURCE_DIR, name);
    sl_map map = {0};
    sl_import_options options = sl_import_options_default();
    options.has_slice = strstr(name, ".ug") != NULL;
    options.slice = 1;
    sl_status status = sl_map_read(context, path, &options, &map);
    one_failure_ends(on);
    if (status == SL_OK) mix_map_text(on, &map);
    if (status != SL_OK) assert_true(map_is_empty(&map));
    sl_map_destroy(context, &map);
    return status;
}

#define SEED(what, file)                                                                           \
    static sl_status read_##what(sl_context *context, one_failure *on) {                           \
        return read_seed(context, on, file);                                                       \
    }
SEED(dxf, "everything.dxf")
SEED(svg, "everything.svg")
SEED(tmx, "everything.tmx")
SEED(tmx_zlib, "zlib.tmx")
SEED(tmx_zstd, "zstd.tmx")
SEED(tmj, "shapes.tmj")
SEED(ldtk, "doors.ldtk")
SEED(uvtt, "everything.dd2vtt")
SEED(foundry, "everything.foundry")
SEED(export, "all.export")
SEED(wad, "nodes3.wad")
SEED(unigrafix, "window.ug")
SEED(agp, "hole.pol")
SEED(image, "dots.pgm")
SEED(ros, "dots.yaml")
SEED(geojson, "lines.geojson")
SEED(world, "one.world")

/// In each format that is written.
static sl_status write_maps(sl_context *context, one_failure *on) {
    sl_status status = SL_OK;
    size_t count;
    const sl_map_format *formats = sl_map_formats(context, &count);
    for (size_t i = 0; i < count && status == SL_OK; i++) {
        if (!formats[i].write) continue;
        char *bytes = NULL;
        size_t size = 0;
        FILE *stream = open_memstream(&bytes, &size);
        assert_non_null(stream);
        status = formats[i].write(context, &on->read, stream);
        assert_int_equal(fclose(stream), 0);
        // What a map does not say in a format is no failure of memory.
        if (status != SL_NO_MEMORY) one_failure_mix(on, bytes, size);
        if (status != SL_NO_MEMORY) status = SL_OK;
        free(bytes);
    }
    one_failure_ends(on);
    return status;
}

#define ROW(call)                                                                                  \
    { #call, call }

static const one_failure_row rows[] = {
    ROW(outline_of),       ROW(cull),        ROW(explain), ROW(record_steps), ROW(walk),
    ROW(see_from_regions), ROW(divide_view), ROW(lines),   ROW(vga),          ROW(write_maps),
};

static const one_failure_row readers[] = {
    ROW(generate),      ROW(read_dxf),     ROW(read_svg),       ROW(read_tmx),   ROW(read_tmx_zlib),
    ROW(read_tmx_zstd), ROW(read_tmj),     ROW(read_ldtk),      ROW(read_uvtt),  ROW(read_foundry),
    ROW(read_export),   ROW(read_wad),     ROW(read_unigrafix), ROW(read_image), ROW(read_agp),
    ROW(read_ros),      ROW(read_geojson), ROW(read_world),
};

static void test_rooms(void **state) {
    (void)state;
    one_failure_check_all(rooms, rows, sizeof rows / sizeof *rows);
}

static void test_effects(void **state) {
    (void)state;
    one_failure_check_all(effects, rows, sizeof rows / sizeof *rows);
}

static void test_readers(void **state) {
    (void)state;
    one_failure_check_all(rooms, readers, sizeof readers / sizeof *readers);
}

int main(void) {
    const struct CMUnitTest tests[] = {cmocka_unit_test(test_rooms), cmocka_unit_test(test_effects),
                                       cmocka_unit_test(test_readers)};
    return cmocka_run_group_tests(tests, NULL, NULL);
}

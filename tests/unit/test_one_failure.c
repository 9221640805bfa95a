// What fails once in the way from a map to a baked file and to its answers, at any allocation.
#include "one_failure.h"

#include "map/source.h"
#include "map_files.h"
#include "sightline/bake.h"
#include "sightline/faults.h"
#include "sightline/json.h"
#include "sightline/stab.h"
#include "space/subdivide.h"

#include <dirent.h>
#include <unistd.h>

static const char rooms[] = "walls 0 0 12 0 12 9 0 9 0 0\nwall 4 0 4 5\nwall 8 3 8 9\n"
                            "solid 1 6 2 6 2 7 1 7\nstart 1 1 45\n";
static const char oblique[] = "walls 0 0 12 1 11 9 1 8 0 0\nwall 4 2 5 5\nwall 8 3 7 7\n"
                              "walls 1 4 2 5 3 4 2 3 1 4\nstart 1 1 45\n";
static const char effects[] =
    "walls 0 0 12 0 12 9 0 9 0 0\nwall 4 0 4 5\nwall 8 3 8 9\ndoor a 4 5 4 9 open\n"
    "door b 8 0 8 3 shut\nmirror 5 0 7 0\noneway 6 9 6 5\nrange 20\nstart 1 1 0\n"
    "path p 1 1 2 2 9 3\nobject o 1 1 2 2\n";

// --- a folder for what is written

static char folder[] = "/tmp/sightline-one-failure-XXXXXX";
static char target[64];

static int make_folder(void **state) {
    (void)state;
    assert_non_null(mkdtemp(folder));
    snprintf(target, sizeof target, "%s/target", folder);
    return 0;
}

static int remove_folder(void **state) {
    (void)state;
    remove(target);
    assert_int_equal(rmdir(folder), 0); // nothing else is left in it
    return 0;
}

static const char older[] = "what was there before\n";

static void write_older(void) {
    FILE *stream = fopen(target, "wb");
    assert_non_null(stream);
    fputs(older, stream);
    assert_int_equal(fclose(stream), 0);
}

/// The target is as new, or as it was; nothing lies beside it.
static void look_at_target(one_failure *on, sl_status status) {
    char bytes[1 << 16];
    FILE *stream = fopen(target, "rb");
    assert_non_null(stream);
    const size_t size = fread(bytes, 1, sizeof bytes, stream);
    fclose(stream);
    if (status == SL_OK)
        one_failure_mix(on, bytes, size);
    else
        assert_true(size == strlen(older) && memcmp(bytes, older, size) == 0);
    DIR *beside = opendir(folder);
    assert_non_null(beside);
    for (struct dirent *e; (e = readdir(beside));)
        if (e->d_name[0] != '.') assert_string_equal(e->d_name, "target");
    closedir(beside);
}

// --- maps

static void mix_map(sl_context *context, one_failure *on, const sl_map *map) {
    write_older();
    assert_ok(context, sl_map_write(context, map, NULL, target));
    look_at_target(on, SL_OK);
}

static sl_status copy(sl_context *context, one_failure *on) {
    sl_map made = {0};
    const sl_status status = sl_map_copy(context, &on->read, &made);
    one_failure_ends(on);
    if (status == SL_OK) mix_map(context, on, &made);
    sl_map_destroy(context, &made);
    return status;
}

typedef sl_status map_change(sl_context *context, sl_map *map);

/// A change of a map; where it fails, the map is whole.
static sl_status change(sl_context *context, one_failure *on, const sl_map *map, map_change *run) {
    const long fail_at = on->memory.fail_at;
    on->memory.fail_at = LONG_MAX - 1;
    sl_map made = {0};
    assert_ok(context, sl_map_copy(context, map, &made));
    on->memory.calls = 0;
    on->memory.fail_at = fail_at;
    const sl_status status = run(context, &made);
    one_failure_ends(on);
    if (status == SL_OK) mix_map(context, on, &made);
    sl_map_destroy(context, &made);
    return status;
}

static sl_status run_clean(sl_context *context, sl_map *map) {
    return sl_map_clean(context, map, NULL, NULL);
}

static sl_status run_mend(sl_context *context, sl_map *map) {
    return sl_map_mend(context, map, 0.25, NULL, NULL);
}

static sl_status run_additions(sl_context *context, sl_map *map) {
    static const sl_point corners[] = {{5, 5}, {6, 5}, {6, 6}, {5, 6}};
    SL_TRY(sl_map_add_solid(context, map, corners, 4, 1));
    SL_TRY(sl_map_add_door(context, map, "z", (sl_segment){{2, 0}, {2, 1}}, true, 2));
    SL_TRY(sl_map_add_path(context, map, "way", corners, 4, 3));
    SL_TRY(sli_map_add_note(context, map, "a note"));
    SL_TRY(sli_map_add_label(context, map, 3, "a label"));
    return sl_effects_settle_doors(context, map);
}

static sl_status clean(sl_context *context, one_failure *on) {
    return change(context, on, &on->read, run_clean);
}

static sl_status mend(sl_context *context, one_failure *on) {
    return change(context, on, &on->read, run_mend);
}

static sl_status add(sl_context *context, one_failure *on) {
    return change(context, on, &on->read, run_additions);
}

static sl_status settle_ground(sl_context *context, one_failure *on) {
    return change(context, on, &on->map, sl_map_settle_ground);
}

static sl_status find_faults(sl_context *context, one_failure *on) {
    sl_faults found = {0};
    double weld = 0;
    sl_inside inside = SL_INSIDE_SURE;
    const sl_faults_options options = {.gap = 0.5, .thin = 2};
    sl_status status = sl_find_faults(context, &on->read, &on->baked.space, &options, &found);
    if (status == SL_OK) status = sl_suggest_weld(context, &on->read, &weld);
    if (status == SL_OK) status = sl_doubt_inside(context, &on->read, &on->baked.space, &inside);
    one_failure_ends(on);
    one_failure_mix(on, found.counts, sizeof found.counts);
    one_failure_mix(on, &weld, sizeof weld);
    one_failure_mix(on, &inside, sizeof inside);
    sl_faults_destroy(context, &found);
    return status;
}

// --- spaces and visible sets

static sl_status subdivide(sl_context *context, one_failure *on) {
    sl_space made = {0};
    sl_status status = sl_subdivision_for(&on->map)->subdivide(context, &on->map, NULL, &made);
    if (status == SL_OK) status = sl_space_check(context, &made);
    one_failure_ends(on);
    if (status == SL_OK) assert_true(sl_baked_same_space(&made, &on->baked.space));
    sl_space_destroy(context, &made);
    return status;
}

static sl_status subdivide_mesh(sl_context *context, one_failure *on) {
    sl_space made = {0};
    sl_status status = sli_subdivide_mesh(context, &on->map, &made);
    if (status == SL_OK) status = sl_space_check(context, &made);
    one_failure_ends(on);
    one_failure_mix(on, made.vertices, made.vertex_count * sizeof *made.vertices);
    sl_space_destroy(context, &made);
    return status;
}

/// By each method of the table, with those of the map's effects that it knows.
static sl_status see_by(sl_context *context, one_failure *on, const sl_see_method *method) {
    sl_see_options options = sl_see_options_default();
    const sl_plan plan = sl_plan_make(&on->map);
    options.plan = plan.effects & ~method->knows ? NULL : &plan;
    options.solver = sl_funnel();
    options.threads = 1;
    options.sectors = 4;
    options.trees = strcmp(method->name, "dfs") == 0;
    sl_visibility made = {0};
    const sl_status status = method->see(context, &on->baked.space, &options, &made);
    one_failure_ends(on);
    if (status == SL_OK) one_failure_mix(on, made.pvs.bytes, made.pvs.offsets[made.pvs.cell_count]);
    if (status == SL_OK) one_failure_mix_seen(context, on, &made);
    sl_visibility_destroy(context, &made);
    return status;
}

/// In two shards, put together.
static sl_status see_in_parts(sl_context *context, one_failure *on) {
    const sl_see_method *method = sl_see_method_named("prune");
    sl_see_options options = sl_see_options_default();
    const sl_plan plan = sl_plan_make(&on->map);
    options.plan = &plan;
    options.solver = sl_funnel();
    options.threads = 1;
    options.shard = 1;
    options.shard_count = 2;
    sl_partial parts[2] = {{0}};
    sl_visibility made = {0};
    sl_status status = method->run(context, &on->baked.space, &options, &parts[0]);
    options.shard = 2;
    if (status == SL_OK) status = method->run(context, &on->baked.space, &options, &parts[1]);
    if (status == SL_OK) status = sl_partial_merge(context, &parts[0], &parts[1]);
    options.shard = options.shard_count = 0;
    if (status == SL_OK)
        status = method->finish(context, &on->baked.space, &options, &parts[0], &made);
    one_failure_ends(on);
    if (status == SL_OK) one_failure_mix_seen(context, on, &made);
    sl_visibility_destroy(context, &made);
    sl_partial_destroy(context, &parts[0]);
    sl_partial_destroy(context, &parts[1]);
    return status;
}

static sl_status bake(sl_context *context, one_failure *on) {
    sl_map map = {0};
    sl_baked made = {0};
    sl_bake_options options = sl_bake_options_default();
    options.see.threads = 1;
    sl_status status = sl_map_copy(context, &on->read, &map);
    if (status == SL_OK) status = sl_bake(context, &map, &options, &made, NULL);
    one_failure_ends(on);
    if (status == SL_OK) one_failure_mix_baked(context, on, &made);
    if (status != SL_OK) assert_int_equal(made.space.cell_count, 0);
    sl_baked_destroy(context, &made);
    sl_map_destroy(context, &map);
    return status;
}

static sl_status shut(sl_context *context, one_failure *on) {
    const bool doors[] = {true, true};
    sl_space space = {0};
    sl_visibility seen = {0};
    const sl_status status = sl_baked_shut(context, &on->baked, doors, &space, &seen);
    one_failure_ends(on);
    if (status == SL_OK) one_failure_mix(on, seen.pvs.bytes, seen.pvs.offsets[space.cell_count]);
    sl_space_destroy(context, &space);
    sl_visibility_destroy(context, &seen);
    return status;
}

// --- files

static sl_status finish_file(one_failure *on, sl_status status) {
    one_failure_ends(on);
    look_at_target(on, status);
    return status;
}

static sl_status write_baked(sl_context *context, one_failure *on) {
    write_older();
    return finish_file(on, sl_baked_write(context, &on->baked, target));
}

static sl_status read_baked(sl_context *context, one_failure *on) {
    const long fail_at = on->memory.fail_at;
    on->memory.fail_at = LONG_MAX - 1;
    assert_ok(context, sl_baked_write(context, &on->baked, target));
    on->memory.calls = 0;
    on->memory.fail_at = fail_at;
    sl_baked made = {0};
    const sl_status status = sl_baked_read(context, target, &made);
    one_failure_ends(on);
    if (status == SL_OK) one_failure_mix_baked(context, on, &made);
    sl_baked_destroy(context, &made);
    return status;
}

/// An export by its name.
static sl_status export_as(sl_context *context, one_failure *on, const char *name) {
    size_t count, i = 0;
    const sl_export_format *formats = sl_export_formats(context, &count);
    while (strcmp(formats[i].name, name) != 0) i++;
    const sl_export_options options = {0};
    write_older();
    return finish_file(on, formats[i].write(context, &on->baked, &options, target));
}

static sl_status write_text(sl_context *context, one_failure *on) {
    write_older();
    return finish_file(on, sl_map_write(context, &on->read, NULL, target));
}

// --- answers

static sl_status ask_view(sl_context *context, one_failure *on, sl_query *query) {
    const sl_view view = sl_query_view(query, (sl_point){1, 1}, 0, 360);
    uint64_t cells[8] = {0};
    bool seen = false, mirrored = false;
    sl_region region = {0};
    sl_mirrored_region bent = {0};
    sl_status status = sl_query_look(context, query, &view, NULL, cells, NULL);
    one_failure_mix(on, cells, sizeof cells);
    if (status == SL_OK) status = sl_query_boxes_seen(context, query, &view, &seen, NULL);
    if (status == SL_OK) status = sl_query_region(context, query, &view, &region);
    if (status == SL_OK && on->map.mirror_count) {
        status = sl_query_look_mirrored(context, query, &view, NULL, cells, NULL);
        if (status == SL_OK) status = sl_query_boxes_seen(context, query, &view, &seen, &mirrored);
        if (status == SL_OK) status = sl_query_mirrored_region(context, query, &view, &bent);
    }
    if (status == SL_OK) {
        const double area = sl_region_area(&region) + sl_mirrored_area(&bent);
        one_failure_mix(on, cells, sizeof cells);
        one_failure_mix(on, (bool[]){seen, mirrored}, 2);
        one_failure_mix(on, &area, sizeof area);
    }
    sl_region_destroy(context, &region);
    sl_mirrored_region_destroy(context, &bent);
    return status;
}

static sl_status ask(sl_context *context, one_failure *on) {
    const sl_moving_box box = {{{6, 4}, {7, 5}}, true};
    sl_query *query = NULL;
    bool sees = false, point = false;
    sl_status status = sl_query_create(context, &on->baked, &query);
    if (status == SL_OK && on->map.door_count)
        status = sl_query_set_door(context, query, "a", false);
    if (status == SL_OK) status = sl_query_set_boxes(context, query, &box, 1);
    if (status == SL_OK) status = sl_query_set_range(context, query, 15);
    if (status == SL_OK) status = ask_view(context, on, query);
    if (status == SL_OK)
        status = sl_query_can_see(context, query, 0, on->baked.space.cell_count - 1, &sees);
    if (status == SL_OK)
        status = sl_query_sees(context, query, (sl_point){1, 1}, (sl_point){5, 7}, &point);
    one_failure_ends(on);
    one_failure_mix(on, (bool[]){sees, point}, 2);
    sl_query_destroy(context, query);
    return status;
}

/// Boxes that could not be placed leave the former ones, and the next question is answered.
static sl_status boxes_stay(sl_context *context, one_failure *on) {
    const long fail_at = on->memory.fail_at;
    on->memory.fail_at = LONG_MAX - 1;
    const sl_moving_box first = {{{6, 4}, {7, 5}}, true}, second = {{{2, 2}, {5, 3}}, true};
    sl_query *query = NULL;
    assert_ok(context, sl_query_create(context, &on->baked, &query));
    assert_ok(context, sl_query_set_boxes(context, query, &first, 1));
    one_failure before = {.map = on->map}, after = {.map = on->map};
    assert_ok(context, ask_view(context, &before, query));
    on->memory.calls = 0;
    on->memory.fail_at = fail_at;
    const sl_status status = sl_query_set_boxes(context, query, &second, 1);
    one_failure_ends(on);
    assert_ok(context, ask_view(context, &after, query));
    if (status != SL_OK)
        assert_true(before.digest == after.digest);
    else
        one_failure_mix(on, &after.digest, sizeof after.digest);
    sl_query_destroy(context, query);
    return status;
}

// --- the tables

#define ROW(call)                                                                                  \
    { #call, call }

#define SEE(method)                                                                                \
    static sl_status see_##method(sl_context *context, one_failure *on) {                          \
        return see_by(context, on, sl_see_method_named(#method));                                  \
    }
SEE(sweep)
SEE(dfs)
SEE(prune)
SEE(multipass)
SEE(flood)
SEE(sampling)

#define EXPORT(name)                                                                               \
    static sl_status export_##name(sl_context *context, one_failure *on) {                         \
        return export_as(context, on, #name);                                                      \
    }
EXPORT(json)
EXPORT(geojson)
EXPORT(csv)
EXPORT(c)

static const one_failure_row rows[] = {
    ROW(copy),          ROW(clean),          ROW(mend),         ROW(add),
    ROW(settle_ground), ROW(find_faults),    ROW(subdivide),    ROW(subdivide_mesh),
    ROW(see_sweep),     ROW(see_dfs),        ROW(see_prune),    ROW(see_multipass),
    ROW(see_flood),     ROW(see_sampling),   ROW(see_in_parts), ROW(bake),
    ROW(shut),          ROW(write_baked),    ROW(read_baked),   ROW(write_text),
    ROW(export_json),   ROW(export_geojson), ROW(export_csv),   ROW(export_c),
    ROW(ask),           ROW(boxes_stay),
};

static void test_axial(void **state) {
    (void)state;
    one_failure_check_all(rooms, rows, sizeof rows / sizeof *rows);
}

static void test_oblique(void **state) {
    (void)state;
    one_failure_check_all(oblique, rows, sizeof rows / sizeof *rows);
}

static void test_effects(void **state) {
    (void)state;
    one_failure_check_all(effects, rows, sizeof rows / sizeof *rows);
}

int main(void) {
    const struct CMUnitTest tests[] = {cmocka_unit_test(test_axial), cmocka_unit_test(test_oblique),
                                       cmocka_unit_test(test_effects)};
    return cmocka_run_group_tests(tests, make_folder, remove_folder);
}

/// What the viewer shows of a map with effects, against the library: viewer_effects MAP
///
/// Prints a line for each layer that an effect changes: its name, then "+" where the viewer has
/// what a query of the library answers from many eyes; else what the viewer says in place of it.
/// Exits with 1, and prints where, if the two differ.
#include "actions.h"
#include "app.h"
#include "files.h"
#include "input.h"
#include "script.h"
#include "sightline/bake.h"
#include "sightline/io.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

static void must(sl_context *context, sl_status status) {
    if (status == SL_OK) return;
    fprintf(stderr, "%s\n", sl_context_message(context));
    exit(1);
}

static void must_be(bool good, sl_point eye, const char *what) {
    if (good) return;
    fprintf(stderr, "eye %g,%g: %s differ\n", eye.x, eye.y, what);
    exit(1);
}

static app_state *start(const char *map) {
    sl_context *context = sl_context_create(NULL);
    app_state *app = calloc(1, sizeof *app);
    if (!context || !app) abort();
    must(context, sl_io_use(context));
    app_init(app, context);
    app->options = sl_import_options_default();
    app->steady = true;
    files_open(app, map, false);
    app_settle(app);
    if (!app->document.baked) {
        fprintf(stderr, "%s: %s\n", map, app->ui.message);
        exit(1);
    }
    for (size_t i = 0; i < app->document.object_count; i++) app->document.blocks[i] = true;
    app->document.touched++;
    script_frame(app);
    return app;
}

/// The same map baked apart from the viewer, with the same boxes.
static sl_query *make_query(const app_state *app, sl_context *context, sl_baked *baked) {
    const document_state *document = &app->document;
    sl_bake_options options = sl_bake_options_default();
    sl_map map = {0};
    sl_query *query;
    sl_moving_box boxes[OBJECTS_MOST] = {0};
    options.mirror_depth = document->mirror_depth;
    must(context, sl_map_copy(context, &document->map, &map));
    must(context, sl_bake(context, &map, &options, baked, NULL));
    must(context, sl_query_create(context, baked, &query));
    for (size_t i = 0; i < document->object_count; i++)
        boxes[i] = (sl_moving_box){document->map.objects[i].box, document->blocks[i]};
    must(context, sl_query_set_boxes(context, query, boxes, document->object_count));
    must(context, sl_query_set_mirror_depth(context, query, document->mirror_depth));
    return query;
}

static bool same_area(double a, double b) {
    return fabs(a - b) <= 1e-9 * (1 + fabs(b));
}

static void compare(const app_state *app, sl_context *context, sl_query *query, sl_point eye) {
    const seen_state *seen = &app->view.seen;
    const size_t size = sl_eye_words(&app->document.baked->space) * sizeof(uint64_t);
    size_t count;
    sl_eye_methods(&count);
    const seen_method *exact = &seen->methods[count - 1];
    uint64_t *cells = calloc(1, size), *by_mirror = calloc(1, size);
    bool boxes[OBJECTS_MOST] = {false}, in_mirrors[OBJECTS_MOST] = {false};
    sl_mirrored_region region = {0};
    if (!cells || !by_mirror) abort();
    must(context, sl_query_look(context, query, &seen->view, NULL, cells, NULL));
    must(context, sl_query_look_mirrored(context, query, &seen->view, NULL, by_mirror, NULL));
    must(context, sl_query_mirrored_region(context, query, &seen->view, &region));
    must(context, sl_query_boxes_seen(context, query, &seen->view, boxes, in_mirrors));
    must_be(seen->valid && memcmp(cells, exact->cells, size) == 0, eye, "cells");
    must_be(!app->document.map.mirror_count || memcmp(by_mirror, exact->mirrored, size) == 0, eye,
            "cells by mirror");
    must_be(same_area(seen->region_area, sl_region_area(&region.direct)), eye, "regions");
    must_be(same_area(seen->mirrored_area, sl_mirrored_area(&region)), eye, "regions in mirrors");
    must_be(memcmp(boxes, seen->objects, seen->object_count * sizeof *boxes) == 0, eye, "objects");
    must_be(memcmp(in_mirrors, seen->objects_mirrored, seen->object_count * sizeof *boxes) == 0,
            eye, "objects by mirror");
    sl_mirrored_region_destroy(context, &region);
    free(cells);
    free(by_mirror);
}

/// Eyes all over the map, some of them in line with walls.
static void look_from_all_over(app_state *app) {
    sl_context *context = sl_context_create(NULL);
    sl_baked baked = {0};
    sl_query *query = make_query(app, context, &baked);
    const sl_box b = baked.space.bounds;
    for (int i = 0; i < 64; i++) {
        const sl_point eye = {b.min.x + (b.max.x - b.min.x) * (i % 8 + 0.5) / 8,
                              b.min.y + (b.max.y - b.min.y) * (i / 8 + 0.5) / 8};
        app->view.eye.at = (sl_point){floor(eye.x), i % 2 ? floor(eye.y) : eye.y};
        app_tick(app, 0);
        script_frame(app);
        if (app->view.seen.cell != SL_NO_CELL) compare(app, context, query, app->view.eye.at);
    }
    sl_query_destroy(context, query);
    sl_baked_destroy(context, &baked);
    sl_context_destroy(context);
    puts("viewer: the eye\t+");
}

static void press_key(app_state *app, const char *key) {
    input_key(app, key, true);
    input_key(app, key, false);
    app_tick(app, 0);
}

static void show_heat_map(app_state *app) {
    const heat_graph *graph;
    press_key(app, "1");
    app_settle(app);
    const bool shown = heat_layer_values(app, &graph) != NULL;
    printf("viewer: the heat map\t%s\n", shown ? "+" : app->ui.message);
}

int main(int argc, char **argv) {
    if (argc != 2) {
        fputs("usage: viewer_effects MAP\n", stderr);
        return 2;
    }
    app_state *app = start(argv[1]);
    look_from_all_over(app);
    show_heat_map(app);
    sl_context *context = app->context;
    app_destroy(app);
    free(app);
    sl_context_destroy(context);
    return 0;
}

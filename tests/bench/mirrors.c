// What mirrors cost and show, by how often they may reflect a sightline: the bake, and what one
// viewpoint sees, its cells and its region.
//   bench_mirrors MAP CHART.png      CSV on stdout: what is made, depth, processor seconds, how
//   much
//                                    of that it shows which DEEPEST reflections show, images
//                                    rounded
#include "bench.h"
#include "sight/eye_search.h"
#include "sight/region.h"
#include "space/outline.h"

#include "sightline/draw.h"
#include "sightline/io.h"
#include "sightline/region.h"
#include "sightline/sightline.h"
#include "sightline/support.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/utsname.h>

enum { DEPTHS = 5, DEEPEST = 8, EYES = 200, KINDS = 3 };
#define SECONDS 0.3 // a figure's, at least

typedef struct figure {
    double seconds, shown;
    uint64_t rounded;
} figure;

typedef struct scene {
    sl_context *context;
    sl_map map;
    sl_space space;
    sl_outline outline;
    sli_room_mirrors mirrors;
    sl_point eyes[EYES];
} scene;

static void read_scene(scene *s, const char *path) {
    const sl_import_options options = sl_import_options_default();
    bench_must(s->context, sl_io_use(s->context));
    bench_must(s->context, sl_map_read(s->context, path, &options, &s->map));
    bench_must(s->context, sl_map_clean(s->context, &s->map, NULL, NULL));
    bench_must(s->context,
               sl_subdivision_for(&s->map)->subdivide(s->context, &s->map, NULL, &s->space));
    bench_must(s->context, sli_outline_make(s->context, &s->space, &s->outline));
    bench_must(s->context, sli_room_mirrors_make(s->context, &s->outline, &s->map, &s->mirrors));
    sl_random random = {7};
    const sl_box *b = &s->space.bounds;
    for (int i = 0; i < EYES;) {
        s->eyes[i] = (sl_point){b->min.x + sl_random_unit(&random) * (b->max.x - b->min.x),
                                b->min.y + sl_random_unit(&random) * (b->max.y - b->min.y)};
        const uint32_t cell = sl_space_locate(&s->space, s->eyes[i]);
        i += cell != SL_NO_CELL && (!s->space.inside_count || s->space.cells[cell].inside);
    }
}

// --- what is made

/// Pairs seen directly or by mirror.
static figure bake(const scene *s, uint32_t depth) {
    sl_plan plan = sl_plan_make(&s->map);
    plan.mirror_depth = depth;
    sl_see_options options = sl_see_options_default();
    options.solver = sl_funnel();
    options.threads = 1;
    options.plan = &plan;
    size_t count;
    const sl_see_method *methods = sl_see_methods(&count);
    while (strcmp(methods->name, "prune") != 0) methods++;
    sl_visibility seen = {0};
    bench_must(s->context, methods->see(s->context, &s->space, &options, &seen));
    figure out = {.rounded = seen.account.effects.rounded_places};
    for (uint32_t a = 0; a < s->space.cell_count; a++)
        for (uint32_t b = 0; b < s->space.cell_count; b++)
            out.shown += sl_pvs_sees(&seen.pvs, a, b) ||
                         (seen.mirrored.cell_count && sl_pvs_sees(&seen.mirrored, a, b));
    sl_visibility_destroy(s->context, &seen);
    return out;
}

/// Cells that all eyes see directly or by mirror.
static figure see_cells(const scene *s, uint32_t depth) {
    const sl_visibility bare = {.sight = SL_CLOSED};
    const size_t words = sl_eye_words(&s->space);
    uint64_t *sets = calloc(2 * words, sizeof *sets);
    if (!sets) abort();
    sli_eye_search *search;
    sl_eye_account account;
    size_t count;
    const sl_eye_method *exact = sl_eye_methods(&count) + count - 1;
    figure out = {0};
    bench_must(s->context, sli_eye_search_create(s->context, &s->space, &bare, &search));
    bench_must(s->context, sli_eye_search_add_mirrors(s->context, search, &s->map, depth));
    for (int i = 0; i < EYES; i++) {
        const sl_view view = sl_view_all_round(s->eyes[i]);
        bench_must(s->context, exact->cull(s->context, search, &view, sets, &account));
        bench_must(s->context, exact->mirrored(s->context, search, &view, sets + words, &account));
        out.rounded += account.rounded;
        for (uint32_t c = 0; c < s->space.cell_count; c++)
            out.shown += sl_eye_sees(sets, c) || sl_eye_sees(sets + words, c);
    }
    sli_eye_search_destroy(s->context, search);
    free(sets);
    return out;
}

/// The area of all eyes' regions, what several mirrors show several times.
static figure see_regions(const scene *s, uint32_t depth) {
    sl_mirrored_region region = {0};
    figure out = {0};
    for (int i = 0; i < EYES; i++) {
        const sl_view view = sl_view_all_round(s->eyes[i]);
        bench_must(s->context, sli_mirrored_region_make(s->context, &s->mirrors, &view,
                                                        s->map.range, depth, &region));
        out.shown += sl_region_area(&region.direct) + sl_mirrored_area(&region);
        for (size_t k = 0; k < region.part_count; k++) out.rounded += region.parts[k].rounded;
    }
    sl_mirrored_region_destroy(s->context, &region);
    return out;
}

static const struct kind {
    const char *name, *called;
    figure (*make)(const scene *s, uint32_t depth);
    int queries;
} kinds[KINDS] = {
    {"cell_to_cell", "cell to cell, the whole bake", bake, 1},
    {"eye_to_cell", "cells that an eye sees", see_cells, EYES},
    {"region", "region that an eye sees", see_regions, EYES},
};

static figure measure(const scene *s, const struct kind *kind, uint32_t depth) {
    figure out = {0};
    int rounds = 0;
    const double start = bench_seconds();
    do {
        out = kind->make(s, depth);
        rounds++;
    } while (bench_seconds() - start < SECONDS);
    out.seconds = (bench_seconds() - start) / rounds / kind->queries;
    return out;
}

// --- what comes of it

static void draw(const scene *s, figure figures[KINDS][DEPTHS], const char *path) {
    static const char *const labels[DEPTHS] = {"0", "1", "2", "3", "4"};
    sl_chart_mark marks[2 * KINDS][DEPTHS]; ///< each place twice: on a line, and with its label
    sl_chart_series series[2 * KINDS];
    for (int k = 0; k < 2 * KINDS; k++) {
        const bool line = k < KINDS;
        for (int d = 0; d < DEPTHS; d++)
            marks[k][d] = (sl_chart_mark){.x = figures[k % KINDS][d].seconds,
                                          .y = 100 * figures[k % KINDS][d].shown,
                                          .label = line ? NULL : labels[d]};
        series[k] = (sl_chart_series){.name = kinds[k % KINDS].called,
                                      .style = line ? SL_CHART_LINE : SL_CHART_MARKS,
                                      .colour = (unsigned)(k % KINDS),
                                      .marks = marks[k],
                                      .mark_count = DEPTHS};
    }
    char subtitle[160];
    snprintf(subtitle, sizeof subtitle,
             "%zu mirrors, %u cells; at each mark the reflections that a sightline may have",
             s->map.mirror_count, (unsigned)s->space.cell_count);
    const sl_chart chart = {
        .title = "What mirrors show against what they cost",
        .subtitle = subtitle,
        .notes =
            "100 %: what eight reflections show, of pairs of cells, of cells, and of area, where "
            "what several mirrors show counts several times",
        .x = {.label = "processor time", .scale = SL_CHART_LOG, .seconds = true},
        .y = {.label = "shown, %"},
        .series = series,
        .series_count = 2 * KINDS,
        .width = 900};
    bench_must(s->context, sl_draw_chart_file(s->context, &chart, path));
}

int main(int argc, char **argv) {
    if (argc != 3) {
        fputs("usage: bench_mirrors MAP CHART.png\n", stderr);
        return 2;
    }
    static scene s;
    struct utsname machine;
    s.context = sl_context_create(NULL);
    if (!s.context || uname(&machine) != 0) return 1;
    read_scene(&s, argv[1]);
    figure figures[KINDS][DEPTHS];
    puts("machine,what,depth,seconds,shown_share,rounded");
    for (int k = 0; k < KINDS; k++) {
        const double all = kinds[k].make(&s, DEEPEST).shown;
        for (uint32_t d = 0; d < DEPTHS; d++) {
            figure *f = &figures[k][d];
            *f = measure(&s, &kinds[k], d);
            f->shown /= all;
            printf("%s,%s,%u,%.3g,%.4f,%llu\n", machine.nodename, kinds[k].name, (unsigned)d,
                   f->seconds, f->shown, (unsigned long long)f->rounded);
        }
    }
    draw(&s, figures, argv[2]);
    sli_room_mirrors_destroy(s.context, &s.mirrors);
    sli_outline_destroy(s.context, &s.outline);
    sl_space_destroy(s.context, &s.space);
    sl_map_destroy(s.context, &s.map);
    sl_context_destroy(s.context);
    return 0;
}

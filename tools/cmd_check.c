/// `sightline check`: leaks, gaps, overlaps and thin cells of a map; closes gaps with --snap.
#include "commands.h"
#include "json_print.h"
#include "pipeline.h"
#include "sightline/draw.h"
#include "sightline/faults.h"
#include "sightline/support.h"

#include <math.h>

typedef struct faults_report {
    const char *input;
    const sl_map *map;
    const sl_space *space;
    const sl_faults *faults;
    double gap, thin;
    const char *mended; ///< the file written; NULL for none
    sl_snap_account snap;
    uint32_t left[SL_FAULT_KINDS]; ///< what the mended map has, by kind
    uint64_t most;                 ///< of a kind, in the text
} faults_report;

// --- the report

/// "(1,2.5)"
static void print_point(const char *before, sl_point point) {
    printf("%s(%.6g,%.6g)", before, point.x, point.y);
}

/// "lines 3 and 7", where the walls' lines are known.
static void print_lines(const sl_map *map, const sl_fault *fault) {
    const uint32_t a = map->walls[fault->walls[0]].line, b = map->walls[fault->walls[1]].line;
    if (a && b) printf(", lines %u and %u", (unsigned)a, (unsigned)b);
}

static void print_leak(const faults_report *report, const sl_fault *fault) {
    print_point("    from ", report->faults->points[fault->first_point]);
    printf(" through %u cells to the border at ", (unsigned)fault->cells);
    print_point("", report->faults->points[fault->first_point + fault->point_count - 1]);
    if (fault->size > 0) {
        printf("; its narrowest portal, %.6g wide, is ", fault->size);
        print_point("", fault->at.a);
        print_point("-", fault->at.b);
    }
    putchar('\n');
}

static void print_fault(const faults_report *report, const sl_fault *fault) {
    switch (fault->kind) {
    case SL_FAULT_LEAK:
        print_leak(report, fault);
        return;
    case SL_FAULT_GAP:
        printf("    %.6g wide, from ", fault->size);
        print_point("", fault->at.a);
        print_point(" to ", fault->at.b);
        print_lines(report->map, fault);
        break;
    case SL_FAULT_OVERLAP:
        printf("    %.6g long, from ", fault->size);
        print_point("", fault->at.a);
        print_point(" to ", fault->at.b);
        print_lines(report->map, fault);
        break;
    case SL_FAULT_CROSSING:
        print_point("    at ", fault->at.a);
        print_lines(report->map, fault);
        break;
    case SL_FAULT_THIN:
        printf("    cell %u, %.6g wide", (unsigned)fault->cell, fault->size);
        print_point(" at ", fault->at.a);
        break;
    default:
        printf("    %u cell%s, area %.6g", (unsigned)fault->cells, fault->cells == 1 ? "" : "s",
               fault->size);
        print_point(", about ", fault->at.a);
    }
    putchar('\n');
}

static void print_kind(const faults_report *report, sl_fault_kind kind) {
    static const char *const what[SL_FAULT_KINDS] = {
        "leak: a way from a start to the map's border",
        "gap: a wall's end near another wall",
        "overlap: a piece that two walls share (bake joins them)",
        "crossing: where two walls cross (no mistake if they are meant to)",
        "thin: a cell thinner than the width asked about",
        "unreachable: a room that no start leads to"};
    const sl_faults *faults = report->faults;
    if (!faults->counts[kind]) return;
    printf("  %u %s\n", (unsigned)faults->counts[kind], what[kind]);
    uint64_t printed = 0;
    for (uint32_t i = 0; i < faults->count && printed < report->most; i++) {
        if (faults->items[i].kind != kind) continue;
        print_fault(report, &faults->items[i]);
        printed++;
    }
    if (printed < faults->counts[kind])
        printf("    ... and %u more (--most N, --json)\n",
               (unsigned)(faults->counts[kind] - printed));
}

static sl_status faults_print(const faults_report *report) {
    const sl_faults *faults = report->faults;
    printf("%s: %zu walls, %u cells; gaps up to %.4g and cells thinner than %.4g looked for\n",
           report->input, report->map->wall_count, (unsigned)report->space->cell_count, report->gap,
           report->thin);
    for (int kind = 0; kind < SL_FAULT_KINDS; kind++) print_kind(report, (sl_fault_kind)kind);
    if (!faults->count) puts("  nothing found");
    if (!faults->has_starts)
        puts("  leaks and unreachable rooms need a start to be told: give --start X,Y");
    if (report->mended) {
        printf("%s: %zu wall ends moved, by %.6g at most; %zu walls vanished; left over: ",
               report->mended, report->snap.moved, report->snap.farthest, report->snap.vanished);
        for (int kind = 0; kind < SL_FAULT_KINDS; kind++)
            printf("%s%u %s", kind ? ", " : "", (unsigned)report->left[kind],
                   sl_fault_name((sl_fault_kind)kind));
        putchar('\n');
    } else if (faults->counts[SL_FAULT_GAP]) {
        puts("  --snap FIXED.map closes the gaps and writes the map so mended");
    }
    return SL_OK;
}

// --- JSON

static json_fields fault_fields(const faults_report *report, const sl_fault *fault) {
    json_fields fields = json_begin();
    const sl_point at[2] = {fault->at.a, fault->at.b};
    json_add_text(&fields, "kind", sl_fault_name(fault->kind));
    json_add_real(&fields, "size", fault->size);
    json_add_points(&fields, "at", at, 2);
    if (fault->walls[0] != UINT32_MAX) {
        json_add_count(&fields, "wall", fault->walls[0]);
        json_add_count(&fields, "line", report->map->walls[fault->walls[0]].line);
        json_add_count(&fields, "other_wall", fault->walls[1]);
        json_add_count(&fields, "other_line", report->map->walls[fault->walls[1]].line);
    }
    if (fault->walls[0] == UINT32_MAX) json_add_count(&fields, "cell", fault->cell);
    if (fault->cells) json_add_count(&fields, "cells", fault->cells);
    if (fault->point_count)
        json_add_points(&fields, "way", report->faults->points + fault->first_point,
                        fault->point_count);
    return fields;
}

static void add_counts(json_fields *fields, const char *key,
                       const uint32_t counts[SL_FAULT_KINDS]) {
    json_fields inner = json_begin();
    for (int kind = 0; kind < SL_FAULT_KINDS; kind++)
        json_add_count(&inner, sl_fault_name((sl_fault_kind)kind), counts[kind]);
    json_add_fields(fields, key, &inner);
}

static sl_status faults_print_json(sl_context *context, const faults_report *report) {
    const uint32_t count = report->faults->count;
    json_fields fields = json_begin();
    json_fields *items = sl_alloc_array(context, count, sizeof *items);
    if (!items) return SL_NO_MEMORY;
    json_add_text(&fields, "file", report->input);
    json_add_count(&fields, "walls", report->map->wall_count);
    json_add_count(&fields, "cells", report->space->cell_count);
    json_add_real(&fields, "gap", report->gap);
    json_add_real(&fields, "thin", report->thin);
    json_add_flag(&fields, "has_starts", report->faults->has_starts);
    add_counts(&fields, "counts", report->faults->counts);
    for (uint32_t i = 0; i < count; i++) items[i] = fault_fields(report, &report->faults->items[i]);
    json_add_list(&fields, "faults", items, count);
    if (report->mended) {
        json_fields mended = json_begin();
        json_add_text(&mended, "file", report->mended);
        json_add_count(&mended, "moved", report->snap.moved);
        json_add_real(&mended, "farthest", report->snap.farthest);
        json_add_count(&mended, "vanished", report->snap.vanished);
        add_counts(&mended, "counts", report->left);
        json_add_fields(&fields, "mended", &mended);
    }
    sl_free(context, items);
    return json_print(context, &fields);
}

// --- the command

typedef struct check_plan {
    map_pipeline pipeline;
    sl_faults_options faults;
    sl_draw_options drawing;
    const char *output, *snap;
    uint64_t most;
    bool json;
} check_plan;

/// A map with its space and its faults.
typedef struct checked {
    sl_map map;     ///< as read: walls with their lines
    sl_baked baked; ///< its space, and the rest of the map for the picture
    sl_faults faults;
} checked;

static void destroy(sl_context *context, checked *c) {
    sl_map_destroy(context, &c->map);
    sl_baked_destroy(context, &c->baked);
    sl_faults_destroy(context, &c->faults);
}

/// Subdivides and finds faults. c->map is as it was read; c->baked.map is a copy, which is cleaned.
static sl_status examine(sl_context *context, const check_plan *plan, checked *c) {
    SL_TRY(input_clean(context, &plan->pipeline.input, &c->baked.map, NULL));
    SL_TRY(pipeline_subdivide(context, &plan->pipeline, &c->baked.map, &c->baked.space));
    return sl_find_faults(context, &c->map, &c->baked.space, &plan->faults, &c->faults);
}

/// Closes gaps, writes the map, and counts what is left.
static sl_status mend(sl_context *context, const check_plan *plan, const checked *before,
                      faults_report *report) {
    checked after = {0};
    sl_status status = sl_map_copy(context, &before->map, &after.map);
    if (status == SL_OK) status = sl_map_snap(context, &after.map, report->gap, &report->snap);
    if (status == SL_OK && !after.map.wall_count)
        status = sl_fail(context, SL_BAD_ARGUMENT,
                         "--snap %s: closing gaps up to %g (--gap) leaves no wall", plan->snap,
                         report->gap);
    if (status == SL_OK) status = sl_map_copy(context, &after.map, &after.baked.map);
    if (status == SL_OK) status = examine(context, plan, &after);
    if (status == SL_OK) status = sl_map_write_text(context, &after.map, plan->snap);
    for (int kind = 0; kind < SL_FAULT_KINDS; kind++)
        report->left[kind] = after.faults.counts[kind];
    report->mended = plan->snap;
    destroy(context, &after);
    return status;
}

static sl_status check(command_console *console, const check_plan *plan, checked *c) {
    sl_context *context = console->context;
    SL_TRY(pipeline_read(context, &plan->pipeline, &c->map));
    SL_TRY(sl_map_copy(context, &c->map, &c->baked.map));
    SL_TRY(examine(context, plan, c));
    const sl_box box = sl_map_bounds(&c->map);
    const double usual = hypot(box.max.x - box.min.x, box.max.y - box.min.y) / 1000;
    faults_report report = {.input = plan->pipeline.path,
                            .map = &c->map,
                            .space = &c->baked.space,
                            .faults = &c->faults,
                            .gap = plan->faults.gap > 0 ? plan->faults.gap : usual,
                            .thin = plan->faults.thin > 0 ? plan->faults.thin : usual,
                            .most = plan->most};
    if (plan->snap) SL_TRY(mend(context, plan, c, &report));
    if (plan->output) {
        sl_draw_options drawing = plan->drawing;
        drawing.faults = &c->faults;
        SL_TRY(sl_draw_file(context, &c->baked, &drawing, plan->output));
    }
    progress_line_clear(&console->line);
    return plan->json ? faults_print_json(context, &report) : faults_print(&report);
}

static void print_tables(void) {
    pipeline_print_subdivisions();
    input_print_formats();
}

sl_status cmd_check(command_console *console, int argc, char **argv) {
    check_plan plan = {
        .pipeline = pipeline_default(), .drawing = sl_draw_options_default(), .most = 10};
    const option_table pipeline = pipeline_option_table(&plan.pipeline);
    const option_spec options[] = {
        {"gap", 0, "SIZE",
         "tell of gaps up to this width (the default is a\nthousandth of the map's diagonal)",
         .number = &plan.faults.gap, .over_0 = true},
        {"thin", 0, "SIZE", "tell of cells thinner than this (the same default)",
         .number = &plan.faults.thin, .over_0 = true},
        {"snap", 0, "FIXED.map", "close such gaps and write the map so mended", .text = &plan.snap,
         .check = CHECK_FILE},
        {"output", 'o', "PICTURE", "mark all faults on the plan: .png, .svg or .pdf",
         .text = &plan.output, .check = CHECK_PICTURE},
        {"width", 0, "PX", "of the picture, 64 to 20000 pixels or points",
         .number = &plan.drawing.width, .least = SL_DRAW_WIDTH_MIN, .most = SL_DRAW_WIDTH_MAX},
        {"dark", 0, NULL, "light on dark", .flag = &plan.drawing.dark},
        {"most", 0, "N", "print so many faults of a kind, 10 unless told", .count = &plan.most,
         .most = UINT32_MAX},
        {.group = &pipeline},
        {"json", 0, NULL, "print all faults as one JSON object", .flag = &plan.json},
    };
    const command_usage usage = {
        .name = "check",
        .synopsis = "MAP [options]",
        .operands = {"MAP"},
        .what = "Looks a map over: leaks from a start to the outside with their way, gaps between\n"
                "walls, overlaps and crossings, thin cells, rooms that no start leads to.",
        .tables = print_tables,
        .examples = "  sightline check office.map -o office-check.png\n"
                    "  sightline check plan.dxf --start 3,5 --gap 0.02 --snap mended.map",
        .options = options,
        .option_count = sizeof options / sizeof *options,
    };
    checked c = {0};
    bool helped;
    const char *input;
    SL_TRY(options_parse(console, &usage, argc, argv, &input, &helped));
    if (helped) return SL_OK;
    SL_TRY(pipeline_plan(console->context, input, &plan.pipeline));
    const sl_status status = check(console, &plan, &c);
    destroy(console->context, &c);
    return status;
}

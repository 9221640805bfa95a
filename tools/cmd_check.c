/// `sightline check`: leaks, gaps, overlaps and thin cells of a map; closes gaps with --snap.
#include "commands.h"
#include "json_print.h"
#include "pipeline.h"
#include "sightline/draw.h"
#include "sightline/faults.h"
#include "sightline/support.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

/// A map with its space and its faults.
typedef struct checked {
    sl_map map;     ///< as read: walls with their lines
    sl_baked baked; ///< its space, and the rest of the map for the picture
    sl_faults faults;
    sl_inside inside;
} checked;

typedef struct faults_report {
    const char *input;
    const checked *found;
    double gap, thin;
    const char *mended; ///< the file written; NULL for none
    sl_snap_account snap;
    const checked *left;          ///< the mended map
    double helps;                 ///< a larger gap that closes a leak; 0 for none
    uint64_t most;                ///< of a kind, in the text
    const char *picture;          ///< NULL for none
    const char *start, *gap_text; ///< as given, to be said again; NULL for none
} faults_report;

// --- the report

/// "(1,2.5)"
static void print_point(const char *before, sl_point point, int digits) {
    printf("%s(%.*g,%.*g)", before, digits, point.x, digits, point.y);
}

/// The digits that tell two points apart, to about a hundredth of their distance.
static int digits_for(sl_segment at) {
    const double most = fmax(fmax(fabs(at.a.x), fabs(at.a.y)), fmax(fabs(at.b.x), fabs(at.b.y)));
    const double apart = hypot(at.b.x - at.a.x, at.b.y - at.a.y);
    if (!(apart > 0 && most > 0)) return 6;
    return (int)fmin(fmax(ceil(log10(most / apart)) + 3, 6), 17);
}

/// The digits for a place in a map, which may lie far from the origin.
static int digits_in(const sl_map *map) {
    const sl_box box = sl_map_bounds(map);
    const double most =
        fmax(fmax(fabs(box.min.x), fabs(box.min.y)), fmax(fabs(box.max.x), fabs(box.max.y)));
    const double across = hypot(box.max.x - box.min.x, box.max.y - box.min.y);
    if (!(across > 0 && most > 0)) return 6;
    return (int)fmin(fmax(ceil(log10(most / across)), 0) + 6, 17);
}

/// "from (1,2) to (3,4)"
static void print_ends(sl_segment at) {
    const int digits = digits_for(at);
    print_point("from ", at.a, digits);
    print_point(" to ", at.b, digits);
}

/// "lines 3 and 7", where the walls' lines are known.
static void print_lines(const sl_map *map, const sl_fault *fault) {
    unsigned lines[2] = {0, 0};
    for (int i = 0; i < 2; i++)
        if (fault->walls[i] != UINT32_MAX) lines[i] = map->walls[fault->walls[i]].line;
    if (lines[0] && lines[1] && lines[0] != lines[1])
        printf(", lines %u and %u", lines[0], lines[1]);
    else if (lines[0] || lines[1])
        printf(", line %u", lines[0] ? lines[0] : lines[1]);
}

static void print_width(double width) {
    if (width > 0)
        printf("    %.6g wide, ", width);
    else
        printf("    narrower than rounding, ");
}

static void print_leak(const checked *found, const sl_fault *fault) {
    const sl_point *way = found->faults.points + fault->first_point;
    print_width(fault->size);
    print_ends(fault->at);
    print_lines(&found->map, fault);
    print_point("; the way to it begins at ", way[0], digits_in(&found->map));
    putchar('\n');
}

static void print_fault(const checked *found, const sl_fault *fault) {
    switch (fault->kind) {
    case SL_FAULT_LEAK:
        print_leak(found, fault);
        return;
    case SL_FAULT_GAP:
        print_width(fault->size);
        print_ends(fault->at);
        print_lines(&found->map, fault);
        if (fault->stays) printf("; needs a decision");
        break;
    case SL_FAULT_OVERLAP:
        printf("    %.6g long, ", fault->size);
        print_ends(fault->at);
        print_lines(&found->map, fault);
        break;
    case SL_FAULT_CROSSING:
        print_point("    at ", fault->at.a, digits_in(&found->map));
        print_lines(&found->map, fault);
        break;
    case SL_FAULT_THIN:
        printf("    cell %u, %.6g wide", (unsigned)fault->cell, fault->size);
        print_point(" at ", fault->at.a, digits_for(fault->at));
        break;
    default:
        printf("    %u cell%s, area %.6g", (unsigned)fault->cells, fault->cells == 1 ? "" : "s",
               fault->size);
        print_point(", about ", fault->at.a, digits_in(&found->map));
    }
    putchar('\n');
}

static void print_kind(const checked *found, sl_fault_kind kind, uint64_t most) {
    static const char *const what[SL_FAULT_KINDS] = {
        "leak: an opening through which a start leads to the map's border",
        "gap: a wall's end near another wall",
        "overlap: a piece that two walls share (bake joins them)",
        "crossing: where two walls cross (no mistake if they are meant to)",
        "thin: a cell thinner than the width asked about",
        "unreachable: a room that no start leads to"};
    const sl_faults *faults = &found->faults;
    if (!faults->counts[kind]) return;
    printf("  %u %s\n", (unsigned)faults->counts[kind], what[kind]);
    uint64_t printed = 0;
    for (uint32_t i = 0; i < faults->count && printed < most; i++) {
        if (faults->items[i].kind != kind) continue;
        print_fault(found, &faults->items[i]);
        printed++;
    }
    if (printed < faults->counts[kind])
        printf("    ... and %u more (--most N, --json)\n",
               (unsigned)(faults->counts[kind] - printed));
}

/// The gaps that snapping closes.
static uint32_t closable(const sl_faults *faults) {
    uint32_t count = 0;
    for (uint32_t i = 0; i < faults->count; i++)
        count += faults->items[i].kind == SL_FAULT_GAP && !faults->items[i].stays;
    return count;
}

static void print_mended(const faults_report *report) {
    const sl_faults *left = &report->left->faults;
    printf("%s: %zu wall ends moved, by %.6g at most; %zu walls vanished; left over: ",
           report->mended, report->snap.moved, report->snap.farthest, report->snap.vanished);
    for (int kind = 0; kind < SL_FAULT_KINDS; kind++)
        printf("%s%u %s", kind ? ", " : "", (unsigned)left->counts[kind],
               sl_fault_name((sl_fault_kind)kind));
    putchar('\n');
    if (left->counts[SL_FAULT_LEAK] || left->counts[SL_FAULT_GAP])
        printf("  what is left needs a decision (by lines of %s):\n", report->input);
    print_kind(report->left, SL_FAULT_LEAK, report->most);
    print_kind(report->left, SL_FAULT_GAP, report->most);
}

static void print_snap_advice(const faults_report *report) {
    const sl_faults *faults = &report->found->faults;
    const uint32_t gaps = faults->counts[SL_FAULT_GAP], closes = closable(faults);
    if (report->helps > 0)
        printf("  --gap %.2g is wide enough for --snap to close a leak\n", report->helps);
    if (closes && closes == gaps)
        puts("  --snap FIXED.map closes the gaps and writes the map so mended");
    else if (closes)
        printf("  --snap FIXED.map closes %u of the gaps; %u need a decision\n", (unsigned)closes,
               (unsigned)(gaps - closes));
    else if (gaps)
        puts("  --snap does not close these gaps: each needs a decision");
}

// --- the next command

/// A word for the shell: in quotes if it is not made of plain characters.
static void print_word(const char *before, const char *word) {
    const char *plain = "abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ0123456789_-+./,:=@%";
    fputs(before, stdout);
    if (word[0] && strspn(word, plain) == strlen(word)) {
        fputs(word, stdout);
        return;
    }
    putchar('\'');
    for (; *word; word++)
        if (*word == '\'')
            fputs("'\\''", stdout);
        else
            putchar(*word);
    putchar('\'');
}

/// "sightline check MAP", with the options for reading it.
static void print_command(const faults_report *report, const char *command) {
    printf("next: sightline %s", command);
    print_word(" ", report->input);
    if (report->start) printf(" --start %s", report->start);
}

/// " --snap office-fixed.map"
static void print_name(const faults_report *report, const char *option, const char *end) {
    size_t length;
    char name[256];
    const char *base = input_base_name(report->input, &length);
    const bool fits = length < sizeof name / 2 && strcmp(report->input, "-") != 0;
    snprintf(name, sizeof name, "%.*s%s", fits ? (int)length : 3, fits ? base : "map", end);
    print_word(option, name);
}

static void print_gap_again(const faults_report *report) {
    if (report->gap_text) printf(" --gap %s", report->gap_text);
}

static void print_next_of_mended(const faults_report *report) {
    const uint32_t *counts = report->left->faults.counts;
    const bool left = counts[SL_FAULT_LEAK] || counts[SL_FAULT_GAP];
    print_word(left ? "next: sightline check " : "next: sightline bake ", report->mended);
    if (left) {
        print_gap_again(report);
        print_name(report, " -o ", "-fixed.png");
    }
}

static void print_next(const faults_report *report) {
    const sl_faults *faults = &report->found->faults;
    const bool grave = faults->counts[SL_FAULT_LEAK] || faults->counts[SL_FAULT_GAP];
    if (report->mended) {
        print_next_of_mended(report);
    } else if (report->helps > 0) {
        print_command(report, "check");
        printf(" --gap %.2g", report->helps);
        print_name(report, " --snap ", "-fixed.map");
    } else if (closable(faults)) {
        print_command(report, "check");
        print_gap_again(report);
        print_name(report, " --snap ", "-fixed.map");
    } else if (!faults->has_starts) {
        print_command(report, "check");
        print_gap_again(report);
        fputs(" --start X,Y", stdout);
    } else if (grave && !report->picture) {
        print_command(report, "check");
        print_gap_again(report);
        print_name(report, " -o ", "-check.png");
    } else if (grave) {
        print_command(report, "check");
        print_gap_again(report);
        fputs(", once the walls named above are mended", stdout);
    } else {
        print_command(report, "bake");
    }
    putchar('\n');
}

static sl_status faults_print(const faults_report *report) {
    const checked *found = report->found;
    const sl_faults *faults = &found->faults;
    printf("%s: %zu walls, %u cells; gaps up to %.4g and cells thinner than %.4g looked for\n",
           report->input, found->map.wall_count, (unsigned)found->baked.space.cell_count,
           report->gap, report->thin);
    for (int kind = 0; kind < SL_FAULT_KINDS; kind++)
        print_kind(found, (sl_fault_kind)kind, report->most);
    if (found->inside == SL_INSIDE_SMALL)
        puts("  inside is doubtful: walls enclose less than half of the map, and it has no start");
    else if (!faults->count)
        puts("  nothing found");
    if (!faults->has_starts)
        puts("  leaks and unreachable rooms need a start to be told: give --start X,Y");
    if (report->mended)
        print_mended(report);
    else
        print_snap_advice(report);
    print_next(report);
    return SL_OK;
}

// --- JSON

static json_fields fault_fields(const checked *found, const sl_fault *fault) {
    const sl_map *map = &found->map;
    json_fields fields = json_begin();
    const sl_point at[2] = {fault->at.a, fault->at.b};
    json_add_text(&fields, "kind", sl_fault_name(fault->kind));
    json_add_real(&fields, "size", fault->size);
    json_add_points(&fields, "at", at, 2);
    if (fault->walls[0] != UINT32_MAX) {
        json_add_count(&fields, "wall", fault->walls[0]);
        json_add_count(&fields, "line", map->walls[fault->walls[0]].line);
    }
    if (fault->walls[1] != UINT32_MAX) {
        json_add_count(&fields, "other_wall", fault->walls[1]);
        json_add_count(&fields, "other_line", map->walls[fault->walls[1]].line);
    }
    if (fault->cell != SL_NO_CELL) json_add_count(&fields, "cell", fault->cell);
    if (fault->kind == SL_FAULT_GAP) json_add_flag(&fields, "needs_decision", fault->stays);
    if (fault->cells) json_add_count(&fields, "cells", fault->cells);
    if (fault->point_count)
        json_add_points(&fields, "way", found->faults.points + fault->first_point,
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
    static const char *const inside[] = {"sure", "leaks", "doubtful"};
    const checked *found = report->found;
    const uint32_t count = found->faults.count;
    json_fields fields = json_begin();
    json_fields *items = sl_alloc_array(context, count, sizeof *items);
    if (!items) return SL_NO_MEMORY;
    json_add_text(&fields, "file", report->input);
    json_add_count(&fields, "walls", found->map.wall_count);
    json_add_count(&fields, "cells", found->baked.space.cell_count);
    json_add_real(&fields, "gap", report->gap);
    json_add_real(&fields, "thin", report->thin);
    json_add_flag(&fields, "has_starts", found->faults.has_starts);
    json_add_text(&fields, "inside", inside[found->inside]);
    if (report->helps > 0) json_add_real(&fields, "gap_that_helps", report->helps);
    add_counts(&fields, "counts", found->faults.counts);
    for (uint32_t i = 0; i < count; i++) items[i] = fault_fields(found, &found->faults.items[i]);
    json_add_list(&fields, "faults", items, count);
    if (report->mended) {
        json_fields mended = json_begin();
        json_add_text(&mended, "file", report->mended);
        json_add_count(&mended, "moved", report->snap.moved);
        json_add_real(&mended, "farthest", report->snap.farthest);
        json_add_count(&mended, "vanished", report->snap.vanished);
        add_counts(&mended, "counts", report->left->faults.counts);
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
    const char *output, *snap, *gap_given;
    uint64_t most;
    bool json, strict;
    char gap_text[SL_NUMBER_TEXT];
} check_plan;

static void destroy(sl_context *context, checked *c) {
    sl_map_destroy(context, &c->map);
    sl_baked_destroy(context, &c->baked);
    sl_faults_destroy(context, &c->faults);
}

/// Subdivides and finds faults. c->map is as it was read; c->baked.map becomes a clean copy.
static sl_status examine(sl_context *context, const check_plan *plan, double gap, checked *c) {
    sl_faults_options options = plan->faults;
    options.gap = gap;
    options.clean = &plan->pipeline.input.clean;
    sl_baked_destroy(context, &c->baked);
    sl_faults_destroy(context, &c->faults);
    SL_TRY(sl_map_copy(context, &c->map, &c->baked.map));
    SL_TRY(input_clean(context, &plan->pipeline.input, &c->baked.map, NULL));
    SL_TRY(pipeline_subdivide(context, &plan->pipeline, &c->baked.map, &c->baked.space));
    SL_TRY(sl_doubt_inside(context, &c->baked.map, &c->baked.space, &c->inside));
    return sl_find_faults(context, &c->map, &c->baked.space, &options, &c->faults);
}

static double usual_gap(const sl_map *map) {
    const sl_box box = sl_map_bounds(map);
    return hypot(box.max.x - box.min.x, box.max.y - box.min.y) / 1000;
}

/// Mends a copy of the map as read, and looks at what is left.
static sl_status mend_copy(sl_context *context, const check_plan *plan, const sl_map *map,
                           double gap, sl_snap_account *account, checked *after) {
    SL_TRY(sl_map_copy(context, map, &after->map));
    SL_TRY(sl_map_mend(context, &after->map, gap, &plan->pipeline.input.clean, account));
    if (!after->map.wall_count) return SL_OK;
    const double own = plan->faults.gap > 0 ? gap : fmax(gap, usual_gap(&after->map));
    return examine(context, plan, own, after);
}

/// Closes gaps and writes the map.
static sl_status mend(sl_context *context, const check_plan *plan, const sl_map *map,
                      faults_report *report, checked *after) {
    SL_TRY(mend_copy(context, plan, map, report->gap, &report->snap, after));
    if (!after->map.wall_count)
        return sl_fail(context, SL_BAD_ARGUMENT,
                       "--snap %s: closing gaps up to %g (--gap) leaves no wall", plan->snap,
                       report->gap);
    SL_TRY(sl_map_write_text(context, &after->map, plan->snap));
    report->mended = plan->snap;
    report->left = after;
    return SL_OK;
}

/// The least number of two digits that is not below a width.
static double round_up(double width) {
    const double unit = pow(10, floor(log10(width)) - 1);
    char text[SL_NUMBER_TEXT];
    snprintf(text, sizeof text, "%.2g", width);
    double rounded = strtod(text, NULL);
    if (rounded < width) {
        snprintf(text, sizeof text, "%.2g", rounded + unit);
        rounded = strtod(text, NULL);
    }
    return rounded;
}

/// Tries whether snapping closes the narrowest leak, if it is small against the map. Openings that
/// are larger are meant.
static sl_status suggest_gap(sl_context *context, const check_plan *plan, const checked *c,
                             faults_report *report) {
    const sl_faults *faults = &c->faults;
    if (!faults->counts[SL_FAULT_LEAK] || !(faults->items[0].size > report->gap)) return SL_OK;
    const double gap = round_up(faults->items[0].size);
    if (gap > 20 * usual_gap(&c->map)) return SL_OK;
    checked after = {0};
    sl_snap_account account = {0};
    const sl_status status = mend_copy(context, plan, &c->map, gap, &account, &after);
    if (status == SL_OK && after.map.wall_count &&
        after.faults.counts[SL_FAULT_LEAK] < faults->counts[SL_FAULT_LEAK])
        report->helps = gap;
    destroy(context, &after);
    // A trial that cannot be done is no help, and no failure.
    return status == SL_NO_MEMORY || status == SL_CANCELLED ? status : SL_OK;
}

static sl_status check(command_console *console, const check_plan *plan, checked *c,
                       checked *after) {
    sl_context *context = console->context;
    SL_TRY(pipeline_read(context, &plan->pipeline, &c->map));
    SL_TRY(examine(context, plan, plan->faults.gap, c));
    const double usual = usual_gap(&c->map);
    faults_report report = {.input = plan->pipeline.path,
                            .found = c,
                            .gap = plan->faults.gap > 0 ? plan->faults.gap : usual,
                            .thin = plan->faults.thin > 0 ? plan->faults.thin : usual,
                            .most = plan->most,
                            .picture = plan->output,
                            .start = plan->pipeline.start_text,
                            .gap_text = plan->gap_given ? plan->gap_text : NULL};
    if (plan->snap)
        SL_TRY(mend(context, plan, &c->map, &report, after));
    else
        SL_TRY(suggest_gap(context, plan, c, &report));
    if (plan->output) {
        sl_draw_options drawing = plan->drawing;
        drawing.faults = &c->faults;
        SL_TRY(sl_draw_file(context, &c->baked, &drawing, plan->output));
    }
    console->fault = plan->strict && (c->faults.count || c->inside == SL_INSIDE_SMALL);
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
         .number = &plan.faults.gap, .over_0 = true, .given = &plan.gap_given},
        {"thin", 0, "SIZE", "tell of cells thinner than this (the same default)",
         .number = &plan.faults.thin, .over_0 = true},
        {"snap", 0, "FIXED.map", "close such gaps and write the map so mended", .text = &plan.snap,
         .check = CHECK_FILE},
        {"output", 'o', "PICTURE", "mark all faults on the plan: .png, .svg or .pdf",
         .text = &plan.output, .check = CHECK_PICTURE},
        {"width", 0, "PX", "of the picture, 64 to 20000 pixels or points",
         .number = &plan.drawing.width, .least = SL_DRAW_WIDTH_MIN, .most = SL_DRAW_WIDTH_MAX},
        {"dark", 0, NULL, "light on dark", .flag = &plan.drawing.dark},
        {"most", 0, "N", "print up to N faults of a kind (default 10)", .count = &plan.most,
         .most = UINT32_MAX},
        {.group = &pipeline},
        {"strict", 0, NULL, "exit with status 3 if a fault is found", .flag = &plan.strict},
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
    checked c = {0}, after = {0};
    bool helped;
    const char *input;
    SL_TRY(options_parse(console, &usage, argc, argv, &input, &helped));
    if (helped) return SL_OK;
    SL_TRY(pipeline_plan(console->context, input, &plan.pipeline));
    if (plan.gap_given) sl_number_write(plan.faults.gap, plan.gap_text);
    const sl_status status = check(console, &plan, &c, &after);
    destroy(console->context, &c);
    destroy(console->context, &after);
    return status;
}

#include "faults_report.h"

#include "json_print.h"
#include "sightline/support.h"

#include <string.h>

/// "(1,2.5)"
static void print_point(const char *before, sl_point point) {
    printf("%s(%.6g,%.6g)", before, point.x, point.y);
}

/// "lines 3 and 7", where the walls' lines are known.
static void print_lines(const sl_map *map, const sl_fault *fault) {
    const uint32_t a = map->walls[fault->walls[0]].line, b = map->walls[fault->walls[1]].line;
    if (a && b) printf(", lines %u and %u", (unsigned)a, (unsigned)b);
}

static void print_leak(const sl_faults_report *report, const sl_fault *fault) {
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

static void print_fault(const sl_faults_report *report, const sl_fault *fault) {
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

static void print_kind(const sl_faults_report *report, sl_fault_kind kind) {
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

sl_status sl_faults_print(const sl_faults_report *report) {
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

static sl_json_fields fault_fields(const sl_faults_report *report, const sl_fault *fault) {
    sl_json_fields fields = sl_json_begin();
    const sl_point at[2] = {fault->at.a, fault->at.b};
    sl_json_add_text(&fields, "kind", sl_fault_name(fault->kind));
    sl_json_add_real(&fields, "size", fault->size);
    sl_json_add_points(&fields, "at", at, 2);
    if (fault->walls[0] != UINT32_MAX) {
        sl_json_add_count(&fields, "wall", fault->walls[0]);
        sl_json_add_count(&fields, "line", report->map->walls[fault->walls[0]].line);
        sl_json_add_count(&fields, "other_wall", fault->walls[1]);
        sl_json_add_count(&fields, "other_line", report->map->walls[fault->walls[1]].line);
    }
    if (fault->walls[0] == UINT32_MAX) sl_json_add_count(&fields, "cell", fault->cell);
    if (fault->cells) sl_json_add_count(&fields, "cells", fault->cells);
    if (fault->point_count)
        sl_json_add_points(&fields, "way", report->faults->points + fault->first_point,
                           fault->point_count);
    return fields;
}

static void add_counts(sl_json_fields *fields, const char *key,
                       const uint32_t counts[SL_FAULT_KINDS]) {
    sl_json_fields inner = sl_json_begin();
    for (int kind = 0; kind < SL_FAULT_KINDS; kind++)
        sl_json_add_count(&inner, sl_fault_name((sl_fault_kind)kind), counts[kind]);
    sl_json_add_fields(fields, key, &inner);
}

sl_status sl_faults_print_json(sl_context *context, const sl_faults_report *report) {
    const uint32_t count = report->faults->count;
    sl_json_fields fields = sl_json_begin();
    sl_json_fields *items = sl_alloc_array(context, count, sizeof *items);
    if (!items) return SL_NO_MEMORY;
    sl_json_add_text(&fields, "file", report->input);
    sl_json_add_count(&fields, "walls", report->map->wall_count);
    sl_json_add_count(&fields, "cells", report->space->cell_count);
    sl_json_add_real(&fields, "gap", report->gap);
    sl_json_add_real(&fields, "thin", report->thin);
    sl_json_add_flag(&fields, "has_starts", report->faults->has_starts);
    add_counts(&fields, "counts", report->faults->counts);
    for (uint32_t i = 0; i < count; i++) items[i] = fault_fields(report, &report->faults->items[i]);
    sl_json_add_list(&fields, "faults", items, count);
    if (report->mended) {
        sl_json_fields mended = sl_json_begin();
        sl_json_add_text(&mended, "file", report->mended);
        sl_json_add_count(&mended, "moved", report->snap.moved);
        sl_json_add_real(&mended, "farthest", report->snap.farthest);
        sl_json_add_count(&mended, "vanished", report->snap.vanished);
        add_counts(&mended, "counts", report->left);
        sl_json_add_fields(&fields, "mended", &mended);
    }
    sl_free(context, items);
    return sl_json_print(context, &fields);
}

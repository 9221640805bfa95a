/// Prints each fault, and works out the command that mends the map.
#include "reports/faults_report.h"

#include "sightline/support.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

/// From such a share of the area inside on, in rooms that no opening joins to the largest one, a
/// start would leave too much out.
static const double MOST_SEALED = 0.25;

/// The digits that tell two points of a map apart, to about a hundredth of their distance.
static int digits_for(const sl_map *map, sl_segment at) {
    const double most = fmax(fmax(fabs(at.a.x), fabs(at.a.y)), fmax(fabs(at.b.x), fabs(at.b.y)));
    const double apart = hypot(at.b.x - at.a.x, at.b.y - at.a.y);
    const int least = sl_map_digits(map);
    if (!(most > 0)) return least;
    if (!(apart > 0)) return at.a.x == at.b.x && at.a.y == at.b.y ? least : 17;
    return (int)fmin(fmax(ceil(log10(most / apart)) + 3, least), 17);
}

/// "map.map: 16 walls (6 do not stop all), 12 cells"
static void print_size(const char *name, const checked *c) {
    const size_t partial = sl_map_partial_walls(&c->map);
    const size_t walls = c->map.wall_count + partial;
    const unsigned cells = c->baked.space.cell_count;
    printf("%s: %zu wall%s", name, walls, walls == 1 ? "" : "s");
    if (partial) printf(" (%zu do%s not stop all)", partial, partial == 1 ? "es" : "");
    printf(", %u cell%s", cells, cells == 1 ? "" : "s");
}

static void add_size(json_fields *fields, const checked *c) {
    const size_t partial = sl_map_partial_walls(&c->map);
    json_add_count(fields, "walls", c->map.wall_count + partial);
    json_add_count(fields, "partial_walls", partial);
    json_add_count(fields, "cells", c->baked.space.cell_count);
}

/// "(1,2.5)"
static void print_point(const char *before, sl_point point, int digits) {
    printf("%s(%.*g,%.*g)", before, digits, point.x, digits, point.y);
}

/// "from (1,2) to (3,4)"
static void print_ends(const sl_map *map, sl_segment at) {
    const int digits = digits_for(map, at);
    print_point("from ", at.a, digits);
    print_point(" to ", at.b, digits);
}

/// The map that the walls of faults are of.
static const sl_map *map_of_walls(const checked *found) {
    return sl_map_partial_walls(&found->map) ? &found->counted : &found->map;
}

/// "lines 3 and 7", or "line 12 (layer WALLS) and line 30 (layer WALLS)", where walls have lines.
static void print_lines(const sl_map *map, const sl_fault *fault) {
    uint32_t lines[2] = {0, 0};
    char text[2][SL_LINE_TEXT];
    size_t count = 0;
    for (int i = 0; i < 2; i++) {
        if (fault->walls[i] == UINT32_MAX) continue;
        const uint32_t line = map->walls[fault->walls[i]].line;
        if (line && !(count && line == lines[0])) lines[count++] = line;
    }
    for (size_t i = 0; i < count; i++) sl_map_say_line(map, lines[i], text[i]);
    const bool plain = !map->source.label_count && !map->source.lines_are_items;
    if (count == 2 && plain)
        printf(", lines %u and %u", (unsigned)lines[0], (unsigned)lines[1]);
    else if (count)
        printf(", %s%s%s", text[0], count == 2 ? " and " : "", count == 2 ? text[1] : "");
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
    print_ends(&found->map, fault->at);
    print_lines(map_of_walls(found), fault);
    print_point("; the way to it begins at ", way[0], sl_map_digits(&found->map));
    // A wider one is no matter of snapping.
    if (fault->stays && fault->size <= found->gap) printf("; needs a decision");
    putchar('\n');
}

static void print_fault(const checked *found, const sl_fault *fault) {
    switch (fault->kind) {
    case SL_FAULT_LEAK:
        print_leak(found, fault);
        return;
    case SL_FAULT_GAP:
        print_width(fault->size);
        print_ends(&found->map, fault->at);
        print_lines(map_of_walls(found), fault);
        if (fault->stays) printf("; needs a decision");
        break;
    case SL_FAULT_OVERLAP:
        printf("    %.6g long, ", fault->size);
        print_ends(&found->map, fault->at);
        print_lines(map_of_walls(found), fault);
        break;
    case SL_FAULT_CROSSING:
        print_point("    at ", fault->at.a, sl_map_digits(&found->map));
        print_lines(map_of_walls(found), fault);
        break;
    case SL_FAULT_THIN:
        printf("    cell %u, %.6g wide", (unsigned)fault->cell, fault->size);
        print_point(" at ", fault->at.a, digits_for(&found->map, fault->at));
        break;
    default:
        printf("    %u cell%s, area %.6g", (unsigned)fault->cells, fault->cells == 1 ? "" : "s",
               fault->size);
        print_point(", about ", fault->at.a, sl_map_digits(&found->map));
    }
    putchar('\n');
}

/// What kinds of faults are called.
static const struct {
    const char *one, *several, *what;
} kinds[SL_FAULT_KINDS] = {
    {"leak", "leaks", "openings through which a start leads out of the map"},
    {"gap", "gaps", "places where a wall ends near another one"},
    {"overlap", "overlaps", "pieces that two walls share; bake joins them"},
    {"crossing", "crossings", "places where two walls cross; no mistake if they are meant to"},
    {"thin cell", "thin cells", "cells thinner than --thin"},
    {"unreachable room", "unreachable rooms", "rooms that no start leads to"}};

/// "3 gaps"
static void print_count(const char *before, sl_fault_kind kind, uint32_t count) {
    printf("%s%u %s", before, (unsigned)count, count == 1 ? kinds[kind].one : kinds[kind].several);
}

static void print_kind(const checked *found, sl_fault_kind kind, uint64_t most) {
    const sl_faults *faults = &found->faults;
    const uint32_t count = faults->counts[kind];
    if (!count) return;
    print_count("  ", kind, count);
    printf(" (%s):\n", kinds[kind].what);
    uint64_t printed = 0;
    for (uint32_t i = 0; i < faults->count && printed < most; i++) {
        if (faults->items[i].kind != kind) continue;
        print_fault(found, &faults->items[i]);
        printed++;
    }
    if (printed < count)
        printf("    ... and %u more (--most N, --json)\n", (unsigned)(count - printed));
}

/// What lies far away, and what to do about it.
static void print_strays(const faults_report *report) {
    const sl_map *map = &report->found->map;
    const sl_strays *strays = &report->found->strays;
    const sl_box *rest = &strays->rest;
    if (!strays->count) return;
    printf("  %u stray%s (far away from the rest of the map, which is %.4g by %.4g):\n",
           (unsigned)strays->count, strays->count == 1 ? "" : "s", rest->max.x - rest->min.x,
           rest->max.y - rest->min.y);
    for (uint32_t i = 0; i < strays->count && i < report->most; i++) {
        const sl_stray *stray = &strays->items[i];
        char line[SL_LINE_TEXT];
        sl_map_say_line(map, stray->line, line);
        printf("    %s%s", line, *line ? ", " : "");
        print_point("at ", stray->at, 12); // as in the file, to look for it
        printf(", %.4g away\n", stray->distance);
    }
    if (strays->count > report->most)
        printf("    ... and %u more (--most N, --json)\n",
               (unsigned)(strays->count - report->most));
    printf("  correct or remove %s in %s, then check again: until then pictures show the rest as a "
           "dot\n",
           strays->count == 1 ? "it" : "them", sl_path_name(report->input));
}

/// The faults of a kind that snapping closes.
static uint32_t closable(const sl_faults *faults, sl_fault_kind kind) {
    uint32_t count = 0;
    for (uint32_t i = 0; i < faults->count; i++)
        count += faults->items[i].kind == kind && !faults->items[i].stays;
    return count;
}

/// The leaks that are no wider than what the map or --entrance says of entrances.
static uint32_t leaking_entrances(const checked *found) {
    uint32_t count = 0;
    for (uint32_t i = 0; i < found->faults.count; i++) {
        const sl_fault *fault = &found->faults.items[i];
        count += fault->kind == SL_FAULT_LEAK && fault->size <= found->map.entrance;
    }
    return count;
}

static void print_entrances(const checked *found) {
    const uint32_t count = leaking_entrances(found);
    if (!count) return;
    const char *many = found->faults.counts[SL_FAULT_LEAK] == 1 ? "the leak is an entrance"
                       : count == 1                             ? "one leak is an entrance"
                                                                : "leaks are entrances";
    if (count == 1)
        printf("  %s", many);
    else
        printf("  %u %s", (unsigned)count, many);
    printf(" up to %.4g wide, but starts go before entrances: without a start, inside ends there\n",
           found->map.entrance);
}

static void print_mended(const faults_report *report) {
    const sl_faults *left = &report->left->faults;
    const size_t moved = report->snap.moved, vanished = report->snap.vanished;
    printf("%s: %zu wall end%s moved", report->mended, moved, moved == 1 ? "" : "s");
    if (moved) printf(", by %.6g at most", report->snap.farthest);
    if (vanished) printf("; %zu piece%s of walls vanished", vanished, vanished == 1 ? "" : "s");
    const char *before = "; left: ";
    for (int kind = 0; kind < SL_FAULT_KINDS; kind++) {
        if (!left->counts[kind]) continue;
        print_count(before, (sl_fault_kind)kind, left->counts[kind]);
        before = ", ";
    }
    putchar('\n');
    if (report->snap.ground_dropped)
        puts("  the marks of solid ground are left out, as walls have moved: starts say what is "
             "inside");
    if (left->counts[SL_FAULT_LEAK] || left->counts[SL_FAULT_GAP])
        printf("  what is left needs a decision (by %s of %s):\n",
               report->left->map.source.lines_are_items ? "the names" : "lines",
               sl_path_name(report->input));
    print_kind(report->left, SL_FAULT_LEAK, report->most);
    print_kind(report->left, SL_FAULT_GAP, report->most);
}

/// "the gap", "all 3 gaps", "2 of 3 gaps"
static void print_share(const char *before, uint32_t count, uint32_t all, const char *what) {
    const char *several = all == 1 ? "" : "s";
    if (count == all && all == 1)
        printf("%sthe %s", before, what);
    else if (count == all)
        printf("%sall %u %s%s", before, (unsigned)all, what, several);
    else
        printf("%s%u of %u %s%s", before, (unsigned)count, (unsigned)all, what, several);
}

/// Whether a gap that would close a leak may be a door, by what is known of entrances.
static bool is_as_door(const faults_report *report) {
    const double entrance = report->found->map.entrance;
    return entrance > 0 && 2 * report->helps >= entrance;
}

static void print_snap_advice(const faults_report *report) {
    const sl_faults *faults = &report->found->faults;
    const uint32_t gaps = faults->counts[SL_FAULT_GAP], leaks = faults->counts[SL_FAULT_LEAK];
    const uint32_t gaps_closed = closable(faults, SL_FAULT_GAP);
    const uint32_t leaks_closed = closable(faults, SL_FAULT_LEAK);
    if (gaps_closed || leaks_closed) {
        printf("  --snap FIXED.map closes ");
        if (gaps_closed) print_share("", gaps_closed, gaps, "gap");
        if (leaks_closed) print_share(gaps_closed ? " and " : "", leaks_closed, leaks, "leak");
        if (gaps_closed < gaps)
            printf("; %u gap%s a decision", (unsigned)(gaps - gaps_closed),
                   gaps - gaps_closed == 1 ? " needs" : "s need");
        if (faults->leaks_left)
            printf("; then %u leak%s left", (unsigned)faults->leaks_left,
                   faults->leaks_left == 1 ? " is" : "s are");
        putchar('\n');
    } else if (gaps) {
        puts("  --snap does not close these gaps: each needs a decision");
    }
    if (report->helps > 0)
        printf(
            "  --gap %.12g is wide enough for --snap to close a leak; a door may be as wide: %s\n",
            report->helps,
            is_as_door(report) ? "entrances are not much wider" : "see that it is none");
    if (report->weld > 0)
        printf("  --weld %.2g joins the ends that miss each other by rounding, in all commands\n",
               report->weld);
}

// --- the next command

static void print_word(const char *before, const char *word) {
    const size_t size = pipeline_shell_word(word, NULL, 0) + 1;
    char *text = malloc(size);
    if (text) pipeline_shell_word(word, text, size);
    printf("%s%s", before, text ? text : word);
    free(text);
}

/// A file's name; one that looks like an option is led by its folder.
static void print_file(const char *before, const char *name) {
    fputs(before, stdout);
    print_word(name[0] == '-' && name[1] ? "./" : "", name);
}

static bool is_among(const char *name, const char *const *names) {
    for (; *names; names++)
        if (strcmp(*names, name) == 0) return true;
    return false;
}

/// What a next command is for.
typedef enum next_use {
    NEXT_CHECK,
    NEXT_BAKE,
    NEXT_BAKE_STARTLESS, ///< without the starts of options
    NEXT_CHECK_MENDED,
    NEXT_BAKE_MENDED
} next_use;

/// Repeats an option unless it is for this run alone, or for reading a file that the next command
/// does not read.
static bool is_repeated(const struct option_given *option, next_use use) {
    static const char *const own[] = {"gap",    "snap", "output", "width", "dark", "most",
                                      "strict", "json", "quiet",  "help",  NULL};
    static const char *const for_check[] = {"thin", NULL};
    static const char *const reading[] = {"map",         "slice",   "layers", "tolerance", "unit",
                                          "threshold",   "sectors", "doors",  "entrance",  "start",
                                          "start-names", "without", NULL};
    static const char *const starts[] = {"start", "start-names", NULL};
    const bool mended = use == NEXT_CHECK_MENDED || use == NEXT_BAKE_MENDED;
    if (is_among(option->name, own)) return false;
    if (use == NEXT_BAKE_STARTLESS && is_among(option->name, starts)) return false;
    if (is_among(option->name, for_check)) return use == NEXT_CHECK || use == NEXT_CHECK_MENDED;
    if (!mended) return true;
    const bool given = strcmp(option->name, "subdivide") == 0 && *option->argument == 'g';
    return !given && !is_among(option->name, reading);
}

/// "next: sightline check MAP", with the options that count, and the width of gaps.
static void print_command(const faults_report *report, next_use use, double gap) {
    const bool bakes = use != NEXT_CHECK && use != NEXT_CHECK_MENDED;
    const bool mended = use == NEXT_CHECK_MENDED || use == NEXT_BAKE_MENDED;
    print_file(bakes ? "next: sightline bake " : "next: sightline check ",
               mended ? report->mended : report->input);
    for (size_t i = 0; i < report->given->count; i++) {
        const struct option_given *option = &report->given->items[i];
        if (strcmp(option->name, "gap") == 0 && !bakes && !(gap > 0)) {
            print_word(" --gap ", option->argument);
        } else if (is_repeated(option, use)) {
            printf(" --%s", option->name);
            if (option->argument) print_word(" ", option->argument);
        }
    }
    if (gap > 0) printf(" --gap %.12g", gap);
}

/// " --snap office-fixed.map"
static void print_name(const faults_report *report, const char *option, const char *end) {
    size_t length;
    char name[256];
    const char *base = input_base_name(report->input, &length);
    const bool fits = length < sizeof name / 2 && strcmp(report->input, "-") != 0;
    snprintf(name, sizeof name, "%.*s%s", fits ? (int)length : 3, fits ? base : "map", end);
    print_file(option, name);
}

/// Checks again, with a start.
static sl_status print_next_start(sl_context *context, const faults_report *report, next_use use,
                                  const checked *found) {
    sl_point start;
    SL_TRY(pipeline_likely_start(context, &found->baked.map, &found->baked.space, &start));
    const int digits = sl_map_digits(&found->map);
    puts("  the next command has a start in the roomiest place: put another place there if that is "
         "outside");
    print_command(report, use, 0);
    printf(" --start %.*g,%.*g", digits, start.x, digits, start.y);
    return SL_OK;
}

/// Checks again, with what decides the opening in doubt.
static sl_status print_next_opening(sl_context *context, const faults_report *report, next_use use,
                                    const checked *found) {
    if (report->opening.start) return print_next_start(context, report, use, found);
    if (report->inside > 0)
        printf("  with the entrance of the next command, %.3g %% of the area is inside\n",
               100 * report->inside);
    print_command(report, use, 0);
    printf(" --entrance %.4g", report->opening.entrance);
    return SL_OK;
}

/// Whether inside ends at entrances, beyond doubt. No start is needed then: it would go before the
/// entrances, and leak through them.
static bool has_entrances(const checked *found) {
    return found->inside == SL_INSIDE_SURE && found->baked.map.interior.entrances;
}

static bool needs_start(const checked *found) {
    return !found->faults.has_starts && found->inside != SL_INSIDE_NONE && !has_entrances(found);
}

/// What a start as the next step would do.
typedef struct start_advice {
    bool helps;
    uint32_t apart; ///< rooms that no opening joins, so that it would lead to a part of them alone;
                    ///< 0 for no such doubt
} start_advice;

/// In a drawing whose rooms have no openings, all of them are inside without a start.
static sl_status find_start_helps(sl_context *context, const faults_report *report,
                                  const checked *found, start_advice *out) {
    sl_sealed rooms;
    *out = (start_advice){.helps = needs_start(found)};
    if (!out->helps || found->inside != SL_INSIDE_SURE || !input_is_drawing(context, report->input))
        return SL_OK;
    SL_TRY(sl_find_sealed(context, &found->baked.map, &found->baked.space, &rooms));
    if (rooms.share > MOST_SEALED) *out = (start_advice){.apart = rooms.rooms};
    return SL_OK;
}

static void print_apart(const start_advice *advice) {
    if (advice->apart)
        printf("  a start would reach a part of the %u rooms, as no opening joins them: the next "
               "command has none\n",
               (unsigned)advice->apart);
}

/// Whether inside hangs on an opening that is too wide for snapping.
static bool needs_entrance(const faults_report *report, const checked *found) {
    return found->inside == SL_INSIDE_OPENING &&
           found->baked.map.interior.doubtful_width > report->found->gap;
}

static sl_status print_next_of_mended(sl_context *context, const faults_report *report) {
    const uint32_t *counts = report->left->faults.counts;
    const bool left = counts[SL_FAULT_LEAK] || counts[SL_FAULT_GAP];
    bool gap_given = false;
    start_advice start = {0};
    if (needs_entrance(report, report->left) ||
        (!left && report->left->inside == SL_INSIDE_OPENING)) {
        return print_next_opening(context, report, NEXT_CHECK_MENDED, report->left);
    }
    if (!left) SL_TRY(find_start_helps(context, report, report->left, &start));
    print_apart(&start);
    if (start.helps) return print_next_start(context, report, NEXT_CHECK_MENDED, report->left);
    for (size_t i = 0; i < report->given->count; i++)
        gap_given |= strcmp(report->given->items[i].name, "gap") == 0;
    print_command(report, left ? NEXT_CHECK_MENDED : NEXT_BAKE_MENDED, 0);
    if (left && !gap_given) printf(" --gap %.6g", report->found->gap);
    if (left) print_name(report, " -o ", "-fixed.png");
    return SL_OK;
}

/// Whether all leaks are entrances, and only options say where starts are.
static bool has_startless(const faults_report *report) {
    const uint32_t leaks = report->found->faults.counts[SL_FAULT_LEAK];
    size_t given = 0;
    for (size_t i = 0; i < report->given->count; i++)
        given += strcmp(report->given->items[i].name, "start") == 0;
    return leaks && leaks == leaking_entrances(report->found) &&
           given == report->found->map.start_count;
}

/// The next command of a map that needs no other decision.
static void print_next_plain(const faults_report *report, bool grave) {
    if (has_startless(report)) {
        print_command(report, NEXT_BAKE_STARTLESS, 0);
    } else if (report->found->strays.count) {
        print_command(report, NEXT_CHECK, 0);
    } else if (grave && !report->picture) {
        print_command(report, NEXT_CHECK, 0);
        print_name(report, " -o ", "-check.png");
    } else if (name_ends_with(report->input, ".slv")) {
        print_file("next: sightline info ", report->input);
    } else {
        if (grave) puts("  the next command takes these walls as they are: mend them before it");
        print_command(report, NEXT_BAKE, 0);
    }
}

static sl_status print_next(sl_context *context, const faults_report *report) {
    const sl_faults *faults = &report->found->faults;
    const bool grave = faults->counts[SL_FAULT_LEAK] || faults->counts[SL_FAULT_GAP];
    const bool helps = report->helps > 0 && !is_as_door(report);
    const bool closes = helps || closable(faults, SL_FAULT_GAP) || closable(faults, SL_FAULT_LEAK);
    start_advice start;
    if (report->mended) {
        SL_TRY(print_next_of_mended(context, report));
    } else if (report->found->map.source.plans) {
        print_command(report, NEXT_CHECK, 0);
        printf(" --map 'plan 1'");
    } else if (needs_entrance(report, report->found) ||
               (!closes && report->found->inside == SL_INSIDE_OPENING)) {
        SL_TRY(print_next_opening(context, report, NEXT_CHECK, report->found));
    } else if (closes) {
        print_command(report, NEXT_CHECK, helps ? report->helps : 0);
        print_name(report, " --snap ", "-fixed.map");
    } else {
        SL_TRY(find_start_helps(context, report, report->found, &start));
        print_apart(&start);
        if (start.helps)
            SL_TRY(print_next_start(context, report, NEXT_CHECK, report->found));
        else
            print_next_plain(report, grave);
    }
    putchar('\n');
    return SL_OK;
}

/// What sets the tolerance.
static const char *how_welded(const faults_report *report) {
    for (size_t i = 0; i < report->given->count; i++)
        if (strcmp(report->given->items[i].name, "weld") == 0) return "--weld";
    return report->found->map.precision > 0 ? "the digits of the file; --weld 0 closes none"
                                            : "the map's own tolerance";
}

/// What is inside, where that is not plain.
static void print_inside(const checked *found) {
    const sl_interior *interior = &found->baked.map.interior;
    const char *name = found->map.unit, *space = *name ? " " : "";
    const int digits = sl_map_digits(&found->map);
    if (interior->entrances)
        printf("  inside ends at %zu opening%s up to %.4g%s%s wide (--entrance)\n",
               interior->entrances, interior->entrances == 1 ? "" : "s", interior->width, space,
               name);
    if (found->inside == SL_INSIDE_OPENING)
        printf("  inside is doubtful: an opening %.4g%s%s wide, at %.*g,%.*g, is wider than "
               "entrances (%.4g%s%s)\n",
               interior->doubtful_width, space, name, digits, interior->doubtful.a.x, digits,
               interior->doubtful.a.y, interior->width, space, name);
    else if (found->inside == SL_INSIDE_SMALL)
        puts("  inside is doubtful: walls enclose less than half of the area among them, and the "
             "map "
             "has no start");
    else if (found->inside == SL_INSIDE_FEW)
        puts("  inside is doubtful: most of the area is in rooms that no start leads to");
    else if (found->inside == SL_INSIDE_NONE)
        puts("  nothing is inside: all is solid ground");
    else if (!found->faults.count && !found->strays.count)
        puts("  nothing found");
}

sl_status faults_print(sl_context *context, const faults_report *report) {
    const checked *found = report->found;
    const sl_faults *faults = &found->faults;
    print_size(report->input, found);
    printf("; looked for gaps up to %.4g and cells thinner than %.4g\n", found->gap, report->thin);
    for (int kind = 0; kind < SL_FAULT_KINDS; kind++)
        print_kind(found, (sl_fault_kind)kind, report->most);
    print_entrances(found);
    print_strays(report);
    if (faults->welded)
        printf("  %u gap%s up to %.3g wide %s closed on import (by %s); no fault\n",
               (unsigned)faults->welded, faults->welded == 1 ? "" : "s", faults->weld,
               faults->welded == 1 ? "is" : "are", how_welded(report));
    print_inside(found);
    if (needs_start(found))
        puts("  leaks and unreachable rooms are found only from a start: give --start X,Y");
    if (report->mended)
        print_mended(report);
    else
        print_snap_advice(report);
    return print_next(context, report);
}

// --- JSON

static void add_fault(json_fields *fields, const checked *found, const sl_fault *fault) {
    const sl_map *map = map_of_walls(found);
    json_open_item(fields);
    const sl_point at[2] = {fault->at.a, fault->at.b};
    json_add_text(fields, "kind", sl_fault_name(fault->kind));
    json_add_real(fields, "size", fault->size);
    json_add_points(fields, "at", at, 2);
    static const char *const walls[] = {"wall", "other_wall"};
    static const char *const lines[] = {"line", "other_line"}, *const items[] = {"item",
                                                                                 "other_item"};
    static const char *const labels[] = {"label", "other_label"};
    for (int i = 0; i < 2; i++) {
        if (fault->walls[i] == UINT32_MAX) continue;
        const uint32_t line = map->walls[fault->walls[i]].line;
        const char *label = sl_map_label(map, line);
        json_add_count(fields, walls[i], fault->walls[i]);
        json_add_count(fields, (map->source.lines_are_items ? items : lines)[i], line);
        if (label) json_add_text(fields, labels[i], label);
    }
    if (fault->cell != SL_NO_CELL) json_add_count(fields, "cell", fault->cell);
    if (fault->kind == SL_FAULT_GAP || fault->kind == SL_FAULT_LEAK)
        json_add_flag(fields, "needs_decision", fault->stays);
    if (fault->cells) json_add_count(fields, "cells", fault->cells);
    if (fault->point_count)
        json_add_points(fields, "way", found->faults.points + fault->first_point,
                        fault->point_count);
    json_close(fields);
}

static void add_counts(json_fields *fields, const char *key,
                       const uint32_t counts[SL_FAULT_KINDS]) {
    json_open(fields, key);
    for (int kind = 0; kind < SL_FAULT_KINDS; kind++)
        json_add_count(fields, sl_fault_name((sl_fault_kind)kind), counts[kind]);
    json_close(fields);
}

static const char *const inside_words[] = {"sure", "leaks", "doubtful", "few", "none", "opening"};

static void add_stray_list(json_fields *fields, const checked *found) {
    const uint32_t count = found->strays.count;
    json_open_list(fields, "strays");
    for (uint32_t i = 0; i < count; i++) {
        const sl_stray *stray = &found->strays.items[i];
        const char *label = sl_map_label(&found->map, stray->line);
        json_open_item(fields);
        json_add_points(fields, "at", &stray->at, 1);
        json_add_real(fields, "distance", stray->distance);
        if (stray->wall != UINT32_MAX) json_add_count(fields, "wall", stray->wall);
        json_add_count(fields, found->map.source.lines_are_items ? "item" : "line", stray->line);
        if (label) json_add_text(fields, "label", label);
        json_close(fields);
    }
    json_close_list(fields);
}

sl_status faults_print_json(sl_context *context, const faults_report *report) {
    const checked *found = report->found;
    const uint32_t count = found->faults.count;
    json_fields fields = json_begin();
    json_add_text(&fields, "file", report->input);
    add_size(&fields, found);
    json_add_real(&fields, "gap", found->gap);
    json_add_real(&fields, "thin", report->thin);
    json_add_flag(&fields, "has_starts", found->faults.has_starts);
    json_add_text(&fields, "inside", inside_words[found->inside]);
    if (report->helps > 0) json_add_real(&fields, "gap_that_helps", report->helps);
    if (report->weld > 0) json_add_real(&fields, "suggested_weld", report->weld);
    json_add_count(&fields, "closed_on_import", found->faults.welded);
    json_add_real(&fields, "weld", found->faults.weld);
    add_counts(&fields, "counts", found->faults.counts);
    json_open_list(&fields, "faults");
    for (uint32_t i = 0; i < count; i++) add_fault(&fields, found, &found->faults.items[i]);
    json_close_list(&fields);
    add_stray_list(&fields, found);
    if (report->mended) {
        json_open(&fields, "mended");
        json_add_text(&fields, "file", report->mended);
        json_add_count(&fields, "moved", report->snap.moved);
        json_add_real(&fields, "farthest", report->snap.farthest);
        json_add_count(&fields, "vanished", report->snap.vanished);
        json_add_flag(&fields, "ground_dropped", report->snap.ground_dropped);
        add_counts(&fields, "counts", report->left->faults.counts);
        json_close(&fields);
    }
    return json_print(context, &fields);
}

// --- one line a map

bool checked_has_fault(const checked *c) {
    return c->faults.count || c->strays.count || c->inside == SL_INSIDE_SMALL ||
           c->inside == SL_INSIDE_NONE || c->inside == SL_INSIDE_OPENING;
}

void faults_print_line(const char *name, const checked *c) {
    const char *before = "; ";
    print_size(name, c);
    for (int kind = 0; kind < SL_FAULT_KINDS; kind++) {
        if (!c->faults.counts[kind]) continue;
        print_count(before, (sl_fault_kind)kind, c->faults.counts[kind]);
        before = ", ";
    }
    if (c->strays.count)
        printf("%s%u stray%s", before, (unsigned)c->strays.count, c->strays.count == 1 ? "" : "s");
    if (c->inside == SL_INSIDE_NONE)
        printf("; nothing is inside");
    else if (c->inside == SL_INSIDE_SMALL || c->inside == SL_INSIDE_FEW ||
             c->inside == SL_INSIDE_OPENING)
        printf("; inside is doubtful");
    puts(checked_has_fault(c) || c->inside == SL_INSIDE_FEW ? "" : "; nothing found");
}

void faults_add_line(json_fields *fields, const char *name, const checked *c) {
    json_open_item(fields);
    json_add_text(fields, "map", name);
    add_size(fields, c);
    json_add_text(fields, "inside", inside_words[c->inside]);
    add_counts(fields, "counts", c->faults.counts);
    json_add_count(fields, "strays", c->strays.count);
    json_close(fields);
}

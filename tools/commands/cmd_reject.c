/// `sightline reject`: new REJECT lumps for all maps of a Doom WAD.
#include "arguments/options.h"
#include "arguments/outputs.h"
#include "commands/commands.h"
#include "reports/json_print.h"
#include "sightline/io.h"
#include "sightline/support.h"
#include "system/system.h"

#include <inttypes.h>
#include <string.h>

enum { MAX_THREADS = 4096 };

typedef struct reject_plan {
    const char *input, *output;
    option_list maps;
    sl_reject_options options;
    bool json;
} reject_plan;

static uint64_t pairs_of(uint64_t sectors) {
    return sectors ? sectors * (sectors - 1) / 2 : 0;
}

static double percent(uint64_t part, uint64_t whole) {
    return whole ? 100 * (double)part / (double)whole : 0;
}

static void print_map(const sl_reject_account *map) {
    printf("  %-8s  %4" PRIu32 " sector%s, %" PRIu64 " of %" PRIu64 " pairs hidden (%.1f %%)",
           map->map, map->sectors, map->sectors == 1 ? "" : "s", map->hidden,
           pairs_of(map->sectors), percent(map->hidden, pairs_of(map->sectors)));
    if (map->unknown)
        printf("; %" PRIu32 " %s no cell; nothing is hidden from %s", map->unknown,
               map->unknown == 1 ? "sector contains" : "sectors contain",
               map->unknown == 1 ? "it" : "them");
    putchar('\n');
}

static void print_report(const reject_plan *plan, const sl_reject_report *report, double seconds) {
    char size[SIZE_TEXT];
    uint64_t hidden = 0, pairs = 0;
    for (size_t i = 0; i < report->count; i++) {
        hidden += report->maps[i].hidden;
        pairs += pairs_of(report->maps[i].sectors);
    }
    size_write(system_file_size(plan->output), size);
    printf("%s: %s, with a new REJECT for %zu map%s, in %.2f s\n", plan->output, size,
           report->count, report->count == 1 ? "" : "s", seconds);
    for (size_t i = 0; i < report->count; i++) print_map(&report->maps[i]);
    if (report->count > 1)
        printf("  all       %" PRIu64 " of %" PRIu64 " pairs hidden (%.1f %%)\n", hidden, pairs,
               percent(hidden, pairs));
}

static sl_status print_json(sl_context *context, const reject_plan *plan,
                            const sl_reject_report *report, double seconds) {
    json_fields fields = json_begin();
    json_add_text(&fields, "input", plan->input);
    json_add_text(&fields, "output", plan->output);
    json_open_list(&fields, "maps");
    for (size_t i = 0; i < report->count; i++) {
        const sl_reject_account *map = &report->maps[i];
        json_open_item(&fields);
        json_add_text(&fields, "name", map->map);
        json_add_count(&fields, "sectors", map->sectors);
        json_add_count(&fields, "cells", map->cells);
        json_add_count(&fields, "pairs", pairs_of(map->sectors));
        json_add_count(&fields, "hidden", map->hidden);
        json_add_count(&fields, "unknown", map->unknown);
        json_close(&fields);
    }
    json_close_list(&fields);
    json_add_real(&fields, "seconds", seconds);
    return json_print(context, &fields);
}

static sl_status run(command_console *console, reject_plan *plan) {
    sl_context *context = console->context;
    if (!plan->output)
        return sl_fail(context, SL_BAD_ARGUMENT,
                       "-o OUT.wad is needed: where to write the copy with its REJECTs");
    if (plan->json && strcmp(plan->output, "-") == 0)
        return sl_fail(context, SL_BAD_ARGUMENT, "--json and -o - both write to stdout");
    plan->options.maps = plan->maps.items;
    plan->options.map_count = plan->maps.count;
    const double began = sl_seconds();
    sl_reject_report report = {0};
    SL_TRY(sl_reject_wad(context, plan->input, &plan->options, plan->output, &report));
    const double seconds = sl_seconds() - began;
    progress_line_clear(&console->line);
    sl_status status = SL_OK;
    if (plan->json)
        status = print_json(context, plan, &report, seconds);
    else if (!console->quiet && strcmp(plan->output, "-") != 0)
        print_report(plan, &report, seconds);
    sl_reject_report_destroy(context, &report);
    return status;
}

sl_status cmd_reject(command_console *console, int argc, char **argv) {
    reject_plan plan = {.options = sl_reject_options_default()};
    plan.options.row_bytes = sl_machine_memory() / 2;
    const option_spec options[] = {
        {"output", 'o', "OUT.wad", "the copy; '-': standard output", .text = &plan.output,
         .check = CHECK_FILE, .endings = ".wad"},
        {"map", 0, "NAME", "only this map; may be given several times", .list = &plan.maps},
        {"sight", 0, "closed|open",
         "whether lines that only touch wall ends count: open (default): no; closed: yes",
         .sight = &plan.options.sight},
        {"threads", 0, "N", "number of threads (default: one per core)",
         .count32 = &plan.options.threads, .most = MAX_THREADS},
        {"memory", 0, "SIZE",
         "memory for the visible sets while they grow: 64M, 2G (default: half of the machine's)",
         .bytes = &plan.options.row_bytes},
        {"json", 0, NULL, "print the statistics as one JSON object", .flag = &plan.json},
    };
    const command_usage usage = {
        .name = "reject",
        .synopsis = "IN.wad -o OUT.wad [--map NAME ...] [options]",
        .operands = {"IN.wad"},
        .what =
            "Computes the REJECT tables of all maps of a Doom WAD: which sectors never see each "
            "other. Writes a copy of the WAD. Doors count as open, and no pair is hidden that a "
            "free line joins. All other lumps stay as they are.",
        .examples = "  sightline reject mine.wad -o mine-reject.wad\n"
                    "  sightline reject doom2.wad -o out.wad --map MAP01 --map MAP07",
        .options = options,
        .option_count = sizeof options / sizeof *options,
    };
    bool helped;
    SL_TRY(options_parse(console, &usage, argc, argv, &plan.input, &helped));
    return helped ? SL_OK : run(console, &plan);
}

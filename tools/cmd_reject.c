#include "commands.h"
#include "inputs.h"
#include "json_print.h"
#include "options.h"
#include "sightline/reject.h"
#include "sightline/support.h"
#include "sizes.h"

#include <inttypes.h>
#include <string.h>

enum { MAX_THREADS = 4096 };

/// The options as they are given.
typedef struct reject_texts {
    const char *input, *output, *map, *sight, *threads, *memory;
    sl_option_list maps;
    bool json;
} reject_texts;

static sl_status plan(sl_context *context, const reject_texts *texts, sl_reject_options *options) {
    if (!texts->output)
        return sl_fail(context, SL_BAD_ARGUMENT,
                       "-o OUT.wad is needed: where to write the copy with its REJECTs");
    SL_TRY(sl_output_check(context, texts->input, "-o", texts->output));
    if (texts->json && strcmp(texts->output, "-") == 0)
        return sl_fail(context, SL_BAD_ARGUMENT, "--json and -o - both write to stdout");
    size_t sight = options->sight;
    uint64_t threads = 0;
    const sl_name_table sights = sl_sight_table();
    SL_TRY(sl_option_choice(context, "--sight", texts->sight, &sights, &sight));
    SL_TRY(sl_option_count(context, "--threads", texts->threads, MAX_THREADS, &threads));
    options->row_bytes = sl_machine_memory() / 2;
    SL_TRY(sl_option_size(context, "--memory", texts->memory, &options->row_bytes));
    options->sight = (sl_sight)sight;
    options->threads = (unsigned)threads;
    options->maps = texts->maps.items;
    options->map_count = texts->maps.count;
    return SL_OK;
}

static uint64_t pairs_of(uint64_t sectors) {
    return sectors ? sectors * (sectors - 1) / 2 : 0;
}

static double percent(uint64_t part, uint64_t whole) {
    return whole ? 100 * (double)part / (double)whole : 0;
}

static void print_map(const sl_reject_account *map) {
    printf("  %-8s  %4" PRIu32 " sectors, %" PRIu64 " of %" PRIu64 " pairs hidden (%.1f %%)",
           map->map, map->sectors, map->hidden, pairs_of(map->sectors),
           percent(map->hidden, pairs_of(map->sectors)));
    if (map->unknown)
        printf("; %" PRIu32 " sectors that no cell reaches into hide nothing", map->unknown);
    putchar('\n');
}

static void print_report(const reject_texts *texts, const sl_reject_report *report,
                         double seconds) {
    char size[SL_SIZE_TEXT];
    uint64_t hidden = 0, pairs = 0;
    for (size_t i = 0; i < report->count; i++) {
        hidden += report->maps[i].hidden;
        pairs += pairs_of(report->maps[i].sectors);
    }
    sl_size_write(sl_size_of_file(texts->output), size);
    printf("%s: %s, with a new REJECT for %zu map%s, in %.2f s\n", texts->output, size,
           report->count, report->count == 1 ? "" : "s", seconds);
    for (size_t i = 0; i < report->count; i++) print_map(&report->maps[i]);
    if (report->count > 1)
        printf("  all       %" PRIu64 " of %" PRIu64 " pairs hidden (%.1f %%)\n", hidden, pairs,
               percent(hidden, pairs));
}

static sl_status print_json(sl_context *context, const reject_texts *texts,
                            const sl_reject_report *report, double seconds) {
    sl_json_fields fields = sl_json_begin();
    sl_json_fields *maps = sl_alloc_array(context, report->count, sizeof *maps);
    if (!maps) {
        sl_json_drop(&fields);
        return SL_NO_MEMORY;
    }
    for (size_t i = 0; i < report->count; i++) {
        const sl_reject_account *map = &report->maps[i];
        maps[i] = sl_json_begin();
        sl_json_add_text(&maps[i], "name", map->map);
        sl_json_add_count(&maps[i], "sectors", map->sectors);
        sl_json_add_count(&maps[i], "cells", map->cells);
        sl_json_add_count(&maps[i], "pairs", pairs_of(map->sectors));
        sl_json_add_count(&maps[i], "hidden", map->hidden);
        sl_json_add_count(&maps[i], "unknown", map->unknown);
    }
    sl_json_add_text(&fields, "input", texts->input);
    sl_json_add_text(&fields, "output", texts->output);
    sl_json_add_list(&fields, "maps", maps, report->count);
    sl_json_add_real(&fields, "seconds", seconds);
    sl_free(context, maps);
    return sl_json_print(context, &fields);
}

static sl_status run(sl_console *console, const reject_texts *texts) {
    sl_context *context = console->context;
    sl_reject_options options = sl_reject_options_default();
    SL_TRY(plan(context, texts, &options));
    const double began = sl_now();
    sl_reject_report report = {0};
    SL_TRY(sl_reject_wad(context, texts->input, &options, texts->output, &report));
    const double seconds = sl_now() - began;
    sl_progress_line_clear(&console->line);
    sl_status status = SL_OK;
    if (texts->json)
        status = print_json(context, texts, &report, seconds);
    else if (!console->quiet && strcmp(texts->output, "-") != 0)
        print_report(texts, &report, seconds);
    sl_reject_report_destroy(context, &report);
    return status;
}

sl_status sl_cmd_reject(sl_console *console, int argc, char **argv) {
    reject_texts t = {0};
    const sl_option_spec options[] = {
        {"output", 'o', "OUT.wad", NULL, &t.output, "where to write the copy; - for stdout"},
        {"map", 0, "NAME", NULL, &t.map, "only this map; may be given several times"},
        {"sight", 0, "closed|open", NULL, &t.sight,
         "open (the default): lines that only touch wall ends\nhide; closed: they count as seen"},
        {"threads", 0, "N", NULL, &t.threads,
         "0, the default, for one a core;\nthe result is the same for any number"},
        {"memory", 0, "SIZE", NULL, &t.memory,
         "for the visible sets in the making at most, as 64M,\n2G; half of the machine's unless "
         "told"},
        {"json", 0, NULL, &t.json, NULL, "print the statistics as one JSON object"},
    };
    const sl_command_usage usage = {
        .name = "reject",
        .synopsis = "IN.wad -o OUT.wad [--map NAME ...] [options]",
        .operands = {"IN.wad"},
        .what =
            "Makes the REJECT of all maps of a Doom WAD anew, in one go, in a copy of the WAD:\n"
            "which sectors never see each other. Nothing is hidden that a line past all lines "
            "with\n"
            "one side joins, doors being open. All other lumps stay as they are. The copy is\n"
            "written when all maps are done; what fails or is stopped leaves an older OUT.wad as\n"
            "it was.",
        .examples = "  sightline reject mine.wad -o mine-reject.wad\n"
                    "  sightline reject doom2.wad -o out.wad --map MAP01 --map MAP07",
        .options = options,
        .option_count = sizeof options / sizeof *options,
        .repeats = "map",
        .repeated = &t.maps,
    };
    bool helped;
    SL_TRY(sl_option_parse(console, &usage, argc, argv, &t.input, &helped));
    return helped ? SL_OK : run(console, &t);
}

#include "bake_report.h"

#include "json_print.h"
#include "names.h"
#include "outputs.h"
#include "report.h"
#include "sightline/support.h"

#include <inttypes.h>

// --- JSON

static void add_seconds(sl_json_fields *fields, const bake_report *report) {
    sl_json_fields seconds = sl_json_begin();
    sl_json_add_real(&seconds, "read", report->seconds.read);
    sl_json_add_real(&seconds, "subdivide", report->account.seconds.subdivide);
    if (report->account.checked) sl_json_add_real(&seconds, "check", report->account.seconds.check);
    sl_json_add_real(&seconds, "cell_to_cell", report->seconds.see);
    sl_json_add_real(&seconds, "write", report->seconds.write);
    sl_json_add_fields(fields, "seconds", &seconds);
}

/// What was done of the work, where it was not all in one go.
static void add_parts(sl_json_fields *fields, const bake_report *report) {
    const bake_parts_account *parts = &report->parts;
    const sl_partial *partial = &report->baked->partial;
    sl_json_add_flag(fields, "finished", !sl_partial_begun(partial));
    if (!parts->units) return;
    sl_json_fields inner = sl_json_begin();
    sl_json_add_text(&inner, "units", parts->units);
    sl_json_add_count(&inner, "count", parts->unit_count);
    sl_json_add_count(&inner, "known_before", parts->known);
    sl_json_add_count(&inner, "done", parts->done);
    if (partial->shard_count) {
        sl_json_add_count(&inner, "shard", partial->shard);
        sl_json_add_count(&inner, "shards", partial->shard_count);
        sl_json_add_count(&inner, "left", sl_partial_left(partial));
    }
    sl_json_add_fields(fields, "work", &inner);
}

static void add_visibility(sl_json_fields *fields, const sl_visibility *visibility) {
    const sl_see_account *account = &visibility->account;
    const sl_stab_trees *trees = &visibility->trees;
    sl_json_add_count(fields, "pairs", account->pairs);
    sl_json_add_count(fields, "doubtful_pairs", account->doubtful_pairs);
    sl_json_add_count(fields, "tests", account->tests);
    sl_json_add_count(fields, "tree_nodes", account->nodes);
    sl_json_add_count(fields, "pieces", account->pieces);
    if (account->sectors) {
        sl_json_add_count(fields, "sectors", account->sectors);
        sl_json_add_count(fields, "candidates", account->candidates);
        sl_json_add_count(fields, "relations", account->relations);
        sl_json_add_count(fields, "cells_on_cycles", account->on_cycles);
    }
    sl_json_add_count(fields, "longest_sequence", account->deepest);
    sl_json_fields work = sl_json_begin();
    sl_json_add_count(&work, "door_steps", account->door_steps);
    sl_json_add_count(&work, "mirror_steps", account->mirror_steps);
    sl_json_add_count(&work, "glass_tests", account->glass_tests);
    sl_json_add_count(&work, "mirrored_pairs", account->mirrored_pairs);
    sl_json_add_count(&work, "rounded_places", account->rounded_places);
    sl_json_add_count(&work, "door_bytes", sl_door_sets_bytes(&visibility->doors));
    sl_json_add_count(&work, "door_fallbacks", account->door_fallbacks);
    sl_json_add_count(&work, "range_tests", account->range_tests);
    sl_json_add_count(&work, "close_calls", account->close_calls);
    sl_json_add_fields(fields, "effect_work", &work);
    if (!trees->cell_count) return;
    sl_json_add_count(fields, "tree_nodes_kept", trees->offsets[trees->cell_count]);
    sl_json_add_count(fields, "trees_left_out", trees->left_out);
}

sl_status bake_report_print_json(sl_context *context, const bake_report *report) {
    const sl_baked *baked = report->baked;
    const sl_space *space = &baked->space;
    const bool has_sets = !sl_baked_is_shard(baked);
    pvs_means mean;
    if (has_sets) SL_TRY(mean_pvs_of(context, baked, &mean));

    sl_json_fields fields = sl_json_begin();
    sl_json_add_text(&fields, "map", report->input);
    sl_json_add_text(&fields, "output", report->output);
    sl_json_add_text(&fields, "subdivide", report->account.subdivision->name);
    sl_json_add_text(&fields, "method", baked->method);
    sl_json_add_text(&fields, "solver", baked->solver[0] ? baked->solver : NULL);
    sl_json_add_text(&fields, "sight", sight_name(baked->visibility.sight));
    sl_json_add_text(&fields, "guarantee", sl_guarantee_name(baked->visibility.guarantee));
    plan_add_json(&fields, &baked->map);
    add_parts(&fields, report);
    add_seconds(&fields, report);
    sl_json_add_cleaning(&fields, "cleaning", &report->account.cleaning);
    sl_json_add_count(&fields, "walls", space->wall_count);
    sl_json_add_count(&fields, "welded", report->account.cleaning.welded);
    sl_json_add_count(&fields, "cells", space->cell_count);
    sl_json_add_count(&fields, "inside_cells", space->inside_count);
    sl_json_add_count(&fields, "portals", space->portal_count);
    sl_json_add_count(&fields, "tree_depth", space->tree_depth);
    if (has_sets) add_visibility(&fields, &baked->visibility);
    if (has_sets) mean_pvs_add_json(&fields, &mean);
    sl_json_add_count(&fields, "peak_memory_bytes", size_of_peak_memory());
    sl_json_add_count(&fields, "file_bytes", size_of_file(report->output));
    return sl_json_print(context, &fields);
}

// --- text

static void print_welding(const sl_clean_account *account) {
    const char *between = "";
    printf("  welded    ");
    if (account->welded) {
        printf("%zu end%s", account->welded, account->welded == 1 ? "" : "s");
        between = ", ";
    }
    if (account->crossings)
        printf("%s%zu crossing%s computed", between, account->crossings,
               account->crossings == 1 ? "" : "s");
    if (account->largest_move > 0)
        printf("; no wall moved by more than %.2g", account->largest_move);
    putchar('\n');
}

void cleaning_print(const sl_clean_account *account) {
    const struct {
        size_t count;
        const char *what;
    } done[] = {{account->zero_length, "of zero length"},
                {account->duplicate, "duplicate"},
                {account->merged, "merged"},
                {account->split, "split"}};
    bool any = false;
    for (size_t i = 0; i < sizeof done / sizeof *done; i++) {
        if (!done[i].count) continue;
        if (!any) printf(", from %zu read", account->before);
        printf("%s %zu %s", any ? "," : ":", done[i].count, done[i].what);
        any = true;
    }
    putchar('\n');
    if (account->welded || account->crossings) print_welding(account);
}

static void print_parts(const bake_report *report) {
    const bake_parts_account *parts = &report->parts;
    const sl_partial *partial = &report->baked->partial;
    char text[SL_PARTIAL_TEXT];
    if (!parts->units) return;
    printf("  %-9s %" PRIu32 ", %" PRIu32 " of them done, %" PRIu32 " known before\n", parts->units,
           parts->unit_count, parts->done, parts->known);
    if (partial->shard_count) {
        printf("  shard     %" PRIu32 " of %" PRIu32 ", %" PRIu32 " %s left\n", partial->shard,
               partial->shard_count, sl_partial_left(partial), parts->units);
        return;
    }
    sl_baked_say_partial(report->baked, text);
    if (text[0]) printf("  %s\n", text);
}

static void print_effect_work(const sl_visibility *visibility) {
    const sl_see_account *account = &visibility->account;
    const sl_door_sets *doors = &visibility->doors;
    if (visibility->mirrored.cell_count)
        printf("  mirrored  %" PRIu64 " pairs seen by mirror; %" PRIu64 " places rounded\n",
               account->mirrored_pairs, account->rounded_places);
    if (doors->cell_count)
        printf("  doors     %" PRIu64 " bytes of door sets, %.2f a pair; %" PRIu64
               " pairs with more than kept: they count as seen\n",
               sl_door_sets_bytes(doors),
               account->pairs ? (double)sl_door_sets_bytes(doors) / (double)account->pairs : 0,
               account->door_fallbacks);
    if (account->range_tests)
        printf("  in range  %" PRIu64 " sequences measured, %" PRIu64
               " within rounding of the range: they count as seen\n",
               account->range_tests, account->close_calls);
}

static void print_visibility(const sl_baked *baked) {
    const sl_visibility *visibility = &baked->visibility;
    const sl_see_account *account = &visibility->account;
    printf("  pairs     %" PRIu64 " seen, %s sight, by %s%s%s (%s)\n", account->pairs,
           sight_name(visibility->sight), baked->method, baked->solver[0] ? " with " : "",
           baked->solver, sl_guarantee_name(visibility->guarantee));
    if (account->doubtful_pairs)
        printf("  doubtful  %" PRIu64 " of them, of which rounding decided\n",
               account->doubtful_pairs);
    if (account->tests)
        printf("  work      %" PRIu64 " stabbing tests, %" PRIu64
               " tree nodes, longest sequence %" PRIu32 "\n",
               account->tests, account->nodes, account->deepest);
    else if (account->pieces)
        printf("  work      %" PRIu64 " pieces of cells, longest sequence %" PRIu32 "\n",
               account->pieces, account->deepest);
    print_effect_work(visibility);
    const sl_stab_trees *trees = &visibility->trees;
    if (trees->cell_count)
        printf("  trees     %" PRIu64 " nodes kept, %" PRIu32 " of %" PRIu32
               " trees left out by --tree-memory\n",
               trees->offsets[trees->cell_count], trees->left_out, trees->cell_count);
}

static void print_seconds(const bake_report *report) {
    printf("  seconds   read %.3f, subdivide %.3f", report->seconds.read,
           report->account.seconds.subdivide);
    if (report->account.checked) printf(", check %.3f", report->account.seconds.check);
    printf(", cell to cell %.3f, write %.3f\n", report->seconds.see, report->seconds.write);
}

sl_status bake_report_print(sl_context *context, const bake_report *report) {
    const sl_space *space = &report->baked->space;
    const bool has_sets = !sl_baked_is_shard(report->baked);
    pvs_means mean;
    if (has_sets) SL_TRY(mean_pvs_of(context, report->baked, &mean));
    char file[SIZE_TEXT], memory[SIZE_TEXT];
    size_write(size_of_file(report->output), file);
    size_write(size_of_peak_memory(), memory);
    printf("%s: %s, baked from %s\n", report->output, file, report->input);
    printf("  walls     %" PRIu32, space->wall_count);
    cleaning_print(&report->account.cleaning);
    printf("  cells     %" PRIu32 ", %" PRIu32 " of them inside", space->cell_count,
           space->inside_count);
    if (space->node_count) printf("; tree depth %" PRIu32, space->tree_depth);
    putchar('\n');
    printf("  portals   %" PRIu32 "\n", space->portal_count);
    plan_print(&report->baked->map);
    print_parts(report);
    if (has_sets) {
        print_visibility(report->baked);
        mean_pvs_print(&mean);
    }
    print_seconds(report);
    printf("  memory    %s at most\n", memory);
    return SL_OK;
}

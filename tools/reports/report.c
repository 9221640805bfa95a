/// Parts of reports, each as text and as JSON.
#include "reports/report.h"

#include "sightline/faults.h"
#include "sightline/support.h"

#include <inttypes.h>
#include <stdio.h>
#include <stdlib.h>

// --- the plan

void plan_print(const sl_map *map) {
    size_t count;
    const sl_effect *const *effects = sl_effects(&count);
    const unsigned called_for = sl_plan_make(map).effects;
    const char *lead = "  effects   ";
    for (size_t i = 0; i < count; i++) {
        if (!(called_for >> i & 1)) continue;
        printf("%s%s (%zu): %s\n", lead, effects[i]->several, effects[i]->count(map),
               effects[i]->adds);
        lead = "            ";
    }
}

void plan_add_json(json_fields *fields, const sl_map *map) {
    size_t count;
    const sl_effect *const *effects = sl_effects(&count);
    const unsigned called_for = sl_plan_make(map).effects;
    json_open(fields, "effects");
    for (size_t i = 0; i < count; i++) json_add_flag(fields, effects[i]->name, called_for >> i & 1);
    json_close(fields);
}

// --- cleaning

static void print_welding(const sl_clean_account *account) {
    const char *between = "";
    printf("  welded    ");
    if (!account->welded && !account->crossings) printf("walls to ends beside them");
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
    if (account->welded || account->crossings || account->largest_move > 0) print_welding(account);
}

// --- how much a cell sees

/// Sums over the cells before a cell, of those that count: the sum over a run of cells is one
/// difference. Where all areas are too small for a double, each cell counts as 1.
typedef struct before {
    double area;
    uint32_t cells;
} before;

static void sum_before(const sl_baked *baked, before *sums) {
    const sl_space *space = &baked->space;
    sums[0] = (before){0};
    for (uint32_t c = 0; c < space->cell_count; c++) {
        sums[c + 1] = sums[c];
        if (!sl_baked_counts(baked, c)) continue;
        sums[c + 1].area += sl_space_area(space, c);
        sums[c + 1].cells++;
    }
    if (sums[space->cell_count].area > 0) return;
    for (uint32_t c = 0; c <= space->cell_count; c++) sums[c].area = sums[c].cells;
}

sl_status mean_pvs_of(sl_context *context, const sl_baked *baked, pvs_means *out) {
    const sl_space *space = &baked->space;
    pvs_means mean = {0};
    before *sums = sl_alloc_array(context, (size_t)space->cell_count + 1, sizeof *sums);
    if (!sums) return SL_NO_MEMORY;
    sum_before(baked, sums);
    const before all = sums[space->cell_count];

    uint64_t cells = 0;
    double area = 0; // shares, so that no sum grows beyond what a double holds
    for (uint32_t c = 0; c < space->cell_count; c++) {
        if (!sl_baked_counts(baked, c)) continue;
        for (sl_pvs_run run = sl_pvs_begin(&baked->visibility.pvs, c); sl_pvs_next(&run);) {
            cells += sums[run.end].cells - sums[run.first].cells;
            area += (sums[run.end].area - sums[run.first].area) / all.area;
        }
    }
    sl_free(context, sums);
    mean.inside_only = all.cells < space->cell_count;
    if (all.cells) {
        mean.cell_count = all.cells;
        mean.cells = (double)cells / all.cells;
        mean.share_of_cells = mean.cells / all.cells;
        mean.share_of_area = area / all.cells;
    }
    *out = mean;
    return SL_OK;
}

void mean_pvs_print(const pvs_means *mean) {
    printf("  a cell    sees %.1f of %" PRIu32
           " %scells (%.1f %%) and %.1f %% of their area, on average\n",
           mean->cells, mean->cell_count, mean->inside_only ? "inside " : "",
           100 * mean->share_of_cells, 100 * mean->share_of_area);
}

void mean_pvs_add_json(json_fields *fields, const pvs_means *mean) {
    json_add_text(fields, "mean_pvs_over", mean->inside_only ? "inside cells" : "all cells");
    json_add_real(fields, "mean_pvs_cells", mean->cells);
    json_add_real(fields, "mean_pvs_share_of_cells", mean->share_of_cells);
    json_add_real(fields, "mean_pvs_share_of_area", mean->share_of_area);
}

// --- ground

void ground_print(const sl_space *space) {
    const sl_ground_shares shares = sl_space_ground(space);
    if (space->inside_count == space->cell_count) return;
    printf("  area      %.1f %% inside", 100 * shares.inside);
    if (shares.outside > 0) printf(", %.1f %% outside", 100 * shares.outside);
    if (shares.solid > 0) printf(", %.1f %% solid ground", 100 * shares.solid);
    putchar('\n');
}

void ground_add_json(json_fields *fields, const sl_space *space) {
    const sl_ground_shares shares = sl_space_ground(space);
    json_add_real(fields, "inside_share", shares.inside);
    json_add_real(fields, "outside_share", shares.outside);
    json_add_real(fields, "solid_share", shares.solid);
}

// --- times

void sort_doubles(double *values, size_t count) {
    qsort(values, count, sizeof *values, sl_compare_numbers);
}

void seconds_write(double seconds, const char *micro, char text[SECONDS_TEXT]) {
    const char *const units[] = {"s", "ms", micro, "ns"};
    int unit = 0;
    // A value that would round up to 1000 gets the next larger unit.
    for (; unit < 3 && seconds < 0.9995; unit++) seconds *= 1000;
    const int decimals = seconds < 9.995 ? 2 : seconds < 99.95 ? 1 : 0;
    snprintf(text, SECONDS_TEXT, "%.*f %s%s", decimals, seconds, units[unit], unit == 2 ? "s" : "");
}

/// Culling methods on many viewpoints: Teller and Séquin 1991, Results.
#include "studies/compare.h"

#include "arguments/names.h"
#include "inputs/pipeline.h"
#include "reports/fields.h"
#include "reports/report.h"
#include "sightline/region.h"
#include "sightline/stab.h"
#include "sightline/support.h"
#include "studies/eye_run.h"

#include <inttypes.h>
#include <math.h>
#include <stdio.h>
#include <string.h>

/// The number of queries that are timed together, and how often. The shortest time counts, since
/// other work of the machine only adds to it. The cells that they keep are summed up separately.
enum { BATCH = 64, RUNS = 3 };

/// The answer of one query: cells, or an area.
typedef struct answer {
    uint64_t *cells;
    sl_eye_account account;
    bool has_area; ///< `area` was set, and no cells
    double area;
} answer;

typedef struct viewpoint {
    sl_point at;
    double heading;
} viewpoint;

typedef struct comparing {
    sl_context *context;
    const compare_eye_plan *plan;
    const sl_map *map;
    const sl_space *space;
    sl_visibility visibility;
    sl_query *query;
    sl_region region;
    double *area; ///< by cell; 0 for outside cells
    double whole;
    viewpoint *viewpoints;
    answer answers[BATCH];
} comparing;

/// A method under comparison. It has a row of the table for each cone.
typedef struct contender {
    const char *name;
    sl_guarantee guarantee;
    sl_status (*ask)(comparing *all, const struct contender *me, const sl_view *view, answer *out);
    const sl_eye_method *method;
} contender;

enum { CONTENDERS_MOST = 16 };

static sl_status ask_method(comparing *all, const contender *me, const sl_view *view, answer *out) {
    return sl_query_look(all->context, all->query, view, me->method, out->cells, &out->account);
}

/// The exact visible region: what is seen of each cell, and no more.
static sl_status ask_region(comparing *all, const contender *me, const sl_view *view, answer *out) {
    (void)me;
    SL_TRY(sl_query_region(all->context, all->query, view, &all->region));
    out->has_area = true;
    out->area = sl_region_area(&all->region);
    out->account = (sl_eye_account){.nodes = all->region.portals_passed};
    return SL_OK;
}

/// The library's methods, from the loosest to the exact one, and the region.
static size_t list_contenders(contender contenders[CONTENDERS_MOST]) {
    size_t count;
    const sl_eye_method *methods = sl_eye_methods(&count);
    for (size_t i = 0; i < count; i++)
        contenders[i] = (contender){methods[i].name, methods[i].guarantee, ask_method, &methods[i]};
    contenders[count++] = (contender){"visible_area", SL_EXACT, ask_region, NULL};
    return count;
}

// --- reading the options

sl_status compare_eye_read_fovs(sl_context *context, const char *text, compare_eye_plan *plan) {
    for (const char *word = text;; word++) {
        const size_t length = strcspn(word, ",");
        double fov;
        if (!sl_number_read(word, length, &fov) || !(fov >= 0 && fov <= 360))
            return sl_fail(context, SL_BAD_ARGUMENT,
                           "--fov %s: degrees from 0 to 360 are needed, with commas between", text);
        if (plan->fov_count == FOVS_MOST)
            return sl_fail(context, SL_BAD_ARGUMENT, "--fov %s: at most %d cones can be compared",
                           text, FOVS_MOST);
        plan->fovs[plan->fov_count++] = fov;
        word += length;
        if (!*word) return SL_OK;
    }
}

compare_eye_plan compare_eye_plan_default(void) {
    return (compare_eye_plan){.viewpoints = 10000, .seed = 1};
}

// --- viewpoints

/// A random point of a cell, evenly over its area: choose a triangle of its fan by area, then a
/// point of it.
static sl_point point_in(const sl_space *space, uint32_t number, sl_random *random) {
    const sl_cell *cell = &space->cells[number];
    const sl_point *v = space->vertices + cell->first_vertex;
    double rest = sl_random_unit(random) * 2 * sl_space_area(space, number);
    uint32_t i = 1;
    for (; i + 2 < cell->vertex_count; i++) {
        const double twice =
            (v[i].x - v[0].x) * (v[i + 1].y - v[0].y) - (v[i + 1].x - v[0].x) * (v[i].y - v[0].y);
        if (rest < twice) break;
        rest -= twice;
    }
    double s = sl_random_unit(random), t = sl_random_unit(random);
    if (s + t > 1) {
        s = 1 - s;
        t = 1 - t;
    }
    return (sl_point){v[0].x + s * (v[i].x - v[0].x) + t * (v[i + 1].x - v[0].x),
                      v[0].y + s * (v[i].y - v[0].y) + t * (v[i + 1].y - v[0].y)};
}

/// The cell where the running sum of areas passes `area`; binary search.
static uint32_t cell_at(const double *before, uint32_t count, double area) {
    uint32_t low = 0, high = count;
    while (high - low > 1) {
        const uint32_t middle = low + (high - low) / 2;
        if (before[middle] <= area)
            low = middle;
        else
            high = middle;
    }
    return low;
}

/// Rounding may put a point beyond its cell's border. Then another point is drawn; after many
/// tries, as in cells too thin for doubles, a corner is taken.
static void draw_viewpoint(const comparing *all, const double *before, sl_random *random,
                           viewpoint *out) {
    const sl_space *space = all->space;
    const double area = sl_random_unit(random) * all->whole;
    const uint32_t cell = cell_at(before, space->cell_count, area);
    out->heading = 360 * sl_random_unit(random);
    for (int i = 0; i < 64; i++) {
        out->at = point_in(space, cell, random);
        if (sl_space_locate(space, out->at) == cell) return;
    }
    out->at = space->vertices[space->cells[cell].first_vertex];
}

static sl_status draw_viewpoints(sl_context *context, comparing *all) {
    const uint32_t count = all->space->cell_count;
    sl_random random = {all->plan->seed};
    all->area = sl_alloc_array(context, count, sizeof *all->area);
    all->viewpoints = sl_alloc_array(context, all->plan->viewpoints, sizeof *all->viewpoints);
    double *before = sl_alloc_array(context, (size_t)count + 1, sizeof *before);
    if (!all->area || !all->viewpoints || !before) {
        sl_free(context, before);
        return SL_NO_MEMORY;
    }
    for (uint32_t c = 0; c < count; c++) {
        all->area[c] = all->space->cells[c].inside ? sl_space_area(all->space, c) : 0;
        before[c + 1] = before[c] + all->area[c];
    }
    all->whole = before[count];
    for (uint64_t i = 0; i < all->plan->viewpoints; i++)
        draw_viewpoint(all, before, &random, &all->viewpoints[i]);
    sl_free(context, before);
    return all->whole > 0 ? SL_OK
                          : sl_fail(context, SL_BAD_INPUT,
                                    "the map's cells are too small for their areas to be computed");
}

// --- the runs

static void add_answer(const comparing *all, const answer *a, compare_eye_row *row) {
    double area = a->has_area ? a->area : 0;
    const size_t words = a->has_area ? 0 : sl_eye_words(all->space);
    for (size_t word = 0; word < words; word++)
        for (sl_bits rest = a->cells[word]; rest; rest &= rest - 1) {
            area += all->area[64 * word + (size_t)__builtin_ctzll(rest)];
            row->cells++;
        }
    if (a->has_area) row->cells = NAN;
    row->share += area / all->whole;
    row->nodes += (double)a->account.nodes;
    row->orientations += (double)a->account.orientations;
}

/// Asks a batch of views, and gives the time of one query.
static sl_status run_batch(comparing *all, const contender *who, const sl_view *views, size_t count,
                           compare_eye_row *row, double *seconds) {
    double least = INFINITY;
    for (int run = 0; run < RUNS; run++) {
        const double start = sl_seconds();
        for (size_t i = 0; i < count; i++) {
            all->answers[i].has_area = false;
            SL_TRY(who->ask(all, who, &views[i], &all->answers[i]));
        }
        least = fmin(least, sl_seconds() - start);
    }
    *seconds = least / (double)count;
    for (size_t i = 0; i < count; i++) add_answer(all, &all->answers[i], row);
    return SL_OK;
}

/// Turns sums into means. `seconds` has the times of all batches; their median is the result.
static void finish_row(const comparing *all, double *seconds, size_t batches,
                       compare_eye_row *row) {
    const double n = (double)all->plan->viewpoints;
    row->share /= n;
    row->cells /= n;
    row->nodes /= n;
    row->orientations /= n;
    sort_doubles(seconds, batches);
    row->seconds = (seconds[(batches - 1) / 2] + seconds[batches / 2]) / 2;
}

/// All methods take turns, batch by batch, so that other work of the machine slows all of them
/// alike.
static sl_status run_cone(comparing *all, const contender *contenders, size_t count, double fov,
                          double *seconds, compare_eye_row *rows) {
    const uint64_t total = all->plan->viewpoints;
    const size_t batches = (size_t)((total + BATCH - 1) / BATCH);
    const double reach = eye_reach(all->space);
    sl_view views[BATCH];
    char stage[32];
    snprintf(stage, sizeof stage, "cones of %g degrees", fov);
    for (size_t b = 0; b < batches; b++) {
        const uint64_t first = (uint64_t)b * BATCH;
        const size_t size = total - first < BATCH ? (size_t)(total - first) : BATCH;
        sl_report(all->context, stage, "viewpoints", first, total);
        SL_TRY(sl_check_cancelled(all->context));
        for (size_t i = 0; i < size; i++)
            views[i] = sl_view_cone(all->viewpoints[first + i].at,
                                    all->viewpoints[first + i].heading, fov, reach);
        for (size_t k = 0; k < count; k++)
            SL_TRY(
                run_batch(all, &contenders[k], views, size, &rows[k], &seconds[k * batches + b]));
    }
    for (size_t k = 0; k < count; k++) finish_row(all, seconds + k * batches, batches, &rows[k]);
    return SL_OK;
}

static sl_status run_cones(comparing *all, eye_comparison *out) {
    contender contenders[CONTENDERS_MOST];
    const size_t count = list_contenders(contenders), cones = all->plan->fov_count;
    const size_t batches = (size_t)((all->plan->viewpoints + BATCH - 1) / BATCH);
    out->rows = sl_alloc_array(all->context, count * cones, sizeof *out->rows);
    double *seconds = sl_alloc_array(all->context, count * batches, sizeof *seconds);
    sl_status status = out->rows && seconds ? SL_OK : SL_NO_MEMORY;
    for (size_t f = 0; f < cones && status == SL_OK; f++) {
        compare_eye_row *rows = out->rows + f * count;
        for (size_t k = 0; k < count; k++)
            rows[k] = (compare_eye_row){.name = contenders[k].name,
                                        .guarantee = contenders[k].guarantee,
                                        .fov = all->plan->fovs[f]};
        status = run_cone(all, contenders, count, all->plan->fovs[f], seconds, rows);
    }
    out->row_count = count * cones;
    sl_free(all->context, seconds);
    return status;
}

/// The visible sets, with glass and the range. Mirrors are walls, and shut doors are by now.
static sl_status see(comparing *all, sl_sight sight, double *seconds) {
    size_t count;
    sl_plan plan = sl_plan_make(all->map);
    plan.effects &= ~(unsigned)(SL_EFFECT_MIRROR | SL_EFFECT_DOOR);
    sl_see_options options = sl_see_options_default();
    options.solver = sl_funnel();
    options.sight = sight;
    options.inside_only = true;
    options.plan = &plan;
    const double start = sl_seconds();
    SL_TRY(sl_see_methods(&count)->see(all->context, all->space, &options, &all->visibility));
    *seconds = sl_seconds() - start;
    SL_TRY(sl_query_over(all->context, all->space, all->map, &all->visibility, &all->query));
    return sl_query_set_mirror_depth(all->context, all->query, 0);
}

static sl_status make_answers(comparing *all) {
    for (size_t i = 0; i < BATCH; i++) {
        all->answers[i].cells =
            sl_alloc_array(all->context, sl_eye_words(all->space), sizeof *all->answers[i].cells);
        if (!all->answers[i].cells) return SL_NO_MEMORY;
    }
    return SL_OK;
}

sl_status compare_eye_run(command_console *console, const compare_eye_plan *plan, const sl_map *map,
                          const sl_space *space, sl_sight sight, eye_comparison *out) {
    sl_context *context = console->context;
    comparing all = {.context = context, .plan = plan, .map = map, .space = space};
    eye_comparison result = {.space = space, .sight = sight, .plan = plan};
    sl_status status = draw_viewpoints(context, &all);
    if (status == SL_OK) status = make_answers(&all);
    if (status == SL_OK) status = see(&all, sight, &result.pvs_seconds);
    if (status == SL_OK) status = run_cones(&all, &result);
    for (size_t i = 0; i < BATCH; i++) sl_free(context, all.answers[i].cells);
    sl_region_destroy(context, &all.region);
    sl_query_destroy(context, all.query);
    sl_visibility_destroy(context, &all.visibility);
    sl_free(context, all.area);
    sl_free(context, all.viewpoints);
    if (status == SL_OK)
        *out = result;
    else
        sl_free(context, result.rows);
    return status;
}

// --- the report

/// The paper's figures for a method. False where it has none.
static bool compare_eye_paper(const char *name, double fov, double *share, double *reduction) {
    // Teller & Séquin 1991, Results; the reduction factors are rounded there.
    static const struct {
        const char *name;
        double fov, percent, reduction;
    } told[] = {
        {"cell_to_cell", 360, 8.1, 10},
        {"cell_to_cell", 60, 8.1, 10},
        {"disjoint_cell", 360, 8.1, 10},
        {"disjoint_cell", 60, 3.1, 30},
        {"connected_component", 360, 8.1, 10},
        {"connected_component", 60, 2.4, 40},
        {"incident_portals", 360, 8.1, 10},
        {"incident_portals", 60, 2.2, 40},
        {"exact", 360, 4.9, 20},
        {"exact", 60, 1.8, 50},
        {"visible_area", 360, 2.1, 50},
        {"visible_area", 60, 0.3, 300},
    };
    for (size_t i = 0; i < sizeof told / sizeof *told; i++)
        if (told[i].fov == fov && strcmp(told[i].name, name) == 0) {
            *share = told[i].percent / 100;
            *reduction = told[i].reduction;
            return true;
        }
    return false;
}

static double reduction_of(const compare_eye_row *row) {
    return row->share > 0 ? 1 / row->share : 0;
}

// --- the table

static void print_row(const compare_eye_row *row) {
    char cells[SL_NUMBER_TEXT] = "", seconds[SECONDS_TEXT], paper[64] = "";
    double share, reduction;
    if (!isnan(row->cells)) snprintf(cells, sizeof cells, "%.1f", row->cells);
    seconds_write(row->seconds, "u", seconds);
    if (compare_eye_paper(row->name, row->fov, &share, &reduction))
        snprintf(paper, sizeof paper, "%12.1f %% %8.0f x", 100 * share, reduction);
    printf("  %-20s %8.2f %% %8.1f x %8s %9.1f %13.1f %9s%s\n", row->name, 100 * row->share,
           reduction_of(row), cells, row->nodes, row->orientations, seconds, paper);
}

void compare_eye_print(const eye_comparison *comparison) {
    const sl_space *space = comparison->space;
    char seconds[SECONDS_TEXT];
    seconds_write(comparison->pvs_seconds, "u", seconds);
    printf("%s: %" PRIu32 " walls after cleaning, %" PRIu32 " cells (%" PRIu32 " inside), %" PRIu32
           " portals; %s sight\n%" PRIu64 " viewpoints, seed %" PRIu64
           ", spread evenly over the inside area; visible sets made in %s\n",
           comparison->input, space->wall_count, space->cell_count, space->inside_count,
           space->portal_count, sight_name(comparison->sight), comparison->plan->viewpoints,
           comparison->plan->seed, seconds);
    ground_print(space);
    double fov = -1;
    for (size_t i = 0; i < comparison->row_count; i++) {
        const compare_eye_row *row = &comparison->rows[i];
        if (row->fov != fov)
            printf("\n%g degrees              area kept  reduction    cells     nodes  "
                   "orientations      time   paper: area  reduction\n",
                   row->fov);
        fov = row->fov;
        print_row(row);
    }
    puts("\nmeans over all viewpoints (time: the median), a query; reduction: 1 / area kept; "
         "paper: Teller & Sequin "
         "1991,\nof Soda Hall");
}

// --- CSV and JSON

static table_field of_paper(const char *key, bool known, double real) {
    table_field field = field_real(key, real);
    if (!known) field.kind = FIELD_LEFT_OUT;
    return field;
}

static size_t list_fields(const void *of, size_t number, table_field fields[FIELDS_MOST]) {
    const eye_comparison *comparison = of;
    const compare_eye_row *row = &comparison->rows[number];
    double share = 0, reduction = 0;
    const bool paper = compare_eye_paper(row->name, row->fov, &share, &reduction);
    size_t count = 0;
    fields[count++] = field_real("fov", row->fov);
    fields[count++] = field_text("method", row->name);
    fields[count++] = field_text("guarantee", sl_guarantee_name(row->guarantee));
    fields[count++] = field_real("share", row->share);
    fields[count++] = field_real("reduction", reduction_of(row));
    fields[count++] = field_real("cells", row->cells);
    fields[count++] = field_real("nodes", row->nodes);
    fields[count++] = field_real("orientations", row->orientations);
    fields[count++] = field_real("seconds", row->seconds);
    fields[count++] = of_paper("paper_share", paper, share);
    fields[count++] = of_paper("paper_reduction", paper, reduction);
    return count;
}

static field_rows rows_of(const eye_comparison *comparison) {
    return (field_rows){list_fields, comparison, comparison->row_count};
}

sl_status compare_eye_write_csv(sl_context *context, const eye_comparison *comparison,
                                const char *path) {
    const field_rows rows = rows_of(comparison);
    return fields_write_csv(context, &rows, path);
}

void compare_eye_print_columns(void) {
    puts("\ncolumns of eye.csv, a line for each cone and method; means over all viewpoints:\n"
         "  fov                 the view cone, degrees\n"
         "  method, guarantee   as 'sightline eye --help' lists them\n"
         "  share, reduction    the area kept, as a share of all inside; 1 / share\n"
         "  cells               those kept; blank for visible_area, which has none\n"
         "  nodes               cells looked at; exact: nodes of the stab tree visited\n"
         "  orientations        orientation tests\n"
         "  seconds             a query, on one thread (the median)\n"
         "  paper_share, paper_reduction\n"
         "                      what Teller & Sequin 1991 tell of Soda Hall");
}

sl_status compare_eye_print_json(sl_context *context, const eye_comparison *comparison) {
    const sl_space *space = comparison->space;
    const field_rows rows = rows_of(comparison);
    json_fields fields = json_begin();
    json_add_text(&fields, "map", comparison->input);
    json_add_text(&fields, "sight", sight_name(comparison->sight));
    json_add_count(&fields, "walls", space->wall_count);
    json_add_count(&fields, "cells", space->cell_count);
    json_add_count(&fields, "inside_cells", space->inside_count);
    ground_add_json(&fields, space);
    json_add_count(&fields, "portals", space->portal_count);
    json_add_count(&fields, "viewpoints", comparison->plan->viewpoints);
    json_add_count(&fields, "seed", comparison->plan->seed);
    json_add_real(&fields, "cell_to_cell_seconds", comparison->pvs_seconds);
    fields_add_json(&fields, "rows", &rows);
    return json_print(context, &fields);
}

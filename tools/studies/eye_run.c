/// Asks each culling method in turn, and gathers what is seen as polygons.
#include "studies/eye_run.h"

#include "arguments/names.h"
#include "reports/report.h"
#include "sightline/support.h"

#include <inttypes.h>
#include <math.h>
#include <string.h>

/// A question is timed in rounds of at least ROUND_SECONDS each. The result is the median of
/// ROUNDS.
enum { ROUNDS = 5, QUERIES_MOST = 1 << 20 };
#define ROUND_SECONDS 0.002

double eye_reach(const sl_space *space) {
    const sl_box b = space->bounds;
    const double x = fmax(fabs(b.min.x), fabs(b.max.x)), y = fmax(fabs(b.min.y), fabs(b.max.y));
    return fmax(fmax(x, y), fmax(b.max.x - b.min.x, b.max.y - b.min.y));
}

/// A question of one kind, to be asked again and again.
typedef struct question {
    sl_context *context;
    sl_query *query;
    const sl_view *view;
    const sl_eye_method *method; ///< NULL for the region
    eye_result *result;
    sl_region *region;
} question;

static sl_status ask(const question *q) {
    if (!q->method) return sl_query_region(q->context, q->query, q->view, q->region);
    return sl_query_look(q->context, q->query, q->view, q->method, q->result->cells,
                         &q->result->account);
}

static sl_status time_question(const question *q, double *out) {
    double seconds[ROUNDS];
    size_t queries = 1;
    for (int round = 0; round < ROUNDS;) {
        const double start = sl_seconds();
        for (size_t i = 0; i < queries; i++) SL_TRY(ask(q));
        const double taken = sl_seconds() - start;
        if (taken < ROUND_SECONDS && queries < QUERIES_MOST) {
            queries *= 2;
            continue;
        }
        seconds[round++] = taken / (double)queries;
        SL_TRY(sl_check_cancelled(q->context));
    }
    sort_doubles(seconds, ROUNDS);
    *out = seconds[ROUNDS / 2];
    return SL_OK;
}

/// The area of all cells that count, or of all that do not, as the given cell does.
static double area_of_side(const sl_baked *baked, uint32_t cell) {
    const bool side = sl_baked_counts(baked, cell);
    double whole = 0;
    for (uint32_t c = 0; c < baked->space.cell_count; c++)
        if (sl_baked_counts(baked, c) == side) whole += sl_space_area(&baked->space, c);
    return whole;
}

/// Counts the cells of a set, adding to *count, and finds their share of the area.
static void eye_measure(const sl_baked *baked, uint32_t eye_cell, const uint64_t *cells,
                        uint32_t *count, double *share) {
    const sl_space *space = &baked->space;
    const bool side = sl_baked_counts(baked, eye_cell);
    const double whole = area_of_side(baked, eye_cell);
    double kept = 0;
    for (uint32_t c = 0; c < space->cell_count; c++) {
        const bool seen = sl_eye_sees(cells, c);
        const double area = sl_baked_counts(baked, c) == side ? sl_space_area(space, c) : 0;
        kept += seen ? area : 0;
        *count += seen;
    }
    *share = whole > 0 ? kept / whole : 0;
}

/// The cells that a method sees by mirror, if it knows mirrors.
static sl_status run_mirrored(sl_context *context, const sl_eye_method *method, sl_query *query,
                              eye_run *run, eye_result *result) {
    sl_eye_account account;
    if (!run->has_mirrors || !method->mirrored) return SL_OK;
    result->mirrored =
        sl_alloc_array(context, sl_eye_words(sl_query_asked(query)), sizeof *result->mirrored);
    if (!result->mirrored) return SL_NO_MEMORY;
    SL_TRY(sl_query_look_mirrored(context, query, &run->view, method, result->mirrored, &account));
    result->rounded = account.rounded;
    eye_measure(run->baked, run->cell, result->mirrored, &result->mirrored_count,
                &result->mirrored_share);
    return SL_OK;
}

static sl_status run_methods(sl_context *context, sl_query *query, bool timed, eye_run *run) {
    const sl_baked *baked = run->baked;
    const sl_eye_method *methods = sl_eye_methods(&run->result_count);
    run->results = sl_alloc_array(context, run->result_count, sizeof *run->results);
    if (!run->results) return SL_NO_MEMORY;
    for (size_t i = 0; i < run->result_count; i++) {
        eye_result *result = &run->results[i];
        result->cells = sl_alloc_array(context, sl_eye_words(&baked->space), sizeof *result->cells);
        if (!result->cells) return SL_NO_MEMORY;
        const question q = {context, query, &run->view, &methods[i], .result = result};
        SL_TRY(timed ? time_question(&q, &result->seconds) : ask(&q));
        eye_measure(baked, run->cell, result->cells, &result->count, &result->share);
        SL_TRY(run_mirrored(context, &methods[i], query, run, result));
    }
    return SL_OK;
}

static sl_status run_region(sl_context *context, sl_query *query, bool timed, eye_run *run) {
    const question q = {context, query, &run->view, .region = &run->region};
    SL_TRY(timed ? time_question(&q, &run->region_seconds) : ask(&q));
    const double whole = area_of_side(run->baked, run->cell);
    run->region_share = whole > 0 ? sl_region_area(&run->region) / whole : 0;
    if (!run->has_mirrors) return SL_OK;
    return sl_query_mirrored_region(context, query, &run->view, &run->mirrored);
}

sl_status eye_run_make(sl_context *context, const sl_baked *baked, sl_query *query,
                       const sl_view *view, uint32_t mirror_depth, bool timed, eye_run *out) {
    eye_run run = {.baked = baked,
                   .view = *view,
                   .cell = sl_query_locate(query, view->eye),
                   .has_mirrors = baked->map.mirror_count > 0,
                   .mirror_depth = mirror_depth};
    sl_status status = run_methods(context, query, timed, &run);
    if (status == SL_OK) status = run_region(context, query, timed, &run);
    if (status == SL_OK)
        *out = run;
    else
        eye_run_destroy(context, &run);
    return status;
}

void eye_run_destroy(sl_context *context, eye_run *run) {
    for (size_t i = 0; run->results && i < run->result_count; i++) {
        sl_free(context, run->results[i].cells);
        sl_free(context, run->results[i].mirrored);
    }
    sl_free(context, run->results);
    sl_region_destroy(context, &run->region);
    sl_mirrored_region_destroy(context, &run->mirrored);
    *run = (eye_run){0};
}

// --- objects

// --- reading

static sl_status refuse(sl_context *context, const char *text, const sl_map *map) {
    const name_table objects = {"object", map->objects, sizeof *map->objects, map->object_count,
                                NULL};
    char names[NAME_LIST];
    name_list(&objects, names);
    return sl_fail(context, SL_BAD_ARGUMENT,
                   "--object %s: X0,Y0,X1,Y1 is needed, or one of the map's objects: %s; with "
                   "',block' behind it, it blocks sight",
                   text, names);
}

static bool read_box(const char *text, size_t length, sl_box *out) {
    double values[4];
    const char *at = text, *end = text + length;
    for (int i = 0; i < 4; i++) {
        const char *stop = i < 3 ? memchr(at, ',', (size_t)(end - at)) : end;
        if (!stop || !sl_number_read(at, (size_t)(stop - at), &values[i]) || !isfinite(values[i]))
            return false;
        at = stop + 1;
    }
    *out = (sl_box){{fmin(values[0], values[2]), fmin(values[1], values[3])},
                    {fmax(values[0], values[2]), fmax(values[1], values[3])}};
    return true;
}

static bool find_box(const char *text, size_t length, const sl_map *map, sl_box *out) {
    for (size_t i = 0; i < map->object_count; i++) {
        const char *name = map->objects[i].name;
        if (strlen(name) != length || memcmp(name, text, length) != 0) continue;
        *out = map->objects[i].box;
        return true;
    }
    return false;
}

static sl_status read_object(sl_context *context, const char *text, const sl_map *map,
                             sl_moving_box *out) {
    static const char block[] = ",block";
    size_t length = strlen(text);
    const size_t tail = sizeof block - 1;
    out->blocks = length > tail && strcmp(text + length - tail, block) == 0;
    if (out->blocks) length -= tail;
    if (read_box(text, length, &out->box) || find_box(text, length, map, &out->box)) return SL_OK;
    return refuse(context, text, map);
}

sl_status eye_objects_read(sl_context *context, const option_list *texts, const sl_map *map,
                           eye_objects *out) {
    out->count = texts->count;
    out->boxes = sl_alloc_array(context, texts->count, sizeof *out->boxes);
    out->objects = sl_alloc_array(context, texts->count, sizeof *out->objects);
    out->seen = sl_alloc_array(context, texts->count, sizeof *out->seen);
    out->mirrored = sl_alloc_array(context, texts->count, sizeof *out->mirrored);
    if (!out->boxes || !out->objects || !out->seen || !out->mirrored) return SL_NO_MEMORY;
    for (size_t i = 0; i < texts->count; i++) {
        out->objects[i].text = texts->items[i];
        SL_TRY(read_object(context, texts->items[i], map, &out->boxes[i]));
    }
    return SL_OK;
}

void eye_objects_destroy(sl_context *context, eye_objects *objects) {
    sl_free(context, objects->boxes);
    sl_free(context, objects->objects);
    sl_free(context, objects->seen);
    sl_free(context, objects->mirrored);
    sl_free(context, objects->cells);
    sl_free(context, objects->mirrored_cells);
    sl_mirrored_region_destroy(context, &objects->mirrored_region);
    sl_region_destroy(context, &objects->region);
    *objects = (eye_objects){0};
}

// --- looking

static bool meet(const uint64_t *a, const uint64_t *b, size_t words) {
    for (size_t i = 0; i < words; i++)
        if (a[i] & b[i]) return true;
    return false;
}

/// The first method keeps the whole visible set. The last one is exact.
static sl_status find_cells(sl_context *context, const sl_baked *baked, const eye_run *run,
                            eye_objects *o) {
    const size_t words = sl_eye_words(&baked->space);
    uint64_t *cells = sl_alloc_array(context, words, sizeof *cells);
    if (!cells) return SL_NO_MEMORY;
    for (size_t i = 0; i < o->count; i++) {
        sl_cells_of_box(&baked->space, o->boxes[i].box, cells);
        for (uint32_t c = 0; c < baked->space.cell_count; c++)
            o->objects[i].cells += sl_eye_sees(cells, c);
        o->objects[i].possible = meet(cells, run->results[0].cells, words);
        o->objects[i].in_exact = meet(cells, run->results[run->result_count - 1].cells, words);
    }
    sl_free(context, cells);
    return SL_OK;
}

/// What mirrors show: objects stand before them, and are seen in them.
static sl_status look_in_mirrors(sl_context *context, sl_query *query, const eye_run *run,
                                 eye_objects *o) {
    const sl_baked *baked = run->baked;
    o->has_mirrors = run->has_mirrors;
    if (!run->has_mirrors) return SL_OK;
    o->mirrored_cells =
        sl_alloc_array(context, sl_eye_words(&baked->space), sizeof *o->mirrored_cells);
    if (!o->mirrored_cells) return SL_NO_MEMORY;
    SL_TRY(sl_query_look_mirrored(context, query, &run->view, NULL, o->mirrored_cells, NULL));
    eye_measure(baked, run->cell, o->mirrored_cells, &o->mirrored_count, &o->mirrored_share);
    return sl_query_mirrored_region(context, query, &run->view, &o->mirrored_region);
}

/// Puts the objects in and finds the region past them. The first time also makes what serves all
/// later questions, so the second time is measured.
static sl_status place(sl_context *context, sl_query *query, const eye_run *run, bool timed,
                       eye_objects *o) {
    for (int time = 0; time < (timed ? 2 : 1); time++) {
        const double start = sl_seconds();
        SL_TRY(sl_query_set_boxes(context, query, o->boxes, o->count));
        SL_TRY(sl_query_region(context, query, &run->view, &o->region));
        if (timed) o->seconds = sl_seconds() - start;
    }
    return SL_OK;
}

sl_status eye_objects_run(sl_context *context, sl_query *query, const eye_run *run, bool timed,
                          eye_objects *o) {
    const sl_baked *baked = run->baked;
    if (!o->count) return SL_OK;
    o->cells = sl_alloc_array(context, sl_eye_words(&baked->space), sizeof *o->cells);
    if (!o->cells) return SL_NO_MEMORY;
    SL_TRY(find_cells(context, baked, run, o));
    SL_TRY(place(context, query, run, timed, o));
    const double direct = sl_region_area(&run->region);
    o->region_share = direct > 0 ? run->region_share * sl_region_area(&o->region) / direct : 0;
    SL_TRY(sl_query_look(context, query, &run->view, NULL, o->cells, NULL));
    SL_TRY(sl_query_boxes_seen(context, query, &run->view, o->seen,
                               run->has_mirrors ? o->mirrored : NULL));
    eye_measure(baked, run->cell, o->cells, &o->cell_count, &o->share);
    return look_in_mirrors(context, query, run, o);
}

// --- telling

static const char *say(const eye_objects *o, size_t i) {
    if (o->seen[i]) return o->mirrored[i] ? "seen, by mirror too" : "seen";
    if (o->mirrored[i]) return "seen by mirror";
    if (!o->objects[i].possible) return "hidden: not in the visible set of the eye's cell";
    return o->objects[i].in_exact ? "hidden, in a cell that is seen"
                                  : "hidden: its cells are not seen from here";
}

void eye_objects_print(const eye_objects *objects) {
    char seconds[SECONDS_TEXT];
    if (!objects->count) return;
    printf("\nobjects, put in without a new bake");
    if (objects->seconds > 0) {
        seconds_write(objects->seconds, "u", seconds);
        printf(" in %s", seconds);
    }
    puts(":");
    for (size_t i = 0; i < objects->count; i++)
        printf("  %-24s in %" PRIu32 " cell%s; %s\n", objects->objects[i].text,
               objects->objects[i].cells, objects->objects[i].cells == 1 ? "" : "s",
               say(objects, i));
    printf("past them %" PRIu32 " cells are seen, %.2f %%; visible area %.2f %%\n",
           objects->cell_count, 100 * objects->share, 100 * objects->region_share);
    if (objects->has_mirrors)
        printf("by mirror past them %" PRIu32 " cells, %.2f %%; area in mirrors %.6g\n",
               objects->mirrored_count, 100 * objects->mirrored_share,
               sl_mirrored_area(&objects->mirrored_region));
}

/// Whether an object before it was given by the same text: a key stands once in an object.
static bool is_repeated(const eye_objects *objects, size_t index) {
    for (size_t i = 0; i < index; i++)
        if (strcmp(objects->objects[i].text, objects->objects[index].text) == 0) return true;
    return false;
}

void eye_objects_add_json(json_fields *fields, const sl_baked *baked, const eye_objects *objects) {
    if (!objects->count) return;
    json_open(fields, "objects_seen");
    for (size_t i = 0; i < objects->count; i++)
        if (!is_repeated(objects, i))
            json_add_flag(fields, objects->objects[i].text, objects->seen[i]);
    json_close(fields);
    if (objects->has_mirrors) {
        json_open(fields, "objects_mirrored");
        for (size_t i = 0; i < objects->count; i++)
            if (!is_repeated(objects, i))
                json_add_flag(fields, objects->objects[i].text, objects->mirrored[i]);
        json_close(fields);
    }
    json_open(fields, "past_objects");
    if (objects->has_mirrors)
        json_add_members(fields, "mirrored_cells", objects->mirrored_cells,
                         baked->space.cell_count);
    json_add_members(fields, "cells", objects->cells, baked->space.cell_count);
    const sl_region_measures measures = sl_region_measure(&objects->region);
    json_open(fields, "region");
    json_add_real(fields, "area", measures.area);
    json_add_real(fields, "perimeter", measures.perimeter);
    json_add_points(fields, "polygon", objects->region.points, objects->region.count);
    json_close(fields);
    json_close(fields);
}

// --- polygons to be drawn

/// A share of the map's width plus height. It is too small to see in a picture.
#define TOLERANCE 1e-4

/// A share of the largest coordinate. Points of regions are rounded by less.
#define ROUNDING 0x1p-42

/// Whether the outline does not go on at a point, or goes back where it came from: slits, which a
/// corner makes that hides nothing beside itself, and needles, up to rounding.
static bool is_needless(sl_point before, sl_point p, sl_point behind, double rounding) {
    const sl_point in = {p.x - before.x, p.y - before.y}, out = {behind.x - p.x, behind.y - p.y};
    const double come = hypot(in.x, in.y), go = hypot(out.x, out.y);
    if (come <= rounding || go <= rounding) return come <= rounding;
    return in.x * out.x + in.y * out.y < 0 &&
           fabs(in.x * out.y - in.y * out.x) <= rounding * fmax(come, go);
}

/// Leaves such points out, so that the polygon touches itself nowhere. Returns how many are left.
static size_t drop_needless(sl_point *points, size_t count, double rounding) {
    for (size_t before = count + 1; count < before && count;) {
        size_t kept = 0;
        before = count;
        for (size_t i = 0; i < count; i++) {
            const sl_point last = points[kept ? kept - 1 : count - 1];
            if (!is_needless(last, points[i], points[i + 1 < count ? i + 1 : 0], rounding))
                points[kept++] = points[i];
        }
        count = kept;
    }
    return count;
}

static sl_status add_seen_part(sl_context *context, const sl_space *space, const sl_region *region,
                               sl_point eye, uint32_t depth, seen_parts *parts) {
    const sl_box *b = &space->bounds;
    const double tolerance = (b->max.x - b->min.x + b->max.y - b->min.y) * TOLERANCE;
    const double largest =
        fmax(fmax(fabs(b->min.x), fabs(b->max.x)), fmax(fabs(b->min.y), fabs(b->max.y)));
    size_t count = sl_region_flatten(region, tolerance, NULL, 0);
    SL_TRY(SL_ARRAY_ROOM(context, parts, 1));
    sl_point *points = sl_alloc_array(context, count, sizeof *points);
    if (!points) return SL_NO_MEMORY;
    sl_region_flatten(region, tolerance, points, count);
    count = drop_needless(points, count, ROUNDING * largest);
    parts->items[parts->count++] =
        (sl_drawn_region){.eye = eye, .points = points, .count = count, .depth = depth};
    return SL_OK;
}

sl_status seen_parts_add(sl_context *context, const sl_space *space,
                         const sl_mirrored_region *region, bool direct, seen_parts *parts) {
    const sl_point eye = region->direct.view.eye;
    if (direct) SL_TRY(add_seen_part(context, space, &region->direct, eye, 0, parts));
    for (size_t i = 0; i < region->part_count; i++)
        SL_TRY(add_seen_part(context, space, &region->parts[i].region, eye, region->parts[i].depth,
                             parts));
    return SL_OK;
}

sl_status seen_parts_add_region(sl_context *context, const sl_space *space, const sl_region *region,
                                seen_parts *parts) {
    return add_seen_part(context, space, region, region->view.eye, 0, parts);
}

void seen_parts_put_mirrored(sl_geojson_writer *out, const sl_mirrored_region *region,
                             const sl_drawn_region *parts) {
    const sl_point eye = region->direct.view.eye;
    for (size_t i = 0; i < region->part_count; i++) {
        const sl_mirror_part *part = &region->parts[i];
        sl_geojson_put_polygon(out, "mirrored", parts[i].points, parts[i].count);
        sl_geojson_add_real(out, "x", eye.x);
        sl_geojson_add_real(out, "y", eye.y);
        sl_geojson_add_count(out, "mirror", part->mirror);
        sl_geojson_add_count(out, "reflections", part->depth);
        sl_geojson_add_real(out, "area", sl_region_area(&part->region));
        sl_geojson_end_feature(out);
    }
}

void seen_parts_destroy(sl_context *context, seen_parts *parts) {
    for (size_t i = 0; i < parts->count; i++)
        sl_free(context, (void *)(uintptr_t)parts->items[i].points);
    sl_free(context, parts->items);
    *parts = (seen_parts){0};
}

/// Eyes from points, grids, paths and tables; a region and its measures for each, thread by thread.
#include "studies/isovist.h"

#include "inputs/inputs.h"
#include "inputs/within.h"
#include "reports/fields.h"
#include "sightline/support.h"
#include "studies/eye_run.h"
#include "system/built.h"

#include <math.h>
#include <stdint.h>
#include <string.h>

// --- eyes

enum { MOST_SQUARES = 1 << 26 };

void eyes_destroy(sl_context *context, eye_places *eyes) {
    sl_free(context, eyes->list.items);
    sl_free(context, eyes->squares.items);
    sl_cameras_destroy(context, &eyes->table);
    *eyes = (eye_places){0};
}

sl_status eyes_add(sl_context *context, eye_places *eyes, eye_place eye) {
    SL_TRY(SL_ARRAY_ROOM(context, &eyes->list, 1));
    eyes->list.items[eyes->list.count++] = eye;
    return SL_OK;
}

sl_status eyes_add_grid(sl_context *context, const sl_space *space, double step, eye_place like,
                        eye_places *eyes) {
    const sl_box *b = &space->bounds;
    const double columns = ceil((b->max.x - b->min.x) / step);
    const double rows = ceil((b->max.y - b->min.y) / step);
    if (!(columns * rows <= MOST_SQUARES))
        return sl_fail(context, SL_BAD_ARGUMENT,
                       "a grid of step %g has more than %d squares: take a longer step", step,
                       MOST_SQUARES);
    eyes->corner = b->min;
    eyes->step = step;
    eyes->columns = (size_t)columns;
    eyes->rows = (size_t)rows;
    for (size_t i = 0; i < eyes->columns * eyes->rows; i++) {
        if (i % 65536 == 0) SL_TRY(sl_check_cancelled(context));
        like.at.x = b->min.x + step * ((double)(i % eyes->columns) + 0.5);
        like.at.y = b->min.y + step * ((double)(i / eyes->columns) + 0.5);
        const uint32_t cell = sl_space_locate(space, like.at);
        if (cell == SL_NO_CELL || !space->cells[cell].inside) continue;
        SL_TRY(SL_ARRAY_ROOM(context, &eyes->squares, 1));
        eyes->squares.items[eyes->squares.count++] = i;
        SL_TRY(eyes_add(context, eyes, like));
    }
    if (eyes->list.count) return SL_OK;
    return sl_fail(context, SL_BAD_ARGUMENT,
                   "a grid of step %.9g has no point inside the map; choose a smaller step", step);
}

void eyes_keep_within(const sl_map *outlines, eye_places *eyes) {
    size_t kept = 0;
    for (size_t i = 0; i < eyes->list.count; i++) {
        if (!within_has(outlines, eyes->list.items[i].at)) continue;
        eyes->list.items[kept] = eyes->list.items[i];
        eyes->squares.items[kept++] = eyes->squares.items[i];
    }
    eyes->list.count = eyes->squares.count = kept;
}

sl_status eyes_add_path(sl_context *context, const sl_path *path, double step, eye_place like,
                        eye_places *eyes) {
    double over = 0; // from the last eye to the point reached
    for (size_t i = 0; i < path->count; i++) {
        const sl_point to = path->points[i];
        if (i == 0 || step == 0) {
            like.at = to;
            SL_TRY(eyes_add(context, eyes, like));
            continue;
        }
        const sl_point from = path->points[i - 1];
        const double length = hypot(to.x - from.x, to.y - from.y);
        if (length / step > MOST_SQUARES)
            return sl_fail(context, SL_BAD_ARGUMENT, "--step %g: too small for path '%s'", step,
                           path->name);
        double along = step - over;
        for (; along <= length; along += step) {
            like.at = (sl_point){from.x + along / length * (to.x - from.x),
                                 from.y + along / length * (to.y - from.y)};
            SL_TRY(eyes_add(context, eyes, like));
        }
        over = length - (along - step);
    }
    return SL_OK;
}

sl_status eyes_read_table(sl_context *context, const char *path, const sl_space *space,
                          eye_place like, eye_places *eyes) {
    const sl_viewpoint usual = {.heading = like.heading, .fov = like.fov, .range = like.range};
    SL_TRY(sl_cameras_read(context, path, &usual, &eyes->table));
    bool dead_zones = false;
    for (size_t i = 0; i < eyes->table.count; i++) {
        const sl_viewpoint *v = &eyes->table.items[i].view;
        dead_zones |= v->nearest > 0;
        SL_TRY(input_check_place(context, path, eyes->table.items[i].line, space, v->at));
        SL_TRY(eyes_add(context, eyes, (eye_place){v->at, v->heading, v->fov, v->range}));
    }
    if (dead_zones)
        sl_note(context, "%s: dead zones do not count here; sightline cover counts them", path);
    return SL_OK;
}

// --- parts

sl_status isovist_part_sizes(sl_context *context, sl_query *query, const eye_places *eyes,
                             uint32_t *sizes) {
    const sl_space *space;
    SL_TRY(sl_query_space(context, query, &space, NULL));
    const uint32_t cells = space->cell_count;
    const size_t count = eyes->list.count;
    uint32_t *parent = sl_alloc_array(context, (size_t)cells + 1, sizeof *parent);
    uint32_t *points = sl_alloc_array(context, (size_t)cells + 1, sizeof *points);
    const bool room = parent && points;
    for (uint32_t c = 0; room && c < cells; c++) parent[c] = c;
    for (uint32_t c = 0; room && c < cells; c++) {
        const sl_directed_portal *directed = &space->directed[space->cells[c].first_directed];
        for (uint32_t i = 0; i < space->cells[c].directed_count; i++)
            parent[sl_root_of(parent, c)] = sl_root_of(parent, directed[i].cell);
    }
    for (size_t i = 0; room && i < count; i++) {
        const uint32_t cell = sl_query_locate(query, eyes->list.items[i].at);
        sizes[i] = cell == SL_NO_CELL ? cells : sl_root_of(parent, cell);
        points[sizes[i]]++;
    }
    for (size_t i = 0; room && i < count; i++) sizes[i] = points[sizes[i]];
    sl_free(context, parent);
    sl_free(context, points);
    return room ? SL_OK : SL_NO_MEMORY;
}

// --- measures

enum { EYES_A_BUNDLE = 64 };

void isovist_put_measures(sl_geojson_writer *out, const sl_region_measures *all) {
    size_t count;
    const sl_measure *measures = sl_measures(SL_ISOVIST, &count);
    for (size_t i = 0; i < count; i++)
        sl_geojson_add_real(out, measures[i].name, sl_measure_value(&measures[i], all));
}

sl_view eye_view(const sl_space *space, const eye_place *eye) {
    const sl_box *b = &space->bounds;
    const double reach = fmax(b->max.x - b->min.x, b->max.y - b->min.y);
    return sl_view_cone(eye->at, eye->heading, eye->fov, reach);
}

/// How far an eye sees: as far as all, or less.
static double range_of(const isovist_scene *scene, const eye_place *eye) {
    const bool less = eye->range > 0 && !(scene->range > 0 && scene->range < eye->range);
    return less ? eye->range : scene->range;
}

/// Looks as far as the query is set to see.
static sl_status look_so_far(sl_context *context, const isovist_scene *scene, const eye_place *eye,
                             sl_mirrored_region *out) {
    const sl_view view = eye_view(scene->space, eye);
    return scene->mirrored ? sl_query_mirrored_region(context, scene->query, &view, out)
                           : sl_query_region(context, scene->query, &view, &out->direct);
}

sl_status isovist_look(sl_context *context, const isovist_scene *scene, const eye_place *eye,
                       sl_mirrored_region *out) {
    SL_TRY(sl_query_set_range(context, scene->query, range_of(scene, eye)));
    return look_so_far(context, scene, eye, out);
}

/// The eyes of one range: the query has one range for all threads.
typedef struct job {
    const isovist_scene *scene;
    const eye_places *eyes;
    double range;
    size_t first, stop; ///< eyes to measure
    isovist_result *out;
} job;

static sl_status begin_isovist_worker(sl_context *context, void *all, void **state) {
    (void)all;
    *state = sl_alloc_array(context, 1, sizeof(sl_mirrored_region));
    return *state ? SL_OK : SL_NO_MEMORY;
}

static sl_status measure_bundle(sl_context *context, void *all, void *state, size_t bundle) {
    const job *j = all;
    sl_mirrored_region *region = state;
    const sl_space *space = j->scene->space;
    const size_t first = j->first + bundle * EYES_A_BUNDLE;
    for (size_t i = first; i < j->stop && i < first + EYES_A_BUNDLE; i++) {
        const eye_place *eye = &j->eyes->list.items[i];
        if (range_of(j->scene, eye) != j->range) continue;
        SL_TRY(sl_check_cancelled(context));
        SL_TRY(look_so_far(context, j->scene, eye, region));
        j->out[i] = (isovist_result){
            sl_region_measure(&region->direct), sl_region_corners(&region->direct, space, NULL, 0),
            sl_mirrored_area(region), region->part_count, sl_region_meets_border(&region->direct)};
    }
    return SL_OK;
}

static void end_isovist_worker(sl_context *context, void *all, void *state) {
    (void)all;
    sl_mirrored_region_destroy(context, state);
    sl_free(context, state);
}

sl_status isovist_run(sl_context *context, const isovist_scene *scene, const eye_places *eyes,
                      const table_part *part, unsigned threads, isovist_result *out) {
    job j = {.scene = scene, .eyes = eyes, .stop = eyes->list.count, .out = out};
    if (part) table_part_rows(part, eyes->list.count, &j.first, &j.stop);
    const sl_work work = {.job = &j,
                          .begin = begin_isovist_worker,
                          .unit = measure_bundle,
                          .end = end_isovist_worker,
                          .stage = "isovist",
                          .units = "bundles of eyes"};
    const size_t bundles = (j.stop - j.first + EYES_A_BUNDLE - 1) / EYES_A_BUNDLE;
    for (bool more = true, first = true; more; first = false) {
        // The smallest range that is left.
        const double done = j.range;
        more = false;
        for (size_t i = 0; i < eyes->list.count; i++) {
            const double range = range_of(scene, &eyes->list.items[i]);
            if ((!first && range <= done) || (more && range >= j.range)) continue;
            j.range = range;
            more = true;
        }
        if (!more) break;
        SL_TRY(sl_query_set_range(context, scene->query, j.range));
        SL_TRY(sl_work_run(context, &work, bundles, threads));
    }
    return SL_OK;
}

/// What the table is of.
typedef struct isovist_rows {
    bool mirrored;
    const eye_places *eyes;
    const isovist_result *isovists;
} isovist_rows;

/// The columns of the table, and the properties of the region.
static size_t list_fields(const void *of, size_t row, table_field fields[FIELDS_MOST]) {
    const isovist_rows *rows = of;
    const eye_place *eye = &rows->eyes->list.items[row];
    const isovist_result *isovist = &rows->isovists[row];
    size_t measure_count, count = 0;
    const sl_measure *measures = sl_measures(SL_ISOVIST, &measure_count);
    fields[count++] = field_real("x", eye->at.x);
    fields[count++] = field_real("y", eye->at.y);
    fields[count++] = field_real("heading", eye->heading);
    fields[count++] = field_real("fov", eye->fov);
    for (size_t k = 0; k < measure_count; k++)
        fields[count++] =
            field_real(measures[k].name, sl_measure_value(&measures[k], &isovist->measures));
    fields[count++] = field_count("corners", isovist->corners);
    if (rows->mirrored) fields[count++] = field_real("mirrored_area", isovist->mirrored_area);
    if (rows->mirrored) fields[count++] = field_count("parts", isovist->parts);
    return count;
}

static sl_status put_eye(sl_context *context, sl_geojson_writer *out, const isovist_scene *scene,
                         const field_rows *rows, size_t row, sl_mirrored_region *region) {
    const isovist_rows *of = rows->of;
    seen_parts parts = {0};
    SL_TRY(isovist_look(context, scene, &of->eyes->list.items[row], region));
    const sl_status status = seen_parts_add(context, scene->space, region, true, &parts);
    if (status == SL_OK) {
        sl_geojson_put_polygon(out, "isovist", parts.items[0].points, parts.items[0].count);
        fields_add_properties(out, rows, row);
        sl_geojson_end_feature(out);
        seen_parts_put_mirrored(out, region, parts.items + 1);
    }
    seen_parts_destroy(context, &parts);
    return status;
}

/// Regions are found anew: those of all eyes at once may take much memory.
static sl_status write_places(sl_context *context, const isovist_scene *scene,
                              const field_rows *rows, FILE *file) {
    sl_geojson_writer out = sl_geojson_begin(file, &scene->earth);
    sl_mirrored_region region = {0};
    sl_status status = SL_OK;
    for (size_t i = 0; i < rows->count && status == SL_OK && !ferror(file); i++) {
        status = sl_check_cancelled(context);
        if (status == SL_OK) status = put_eye(context, &out, scene, rows, i, &region);
        sl_report(context, "write", "regions", i + 1, rows->count);
    }
    sl_mirrored_region_destroy(context, &region);
    sl_geojson_end(&out);
    return status;
}

/// What is seen by mirror is on a layer of its own.
static sl_status write_dxf(sl_context *context, const isovist_scene *scene, const eye_places *eyes,
                           const char *path) {
    const built_io *io;
    SL_TRY(built_need_io(context, path, &io));
    seen_parts parts = {0};
    SL_ARRAY(sl_polyline) lines = {0};
    sl_mirrored_region region = {0};
    sl_status status = SL_OK;
    for (size_t i = 0; i < eyes->list.count && status == SL_OK; i++) {
        const size_t first = parts.count;
        status = isovist_look(context, scene, &eyes->list.items[i], &region);
        if (status == SL_OK) status = seen_parts_add(context, scene->space, &region, true, &parts);
        if (status == SL_OK) status = SL_ARRAY_ROOM(context, &lines, parts.count - first);
        for (size_t k = first; k < parts.count && status == SL_OK; k++)
            if (parts.items[k].count > 2)
                lines.items[lines.count++] =
                    (sl_polyline){.layer = k == first ? "ISOVIST" : "ISOVIST-MIRRORED",
                                  .points = parts.items[k].points,
                                  .count = parts.items[k].count,
                                  .closed = true};
    }
    if (status == SL_OK)
        status = io->polylines_dxf(context, lines.items, lines.count, scene->unit, path);
    sl_mirrored_region_destroy(context, &region);
    seen_parts_destroy(context, &parts);
    sl_free(context, lines.items);
    return status;
}

sl_status isovist_write(sl_context *context, const isovist_scene *scene, const eye_places *eyes,
                        const isovist_result *isovists, const table_part *part, const char *path) {
    const isovist_rows of = {scene->mirrored, eyes, isovists};
    const field_rows rows = {list_fields, &of, eyes->list.count};
    if (name_ends_with(path, ".dxf")) return write_dxf(context, scene, eyes, path);
    if (!name_ends_with(path, ".geojson")) return table_part_write(context, part, &rows, path);
    sl_output output;
    SL_TRY(sl_output_open(context, path, &output));
    return sl_output_close(context, &output, write_places(context, scene, &rows, output.stream));
}

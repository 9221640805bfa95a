/// What an eye sees, as GeoJSON or CSV: each cell that some method keeps, with a yes or no for each
/// method.
#include "studies/eye_files.h"

#include "inputs/inputs.h"
#include "sightline/support.h"
#include "studies/isovist.h"

#include <inttypes.h>
#include <stdio.h>

/// A set of cells, and what a table calls it.
typedef struct named_set {
    char name[64];
    const uint64_t *cells;
} named_set;

enum { SETS_MOST = 2 * SL_EYE_LAYERS_MOST + 2 };

static void add_set(named_set *sets, size_t *count, const char *lead, const char *name,
                    const uint64_t *cells) {
    if (!cells || *count == SETS_MOST) return;
    named_set *set = &sets[(*count)++];
    snprintf(set->name, sizeof set->name, "%s%s", lead, name);
    set->cells = cells;
}

/// Direct sight by each method, what each sees by mirror, and the cells seen past objects.
static size_t find_sets(const eye_run *run, const eye_objects *objects, named_set *sets) {
    size_t methods, count = 0;
    const sl_eye_method *table = sl_eye_methods(&methods);
    for (size_t i = 0; i < methods; i++)
        add_set(sets, &count, "", table[i].name, run->results[i].cells);
    for (size_t i = 0; i < methods; i++)
        add_set(sets, &count, "mirrored_", table[i].name, run->results[i].mirrored);
    if (!objects->count) return count;
    add_set(sets, &count, "", "past_objects", objects->cells);
    if (objects->has_mirrors)
        add_set(sets, &count, "", "mirrored_past_objects", objects->mirrored_cells);
    return count;
}

static bool is_kept(const named_set *sets, size_t count, uint32_t cell) {
    for (size_t i = 0; i < count; i++)
        if (sl_bits_has(sets[i].cells, cell)) return true;
    return false;
}

static void write_rows(const sl_baked *baked, const named_set *sets, size_t count, FILE *file) {
    fputs("cell", file);
    for (size_t i = 0; i < count; i++) fprintf(file, ",%s", sets[i].name);
    putc('\n', file);
    for (uint32_t cell = 0; cell < baked->space.cell_count; cell++) {
        if (!is_kept(sets, count, cell)) continue;
        fprintf(file, "%" PRIu32, cell);
        for (size_t i = 0; i < count; i++)
            fputs(sl_bits_has(sets[i].cells, cell) ? ",1" : ",0", file);
        putc('\n', file);
    }
}

static void put_region(sl_geojson_writer *out, const char *kind, const sl_region *region,
                       const sl_drawn_region *part) {
    const sl_region_measures measures = sl_region_measure(region);
    sl_geojson_put_polygon(out, kind, part->points, part->count);
    isovist_put_measures(out, &measures);
    sl_geojson_end_feature(out);
}

static void put_cells(sl_geojson_writer *out, const sl_baked *baked, const named_set *sets,
                      size_t count) {
    for (uint32_t i = 0; i < baked->space.cell_count && !ferror(out->stream); i++) {
        const sl_cell *cell = &baked->space.cells[i];
        if (!is_kept(sets, count, i)) continue;
        sl_geojson_put_polygon(out, "cell", baked->space.vertices + cell->first_vertex,
                               cell->vertex_count);
        sl_geojson_add_count(out, "id", i);
        sl_geojson_add_flag(out, "inside", cell->inside);
        for (size_t k = 0; k < count; k++)
            sl_geojson_add_flag(out, sets[k].name, sl_bits_has(sets[k].cells, i));
        sl_geojson_end_feature(out);
    }
}

static void put_objects(sl_geojson_writer *out, const eye_objects *objects) {
    for (size_t i = 0; i < objects->count; i++) {
        const sl_box b = objects->boxes[i].box;
        const sl_point corners[4] = {b.min, {b.max.x, b.min.y}, b.max, {b.min.x, b.max.y}};
        char name[256];
        text_make_readable(objects->objects[i].text, name, sizeof name);
        sl_geojson_put_polygon(out, "object", corners, 4);
        sl_geojson_add_text(out, "name", name);
        sl_geojson_add_flag(out, "blocks", objects->boxes[i].blocks);
        sl_geojson_add_flag(out, "seen", objects->seen[i]);
        if (objects->has_mirrors) sl_geojson_add_flag(out, "mirrored", objects->mirrored[i]);
        sl_geojson_end_feature(out);
    }
}

/// The region, and with objects the region past them. `parts` has all of it as polygons.
static void put_regions(sl_geojson_writer *out, const eye_run *run, const eye_objects *objects,
                        const sl_drawn_region *parts) {
    const sl_mirrored_region *mirrored =
        objects->count ? &objects->mirrored_region : &run->mirrored;
    put_region(out, "region", &run->region, parts++);
    if (objects->count) put_region(out, "region_past_objects", &objects->region, parts++);
    seen_parts_put_mirrored(out, mirrored, parts);
}

static sl_status gather_parts(sl_context *context, const sl_space *space, const eye_run *run,
                              const eye_objects *objects, seen_parts *parts) {
    SL_TRY(seen_parts_add_region(context, space, &run->region, parts));
    if (!objects->count) return seen_parts_add(context, space, &run->mirrored, false, parts);
    SL_TRY(seen_parts_add_region(context, space, &objects->region, parts));
    return seen_parts_add(context, space, &objects->mirrored_region, false, parts);
}

sl_status eye_files_write(sl_context *context, const sl_baked *baked, const eye_run *run,
                          const eye_objects *objects, double heading, double fov,
                          const char *path) {
    named_set sets[SETS_MOST];
    const size_t count = find_sets(run, objects, sets);
    seen_parts parts = {0};
    sl_output output;
    SL_TRY(sl_output_open(context, path, &output));
    sl_status status = SL_OK;
    if (!name_ends_with(path, ".geojson")) {
        write_rows(baked, sets, count, output.stream);
    } else if ((status = gather_parts(context, &baked->space, run, objects, &parts)) == SL_OK) {
        sl_geojson_writer out = sl_geojson_begin(output.stream, &baked->map.earth);
        sl_geojson_put_point(&out, "eye", run->view.eye);
        sl_geojson_add_count(&out, "cell", run->cell);
        sl_geojson_add_real(&out, "heading", heading);
        sl_geojson_add_real(&out, "fov", fov);
        sl_geojson_end_feature(&out);
        put_regions(&out, run, objects, parts.items);
        put_objects(&out, objects);
        put_cells(&out, baked, sets, count);
        sl_geojson_end(&out);
    }
    seen_parts_destroy(context, &parts);
    return sl_output_close(context, &output, status);
}

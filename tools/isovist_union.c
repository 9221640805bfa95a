#include "isovist_union.h"

#include "inputs.h"
#include "sightline/support.h"
#include "within.h"

#include <math.h>

void isovist_union_destroy(sl_context *context, isovist_union *all) {
    sl_space_destroy(context, &all->pieces);
    sl_free(context, all->counts);
    sl_free(context, all->areas);
    *all = (isovist_union){0};
}

static sl_status cut(sl_context *context, const seen_parts *regions, sl_space *pieces) {
    sl_map map = {0};
    sl_status status = SL_OK;
    for (size_t i = 0; i < regions->count; i++) {
        const sl_drawn_region *region = &regions->items[i];
        for (size_t k = 0; k < region->count && status == SL_OK; k++)
            status = sl_map_add_wall(context, &map, region->points[k],
                                     region->points[k + 1 < region->count ? k + 1 : 0], 0);
    }
    if (map.wall_count) {
        if (status == SL_OK) status = sl_map_clean(context, &map, NULL, NULL);
        if (status == SL_OK)
            status = sl_subdivision_for(&map)->subdivide(context, &map, NULL, pieces);
    }
    sl_map_destroy(context, &map);
    return status;
}

static sl_box box_of(const sl_drawn_region *region) {
    sl_box box = {region->eye, region->eye};
    for (size_t i = 0; i < region->count; i++) {
        const sl_point p = region->points[i];
        box.min = (sl_point){fmin(box.min.x, p.x), fmin(box.min.y, p.y)};
        box.max = (sl_point){fmax(box.max.x, p.x), fmax(box.max.y, p.y)};
    }
    return box;
}

static bool holds(const sl_drawn_region *region, sl_point p) {
    bool within = false;
    for (size_t i = 0; i < region->count; i++)
        within ^=
            within_crosses(p, region->points[i], region->points[i + 1 < region->count ? i + 1 : 0]);
    return within;
}

/// No outline passes through a piece, so its middle says where all of it is.
static sl_status count_regions(sl_context *context, const seen_parts *regions, isovist_union *all) {
    const sl_space *pieces = &all->pieces;
    sl_point *middles = sl_alloc_array(context, pieces->cell_count, sizeof *middles);
    sl_status status = middles ? SL_OK : SL_NO_MEMORY;
    for (uint32_t c = 0; c < pieces->cell_count && middles; c++)
        middles[c] = sl_space_middle(pieces, c);
    for (size_t i = 0; i < regions->count && status == SL_OK; i++) {
        const sl_box box = box_of(&regions->items[i]);
        status = sl_check_cancelled(context);
        for (uint32_t c = 0; c < pieces->cell_count; c++) {
            const sl_point p = middles[c];
            if (p.x >= box.min.x && p.x <= box.max.x && p.y >= box.min.y && p.y <= box.max.y)
                all->counts[c] += holds(&regions->items[i], p);
        }
    }
    sl_free(context, middles);
    return status;
}

static sl_status make(sl_context *context, const sl_space *space, const seen_parts *regions,
                      isovist_union *all) {
    SL_TRY(cut(context, regions, &all->pieces));
    all->count = regions->count;
    all->counts = sl_alloc_array(context, all->pieces.cell_count, sizeof *all->counts);
    all->areas = sl_alloc_array(context, all->count + 1, sizeof *all->areas);
    if (!all->counts || !all->areas) return SL_NO_MEMORY;
    SL_TRY(count_regions(context, regions, all));
    for (uint32_t c = 0; c < space->cell_count; c++)
        if (space->cells[c].inside) all->areas[0] += sl_space_area(space, c);
    for (uint32_t c = 0; c < all->pieces.cell_count; c++)
        if (all->counts[c]) all->areas[all->counts[c]] += sl_space_area(&all->pieces, c);
    for (size_t k = all->count; k-- > 1;) all->areas[k] += all->areas[k + 1];
    return SL_OK;
}

sl_status isovist_union_make(sl_context *context, const sl_space *space, const seen_parts *regions,
                             isovist_union *out) {
    isovist_union all = {0};
    const sl_status status = make(context, space, regions, &all);
    if (status == SL_OK)
        *out = all;
    else
        isovist_union_destroy(context, &all);
    return status;
}

// --- files

static void put_rows(const isovist_union *all, FILE *out) {
    char area[SL_NUMBER_TEXT], share[SL_NUMBER_TEXT];
    fputs("viewpoints,area,share\n", out);
    for (size_t k = 0; k <= all->count && (k < 2 || all->areas[k] > 0); k++) {
        sl_number_write(all->areas[k], area);
        sl_number_write(all->areas[k] / all->areas[0], share);
        fprintf(out, "%zu,%s,%s\n", k, area, share);
    }
}

static void put_pieces(const isovist_union *all, FILE *file) {
    sl_geojson_writer out = sl_geojson_begin(file);
    for (uint32_t c = 0; c < all->pieces.cell_count && !ferror(file); c++) {
        const sl_cell *cell = &all->pieces.cells[c];
        if (!all->counts[c]) continue;
        sl_geojson_put_polygon(&out, "seen", all->pieces.vertices + cell->first_vertex,
                               cell->vertex_count);
        sl_geojson_add_count(&out, "viewpoints", all->counts[c]);
        sl_geojson_add_real(&out, "area", sl_space_area(&all->pieces, c));
        sl_geojson_end_feature(&out);
    }
    sl_geojson_end(&out);
}

sl_status isovist_union_write(sl_context *context, const isovist_union *all, const char *path) {
    sl_output output;
    SL_TRY(sl_output_open(context, path, &output));
    if (input_ends_with(path, ".geojson"))
        put_pieces(all, output.stream);
    else
        put_rows(all, output.stream);
    return sl_output_close(context, &output, SL_OK);
}

/// The union of regions, by the library, and its pieces as GeoJSON.
#include "studies/isovist_union.h"

#include "inputs/inputs.h"
#include "sightline/support.h"

sl_status isovist_union_make(sl_context *context, const sl_space *space, const seen_parts *regions,
                             sl_overlay *out) {
    sl_shape inside = {0}, *shapes = sl_alloc_array(context, regions->count, sizeof *shapes);
    sl_status status = shapes ? sl_shape_of_inside(context, space, &inside) : SL_NO_MEMORY;
    for (size_t i = 0; i < regions->count && shapes; i++)
        shapes[i] = (sl_shape){regions->items[i].points, &regions->items[i].count, 1};
    if (status == SL_OK) status = sl_overlay_make(context, &inside, shapes, regions->count, out);
    sl_shape_destroy(context, &inside);
    sl_free(context, shapes);
    if (status != SL_OK) return status;
    out->areas[0] = 0; // of the plan itself: no crossing of outlines has rounded it
    for (uint32_t c = 0; c < space->cell_count; c++)
        if (space->cells[c].inside) out->areas[0] += sl_space_area(space, c);
    return SL_OK;
}

static void put_rows(const sl_overlay *all, FILE *out) {
    char area[SL_NUMBER_TEXT], share[SL_NUMBER_TEXT];
    fputs("viewpoints,area,share\n", out);
    for (size_t k = 0; k <= all->shape_count && (k < 2 || all->areas[k] > 0); k++) {
        sl_number_write(all->areas[k], area);
        sl_number_write(all->areas[k] / all->areas[0], share);
        fprintf(out, "%zu,%s,%s\n", k, area, share);
    }
}

static void put_pieces(const sl_overlay *all, const sl_earth *earth, FILE *file) {
    sl_geojson_writer out = sl_geojson_begin(file, earth);
    for (uint32_t c = 0; c < all->pieces.cell_count && !ferror(file); c++) {
        const sl_cell *cell = &all->pieces.cells[c];
        if (!all->counts[c] || !cell->inside) continue;
        sl_geojson_put_polygon(&out, "seen", all->pieces.vertices + cell->first_vertex,
                               cell->vertex_count);
        sl_geojson_add_count(&out, "viewpoints", all->counts[c]);
        sl_geojson_add_real(&out, "area", sl_space_area(&all->pieces, c));
        sl_geojson_end_feature(&out);
    }
    sl_geojson_end(&out);
}

sl_status isovist_union_write(sl_context *context, const sl_overlay *all, const sl_earth *earth,
                              const char *path) {
    sl_output output;
    SL_TRY(sl_output_open(context, path, &output));
    if (name_ends_with(path, ".geojson"))
        put_pieces(all, earth, output.stream);
    else
        put_rows(all, output.stream);
    return sl_output_close(context, &output, SL_OK);
}

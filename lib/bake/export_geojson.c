/// The export of a baked file as GeoJSON.
#include "bake/export.h"
#include "sightline/json.h"
#include "sightline/support.h"
#include "space/walled.h"

// --- the export of a baked file

static void put_cell(sl_geojson_writer *out, const sl_baked *baked, uint32_t number) {
    const sl_space *space = &baked->space;
    const sl_cell *cell = &space->cells[number];
    sl_geojson_put_polygon(out, "cell", space->vertices + cell->first_vertex, cell->vertex_count);
    sl_geojson_add_count(out, "id", number);
    sl_geojson_add_flag(out, "inside", cell->inside);
    sl_geojson_add_flag(out, "solid", cell->solid);
    sl_geojson_add_count(out, "sees", sl_pvs_count(&baked->visibility.pvs, number));
    sl_geojson_end_feature(out);
}

/// What a wall stops that does not stop all.
static void put_stops(sl_geojson_writer *out, uint32_t stops) {
    char text[SL_STOPS_TEXT];
    sl_stops_write(stops, text);
    if (stops) sl_geojson_add_text(out, "stops", text);
}

static void put_portal(sl_geojson_writer *out, const sl_baked *baked, uint32_t number) {
    const sl_portal *portal = &baked->space.portals[number];
    const sl_door *door = sli_portal_door(baked, number);
    const char *oneway = sli_glass_name(sli_portal_glass(&baked->space, number));
    sl_geojson_put_line(out, "portal", portal->left, portal->right);
    sl_json_put_key(&out->json, "cells");
    sl_json_put_list(&out->json);
    sl_json_put_integer(&out->json, portal->cell[0]);
    sl_json_put_integer(&out->json, portal->cell[1]);
    sl_json_put_end(&out->json, ']');
    if (door) sl_geojson_add_text(out, "door", door->name);
    if (oneway) sl_geojson_add_text(out, "oneway", oneway);
    put_stops(out, sli_portal_stops(&baked->map, &baked->space, number));
    sl_geojson_end_feature(out);
}

static void put_doors(sl_geojson_writer *out, const sl_baked *baked) {
    for (uint32_t i = 0; i < baked->space.seam_count; i++) {
        const sl_seam *seam = &baked->space.seams[i];
        if (seam->kind != SL_SEAM_DOOR) continue;
        const sl_door *door = &baked->map.doors[seam->number];
        sl_geojson_put_line(out, "door", seam->at.a, seam->at.b);
        sl_geojson_add_text(out, "name", door->name);
        sl_geojson_add_flag(out, "open", door->open);
        sl_geojson_end_feature(out);
    }
}

static void put_glass(sl_geojson_writer *out, const char *kind, const sl_glass *glass,
                      size_t count) {
    for (size_t i = 0; i < count; i++) {
        sl_geojson_put_line(out, kind, glass[i].segment.a, glass[i].segment.b);
        sl_geojson_end_feature(out);
    }
}

static void put_starts(sl_geojson_writer *out, const sl_map *map) {
    for (size_t i = 0; i < map->start_count; i++) {
        sl_geojson_put_point(out, "start", map->starts[i].at);
        sl_geojson_add_real(out, "heading", map->starts[i].heading);
        sl_geojson_end_feature(out);
    }
}

static sl_status put_all(sl_context *context, const sl_baked *baked, FILE *stream) {
    const sl_space *space = &baked->space;
    const sl_map *map = &baked->map;
    sl_geojson_writer out = sl_geojson_begin(stream, &map->earth);
    for (uint32_t i = 0; i < space->cell_count && !ferror(stream); i++) put_cell(&out, baked, i);
    SL_TRY(sl_check_cancelled(context));
    for (uint32_t i = 0; i < space->portal_count && !ferror(stream); i++)
        put_portal(&out, baked, i);
    SL_TRY(sl_check_cancelled(context));
    for (uint32_t i = 0, passage = 0; i < space->wall_count && !ferror(stream); i++) {
        const bool passed = passage < space->passage_count && space->passages[passage].wall == i;
        sl_geojson_put_line(&out, "wall", space->walls[i].a, space->walls[i].b);
        if (passed) put_stops(&out, space->passages[passage++].stops);
        sl_geojson_end_feature(&out);
    }
    put_doors(&out, baked);
    put_glass(&out, "mirror", map->mirrors, map->mirror_count);
    put_glass(&out, "oneway", map->oneways, map->oneway_count);
    put_starts(&out, map);
    sl_geojson_end(&out);
    return sl_check_cancelled(context);
}

sl_status sli_export_geojson(sl_context *context, const sl_baked *baked,
                             const sl_export_options *options, const char *path) {
    (void)options;
    sl_output output;
    SL_TRY(sl_output_open(context, path, &output));
    return sl_output_close(context, &output, put_all(context, baked, output.stream));
}

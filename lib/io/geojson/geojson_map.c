/// GeoJSON as a map: outlines of rooms, walls, openings; or all lines as they are drawn.
#include "geometry/orient.h"
#include "io/geojson/geojson.h"
#include "io/io_formats.h"
#include "io/parts/names.h"
#include "io/parts/shapes.h"
#include "map/source.h"
#include "sightline/io.h"

#include <math.h>
#include <string.h>
#include <strings.h>

// --- which features

static bool has_meaning(const sli_geo *geo, sli_geo_meaning means) {
    for (size_t i = 0; i < geo->features.count; i++) {
        const sli_geo_feature *f = &geo->features.items[i];
        if (f->means == means && f->count && geo->lines.items[f->first].count > 1) return true;
    }
    return false;
}

static bool is_layer(const sli_geo_feature *feature, sli_word name) {
    return strlen(feature->layer) == name.length &&
           strncasecmp(feature->layer, name.at, name.length) == 0;
}

/// SL_BAD_ARGUMENT for a layer that no feature is on.
static sl_status check_layers(const sli_geo *geo) {
    const char *list = geo->options->layers;
    for (sli_word name; list && sli_layers_next(&list, &name);) {
        bool found = false;
        sli_name_list there = {0};
        const char *last = "";
        for (size_t i = 0; i < geo->features.count && !found; i++) {
            const sli_geo_feature *f = &geo->features.items[i];
            found = is_layer(f, name);
            if (*f->layer && strcmp(f->layer, last) != 0 && !strstr(there.text, f->layer))
                sli_name_list_add(&there, (sli_word){f->layer, strlen(f->layer)});
            last = f->layer;
        }
        if (!found) return sli_fail_layer(geo->context, geo->name, name, "file", &there);
    }
    return SL_OK;
}

static bool is_asked_for(const sli_geo *geo, const sli_geo_feature *feature) {
    const char *list = geo->options->layers;
    for (sli_word name; list && sli_layers_next(&list, &name);)
        if (is_layer(feature, name)) return true;
    return false;
}

/// SL_BAD_INPUT where the lines are streets and their like: no walls.
static sl_status refuse_ways(const sli_geo *geo) {
    size_t ways = 0;
    const char *layer = "";
    for (size_t i = 0; i < geo->features.count; i++) {
        if (geo->features.items[i].means != SLI_GEO_WAY) continue;
        ways++;
        layer = geo->features.items[i].layer;
    }
    return sl_fail_at(
        geo->context, geo->name, 0,
        "nothing in it is a wall: %zu feature%s a street, a meadow or the like (%s); sightline "
        "segments measures them; --layers %s takes them as walls",
        ways, ways == 1 ? " is" : "s are each", layer, layer);
}

/// Walls are the features that say so. Where none does: those that say nothing; and where all say
/// something else, all.
static sl_status choose(sli_geo *geo) {
    const sl_import_options *options = geo->options;
    const sli_geo_meaning walls = options->layers ? SLI_GEO_WALL : sli_geo_means_walls(geo);
    SL_TRY(check_layers(geo));
    const bool free = !options->layers && !options->lines;
    if (free && walls != SLI_GEO_WALL && has_meaning(geo, SLI_GEO_WAY)) return refuse_ways(geo);
    geo->guessed = free && walls == SLI_GEO_UNSAID;
    for (size_t i = 0; i < geo->features.count; i++) {
        sli_geo_feature *f = &geo->features.items[i];
        const bool asked = is_asked_for(geo, f);
        const bool other =
            f->means == SLI_GEO_UNSAID || f->means == SLI_GEO_WAY || f->means == SLI_GEO_NO_WALL;
        // Without layers asked for, nothing is `asked`.
        const bool wall =
            options->layers ? options->lines && asked : options->lines || f->means == walls;
        if (wall)
            f->means = SLI_GEO_WALL;
        else if (asked)
            f->means = other ? SLI_GEO_WALL : f->means;
        else if (other || f->means == SLI_GEO_WALL)
            f->means = SLI_GEO_NO_WALL;
        f->taken = f->means != SLI_GEO_NO_WALL &&
                   (!options->map || sli_geo_on_level(geo, f, options->map));
    }
    return SL_OK;
}

// --- the map

static sl_status add_lines(sli_geo *geo, const sli_geo_feature *feature, uint32_t item) {
    for (size_t k = 0; k < feature->count; k++) {
        const sli_geo_line line = geo->lines.items[feature->first + k];
        const sl_point *p = geo->points.items + line.first;
        if (line.ring && geo->without_rings) continue;
        for (size_t i = 1; i < line.count; i++)
            if (p[i].x != p[i - 1].x || p[i].y != p[i - 1].y)
                SL_TRY(sl_map_add_wall(geo->context, geo->map, p[i - 1], p[i], item));
    }
    return SL_OK;
}

/// Mirrors, one-way glass and starts, as our own exports write them.
static sl_status add_other(sli_geo *geo, const sli_geo_feature *feature, uint32_t item) {
    const sli_geo_line line = geo->lines.items[feature->first];
    if (!line.count) return SL_OK;
    const sl_point p = geo->points.items[line.first];
    const sl_point q = geo->points.items[line.first + line.count - 1];
    const double heading = json_number_value(sli_geo_property(feature, "heading"));
    if (feature->means == SLI_GEO_START)
        return line.count == 1 ? sl_map_add_start(geo->context, geo->map, p, heading, item) : SL_OK;
    if (p.x == q.x && p.y == q.y) return SL_OK;
    return feature->means == SLI_GEO_MIRROR
               ? sl_map_add_mirror(geo->context, geo->map, (sl_segment){p, q}, item)
               : sl_map_add_oneway(geo->context, geo->map, (sl_segment){p, q}, item);
}

static sl_status add_label(sli_geo *geo, size_t number) {
    const sli_geo_feature *f = &geo->features.items[number];
    const json_t *id = json_object_get(f->feature, "id");
    char text[SL_LINE_TEXT];
    snprintf(text, sizeof text, "features[%zu]%s%.40s%s%.40s", number, *f->layer ? " " : "",
             f->layer, json_is_string(id) ? " " : "",
             json_is_string(id) ? json_string_value(id) : "");
    return sli_map_add_label(geo->context, geo->map, (uint32_t)number + 1, text);
}

/// Of drawn lines. In a file of lines polygons stand for something else, as blocks of houses.
static void choose_rings(sli_geo *geo) {
    size_t rings = 0, open = 0;
    for (size_t i = 0; i < geo->features.count; i++) {
        const sli_geo_feature *f = &geo->features.items[i];
        for (size_t k = 0; k < f->count && f->taken; k++) {
            const sli_geo_line *line = &geo->lines.items[f->first + k];
            rings += line->ring;
            open += !line->ring && line->count > 1;
        }
    }
    geo->without_rings = open > 0;
    if (rings && open)
        sl_note(geo->context,
                "%s: left out: %zu outline%s of polygons; to measure them, make them line strings; "
                "if this is a plan, sightline axial --lines fewest finds its axial lines",
                geo->name, rings, rings == 1 ? "" : "s");
    else if (rings)
        sl_note(geo->context,
                "%s: there are polygons only: their outlines are taken as lines; if they are a "
                "plan, sightline axial --lines fewest finds its axial lines",
                geo->name);
}

static sl_status add_all(sli_geo *geo) {
    if (geo->features.count >= UINT32_MAX)
        return sl_fail_at(geo->context, geo->name, 0, "too many features");
    geo->map->source.lines_are_items = true;
    for (size_t i = 0; i < geo->features.count; i++) {
        const sli_geo_feature *f = &geo->features.items[i];
        if (i % 1024 == 0) SL_TRY(sl_check_cancelled(geo->context));
        if (!f->taken || !f->count) continue;
        SL_TRY(add_label(geo, i));
        if (f->means == SLI_GEO_WALL) SL_TRY(add_lines(geo, f, (uint32_t)i + 1));
        if (f->means == SLI_GEO_MIRROR || f->means == SLI_GEO_ONEWAY || f->means == SLI_GEO_START)
            SL_TRY(add_other(geo, f, (uint32_t)i + 1));
    }
    return SL_OK;
}

/// Cleaning drops walls of no length; those that openings took away whole go at once.
static void drop_points(sl_map *map) {
    size_t kept = 0;
    for (size_t i = 0; i < map->wall_count; i++)
        if (map->walls[i].a.x != map->walls[i].b.x || map->walls[i].a.y != map->walls[i].b.y)
            map->walls[kept++] = map->walls[i];
    map->wall_count = kept;
}

static void report(const sli_geo *geo) {
    sli_name_list left = {0};
    size_t walls = 0, doors = 0, other = 0;
    for (size_t i = 0; i < geo->features.count; i++) {
        const sli_geo_feature *f = &geo->features.items[i];
        const bool lines = f->count && geo->lines.items[f->first].count > 1;
        walls += f->taken && f->means == SLI_GEO_WALL && lines;
        doors += f->taken && f->means == SLI_GEO_DOOR;
        if (f->means != SLI_GEO_NO_WALL || !lines) continue;
        if (geo->options->map && !sli_geo_on_level(geo, f, geo->options->map)) continue;
        other++;
        if (!*f->layer || strstr(left.text, f->layer)) continue;
        sli_name_list_add(&left, (sli_word){f->layer, strlen(f->layer)});
    }
    const sli_tally taken[] = {{walls, "feature as walls", "features as walls"},
                               {geo->cuts, "opening in them", "openings in them"},
                               {doors - geo->cuts, "other door", "other doors"}};
    char with[SLI_TALLY_TEXT];
    sli_tally_write("", taken, doors >= geo->cuts ? 3 : 2, with);
    if (other)
        sl_note(geo->context, "%s: %s; left out: %zu of other layers%s%s; --layers takes layers",
                geo->name, with, other, *left.text ? ": " : "", left.text);
    else
        sl_note(geo->context, "%s: %s", geo->name, with);
    if (geo->guessed && walls)
        sl_note(geo->context,
                "%s: no property says what is a wall, so all lines are; if they are streets, "
                "sightline segments measures them",
                geo->name);
    for (size_t i = 1; i < geo->file_count; i++)
        sl_note(geo->context, "%s: %s beside it is read too", geo->name, geo->files[i].name);
    if (geo->no_walls)
        sl_note(geo->context, "%s: %zu door%s no wall", geo->name, geo->no_walls,
                geo->no_walls == 1 ? " is on" : "s are on");
}

/// Straight walls of the file are straight in its own plane, and bend by this in another one.
#define BENT 2e-3

static sl_status read_all(sli_geo *geo, const char *text, size_t size) {
    const bool lines = geo->options->lines;
    SL_TRY(sli_geo_open(geo, text, size));
    if (!lines) SL_TRY(sli_geo_refuse_points(geo));
    SL_TRY(sli_geo_place(geo));
    SL_TRY(sli_geo_find_meanings(geo));
    SL_TRY(sli_geo_find_storeys(geo));
    SL_TRY(choose(geo));
    if (lines) choose_rings(geo);
    if (!lines) SL_TRY(sli_geo_doubt(geo));
    if (!lines) SL_TRY(sli_geo_look_for_footprints(geo));
    SL_TRY(add_all(geo));
    if (!lines) SL_TRY(sli_geo_add_doors(geo));
    if (!lines) SL_TRY(sli_geo_add_names(geo));
    geo->map->entrance_may_be_wide = sli_geo_is_plan(geo);
    drop_points(geo->map);
    if (!lines || geo->map->earth.known)
        geo->map->precision = sli_marked_precision(geo->map, geo->finest, NULL, 0);
    if (geo->map->earth.known && geo->map->wall_count)
        geo->map->precision = fmax(geo->map->precision, BENT);
    if (!lines) report(geo);
    if (!lines) sli_geo_note_levels(geo);
    return lines ? SL_OK : sli_geo_note_storeys(geo);
}

sl_status sli_map_read_geojson(sl_context *context, const char *name, const char *text, size_t size,
                               const sl_import_options *options, sl_map *map) {
    sl_map out = {0};
    sli_geo geo = {.context = context, .name = name, .options = options, .map = &out};
    const sl_status status = read_all(&geo, text, size);
    sli_geo_close(&geo);
    if (status == SL_OK)
        *map = out;
    else
        sl_map_destroy(context, &out);
    return status;
}

sl_status sl_lines_read_geojson(sl_context *context, const char *name, const char *text,
                                size_t size, sl_map *map) {
    sl_import_options options = sl_import_options_default();
    options.lines = true;
    return sli_map_read_geojson(context, name, text, size, &options, map);
}

sl_status sli_map_list_geojson(sl_context *context, const char *name, const char *text, size_t size,
                               sl_map_list *list) {
    const sl_import_options options = sl_import_options_default();
    sli_geo geo = {.context = context, .name = name, .options = &options};
    sl_status status = sli_geo_open(&geo, text, size);
    if (status == SL_OK) status = sli_geo_refuse_points(&geo);
    if (status == SL_OK) status = sli_geo_find_meanings(&geo);
    if (status == SL_OK) status = sli_geo_find_storeys(&geo);
    if (status == SL_OK) status = sli_geo_levels(&geo, list);
    sli_geo_close(&geo);
    if (status != SL_OK) sl_map_list_destroy(context, list);
    return status;
}

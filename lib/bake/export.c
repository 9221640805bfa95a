/// Exports of a baked file as JSON and CSV, and the table of all exports that need no other library
/// (GeoJSON: export_geojson.c, C: export_source.c). Each is printed piece by piece, so that a large
/// map needs no tree in memory. EXPORT.md describes them. Numbers have 17 digits, and read back to
/// the same double.
#include "bake/export.h"
#include "bake/view_rows.h"
#include "base/base.h"
#include "sightline/json.h"
#include "sightline/support.h"
#include "space/kd_tree.h"
#include "space/walled.h"

#include <inttypes.h>
#include <string.h>

// --- JSON: one object

typedef struct printer {
    sl_context *context;
    FILE *stream;
    sl_json_writer json;
    bool any; ///< a list has an item already
} printer;

/// What stands before item i; false where there is none, or the stream takes no more.
static bool begin_item(const printer *out, uint32_t i, uint32_t count) {
    if (i >= count || ferror(out->stream)) return false;
    fputs(i ? ",\n" : "\n", out->stream);
    return true;
}

/// Begins the next member of the object, on a line of its own.
static void begin_member(const printer *out, const char *key) {
    fprintf(out->stream, ",\n\"%s\": ", key);
}

static void print_text_member(printer *out, const char *key, const char *text) {
    fprintf(out->stream, ", \"%s\": ", key);
    sl_json_put_text(&out->json, text);
}

static void print_point(printer *out, sl_point p) {
    sl_json_put_list(&out->json);
    sl_json_put_real(&out->json, p.x);
    sl_json_put_real(&out->json, p.y);
    sl_json_put_end(&out->json, ']');
}

static void print_segment(printer *out, sl_point a, sl_point b) {
    sl_json_put_list(&out->json);
    sl_json_put_real(&out->json, a.x);
    sl_json_put_real(&out->json, a.y);
    sl_json_put_real(&out->json, b.x);
    sl_json_put_real(&out->json, b.y);
    sl_json_put_end(&out->json, ']');
}

static void print_polygon(printer *out, const sl_space *space, const sl_cell *cell) {
    sl_json_put_list(&out->json);
    for (uint32_t i = 0; i < cell->vertex_count; i++)
        print_point(out, space->vertices[cell->first_vertex + i]);
    sl_json_put_end(&out->json, ']');
}

static void print_cell(printer *out, const sl_space *space, uint32_t number) {
    const sl_cell *cell = &space->cells[number];
    sl_json_put_object(&out->json);
    sl_json_put_key(&out->json, "id");
    sl_json_put_integer(&out->json, number);
    sl_json_put_key(&out->json, "polygon");
    print_polygon(out, space, cell);
    sl_json_put_key(&out->json, "inside");
    sl_json_put_flag(&out->json, cell->inside);
    if (cell->solid) {
        sl_json_put_key(&out->json, "solid");
        sl_json_put_flag(&out->json, true);
    }
    sl_json_put_end(&out->json, '}');
}

/// Solid ground, as the polygons of its cells.
static void print_solids(printer *out, const sl_space *space) {
    bool any = false;
    for (uint32_t i = 0; i < space->cell_count; i++) {
        const sl_cell *cell = &space->cells[i];
        if (!cell->solid) continue;
        fputs(any ? ",\n" : ",\n\"solids\": [\n", out->stream);
        any = true;
        print_polygon(out, space, cell);
    }
    if (any) fputs("]", out->stream);
}

/// The walls that have solid ground at one hand, by number. Readers need not find them by place.
static void put_solid_walls(printer *out, const sl_wall *walls, uint32_t count) {
    static const struct {
        uint32_t side;
        const char *name;
    } hands[] = {{SL_SOLID_LEFT, "left"}, {SL_SOLID_RIGHT, "right"}};
    begin_member(out, "solid_walls");
    sl_json_put_object(&out->json);
    for (size_t hand = 0; hand < sizeof hands / sizeof *hands; hand++) {
        sl_json_put_key(&out->json, hands[hand].name);
        sl_json_put_list(&out->json);
        for (uint32_t i = 0; i < count; i++)
            if (walls[i].ground & hands[hand].side) sl_json_put_integer(&out->json, i);
        sl_json_put_end(&out->json, ']');
    }
    sl_json_put_end(&out->json, '}');
}

/// Walls take their ground from the cells, so it is that of `solids`. A loose space does not tell.
static sl_status print_solid_walls(printer *out, const sl_space *space) {
    bool any = false;
    for (uint32_t i = 0; i < space->cell_count; i++) any |= space->cells[i].solid != 0;
    if (!any || space->loose) return SL_OK;
    sl_space marked = *space;
    marked.walls = sl_alloc_array(out->context, space->wall_count, sizeof *marked.walls);
    if (!marked.walls) return SL_NO_MEMORY;
    for (uint32_t i = 0; i < space->wall_count; i++)
        marked.walls[i] = (sl_wall){.a = space->walls[i].a, .b = space->walls[i].b};
    sli_ground_of_cells(&marked);
    put_solid_walls(out, marked.walls, marked.wall_count);
    sl_free(out->context, marked.walls);
    return SL_OK;
}

const sl_door *sli_portal_door(const sl_baked *baked, uint32_t portal) {
    size_t count;
    const sl_seam_portal *on = sl_space_seams_of(&baked->space, portal, &count);
    for (size_t i = 0; i < count; i++) {
        const sl_seam *seam = &baked->space.seams[on[i].seam];
        if (seam->kind == SL_SEAM_DOOR) return &baked->map.doors[seam->number];
    }
    return NULL;
}

sli_glass_way sli_portal_glass(const sl_space *space, uint32_t portal) {
    bool blocked[2] = {false};
    size_t count;
    const sl_seam_portal *on = sl_space_seams_of(space, portal, &count);
    for (size_t i = 0; i < count; i++)
        if (space->seams[on[i].seam].kind == SL_SEAM_ONEWAY) blocked[on[i].forward != 0] = true;
    if (blocked[0] && blocked[1]) return SLI_GLASS_SHUT;
    return blocked[0] ? SLI_GLASS_TO : blocked[1] ? SLI_GLASS_FROM : SLI_GLASS_NONE;
}

const char *sli_glass_name(sli_glass_way way) {
    static const char *const names[] = {NULL, "from", "to", "none"};
    return names[way];
}

static void put_stops(printer *out, uint32_t stops) {
    sl_json_put_key(&out->json, "stops");
    sl_json_put_list(&out->json);
    for (uint32_t bit = 1; bit <= SL_STOPS_LIMITED; bit *= 2) {
        char name[SL_STOPS_TEXT];
        sl_stops_write(stops & bit, name);
        if (*name) sl_json_put_text(&out->json, name);
    }
    sl_json_put_end(&out->json, ']');
}

/// Walls that do not stop all.
static void print_partial_walls(printer *out, const sl_map *map) {
    if (!sl_map_partial_walls(map)) return;
    begin_member(out, "partial_walls");
    fputs("[", out->stream);
    for (size_t i = 0, any = 0; i < map->seam_count; i++) {
        const sl_glass *wall = &map->seams[i];
        if (!wall->stops) continue;
        fputs(any++ ? ",\n" : "\n", out->stream);
        sl_json_put_object(&out->json);
        sl_json_put_key(&out->json, "segment");
        print_segment(out, wall->segment.a, wall->segment.b);
        put_stops(out, wall->stops);
        if (wall->ground & (SL_SOLID_LEFT | SL_SOLID_RIGHT)) {
            sl_json_put_key(&out->json, "solid");
            sl_json_put_text(&out->json, wall->ground & SL_SOLID_LEFT ? "left" : "right");
        }
        sl_json_put_end(&out->json, '}');
    }
    fputs("]", out->stream);
}

/// The walls of the space that do not stop all, with the cells at their left and right.
static void print_passages(printer *out, const sl_space *space) {
    if (!space->passage_count) return;
    begin_member(out, "passages");
    fputs("[", out->stream);
    for (uint32_t i = 0; begin_item(out, i, space->passage_count); i++) {
        const sl_passage *p = &space->passages[i];
        sl_json_put_object(&out->json);
        sl_json_put_key(&out->json, "wall");
        sl_json_put_integer(&out->json, p->wall);
        sl_json_put_key(&out->json, "cells");
        sl_json_put_list(&out->json);
        sl_json_put_integer(&out->json, p->cell[0]);
        sl_json_put_integer(&out->json, p->cell[1]);
        sl_json_put_end(&out->json, ']');
        put_stops(out, p->stops);
        sl_json_put_end(&out->json, '}');
    }
    fputs("]", out->stream);
}

static void put_portal_effects(printer *out, const sl_baked *baked, uint32_t number) {
    const sl_door *door = sli_portal_door(baked, number);
    const char *oneway = sli_glass_name(sli_portal_glass(&baked->space, number));
    if (door) sl_json_put_key(&out->json, "door");
    if (door) sl_json_put_text(&out->json, door->name);
    if (oneway) sl_json_put_key(&out->json, "oneway");
    if (oneway) sl_json_put_text(&out->json, oneway);
    const uint32_t stops = sli_portal_stops(&baked->map, &baked->space, number);
    if (stops) put_stops(out, stops);
}

static void print_portal(printer *out, const sl_baked *baked, uint32_t number, int version) {
    const sl_portal *portal = &baked->space.portals[number];
    sl_json_put_object(&out->json);
    sl_json_put_key(&out->json, "cells");
    sl_json_put_list(&out->json);
    sl_json_put_integer(&out->json, portal->cell[0]);
    sl_json_put_integer(&out->json, portal->cell[1]);
    sl_json_put_end(&out->json, ']');
    sl_json_put_key(&out->json, "segment");
    print_segment(out, portal->left, portal->right);
    if (version > 1) put_portal_effects(out, baked, number);
    sl_json_put_end(&out->json, '}');
}

static void print_row(printer *out, const sl_pvs *pvs, uint32_t cell) {
    sl_json_put_list(&out->json);
    for (sl_pvs_run run = sl_pvs_begin(pvs, cell); sl_pvs_next(&run);)
        for (uint32_t i = run.first; i < run.end; i++) sl_json_put_integer(&out->json, i);
    sl_json_put_end(&out->json, ']');
}

/// Rows of cells; nothing where there are none.
static sl_status print_rows(printer *out, const char *key, const sl_pvs *pvs) {
    if (!pvs->cell_count) return SL_OK;
    begin_member(out, key);
    fputs("[", out->stream);
    for (uint32_t i = 0; begin_item(out, i, pvs->cell_count); i++) {
        print_row(out, pvs, i);
        SL_TRY(sl_check_cancelled(out->context));
    }
    fputs("]", out->stream);
    return SL_OK;
}

static sl_status print_space(printer *out, const sl_baked *baked, int version) {
    const sl_space *space = &baked->space;
    begin_member(out, "bounds");
    print_segment(out, space->bounds.min, space->bounds.max);
    begin_member(out, "walls");
    fputs("[", out->stream);
    for (uint32_t i = 0; begin_item(out, i, space->wall_count); i++)
        print_segment(out, space->walls[i].a, space->walls[i].b);
    SL_TRY(sl_check_cancelled(out->context));
    fputs("]", out->stream);
    print_solids(out, space);
    if (version > 1) SL_TRY(print_solid_walls(out, space));
    begin_member(out, "cells");
    fputs("[", out->stream);
    for (uint32_t i = 0; begin_item(out, i, space->cell_count); i++) print_cell(out, space, i);
    SL_TRY(sl_check_cancelled(out->context));
    fputs("]", out->stream);
    begin_member(out, "portals");
    fputs("[", out->stream);
    for (uint32_t i = 0; begin_item(out, i, space->portal_count); i++)
        print_portal(out, baked, i, version);
    fputs("]", out->stream);
    return sl_check_cancelled(out->context);
}

// --- JSON: effects, places, and all else that a map holds

/// The stretches of a door: those that its cells end at, or all of it where no cell does.
static void put_door_segments(printer *out, const sl_baked *baked, uint32_t number) {
    const sl_space *space = &baked->space;
    bool any = false;
    sl_json_put_list(&out->json);
    for (uint32_t i = 0; i < space->seam_count; i++) {
        const sl_seam *seam = &space->seams[i];
        if (seam->kind != SL_SEAM_DOOR || seam->number != number) continue;
        print_segment(out, seam->at.a, seam->at.b);
        any = true;
    }
    const sl_segment *whole = &baked->map.doors[number].segment;
    if (!any) print_segment(out, whole->a, whole->b);
    sl_json_put_end(&out->json, ']');
}

static void put_door_kind(printer *out, sl_door_kind kind) {
    if (kind == SL_DOOR_PLAIN) return;
    sl_json_put_key(&out->json, "kind");
    sl_json_put_text(&out->json, kind == SL_DOOR_BREAKABLE ? "breakable" : "site");
}

static void print_doors(printer *out, const sl_baked *baked) {
    const uint32_t count = (uint32_t)baked->map.door_count;
    if (!count) return;
    begin_member(out, "doors");
    fputs("[", out->stream);
    for (uint32_t i = 0; begin_item(out, i, count); i++) {
        sl_json_put_object(&out->json);
        sl_json_put_key(&out->json, "name");
        sl_json_put_text(&out->json, baked->map.doors[i].name);
        sl_json_put_key(&out->json, "segments");
        put_door_segments(out, baked, i);
        sl_json_put_key(&out->json, "open");
        sl_json_put_flag(&out->json, baked->map.doors[i].open);
        put_door_kind(out, baked->map.doors[i].kind);
        sl_json_put_end(&out->json, '}');
    }
    fputs("]", out->stream);
}

/// The next number of a row of door sets, which is sound.
static uint32_t next_number(const uint8_t **at) {
    uint32_t value = 0;
    for (unsigned shift = 0;; shift += 7) {
        const uint8_t byte = *(*at)++;
        value |= (uint32_t)(byte & 127) << shift;
        if (byte < 128) return value;
    }
}

/// One alternative of a pair, as names of doors, each once.
static void put_alternative(printer *out, const sl_map *map, const uint8_t **at) {
    uint32_t door = UINT32_MAX, names = 0;
    sl_json_put_list(&out->json);
    const uint8_t *const first = *at;
    for (uint32_t left = next_number(at); left; left--, names++) {
        door += 1 + next_number(at);
        const uint8_t *before = first;
        uint32_t other = UINT32_MAX;
        bool told = false;
        (void)next_number(&before);
        for (uint32_t i = 0; i < names && !told; i++) {
            other += 1 + next_number(&before);
            told = strcmp(map->doors[other].name, map->doors[door].name) == 0;
        }
        if (!told) sl_json_put_text(&out->json, map->doors[door].name);
    }
    sl_json_put_end(&out->json, ']');
}

/// The pairs of one row: {"cells": [from, to], "needs": [[names], ...]}.
static void print_door_row(printer *out, const sl_door_sets *sets, const sl_map *map,
                           uint32_t from) {
    const uint8_t *at = sets->bytes + sets->offsets[from];
    const uint8_t *const stop = sets->bytes + sets->offsets[from + 1];
    for (uint32_t to = UINT32_MAX; at != stop && !ferror(out->stream);) {
        to += 1 + next_number(&at);
        fputs(out->any ? ",\n" : "\n", out->stream);
        out->any = true;
        fprintf(out->stream, "{\"cells\":[%" PRIu32 ",%" PRIu32 "],\"needs\":", from, to);
        sl_json_put_list(&out->json);
        for (uint32_t left = next_number(&at); left; left--) put_alternative(out, map, &at);
        sl_json_put_end(&out->json, ']');
        fputs("}", out->stream);
    }
}

static sl_status print_door_sets(printer *out, const char *key, const sl_door_sets *sets,
                                 const sl_map *map) {
    if (!sl_door_sets_bytes(sets)) return SL_OK;
    begin_member(out, key);
    fputs("[", out->stream);
    out->any = false;
    for (uint32_t i = 0; i < sets->cell_count; i++) {
        print_door_row(out, sets, map, i);
        SL_TRY(sl_check_cancelled(out->context));
    }
    fputs("]", out->stream);
    return SL_OK;
}

/// Walls that do not stop all have a member of their own.
static void print_glass(printer *out, const char *key, const sl_glass *glass, size_t count) {
    uint32_t left = 0;
    for (size_t i = 0; i < count; i++) left += !glass[i].stops;
    if (!left) return;
    begin_member(out, key);
    fputs("[", out->stream);
    for (uint32_t i = 0, next = 0; begin_item(out, i, left); i++, next++) {
        while (glass[next].stops) next++;
        print_segment(out, glass[next].segment.a, glass[next].segment.b);
    }
    fputs("]", out->stream);
}

/// The numbers of mirrors that reflect on their left only.
static void print_one_sided(printer *out, const sl_map *map) {
    bool any = false;
    for (size_t i = 0; i < map->mirror_count; i++) any |= map->mirrors[i].one_sided;
    if (!any) return;
    begin_member(out, "one_sided_mirrors");
    sl_json_put_list(&out->json);
    for (size_t i = 0; i < map->mirror_count; i++)
        if (map->mirrors[i].one_sided) sl_json_put_integer(&out->json, (int64_t)i);
    sl_json_put_end(&out->json, ']');
}

static void print_starts(printer *out, const sl_map *map) {
    if (!map->start_count) return;
    begin_member(out, "starts");
    fputs("[", out->stream);
    for (uint32_t i = 0; begin_item(out, i, (uint32_t)map->start_count); i++) {
        sl_json_put_object(&out->json);
        sl_json_put_key(&out->json, "at");
        print_point(out, map->starts[i].at);
        sl_json_put_key(&out->json, "heading");
        sl_json_put_real(&out->json, map->starts[i].heading);
        sl_json_put_end(&out->json, '}');
    }
    fputs("]", out->stream);
}

static void print_paths(printer *out, const sl_map *map) {
    if (!map->path_count) return;
    begin_member(out, "paths");
    fputs("[", out->stream);
    for (uint32_t i = 0; begin_item(out, i, (uint32_t)map->path_count); i++) {
        sl_json_put_object(&out->json);
        sl_json_put_key(&out->json, "name");
        sl_json_put_text(&out->json, map->paths[i].name);
        sl_json_put_key(&out->json, "points");
        sl_json_put_list(&out->json);
        for (size_t k = 0; k < map->paths[i].count; k++) print_point(out, map->paths[i].points[k]);
        sl_json_put_end(&out->json, ']');
        sl_json_put_end(&out->json, '}');
    }
    fputs("]", out->stream);
}

static void print_objects(printer *out, const sl_map *map) {
    if (!map->object_count) return;
    begin_member(out, "objects");
    fputs("[", out->stream);
    for (uint32_t i = 0; begin_item(out, i, (uint32_t)map->object_count); i++) {
        sl_json_put_object(&out->json);
        sl_json_put_key(&out->json, "name");
        sl_json_put_text(&out->json, map->objects[i].name);
        sl_json_put_key(&out->json, "box");
        print_segment(out, map->objects[i].box.min, map->objects[i].box.max);
        sl_json_put_end(&out->json, '}');
    }
    fputs("]", out->stream);
}

static void print_range(printer *out, const sl_map *map) {
    begin_member(out, "range");
    if (map->range > 0)
        sl_json_put_real(&out->json, map->range);
    else
        sl_json_put_null(&out->json);
}

/// The cells of each view cell, and the cells that it sees.
static sl_status print_views(printer *out, const sl_view_rows *views, uint32_t cells,
                             sl_bits *seen) {
    begin_member(out, "view_cells");
    fputs("[", out->stream);
    for (uint32_t i = 0; begin_item(out, i, views->view_cell_count); i++) {
        SL_TRY(sl_check_cancelled(out->context));
        sl_json_put_list(&out->json);
        for (uint32_t k = 0; k < cells; k++)
            if (views->view_cells[k] == i) sl_json_put_integer(&out->json, k);
        sl_json_put_end(&out->json, ']');
    }
    fputs("]", out->stream);
    begin_member(out, "view_cell_pvs");
    fputs("[", out->stream);
    for (uint32_t i = 0; begin_item(out, i, views->view_cell_count); i++) {
        SL_TRY(sl_check_cancelled(out->context));
        memset(seen, 0, sl_bits_words(cells) * sizeof *seen);
        sli_view_rows_add_to(views, i, seen);
        sl_json_put_list(&out->json);
        for (uint32_t k = 0; k < cells; k++)
            if (sl_bits_has(seen, k)) sl_json_put_integer(&out->json, k);
        sl_json_put_end(&out->json, ']');
    }
    fputs("]", out->stream);
    return SL_OK;
}

static sl_status print_view_cells(printer *out, const sl_baked *baked) {
    const uint32_t cells = baked->space.cell_count;
    if (!baked->views.view_cell_count) return SL_OK;
    sl_bits *seen = sl_alloc_array(out->context, sl_bits_words(cells), sizeof *seen);
    const sl_status status = seen ? print_views(out, &baked->views, cells, seen) : SL_NO_MEMORY;
    sl_free(out->context, seen);
    return status;
}

/// What version 2 has and version 1 had not.
static sl_status print_rest(printer *out, const sl_baked *baked) {
    const sl_visibility *seen = &baked->visibility;
    const sl_map *map = &baked->map;
    SL_TRY(print_rows(out, "doubtful", &seen->doubtful));
    print_doors(out, baked);
    SL_TRY(print_door_sets(out, "door_sets", &seen->doors, map));
    print_glass(out, "mirrors", map->mirrors, map->mirror_count);
    print_one_sided(out, map);
    SL_TRY(print_rows(out, "mirrored", &seen->mirrored));
    SL_TRY(print_door_sets(out, "mirrored_door_sets", &seen->mirrored_doors, map));
    print_glass(out, "oneways", map->oneways, map->oneway_count);
    print_glass(out, "seams", map->seams, map->seam_count);
    print_partial_walls(out, map);
    print_passages(out, &baked->space);
    print_starts(out, map);
    print_paths(out, map);
    print_objects(out, map);
    print_range(out, map);
    return print_view_cells(out, baked);
}

static sl_status print_json(printer *out, const sl_baked *baked, int version) {
    const sl_visibility *seen = &baked->visibility;
    fprintf(out->stream, "{\"format\": \"sightline\", \"version\": %d, \"sight\": \"%s\"", version,
            seen->sight == SL_CLOSED ? "closed" : "open");
    if (version > 1) {
        print_text_member(out, "guarantee", sl_guarantee_name(seen->guarantee));
        if (baked->method[0]) print_text_member(out, "method", baked->method);
        if (baked->solver[0]) print_text_member(out, "solver", baked->solver);
        if (sl_map_channel(&baked->map) != SL_STOPS_SIGHT) {
            char channel[SL_STOPS_TEXT];
            sl_stops_write(sl_map_channel(&baked->map), channel);
            print_text_member(out, "walls_stop", channel);
        }
        if (baked->space.loose) fputs(", \"loose\": true", out->stream);
    }
    if (sl_partial_begun(&baked->partial)) fputs(", \"finished\": false", out->stream);
    SL_TRY(print_space(out, baked, version));
    SL_TRY(print_rows(out, "pvs", &seen->pvs));
    if (version > 1) SL_TRY(print_rest(out, baked));
    fputs("}\n", out->stream);
    return SL_OK;
}

sl_status sli_export_json(sl_context *context, const sl_baked *baked,
                          const sl_export_options *options, const char *path) {
    const unsigned version = options->json_version ? options->json_version : SL_JSON_VERSION;
    if (version > SL_JSON_VERSION)
        return sl_fail(context, SL_BAD_ARGUMENT, "there is no JSON version %u; the newest is %d",
                       version, SL_JSON_VERSION);
    if (version == 1)
        SL_TRY(sl_effects_check(
            context, &baked->map, "JSON version 1",
            SL_EFFECT_DOOR | SL_EFFECT_ONEWAY | SL_EFFECT_RANGE,
            "it has no member for what is seen by mirror, and its readers would take a pair that "
            "is seen by mirror alone for hidden; version 2 has one"));
    sl_output output;
    SL_TRY(sl_output_open(context, path, &output));
    printer out = {context, output.stream, sl_json_writer_to(output.stream, 0), false};
    return sl_output_close(context, &output, print_json(&out, baked, (int)version));
}

// --- CSV: a line for each ordered pair of cells of which the first sees the second

/// Whether a row holds a cell: cells are asked for in ascending order.
static bool run_holds(sl_pvs_run *run, bool *more, uint32_t cell) {
    while (*more && run->end <= cell) *more = sl_pvs_next(run);
    return *more && run->first <= cell;
}

/// With mirrors two columns more: whether the pair is seen directly, and whether by mirror.
static sl_status print_pairs_with_mirrors(sl_context *context, const sl_visibility *seen,
                                          FILE *stream) {
    const uint32_t count = seen->pvs.cell_count;
    fputs("from,to,direct,mirrored\n", stream);
    for (uint32_t cell = 0; cell < count && !ferror(stream); cell++) {
        sl_pvs_run direct = sl_pvs_begin(&seen->pvs, cell);
        sl_pvs_run mirrored = sl_pvs_begin(&seen->mirrored, cell);
        bool any_direct = sl_pvs_next(&direct), any_mirrored = sl_pvs_next(&mirrored);
        SL_TRY(sl_check_cancelled(context));
        for (uint32_t i = 0; i < count; i++) {
            const bool straight = run_holds(&direct, &any_direct, i);
            const bool reflected = run_holds(&mirrored, &any_mirrored, i);
            if (straight || reflected)
                fprintf(stream, "%" PRIu32 ",%" PRIu32 ",%d,%d\n", cell, i, straight, reflected);
        }
        sl_report(context, "export", "cells", cell + 1, count);
    }
    return SL_OK;
}

static sl_status print_pairs(sl_context *context, const sl_pvs *pvs, FILE *stream) {
    fputs("from,to\n", stream);
    for (uint32_t cell = 0; cell < pvs->cell_count && !ferror(stream); cell++) {
        SL_TRY(sl_check_cancelled(context));
        for (sl_pvs_run run = sl_pvs_begin(pvs, cell); sl_pvs_next(&run);)
            for (uint32_t i = run.first; i < run.end; i++)
                fprintf(stream, "%" PRIu32 ",%" PRIu32 "\n", cell, i);
        sl_report(context, "export", "cells", cell + 1, pvs->cell_count);
    }
    return SL_OK;
}

sl_status sli_export_csv(sl_context *context, const sl_baked *baked,
                         const sl_export_options *options, const char *path) {
    (void)options;
    const sl_visibility *seen = &baked->visibility;
    sl_output output;
    SL_TRY(sl_output_open(context, path, &output));
    return sl_output_close(context, &output,
                           seen->mirrored.cell_count
                               ? print_pairs_with_mirrors(context, seen, output.stream)
                               : print_pairs(context, &seen->pvs, output.stream));
}

// --- the table

static const sl_export_format formats[] = {
    {.name = "json",
     .what = "everything: walls, cells, portals, visible sets, doors, mirrors, starts",
     .takes = SL_EXPORT_TAKES_VERSION,
     .shows_mirrors = true,
     .write = sli_export_json},
    {.name = "geojson",
     .what = "cells, portals, walls, doors and starts for maps in a GIS",
     .shows_mirrors = true,
     .write = sli_export_geojson},
    {.name = "csv",
     .what = "a line for each ordered pair seen",
     .shows_mirrors = true,
     .write = sli_export_csv},
    {.name = "c",
     .what = "a C header: cells, portals, doors, starts, and a bit for each pair",
     .takes = SL_EXPORT_TAKES_PREFIX,
     .shows_mirrors = true,
     .write = sli_export_c},
};
enum { FORMAT_COUNT = sizeof formats / sizeof *formats };

const sl_export_format *sl_export_formats(const sl_context *context, size_t *count) {
    return sli_table_items(&context->export_formats, formats, FORMAT_COUNT, count);
}

sl_status sl_export_formats_add(sl_context *context, const sl_export_format *more, size_t count) {
    return sli_table_add(context, &context->export_formats, sizeof *formats, formats, FORMAT_COUNT,
                         more, count);
}

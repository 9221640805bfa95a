/// Areas by overlays of each room with what is seen; means by the room of each point.
#include "studies/room_table.h"

#include "reports/fields.h"
#include "reports/json_print.h"
#include "sightline/support.h"
#include "studies/eye_run.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

/// Such a share of the area inside that is in no room is worth a note.
static const double NOTED = 0.01;

/// The texts inside that are in no room.
static void list_lost(const sl_space *space, const sl_map_source *source, room_table *out) {
    for (size_t i = 0; i < source->text_count; i++) {
        const sl_map_text *text = &source->texts[i];
        if (!sl_space_is_inside(space, text->at) ||
            sl_rooms_at(&out->rooms, text->at) != SL_NO_ROOM)
            continue;
        if (!out->lost++) text_make_readable(text->text, out->lost_text, sizeof out->lost_text);
    }
}

sl_status room_table_make(sl_context *context, const sl_baked *baked, double width,
                          room_table *out) {
    const sl_space *space = &baked->space;
    for (uint32_t c = 0; c < space->cell_count; c++)
        if (space->cells[c].inside) out->inside += sl_space_area(space, c);
    sl_map map = {0};
    sl_status status = sl_baked_copy_map(context, baked, &map);
    if (status == SL_OK) status = sl_rooms_find(context, &map, space, width, &out->rooms);
    if (status == SL_OK) status = sl_rooms_take_names(context, &out->rooms, &map);
    if (status == SL_OK) list_lost(space, &map.source, out);
    sl_map_destroy(context, &map);
    return status;
}

void room_table_destroy(sl_context *context, room_table *table) {
    sl_rooms_destroy(context, &table->rooms);
    sl_free(context, table->seen);
    sl_free(context, table->points);
    sl_free(context, table->measures);
    sl_free(context, table->means);
    *table = (room_table){0};
}

void room_table_note(sl_context *context, const room_table *table) {
    double listed = 0;
    char names[LOST_TEXT + 64] = "";
    for (uint32_t i = 0; i < table->rooms.count; i++) listed += table->rooms.items[i].area;
    const double rest = 1 - listed / table->inside;
    if (table->lost)
        snprintf(names, sizeof names, ", and so do%s %u text%s (\"%s\"%s)",
                 table->lost == 1 ? "es" : "", (unsigned)table->lost, table->lost == 1 ? "" : "s",
                 table->lost_text, table->lost == 1 ? "" : ", ...");
    if (rest > NOTED || table->lost)
        sl_note(context,
                "%.2g %% of the area inside lies in no room%s: in doorways, and in places that are "
                "small for doors of %.4g (--door-width W)",
                100 * fmax(rest, 0), names, table->rooms.width);
}

// --- what is seen

static sl_status look(sl_context *context, const isovist_scene *scene, const eye_places *eyes,
                      seen_parts *parts) {
    for (size_t i = 0; i < eyes->list.count; i++) {
        sl_mirrored_region region = {0};
        sl_status status = isovist_look(context, scene, &eyes->list.items[i], &region);
        if (status == SL_OK) status = seen_parts_add(context, scene->space, &region, true, parts);
        sl_mirrored_region_destroy(context, &region);
        SL_TRY(status);
    }
    return SL_OK;
}

static sl_status cover_rooms(sl_context *context, const seen_parts *parts, sl_shape *shapes,
                             room_table *table) {
    for (size_t i = 0; i < parts->count; i++)
        shapes[i] = (sl_shape){parts->items[i].points, &parts->items[i].count, 1};
    for (uint32_t r = 0; r < table->rooms.count; r++) {
        sl_overlay overlay = {0};
        SL_TRY(sl_check_cancelled(context));
        SL_TRY(
            sl_overlay_make(context, &table->rooms.items[r].shape, shapes, parts->count, &overlay));
        table->seen[r] = parts->count ? overlay.areas[1] : 0;
        sl_overlay_destroy(context, &overlay);
    }
    return SL_OK;
}

sl_status room_table_look(sl_context *context, const isovist_scene *scene, const eye_places *eyes,
                          room_table *table) {
    seen_parts parts = {0};
    table->seen = sl_alloc_array(context, table->rooms.count, sizeof *table->seen);
    if (!table->seen) return SL_NO_MEMORY;
    sl_status status = look(context, scene, eyes, &parts);
    sl_shape *shapes = sl_alloc_array(context, parts.count, sizeof *shapes);
    if (status == SL_OK)
        status = shapes ? cover_rooms(context, &parts, shapes, table) : SL_NO_MEMORY;
    sl_free(context, shapes);
    seen_parts_destroy(context, &parts);
    return status;
}

// --- means

/// The measures that a grid has, in the order of its columns.
static sl_status list_measures(sl_context *context, room_table *table) {
    size_t count;
    sl_measures(SL_VGA, &count);
    table->measures = sl_alloc_array(context, count, sizeof *table->measures);
    if (!table->measures) return SL_NO_MEMORY;
    for (size_t k = 0; k < count; k++)
        if (table->grid->parts & vga_measure_part(k)) table->measures[table->measure_count++] = k;
    return SL_OK;
}

static void add_means(room_table *table, const uint32_t *rooms, size_t m, uint32_t *defined) {
    const size_t count = table->measure_count;
    memset(defined, 0, table->rooms.count * sizeof *defined);
    for (uint32_t p = 0; p < table->grid->grid.count; p++) {
        const uint32_t r = rooms[p];
        const double value = vga_value(table->grid, table->measures[m], p);
        if (r == SL_NO_ROOM || isnan(value)) continue;
        table->means[r * count + m] += value;
        defined[r]++;
    }
    for (uint32_t r = 0; r < table->rooms.count; r++)
        table->means[r * count + m] /= defined[r]; // NAN where there is none
}

sl_status room_table_average(sl_context *context, const vga_table *grid, room_table *table) {
    const uint32_t rooms = table->rooms.count;
    table->grid = grid;
    SL_TRY(list_measures(context, table));
    uint32_t *room = sl_alloc_array(context, grid->grid.count, sizeof *room);
    uint32_t *defined = sl_alloc_array(context, rooms, sizeof *defined);
    table->points = sl_alloc_array(context, rooms, sizeof *table->points);
    table->means =
        sl_alloc_array(context, (size_t)rooms * table->measure_count, sizeof *table->means);
    const sl_status status =
        room && defined && table->points && table->means ? SL_OK : SL_NO_MEMORY;
    for (uint32_t p = 0; p < grid->grid.count && status == SL_OK; p++) {
        room[p] = sl_rooms_at(&table->rooms, grid->grid.points[p]);
        if (room[p] != SL_NO_ROOM) table->points[room[p]]++;
    }
    for (size_t m = 0; m < table->measure_count && status == SL_OK; m++)
        add_means(table, room, m, defined);
    sl_free(context, room);
    sl_free(context, defined);
    return status;
}

// --- output

static size_t list_fields(const void *of, size_t r, table_field fields[FIELDS_MOST]) {
    const room_table *t = of;
    const sl_room *room = &t->rooms.items[r];
    size_t count = 0;
    fields[count++] = field_text("room", room->name);
    fields[count++] = field_real("x", room->at.x);
    fields[count++] = field_real("y", room->at.y);
    fields[count++] = field_real("area", room->area);
    fields[count++] = field_real("share", t->inside > 0 ? room->area / t->inside : NAN);
    fields[count++] = field_real("clearance", room->clearance);
    if (t->seen) {
        fields[count++] = field_real("seen_area", t->seen[r]);
        fields[count++] = field_real("seen_share", fmin(t->seen[r] / room->area, 1));
    }
    if (!t->grid) return count;
    fields[count++] = field_count("points", t->points[r]);
    for (size_t m = 0; m < t->measure_count; m++) {
        const sl_measure *measure = &sl_measures(SL_VGA, &(size_t){0})[t->measures[m]];
        fields[count++] = field_real(strcmp(measure->name, "area") ? measure->name : "isovist_area",
                                     t->means[r * t->measure_count + m]);
    }
    return count;
}

sl_status room_table_write(sl_context *context, const room_table *table, const char *path) {
    return fields_write_csv(context, &(field_rows){list_fields, table, table->rooms.count}, path);
}

sl_status room_table_print_json(sl_context *context, const room_table *table) {
    json_fields fields = json_begin();
    fields_add_json(&fields, "rooms", &(field_rows){list_fields, table, table->rooms.count});
    return json_print(context, &fields);
}

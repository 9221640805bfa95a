/// Zones and rooms: the regions of the viewpoints are laid over each.
#include "studies/cover_zones.h"

#include <stdio.h>
#include <string.h>

/// Zones beside the plan, or of another unit, have nothing that anybody could see.
static void note_empty(sl_context *context, const zone_covers *covers) {
    size_t empty = 0, first = 0;
    for (size_t z = 0; z < covers->count; z++)
        if (!(covers->items[z].by[0] > 0) && !empty++) first = z;
    if (empty)
        sl_note(context,
                "--zones: no area inside in %zu of %zu zones, the first is %s; are they in the "
                "plan's unit?",
                empty, covers->count, covers->items[first].name);
}

/// What of a zone is inside.
static sl_status inside_of(sl_context *context, const sl_shape *inside, sl_shape zone,
                           sl_shape *out) {
    const sl_shape both[2] = {*inside, zone};
    sl_overlay overlay;
    SL_TRY(sl_overlay_make(context, NULL, both, 2, &overlay));
    const sl_status status = sl_overlay_outline(context, &overlay, 2, out);
    sl_overlay_destroy(context, &overlay);
    return status;
}

/// `within` tiles the zone.
static sl_status make_one(sl_context *context, const cover_report *r, const sl_shape *within,
                          zone_cover *out) {
    sl_overlay overlay = {0};
    const sl_coverage *c = r->coverage;
    if (!within->count) return SL_OK;
    SL_TRY(sl_overlay_make(context, within, c->regions, c->count, &overlay));
    for (size_t k = 0; overlay.areas && k < SL_COVERAGE_CLASSES && k <= c->count; k++) {
        out->by[k] = overlay.areas[k];
        if (k && out->by[k - 1] - out->by[k] <= c->negligible) out->by[k] = out->by[k - 1];
    }
    for (size_t i = 0; overlay.areas && i < c->count; i++)
        out->viewpoints += overlay.covered[i] > c->negligible;
    sl_overlay_destroy(context, &overlay);
    return SL_OK;
}

static sl_status begin(sl_context *context, const char *what, size_t count, zone_covers *out) {
    zone_cover *items = sl_alloc_array(context, count, sizeof *items);
    if (!items) return SL_NO_MEMORY;
    *out = (zone_covers){what, items, count};
    return SL_OK;
}

sl_status cover_zones_make(sl_context *context, const cover_report *r, const zone_list *zones,
                           zone_covers *out) {
    sl_shape inside = {0};
    SL_TRY(begin(context, "zone", zones->ends.count, out));
    SL_TRY(sl_shape_of_inside(context, &r->baked->space, &inside));
    sl_status status = SL_OK;
    for (size_t z = 0; status == SL_OK && z < out->count; z++) {
        size_t end;
        sl_shape within = {0};
        out->items[z].name = zones->names.items[z];
        status = inside_of(context, &inside, zones_shape_of(zones, z, &end), &within);
        if (status == SL_OK) status = make_one(context, r, &within, &out->items[z]);
        sl_shape_destroy(context, &within);
    }
    sl_shape_destroy(context, &inside);
    if (status == SL_OK) note_empty(context, out);
    return status;
}

sl_status cover_rooms_make(sl_context *context, const cover_report *r, const sl_rooms *rooms,
                           zone_covers *out) {
    SL_TRY(begin(context, "room", rooms->count, out));
    for (size_t i = 0; i < out->count; i++) {
        out->items[i].name = rooms->items[i].name;
        SL_TRY(make_one(context, r, &rooms->items[i].shape, &out->items[i]));
    }
    return SL_OK;
}

void cover_zones_destroy(sl_context *context, zone_covers *covers) {
    sl_free(context, covers->items);
    *covers = (zone_covers){0};
}

double cover_zone_percent(const zone_cover *c, uint32_t class) {
    const double more = class + 1 < SL_COVERAGE_CLASSES ? c->by[class + 1] : 0;
    return c->by[0] > 0 ? 100 * (c->by[class] - more) / c->by[0] : 0;
}

void cover_zones_print(const cover_report *r, const zone_covers *covers) {
    printf("\n  %-16s %10s  not seen      by 1      by 2     by 3+ viewpoints\n", covers->what,
           "inside");
    for (size_t z = 0; z < covers->count; z++) {
        const zone_cover *c = &covers->items[z];
        char area[AREA_TEXT];
        printf("  %-16s %10s", c->name, cover_area_text(r, c->by[0], area));
        for (uint32_t k = 0; k < SL_COVERAGE_CLASSES; k++)
            printf("  %5.1f %%%s", cover_zone_percent(c, k),
                   k + 1 < SL_COVERAGE_CLASSES ? " " : "");
        printf("  %9u\n", (unsigned)c->viewpoints);
    }
}

void cover_zones_add_json(json_fields *f, const zone_covers *covers) {
    json_open_list(f, strcmp(covers->what, "room") == 0 ? "rooms" : "zones");
    for (size_t z = 0; z < covers->count; z++) {
        const zone_cover *c = &covers->items[z];
        json_open_item(f);
        json_add_text(f, "name", c->name);
        json_add_real(f, "inside_area", c->by[0]);
        json_add_real(f, "seen_area", c->by[1]);
        json_add_real(f, "seen_by_two_area", c->by[2]);
        json_add_real(f, "seen_by_three_area", c->by[3]);
        json_add_count(f, "viewpoints", c->viewpoints);
        json_close(f);
    }
    json_close_list(f);
}

// --- tables

static void put_number(FILE *to, double value) {
    char text[SL_NUMBER_TEXT];
    sl_number_write(value, text);
    fprintf(to, ",%s", text);
}

static void put_zones(FILE *to, const zone_covers *covers) {
    fputs("name,inside_area,seen_area,seen_by_two_area,seen_by_three_area,viewpoints\n", to);
    for (size_t z = 0; z < covers->count; z++) {
        const zone_cover *c = &covers->items[z];
        sl_table_text_write(to, c->name, true);
        for (uint32_t k = 0; k < SL_COVERAGE_CLASSES; k++) put_number(to, c->by[k]);
        fprintf(to, ",%u\n", (unsigned)c->viewpoints);
    }
}

static void put_viewpoints(FILE *to, const cover_report *r) {
    fputs("name,x,y,heading,fov,range,nearest,seen_area,alone_area,spare\n", to);
    for (size_t i = 0; i < r->coverage->count; i++) {
        const sl_camera *camera = &r->cameras->items[i];
        char number[32];
        snprintf(number, sizeof number, "%zu", i + 1);
        sl_table_text_write(to, camera->name ? camera->name : number, true);
        put_number(to, camera->view.at.x);
        put_number(to, camera->view.at.y);
        put_number(to, camera->view.heading);
        put_number(to, camera->view.fov);
        if (camera->view.range > 0)
            put_number(to, camera->view.range);
        else
            putc(',', to);
        put_number(to, camera->view.nearest);
        put_number(to, r->coverage->seen[i]);
        put_number(to, r->coverage->alone[i]);
        fprintf(to, ",%d\n", sl_coverage_is_spare(r->coverage, i));
    }
}

sl_status cover_table_write(sl_context *context, const cover_report *report,
                            const zone_covers *covers, const char *path) {
    sl_output output;
    SL_TRY(sl_output_open(context, path, &output));
    if (covers->what)
        put_zones(output.stream, covers);
    else
        put_viewpoints(output.stream, report);
    return sl_output_close(context, &output, SL_OK);
}

/// Zones: the regions of the viewpoints are laid over each.
#include "studies/cover_zones.h"

#include <stdio.h>
#include <string.h>

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

static sl_status make_one(sl_context *context, const cover_report *r, const sl_shape *inside,
                          sl_shape zone, zone_cover *out) {
    sl_shape within = {0};
    sl_overlay overlay = {0};
    const sl_coverage *c = r->coverage;
    *out = (zone_cover){0};
    SL_TRY(inside_of(context, inside, zone, &within));
    sl_status status = SL_OK;
    if (within.count) status = sl_overlay_make(context, &within, c->regions, c->count, &overlay);
    sl_shape_destroy(context, &within);
    if (status != SL_OK || !overlay.areas) return status;
    out->inside = overlay.areas[0];
    if (c->count > 0) out->seen = overlay.areas[1];
    if (c->count > 1) out->by_two = overlay.areas[2];
    for (size_t i = 0; i < c->count; i++) out->viewpoints += overlay.covered[i] > c->negligible;
    if (out->inside - out->seen <= c->negligible) out->seen = out->inside; // rounding
    sl_overlay_destroy(context, &overlay);
    return SL_OK;
}

sl_status cover_zones_make(sl_context *context, const cover_report *r, const zone_list *zones,
                           zone_cover **out) {
    sl_shape inside = {0};
    *out = sl_alloc_array(context, zones->ends.count, sizeof **out);
    if (!*out) return SL_NO_MEMORY;
    SL_TRY(sl_shape_of_inside(context, &r->baked->space, &inside));
    sl_status status = SL_OK;
    for (size_t z = 0; status == SL_OK && z < zones->ends.count; z++) {
        size_t end;
        status = make_one(context, r, &inside, zones_shape_of(zones, z, &end), &(*out)[z]);
    }
    sl_shape_destroy(context, &inside);
    return status;
}

static double percent(double part, double all) {
    return all > 0 ? 100 * part / all : 0;
}

void cover_zones_print(const cover_report *r, const zone_list *zones, const zone_cover *covers) {
    printf("\n  zone                    inside      seen  by 2 or more  viewpoints\n");
    for (size_t z = 0; z < zones->ends.count; z++) {
        const zone_cover *c = &covers[z];
        char area[AREA_TEXT];
        printf("  %-18s %11s  %6.1f %%      %6.1f %%  %10u\n", zones->names.items[z],
               cover_area_text(r, c->inside, area), percent(c->seen, c->inside),
               percent(c->by_two, c->inside), (unsigned)c->viewpoints);
    }
}

void cover_zones_add_json(json_fields *f, const zone_list *zones, const zone_cover *covers) {
    json_open_list(f, "zones");
    for (size_t z = 0; z < zones->ends.count; z++) {
        json_open_item(f);
        json_add_text(f, "name", zones->names.items[z]);
        json_add_real(f, "inside_area", covers[z].inside);
        json_add_real(f, "seen_area", covers[z].seen);
        json_add_real(f, "seen_by_two_area", covers[z].by_two);
        json_add_count(f, "viewpoints", covers[z].viewpoints);
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

static void put_zones(FILE *to, const zone_list *zones, const zone_cover *covers) {
    fputs("name,inside_area,seen_area,seen_by_two_area,viewpoints\n", to);
    for (size_t z = 0; z < zones->ends.count; z++) {
        sl_table_text_write(to, zones->names.items[z], true);
        put_number(to, covers[z].inside);
        put_number(to, covers[z].seen);
        put_number(to, covers[z].by_two);
        fprintf(to, ",%u\n", (unsigned)covers[z].viewpoints);
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

sl_status cover_table_write(sl_context *context, const cover_report *report, const zone_list *zones,
                            const zone_cover *covers, const char *path) {
    sl_output output;
    SL_TRY(sl_output_open(context, path, &output));
    if (zones)
        put_zones(output.stream, zones, covers);
    else
        put_viewpoints(output.stream, report);
    return sl_output_close(context, &output, SL_OK);
}

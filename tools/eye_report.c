#include "eye_report.h"

#include "compare_report.h"
#include "json_print.h"
#include "names.h"
#include "sightline/support.h"

#include <inttypes.h>
#include <stdio.h>

/// What is seen by mirror, method by method, and the region's parts by how many mirrors they took.
static void print_mirrored(const sl_eye_run *run) {
    size_t count;
    const sl_eye_method *methods = sl_eye_methods(&count);
    uint64_t rounded = 0;
    printf("\nby mirror, %" PRIu32 " reflection%s at most:\n", run->mirror_depth,
           run->mirror_depth == 1 ? "" : "s");
    for (size_t i = 0; i < count; i++) {
        const sl_eye_result *result = &run->results[i];
        rounded += result->rounded;
        if (!result->mirrored)
            printf("  %-20s refused: does not know mirrors\n", methods[i].name);
        else
            printf("  %-20s %-13s %7" PRIu32 " %6.2f %%\n", methods[i].name,
                   sl_guarantee_name(methods[i].guarantee), result->mirrored_count,
                   100 * result->mirrored_share);
    }
    for (uint32_t depth = 1; depth <= run->mirror_depth; depth++) {
        size_t parts = 0;
        double area = 0;
        for (size_t i = 0; i < run->mirrored.part_count; i++) {
            const sl_mirror_part *part = &run->mirrored.parts[i];
            if (part->depth != depth) continue;
            parts++;
            area += sl_region_area(&part->region);
        }
        if (parts)
            printf("  in %" PRIu32 " mirror%s: %zu part%s of the region, area %.6g\n", depth,
                   depth == 1 ? "" : "s", parts, parts == 1 ? "" : "s", area);
    }
    if (rounded) printf("  %" PRIu64 " images of the eye and its rays are rounded\n", rounded);
}

void sl_eye_print(const sl_baked *baked, const sl_eye_run *run) {
    size_t count;
    const sl_eye_method *methods = sl_eye_methods(&count);
    char x[SL_NUMBER_TEXT], y[SL_NUMBER_TEXT], seconds[SL_SECONDS_TEXT];
    sl_number_write(run->view.eye.x, x);
    sl_number_write(run->view.eye.y, y);
    printf("eye at %s,%s: cell %" PRIu32 ", %s sight\n", x, y, run->cell,
           sl_sight_name(baked->visibility.sight));
    puts("\n  method               guarantee       cells     area     nodes  orientations     "
         "time");
    for (size_t i = 0; i < count; i++) {
        const sl_eye_result *result = &run->results[i];
        sl_seconds_write(result->seconds, "u", seconds);
        printf("  %-20s %-13s %7" PRIu32 " %6.2f %% %9" PRIu64 " %13" PRIu64 " %8s\n",
               methods[i].name, sl_guarantee_name(methods[i].guarantee), result->count,
               100 * result->share, result->account.nodes, result->account.orientations, seconds);
    }
    sl_seconds_write(run->region_seconds, "u", seconds);
    printf("  %-20s %-13s %7s %6.2f %% %9" PRIu64 " %13s %8s\n", "visible_area",
           sl_guarantee_name(SL_EXACT), "", 100 * run->region_share, run->region.portals_passed, "",
           seconds);
    const sl_region_measures m = sl_region_measure(&run->region);
    printf("\nvisible region: area %.6g, perimeter %.6g, %zu corners\n", m.area, m.perimeter,
           run->region.count);
    if (run->has_mirrors) print_mirrored(run);
    if (!run->results[0].count)
        printf("\nthe file has no visible set for cell %" PRIu32
               ": it was baked for inside cells only\n",
               run->cell);
}

/// {"area": a, "perimeter": p, "polygon": [[x, y], ...]}
static void add_region(sl_json_fields *fields, const sl_region *region) {
    const sl_region_measures measures = sl_region_measure(region);
    sl_json_fields inner = sl_json_begin();
    sl_json_add_real(&inner, "area", measures.area);
    sl_json_add_real(&inner, "perimeter", measures.perimeter);
    sl_json_add_points(&inner, "polygon", region->points, region->count);
    sl_json_add_fields(fields, "region", &inner);
}

/// "mirrors": the chain by the map's numbers, from 0, the eye's end first.
static void add_chain(sl_json_fields *fields, const sl_mirrored_region *region, uint32_t number) {
    uint32_t length = 0;
    for (uint32_t i = number; i != SL_NO_PART; i = region->parts[i].parent) length++;
    sl_json_writer *json = sl_json_add(fields, "mirrors");
    sl_json_put_list(json);
    for (; length; length--) {
        uint32_t part = number;
        for (uint32_t i = 1; i < length; i++) part = region->parts[part].parent;
        sl_json_put_integer(json, region->parts[part].mirror);
    }
    sl_json_put_end(json, ']');
}

/// [{"mirrors": [0], "area": a, "rounded": false, "polygon": [...], "image": [...]}, ...]
static sl_status add_parts(sl_context *context, sl_json_fields *fields,
                           const sl_mirrored_region *region) {
    sl_json_fields *parts = sl_alloc_array(context, region->part_count, sizeof *parts);
    if (!parts) return SL_NO_MEMORY;
    for (uint32_t i = 0; i < region->part_count; i++) {
        const sl_mirror_part *part = &region->parts[i];
        parts[i] = sl_json_begin();
        add_chain(&parts[i], region, i);
        sl_json_add_real(&parts[i], "area", sl_region_area(&part->region));
        sl_json_add_flag(&parts[i], "rounded", part->rounded);
        sl_json_add_points(&parts[i], "polygon", part->region.points, part->region.count);
        sl_json_add_points(&parts[i], "image", part->image, part->region.count);
    }
    sl_json_add_list(fields, "mirrored_region", parts, region->part_count);
    sl_free(context, parts);
    return SL_OK;
}

static sl_status add_mirrored(sl_context *context, sl_json_fields *fields, const sl_baked *baked,
                              const sl_eye_run *run) {
    size_t count;
    const sl_eye_method *methods = sl_eye_methods(&count);
    sl_json_fields sets = sl_json_begin();
    for (size_t i = 0; i < count; i++)
        if (run->results[i].mirrored)
            sl_json_add_members(&sets, methods[i].name, run->results[i].mirrored,
                                baked->space.cell_count);
    sl_json_add_fields(fields, "mirrored", &sets);
    return add_parts(context, fields, &run->mirrored);
}

sl_status sl_eye_print_json(sl_context *context, const sl_baked *baked, const sl_eye_run *run,
                            const sl_eye_objects *objects) {
    size_t count;
    const sl_eye_method *methods = sl_eye_methods(&count);
    sl_json_fields fields = sl_json_begin(), sets = sl_json_begin();
    sl_json_add_count(&fields, "cell", run->cell);
    if (sl_partial_begun(&baked->partial)) sl_json_add_flag(&fields, "finished", false);
    for (size_t i = 0; i < count; i++)
        sl_json_add_members(&sets, methods[i].name, run->results[i].cells, baked->space.cell_count);
    sl_json_add_fields(&fields, "methods", &sets);
    add_region(&fields, &run->region);
    if (run->has_mirrors) SL_TRY(add_mirrored(context, &fields, baked, run));
    sl_eye_objects_add_json(&fields, baked, objects);
    return sl_json_print(context, &fields);
}

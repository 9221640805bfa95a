#include "eye_report.h"

#include "base/number.h"
#include "compare_report.h"
#include "json_print.h"
#include "names.h"

#include <inttypes.h>
#include <stdio.h>

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
           sl_guarantee_name(SL_EXACT), "", 100 * run->region_share, run->region.crossings, "",
           seconds);
    const sl_region_measures m = sl_region_measure(&run->region);
    printf("\nvisible region: area %.6g, perimeter %.6g, %zu corners\n", m.area, m.perimeter,
           run->region.count);
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

sl_status sl_eye_print_json(sl_context *context, const sl_baked *baked, const sl_eye_run *run) {
    size_t count;
    const sl_eye_method *methods = sl_eye_methods(&count);
    sl_json_fields fields = sl_json_begin(), sets = sl_json_begin();
    sl_json_add_count(&fields, "cell", run->cell);
    if (sl_findings_begun(&baked->findings)) sl_json_add_flag(&fields, "finished", false);
    for (size_t i = 0; i < count; i++)
        sl_json_add_members(&sets, methods[i].name, run->results[i].cells, baked->space.cell_count);
    sl_json_add_fields(&fields, "methods", &sets);
    add_region(&fields, &run->region);
    return sl_json_print(context, &fields);
}

/// Frames are pages of the picture of a region, without titles: what moves is the region alone.
#include "studies/isovist_walk.h"

#include "arguments/outputs.h"
#include "reports/fields.h"
#include "studies/eye_run.h"
#include "system/built.h"

#include <math.h>
#include <stdio.h>

enum { FRAME_NAME = 24, FRAMES_MOST = 99999 };

static sl_status draw_frame(sl_context *context, const isovist_walk *walk, size_t eye,
                            const sl_draw_options *drawing, const char *path) {
    sl_mirrored_region region = {0};
    seen_parts parts = {0};
    sl_status status = isovist_look(context, walk->scene, &walk->eyes->list.items[eye], &region);
    if (status == SL_OK)
        status = seen_parts_add_region(context, walk->scene->space, &region.direct, &parts);
    if (status == SL_OK)
        status = built_pictures()->regions(context, walk->baked, parts.items, parts.count, NULL,
                                           drawing, path);
    seen_parts_destroy(context, &parts);
    sl_mirrored_region_destroy(context, &region);
    return status;
}

static sl_status draw_frames(sl_context *context, const isovist_walk *walk,
                             const sl_draw_options *drawing, const char *const *names,
                             output_folder *folder) {
    for (size_t i = 0; names[i]; i++) {
        char *path = folder_file(context, folder, names[i]);
        sl_status status = path ? sl_check_cancelled(context) : SL_NO_MEMORY;
        if (status == SL_OK) status = draw_frame(context, walk, i, drawing, path);
        sl_free(context, path);
        SL_TRY(status);
        sl_report(context, "write", "frames", i + 1, walk->eyes->list.count);
    }
    return SL_OK;
}

sl_status isovist_walk_frames(sl_context *context, const isovist_walk *walk,
                              const sl_draw_options *drawing, const char *folder_path) {
    const size_t count = walk->eyes->list.count;
    if (count > FRAMES_MOST)
        return sl_fail(context, SL_BAD_ARGUMENT,
                       "--frames: %zu frames are more than %d; choose a larger --step", count,
                       FRAMES_MOST);
    char(*text)[FRAME_NAME] = sl_alloc_array(context, count, sizeof *text);
    const char **names = sl_alloc_array(context, count + 1, sizeof *names);
    output_folder folder = {0};
    sl_status status = text && names ? SL_OK : SL_NO_MEMORY;
    for (size_t i = 0; i < count && status == SL_OK; i++) {
        snprintf(text[i], sizeof text[i], "frame-%05zu.png", i + 1);
        names[i] = text[i];
    }
    if (status == SL_OK) status = folder_open(context, folder_path, names, &folder);
    if (status == SL_OK)
        status =
            folder_close(context, &folder, draw_frames(context, walk, drawing, names, &folder));
    sl_free(context, text);
    sl_free(context, names);
    SL_TRY(status);
    sl_note(context,
            "%zu frame%s; a film of them: ffmpeg -framerate 25 -i %s/frame-%%05d.png -vf "
            "\"crop=trunc(iw/2)*2:trunc(ih/2)*2\" -pix_fmt yuv420p walk.mp4",
            count, count == 1 ? "" : "s", folder_path);
    return SL_OK;
}

// --- the chart

/// How far an eye is along the way.
static double way_to(const isovist_walk *walk, size_t eye) {
    double way = (double)eye * walk->step;
    for (size_t i = 1; i <= eye && !(walk->step > 0); i++) {
        const sl_point a = walk->eyes->list.items[i - 1].at, b = walk->eyes->list.items[i].at;
        way += hypot(b.x - a.x, b.y - a.y);
    }
    return way;
}

sl_status isovist_walk_chart(sl_context *context, const isovist_walk *walk,
                             const isovist_result *isovists, size_t measure,
                             const sl_draw_options *drawing, const char *path) {
    const sl_measure *m = &sl_measures(SL_ISOVIST, &(size_t){0})[measure];
    const char *lengths = walk->scene->unit;
    char words[64], unit[SL_UNIT_TEXT], x[64], y[160];
    sl_chart_mark *marks = sl_alloc_array(context, walk->eyes->list.count, sizeof *marks);
    if (!marks) return SL_NO_MEMORY;
    size_t count = 0;
    for (size_t i = 0; i < walk->eyes->list.count; i++) {
        const double value = sl_measure_value(m, &isovists[i].measures);
        if (!isnan(value)) marks[count++] = (sl_chart_mark){.x = way_to(walk, i), .y = value};
    }
    words_of(m->name, words, sizeof words);
    sl_measure_say_unit(m, lengths, unit);
    snprintf(x, sizeof x, "way%s%s", *lengths ? ", " : "", lengths);
    snprintf(y, sizeof y, "%s%s%s", words, *unit ? ", " : "", unit);
    const sl_chart_series series = {
        .name = words, .style = SL_CHART_LINE, .marks = marks, .mark_count = count};
    const sl_chart chart = {.title = drawing->title,
                            .x = {.label = x},
                            .y = {.label = y},
                            .series = &series,
                            .series_count = 1,
                            .width = drawing->width,
                            .dark = drawing->dark};
    const sl_status status = built_pictures()->chart(context, &chart, path);
    sl_free(context, marks);
    return status;
}

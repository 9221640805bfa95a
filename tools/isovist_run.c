#include "isovist_run.h"

#include "base/threads.h"
#include "sightline/support.h"

#include <math.h>
#include <stddef.h>

typedef struct measure {
    const char *name;
    size_t offset; ///< in sl_region_measures
} measure;

#define MEASURE(name)                                                                              \
    { #name, offsetof(sl_region_measures, name) }
static const measure measures[] = {
    MEASURE(area),
    MEASURE(perimeter),
    MEASURE(compactness),
    MEASURE(occlusivity),
    MEASURE(drift_magnitude),
    MEASURE(drift_angle),
    MEASURE(min_radial),
    MEASURE(max_radial),
    MEASURE(mean_radial),
    MEASURE(radial_variance),
    MEASURE(radial_skewness),
};
enum { MEASURES = sizeof measures / sizeof *measures, EYES_A_UNIT = 64 };

sl_name_table sl_isovist_measures(void) {
    return (sl_name_table){"measure", measures, sizeof *measures, MEASURES};
}

double sl_isovist_value(const sl_isovist *isovist, size_t which) {
    return *(const double *)((const char *)&isovist->measures + measures[which].offset);
}

sl_view sl_eye_view(const sl_space *space, const sl_eye *eye) {
    const sl_box *b = &space->bounds;
    const double reach = fmax(b->max.x - b->min.x, b->max.y - b->min.y);
    return sl_view_cone(eye->at, eye->look, eye->fov, reach);
}

sl_status sl_isovist_look(sl_context *context, const sl_isovist_scene *scene, const sl_view *view,
                          sl_mirrored_region *out) {
    if (!scene->mirrors)
        return sl_region_make(context, scene->outline, view, scene->range, &out->direct);
    return sl_mirrored_region_make(context, scene->mirrors, view, scene->range, scene->mirror_depth,
                                   out);
}

typedef struct job {
    const sl_isovist_scene *scene;
    const sl_eyes *eyes;
    sl_isovist *out;
} job;

static sl_status begin(sl_context *context, void *all, void **state) {
    (void)all;
    *state = sl_alloc_array(context, 1, sizeof(sl_mirrored_region));
    return *state ? SL_OK : SL_NO_MEMORY;
}

static sl_status do_unit(sl_context *context, void *all, void *state, size_t unit) {
    const job *j = all;
    sl_mirrored_region *region = state;
    const sl_space *space = j->scene->outline->space;
    const size_t first = unit * EYES_A_UNIT, count = j->eyes->list.count;
    for (size_t i = first; i < count && i < first + EYES_A_UNIT; i++) {
        const sl_view view = sl_eye_view(space, &j->eyes->list.items[i]);
        SL_TRY(sl_isovist_look(context, j->scene, &view, region));
        j->out[i] = (sl_isovist){sl_region_measure(&region->direct),
                                 sl_region_corners(&region->direct, space, NULL, 0),
                                 sl_mirrored_area(region), region->part_count};
    }
    return SL_OK;
}

static void end(sl_context *context, void *all, void *state) {
    (void)all;
    sl_mirrored_region_destroy(context, state);
    sl_free(context, state);
}

sl_status sl_isovist_run(sl_context *context, const sl_isovist_scene *scene, const sl_eyes *eyes,
                         unsigned threads, sl_isovist *out) {
    job j = {scene, eyes, out};
    const sl_work work = {.job = &j,
                          .begin = begin,
                          .unit = do_unit,
                          .end = end,
                          .stage = "isovist",
                          .units = "bundles of eyes"};
    const size_t units = (eyes->list.count + EYES_A_UNIT - 1) / EYES_A_UNIT;
    return sl_work_run(context, &work, units, threads);
}

static void put(FILE *out, double value, char after) {
    char text[SL_NUMBER_TEXT];
    sl_number_write(value, text);
    fprintf(out, "%s%c", text, after);
}

static sl_status write_rows(sl_context *context, bool mirrors, const sl_eyes *eyes,
                            const sl_isovist *isovists, FILE *out) {
    fputs("x,y,look,fov,", out);
    for (size_t k = 0; k < MEASURES; k++) fprintf(out, "%s,", measures[k].name);
    fputs(mirrors ? "corners,mirrored_area,parts\n" : "corners\n", out);
    for (size_t i = 0; i < eyes->list.count; i++) {
        if (i % 4096 == 0) SL_TRY(sl_check_cancelled(context));
        const sl_eye *eye = &eyes->list.items[i];
        put(out, eye->at.x, ',');
        put(out, eye->at.y, ',');
        put(out, eye->look, ',');
        put(out, eye->fov, ',');
        for (size_t k = 0; k < MEASURES; k++) put(out, sl_isovist_value(&isovists[i], k), ',');
        fprintf(out, "%zu", isovists[i].corners);
        if (mirrors) {
            putc(',', out);
            put(out, isovists[i].mirrored_area, ',');
            fprintf(out, "%zu", isovists[i].parts);
        }
        putc('\n', out);
    }
    return SL_OK;
}

sl_status sl_isovist_write(sl_context *context, const sl_isovist_scene *scene, const sl_eyes *eyes,
                           const sl_isovist *isovists, const char *path) {
    sl_output output;
    SL_TRY(sl_output_open(context, path, &output));
    return sl_output_close(
        context, &output,
        write_rows(context, scene->mirrors != NULL, eyes, isovists, output.stream));
}

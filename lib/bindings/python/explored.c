/// Explored areas for Python: shapes are loops of corners, one behind the other.
#include "facade.h"

#include <stdlib.h>
#include <string.h>

slp_explored *slp_explored_new(void) {
    slp_explored *explored = calloc(1, sizeof *explored);
    if (!explored) return NULL;
    if (slp_base_begin(&explored->base)) return explored;
    free(explored);
    return NULL;
}

void slp_explored_free(slp_explored *explored) {
    if (!explored) return;
    sl_explored_destroy(explored->base.context, explored->area);
    sl_free(explored->base.context, explored->text.data);
    slp_base_end(&explored->base);
    free(explored);
}

int slp_explored_begin(slp_explored *explored, double resolution) {
    return sl_explored_create(explored->base.context, resolution, &explored->area);
}

int slp_explored_read(slp_explored *explored, const char *name, const char *text, size_t length) {
    return sl_explored_read(explored->base.context, name, text, length, &explored->area);
}

int slp_explored_add(slp_explored *explored, const double *corners, const int64_t *ends,
                     size_t count) {
    sl_context *context = explored->base.context;
    size_t *loops = sl_alloc_array(context, count, sizeof *loops);
    if (!loops) return SL_NO_MEMORY;
    for (size_t i = 0; i < count; i++) loops[i] = (size_t)ends[i];
    const sl_shape shape = {(const sl_point *)(const void *)corners, loops, count};
    const sl_status status = sl_explored_add(context, explored->area, &shape);
    sl_free(context, loops);
    return status;
}

int slp_explored_counts(slp_explored *explored, int64_t counts[2]) {
    sl_shape shape = {0};
    SL_TRY(sl_explored_area(explored->base.context, explored->area, &shape));
    counts[0] = (int64_t)shape.count;
    counts[1] = shape.count ? (int64_t)shape.ends[shape.count - 1] : 0;
    return SL_OK;
}

int slp_explored_copy(slp_explored *explored, int64_t *ends, double *corners) {
    sl_shape shape = {0};
    SL_TRY(sl_explored_area(explored->base.context, explored->area, &shape));
    for (size_t i = 0; i < shape.count; i++) ends[i] = (int64_t)shape.ends[i];
    if (shape.count)
        memcpy(corners, shape.points, shape.ends[shape.count - 1] * sizeof *shape.points);
    return SL_OK;
}

int slp_explored_holds(slp_explored *explored, const double *points, size_t count, uint8_t *holds) {
    for (size_t i = 0; i < count; i++) {
        const sl_point at = {points[2 * i], points[2 * i + 1]};
        bool held = false;
        SL_TRY(sl_explored_holds(explored->base.context, explored->area, at, &held));
        holds[i] = held;
        if (i % 256 == 0) SL_TRY(sl_check_cancelled(explored->base.context));
    }
    return SL_OK;
}

int slp_explored_write(slp_explored *explored, int64_t *length) {
    sl_bytes text = {0};
    SL_TRY(sl_explored_write(explored->base.context, explored->area, &text));
    sl_free(explored->base.context, explored->text.data);
    explored->text = text;
    *length = (int64_t)text.size;
    return SL_OK;
}

void slp_explored_text(const slp_explored *explored, char *text) {
    memcpy(text, explored->text.data, explored->text.size);
}

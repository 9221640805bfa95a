/// Explored areas for JavaScript: explored.js asks, sl_explored answers. Results stay until the
/// next call about the same area.
#include "sightline/explored.h"
#include "bindings/js/src/bindings.h"

static sl_context *context(void) {
    return sli_module.context;
}

SLI_EXPORT(sl_explored *, explored_open, double resolution) {
    sl_explored *explored;
    return sli_done(sl_explored_create(context(), resolution, &explored)) ? explored : NULL;
}

/// Reads a text of explored_write().
SLI_EXPORT(sl_explored *, explored_read, const char *name, const char *text, size_t size) {
    sl_explored *explored;
    return sli_done(sl_explored_read(context(), name, text, size, &explored)) ? explored : NULL;
}

SLI_EXPORT(void, explored_close, sl_explored *explored) {
    sl_explored_destroy(context(), explored);
}

/// Adds loops: `ends` has the number of points up to the end of each.
SLI_EXPORT(int, explored_add, sl_explored *explored, const sl_point *points, const size_t *ends,
           size_t count) {
    const sl_shape shape = {points, ends, count};
    return (int)(sli_module.status = sl_explored_add(context(), explored, &shape));
}

/// integers: loops, and where their ends and points lie.
SLI_EXPORT(int, explored_area, sl_explored *explored) {
    sl_shape shape = {0};
    sli_done(sl_explored_area(context(), explored, &shape));
    sli_module.integers[0] = (uint32_t)shape.count;
    sli_module.integers[1] = (uint32_t)(uintptr_t)shape.ends;
    sli_module.integers[2] = (uint32_t)(uintptr_t)shape.points;
    return (int)sli_module.status;
}

/// integers: whether the area holds a point.
SLI_EXPORT(int, explored_holds, sl_explored *explored, double x, double y) {
    bool holds = false;
    sli_done(sl_explored_holds(context(), explored, (sl_point){x, y}, &holds));
    sli_module.integers[0] = holds;
    return (int)sli_module.status;
}

/// integers: the size of the text, and where it lies; explored_drop() frees it.
SLI_EXPORT(int, explored_write, sl_explored *explored) {
    sl_bytes text = {0};
    sli_done(sl_explored_write(context(), explored, &text));
    sli_module.integers[0] = (uint32_t)text.size;
    sli_module.integers[1] = (uint32_t)(uintptr_t)text.data;
    return (int)sli_module.status;
}

SLI_EXPORT(void, explored_drop, void *text) {
    sl_free(context(), text);
}

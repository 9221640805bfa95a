// Tables of viewpoints: whatever is read has usable values, and reads back the same from what is
// written.
#include "fuzz.h"

#include "sightline/viewpoint.h"

#include <math.h>

static const sl_viewpoint like = {.fov = 360};

static void check(const sl_cameras *cameras) {
    FUZZ_CHECK(cameras->count);
    for (size_t i = 0; i < cameras->count; i++) {
        const sl_camera *c = &cameras->items[i];
        FUZZ_CHECK(isfinite(c->view.at.x) && isfinite(c->view.at.y) && isfinite(c->view.heading));
        FUZZ_CHECK(c->view.fov > 0 && c->view.fov <= 360);
        FUZZ_CHECK(c->view.range >= 0 && c->view.nearest >= 0 && c->cost > 0);
    }
}

static void check_same(const sl_cameras *a, const sl_cameras *b) {
    FUZZ_CHECK(a->count == b->count);
    for (size_t i = 0; i < a->count; i++) {
        const sl_camera *c = &a->items[i], *d = &b->items[i];
        FUZZ_CHECK(!c->name == !d->name && (!c->name || strcmp(c->name, d->name) == 0));
        FUZZ_CHECK(c->view.at.x == d->view.at.x && c->view.at.y == d->view.at.y);
        FUZZ_CHECK(c->view.heading == d->view.heading && c->view.fov == d->view.fov);
        FUZZ_CHECK(c->view.range == d->view.range && c->view.nearest == d->view.nearest);
        FUZZ_CHECK(c->height == d->height && c->tilt == d->tilt && c->cost == d->cost);
    }
}

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size) {
    sl_context *context = fuzz_context();
    sl_cameras cameras, back;
    const sl_status status =
        sl_cameras_parse(context, "input", (const char *)data, size, &like, &cameras);
    if (status == SL_OK) {
        char *text = NULL;
        size_t length;
        FILE *out = open_memstream(&text, &length);
        FUZZ_CHECK(out);
        check(&cameras);
        sl_cameras_print(&cameras, out);
        FUZZ_CHECK(fclose(out) == 0);
        FUZZ_CHECK(sl_cameras_parse(context, "back", text, length, &like, &back) == SL_OK);
        check_same(&cameras, &back);
        sl_cameras_destroy(context, &back);
        free(text);
    } else {
        FUZZ_CHECK(status == SL_BAD_INPUT && !cameras.count && !cameras.items);
        FUZZ_CHECK(strncmp(sl_context_message(context), "input:", 6) == 0);
    }
    sl_cameras_destroy(context, &cameras);
    sl_context_destroy(context);
    return 0;
}

// Writers: whatever map text is read is written in every format of other programs, and read back.
// What the format has a place for is there again, at the same places.
#include "fuzz.h"
#include "map/scan.h"

/// The same place. Writers make 0 of -0.
static bool same_place(sl_segment a, sl_segment b) {
    return a.a.x == b.a.x && a.a.y == b.a.y && a.b.x == b.b.x && a.b.y == b.b.y;
}

/// Whether one-way glass or a seam is there again. Walls that do not stop all are seams, and come
/// in another order, by what they stop.
static bool is_among(const sl_glass *one, const sl_glass *items, size_t count) {
    for (size_t i = 0; i < count; i++)
        if (same_place(one->segment, items[i].segment) && one->stops == items[i].stops) return true;
    return false;
}

/// Whether the things are there again that have a length. Walls of no length are not.
static bool has_all(const sl_map *map, const sl_map *back, unsigned keeps) {
    const struct {
        unsigned keeps;
        size_t count, again;
        const sl_glass *items, *items_again;
    } glass[] = {
        {SL_KEEPS_ONEWAYS, map->oneway_count, back->oneway_count, map->oneways, back->oneways},
        {SL_KEEPS_SEAMS, map->seam_count, back->seam_count, map->seams, back->seams},
    };
    for (size_t i = 0; i < sizeof glass / sizeof *glass; i++) {
        if (!(keeps & glass[i].keeps)) continue;
        if (glass[i].count != glass[i].again) return false;
        for (size_t k = 0; k < glass[i].count; k++)
            if (!is_among(&glass[i].items[k], glass[i].items_again, glass[i].again)) return false;
    }
    if (keeps & SL_KEEPS_MIRRORS && map->mirror_count != back->mirror_count) return false;
    if (map->door_count != back->door_count) return false;
    for (size_t i = 0; i < map->door_count; i++)
        if (!same_text(map->doors[i].name, back->doors[i].name) ||
            map->doors[i].open != back->doors[i].open ||
            !same_place(map->doors[i].segment, back->doors[i].segment))
            return false;
    return map->precision == back->precision;
}

/// Leaves out what limits sight, as sl_map_write does for formats without a place for it.
static void unlimit(sl_map *map) {
    size_t kept = 0;
    for (size_t i = 0; i < map->seam_count; i++) {
        sl_glass seam = map->seams[i];
        seam.stops &= SL_STOPS_ALL;
        if (seam.stops || !map->seams[i].stops) map->seams[kept++] = seam;
    }
    map->seam_count = kept;
}

static void trip(sl_context *context, const sl_map *map, const sl_map_format *format) {
    char *text = NULL;
    size_t size;
    FILE *stream = open_memstream(&text, &size);
    FUZZ_CHECK(stream);
    const sl_status written = format->write(context, map, stream);
    FUZZ_CHECK(fclose(stream) == 0);
    if (written == SL_UNSUPPORTED) free(text);
    if (written == SL_UNSUPPORTED) return; // a name that XML cannot have
    FUZZ_CHECK(written == SL_OK);
    sl_import_options options = sl_import_options_default();
    options.doors = true;
    sl_map back = {0};
    const sl_status status = format->read(context, "back", text, size, &options, &back);
    // Tiled maps without walls are refused.
    if (status != SL_OK) FUZZ_CHECK(strcmp(format->name, "tmx") == 0);
    if (status == SL_OK) FUZZ_CHECK(has_all(map, &back, format->keeps));
    sl_map_destroy(context, &back);
    free(text);
}

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size) {
    sl_context *context = fuzz_context();
    sl_map map = {0};
    FUZZ_CHECK(sl_io_use(context) == SL_OK);
    if (sli_map_read_text(context, "input", (const char *)data, size, &map) == SL_OK) {
        size_t count;
        const sl_map_format *formats = sl_map_formats(context, &count);
        for (size_t i = 2; i < count; i++)
            if (formats[i].write && formats[i].keeps & SL_KEEPS_LIMITED)
                trip(context, &map, &formats[i]);
        unlimit(&map);
        for (size_t i = 2; i < count; i++)
            if (formats[i].write && !(formats[i].keeps & SL_KEEPS_LIMITED))
                trip(context, &map, &formats[i]);
    }
    sl_map_destroy(context, &map);
    sl_context_destroy(context);
    return 0;
}

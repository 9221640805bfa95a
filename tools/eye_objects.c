#include "eye_objects.h"

#include "compare_report.h"
#include "names.h"
#include "sightline/support.h"

#include <inttypes.h>
#include <math.h>
#include <string.h>

// --- reading

static sl_status refuse(sl_context *context, const char *text, const sl_map *map) {
    const sl_name_table objects = {"object", map->objects, sizeof *map->objects, map->object_count};
    char names[SL_NAME_LIST];
    sl_name_list(&objects, names);
    return sl_fail(context, SL_BAD_ARGUMENT,
                   "--object %s: X0,Y0,X1,Y1 is needed, or one of the map's objects: %s; with "
                   "',block' behind it, it blocks sight",
                   text, names);
}

static bool read_box(const char *text, size_t length, sl_box *out) {
    double values[4];
    const char *at = text, *end = text + length;
    for (int i = 0; i < 4; i++) {
        const char *stop = i < 3 ? memchr(at, ',', (size_t)(end - at)) : end;
        if (!stop || !sl_number_read(at, (size_t)(stop - at), &values[i]) || !isfinite(values[i]))
            return false;
        at = stop + 1;
    }
    *out = (sl_box){{fmin(values[0], values[2]), fmin(values[1], values[3])},
                    {fmax(values[0], values[2]), fmax(values[1], values[3])}};
    return true;
}

static bool find_box(const char *text, size_t length, const sl_map *map, sl_box *out) {
    for (size_t i = 0; i < map->object_count; i++) {
        const char *name = map->objects[i].name;
        if (strlen(name) != length || memcmp(name, text, length) != 0) continue;
        *out = map->objects[i].box;
        return true;
    }
    return false;
}

static sl_status read_object(sl_context *context, const char *text, const sl_map *map,
                             sl_moving_box *out) {
    static const char block[] = ",block";
    size_t length = strlen(text);
    const size_t tail = sizeof block - 1;
    out->blocks = length > tail && strcmp(text + length - tail, block) == 0;
    if (out->blocks) length -= tail;
    if (read_box(text, length, &out->box) || find_box(text, length, map, &out->box)) return SL_OK;
    return refuse(context, text, map);
}

sl_status sl_eye_objects_read(sl_context *context, const sl_option_list *texts, const sl_map *map,
                              sl_eye_objects *out) {
    out->count = texts->count;
    out->boxes = sl_alloc_array(context, texts->count, sizeof *out->boxes);
    out->objects = sl_alloc_array(context, texts->count, sizeof *out->objects);
    out->seen = sl_alloc_array(context, texts->count, sizeof *out->seen);
    out->mirrored = sl_alloc_array(context, texts->count, sizeof *out->mirrored);
    if (!out->boxes || !out->objects || !out->seen || !out->mirrored) return SL_NO_MEMORY;
    for (size_t i = 0; i < texts->count; i++) {
        out->objects[i].text = texts->items[i];
        SL_TRY(read_object(context, texts->items[i], map, &out->boxes[i]));
    }
    return SL_OK;
}

void sl_eye_objects_destroy(sl_context *context, sl_eye_objects *objects) {
    sl_free(context, objects->boxes);
    sl_free(context, objects->objects);
    sl_free(context, objects->seen);
    sl_free(context, objects->mirrored);
    sl_free(context, objects->cells);
    sl_free(context, objects->mirrored_cells);
    sl_mirrored_region_destroy(context, &objects->mirrored_region);
    sl_region_destroy(context, &objects->region);
    *objects = (sl_eye_objects){0};
}

// --- looking

static bool meet(const uint64_t *a, const uint64_t *b, size_t words) {
    for (size_t i = 0; i < words; i++)
        if (a[i] & b[i]) return true;
    return false;
}

/// The loosest of the methods keeps the whole visible set, the last one what is seen.
static sl_status find_cells(sl_context *context, const sl_baked *baked, const sl_eye_run *run,
                            sl_eye_objects *o) {
    const size_t words = sl_eye_words(&baked->space);
    uint64_t *cells = sl_alloc_array(context, words, sizeof *cells);
    if (!cells) return SL_NO_MEMORY;
    for (size_t i = 0; i < o->count; i++) {
        sl_cells_of_box(&baked->space, o->boxes[i].box, cells);
        for (uint32_t c = 0; c < baked->space.cell_count; c++)
            o->objects[i].cells += sl_eye_sees(cells, c);
        o->objects[i].possible = meet(cells, run->results[0].cells, words);
        o->objects[i].in_exact = meet(cells, run->results[run->result_count - 1].cells, words);
    }
    sl_free(context, cells);
    return SL_OK;
}

/// What is seen in mirrors, before which the objects stand and in which they are seen.
static sl_status look_in_mirrors(sl_context *context, const sl_baked *baked, const sl_eye_run *run,
                                 sl_moving *moving, const sl_outline *outline, sl_eye_objects *o) {
    sl_eye_account account;
    sl_room_mirrors mirrors = {0};
    o->has_mirrors = run->has_mirrors;
    if (!run->has_mirrors) return SL_OK;
    o->mirrored_cells =
        sl_alloc_array(context, sl_eye_words(&baked->space), sizeof *o->mirrored_cells);
    if (!o->mirrored_cells) return SL_NO_MEMORY;
    SL_TRY(sl_moving_add_mirrors(context, moving, &baked->map, run->mirror_depth));
    SL_TRY(sl_moving_look_mirrored(context, moving, &run->view, o->mirrored_cells, o->mirrored,
                                   &account));
    sl_eye_measure(baked, run->cell, o->mirrored_cells, &o->mirrored_count, &o->mirrored_share);
    sl_status status = sl_room_mirrors_make(context, outline, &baked->map, &mirrors);
    if (status == SL_OK)
        status = sl_mirrored_region_make(context, &mirrors, &run->view, run->range,
                                         run->mirror_depth, &o->mirrored_region);
    sl_room_mirrors_destroy(context, &mirrors);
    return status;
}

static sl_status look(sl_context *context, const sl_baked *baked, const sl_eye_run *run,
                      sl_moving *moving, bool timed, sl_eye_objects *o) {
    const sl_outline *outline;
    sl_eye_account account;
    const double start = sl_now();
    SL_TRY(sl_moving_place(context, moving, o->boxes, o->count));
    SL_TRY(sl_moving_outline(context, moving, &outline));
    if (timed) o->seconds = sl_now() - start;
    sl_moving_limit(moving, run->range);
    SL_TRY(sl_moving_look(context, moving, &run->view, o->cells, o->seen, &account));
    sl_eye_measure(baked, run->cell, o->cells, &o->cell_count, &o->share);
    SL_TRY(sl_region_make(context, outline, &run->view, run->range, &o->region));
    const double direct = sl_region_area(&run->region);
    o->region_share = direct > 0 ? run->region_share * sl_region_area(&o->region) / direct : 0;
    return look_in_mirrors(context, baked, run, moving, outline, o);
}

sl_status sl_eye_objects_run(sl_context *context, const sl_baked *baked, const sl_eye_run *run,
                             bool timed, sl_eye_objects *objects) {
    sl_moving *moving;
    if (!objects->count) return SL_OK;
    objects->cells = sl_alloc_array(context, sl_eye_words(&baked->space), sizeof *objects->cells);
    if (!objects->cells) return SL_NO_MEMORY;
    SL_TRY(find_cells(context, baked, run, objects));
    SL_TRY(sl_moving_create(context, &baked->space, &baked->visibility, &moving));
    const sl_status status = look(context, baked, run, moving, timed, objects);
    sl_moving_destroy(context, moving);
    return status;
}

// --- telling

static const char *say(const sl_eye_objects *o, size_t i) {
    if (o->seen[i]) return o->mirrored[i] ? "seen, by mirror too" : "seen";
    if (o->mirrored[i]) return "seen by mirror";
    if (!o->objects[i].possible) return "hidden: not in the visible set of the eye's cell";
    return o->objects[i].in_exact ? "hidden, in a cell that is seen"
                                  : "hidden: its cells are not seen from here";
}

void sl_eye_objects_print(const sl_eye_objects *objects) {
    char seconds[SL_SECONDS_TEXT];
    if (!objects->count) return;
    printf("\nobjects, put in without a new bake");
    if (objects->seconds > 0) {
        sl_seconds_write(objects->seconds, "u", seconds);
        printf(" in %s", seconds);
    }
    puts(":");
    for (size_t i = 0; i < objects->count; i++)
        printf("  %-24s in %" PRIu32 " cell%s; %s\n", objects->objects[i].text,
               objects->objects[i].cells, objects->objects[i].cells == 1 ? "" : "s",
               say(objects, i));
    printf("past them %" PRIu32 " cells are seen, %.2f %%; visible area %.2f %%\n",
           objects->cell_count, 100 * objects->share, 100 * objects->region_share);
    if (objects->has_mirrors)
        printf("by mirror past them %" PRIu32 " cells, %.2f %%; area in mirrors %.6g\n",
               objects->mirrored_count, 100 * objects->mirrored_share,
               sl_mirrored_area(&objects->mirrored_region));
}

/// Whether an object before it was given by the same text: a key stands once in an object.
static bool is_repeated(const sl_eye_objects *objects, size_t index) {
    for (size_t i = 0; i < index; i++)
        if (strcmp(objects->objects[i].text, objects->objects[index].text) == 0) return true;
    return false;
}

void sl_eye_objects_add_json(sl_json_fields *fields, const sl_baked *baked,
                             const sl_eye_objects *objects) {
    if (!objects->count) return;
    sl_json_fields sets = sl_json_begin(), seen = sl_json_begin(), region = sl_json_begin();
    for (size_t i = 0; i < objects->count; i++)
        if (!is_repeated(objects, i))
            sl_json_add_flag(&seen, objects->objects[i].text, objects->seen[i]);
    sl_json_add_fields(fields, "objects_seen", &seen);
    if (objects->has_mirrors) {
        sl_json_fields mirrored = sl_json_begin();
        for (size_t i = 0; i < objects->count; i++)
            if (!is_repeated(objects, i))
                sl_json_add_flag(&mirrored, objects->objects[i].text, objects->mirrored[i]);
        sl_json_add_fields(fields, "objects_mirrored", &mirrored);
        sl_json_add_members(&sets, "mirrored_cells", objects->mirrored_cells,
                            baked->space.cell_count);
    }
    sl_json_add_members(&sets, "cells", objects->cells, baked->space.cell_count);
    const sl_region_measures measures = sl_region_measure(&objects->region);
    sl_json_add_real(&region, "area", measures.area);
    sl_json_add_real(&region, "perimeter", measures.perimeter);
    sl_json_add_points(&region, "polygon", objects->region.points, objects->region.count);
    sl_json_add_fields(&sets, "region", &region);
    sl_json_add_fields(fields, "past_objects", &sets);
}

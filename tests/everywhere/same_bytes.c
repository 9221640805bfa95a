/// What must be the same on every machine, as one line of hashes for a map: same_bytes MAP...
///
/// It bakes each map and, after them, maps that it generates itself: every kind, by many seeds, as
/// it is and turned. A line holds the number of bytes of the baked file, their hash, the hash of
/// what the runtime header answers about the file, and the map's name. The answers are places, what
/// eyes see there, with doors open and shut, and the polygons of what they see, to the last bit.
/// Lines that differ between two machines show which map, and whether the bake or the header.
#include <inttypes.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#define SIGHTLINE_RUNTIME_IMPLEMENTATION
#include "sightline_runtime.h"

#include "sightline/generate.h"
#include "sightline/sightline.h"
#include "sightline/support.h"
#ifdef __wasm__
#include "bindings/js/src/bindings.h"
#endif

enum { PLACES = 12, SEEDS = 9 };
static const char *const file_name = "same_bytes.slv";

/// FNV-1a: a hash of bytes, to compare and no more.
static uint64_t add_bytes(uint64_t hash, const void *bytes, size_t count) {
    const unsigned char *at = bytes;
    for (size_t i = 0; i < count; i++) hash = (hash ^ at[i]) * 0x100000001b3;
    return hash;
}
static const uint64_t empty_hash = 0xcbf29ce484222325;

/// Numbers count by their value, whatever the order of their bytes is here.
static uint64_t add_number(uint64_t hash, uint64_t number) {
    unsigned char bytes[8];
    for (int i = 0; i < 8; i++) bytes[i] = (unsigned char)(number >> (8 * i));
    return add_bytes(hash, bytes, sizeof bytes);
}

static uint64_t add_double(uint64_t hash, double value) {
    uint64_t bits;
    memcpy(&bits, &value, sizeof bits);
    return add_number(hash, bits);
}

/// Ends the program with a message: what stands here must not fail anywhere.
static void must(sl_context *context, sl_status status, const char *what) {
    if (status == SL_OK) return;
    fprintf(stderr, "same_bytes: %s: %s\n", what, sl_context_message(context));
    exit(1);
}

static void *must_have(void *memory) {
    if (!memory) abort();
    return memory;
}

/// Not by the library: its module for WebAssembly has no files.
static void read_map(sl_context *context, const char *path, sl_map *map) {
    enum { ROOM = 1 << 20 };
    char *text = must_have(malloc(ROOM));
    FILE *file = fopen(path, "rb");
    const size_t size = file ? fread(text, 1, ROOM, file) : 0;
    if (!size || size == ROOM || fclose(file)) {
        fprintf(stderr, "same_bytes: %s: not read\n", path);
        exit(1);
    }
    must(context, sl_map_parse(context, path, text, size, NULL, map), path);
    free(text);
}

/// What is written as a baked file: at NULL, or to be freed.
static void take_file(sl_context *context, const sl_baked *baked, sl_bytes *file) {
    must(context, sl_baked_write(context, baked, file_name), file_name);
#ifdef __wasm__
    size_t size;
    const char *written = sli_written(&size);
    *file = (sl_bytes){.data = must_have(sl_alloc(context, size)), .size = size};
    memcpy(file->data, written, size);
#else
    must(context, sl_file_read(context, file_name, file), file_name);
#endif
}

typedef struct answers {
    sl_runtime runtime;
    uint32_t *scratch, *cells;
    double *points;
    uint32_t point_room;
    unsigned char *shut;
} answers;

static uint64_t add_polygon(uint64_t hash, answers *a, const sl_runtime_view *view, double range) {
    uint32_t count = sl_runtime_visible_polygon(&a->runtime, view, a->shut, range, a->scratch,
                                                a->points, a->point_room);
    if (count > a->point_room) {
        a->point_room = count;
        a->points = must_have(realloc(a->points, (size_t)count * 2 * sizeof *a->points));
        count = sl_runtime_visible_polygon(&a->runtime, view, a->shut, range, a->scratch, a->points,
                                           a->point_room);
    }
    hash = add_number(hash, count);
    for (uint32_t i = 0; i < 2 * count; i++) hash = add_double(hash, a->points[i]);
    return hash;
}

static uint64_t add_place(uint64_t hash, answers *a, double x, double y) {
    sl_runtime *runtime = &a->runtime;
    hash = add_number(hash, sl_runtime_locate(runtime, x, y));
    const sl_runtime_view views[] = {sl_runtime_view_all_round(x, y),
                                     sl_runtime_view_toward(x, y, 3, 4, 0.5)};
    const double range = (runtime->max_x - runtime->min_x) / 4;
    for (size_t i = 0; i < 2; i++) {
        const uint32_t count = sl_runtime_look_past(runtime, &views[i], a->shut, 0, a->scratch,
                                                    a->cells, runtime->cell_count);
        hash = add_number(hash, count);
        for (uint32_t k = 0; k < count; k++) hash = add_number(hash, a->cells[k]);
        hash = add_polygon(hash, a, &views[i], 0);
        hash = add_polygon(hash, a, &views[i], range);
    }
    return hash;
}

static uint64_t add_answers(uint64_t hash, answers *a) {
    const sl_runtime *runtime = &a->runtime;
    for (int row = 0; row < PLACES; row++)
        for (int column = 0; column < PLACES; column++) {
            const double u = (column + 0.37) / PLACES, v = (row + 0.61) / PLACES;
            hash = add_place(hash, a, runtime->min_x + u * (runtime->max_x - runtime->min_x),
                             runtime->min_y + v * (runtime->max_y - runtime->min_y));
        }
    for (uint32_t cell = 0; cell < runtime->cell_count; cell++)
        hash = add_number(hash, sl_runtime_row_count(runtime, cell));
    return hash;
}

/// The answers about a file, first with the doors that are open, then with all of them shut.
static uint64_t hash_answers(const sl_bytes *file, const char *name) {
    answers a = {0};
    const sl_runtime_status status = sl_runtime_open(file->data, file->size, &a.runtime);
    if (status != SL_RUNTIME_OK) {
        fprintf(stderr, "same_bytes: %s: %s\n", name, sl_runtime_status_text(status));
        exit(1);
    }
    const uint32_t doors = a.runtime.door_count;
    a.scratch = must_have(malloc((sl_runtime_scratch_count(&a.runtime) + 1) * sizeof *a.scratch));
    a.cells = must_have(malloc(((size_t)a.runtime.cell_count + 1) * sizeof *a.cells));
    a.shut = must_have(calloc((size_t)doors + 1, 1));
    uint64_t hash = empty_hash;
    for (uint32_t i = 0; i < doors; i++) a.shut[i] = !sl_runtime_door_open(&a.runtime, i);
    hash = add_answers(hash, &a);
    if (doors) {
        memset(a.shut, 1, doors);
        hash = add_answers(hash, &a);
    }
    free(a.scratch);
    free(a.cells);
    free(a.points);
    free(a.shut);
    return hash;
}

/// Bakes a map, which is then empty, and prints its line.
static void print_map(sl_context *context, const char *name, sl_map *map) {
    sl_baked baked = {0};
    sl_bytes file = {0};
    must(context, sl_bake(context, map, NULL, &baked, NULL), name);
    take_file(context, &baked, &file);
    printf("%zu %016" PRIx64 " %016" PRIx64 " %s\n", file.size,
           add_bytes(empty_hash, file.data, file.size), hash_answers(&file, name), name);
    sl_free(context, file.data);
    sl_baked_destroy(context, &baked);
    sl_map_destroy(context, map);
}

static void print_generated(sl_context *context, const sl_map_kind *kind, uint64_t seed,
                            double turned, bool in_line) {
    sl_generate_options options = sl_generate_options_default();
    options.seed = seed;
    options.walls = 150 + 20 * seed;
    options.turned = turned;
    options.in_line = in_line;
    char name[80];
    snprintf(name, sizeof name, "%s:%" PRIu64 ":%g%s", kind->name, seed, turned,
             in_line ? ":in-line" : "");
    sl_map map = {0};
    must(context, sl_generate(context, kind, &options, &map), name);
    print_map(context, name, &map);
}

/// The same walls, but for some that are doors, mirrors and one-way glass.
static void put_effects(sl_context *context, const sl_map *from, sl_map *map) {
    for (size_t i = 0; i < from->wall_count; i++) {
        const sl_wall *wall = &from->walls[i];
        const sl_segment at = {wall->a, wall->b};
        char door[24];
        snprintf(door, sizeof door, "d%zu", i % 5);
        const sl_status status = i % 13 == 2   ? sl_map_add_door(context, map, door, at, i % 2, 0)
                                 : i % 13 == 6 ? sl_map_add_mirror(context, map, at, 0)
                                 : i % 13 == 9 ? sl_map_add_oneway(context, map, at, 0)
                                               : sl_map_add_wall(context, map, wall->a, wall->b, 0);
        must(context, status, "effects");
    }
}

static void print_effects(sl_context *context, const sl_map_kind *kind, uint64_t seed) {
    sl_generate_options options = sl_generate_options_default();
    options.seed = seed;
    options.walls = 100;
    options.turned = seed % 2 ? 0 : 28.1;
    char name[80];
    snprintf(name, sizeof name, "%s:%" PRIu64 ":effects", kind->name, seed);
    sl_map walls = {0}, map = {0};
    must(context, sl_generate(context, kind, &options, &walls), name);
    put_effects(context, &walls, &map);
    sl_map_destroy(context, &walls);
    print_map(context, name, &map);
}

/// The name of a file without its folders.
static const char *base_name(const char *path) {
    const char *name = path;
    for (; *path; path++)
        if (*path == '/' || *path == '\\') name = path + 1;
    return name;
}

int main(int argc, char **argv) {
    sl_context *context = must_have(sl_context_create(NULL));
    for (int i = 1; i < argc; i++) {
        sl_map map = {0};
        read_map(context, argv[i], &map);
        print_map(context, base_name(argv[i]), &map);
    }
    size_t count;
    const sl_map_kind *kinds = sl_map_kinds(&count);
    for (size_t i = 0; i < count; i++)
        for (uint64_t seed = 1; seed <= SEEDS; seed++) {
            print_generated(context, &kinds[i], seed, 0, false);
            print_generated(context, &kinds[i], seed, 17.3, seed % 2);
            print_effects(context, &kinds[i], seed);
        }
    remove(file_name);
    sl_context_destroy(context);
    return 0;
}

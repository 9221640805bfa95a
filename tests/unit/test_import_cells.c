// GL nodes of a WAD as cells: each version, and each way in which they can be broken.
#include "testing.h"

#include "io/io_formats.h"
#include "sightline/io.h"
#include "sightline/space.h"
#include "space/subdivide.h"
#include "wad_make.h"

#include <unistd.h>

enum { SEGS = 17 };

/// The subsectors of the two rooms and the door between them, clockwise: start, end and linedef of
/// each seg. Vertex 100 is the first of GL_VERT: the middle of room 0's upper wall.
static const int segs[SEGS][3] = {
    {0, 1, 0},   {1, 100, 1}, {100, 2, 1}, {2, 3, 2},  {3, 10, 12}, {10, 11, 10},
    {11, 0, 11}, {3, 4, 3},   {4, 9, 13},  {9, 10, 9}, {10, 3, 12}, {4, 5, 4},
    {5, 6, 5},   {6, 7, 6},   {7, 8, 7},   {8, 9, 8},  {9, 4, 13},
};
static const int subsectors[3][2] = {{7, 0}, {4, 7}, {6, 11}};

/// What to spoil in the lumps.
typedef struct spoil {
    const char *left_out; ///< a lump
    int vertex, first_seg, cut;
    const char *mark; ///< of GL_VERT
    const char *header;
} spoil;

static void add_segs(wad_made *wad, int version, const spoil *wrong) {
    unsigned char bytes[4 + SEGS * 16] = {0};
    const size_t skip = version == 3 ? 4 : 0, record = version >= 3 ? 16 : 10;
    if (skip) memcpy(bytes, "gNd3", 4);
    const uint32_t flag = version == 5 ? 0x80000000u : version == 3 ? 0x40000000u : 0x8000u;
    for (size_t i = 0; i < SEGS; i++) {
        unsigned char *at = bytes + skip + i * record;
        for (size_t k = 0; k < 2; k++) {
            const int own = i == 0 && k == 0 && wrong->vertex ? wrong->vertex : segs[i][k];
            const uint32_t vertex = own >= 100 ? flag | (uint32_t)(own - 100) : (uint32_t)own;
            if (version >= 3)
                wad_u32(at + 4 * k, vertex);
            else
                wad_u16(at + 2 * k, (int)vertex);
        }
        wad_u16(at + (version >= 3 ? 8 : 4), segs[i][2]);
    }
    wad_lump(wad, "GL_SEGS", bytes, skip + SEGS * record - (size_t)wrong->cut);
}

static void add_subsectors(wad_made *wad, int version, const spoil *wrong) {
    unsigned char bytes[4 + 3 * 8] = {0};
    const size_t skip = version == 3 ? 4 : 0, record = version >= 3 ? 8 : 4;
    if (skip) memcpy(bytes, "gNd3", 4);
    for (size_t i = 0; i < 3; i++) {
        unsigned char *at = bytes + skip + i * record;
        const int first = subsectors[i][1] + (i == 2 ? wrong->first_seg : 0);
        wad_u16(at, subsectors[i][0]);
        wad_u16(at + record / 2, first);
    }
    wad_lump(wad, "GL_SSECT", bytes, skip + 3 * record);
}

static void make(wad_made *wad, int version, const spoil *wrong) {
    static const char *const marks[] = {"", "", "gNd2", "gNd2", "", "gNd5"};
    const char *left_out = wrong->left_out ? wrong->left_out : "";
    unsigned char vertices[12] = {0};
    size_t size = 0;
    if (version > 1) {
        memcpy(vertices, wrong->mark ? wrong->mark : marks[version], 4);
        wad_u32(vertices + 4, 32u << 16 | 0x4000);
        wad_u32(vertices + 8, 64u << 16);
        size = 12;
    } else {
        wad_u16(vertices, 32);
        wad_u16(vertices + 2, 64);
        size = 4;
    }
    wad_begin(wad);
    wad_two_rooms(wad, "MAP01", 0, 0, 128, NULL);
    wad_lump(wad, wrong->header ? wrong->header : "GL_MAP01", "LEVEL=MAP01\n", 12);
    if (strcmp(left_out, "GL_VERT") != 0) wad_lump(wad, "GL_VERT", vertices, size);
    if (strcmp(left_out, "GL_SEGS") != 0) add_segs(wad, version, wrong);
    if (strcmp(left_out, "GL_SSECT") != 0) add_subsectors(wad, version, wrong);
    wad_end(wad);
}

static sl_status read_cells(sl_context *context, int version, const spoil *wrong, sl_map *map) {
    wad_made wad;
    make(&wad, version, wrong);
    const sl_import_options options = {.cells = true};
    // Read from a block of its own size, so that a byte too far is seen.
    char *copy = malloc(wad.size + 1);
    assert_non_null(copy);
    memcpy(copy, wad.bytes, wad.size);
    const sl_status status = sli_map_read_wad(context, "in.wad", copy, wad.size, &options, map);
    free(copy);
    free(wad.bytes);
    return status;
}

static void test_versions(void **state) {
    (void)state;
    sl_context *context = testing_context(NULL);
    const int versions[] = {1, 2, 3, 5, 5};
    for (size_t i = 0; i < sizeof versions / sizeof *versions; i++) {
        const spoil none = {.header = i == 4 ? "GL_LEVEL" : NULL};
        sl_map map = {0};
        sl_space space = {0};
        assert_ok(context, read_cells(context, versions[i], &none, &map));
        assert_int_equal(map.cell_count, 3);
        assert_int_equal(map.corner_count, SEGS);
        assert_true(map.corners[2].x == (versions[i] == 1 ? 32 : 32.25) && map.corners[2].y == 64);
        assert_ok(context, sli_subdivide_given(context, &map, &space));
        // Two are above and below the door, where no subsector is.
        assert_int_equal(space.cell_count, 5);
        assert_int_equal(space.portal_count, 2);
        assert_ok(context, sl_space_check(context, &space));
        sl_space_destroy(context, &space);
        sl_map_destroy(context, &map);
    }
    sl_context_destroy(context);
}

/// Walls that welding has cut at the corners of cells are known as the WAD's.
static void test_reject(void **state) {
    (void)state;
    sl_context *context = testing_context(NULL);
    char folder[] = "/tmp/sightline-cells-XXXXXX", in[100];
    assert_non_null(mkdtemp(folder));
    snprintf(in, sizeof in, "%s/in.wad", folder);
    for (int with_cells = 1; with_cells >= 0; with_cells--) {
        const spoil none = {.header = with_cells ? NULL : "OTHER"};
        const sl_export_options options = {.wad = in, .map = "MAP01"};
        wad_made wad;
        make(&wad, 5, &none);
        FILE *file = fopen(in, "wb");
        assert_non_null(file);
        assert_int_equal(fwrite(wad.bytes, 1, wad.size, file), wad.size);
        assert_int_equal(fclose(file), 0);
        free(wad.bytes);
        sl_map map = {0};
        sl_baked baked = {0};
        assert_ok(context, read_cells(context, 5, &(spoil){0}, &map));
        testing_subdivide(context, &map, &baked.space);
        sl_see_options see = sl_see_options_default();
        assert_ok(context,
                  testing_method("sweep")->see(context, &baked.space, &see, &baked.visibility));
        const sl_status status = sli_export_reject(context, &baked, &options, "/dev/null");
        assert_int_equal(status, with_cells ? SL_OK : SL_BAD_INPUT);
        sl_baked_destroy(context, &baked);
        sl_map_destroy(context, &map);
    }
    remove(in);
    remove(folder);
    sl_context_destroy(context);
}

static void test_refused(void **state) {
    (void)state;
    const struct {
        spoil wrong;
        int version;
        const char *message;
    } cases[] = {
        {{.header = "GL_MAP02"}, 2, "map MAP01 brings no cells: it has no GL nodes"},
        {{.left_out = "GL_VERT"}, 2, "map MAP01, lump GL_VERT: is missing"},
        {{.left_out = "GL_SEGS"}, 5, "map MAP01, lump GL_SEGS: is missing"},
        {{.left_out = "GL_SSECT"}, 1, "map MAP01, lump GL_SSECT: is missing"},
        {{.mark = "gNd4"}, 2, "is of version 4"},
        {{.cut = 1}, 3, "lump GL_SEGS: is cut off"},
        {{.cut = 16}, 5, "subsector 2: segs 11 to 17, but there are 16"},
        {{.first_seg = 3}, 2, "subsector 2: segs 14 to 20, but there are 17"},
        {{.vertex = 12}, 2, "seg 0: vertex 12 of VERTEXES, but there are 12"},
        {{.vertex = 101}, 3, "seg 0: vertex 1 of GL_VERT, but there are 1"},
    };
    sl_context *context = testing_context(NULL);
    for (size_t i = 0; i < sizeof cases / sizeof *cases; i++) {
        sl_map map = {0};
        const sl_status status = read_cells(context, cases[i].version, &cases[i].wrong, &map);
        if (status != SL_BAD_INPUT || !strstr(sl_context_message(context), cases[i].message))
            fail_msg("case %zu: %s", i, sl_context_message(context));
        assert_memory_equal(sl_context_message(context), "in.wad:", 7);
        assert_null(map.walls);
        assert_null(map.cells);
    }
    sl_context_destroy(context);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_versions),
        cmocka_unit_test(test_reject),
        cmocka_unit_test(test_refused),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}

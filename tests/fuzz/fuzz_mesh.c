// Cleaning and meshes: any map text that can be read becomes clean, and its mesh is sound, whatever
// the walls are; without a tolerance a map may be refused, for walls that cross anew each time that
// their crossing is rounded. What is clean stays where it is. A map that contradicts itself in what
// is solid ground is refused; then it is looked at without its marks.
#include "fuzz.h"

#include "map/scan.h"
#include "sightline/space.h"
#include "space/subdivide.h"

#include <string.h>

static void drop_ground(sl_map *map) {
    for (size_t i = 0; i < map->wall_count; i++) map->walls[i].ground = 0;
}

/// Makes the mesh; if the map is refused for its solid ground, again without that.
static sl_status make_mesh(sl_context *context, sl_map *map, sl_space *space) {
    bool marked = false;
    for (size_t i = 0; i < map->wall_count; i++) marked |= map->walls[i].ground != 0;
    const sl_status status = sli_subdivide_mesh(context, map, space);
    if (status != SL_BAD_INPUT) return status;
    FUZZ_CHECK(marked && strstr(sl_context_message(context), "solid ground"));
    drop_ground(map);
    return sli_subdivide_mesh(context, map, space);
}

static void check_mesh(sl_context *context, sl_map *map) {
    sl_space space = {0};
    const sl_status status = make_mesh(context, map, &space);
    if (status == SL_OK) {
        FUZZ_CHECK(sl_space_check(context, &space) == SL_OK);
        for (uint32_t i = 0; i < space.vertex_count; i++)
            FUZZ_CHECK(sl_space_locate(&space, space.vertices[i]) != SL_NO_CELL);
    } else {
        FUZZ_CHECK(status == SL_UNSUPPORTED && !space.cells);
        FUZZ_CHECK(strstr(sl_context_message(context), "larger tolerance"));
    }
    sl_space_destroy(context, &space);
}

static void check_clean(sl_context *context, sl_map *map) {
    sl_map again = {0};
    sl_clean_account account;
    FUZZ_CHECK(sl_map_clean(context, map, NULL, NULL) == SL_OK);
    if (!map->wall_count) return;
    sl_space space = {0};
    FUZZ_CHECK(make_mesh(context, map, &space) == SL_OK);
    FUZZ_CHECK(sl_space_check(context, &space) == SL_OK);
    // Where all is axial, cleaning leaves it to the mesh to cut walls where seams meet them.
    // Walls that do not stop all, but sight, are walls of the space alone; several may lie on each
    // other.
    size_t partial = 0;
    for (size_t i = 0; i < map->seam_count; i++)
        partial += (map->seams[i].stops & SL_STOPS_SIGHT) != 0;
    FUZZ_CHECK(sl_map_is_axial(map) || (space.wall_count >= map->wall_count + (partial > 0) &&
                                        space.wall_count <= map->wall_count + partial));
    sl_space_destroy(context, &space);
    FUZZ_CHECK(sl_map_copy(context, map, &again) == SL_OK);
    FUZZ_CHECK(sl_map_clean(context, &again, &(sl_clean_options){0}, &account) == SL_OK);
    FUZZ_CHECK(account.welded == 0);
    FUZZ_CHECK(map->door_count || account.largest_move == 0); // of a door the parts are forgotten
    sl_map_destroy(context, &again);
}

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size) {
    sl_context *context = fuzz_context();
    sl_map map = {0};
    const sl_status status = sli_map_read_text(context, "input", (const char *)data, size, &map);
    if (status == SL_OK && map.wall_count) {
        sl_map_drop_cells(context, &map);
        check_mesh(context, &map);
        check_clean(context, &map);
    }
    sl_map_destroy(context, &map);
    sl_context_destroy(context);
    return 0;
}

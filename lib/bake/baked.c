/// A baked file in memory: what it holds, whether its space is that of a map, and its end.
#include "sightline/bake.h"

#include "bake/slv.h"
#include "sightline/support.h"

#include <inttypes.h>
#include <string.h>

bool sli_slv_is_name(const char name[16]) {
    static const char letters[] = "abcdefghijklmnopqrstuvwxyz0123456789-";
    size_t length = 0;
    while (length < 16 && name[length] && strchr(letters, name[length])) length++;
    const char zeros[16] = {0};
    return length < 16 && memcmp(name + length, zeros, 16 - length) == 0;
}

bool sl_baked_counts(const sl_baked *baked, uint32_t cell) {
    const sl_pvs *pvs = &baked->visibility.pvs;
    if (cell < pvs->cell_count && pvs->offsets[cell] == pvs->offsets[cell + 1]) return false;
    if (baked->space.cells[cell].solid) return false;
    return !baked->map.start_count || baked->space.cells[cell].inside;
}

bool sl_baked_is_shard(const sl_baked *baked) {
    return sl_partial_begun(&baked->partial) && baked->partial.shard_count;
}

void sl_baked_say_partial(const sl_baked *baked, char text[SL_PARTIAL_TEXT]) {
    text[0] = '\0';
    if (!sl_partial_begun(&baked->partial)) return;
    size_t count;
    const sl_see_method *methods = sl_see_methods(&count);
    const char *units = "units";
    for (size_t i = 0; i < count; i++)
        if (methods[i].units && strcmp(methods[i].name, baked->method) == 0)
            units = methods[i].units;
    snprintf(text, SL_PARTIAL_TEXT,
             "partial: %" PRIu32 " of %" PRIu32 " %s looked at; what is not decided counts as seen",
             baked->partial.done_count, baked->partial.unit_count, units);
}

/// Whether two arrays are the same, of items without padding.
#define SAME_ITEMS(a, b, items, count)                                                             \
    ((a)->count == (b)->count &&                                                                   \
     (!(a)->count || memcmp((a)->items, (b)->items, (a)->count * sizeof *(a)->items) == 0))

static bool same_walls(const sl_space *a, const sl_space *b) {
    if (a->wall_count != b->wall_count) return false;
    for (uint32_t i = 0; i < a->wall_count; i++)
        if (memcmp(&a->walls[i].a, &b->walls[i].a, sizeof(sl_point)) != 0 ||
            memcmp(&a->walls[i].b, &b->walls[i].b, sizeof(sl_point)) != 0)
            return false;
    return true;
}

bool sl_baked_same_space(const sl_space *a, const sl_space *b) {
    return a->root == b->root && a->loose == b->loose && SAME_ITEMS(a, b, nodes, node_count) &&
           SAME_ITEMS(a, b, cells, cell_count) && SAME_ITEMS(a, b, vertices, vertex_count) &&
           SAME_ITEMS(a, b, portals, portal_count) && SAME_ITEMS(a, b, directed, directed_count) &&
           SAME_ITEMS(a, b, seams, seam_count) &&
           SAME_ITEMS(a, b, seam_portals, seam_portal_count) &&
           SAME_ITEMS(a, b, passages, passage_count) && same_walls(a, b) &&
           !a->neighbour == !b->neighbour &&
           (!a->neighbour ||
            memcmp(a->neighbour, b->neighbour, a->vertex_count * sizeof *a->neighbour) == 0);
}

sl_status sl_baked_copy_map(sl_context *context, const sl_baked *baked, sl_map *out) {
    const sl_space *space = &baked->space;
    sl_map map = {0};
    sl_status status = sl_map_copy(context, &baked->map, &map);
    // Walls with a passage are among the map's seams, which know what they stop.
    for (uint32_t i = 0, next = 0; i < space->wall_count && status == SL_OK; i++) {
        const bool passed = next < space->passage_count && space->passages[next].wall == i;
        next += passed;
        if (!passed) status = sl_map_add_walls(context, &map, &space->walls[i], 1);
    }
    if (status == SL_OK)
        *out = map;
    else
        sl_map_destroy(context, &map);
    return status;
}

void sl_baked_destroy(sl_context *context, sl_baked *baked) {
    sl_map_destroy(context, &baked->map);
    sl_space_destroy(context, &baked->space);
    sl_visibility_destroy(context, &baked->visibility);
    sl_view_rows_destroy(context, &baked->views);
    sl_partial_destroy(context, &baked->partial);
    *baked = (sl_baked){0};
}

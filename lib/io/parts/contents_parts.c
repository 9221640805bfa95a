/// What is no wall by its shape, among what was chosen: parts of plans (plan_parts.h), tiles of a
/// floor, and small pieces that touch nothing, where they are to be left out.
#include "io/parts/choice.h"
#include "io/parts/plan_doubt.h"

#include <math.h>

/// Of walls by their looks a tenth may be something else by its shape. How many walls thick lines
/// have at least, and how many times as wide they are as those of tiles.
enum { MOST_BESIDE = 10, LEAST_THICK = 8 };
#define THICK 2.5

/// How wide the widest lines are most of which are tiles, where far thicker ones are walls; else 0.
/// `gone` by look.
static double width_of_tiles(const sli_choice *c, const size_t *gone) {
    const sli_looks *looks = &c->contents->looks;
    double thick = 0, thin = 0;
    for (size_t i = 0; i < looks->items.count; i++) {
        const sli_look *look = &looks->items.items[i];
        if (!look->taken || !look->ink.line) continue;
        if (2 * gone[i] >= look->walls)
            thin = fmax(thin, look->ink.width);
        else if (look->walls >= LEAST_THICK)
            thick = fmax(thick, look->ink.width);
    }
    return THICK * thin <= thick ? thin : 0;
}

/// Where far thicker lines are walls than those most of which are tiles: leaves out the rest of
/// the latter, which are pieces of tiles along walls, and thinner lines.
static sl_status leave_tiled_looks(sli_choice *c) {
    const sli_group_run *runs = c->contents->runs.items;
    sli_look *looks = c->contents->looks.items.items;
    if (!c->by_looks || !c->parts.tiles) return SL_OK;
    size_t *gone =
        sl_alloc_array(c->contents->context, c->contents->looks.items.count, sizeof *gone);
    if (!gone) return SL_NO_MEMORY;
    for (size_t i = 0; i < c->contents->runs.count; i++)
        for (size_t k = runs[i].first; k < runs[i].end; k++)
            gone[runs[i].look] += sli_choice_gone(c, k);
    const double width = width_of_tiles(c, gone);
    for (size_t i = 0; i < c->contents->runs.count; i++) {
        sli_look *look = &looks[runs[i].look];
        if (!look->ink.line || look->ink.width > width) continue;
        look->taken = false;
        for (size_t k = runs[i].first; k < runs[i].end; k++) {
            if (sli_choice_gone(c, k) || !sli_choice_takes(c, c->means[k])) continue;
            sl_bits_add(c->symbols.gone, k);
            c->parts.tiles++;
            c->kept--;
        }
    }
    sl_free(c->contents->context, gone);
    return SL_OK;
}

/// Where no name says what is a wall: finds what is no wall by its shape, among what is taken.
/// Looks have told walls from the rest, so a legend or a frame may be left beside them; where it
/// seems to be more, it may be walls.
sl_status sli_choice_find_parts(sli_choice *c) {
    sl_context *context = c->contents->context;
    if (c->walls_named || c->contents->options->all_layers) return SL_OK;
    const size_t count = c->map->wall_count;
    sl_map taken = {0};
    size_t *number = sl_alloc_array(context, count, sizeof *number);
    taken.walls = sl_alloc_array(context, count, sizeof *taken.walls);
    sl_status status = number && taken.walls ? SL_OK : SL_NO_MEMORY;
    for (size_t i = 0; status == SL_OK && i < count; i++) {
        if (sli_choice_gone(c, i) || !sli_choice_takes(c, c->means[i])) continue;
        number[taken.wall_count] = i;
        taken.walls[taken.wall_count++] = c->map->walls[i];
    }
    if (status == SL_OK)
        status = sli_plan_parts_find(context, &taken, sli_choice_metre(c), &c->parts);
    const size_t others = sli_plan_parts_count(&c->parts) - c->parts.loose - c->parts.tiles;
    if (c->by_looks && MOST_BESIDE * others > taken.wall_count)
        sli_plan_parts_destroy(context, &c->parts);
    for (size_t i = 0; status == SL_OK && c->parts.gone && i < taken.wall_count; i++)
        if (sl_bits_has(c->parts.gone, i)) sl_bits_add(c->symbols.gone, number[i]);
    c->kept -= sli_plan_parts_count(&c->parts);
    if (status == SL_OK) status = leave_tiled_looks(c);
    sl_free(context, number);
    sl_free(context, taken.walls);
    return status;
}

/// Takes small pieces out of what was chosen, and says so.
sl_status sli_choice_keep_large(const sli_choice *c, sli_pen *pen) {
    const sli_contents *contents = c->contents;
    sli_plan_look look;
    SL_TRY(sli_plan_keep_large(contents->context, pen->map, c->metre, &look));
    const size_t gone = look.walls - pen->map->wall_count;
    pen->walls -= gone;
    if (look.crowded)
        sl_note(contents->context, "%s: %zu lines are too many, or too dense, for --layers %s",
                contents->file, look.walls, SLI_LAYERS_LARGE);
    else
        sl_note(contents->context,
                "%s: --layers %s leaves out %zu line%s, in small closed pieces that touch nothing",
                contents->file, SLI_LAYERS_LARGE, gone, gone == 1 ? "" : "s");
    return SL_OK;
}

/// A picture as a plan: walls run along the edges between solid pixels and others. What is solid
/// (image_ink.c) is said, with the option that turns it, and so is what may be wrong about it.
#include "io/image/image.h"
#include "io/io_formats.h"
#include "io/parts/names.h"
#include "map/source.h"
#include "sightline/support.h"

#include <string.h>

sl_status sli_image_add_walls(sl_context *context, const sl_image *image,
                              const sli_image_plan *plan, sl_map *map, size_t *solid,
                              sli_image_small *small) {
    sli_grid grid;
    SL_TRY(sli_grid_create(context, image->width, image->height, &grid));
    grid.origin = plan->origin;
    grid.step = (sl_point){plan->step, plan->step};
    grid.open_outside = !plan->solid_outside;
    grid.sure = true;
    *solid = 0;
    for (size_t i = 0; i < image->width * image->height; i++) {
        const int value = plan->light ? image->pixels[i] : 255 - image->pixels[i];
        if (value < plan->threshold * 255) continue;
        grid.squares[i] = '#';
        ++*solid;
    }
    sl_status status = SL_OK;
    if (small) status = sli_image_find_small(context, &grid, plan->left_out, small);
    if (status == SL_OK) status = sli_grid_add_walls(context, &grid, map);
    sli_grid_destroy(context, &grid);
    return status;
}

/// What is solid.
typedef enum ink { INK_DARK, INK_LIGHT, INK_OPAQUE, INK_COUNT } ink;

static const char *const layer_names[] = {"dark", "light", "opaque", "large"};

typedef struct reader {
    sl_context *context;
    const char *name;
    const sl_import_options *options;
    const char *before; ///< in messages: stands before the names of layers
    sl_image image;
    unsigned char *alpha; ///< NULL for none
    size_t *row;
    ink solid;
    bool said; ///< the options say what is solid
} reader;

static sl_status choose_ink(reader *r, bool *large) {
    const char *layers = r->options->layers;
    SL_TRY(sli_layers_check(r->context, r->name, layers, layer_names, 4));
    *large = layers && sli_layers_have(layers, "large");
    size_t asked = 0;
    for (int i = 0; layers && i < INK_COUNT; i++) {
        if (!sli_layers_have(layers, layer_names[i])) continue;
        asked++;
        r->solid = (ink)i;
    }
    r->said = asked > 0;
    if (asked > 1)
        return sl_fail(r->context, SL_BAD_ARGUMENT,
                       "%s: --layers: one of dark, light and opaque is solid", r->name);
    if (r->said) return SL_OK;
    if (r->alpha && sli_image_is_opaque(r->alpha, &r->image, r->row))
        r->solid = INK_OPAQUE;
    else if (sli_image_is_light(&r->image, r->row))
        r->solid = INK_LIGHT;
    return SL_OK;
}

/// Makes the pixels those that the choice is about: opaque ones are dark; where light ones are
/// solid, transparent ones are dark too.
static void lay_on_ground(reader *r) {
    if (!r->alpha && r->solid == INK_OPAQUE)
        memset(r->image.pixels, 0, r->image.width * r->image.height);
    for (size_t i = 0; r->alpha && i < r->image.width * r->image.height; i++) {
        const unsigned grey = r->alpha[2 * i], alpha = r->alpha[2 * i + 1];
        if (r->solid == INK_OPAQUE) r->image.pixels[i] = (unsigned char)(255 - alpha);
        if (r->solid == INK_LIGHT) r->image.pixels[i] = (unsigned char)(grey * alpha / 255);
    }
}

/// What may be wrong, each with what to do about it.
static void note_doubts(const reader *r, const sli_image_levels *levels, size_t solid,
                        const sli_image_small *small, bool large) {
    static const char *const words[] = {"darkness", "lightness", "opacity"};
    const bool given = r->options->threshold > 0;
    if (levels->between >= 0.25)
        sl_note(r->context,
                "%s: %.0f %% of the pixels are neither ground nor lines: a photograph or a map? "
                "What is solid is doubtful; a plan is lines of one kind on plain ground",
                r->name, 100 * levels->between);
    if (solid == 0)
        sl_note(r->context,
                "%s: no pixel is solid: --threshold T takes fainter ones, "
                "--layers %slight or %sopaque others",
                r->name, r->before, r->before);
    else if (!given && levels->lost > solid / 50)
        sl_note(r->context,
                "%s: %zu grey pixels (%s about %g) are open; if walls are among them: "
                "--threshold %g",
                r->name, levels->lost, words[r->solid], levels->lost_level, levels->lost_from);
    if (small->letters)
        sl_note(
            r->context,
            "%s: %zu small piece%s in rows %s left out as lettering; --layers %s%s takes %s too",
            r->name, small->letters, small->letters == 1 ? "" : "s",
            small->letters == 1 ? "is" : "are", r->before, layer_names[r->solid],
            small->letters == 1 ? "it" : "them");
    if (small->count)
        sl_note(r->context,
                "%s: %zu small piece%s of up to %zu x %zu pixels %s nothing (lettering, symbols, "
                "columns): %s%s%s",
                r->name, small->count, small->count == 1 ? "" : "s", small->width, small->height,
                small->count == 1 ? "touches" : "touch",
                large ? "left out" : "walls too; --layers ", large ? "" : r->before,
                large ? "" : "large leaves them out");
}

/// A dark page that is solid may be the ground of light lines, or of dark rooms.
static void note_page(const reader *r, const sli_image_page *page) {
    if (page->has_lines)
        sl_note(r->context,
                "%s: the page is dark and solid, and what is light on it is mostly thin: if it is "
                "the walls: --layers %slight",
                r->name, r->before);
    if (page->threshold > 0 && !(r->options->threshold > 0))
        sl_note(r->context,
                "%s: two dark tones are solid (lightness about %g and %g): if the lighter one is "
                "open ground: --threshold %g",
                r->name, page->lightness, page->second, page->threshold);
}

static void note_taken(const reader *r, const sli_image_plan *plan, size_t solid, size_t walls,
                       bool faint) {
    static const char *const kinds[] = {"darkness", "light on a dark ground: lightness",
                                        "opaque on a transparent ground: opacity"};
    static const char *const asked[] = {"darkness", "lightness", "opacity"};
    static const char *const turns[] = {"light", "dark", "dark"};
    char turn[64] = "";
    if (!r->said)
        snprintf(turn, sizeof turn, "; --layers %s%s takes the %s ones", r->before, turns[r->solid],
                 turns[r->solid]);
    sl_note(r->context, "%s: %zu of %zu x %zu pixels are solid (%s from %g%s); %zu wall%s%s",
            r->name, solid, r->image.width, r->image.height,
            r->said ? asked[r->solid] : kinds[r->solid], plan->threshold,
            faint ? ", as the lines are faint" : "", walls, walls == 1 ? "" : "s", turn);
}

static sl_status read_plan(reader *r, const char *text, size_t size, sl_map *map) {
    sli_image_plan plan = {.step = 1};
    sli_image_small small;
    size_t solid;
    SL_TRY(sl_image_read(r->context, r->name, text, size, &r->image));
    SL_TRY(sli_image_read_alpha(r->context, r->name, text, size, &r->alpha));
    r->row = sl_alloc_array(r->context, r->image.width + 1, sizeof *r->row);
    if (!r->row) return SL_NO_MEMORY;
    bool large;
    SL_TRY(choose_ink(r, &large));
    lay_on_ground(r);
    plan.light = r->solid == INK_LIGHT;
    const sli_image_levels levels = sli_image_find_levels(&r->image, plan.light, r->row);
    const bool given = r->options->threshold > 0;
    sli_image_page page = {.has_lines = false};
    if (!r->said && r->solid == INK_DARK) page = sli_image_find_page(&r->image, r->row);
    if (large)
        plan.left_out = SLI_LEAVE_OUT_SMALL;
    else if (!r->said && levels.soft && !page.has_lines && !(page.threshold > 0))
        plan.left_out = SLI_LEAVE_OUT_LETTERS;
    plan.threshold = given ? r->options->threshold : levels.threshold;
    SL_TRY(sli_image_add_walls(r->context, &r->image, &plan, map, &solid, &small));
    note_taken(r, &plan, solid, map->wall_count, levels.faint && !given);
    note_page(r, &page);
    note_doubts(r, &levels, solid, &small, large);
    strcpy(map->unit, "px");
    map->entrance_may_be_wide = true;
    map->source.transform = sli_y_down((double)r->image.height, 1);
    return SL_OK;
}

sl_status sli_image_read_map(sl_context *context, const char *name, const char *text, size_t size,
                             const sl_import_options *options, const char *before, sl_map *map) {
    reader r = {.context = context, .name = name, .options = options, .before = before};
    sl_map read = {0};
    const sl_status status = read_plan(&r, text, size, &read);
    sl_image_destroy(context, &r.image);
    sl_free(context, r.alpha);
    sl_free(context, r.row);
    if (status == SL_OK)
        *map = read;
    else
        sl_map_destroy(context, &read);
    return status;
}

sl_status sli_map_read_image(sl_context *context, const char *name, const char *text, size_t size,
                             const sl_import_options *options, sl_map *map) {
    return sli_image_read_map(context, name, text, size, options, "", map);
}

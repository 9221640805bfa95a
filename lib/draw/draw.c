/// The picture of a baked map: a heading, the plan, and below it a legend with the counts and a
/// scale bar.
#include "sightline/draw.h"
#include "draw/marks.h"
#include "draw/page.h"
#include "draw/sheet.h"
#include "sightline/support.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

/// The strip of the page for a heading or a legend.
typedef struct strip {
    double left, top, width;
    double text; ///< size of the text
    bool paint;  ///< false only measures
} strip;

// --- the legend

/// The widths of things, in sizes of the text.
#define SWATCH_WIDTH  2.0
#define SWATCH_HEIGHT 1.15
#define RAMP_WIDTH    9.0
#define GAP           0.55
#define BETWEEN       1.9
#define LINE_HEIGHT   1.95
#define TEXT_MAX      (5 * SL_COUNT_TEXT)

/// One entry of the key: a swatch and its meaning. `lead` is a text before the swatch, or "".
typedef struct entry {
    void (*swatch)(cairo_t *cairo, const sl_scene *scene, const sli_pens *pens, sl_box box);
    double width; ///< of the swatch, in sizes of the text
    char lead[SL_COUNT_TEXT];
    char text[TEXT_MAX];
} entry;

#define ENTRIES 28

typedef struct key {
    entry entries[ENTRIES];
    size_t count;
} key;

static entry *add_key_entry(key *k,
                            void (*swatch)(cairo_t *, const sl_scene *, const sli_pens *, sl_box),
                            const char *text) {
    entry *e = &k->entries[k->count++];
    *e = (entry){.swatch = swatch, .width = SWATCH_WIDTH};
    snprintf(e->text, sizeof e->text, "%s", text);
    return e;
}

static void add_count(key *k, void (*swatch)(cairo_t *, const sl_scene *, const sli_pens *, sl_box),
                      uint64_t count, const char *unit) {
    char text[SL_COUNT_TEXT];
    sl_text_count(count, unit, text);
    add_key_entry(k, swatch, text);
}

static void fill_box(cairo_t *cairo, sl_colour colour, double left, double right, sl_box box) {
    sl_set_colour(cairo, colour);
    cairo_rectangle(cairo, left, box.min.y, right - left, box.max.y - box.min.y);
    cairo_fill(cairo);
}

/// The tones side by side, under one thin frame.
static void swatch_tones(cairo_t *cairo, const sl_scene *scene, const sli_pens *pens, sl_box box,
                         const sl_colour *tones, int count) {
    const double step = (box.max.x - box.min.x) / count;
    for (int i = 0; i < count; i++)
        fill_box(cairo, tones[i], box.min.x + i * step, box.min.x + (i + 1) * step, box);
    cairo_rectangle(cairo, box.min.x, box.min.y, box.max.x - box.min.x, box.max.y - box.min.y);
    sli_pen_outline(cairo, &scene->palette, pens);
}

static void swatch_floor(cairo_t *cairo, const sl_scene *scene, const sli_pens *pens, sl_box box) {
    swatch_tones(cairo, scene, pens, box, scene->palette.floor, SL_TONES - 1);
}

static void swatch_seen(cairo_t *cairo, const sl_scene *scene, const sli_pens *pens, sl_box box) {
    swatch_tones(cairo, scene, pens, box, scene->palette.seen, SL_TONES - 1);
}

static void swatch_doubtful(cairo_t *cairo, const sl_scene *scene, const sli_pens *pens,
                            sl_box box) {
    swatch_tones(cairo, scene, pens, box, &scene->palette.doubtful, 1);
}

static void swatch_source(cairo_t *cairo, const sl_scene *scene, const sli_pens *pens, sl_box box) {
    fill_box(cairo, scene->palette.source, box.min.x, box.max.x, box);
    cairo_rectangle(cairo, box.min.x, box.min.y, box.max.x - box.min.x, box.max.y - box.min.y);
    sli_pen_source_edge(cairo, &scene->palette, pens);
}

static void swatch_hidden(cairo_t *cairo, const sl_scene *scene, const sli_pens *pens, sl_box box) {
    fill_box(cairo, scene->palette.ground, box.min.x, box.max.x, box);
    sli_mark_hatch(cairo, &scene->palette, box, (box.max.y - box.min.y) / 2.5, 0);
    cairo_rectangle(cairo, box.min.x, box.min.y, box.max.x - box.min.x, box.max.y - box.min.y);
    sli_pen_outline(cairo, &scene->palette, pens);
}

static void swatch_solid(cairo_t *cairo, const sl_scene *scene, const sli_pens *pens, sl_box box) {
    swatch_tones(cairo, scene, pens, box, &scene->palette.solid, 1);
}

/// As cells outside look that are shown.
static void swatch_outside(cairo_t *cairo, const sl_scene *scene, const sli_pens *pens,
                           sl_box box) {
    sl_palette palette = scene->palette;
    palette.hatch = palette.outline;
    fill_box(cairo, palette.floor[0], box.min.x, box.max.x, box);
    sli_mark_hatch(cairo, &palette, box, (box.max.y - box.min.y) / 2.5, 0);
    cairo_rectangle(cairo, box.min.x, box.min.y, box.max.x - box.min.x, box.max.y - box.min.y);
    sli_pen_outline(cairo, &palette, pens);
}

static void swatch_ramp(cairo_t *cairo, const sl_scene *scene, const sli_pens *pens, sl_box box) {
    cairo_pattern_t *ramp = cairo_pattern_create_linear(box.min.x, 0, box.max.x, 0);
    for (unsigned i = 0; i <= 12; i++) {
        const sl_colour c = sl_palette_ramp(scene->palette.dark, i / 12.0);
        cairo_pattern_add_color_stop_rgb(ramp, i / 12.0, c.red, c.green, c.blue);
    }
    cairo_rectangle(cairo, box.min.x, box.min.y, box.max.x - box.min.x, box.max.y - box.min.y);
    cairo_set_source(cairo, ramp);
    cairo_fill_preserve(cairo);
    cairo_pattern_destroy(ramp);
    sli_pen_outline(cairo, &scene->palette, pens);
}

static sl_point left_middle(sl_box box) {
    return (sl_point){box.min.x, (box.min.y + box.max.y) / 2};
}

static sl_point right_middle(sl_box box) {
    return (sl_point){box.max.x, (box.min.y + box.max.y) / 2};
}

static void add_middle_line(cairo_t *cairo, sl_box box) {
    cairo_move_to(cairo, box.min.x, left_middle(box).y);
    cairo_line_to(cairo, box.max.x, left_middle(box).y);
}

static void swatch_wall(cairo_t *cairo, const sl_scene *scene, const sli_pens *pens, sl_box box) {
    add_middle_line(cairo, box);
    sli_pen_wall(cairo, &scene->palette, pens);
}

static void swatch_portal(cairo_t *cairo, const sl_scene *scene, const sli_pens *pens, sl_box box) {
    add_middle_line(cairo, box);
    sli_pen_portal(cairo, &scene->palette, pens);
}

static void swatch_path(cairo_t *cairo, const sl_scene *scene, const sli_pens *pens, sl_box box) {
    add_middle_line(cairo, box);
    sli_pen_path(cairo, &scene->palette, pens);
}

/// Strokes fade from left to right, as they do with depth.
static void fade(cairo_t *cairo, sl_colour colour, const sli_pens *pens, sl_box box) {
    const double step = (box.max.x - box.min.x) / 6, y = left_middle(box).y;
    for (uint32_t i = 0; i < 6; i++) {
        cairo_move_to(cairo, box.min.x + i * step, y);
        cairo_line_to(cairo, box.min.x + (i + 1) * step, y);
        sli_pen_tree(cairo, colour, pens, 2 * i);
    }
}

static void swatch_tree(cairo_t *cairo, const sl_scene *scene, const sli_pens *pens, sl_box box) {
    fade(cairo, scene->palette.tree, pens, box);
}

static void swatch_mirrored(cairo_t *cairo, const sl_scene *scene, const sli_pens *pens,
                            sl_box box) {
    fade(cairo, scene->palette.mirrored, pens, box);
}

static void swatch_start(cairo_t *cairo, const sl_scene *scene, const sli_pens *pens, sl_box box) {
    (void)pens;
    const sl_point middle = {(box.min.x + box.max.x) / 2, left_middle(box).y};
    sli_mark_start(cairo, &scene->palette, middle, 0, (box.max.y - box.min.y) / 2);
}

static void swatch_door(cairo_t *cairo, const sl_scene *scene, const sli_pens *pens, sl_box box) {
    const sl_point a = left_middle(box), b = right_middle(box);
    const sl_point middle = {(a.x + b.x) / 2, a.y};
    sli_mark_door(cairo, &scene->palette, pens, a, middle, false);
    sli_mark_door(cairo, &scene->palette, pens, middle, b, true);
}

static void swatch_mirror(cairo_t *cairo, const sl_scene *scene, const sli_pens *pens, sl_box box) {
    sli_mark_mirror(cairo, &scene->palette, pens, left_middle(box), right_middle(box));
}

static void swatch_oneway(cairo_t *cairo, const sl_scene *scene, const sli_pens *pens, sl_box box) {
    const sl_point a = {box.min.x, box.max.y}, b = {box.max.x, box.max.y};
    sli_mark_oneway(cairo, &scene->palette, pens, a, b);
}

static void swatch_open_wall(cairo_t *cairo, const sl_scene *scene, const sli_pens *pens,
                             sl_box box) {
    sli_mark_partial(cairo, &scene->palette, pens, left_middle(box), right_middle(box),
                     SLI_PARTIAL_OPEN);
}

static void swatch_limited(cairo_t *cairo, const sl_scene *scene, const sli_pens *pens,
                           sl_box box) {
    sli_mark_partial(cairo, &scene->palette, pens, left_middle(box), right_middle(box),
                     SLI_PARTIAL_LIMITED);
}

static void swatch_passage(cairo_t *cairo, const sl_scene *scene, const sli_pens *pens,
                           sl_box box) {
    sli_mark_partial(cairo, &scene->palette, pens, left_middle(box), right_middle(box),
                     SLI_PARTIAL_WALL);
}

static void swatch_object(cairo_t *cairo, const sl_scene *scene, const sli_pens *pens, sl_box box) {
    cairo_rectangle(cairo, box.min.x, box.min.y, box.max.x - box.min.x, box.max.y - box.min.y);
    sli_pen_object(cairo, &scene->palette, pens);
}

#define SWATCH_FAULT(name, kind)                                                                   \
    static void name(cairo_t *cairo, const sl_scene *scene, const sli_pens *pens, sl_box box) {    \
        sli_mark_fault(cairo, &scene->palette, pens, kind, left_middle(box), right_middle(box));   \
    }
SWATCH_FAULT(swatch_leak, SL_FAULT_LEAK)
SWATCH_FAULT(swatch_gap, SL_FAULT_GAP)
SWATCH_FAULT(swatch_overlap, SL_FAULT_OVERLAP)
SWATCH_FAULT(swatch_crossing, SL_FAULT_CROSSING)
SWATCH_FAULT(swatch_thin, SL_FAULT_THIN)
SWATCH_FAULT(swatch_unreachable, SL_FAULT_UNREACHABLE)

static void add_faults(key *k, const sl_faults *faults) {
    static const struct {
        void (*swatch)(cairo_t *, const sl_scene *, const sli_pens *, sl_box);
        const char *what;
    } kinds[SL_FAULT_KINDS] = {
        [SL_FAULT_LEAK] = {swatch_leak, "leak"},
        [SL_FAULT_GAP] = {swatch_gap, "gap"},
        [SL_FAULT_OVERLAP] = {swatch_overlap, "overlap"},
        [SL_FAULT_CROSSING] = {swatch_crossing, "crossing"},
        [SL_FAULT_THIN] = {swatch_thin, "thin cell"},
        [SL_FAULT_UNREACHABLE] = {swatch_unreachable, "unreachable room"},
    };
    for (int kind = 0; kind < SL_FAULT_KINDS; kind++)
        if (faults->counts[kind])
            add_count(k, kinds[kind].swatch, faults->counts[kind], kinds[kind].what);
}

static void add_seen(key *k, const sl_scene *scene) {
    char text[TEXT_MAX], seen[SL_COUNT_TEXT], of[SL_COUNT_TEXT], share[SL_COUNT_TEXT];
    sl_text_percent(scene->seen_share, share);
    sl_text_count(scene->seen, "", seen);
    sl_text_count(scene->population, "cell", of);
    snprintf(text, sizeof text, "sees %s of %s, %s of the area", seen, of, share);
    if (scene->seen_beyond) {
        sl_text_count(scene->seen_beyond, scene->outside ? "inside cell" : "outside cell", of);
        const size_t length = strlen(text);
        snprintf(text + length, sizeof text - length, ", and %s", of);
    }
    add_key_entry(k, swatch_seen, text);
    if (!scene->doubtful) return;
    sl_text_count(scene->doubtful, "cell", of);
    snprintf(text, sizeof text, "%s decided by rounding", of);
    add_key_entry(k, swatch_doubtful, text);
}

static void add_tree(key *k, const sl_scene *scene) {
    char text[TEXT_MAX], nodes[SL_COUNT_TEXT];
    sl_text_count(scene->tree_nodes, "node", nodes);
    snprintf(text, sizeof text, "stab tree: %s, %u deep", nodes, scene->tree_depth);
    add_key_entry(k, swatch_tree, scene->tree_nodes ? text : "stab tree: not kept");
    if (!scene->mirrored_nodes) return;
    sl_text_count(scene->mirrored_nodes, "node", nodes);
    snprintf(text, sizeof text, "%s of it by mirror", nodes);
    add_key_entry(k, swatch_mirrored, text);
}

static void add_heat(key *k, const sl_scene *scene) {
    char text[TEXT_MAX], most[SL_COUNT_TEXT], mean[SL_COUNT_TEXT];
    sl_text_percent(scene->most, most);
    sl_text_percent(scene->mean, mean);
    snprintf(text, sizeof text, "%s of the area seen, %s on average", most, mean);
    entry *e = add_key_entry(k, swatch_ramp, text);
    e->width = RAMP_WIDTH;
    sl_text_percent(scene->least, e->lead);
}

/// Cells that are neither shown nor solid.
static uint32_t hidden_count(const sl_scene *scene) {
    return scene->baked->space.cell_count - scene->solid - scene->population;
}

/// Whether a picture shows nothing of cells: a plan for people who draw plans.
static bool is_plain(const sl_scene *scene) {
    return !(scene->options.layers &
             ~(unsigned)(SL_LAYER_WALLS | SL_LAYER_STARTS | SL_LAYER_LEGEND)) &&
           !scene->chosen;
}

/// What is outside, and solid ground, without a word on cells.
static void add_ground(key *k, const sl_scene *scene) {
    if (scene->hatched) add_key_entry(k, swatch_outside, "outside");
    if (!scene->hatched && hidden_count(scene))
        add_key_entry(k, swatch_hidden, scene->outside ? "inside" : "outside");
    if (scene->solid) add_key_entry(k, swatch_solid, "solid ground");
}

static void add_cells(key *k, const sl_scene *scene) {
    const uint32_t hidden = hidden_count(scene);
    char text[TEXT_MAX], count[SL_COUNT_TEXT];
    if (!scene->heat) add_count(k, swatch_floor, scene->population, "cell");
    if (hidden)
        add_count(k, swatch_hidden, hidden, scene->outside ? "inside cell" : "outside cell");
    if (scene->hatched) {
        sl_text_count(scene->hatched, "", count);
        snprintf(text, sizeof text, "%s of the cells %s outside", count,
                 scene->hatched == 1 ? "is" : "are");
        add_key_entry(k, swatch_outside, text);
    }
    if (scene->solid) add_key_entry(k, swatch_solid, "solid ground");
}

/// Walls that do not stop all, as the space has them.
static void add_partial_walls(key *k, const sl_map *map) {
    char stops[SL_STOPS_TEXT], text[TEXT_MAX];
    bool has[] = {
        [SLI_PARTIAL_OPEN] = false, [SLI_PARTIAL_LIMITED] = false, [SLI_PARTIAL_WALL] = false};
    for (size_t i = 0; i < map->seam_count; i++)
        if (map->seams[i].stops) has[sli_partial_of(map, map->seams[i].stops)] = true;
    sl_stops_write(sl_map_channel(map), stops);
    snprintf(text, sizeof text, "wall that does not stop %s", stops);
    if (has[SLI_PARTIAL_OPEN]) add_key_entry(k, swatch_open_wall, text);
    if (has[SLI_PARTIAL_LIMITED])
        add_key_entry(k, swatch_limited, "wall that limits sight: one is passed, not two");
    snprintf(text, sizeof text, "wall that stops %s, but not all", stops);
    if (has[SLI_PARTIAL_WALL]) add_key_entry(k, swatch_passage, text);
}

static void add_effects(key *k, const sl_map *map) {
    add_partial_walls(k, map);
    if (map->door_count) add_key_entry(k, swatch_door, "door, shut and open");
    if (map->mirror_count) add_key_entry(k, swatch_mirror, "mirror");
    if (map->oneway_count) add_key_entry(k, swatch_oneway, "one-way glass");
}

/// Adds the entries in order of importance.
static void fill_key(key *k, const sl_scene *scene) {
    const sl_space *space = &scene->baked->space;
    const sl_map *map = &scene->baked->map;
    const unsigned layers = scene->options.layers;
    if (scene->options.faults) add_faults(k, scene->options.faults);
    if (scene->heat) add_heat(k, scene);
    if (scene->chosen) {
        char text[SL_COUNT_TEXT];
        snprintf(text, sizeof text, "cell %u", scene->options.cell);
        add_key_entry(k, swatch_source, text);
        if (scene->shows_seen) add_seen(k, scene);
        if (layers & SL_LAYER_STAB_TREE) add_tree(k, scene);
    }
    if (layers & SL_LAYER_STARTS && map->start_count)
        add_key_entry(k, swatch_start, map->start_count > 1 ? "starts" : "start");
    if (layers & SL_LAYER_WALLS) add_count(k, swatch_wall, space->wall_count, "wall");
    if (is_plain(scene))
        add_ground(k, scene);
    else
        add_cells(k, scene);
    if (layers & SL_LAYER_PORTALS) add_count(k, swatch_portal, scene->portals, "portal");
    if (layers & SL_LAYER_WALLS) add_effects(k, map);
    if (layers & SL_LAYER_STARTS && map->path_count)
        add_key_entry(k, swatch_path, map->path_count > 1 ? "paths" : "path");
    if (layers & SL_LAYER_STARTS && map->object_count)
        add_count(k, swatch_object, map->object_count, "object");
}

static void draw_entry(cairo_t *cairo, const sl_scene *scene, const sli_pens *pens, const entry *e,
                       double x, double middle, double size) {
    const double base = middle + 0.36 * size;
    if (e->lead[0]) {
        sl_text_show(cairo, scene->palette.ink, x, base, e->lead);
        x += sl_text_width(cairo, e->lead) + GAP * size;
    }
    const double half = SWATCH_HEIGHT / 2 * size;
    e->swatch(cairo, scene, pens,
              (sl_box){{x, middle - half}, {x + e->width * size, middle + half}});
    sl_text_show(cairo, scene->palette.ink, x + (e->width + GAP) * size, base, e->text);
}

static double entry_width(cairo_t *cairo, const entry *e, double size) {
    const double lead = e->lead[0] ? sl_text_width(cairo, e->lead) + GAP * size : 0;
    return lead + (e->width + GAP) * size + sl_text_width(cairo, e->text);
}

/// Pens that fit a line of text, whatever the plan uses.
static sli_pens key_pens(const sli_pens *pens, double size) {
    sli_pens fitted = *pens;
    fitted.wall = fmin(fmax(pens->wall, 0.14 * size), 0.28 * size);
    fitted.portal = fmin(fmax(pens->portal, 0.07 * size), 0.12 * size);
    fitted.tree = fmin(fmax(pens->tree, 0.16 * size), 0.3 * size);
    fitted.mark = fmin(pens->mark, 0.75 * size);
    return fitted;
}

/// The key in lines as the width allows, and a scale bar at the right. Returns its height, which
/// does not depend on the frame or the pens.
static double draw_legend(cairo_t *cairo, const sl_scene *scene, const sl_frame *frame,
                          const sli_pens *pens, const strip *at) {
    key k = {0};
    fill_key(&k, scene);
    const double size = at->text, bar_room = 0.17 * at->width;
    const double width = at->width - bar_room - BETWEEN * size;
    const sli_pens fitted = at->paint ? key_pens(pens, size) : (sli_pens){0};
    sl_text_font(cairo, size, false);
    double x = 0, y = LINE_HEIGHT / 2 * size;
    for (size_t i = 0; i < k.count; i++) {
        const double wide = entry_width(cairo, &k.entries[i], size);
        if (x > 0 && x + wide > width) {
            x = 0;
            y += LINE_HEIGHT * size;
        }
        if (at->paint)
            draw_entry(cairo, scene, &fitted, &k.entries[i], at->left + x, at->top + y, size);
        x += wide + BETWEEN * size;
    }
    if (at->paint && !scene->options.sheet.paper) // which has one in its title block
        sli_draw_scale_bar(cairo, scene, frame, at->left + at->width,
                           at->top + 0.45 * LINE_HEIGHT * size, bar_room, size);
    return y + LINE_HEIGHT / 2 * size;
}

double sli_draw_ground_key(cairo_t *cairo, const sl_scene *scene, sl_point at, double size,
                           bool paint) {
    const sli_pens pens = {.outline = 0.06 * size};
    key k = {0};
    if (!scene->solid && !scene->hatched) return 0;
    add_ground(&k, scene);
    sl_text_font(cairo, size, false);
    for (size_t i = 0; i < k.count && paint; i++) {
        draw_entry(cairo, scene, &pens, &k.entries[i], at.x, at.y + 0.8 * size, size);
        at.x += entry_width(cairo, &k.entries[i], size) + BETWEEN * size;
    }
    return LINE_HEIGHT * size;
}

/// "What cell 17 sees  ·  dfs with funnel  ·  closed sight, exact"
static void describe(const sl_scene *scene, char *text, size_t room) {
    const sl_baked *baked = scene->baked;
    char what[32] = "Cells and portals", how[64] = "";
    if (scene->heat)
        snprintf(what, sizeof what, "How much each cell sees");
    else if (scene->shows_seen)
        snprintf(what, sizeof what, "What cell %u sees", scene->options.cell);
    else if (scene->chosen)
        snprintf(what, sizeof what, "Cell %u", scene->options.cell);
    if (baked->method[0])
        snprintf(how, sizeof how, "  \xc2\xb7  %.15s%s%.15s", baked->method,
                 baked->solver[0] ? " with " : "", baked->solver);
    if (scene->heat || scene->shows_seen)
        snprintf(text, room, "%s%s  \xc2\xb7  %s sight, %s%s", what, how,
                 baked->visibility.sight == SL_OPEN ? "open" : "closed",
                 sl_guarantee_name(baked->visibility.guarantee),
                 sl_partial_begun(&baked->partial) ? " (partial)" : "");
    else
        snprintf(text, room, "%s", what);
}

/// The title, and below it what the picture shows and how that was found. Returns its height.
static double draw_heading(cairo_t *cairo, const sl_scene *scene, const strip *at) {
    const double size = at->text;
    double y = at->top;
    if (scene->options.title) {
        y += 1.9 * size;
        if (at->paint)
            sl_text_show_within(cairo, scene->palette.ink, at->left, y, at->width, 1.9 * size, true,
                                scene->options.title);
        y += 0.45 * size;
    }
    if (scene->options.layers & SL_LAYER_LEGEND && !is_plain(scene)) {
        char text[160];
        describe(scene, text, sizeof text);
        y += 1.15 * size;
        if (at->paint)
            sl_text_show_within(cairo, scene->palette.faint, at->left, y, at->width, size, false,
                                text);
        y += 0.2 * size;
    }
    return y - at->top;
}

// --- the picture

#define ALL_LAYERS                                                                                 \
    (SL_LAYER_CELLS | SL_LAYER_PORTALS | SL_LAYER_WALLS | SL_LAYER_PVS | SL_LAYER_STAB_TREE |      \
     SL_LAYER_STARTS | SL_LAYER_LEGEND | SL_LAYER_NUMBERS)

sl_draw_options sl_draw_options_default(void) {
    return (sl_draw_options){.layers =
                                 ALL_LAYERS & ~(unsigned)(SL_LAYER_STAB_TREE | SL_LAYER_NUMBERS),
                             .cell = SL_NO_CELL,
                             .width = 1200};
}

static sl_status check_options(sl_context *context, const sl_baked *baked,
                               const sl_draw_options *options) {
    SL_TRY(sli_page_check_width(context, options->width));
    if (options->layers & ~(unsigned)ALL_LAYERS)
        return sl_fail(context, SL_BAD_ARGUMENT, "layers 0x%x: only 0x%x are known",
                       options->layers, ALL_LAYERS);
    return sli_scene_check_cell(context, baked, options->cell);
}

static strip strip_at(const sli_page *page, double top, bool paint) {
    return (strip){page->margin, top, page->inner, page->text, paint};
}

static void set_page(cairo_t *cairo, const void *what, sli_page *page, bool paint) {
    const sl_scene *scene = what;
    const strip heading = strip_at(page, page->margin, paint);
    double y = page->margin + draw_heading(cairo, scene, &heading);
    if (y > page->margin) y += 0.6 * page->margin;
    if (!paint) sli_page_place_plan(page, scene->baked->space.bounds, y, SLI_PAGE_TALLEST);
    y = page->bottom;
    if (scene->options.layers & SL_LAYER_LEGEND) {
        const strip legend = strip_at(page, y + 0.55 * page->margin, paint);
        const sli_pens pens = sli_pens_for(scene, &page->frame);
        y = legend.top + draw_legend(cairo, scene, &page->frame, &pens, &legend) -
            0.3 * page->margin;
    }
    page->height = ceil(y + page->margin);
}

static sl_status draw_plan(sl_context *context, cairo_t *cairo, const void *what,
                           const sl_frame *frame) {
    const sl_scene *scene = what;
    return sl_draw_plan(context, cairo, scene, scene->options.layers, frame);
}

static sl_status draw_scene(sl_context *context, const sl_scene *scene, const char *title,
                            const sli_paper_kind *kind, const char *path) {
    const sli_page_parts parts = {.set = set_page,
                                  .draw_plan = draw_plan,
                                  .what = scene,
                                  .scene = scene,
                                  .ground = scene->palette.page,
                                  .title = title};
    return sli_page_write(context, &parts, scene->options.width, kind, path);
}

sl_status sl_draw_file(sl_context *context, const sl_baked *baked, const sl_draw_options *options,
                       const char *path) {
    const sli_paper_kind *kind;
    sl_scene scene;
    SL_TRY(sli_paper_kind_of(context, path, &kind));
    SL_TRY(check_options(context, baked, options));
    sl_draw_options plain = *options;
    if (plain.sheet.paper) plain.title = NULL; // it stands in the title block
    SL_TRY(sli_scene_make(context, baked, &plain, NULL, &scene));
    const sl_status status = draw_scene(context, &scene, options->title, kind, path);
    sli_scene_clear(context, &scene);
    return status;
}

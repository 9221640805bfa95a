/// Procedural maps: the table of kinds, how large a plan becomes, turning it, and what every kind
/// draws with: walls, doors, boxes and rooms on a grid of whole numbers.
///
/// How many walls a kind gives is not known beforehand. So a few units are laid out and counted,
/// and the size is corrected in proportion until the number asked for is met.
#include "study/generate/plot.h"

#include "map/source.h"
#include "sightline/support.h"

#include <assert.h>
#include <math.h>
#include <stdio.h>

// --- drawing on a plot

int sli_pick(sli_plot *plot, int low, int high) {
    assert(low <= high);
    return low + (int)sl_random_below(&plot->random, (uint64_t)(high - low) + 1);
}

bool sli_chance(sli_plot *plot, int percent) {
    return sl_random_below(&plot->random, 100) < (uint64_t)percent;
}

sl_status sli_plot_wall(sli_plot *plot, sli_run run) {
    if (run.low >= run.high) return SL_OK;
    sl_point a = {run.at, run.low}, b = {run.at, run.high};
    if (!run.upright) {
        a = (sl_point){run.low, run.at};
        b = (sl_point){run.high, run.at};
    }
    return sl_map_add_wall(plot->context, plot->map, a, b, 0);
}

sl_status sli_plot_wall_open(sli_plot *plot, sli_run run, int low, int high) {
    assert(run.low <= low && low < high && high <= run.high);
    SL_TRY(sli_plot_wall(plot, (sli_run){run.upright, run.at, run.low, low}));
    return sli_plot_wall(plot, (sli_run){run.upright, run.at, high, run.high});
}

sl_status sli_plot_wall_door(sli_plot *plot, sli_run run) {
    const int door = sli_pick(plot, run.low, run.high - 1);
    return sli_plot_wall_open(plot, run, door, door + 1);
}

sli_run sli_side_of(sli_rect rect, sl_side side) {
    switch (side) {
    case SLI_LEFT:
        return (sli_run){true, rect.x0, rect.y0, rect.y1};
    case SLI_RIGHT:
        return (sli_run){true, rect.x1, rect.y0, rect.y1};
    case SLI_BOTTOM:
        return (sli_run){false, rect.y0, rect.x0, rect.x1};
    default:
        return (sli_run){false, rect.y1, rect.x0, rect.x1};
    }
}

sl_status sli_plot_box(sli_plot *plot, sli_rect rect) {
    for (sl_side side = 0; side < SLI_SIDES; side++)
        SL_TRY(sli_plot_wall(plot, sli_side_of(rect, side)));
    return SL_OK;
}

sl_status sli_plot_start(sli_plot *plot, double x, double y) {
    return sl_map_add_start(plot->context, plot->map, (sl_point){x, y}, 0, 0);
}

sl_status sli_plot_row_done(sli_plot *plot, int row) {
    sl_report(plot->context, "generate", "rows", (uint64_t)row + 1, (uint64_t)plot->rows);
    return sl_check_cancelled(plot->context);
}

sl_status sli_plot_rooms(sli_plot *plot, sli_rect rect, int least) {
    const int width = rect.x1 - rect.x0, height = rect.y1 - rect.y0;
    const bool wide = width >= 2 * least, high = height >= 2 * least;
    if (!wide && !high) return SL_OK;
    // Some rooms are left large.
    if (width * height <= 6 * least * least && sli_chance(plot, 35)) return SL_OK;
    const bool upright =
        wide && (!high || width > height || (width == height && sli_chance(plot, 50)));
    sli_rect first = rect, second = rect;
    if (upright)
        first.x1 = second.x0 = sli_pick(plot, rect.x0 + least, rect.x1 - least);
    else
        first.y1 = second.y0 = sli_pick(plot, rect.y0 + least, rect.y1 - least);
    SL_TRY(sli_plot_wall_door(plot, sli_side_of(first, upright ? SLI_RIGHT : SLI_TOP)));
    SL_TRY(sli_plot_rooms(plot, first, least));
    return sli_plot_rooms(plot, second, least);
}

// --- kinds, sizes, turns

enum {
    USUAL_OPEN = 40,
    SIZE_MOST = 100000,
    TRIALS = 8,
    TRIAL_FIRST = 64,  // units that are laid out to learn how many walls one has
    TRIAL_MOST = 4096, // the most that are laid out for no other reason
};

static const sl_map_kind kinds[] = {
    {"maze", "one way between any two places", "squares a side", 24, false, true, 1, 2,
     sli_lay_maze},
    {"office", "corridors, rooms and their doors on one floor", "wings a side", 3, false, true, 1,
     1, sli_lay_office},
    {"city", "broken streets about houses with rooms, courts and parks", "blocks a side", 5, false,
     true, 1, 2, sli_lay_city},
    {"pillars", "a hall in which few pillars are in line", "pillars a side", 8, false, true, 1, 1,
     sli_lay_pillars},
    {"tunnels", "chambers and tunnels after Laine 2005, each an object; a share is open",
     "times 1,825 objects", 1, true, false, 625, 2, sli_lay_tunnels},
    {"tower", "office floors side by side, apart from each other", "floors", 6, false, false, 1, 1,
     sli_lay_tower},
};

const sl_map_kind *sl_map_kinds(size_t *count) {
    *count = sizeof kinds / sizeof *kinds;
    return kinds;
}

sl_generate_options sl_generate_options_default(void) {
    return (sl_generate_options){.seed = 1, .open = -1};
}

/// Lays out about `count` units, in a shape near a square.
static sl_status lay_out(sl_context *context, const sl_map_kind *kind,
                         const sl_generate_options *options, uint64_t count, sl_map *map) {
    uint64_t columns = (uint64_t)sqrt((double)count);
    if (columns < kind->least) columns = kind->least;
    uint64_t rows = (count + columns / 2) / columns;
    if (rows < kind->least) rows = kind->least;
    sli_plot plot = {.context = context,
                     .map = map,
                     .random = {options->seed},
                     .columns = (int)columns,
                     .rows = (int)rows,
                     .count = (int)count,
                     .open = options->open < 0 ? USUAL_OPEN : options->open};
    sl_status status = kind->lay(&plot);
    if (status == SL_OK) status = sl_map_clean(context, map, NULL, NULL);
    if (status != SL_OK) sl_map_destroy(context, map);
    return status;
}

/// The walls that so many units have together; the map itself is of no use.
static sl_status count_walls(sl_context *context, const sl_map_kind *kind,
                             const sl_generate_options *options, uint64_t count, size_t *walls) {
    sl_map map = {0};
    SL_TRY(lay_out(context, kind, options, count, &map));
    *walls = map.wall_count;
    sl_map_destroy(context, &map);
    return SL_OK;
}

/// Units that have `wanted` walls, where `count` have `walls`.
static uint64_t in_proportion(const sl_map_kind *kind, uint64_t count, uint64_t walls,
                              uint64_t wanted) {
    const uint64_t least = (uint64_t)kind->least * kind->least;
    const uint64_t scaled = (count * wanted + walls / 2) / walls;
    return scaled < least ? least : scaled;
}

static uint64_t difference(uint64_t a, uint64_t b) {
    return a > b ? a - b : b - a;
}

/// A large map: a part of it shows how many walls a unit has.
static sl_status lay_out_many(sl_context *context, const sl_map_kind *kind,
                              const sl_generate_options *options, sl_map *map) {
    size_t walls;
    SL_TRY(count_walls(context, kind, options, TRIAL_MOST, &walls));
    return lay_out(context, kind, options, in_proportion(kind, TRIAL_MOST, walls, options->walls),
                   map);
}

/// Finds the units that have about so many walls together by trying: they differ by chance, and
/// those at the border from those inside.
static sl_status lay_out_walls(sl_context *context, const sl_map_kind *kind,
                               const sl_generate_options *options, sl_map *map) {
    const uint64_t wanted = options->walls;
    uint64_t count = TRIAL_FIRST, best = count, least = UINT64_MAX;
    for (int trial = 0; trial < TRIALS && least > wanted / 100; trial++) {
        size_t walls;
        SL_TRY(count_walls(context, kind, options, count, &walls));
        if (difference(walls, wanted) < least) {
            least = difference(walls, wanted);
            best = count;
        }
        count = in_proportion(kind, count, walls, wanted);
        if (count > TRIAL_MOST) return lay_out_many(context, kind, options, map);
    }
    return lay_out(context, kind, options, best, map);
}

static sl_status lay_out_size(sl_context *context, const sl_map_kind *kind,
                              const sl_generate_options *options, sl_map *map) {
    const uint64_t size = options->size ? options->size : kind->usual_size;
    const unsigned least = kind->is_square ? kind->least : 1;
    if (size > SIZE_MOST || size < least)
        return sl_fail(context, SL_BAD_ARGUMENT, "size %llu: %s: expected %u to %d %s",
                       (unsigned long long)size, kind->name, least, SIZE_MOST, kind->size_is);
    const uint64_t count = kind->units * size * (kind->is_square ? size : 1);
    size_t walls;
    SL_TRY(count_walls(context, kind, options, TRIAL_FIRST, &walls));
    const double expected = (double)walls / TRIAL_FIRST * (double)count;
    if (expected <= SL_GENERATE_WALLS_MOST) return lay_out(context, kind, options, count, map);
    return sl_fail(context, SL_BAD_ARGUMENT, "size %llu: %s: about %.3g walls; at most %d can be",
                   (unsigned long long)size, kind->name, expected, SL_GENERATE_WALLS_MOST);
}

static sl_status check_options(sl_context *context, const sl_map_kind *kind,
                               const sl_generate_options *options) {
    if (options->walls &&
        (options->walls < SL_GENERATE_WALLS_LEAST || options->walls > SL_GENERATE_WALLS_MOST))
        return sl_fail(context, SL_BAD_ARGUMENT, "walls %llu: expected %d to %d",
                       (unsigned long long)options->walls, SL_GENERATE_WALLS_LEAST,
                       SL_GENERATE_WALLS_MOST);
    if (options->walls && options->size)
        return sl_fail(context, SL_BAD_ARGUMENT,
                       "walls %llu and size %llu: either says how large the map becomes",
                       (unsigned long long)options->walls, (unsigned long long)options->size);
    if (options->open >= 0 && !kind->takes_open)
        return sl_fail(context, SL_BAD_ARGUMENT, "open %g: %s has nothing to open, tunnels has",
                       options->open, kind->name);
    if (!(options->open <= 100))
        return sl_fail(context, SL_BAD_ARGUMENT, "open %g: expected 0 to 100 percent",
                       options->open);
    if (!(fabs(options->turned) <= 360))
        return sl_fail(context, SL_BAD_ARGUMENT, "turned %g: expected -360 to 360 degrees",
                       options->turned);
    return SL_OK;
}

// --- turning

/// With cosine and sine in units of 2^-16, products with whole numbers, and their sums, are exact.
/// Else they have all the bits but for some that mathematical libraries may differ in, so that the
/// map is the same on every machine.
#define EXACT_SCALE   0x1p16
#define ROUNDED_SCALE 0x1p48

typedef struct turn {
    double cosine, sine, degrees;
    sl_point middle; // stays where it is
} turn;

static turn turn_by(const sl_generate_options *options, const sl_map *map) {
    const double radians = options->turned * 3.14159265358979323846 / 180;
    const double scale = options->in_line ? EXACT_SCALE : ROUNDED_SCALE;
    turn t = {rint(scale * cos(radians)) / scale,
              rint(scale * sin(radians)) / scale,
              options->turned,
              {0, 0}};
    if (options->in_line) return t;
    const sl_box b = sl_map_bounds(map);
    t.middle = (sl_point){(b.min.x + b.max.x) / 2, (b.min.y + b.max.y) / 2};
    return t;
}

static sl_point turn_point(turn t, sl_point p) {
    const double x = p.x - t.middle.x, y = p.y - t.middle.y;
    // Without a minus before a zero.
    return (sl_point){t.middle.x + (t.cosine * x - t.sine * y) + 0.0,
                      t.middle.y + (t.sine * x + t.cosine * y) + 0.0};
}

static sl_box turn_box(turn t, sl_box box) {
    const sl_point corners[4] = {box.min, {box.max.x, box.min.y}, box.max, {box.min.x, box.max.y}};
    const sl_point first = turn_point(t, corners[0]);
    sl_box turned = {first, first};
    for (int i = 1; i < 4; i++) {
        const sl_point p = turn_point(t, corners[i]);
        turned.min = (sl_point){fmin(turned.min.x, p.x), fmin(turned.min.y, p.y)};
        turned.max = (sl_point){fmax(turned.max.x, p.x), fmax(turned.max.y, p.y)};
    }
    return turned;
}

static void turn_map(turn t, sl_map *map) {
    for (size_t i = 0; i < map->wall_count; i++) {
        map->walls[i].a = turn_point(t, map->walls[i].a);
        map->walls[i].b = turn_point(t, map->walls[i].b);
    }
    for (size_t i = 0; i < map->start_count; i++) {
        map->starts[i].at = turn_point(t, map->starts[i].at);
        map->starts[i].heading += t.degrees;
    }
    for (size_t i = 0; i < map->object_count; i++)
        map->objects[i].box = turn_box(t, map->objects[i].box);
}

// --- the whole

/// The command that makes the map, as a note.
static sl_status add_note(sl_context *context, const sl_map_kind *kind,
                          const sl_generate_options *options, sl_map *map) {
    char open[SL_NUMBER_TEXT] = "", turned[SL_NUMBER_TEXT] = "", text[256];
    const uint64_t size = options->size ? options->size : kind->usual_size;
    if (kind->takes_open) sl_number_write(options->open < 0 ? USUAL_OPEN : options->open, open);
    if (options->turned != 0) sl_number_write(options->turned, turned);
    snprintf(text, sizeof text, "made by: sightline generate %s --seed %llu --%s %llu%s%s%s%s",
             kind->name, (unsigned long long)options->seed, options->walls ? "walls" : "size",
             (unsigned long long)(options->walls ? options->walls : size), *open ? " --open " : "",
             open,
             !*turned           ? ""
             : options->in_line ? " --turned-exact "
                                : " --turned ",
             turned);
    return sli_map_add_note(context, map, text);
}

sl_status sl_generate(sl_context *context, const sl_map_kind *kind,
                      const sl_generate_options *options, sl_map *map) {
    SL_TRY(check_options(context, kind, options));
    SL_TRY(options->walls ? lay_out_walls(context, kind, options, map)
                          : lay_out_size(context, kind, options, map));
    if (options->turned != 0) turn_map(turn_by(options, map), map);
    const sl_status status = add_note(context, kind, options, map);
    if (status != SL_OK) sl_map_destroy(context, map);
    return status;
}

/// What GeoJSON holds that is no plan: points alone, open lines of streets that nothing names,
/// several sites far apart, entrances that are areas, footprints of a town, and levels that their
/// rooms do not fill.
#include "io/geojson/geojson.h"
#include "io/parts/names.h"
#include "map/source.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>
#include <strings.h>

sl_status sli_geo_refuse_points(const sli_geo *geo) {
    size_t points = 0;
    for (size_t i = 0; i < geo->lines.count; i++) {
        if (geo->lines.items[i].count > 1) return SL_OK;
        points += geo->lines.items[i].count;
    }
    if (!points)
        return sl_fail_at(geo->context, geo->name, 0,
                          "none of its features has lines or outlines that walls could be");
    return sl_fail_at(geo->context, geo->name, 0,
                      "it has %zu point%s, and no lines or outlines that walls could be", points,
                      points == 1 ? "" : "s");
}

// --- sites

/// The box of what is one: a feature, then a site.
typedef struct part {
    sl_box box;
    size_t features;
} part;

static void join(sl_box *box, sl_box other) {
    box->min = (sl_point){fmin(box->min.x, other.min.x), fmin(box->min.y, other.min.y)};
    box->max = (sl_point){fmax(box->max.x, other.max.x), fmax(box->max.y, other.max.y)};
}

static const sl_box nothing = {{INFINITY, INFINITY}, {-INFINITY, -INFINITY}};

static sl_box box_of_line(const sli_geo *geo, const sli_geo_line *line) {
    sl_box box = nothing;
    for (size_t i = 0; i < line->count; i++) {
        const sl_point p = geo->points.items[line->first + i];
        join(&box, (sl_box){p, p});
    }
    return box;
}

static sl_box box_of(const sli_geo *geo, const sli_geo_feature *feature) {
    sl_box box = nothing;
    for (size_t k = 0; k < feature->count; k++)
        join(&box, box_of_line(geo, &geo->lines.items[feature->first + k]));
    return box;
}

static int compare_x(const void *left, const void *right) {
    const part *a = left, *b = right;
    return (a->box.min.x > b->box.min.x) - (a->box.min.x < b->box.min.x);
}

static int compare_y(const void *left, const void *right) {
    const part *a = left, *b = right;
    return (a->box.min.y > b->box.min.y) - (a->box.min.y < b->box.min.y);
}

/// Sites have at least a kilometre between them, and a quarter of all that there is.
#define APART       1000
#define APART_SHARE 0.25

/// The number of parts, by x or y, before the widest gap; 0 where no gap is wide enough. Sorts.
static size_t find_gap(part *parts, size_t count, bool by_y) {
    double end = -INFINITY, widest = APART;
    size_t at = 0;
    qsort(parts, count, sizeof *parts, by_y ? compare_y : compare_x);
    const double begin = by_y ? parts[0].box.min.y : parts[0].box.min.x;
    for (size_t i = 0; i < count; i++) {
        const double low = by_y ? parts[i].box.min.y : parts[i].box.min.x;
        if (i && low - end >= widest) {
            widest = low - end;
            at = i;
        }
        end = fmax(end, by_y ? parts[i].box.max.y : parts[i].box.max.x);
    }
    return widest >= APART_SHARE * (end - begin) ? at : 0;
}

enum { SITES_MOST = 4 };

typedef struct site_list {
    part sites[SITES_MOST];
    size_t count; ///< more than the most where there are more
} site_list;

/// Splits the parts at their gaps. At most SITES_MOST levels deep, as then there are enough sites.
static void split(part *parts, size_t count, site_list *out) {
    for (int by_y = 0; by_y < 2 && out->count <= SITES_MOST; by_y++) {
        const size_t at = find_gap(parts, count, by_y);
        if (!at) continue;
        split(parts, at, out);
        split(parts + at, count - at, out);
        return;
    }
    part site = {.box = nothing, .features = count};
    for (size_t i = 0; i < count; i++) join(&site.box, parts[i].box);
    if (out->count < SITES_MOST) out->sites[out->count] = site;
    out->count++;
}

static void note_sites(const sli_geo *geo, const site_list *list) {
    char text[400] = "";
    const size_t shown = list->count < SITES_MOST ? list->count : SITES_MOST;
    for (size_t i = 0; i < shown; i++) {
        const part *site = &list->sites[i];
        const size_t used = strlen(text);
        snprintf(text + used, sizeof text - used, "%s--crop %.0f,%.0f,%.0f,%.0f (%zu feature%s)",
                 i ? ", " : "", floor(site->box.min.x) - 1, floor(site->box.min.y) - 1,
                 ceil(site->box.max.x) + 1, ceil(site->box.max.y) + 1, site->features,
                 site->features == 1 ? "" : "s");
    }
    sl_note(geo->context, "%s: %s sites far apart; each alone: %s%s", geo->name,
            list->count > SITES_MOST ? "more than 4" : "several", text,
            list->count > SITES_MOST ? " ..." : "");
}

static bool is_closed(const sli_geo *geo, const sli_geo_feature *feature) {
    const sli_geo_line line = geo->lines.items[feature->first];
    const sl_point *p = geo->points.items + line.first;
    return line.count > 3 && p[0].x == p[line.count - 1].x && p[0].y == p[line.count - 1].y;
}

/// Open lines that nothing names are streets if they reach farther.
#define STREETS 3000

sl_status sli_geo_doubt(const sli_geo *geo) {
    sl_box all = nothing;
    size_t count = 0, closed = 0;
    if (!geo->map->earth.known || !geo->features.count) return SL_OK;
    part *parts = sl_alloc_array(geo->context, geo->features.count, sizeof *parts);
    if (!parts) return SL_NO_MEMORY;
    for (size_t i = 0; i < geo->features.count; i++) {
        const sli_geo_feature *f = &geo->features.items[i];
        if (!f->taken || f->means != SLI_GEO_WALL || !f->count) continue;
        parts[count] = (part){.box = box_of(geo, f), .features = 1};
        if (!(parts[count].box.min.x <= parts[count].box.max.x)) continue;
        closed += is_closed(geo, f);
        join(&all, parts[count++].box);
    }
    site_list list = {.count = 0};
    if (count) split(parts, count, &list);
    sl_free(geo->context, parts);
    const double size = fmax(all.max.x - all.min.x, all.max.y - all.min.y);
    if (geo->guessed && !closed && size > STREETS)
        return sl_fail_at(
            geo->context, geo->name, 0,
            "no property says what is a wall, and open lines over %.3g km are streets "
            "rather: sightline segments measures them; walls have \"kind\": \"wall\"",
            size / 1000);
    if (list.count > 1) note_sites(geo, &list);
    return SL_OK;
}

// --- areas

static double area_of(const sli_geo *geo, const sli_geo_line *line) {
    const sl_point *p = geo->points.items + line->first;
    double twice = 0;
    for (size_t i = 2; i < line->count; i++)
        twice +=
            (p[i - 1].x - p[0].x) * (p[i].y - p[0].y) - (p[i].x - p[0].x) * (p[i - 1].y - p[0].y);
    return fabs(twice) / 2;
}

static double longest_side(const sli_geo *geo, const sli_geo_line *line) {
    const sl_point *p = geo->points.items + line->first;
    double longest = 0;
    for (size_t i = 1; i < line->count; i++)
        longest = fmax(longest, hypot(p[i].x - p[i - 1].x, p[i].y - p[i - 1].y));
    return longest;
}

/// An area of an entrance is no door from this share of a usual room on, and this share as wide as
/// it is long.
static const double HALL = 0.1, HALL_WIDE = 1.0 / 3;

sl_status sli_geo_find_halls(sli_geo *geo) {
    double *areas = sl_alloc_array(geo->context, geo->features.count, sizeof *areas);
    size_t rooms = 0, walls = 0;
    if (!areas) return SL_NO_MEMORY;
    for (size_t i = 0; i < geo->features.count; i++) {
        const sli_geo_feature *f = &geo->features.items[i];
        walls += sli_says_solid(f->layer);
        if (f->count && geo->lines.items[f->first].ring &&
            (f->means == SLI_GEO_WALL || f->means == SLI_GEO_UNSAID))
            areas[rooms++] = area_of(geo, &geo->lines.items[f->first]);
    }
    if (rooms) qsort(areas, rooms, sizeof *areas, sl_compare_numbers);
    const double least = rooms && !walls ? HALL * areas[rooms / 2] : INFINITY;
    sl_free(geo->context, areas);
    for (size_t i = 0; i < geo->features.count; i++) {
        sli_geo_feature *f = &geo->features.items[i];
        const sli_geo_line *line = geo->lines.items + f->first;
        if (f->means != SLI_GEO_DOOR || f->count != 1 || !line->ring) continue;
        const double area = area_of(geo, line), longest = longest_side(geo, line);
        if (area >= least && area >= HALL_WIDE * longest * longest) f->means = SLI_GEO_NO_WALL;
    }
    return SL_OK;
}

// --- towns

/// Map projections count metres or feet from far away. Towns have many outlines, are larger than a
/// house in either unit, and their buildings leave ground between them.
enum { FOOTPRINTS = 8 };
static const double PROJECTED = 100000, TOWN = 1000, BUILT = 0.5, ENTRANCE = 1.2;

bool sli_geo_is_plan(const sli_geo *geo) {
    sl_box all = nothing;
    size_t count = 0, buildings = 0;
    if (geo->guessed && sli_geo_says_building(sl_path_name(geo->name))) return false;
    for (size_t i = 0; i < geo->features.count; i++) {
        const sli_geo_feature *f = &geo->features.items[i];
        if (!f->taken || f->means != SLI_GEO_WALL || !f->count) continue;
        join(&all, box_of(geo, f));
        count++;
        buildings += sli_geo_says_building(f->layer);
    }
    return count && 2 * buildings < count &&
           fmax(all.max.x - all.min.x, all.max.y - all.min.y) < TOWN;
}

typedef struct outline {
    sl_box box;
    double area;
} outline;

static int compare_outlines(const void *left, const void *right) {
    const outline *a = left, *b = right;
    const double of_a[] = {a->box.min.x, a->box.min.y, a->box.max.x, a->box.max.y, a->area};
    const double of_b[] = {b->box.min.x, b->box.min.y, b->box.max.x, b->box.max.y, b->area};
    for (size_t i = 0; i < sizeof of_a / sizeof *of_a; i++)
        if (of_a[i] != of_b[i]) return of_a[i] < of_b[i] ? -1 : 1;
    return 0;
}

/// The area of outlines, each counted once: some files have every building twice. Sorts.
static double area_of_all(outline *outlines, size_t count) {
    double area = 0;
    if (count) qsort(outlines, count, sizeof *outlines, compare_outlines);
    for (size_t i = 0; i < count; i++)
        if (!i || compare_outlines(&outlines[i - 1], &outlines[i]) != 0) area += outlines[i].area;
    return area;
}

/// Fills in the outlines of all features that are taken. 0 where something else is taken, too.
static size_t list_outlines(const sli_geo *geo, outline *outlines, sl_box *all, size_t *features) {
    size_t count = 0;
    *features = 0;
    *all = nothing;
    for (size_t i = 0; i < geo->features.count; i++) {
        const sli_geo_feature *f = &geo->features.items[i];
        if (!f->taken || !f->count) continue;
        if (f->means != SLI_GEO_WALL) return 0;
        for (size_t k = 0; k < f->count; k++) {
            const sli_geo_line *line = &geo->lines.items[f->first + k];
            if (!line->ring) return 0;
            outlines[count++] = (outline){box_of_line(geo, line), area_of(geo, line)};
            join(all, outlines[count - 1].box);
        }
        ++*features;
    }
    return count;
}

sl_status sli_geo_look_for_footprints(const sli_geo *geo) {
    sl_box all;
    size_t features;
    if (geo->map->earth.known || !geo->lines.count) return SL_OK;
    outline *outlines = sl_alloc_array(geo->context, geo->lines.count, sizeof *outlines);
    if (!outlines) return SL_NO_MEMORY;
    const size_t count = list_outlines(geo, outlines, &all, &features);
    const double area = area_of_all(outlines, count);
    sl_free(geo->context, outlines);
    if (!count || features < FOOTPRINTS) return SL_OK;
    const double width = all.max.x - all.min.x, height = all.max.y - all.min.y;
    const double far =
        fmax(fmax(fabs(all.min.x), fabs(all.max.x)), fmax(fabs(all.min.y), fabs(all.max.y)));
    if (far < PROJECTED || fmax(width, height) < TOWN || area > BUILT * width * height)
        return SL_OK;
    char wider[128] = "";
    if (!(geo->options->entrance > 0)) {
        geo->map->entrance = ENTRANCE;
        snprintf(wider, sizeof wider,
                 ", as openings wider than %g do not count; if there are entrances: --entrance W",
                 ENTRANCE);
    }
    sl_note(geo->context,
            "%s: its outlines look like buildings of a town, in metres or feet, which nothing "
            "says: inside is what they enclose%s",
            geo->name, wider);
    return SL_OK;
}

// --- levels

/// Rooms that fill less of their level's outline may leave corridors open.
#define FILLED 0.9

static bool is_layer(const sli_geo_feature *feature, const char *name) {
    return strcasecmp(feature->layer, name) == 0;
}

void sli_geo_note_levels(const sli_geo *geo) {
    const char *map = geo->options->map;
    double rooms = 0, levels = 0;
    if (geo->options->layers) return;
    for (size_t i = 0; i < geo->features.count; i++) {
        const sli_geo_feature *f = &geo->features.items[i];
        const sli_geo_line *lines = geo->lines.items + f->first;
        const bool wall = f->taken && f->means == SLI_GEO_WALL;
        if (wall && !is_layer(f, "unit")) return; // other walls may stand about corridors
        if (!f->count || !lines->ring) continue;
        for (size_t k = 0; wall && k < f->count; k++) rooms += area_of(geo, &lines[k]);
        if (is_layer(f, "level") && (!map || sli_geo_on_level(geo, f, map)))
            levels += area_of(geo, lines);
    }
    if (!(rooms > 0) || !(rooms < FILLED * levels)) return;
    sl_note(geo->context,
            "%s: rooms fill %.0f %% of their level: if corridors between them are inside: "
            "sightline check '%.300s'%s%.64s%s --layers unit,level -o map.png",
            geo->name, 100 * rooms / levels, geo->name, map ? " --map '" : "", map ? map : "",
            map ? "'" : "");
}

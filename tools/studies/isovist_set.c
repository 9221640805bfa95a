/// What is seen from a line or an area.
#include "studies/isovist_set.h"

#include "arguments/names.h"
#include "inputs/path_points.h"
#include "sightline/json.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

// --- how it is given

/// A disc's corners lie on its circle, its chords up to this share of the radius within it.
static const double CHORD = 1e-3;

/// Numbers with commas between.
static sl_status read_numbers(sl_context *context, const char *label, const char *text,
                              double **numbers, size_t *count) {
    size_t commas = 0;
    for (const char *c = text; *c; c++) commas += *c == ',';
    *count = 0;
    *numbers = sl_alloc_array(context, commas + 1, sizeof **numbers);
    if (!*numbers) return SL_NO_MEMORY;
    for (const char *from = text;; from++) {
        const size_t length = strcspn(from, ",");
        if (!sl_number_read(from, length, &(*numbers)[*count]) || !isfinite((*numbers)[*count]))
            return sl_fail(context, SL_BAD_ARGUMENT,
                           "%s %s: expected numbers with commas between, as 3,5,12,5", label, text);
        ++*count;
        from += length;
        if (!*from) return SL_OK;
    }
}

static sl_status take_numbers(sl_context *context, const char *label, const char *text,
                              size_t least, const double *numbers, size_t count, isovist_set *out) {
    if (out->kind == SL_SET_AREA && count == 3) {
        const sl_point middle = {numbers[0], numbers[1]};
        const double radius = numbers[2];
        if (!(radius > 0))
            return sl_fail(context, SL_BAD_ARGUMENT, "%s %s: the radius must be over 0", label,
                           text);
        out->count = sl_set_of_disc(middle, radius, CHORD * radius, NULL, 0);
        out->points = sl_alloc_array(context, out->count, sizeof *out->points);
        if (!out->points) return SL_NO_MEMORY;
        sl_set_of_disc(middle, radius, CHORD * radius, out->points, out->count);
        return SL_OK;
    }
    if (count % 2 || count < 2 * least)
        return sl_fail(context, SL_BAD_ARGUMENT, "%s %s: expected %s", label, text,
                       out->kind == SL_SET_AREA
                           ? "three or more points, X,Y,X,Y,X,Y, or a disc, X,Y,R"
                           : "two or more points, X,Y,X,Y");
    out->points = sl_alloc_array(context, count / 2, sizeof *out->points);
    if (!out->points) return SL_NO_MEMORY;
    for (; out->count < count / 2; out->count++)
        out->points[out->count] = (sl_point){numbers[2 * out->count], numbers[2 * out->count + 1]};
    return SL_OK;
}

static sl_status read_points(sl_context *context, const char *label, const char *text,
                             sl_set_kind kind, isovist_set *out) {
    double *numbers = NULL;
    size_t count;
    out->kind = kind;
    sl_status status = read_numbers(context, label, text, &numbers, &count);
    if (status == SL_OK)
        status =
            take_numbers(context, label, text, kind == SL_SET_AREA ? 3 : 2, numbers, count, out);
    sl_free(context, numbers);
    return status;
}

sl_status isovist_set_make(sl_context *context, const set_choice *choice, const sl_baked *baked,
                           sl_query *query, isovist_set *out) {
    if (choice->line)
        SL_TRY(read_points(context, "--from-line", choice->line, SL_SET_LINE, out));
    else if (choice->area)
        SL_TRY(read_points(context, "--from-area", choice->area, SL_SET_AREA, out));
    else
        SL_TRY(path_points_read(context, "along", choice->along, &baked->map, &out->points,
                                &out->count));
    sl_set_sight *sight;
    SL_TRY(sl_set_sight_create(context, query, out->points, out->count, out->kind, &sight));
    sl_status status = SL_OK;
    for (int seen = 0; seen < 2 && status == SL_OK; seen++)
        status = sl_set_sight_region(context, sight, (sl_set_seen)seen, &out->regions[seen]);
    sl_set_sight_destroy(context, sight);
    return status;
}

void isovist_set_destroy(sl_context *context, isovist_set *set) {
    sl_free(context, set->points);
    for (int seen = 0; seen < 2; seen++) sl_set_region_destroy(context, &set->regions[seen]);
    *set = (isovist_set){0};
}

// --- its files

static const char *const KINDS[2] = {"seen_from_some", "seen_from_all"};

static void put_rows(const isovist_set *set, FILE *out) {
    fputs("seen,area,corners,loops\n", out);
    for (int seen = 0; seen < 2; seen++) {
        const sl_shape *shape = &set->regions[seen].shape;
        char area[SL_NUMBER_TEXT];
        sl_number_write(set->regions[seen].area, area);
        fprintf(out, "%s,%s,%zu,%zu\n", seen ? "from_all" : "from_some", area,
                shape->count ? shape->ends[shape->count - 1] : 0, shape->count);
    }
}

static double area_of(const sl_point *p, size_t count) {
    double twice = 0;
    for (size_t i = 2; i < count; i++)
        twice +=
            (p[i - 1].x - p[0].x) * (p[i].y - p[0].y) - (p[i - 1].y - p[0].y) * (p[i].x - p[0].x);
    return twice / 2;
}

static bool holds(const sl_point *loop, size_t count, sl_point p) {
    bool in = false;
    for (size_t i = 0; i < count; i++) {
        const sl_point a = loop[i], b = loop[i + 1 < count ? i + 1 : 0];
        if ((a.y > p.y) != (b.y > p.y) && (sl_orient(a, b, p) > 0) == (b.y > a.y)) in = !in;
    }
    return in;
}

typedef struct rings {
    sl_point *points;
    uint32_t *rings, *polygons, *outer;
    double *areas;
} rings;

/// By hole, the least loop that it lies in. Loops meet in single points only, so the middle of a
/// side tells.
static void find_outer(const sl_shape *s, rings *r) {
    for (size_t i = 0; i < s->count; i++) {
        const size_t from = i ? s->ends[i - 1] : 0;
        r->areas[i] = area_of(s->points + from, s->ends[i] - from);
    }
    for (size_t i = 0; i < s->count; i++) {
        const sl_point *p = s->points + (i ? s->ends[i - 1] : 0);
        const sl_point middle = {p[0].x + (p[1].x - p[0].x) / 2, p[0].y + (p[1].y - p[0].y) / 2};
        r->outer[i] = UINT32_MAX;
        if (r->areas[i] > 0) continue;
        double least = INFINITY;
        for (size_t k = 0; k < s->count; k++) {
            const size_t from = k ? s->ends[k - 1] : 0;
            if (!(r->areas[k] > 0 && r->areas[k] < least) ||
                !holds(s->points + from, s->ends[k] - from, middle))
                continue;
            least = r->areas[k];
            r->outer[i] = (uint32_t)k;
        }
    }
}

static void add_ring(const sl_shape *s, size_t i, rings *r, uint32_t *ring) {
    uint32_t at = r->rings[*ring];
    for (size_t k = i ? s->ends[i - 1] : 0; k < s->ends[i]; k++) r->points[at++] = s->points[k];
    r->rings[++*ring] = at;
}

static void put_rings(sl_geojson_writer *out, const sl_shape *s, const char *kind, rings *r) {
    uint32_t ring = 0, polygon = 0;
    find_outer(s, r);
    for (size_t i = 0; i < s->count; i++) {
        if (!(r->areas[i] > 0)) continue;
        add_ring(s, i, r, &ring);
        for (size_t k = 0; k < s->count; k++)
            if (r->outer[k] == i) add_ring(s, k, r, &ring);
        r->polygons[++polygon] = ring;
    }
    uint32_t shapes[2] = {0, polygon};
    const sl_shapes all = {r->points, r->rings, r->polygons, shapes, 1};
    sl_geojson_put_shape(out, kind, &all, 0);
}

static sl_status put_shape(sl_context *context, sl_geojson_writer *out, const sl_set_region *region,
                           const char *kind) {
    const sl_shape *s = &region->shape;
    const size_t points = s->count ? s->ends[s->count - 1] : 0;
    if (!s->count) return SL_OK;
    rings r = {.points = sl_alloc_array(context, points, sizeof *r.points),
               .rings = sl_alloc_array(context, s->count + 1, sizeof *r.rings),
               .polygons = sl_alloc_array(context, s->count + 1, sizeof *r.polygons),
               .outer = sl_alloc_array(context, s->count, sizeof *r.outer),
               .areas = sl_alloc_array(context, s->count, sizeof *r.areas)};
    const bool made = r.points && r.rings && r.polygons && r.outer && r.areas;
    if (made) {
        put_rings(out, s, kind, &r);
        sl_geojson_add_real(out, "area", region->area);
        sl_geojson_end_feature(out);
    }
    sl_free(context, r.points);
    sl_free(context, r.rings);
    sl_free(context, r.polygons);
    sl_free(context, r.outer);
    sl_free(context, r.areas);
    return made ? SL_OK : SL_NO_MEMORY;
}

sl_status isovist_set_write(sl_context *context, const isovist_set *set, const sl_earth *earth,
                            const char *path) {
    sl_output output;
    sl_status status = SL_OK;
    SL_TRY(sl_output_open(context, path, &output));
    if (name_ends_with(path, ".geojson")) {
        sl_geojson_writer out = sl_geojson_begin(output.stream, earth);
        for (int seen = 0; seen < 2 && status == SL_OK; seen++)
            status = put_shape(context, &out, &set->regions[seen], KINDS[seen]);
        sl_geojson_end(&out);
    } else {
        put_rows(set, output.stream);
    }
    return sl_output_close(context, &output, status);
}

void isovist_set_say(const isovist_set *set, const char *unit, char *text, size_t size) {
    const char *space = *unit ? " " : "", *square = *unit ? "\xc2\xb2" : "";
    const size_t used = (size_t)snprintf(text, size, "some point of it sees %.6g%s%s%s",
                                         set->regions[SL_SEEN_FROM_SOME].area, space, unit, square);
    if (used >= size) return;
    if (set->regions[SL_SEEN_FROM_ALL].walled)
        snprintf(text + used, size - used, ", all points see nothing: a wall crosses it");
    else
        snprintf(text + used, size - used, ", all points see %.6g%s%s%s",
                 set->regions[SL_SEEN_FROM_ALL].area, space, unit, square);
}

/// The sampling solver: random lines, rasterised point by point and half a quadrant at a time
/// (Laine 2005, section 5.2; Nirenstein & Blake 2004).
///
///     face   lines of one slope      A point of the face has one line for each pixel, which is a
///      |  /   /   /   /              slope from 0 to 1. The lines of one slope are parallel and
///      | /   /   /  [object]         equally far apart, shifted at random. They are the same
///      |/   /   /   /                lines for all faces.
///
/// Invariant: a line that goes on through the next face is one of that face's lines too. So a
/// refine set never lacks what a line meets, and all methods find the same, to the last bit.
///
/// What a line meets first is found without measuring: leaves have an order in each quadrant, and a
/// line leaves a convex leaf by one side. Signs are exact; a line through an end of a side passes
/// at its right. Only objects that a point's view frustum meets are drawn.
///
/// Cost: O(points x (objects of the refine set + pixels x items drawn)) for a face and quadrant.
#include "study/from_region/from_region_scene.h"

#include "geometry/orient.h"
#include "sightline/support.h"

#include <math.h>
#include <string.h>

/// A line that leaves by the face, and the nearest object that it has met so far.
typedef struct ray {
    sl_line line;
    uint32_t pixel, point;
    uint32_t object; ///< UINT32_MAX for none
    uint32_t leaf;   ///< where it was met, by place in the quadrant's order
} ray;

typedef struct sampler {
    const sl_from_region_scene *scene;
    const sl_from_region_options *options;
    double step;                ///< from one line of a direction to the next, along an axis
    SL_ARRAY(ray) found, rays;  ///< as found; by point, then pixel
    SL_ARRAY(uint32_t) starts;  ///< by point
    SL_ARRAY(uint32_t) refined; ///< the refine set after view frustum culling
} sampler;

static sl_status create(sl_context *context, const sl_from_region_scene *scene,
                        const sl_from_region_options *options, void **state) {
    sampler *s = sl_alloc_array(context, 1, sizeof *s);
    if (!s) return SL_NO_MEMORY;
    const sl_box b = scene->space.bounds;
    s->scene = scene;
    s->options = options;
    s->step = fmax(b.max.x - b.min.x, b.max.y - b.min.y) / options->points;
    *state = s;
    return SL_OK;
}

static void destroy(sl_context *context, void *state) {
    sampler *s = state;
    if (!s) return;
    sl_free(context, s->found.items);
    sl_free(context, s->rays.items);
    sl_free(context, s->starts.items);
    sl_free(context, s->refined.items);
    sl_free(context, s);
}

/// Half a quadrant: where `steep`, lines that go farther up or down than sideways.
typedef struct image {
    int quadrant;
    bool steep;
} image;

/// How far a pixel's line goes aside for each step ahead: 0 to 1.
static double slope_of(const sampler *s, uint32_t pixel) {
    return (pixel + 0.5) / s->options->pixels;
}

/// The share of a step by which a pixel's lines are shifted. Opposite quadrants have the same
/// lines, and so the same shift.
static double shift_of(const sampler *s, image i, uint32_t pixel) {
    const uint64_t falling = i.quadrant % 2 != 0, steep = i.steep;
    sl_random random = {s->options->seed ^
                        (((uint64_t)pixel << 2 | falling << 1 | steep) * 0x9e3779b97f4a7c15u)};
    random.state = sl_random_next(&random);
    return sl_random_unit(&random);
}

/// Where the line of this slope through a point meets the map's edge: the same for all points of a
/// line. It is measured from the map's corner: far from the origin, lines' numbers would be too
/// large for a double to count.
static double offset_of(const sampler *s, image i, double slope, sl_point p) {
    const sl_point corner = s->scene->space.bounds.min;
    const double x = p.x - corner.x, y = p.y - corner.y;
    return i.steep ? x - slope * y : y - slope * x;
}

/// The line of a number, in the quadrant's direction, from one edge of the map to the other.
static sl_line line_of(const sampler *s, image i, double slope, double offset) {
    const sl_box b = s->scene->space.bounds;
    const bool onwards = i.steep ? sli_goes_up(i.quadrant) : sli_goes_right(i.quadrant);
    const double low = i.steep ? b.min.y : b.min.x, high = i.steep ? b.max.y : b.max.x;
    const double at_low = (i.steep ? b.min.x : b.min.y) + offset;
    const double at_high = at_low + slope * (high - low);
    const sl_point first = i.steep ? (sl_point){at_low, low} : (sl_point){low, at_low};
    const sl_point last = i.steep ? (sl_point){at_high, high} : (sl_point){high, at_high};
    return onwards ? (sl_line){first, last} : (sl_line){last, first};
}

static bool passes(sl_line line, sl_point left, sl_point right) {
    return sli_orient(line.a, line.b, left) >= 0 && sli_orient(line.a, line.b, right) < 0;
}

/// Adds the lines of one pixel that leave by the face.
static sl_status add_rays(sl_context *context, sampler *s, image i, uint32_t pixel,
                          const sl_directed_portal *portal, uint32_t points) {
    // Rising and falling lines: x and y grow together in quadrants 0 and 2 alone.
    const double slope = (i.quadrant % 2 ? -1 : 1) * slope_of(s, pixel);
    const double shift = shift_of(s, i, pixel);
    const double p = offset_of(s, i, slope, portal->left),
                 q = offset_of(s, i, slope, portal->right);
    const double low = floor(fmin(p, q) / s->step - shift) - 1;
    const double high = ceil(fmax(p, q) / s->step - shift) + 1;
    for (double number = low; number <= high; number++) {
        const double offset = (number + shift) * s->step;
        const sl_line line = line_of(s, i, slope, offset);
        if (!passes(line, portal->left, portal->right)) continue;
        // The point of the face that a line belongs to matters only for culling.
        const double share = (offset - p) / (q - p) * points;
        const uint32_t point = share >= points ? points - 1 : share > 0 ? (uint32_t)share : 0;
        SL_TRY(SL_ARRAY_ROOM(context, &s->found, 1));
        s->found.items[s->found.count++] =
            (ray){.line = line, .pixel = pixel, .point = point, .object = UINT32_MAX};
    }
    return SL_OK;
}

/// Makes all lines of half a quadrant through a face, sorted by point, then pixel.
static sl_status make_rays(sl_context *context, sampler *s, image i,
                           const sl_directed_portal *portal, uint32_t points) {
    s->found.count = 0;
    for (uint32_t pixel = 0; pixel < s->options->pixels; pixel++)
        SL_TRY(add_rays(context, s, i, pixel, portal, points));
    SL_TRY(SL_ARRAY_ROOM(context, &s->starts, (size_t)points + 2));
    s->rays.count = 0;
    SL_TRY(SL_ARRAY_ROOM(context, &s->rays, s->found.count));
    uint32_t *starts = s->starts.items;
    memset(starts, 0, ((size_t)points + 2) * sizeof *starts);
    for (size_t k = 0; k < s->found.count; k++) starts[s->found.items[k].point + 2]++;
    for (uint32_t k = 0; k < points; k++) starts[k + 2] += starts[k + 1];
    for (size_t k = 0; k < s->found.count; k++)
        s->rays.items[starts[s->found.items[k].point + 1]++] = s->found.items[k];
    s->rays.count = s->found.count;
    return SL_OK;
}

// --- drawing

/// Coordinates in the image's direction: both grow along the lines.
typedef struct frame {
    double ahead, aside;
} frame;

static frame in_frame(image i, sl_point p) {
    const double x = sli_goes_right(i.quadrant) ? p.x : -p.x;
    const double y = sli_goes_up(i.quadrant) ? p.y : -p.y;
    return i.steep ? (frame){y, x} : (frame){x, y};
}

/// A box in the frame: the part of a face that a point stands for, or an object.
typedef struct extent {
    frame low, high;
} extent;

static extent extent_of(image i, sl_point a, sl_point b) {
    const frame p = in_frame(i, a), q = in_frame(i, b);
    return (extent){{fmin(p.ahead, q.ahead), fmin(p.aside, q.aside)},
                    {fmax(p.ahead, q.ahead), fmax(p.aside, q.aside)}};
}

/// Whether lines of slopes from 0 to 1 may meet it. `from` has room for rounding.
static bool in_frustum(const extent *from, const extent *what) {
    const double ahead = what->high.ahead - from->low.ahead;
    return ahead >= 0 && what->high.aside >= from->low.aside &&
           what->low.aside - from->high.aside <= ahead;
}

/// The pixels whose lines may meet a box: the slopes from the face to it, with room for rounding.
static void pixels_of(const sampler *s, const extent *from, const extent *what, uint32_t *first,
                      uint32_t *end) {
    const double near = what->low.ahead - from->high.ahead;
    const double far = what->high.ahead - from->low.ahead;
    const double below = what->low.aside - from->high.aside;
    const double above = what->high.aside - from->low.aside;
    const uint32_t count = s->options->pixels;
    double low = 0, high = count;
    if (far > 0 && below > 0) low = floor(below / far * count) - 2;
    if (near > 0) high = ceil(above / near * count) + 2;
    *first = low > 0 ? low < count ? (uint32_t)low : count : 0;
    *end = high > 0 ? high < count ? (uint32_t)high : count : 0;
}

/// An image at work: the rays of one point of a face.
typedef struct drawing {
    image image;
    uint32_t behind; ///< the place of the leaf behind the face
    extent from;     ///< the point
    ray *rays;
    size_t count;
    sl_bits *seen;
} drawing;

/// Draws an item. A solid one is kept where it is the nearest. One that is seen through is seen
/// where nothing solid is nearer.
static void draw(const sampler *s, const drawing *d, const sli_item *item) {
    const uint32_t place = s->scene->passes[d->image.quadrant].place[item->leaf];
    if (place > d->behind) return; // before the face
    const sl_portal_ends ends = sli_item_ends(item, d->image.quadrant);
    const extent what = extent_of(d->image, ends.left, ends.right);
    uint32_t first, end;
    if (!in_frustum(&d->from, &what)) return;
    pixels_of(s, &d->from, &what, &first, &end);
    for (size_t k = 0; k < d->count && d->rays[k].pixel < end; k++) {
        ray *r = &d->rays[k];
        if (r->pixel < first || (r->object != UINT32_MAX && place < r->leaf)) continue;
        if (!passes(r->line, ends.left, ends.right)) continue;
        if (item->through) {
            sl_bits_add(d->seen, item->object);
        } else {
            r->object = item->object;
            r->leaf = place;
        }
    }
}

static void draw_image(sampler *s, const drawing *d, const sl_bits *refine,
                       sli_from_region_account *account) {
    const sl_from_region_scene *scene = s->scene;
    s->refined.count = 0;
    for (size_t word = 0; word < scene->words; word++)
        for (sl_bits left = refine[word]; left; left &= left - 1) {
            const uint32_t object = (uint32_t)(64 * word) + (uint32_t)__builtin_ctzll(left);
            const sl_box *box = &scene->boxes[object];
            const extent what = extent_of(d->image, box->min, box->max);
            if (in_frustum(&d->from, &what)) s->refined.items[s->refined.count++] = object;
        }
    account->images++;
    account->rays += d->count;
    account->refined += s->refined.count;
    for (int through = 0; through < 2; through++)
        for (size_t k = 0; k < s->refined.count; k++) {
            const uint32_t object = s->refined.items[k];
            for (uint32_t n = scene->first_item[object]; n < scene->first_item[object + 1]; n++)
                if (scene->items.items[n].through == (through == 1))
                    draw(s, d, &scene->items.items[n]);
        }
    for (size_t k = 0; k < d->count; k++)
        if (d->rays[k].object != UINT32_MAX) sl_bits_add(d->seen, d->rays[k].object);
}

/// The part of a face from which the lines of one of its points leave, and a little more.
static extent point_of(image i, const sl_directed_portal *portal, uint32_t point, uint32_t points,
                       double step) {
    const double low = (double)point / points, high = (double)(point + 1) / points;
    const sl_point l = portal->left, way = {portal->right.x - l.x, portal->right.y - l.y};
    extent e = extent_of(i, (sl_point){l.x + low * way.x, l.y + low * way.y},
                         (sl_point){l.x + high * way.x, l.y + high * way.y});
    const double room = step / 1024;
    e.low.ahead -= room;
    e.low.aside -= room;
    e.high.ahead += room;
    e.high.aside += room;
    return e;
}

static sl_status run(sl_context *context, void *state, const sli_from_region_query *query,
                     sl_bits *seen, sli_from_region_account *account) {
    sampler *s = state;
    const sl_directed_portal *portal = &s->scene->space.directed[query->face->directed];
    const double length =
        fabs(portal->right.x - portal->left.x) + fabs(portal->right.y - portal->left.y);
    const uint32_t points = (uint32_t)fmax(1, ceil(length / s->step));
    SL_TRY(SL_ARRAY_ROOM(context, &s->refined, sli_from_region_objects(s->scene)));
    for (int steep = 0; steep < 2; steep++) {
        const image i = {query->quadrant, steep};
        SL_TRY(sl_check_cancelled(context));
        SL_TRY(make_rays(context, s, i, portal, points));
        for (uint32_t point = 0; point < points; point++) {
            const uint32_t first = s->starts.items[point], end = s->starts.items[point + 1];
            if (first == end) continue;
            const drawing d = {i,
                               s->scene->passes[i.quadrant].place[portal->cell],
                               point_of(i, portal, point, points, s->step),
                               s->rays.items + first,
                               end - first,
                               seen};
            draw_image(s, &d, query->refine, account);
        }
    }
    return SL_OK;
}

const sli_from_region_solver_calls *sli_from_region_sampling(void) {
    static const sli_from_region_solver_calls sampling = {
        .create = create,
        .destroy = destroy,
        .run = run,
    };
    return &sampling;
}

/// Sight of a set within a range: what is nearer than R to the point that sees it.
///
///                 . q .           The ray from p past the end u of a wall ends at q, as far as R
///               .       .         from p. While p moves along the segment, q draws the border of
///              .    u    .        the cone behind u (a conchoid). What one eye sees ends at an
///              arc.
///                  . .            Both are bent outwards, so chords lie within them.
///             -----p-p'------
///
/// Let x be seen from some p, and p be the nearest one to it. Either p is the end of a piece of the
/// set that x sees: an eye, or a place whose ray to x grazes a wall, so x is in a cone. Or p is the
/// foot of x on a segment. Then an eye near p sees x, too, or such an end is near: at most D away,
/// and so at most D^2 / 2R farther. So eyes in steps of D leave out only what is nearly as far as
/// R.
///
/// The share of R that is left out, SL_SET_RANGE_SHARE, is spent on steps, chords, and the way from
/// crossings of walls with the set to the eyes beside them.
#include "analysis/set_sight/set_sight.h"

#include "geometry/crossing.h"
#include "geometry/length.h"

#include <math.h>

/// Shares of the range: what chords of a circle and of a cone leave out at most, and how far an eye
/// is from a crossing.
static const double CHORD = 0x1.4p-10, BESIDE = 0x1p-12;

/// A cone is halved as often as this at least and at most.
enum { HALVED_LEAST = 2, HALVED_MOST = 14 };

void sli_range_directions(sl_point out[SLI_RANGE_SECTORS]) {
    enum { QUARTER = SLI_RANGE_SECTORS / 4 };
    const sl_point axes[] = {{1, 0}, {0, 1}, {-1, 0}, {0, -1}};
    for (int i = 0; i < 4; i++) out[i * QUARTER] = axes[i];
    for (int step = QUARTER; step > 1; step /= 2)
        for (int i = step / 2; i < SLI_RANGE_SECTORS; i += step) {
            const sl_point a = out[i - step / 2], b = out[(i + step / 2) % SLI_RANGE_SECTORS];
            const double length = sli_length(a.x + b.x, a.y + b.y);
            out[i] = (sl_point){(a.x + b.x) / length, (a.y + b.y) / length};
        }
}

double sli_range_step(double range) {
    return range * sqrt(2 * (SL_SET_RANGE_SHARE - CHORD - BESIDE)) * 0.99;
}

double sli_range_beside(double range) {
    return range * BESIDE;
}

sl_status sli_add_circle(sl_context *context, const struct sl_set_sight *s, sl_point at,
                         sli_parts *parts) {
    SL_TRY(SL_ARRAY_ROOM(context, &parts->points, SLI_RANGE_SECTORS));
    for (size_t i = 0; i < SLI_RANGE_SECTORS; i++)
        parts->points.items[parts->points.count++] =
            (sl_point){at.x + s->range * s->directions[i].x, at.y + s->range * s->directions[i].y};
    return sli_parts_close(context, parts);
}

sl_status sli_add_eye_in_range(sl_context *context, struct sl_set_sight *s, const sli_spot *spot,
                               sli_parts *parts) {
    sl_segment chord = {.b = {spot->at.x + s->range * s->directions[0].x,
                              spot->at.y + s->range * s->directions[0].y}};
    for (size_t i = 1; i <= SLI_RANGE_SECTORS; i++) {
        const sl_point d = s->directions[i % SLI_RANGE_SECTORS];
        chord.a = chord.b;
        chord.b = (sl_point){spot->at.x + s->range * d.x, spot->at.y + s->range * d.y};
        const sli_beam beam = {{chord.a, false}, {chord.b, false}};
        if (sli_ray_turn(spot->at, &beam.right, &beam.left) <= 0) continue;
        SL_TRY(sli_add_beam(context, s, spot, &beam, &chord, parts));
    }
    return SL_OK;
}

// --- cones

/// A place of the segment, as a share of its way, the ray behind the corner that comes from there,
/// and where it ends.
typedef struct ray_end {
    double share;
    sli_ray ray;
    sl_point q;
    double length; ///< of the ray behind the corner
} ray_end;

typedef struct cone {
    sl_context *context;
    struct sl_set_sight *sight;
    const sli_spot *spot;
    sl_point a, way; ///< the segment, from the corner
    sli_parts *parts;
} cone;

static sl_point place_at(const cone *c, double share) {
    return (sl_point){c->a.x + share * c->way.x, c->a.y + share * c->way.y};
}

static ray_end end_at(const cone *c, double share, const sli_ray *ray) {
    const sl_point p = place_at(c, share), u = c->spot->at;
    const double away = sli_length(p.x, p.y), length = c->sight->range - away;
    const double along = -length / away;
    return (ray_end){.share = share,
                     .ray = ray ? *ray : (sli_ray){{u.x + p.x, u.y + p.y}, true},
                     .q = {u.x + along * p.x, u.y + along * p.y},
                     .length = length};
}

/// Where a ray from the corner, away from the segment, comes from.
static double share_of(const cone *c, const sli_ray *ray) {
    const sl_point v = {ray->through.x - c->spot->at.x, ray->through.y - c->spot->at.y};
    return sli_cross(v, c->a) / -sli_cross(v, c->way);
}

/// How much of a ray the chord between two ends leaves out.
static double left_out(const cone *c, const ray_end *right, const ray_end *left,
                       const ray_end *middle) {
    const sl_point u = c->spot->at, p = place_at(c, middle->share);
    const double away = sli_length(p.x, p.y);
    const sl_point e = {-p.x / away, -p.y / away}, from = {right->q.x - u.x, right->q.y - u.y},
                   chord = {left->q.x - right->q.x, left->q.y - right->q.y};
    const double met = sli_cross(from, chord) / sli_cross(e, chord);
    return met > 0 ? middle->length - met : middle->length;
}

static sl_status add_sectors(const cone *c, const ray_end *right, const ray_end *left, int halved) {
    const double enough = CHORD * c->sight->range / 2;
    if (right->length <= 0 && left->length <= 0 && halved >= HALVED_LEAST) return SL_OK;
    const ray_end middle = end_at(c, right->share + (left->share - right->share) / 2, NULL);
    if (halved < HALVED_LEAST ||
        (halved < HALVED_MOST && left_out(c, right, left, &middle) > enough)) {
        SL_TRY(add_sectors(c, right, &middle, halved + 1));
        return add_sectors(c, &middle, left, halved + 1);
    }
    const sli_beam beam = {right->ray, left->ray};
    const sl_segment chord = {right->q, left->q};
    if (sli_ray_turn(c->spot->at, &beam.right, &beam.left) <= 0) return SL_OK;
    return sli_add_beam(c->context, c->sight, c->spot, &beam, &chord, c->parts);
}

sl_status sli_add_cone_in_range(sl_context *context, struct sl_set_sight *s, const sli_spot *spot,
                                sl_segment segment, const sli_beam *beam, sli_parts *parts) {
    const sl_point u = spot->at;
    const cone c = {.context = context,
                    .sight = s,
                    .spot = spot,
                    .a = {segment.a.x - u.x, segment.a.y - u.y},
                    .way = {segment.b.x - segment.a.x, segment.b.y - segment.a.y},
                    .parts = parts};
    const double square = sli_dot(c.way, c.way), length = sqrt(square);
    const double far = fabs(sli_cross(c.a, c.way)) / length;
    if (!(far < s->range)) return SL_OK;
    const double foot = -sli_dot(c.a, c.way) / square,
                 half = sqrt((s->range - far) * (s->range + far)) / length;
    const double right = share_of(&c, &beam->right), left = share_of(&c, &beam->left);
    const double from = fmin(fmax(right, foot - half), foot + half),
                 to = fmin(fmax(left, foot - half), foot + half);
    if (!(from != to)) return SL_OK; // out of range, or NAN
    const ray_end ends[2] = {end_at(&c, from, from == right ? &beam->right : NULL),
                             end_at(&c, to, to == left ? &beam->left : NULL)};
    return add_sectors(&c, &ends[0], &ends[1], 0);
}

// --- single points

bool sli_is_in_range(const struct sl_set_sight *s, sl_point eye, const sli_beam *beam,
                     sl_segment side) {
    if (!(s->within > 0)) return true;
    const sli_glance glance = {.eye.at = eye,
                               .from.at = beam->right.through,
                               .to.at = beam->left.through,
                               .from_away = beam->right.away,
                               .to_away = beam->left.away,
                               .right = side.a,
                               .left = side.b};
    return sli_nearest_compare(&glance, s->within) <= 0;
}

/// Which look is that of walls.
///
/// A look weighs by the square of its contrast with the ground and by its thickness: the width of
/// its lines, or 2 area / perimeter of what is filled, which is the width of a long bar. A fill
/// thicker than 1/25 of the drawing is a floor and weighs nothing. Long walls tell where a look is:
/// lettering, symbols and furniture are short. The heaviest look that has a fair share of all long
/// lines, over a fair part of the drawing, is that of walls, with all others of at least 2/5 of its
/// weight: thinner inner walls. Coloured lines beside black and grey ones are furniture and wires;
/// light colours fill rooms, and count where nothing else does. Where the walls are a mere outline
/// of the whole plan, the look most like walls of the others draws what is in it, and is taken too.
/// Where there are none, the floors are rooms, and their outlines are walls.
#include "io/parts/drawn_looks.h"

#include "geometry/length.h"
#include "space/index.h"

#include <math.h>
#include <string.h>

/// Of fewer shapes than LEAST_SHAPES nothing is told.
enum { MOST_LOOKS = 512, LEAST_WALLS = 3, LEAST_SHAPES = 8 };

/// A long wall: 1/60 of the drawing, in a shape of 1/20. A floor is thicker than 1/25. A word or a
/// symbol has no long wall, and is up to 1/4 large. A room is wider than 1/15.
#define LONG  60
#define LARGE 20
#define FLOOR 25
#define WORD  4
#define ROOM  15
/// A line of inner walls is longer than this share of the drawing.
#define CROSSING 5
/// Shares of the long lines: of the heaviest look, and of those beside it.
#define FAIR   0.15
#define BESIDE 0.02
/// How much alike the widths of lines are that have one look, and of one pen at several scales.
#define SAME 0.01
#define PEN  0.1
/// How far apart the parts of a colour are that is no grey.
#define COLOURED 0x40
/// The contrast of a colour that fills rooms.
#define TINT 0.7
/// How far apart letters are, and how much larger than the next one, in its size; so many bars may
/// stand before the next letter that is more.
#define NEXT_LETTER    0.7
#define LARGEST_LETTER 1.6
enum { LETTERS = 6 };
/// Of the lines that are taken: those that are no outline of the whole.
#define INNER 0.1
/// Of the heaviest look's weight, and of its contrast.
#define ALIKE    0.4
#define CONTRAST 0.75

// --- names

static const struct {
    uint32_t colour;
    const char *name;
} plain[] = {{0x000000, "black"}, {0xFFFFFF, "white"}, {0xFF0000, "red"},
             {0x0000FF, "blue"},  {0x008000, "green"}, {0x808080, "grey"}};

static void write_name(sli_look *look) {
    const sli_ink *ink = &look->ink;
    char colour[16];
    snprintf(colour, sizeof colour, "#%06x", (unsigned)(ink->colour & 0xFFFFFF));
    for (size_t i = 0; i < sizeof plain / sizeof *plain; i++)
        if (plain[i].colour == ink->colour) snprintf(colour, sizeof colour, "%s", plain[i].name);
    if (!ink->known) snprintf(colour, sizeof colour, "patterned");
    if (ink->line)
        snprintf(look->name, sizeof look->name, "%s line %.3g", colour, ink->width);
    else
        snprintf(look->name, sizeof look->name, "%s fill", colour);
}

bool sli_look_may_be(sli_word name) {
    static const char *const words[] = {" line ", " fill"};
    for (int i = 0; i < 2; i++)
        for (size_t k = 0; k + strlen(words[i]) <= name.length; k++)
            if (memcmp(name.at + k, words[i], strlen(words[i])) == 0) return true;
    return false;
}

// --- which there are

/// Whether colours are the same, and widths of lines within a share.
static bool same_ink(const sli_ink *a, const sli_ink *b, double within) {
    return a->line == b->line && a->known == b->known && a->colour == b->colour &&
           (!a->line || fabs(a->width - b->width) <= within * fmax(a->width, b->width));
}

sl_status sli_looks_find(sl_context *context, sli_looks *looks, const sli_ink *ink, uint32_t *out) {
    if (looks->last < looks->items.count &&
        same_ink(&looks->items.items[looks->last].ink, ink, SAME)) {
        *out = looks->last;
        return SL_OK;
    }
    for (size_t i = 0; i < looks->items.count; i++) {
        if (!same_ink(&looks->items.items[i].ink, ink, SAME) && i + 1 < MOST_LOOKS) continue;
        *out = looks->last = (uint32_t)i;
        return SL_OK;
    }
    SL_TRY(SL_ARRAY_ROOM(context, &looks->items, 1));
    *out = looks->last = (uint32_t)looks->items.count;
    looks->items.items[looks->items.count] = (sli_look){.ink = *ink};
    write_name(&looks->items.items[looks->items.count++]);
    return SL_OK;
}

// --- measures

typedef struct chooser {
    const sl_map *map;
    const sli_look_shape *shapes;
    size_t count;
    sli_looks *looks;
    sl_box bounds;
    double size;
    size_t backdrops;     ///< so many first shapes are pages
    double ground;        ///< how light what all lies on is
    double lines, floors; ///< how long all long lines are: of what may be walls, of floors
} chooser;

static double width_of(sl_box box) {
    return box.max.x - box.min.x;
}

static double height_of(sl_box box) {
    return box.max.y - box.min.y;
}

static double extent(sl_box box) {
    return fmax(width_of(box), height_of(box));
}

static sl_box box_of(const sl_map *map, const sli_look_shape *shape) {
    sl_box box = sli_box_around(map->walls[shape->first].a, map->walls[shape->first].a);
    for (size_t i = shape->first; i < shape->end; i++)
        box = sli_box_with(sli_box_with(box, map->walls[i].a), map->walls[i].b);
    return box;
}

/// How light a colour is, from 0 to 1 (ITU-R BT.709).
static double lightness(const sli_ink *ink) {
    if (!ink->known) return 0.7;
    const double red = ink->colour >> 16 & 0xFF, green = ink->colour >> 8 & 0xFF;
    return (0.2126 * red + 0.7152 * green + 0.0722 * (ink->colour & 0xFF)) / 255;
}

/// Whether a filled shape is a box as large as all.
static bool is_page(const chooser *c, const sli_look_shape *shape) {
    const sl_box box = box_of(c->map, shape);
    return !c->looks->items.items[shape->look].ink.line && shape->end - shape->first == 4 &&
           width_of(box) >= 0.95 * width_of(c->bounds) &&
           height_of(box) >= 0.95 * height_of(c->bounds);
}

/// The lowest filled shapes, if all else lies on them. They are pages or grids, and no floors.
static void find_backdrop(chooser *c) {
    for (size_t i = 0; i < c->count; i++) {
        const sl_box box = box_of(c->map, &c->shapes[i]);
        c->bounds = i ? sli_box_with(sli_box_with(c->bounds, box.min), box.max) : box;
    }
    c->size = extent(c->bounds);
    while (c->backdrops < c->count && is_page(c, &c->shapes[c->backdrops])) c->backdrops++;
}

/// How long the lines of a shape are. `*twice` gets twice the area that they run around.
static double measure_around(const chooser *c, const sli_look_shape *shape, double *twice) {
    const sl_point from = c->map->walls[shape->first].a;
    double around = *twice = 0;
    for (size_t i = shape->first; i < shape->end; i++) {
        const sl_wall *wall = &c->map->walls[i];
        const sl_point a = {wall->a.x - from.x, wall->a.y - from.y};
        const sl_point b = {wall->b.x - from.x, wall->b.y - from.y};
        *twice += sli_cross(a, b);
        around += sli_length(b.x - a.x, b.y - a.y);
    }
    *twice = fabs(*twice);
    return around;
}

static void measure_shape(const chooser *c, const sli_look_shape *shape) {
    sli_look *look = &c->looks->items.items[shape->look];
    const sl_box box = box_of(c->map, shape);
    const bool large = extent(box) * LARGE > c->size;
    double twice;
    look->around += measure_around(c, shape, &twice);
    for (size_t i = shape->first; large && i < shape->end; i++) {
        const sl_wall *wall = &c->map->walls[i];
        const double length = sli_length(wall->b.x - wall->a.x, wall->b.y - wall->a.y);
        if (length * LONG < c->size) continue;
        if (look->length == 0) look->box = sli_box_around(wall->a, wall->a);
        look->box = sli_box_with(sli_box_with(look->box, wall->a), wall->b);
        look->length += length;
    }
    if (look->ink.line && shape->end - shape->first >= LEAST_WALLS &&
        fmin(width_of(box), height_of(box)) * ROOM > c->size) {
        look->rooms++;
        look->room_area +=
            width_of(box) * height_of(box) / (width_of(c->bounds) * height_of(c->bounds));
    }
    look->area += twice / 2;
    look->shapes++;
    look->walls += shape->end - shape->first;
}

/// What is filled, as thick as a bar would be.
static double thickness(const sli_look *look) {
    if (look->ink.line) return look->ink.width;
    return look->around > 0 ? 2 * look->area / look->around : 0;
}

static bool is_floor(const chooser *c, const sli_look *look) {
    return !look->ink.line && thickness(look) * FLOOR > c->size;
}

/// How far a look's colour is from grey.
static int chroma(const sli_look *look) {
    const int red = look->ink.colour >> 16 & 0xFF, green = look->ink.colour >> 8 & 0xFF;
    const int blue = look->ink.colour & 0xFF;
    const int most = red > green ? red : green, least = red < green ? red : green;
    return (most > blue ? most : blue) - (least < blue ? least : blue);
}

/// Whether a look has a colour that is far from grey.
static bool is_coloured(const sli_look *look) {
    return look->ink.known && chroma(look) > COLOURED;
}

static double contrast(const chooser *c, const sli_look *look) {
    return fabs(lightness(&look->ink) - c->ground);
}

static void find_ground(chooser *c) {
    c->ground = 1;
    for (size_t i = 0; i < c->backdrops; i++) {
        const sli_ink *ink = &c->looks->items.items[c->shapes[i].look].ink;
        if (ink->known || c->backdrops == 1) c->ground = lightness(ink);
    }
}

double sli_looks_ground(const sl_map *map, const sli_look_shape *shapes, size_t count,
                        sli_looks *looks) {
    chooser c = {.map = map, .shapes = shapes, .count = count, .looks = looks};
    find_backdrop(&c);
    find_ground(&c);
    // A pattern is that of squared paper: what covers it up is white.
    const bool squared = c.backdrops == 1 && !looks->items.items[shapes[0].look].ink.known;
    return squared ? 1 : c.ground;
}

bool sli_ink_is_ground(const sli_ink *ink, double ground) {
    return ink->known && fabs(lightness(ink) - ground) < 0.02;
}

static void weigh_all(chooser *c) {
    find_ground(c);
    for (size_t i = 0; i < c->looks->items.count; i++) {
        sli_look *look = &c->looks->items.items[i];
        const bool floor = is_floor(c, look);
        look->weight = floor ? 0 : contrast(c, look) * contrast(c, look) * thickness(look);
        *(floor ? &c->floors : &c->lines) += look->length;
    }
}

// --- the choice

static bool is_spread(const chooser *c, const sli_look *look) {
    return look->weight > 0 && width_of(look->box) >= 0.3 * width_of(c->bounds) &&
           height_of(look->box) >= 0.3 * height_of(c->bounds);
}

/// Whether a look fills areas in a light colour, as rooms of one kind are.
static bool is_tint(const chooser *c, const sli_look *look) {
    return !look->ink.line && is_coloured(look) && contrast(c, look) < TINT;
}

/// The heaviest look that is spread as walls are, of `tints` or of all else; NULL for none.
static const sli_look *heaviest(const chooser *c, bool tints) {
    const sli_look *best = NULL;
    const double all = fmax(c->lines, c->floors);
    for (size_t i = 0; i < c->looks->items.count; i++) {
        const sli_look *look = &c->looks->items.items[i];
        if (!is_spread(c, look) || look->walls < LEAST_WALLS || look->length < FAIR * all) continue;
        if (is_tint(c, look) == tints && (!best || look->weight > best->weight)) best = look;
    }
    return best;
}

/// Whether a look is coloured, and the heaviest is grey: lines, or what fills more than bars as
/// thick as walls, such as labels. Two tones of a faint colour are alike: pale blue walls, and
/// steel blue ones.
static bool is_beside_grey(const sli_look *look, const sli_look *best) {
    const bool bar = !look->ink.line && 2 * thickness(look) <= 3 * thickness(best);
    return !bar && is_coloured(look) && !is_coloured(best) && 2 * chroma(look) > 3 * chroma(best);
}

/// Whether a look is one of walls beside the heaviest. What is filled as darkly may be columns,
/// which have no long walls.
static bool is_alike(const chooser *c, const sli_look *look, const sli_look *best) {
    if (look == best || (best->ink.line && same_ink(&look->ink, &best->ink, PEN))) return true;
    if (is_beside_grey(look, best) || (is_tint(c, look) && !is_tint(c, best))) return false;
    if (look->weight < ALIKE * best->weight || contrast(c, look) < CONTRAST * contrast(c, best))
        return false;
    const bool column = !look->ink.line && CONTRAST * contrast(c, look) <= contrast(c, best);
    return column || look->length >= BESIDE * fmax(best->length, look->around);
}

/// Whether a filled shape is a word or a symbol: many short lines, and not round as a column is.
static bool is_word(const chooser *c, const sli_look_shape *shape) {
    if (shape->end - shape->first <= 8 || c->looks->items.items[shape->look].ink.line ||
        extent(box_of(c->map, shape)) * WORD > c->size)
        return false;
    for (size_t i = shape->first; i < shape->end; i++) {
        const sl_wall *wall = &c->map->walls[i];
        if (sli_length(wall->b.x - wall->a.x, wall->b.y - wall->a.y) * LONG > c->size) return false;
    }
    double twice;
    const double around = measure_around(c, shape, &twice);
    return 7 * twice < around * around; // of a circle it is 6.3 to 6.4
}

/// Whether a shape is one closed line about a floor, not about the body of a wall.
static bool is_outline(const chooser *c, const sli_look_shape *shape) {
    const sl_wall *walls = c->map->walls;
    if (!c->looks->items.items[shape->look].ink.line) return false;
    for (size_t i = shape->first; i < shape->end; i++) {
        const sl_point next = walls[i + 1 < shape->end ? i + 1 : shape->first].a;
        if (walls[i].b.x != next.x || walls[i].b.y != next.y) return false;
    }
    double twice;
    const double around = measure_around(c, shape, &twice);
    return twice * FLOOR > c->size * around;
}

static bool is_taken(const chooser *c, size_t shape) {
    return c->looks->items.items[c->shapes[shape].look].taken;
}

/// The direction of the longest wall of the looks that are taken: plans may be drawn turned.
static sl_point direction_of_taken(const chooser *c) {
    sl_point along = {1, 0};
    double longest = 0;
    for (size_t i = c->backdrops; i < c->count; i++)
        for (size_t k = c->shapes[i].first; is_taken(c, i) && k < c->shapes[i].end; k++) {
            const sl_wall *wall = &c->map->walls[k];
            const sl_point by = {wall->b.x - wall->a.x, wall->b.y - wall->a.y};
            const double length = sli_length(by.x, by.y);
            if (!(length > longest)) continue;
            longest = length;
            along = (sl_point){by.x / length, by.y / length};
        }
    return along;
}

/// Along a direction, and to its left.
static sl_point in_line(sl_point p, sl_point along) {
    return (sl_point){p.x * along.x + p.y * along.y, p.y * along.x - p.x * along.y};
}

/// Whether each wall of a shape runs along a side of a box in line with a direction.
static bool is_on_ring(const chooser *c, const sli_look_shape *shape, sl_point along, sl_box ring) {
    const double off = c->size / LARGE;
    for (size_t i = shape->first; i < shape->end; i++) {
        const sl_point a = in_line(c->map->walls[i].a, along);
        const sl_point b = in_line(c->map->walls[i].b, along);
        if (fmax(fabs(a.x - ring.min.x), fabs(b.x - ring.min.x)) > off &&
            fmax(fabs(a.x - ring.max.x), fabs(b.x - ring.max.x)) > off &&
            fmax(fabs(a.y - ring.min.y), fabs(b.y - ring.min.y)) > off &&
            fmax(fabs(a.y - ring.max.y), fabs(b.y - ring.max.y)) > off)
            return false;
    }
    return true;
}

/// Whether the looks that are taken are a ring with gaps, as of windows and doors, and a look draws
/// lines across what is in it: inner walls. Furniture is smaller, or closed, and windows are on the
/// ring.
static bool is_ring_alone(const chooser *c, const sli_look *next) {
    const sl_point along = direction_of_taken(c);
    double outer = 0, across = 0;
    sl_box ring = {{INFINITY, INFINITY}, {-INFINITY, -INFINITY}};
    for (size_t i = c->backdrops; i < c->count; i++)
        for (size_t k = c->shapes[i].first; is_taken(c, i) && k < c->shapes[i].end; k++) {
            ring = sli_box_with(ring, in_line(c->map->walls[k].a, along));
            ring = sli_box_with(ring, in_line(c->map->walls[k].b, along));
        }
    for (size_t i = c->backdrops; next && i < c->count; i++) {
        const sli_look_shape *shape = &c->shapes[i];
        const sl_point from = c->map->walls[shape->first].a, to = c->map->walls[shape->end - 1].b;
        const double straight = sli_length(to.x - from.x, to.y - from.y);
        double twice;
        if (&c->looks->items.items[shape->look] == next && straight * CROSSING >= c->size &&
            !is_on_ring(c, shape, along, ring))
            across += straight;
        if (!is_taken(c, i)) continue;
        if (!is_on_ring(c, shape, along, ring)) return false;
        outer += measure_around(c, shape, &twice);
    }
    return outer >= width_of(ring) + height_of(ring) && 2 * across >= c->size;
}

/// Whether the looks that are taken have outlines of most of the drawing, and little in them.
static bool is_outline_alone(const chooser *c) {
    double outlines = 0, inner = 0;
    for (size_t i = c->backdrops; i < c->count; i++) {
        const sli_look_shape *shape = &c->shapes[i];
        const sl_box box = box_of(c->map, shape);
        double twice;
        if (!c->looks->items.items[shape->look].taken || extent(box) * LARGE <= c->size) continue;
        const bool outline = is_outline(c, shape) && 2 * width_of(box) > width_of(c->bounds) &&
                             2 * height_of(box) > height_of(c->bounds);
        *(outline ? &outlines : &inner) += measure_around(c, shape, &twice);
    }
    return inner < INNER * outlines;
}

/// The look most like walls that is not taken yet, and spread as they are; NULL for none.
static const sli_look *next_like_walls(const chooser *c) {
    const sli_look *best = NULL;
    for (size_t i = 0; i < c->looks->items.count; i++) {
        const sli_look *look = &c->looks->items.items[i];
        if (look->taken || !is_spread(c, look)) continue;
        if (!best || sli_look_likeness(look) > sli_look_likeness(best)) best = look;
    }
    return best;
}

/// Takes a look and all that are like it; NULL for none.
static void take_alike(chooser *c, const sli_look *best) {
    for (size_t i = 0; best && i < c->looks->items.count; i++)
        c->looks->items.items[i].taken |= is_alike(c, &c->looks->items.items[i], best);
}

/// Whether one shape stands beside another that is filled alike, and is not much larger.
static bool stands_by(const chooser *c, const sli_look_shape *shape, const sli_look_shape *other) {
    const sl_box a = box_of(c->map, shape), b = box_of(c->map, other);
    const double gap = fmax(fmax(a.min.x - b.max.x, b.min.x - a.max.x),
                            fmax(a.min.y - b.max.y, b.min.y - a.max.y));
    return shape->look == other->look && gap <= NEXT_LETTER * extent(b) &&
           extent(a) <= LARGEST_LETTER * extent(b);
}

/// Whether a small filled shape is lettering: letters follow each other in the file,
/// side by side, and one of them is more than a bar. `behind`: the shape before it is lettering.
static bool is_letter(const chooser *c, size_t at, bool behind) {
    const sli_look_shape *shapes = c->shapes;
    for (size_t i = at; i < at + LETTERS && i < c->count; i++) {
        if (is_word(c, &shapes[i])) return true;
        if (c->looks->items.items[shapes[i].look].ink.line) return false;
        if (extent(box_of(c->map, &shapes[i])) * LARGE > c->size) return false;
        if (i == at && behind && stands_by(c, &shapes[i], &shapes[i - 1])) return true;
        if (i + 1 == c->count || !stands_by(c, &shapes[i], &shapes[i + 1])) return false;
    }
    return false;
}

/// Takes shapes of the looks that are taken, but for lettering, and counts them.
static size_t take_shapes(chooser *c, sl_bits *taken) {
    size_t walls = 0;
    bool lettering = false;
    for (size_t i = c->backdrops; i < c->count; i++) {
        const sli_look_shape *shape = &c->shapes[i];
        if (!c->looks->items.items[shape->look].taken) continue;
        lettering = is_letter(c, i, lettering && i > c->backdrops);
        if (lettering) continue;
        sl_bits_add(taken, i);
        walls += shape->end - shape->first;
    }
    return walls;
}

/// The share of the looks that are taken in all long lines. Floors that are not taken have the
/// lines between them twice. Coloured lines beside grey ones are no doubt, and have no length then.
static double share_of(const chooser *c, const sli_look *best) {
    double taken = 0, rest = 0;
    for (size_t i = 0; i < c->looks->items.count; i++) {
        sli_look *look = &c->looks->items.items[i];
        if (best && look->ink.line && !look->taken && is_beside_grey(look, best)) look->length = 0;
        if (look->taken)
            taken += look->length;
        else
            rest += is_floor(c, look) ? look->length / 2 : look->length;
    }
    return taken > 0 ? taken / (taken + rest) : 1;
}

double sli_looks_choose(const sl_map *map, const sli_look_shape *shapes, size_t count,
                        sli_looks *looks, sl_bits *taken, bool *chosen) {
    chooser c = {.map = map, .shapes = shapes, .count = count, .looks = looks};
    size_t all = 0;
    for (size_t i = 0; i < looks->items.count; i++) {
        sli_look *look = &looks->items.items[i];
        *look = (sli_look){.ink = look->ink};
        write_name(look);
    }
    find_backdrop(&c);
    for (size_t i = 0; i < count; i++) {
        all += shapes[i].end - shapes[i].first;
        if (i >= c.backdrops) measure_shape(&c, &shapes[i]);
    }
    weigh_all(&c);
    const sli_look *best = count >= LEAST_SHAPES ? heaviest(&c, false) : NULL;
    if (count >= LEAST_SHAPES && !best) best = heaviest(&c, true);
    const bool rooms = count >= LEAST_SHAPES && !best && c.floors > c.lines;
    take_alike(&c, best);
    const sli_look *next = best ? next_like_walls(&c) : NULL;
    if (best && (is_outline_alone(&c) || is_ring_alone(&c, next))) take_alike(&c, next);
    for (size_t i = 0; rooms && i < looks->items.count; i++)
        looks->items.items[i].taken = is_floor(&c, &looks->items.items[i]);
    const size_t walls = take_shapes(&c, taken);
    *chosen = walls >= LEAST_WALLS && walls < all;
    return share_of(&c, best);
}

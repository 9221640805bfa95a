#include "cell_to_cell/explain_line.h"

#include "geometry/orient.h"
#include "space/ray.h"

/// Significant digits, of the size of the map, that are tried for a line's coordinates.
#define MOST_DIGITS 15

static bool is_strict(const sl_space *space, const sl_sequence *sequence, sl_line line) {
    for (uint32_t i = 0; i < sequence->directed_count; i++) {
        const sl_directed_portal *directed = &space->directed[sequence->directed[i]];
        if (sl_orient(line.a, line.b, directed->left) <= 0 ||
            sl_orient(line.a, line.b, directed->right) >= 0)
            return false;
    }
    return true;
}

double sl_share_of_portal(const sl_directed_portal *directed, sl_line line) {
    const double x = line.b.x - line.a.x, y = line.b.y - line.a.y;
    const double left = x * (directed->left.y - line.a.y) - y * (directed->left.x - line.a.x);
    const double right = x * (directed->right.y - line.a.y) - y * (directed->right.x - line.a.x);
    return left > right ? fmin(fmax(left / (left - right), 0), 1) : 0;
}

/// Whether a line keeps half of what distance another one keeps from the portals' ends.
static bool is_near(const sl_space *space, const sl_sequence *sequence, sl_line line,
                    sl_line other) {
    for (uint32_t i = 0; i < sequence->directed_count; i++) {
        const sl_directed_portal *directed = &space->directed[sequence->directed[i]];
        const double share = sl_share_of_portal(directed, line),
                     wanted = sl_share_of_portal(directed, other);
        if (share < wanted / 2 || 1 - share < (1 - wanted) / 2) return false;
    }
    return true;
}

static sl_point rounded(sl_point p, double decimals) {
    return (sl_point){round(p.x * decimals) / decimals, round(p.y * decimals) / decimals};
}

bool sl_simplify_line(const sl_space *space, const sl_sequence *sequence, sl_line *line) {
    const sl_box b = space->bounds;
    const double size =
        fmax(fmax(fabs(b.min.x), fabs(b.max.x)), fmax(fabs(b.min.y), fabs(b.max.y)));
    const double first = size > 0 ? 1 - ceil(log10(size)) : 0;
    const bool strict = is_strict(space, sequence, *line);
    for (int digits = 0; digits < MOST_DIGITS; digits++) {
        const double decimals = pow(10, first + digits);
        const sl_line simple = {rounded(line->a, decimals), rounded(line->b, decimals)};
        if (!is_strict(space, sequence, simple)) continue;
        if (strict && !is_near(space, sequence, simple, *line)) continue;
        *line = simple;
        return true;
    }
    return strict;
}

/// Where the line crosses a portal; an end of it where it lies along.
static sl_point crossing_point(const sl_directed_portal *directed, sl_line line) {
    const double share = sl_share_of_portal(directed, line);
    return (sl_point){directed->left.x + share * (directed->right.x - directed->left.x),
                      directed->left.y + share * (directed->right.y - directed->left.y)};
}

sl_point sl_halfway_into(const sl_space *space, uint32_t cell, sl_point at, sl_point direction) {
    const double half = sl_ray_length(space, cell, at, direction) / 2;
    return (sl_point){at.x + half * direction.x, at.y + half * direction.y};
}

sl_segment sl_shown_segment(const sl_space *space, const sl_sequence *sequence, uint32_t from,
                            sl_line line) {
    const sl_directed_portal *first = &space->directed[sequence->directed[0]];
    const sl_directed_portal *last =
        &space->directed[sequence->directed[sequence->directed_count - 1]];
    const double x = line.b.x - line.a.x, y = line.b.y - line.a.y, length = hypot(x, y);
    const sl_point forward = {x / length, y / length}, back = {-x / length, -y / length};
    return (sl_segment){sl_halfway_into(space, from, crossing_point(first, line), back),
                        sl_halfway_into(space, last->cell, crossing_point(last, line), forward)};
}

/// The choice of a split: the wall whose line costs least, of some that are tried.
#include "space/bsp.h"

/// Walls that a line is weighed against, at most.
enum { MOST_WEIGHED = 512 };

typedef struct split {
    size_t left, right, cut;
    double low, high; ///< of the line within the face, along it
    double covered;   ///< of that, by walls, at most
} split;

static double key_of(const sl_wall *line, sl_point p) {
    const double dx = line->b.x - line->a.x, dy = line->b.y - line->a.y;
    return fabs(dx) >= fabs(dy) ? (dx > 0 ? p.x : -p.x) : (dy > 0 ? p.y : -p.y);
}

/// How far the line goes within the face. Rounded: it weighs, and decides nothing.
static void clip(const sl_bsp_face *face, const sl_wall *line, split *s) {
    const double dx = line->b.x - line->a.x, dy = line->b.y - line->a.y;
    s->low = INFINITY;
    s->high = -INFINITY;
    for (size_t i = 0; i < face->sides.count; i++) {
        const sl_point p = face->sides.items[i].from, q = sl_side_end(&face->sides, i);
        const double from = dx * (p.y - line->a.y) - dy * (p.x - line->a.x);
        const double to = dx * (q.y - line->a.y) - dy * (q.x - line->a.x);
        if ((from > 0) == (to > 0)) continue;
        const double t = from / (from - to);
        const double key = key_of(line, (sl_point){p.x + t * (q.x - p.x), p.y + t * (q.y - p.y)});
        s->low = fmin(s->low, key);
        s->high = fmax(s->high, key);
    }
}

static void weigh_wall(const sl_wall *line, const sl_wall *wall, split *s) {
    const int a = sl_orient(line->a, line->b, wall->a), b = sl_orient(line->a, line->b, wall->b);
    if (a == 0 && b == 0) {
        const double from = key_of(line, wall->a), to = key_of(line, wall->b);
        s->covered += fmax(0, fmin(s->high, fmax(from, to)) - fmax(s->low, fmin(from, to)));
    }
    s->cut += a * b < 0;
    s->left += a * b >= 0 && a + b > 0;
    s->right += a * b >= 0 && a + b < 0;
}

static double cost(const sl_bsp *bsp, const sl_bsp_face *face, const sl_wall *line) {
    const size_t step = (face->walls.count + MOST_WEIGHED - 1) / MOST_WEIGHED;
    split s = {0};
    size_t weighed = 0;
    clip(face, line, &s);
    for (size_t i = 0; i < face->walls.count; i += step, weighed++)
        weigh_wall(line, &bsp->walls[face->walls.items[i]], &s);
    const double all = (double)weighed;
    const double unequal = fabs((double)s.left - (double)s.right) / all;
    const double obscured = s.high > s.low ? fmin(1, s.covered / (s.high - s.low)) : 1;
    const sl_bsp_options *o = bsp->options;
    return o->cuts * (double)s.cut / all + o->imbalance * unequal - o->obscured * obscured;
}

size_t sl_bsp_choose(const sl_bsp *bsp, const sl_bsp_face *face) {
    const size_t count = face->walls.count - face->set_aside, tried = bsp->options->candidates;
    size_t best = 0;
    double least = INFINITY;
    for (size_t i = 0; i < (count < tried ? count : tried); i++) {
        const size_t k = count <= tried ? i : (size_t)((double)i * (double)count / (double)tried);
        const double c = cost(bsp, face, &bsp->walls[face->walls.items[k]]);
        if (c >= least) continue;
        least = c;
        best = k;
    }
    return best;
}

/// The choice of occluders: those that take up the largest angles about the eye, as far as those
/// chosen before leave anything of them to see. Angles are estimates: they decide of nothing but
/// the order in which walls are tried.
#include "walk/occlusion.h"

#include <math.h>

typedef struct candidate {
    double size; ///< grows with the angle
    uint32_t wall;
} candidate;

struct sl_chooser {
    const sl_segment *walls;
    candidate *heap;
    uint32_t count;
    double scale; ///< brings coordinates near 1, so that no product overflows
};

sl_status sl_chooser_create(sl_context *context, const sl_segment *walls, uint32_t count,
                            sl_box bounds, sl_chooser **out) {
    sl_chooser *c = sl_alloc_array(context, 1, sizeof *c);
    candidate *heap = sl_alloc_array(context, count, sizeof *heap);
    if (!c || !heap) {
        sl_free(context, c);
        sl_free(context, heap);
        return SL_NO_MEMORY;
    }
    const double size = fmax(bounds.max.x - bounds.min.x, bounds.max.y - bounds.min.y);
    *c = (sl_chooser){walls, heap, count, 1 / size};
    *out = c;
    return SL_OK;
}

void sl_chooser_destroy(sl_context *context, sl_chooser *chooser) {
    if (chooser) sl_free(context, chooser->heap);
    sl_free(context, chooser);
}

static double cross(sl_point a, sl_point b) {
    return a.x * b.y - a.y * b.x;
}

/// How large a wall is that reaches from p to q as seen from the eye: minus the signed square of
/// the angle's cosine; -2 for one that is not in the cone, or edge-on.
static double angle_size(sl_point p, sl_point q, const sl_walk_cone *cone, sl_point right,
                         sl_point left) {
    if (cross(p, q) < 0) {
        const sl_point turned = p;
        p = q;
        q = turned;
    }
    if (cone->kind == SL_CONE_WEDGE) {
        if (cross(right, p) < 0) p = right;
        if (cross(q, left) < 0) q = left;
    }
    const double turn = cross(p, q);
    if (!(turn > 0)) return -2;
    const double dot = p.x * q.x + p.y * q.y;
    const double size = -(dot * fabs(dot)) / ((p.x * p.x + p.y * p.y) * (q.x * q.x + q.y * q.y));
    return size >= -1 ? size : -1;
}

static void sift_down(candidate *heap, uint32_t count, uint32_t i) {
    const candidate sinking = heap[i];
    for (uint32_t child; (child = 2 * i + 1) < count; i = child) {
        if (child + 1 < count && heap[child + 1].size > heap[child].size) child++;
        if (heap[child].size <= sinking.size) break;
        heap[i] = heap[child];
    }
    heap[i] = sinking;
}

static sl_point toward(const sl_chooser *c, sl_point eye, sl_point at) {
    return (sl_point){(at.x - eye.x) * c->scale, (at.y - eye.y) * c->scale};
}

/// Fills the heap; returns how many walls are in it.
static uint32_t gather(sl_chooser *c, const sl_view *view, const sl_walk_cone *cone) {
    const sl_point right = toward(c, view->eye, view->right),
                   left = toward(c, view->eye, view->left);
    uint32_t count = 0;
    for (uint32_t i = 0; i < c->count; i++) {
        const sl_point p = toward(c, view->eye, c->walls[i].a);
        const sl_point q = toward(c, view->eye, c->walls[i].b);
        const double size = angle_size(p, q, cone, right, left);
        if (size >= -1) c->heap[count++] = (candidate){size, i};
    }
    for (uint32_t i = count / 2; i-- > 0;) sift_down(c->heap, count, i);
    return count;
}

/// Tries a wall: it is chosen where it hides anything within the cone that was free.
static sl_status try_wall(sl_context *context, const sl_segment *wall, const sl_walk_cone *cone,
                          const sl_node_test_calls *test, sl_occlusion *occlusion) {
    sl_shadows *s = &occlusion->shadows;
    const int side = sl_orient(wall->a, wall->b, s->pivot.eye);
    if (!side) return SL_OK;
    const sl_occluder o =
        side > 0 ? (sl_occluder){wall->a, wall->b} : (sl_occluder){wall->b, wall->a};
    SL_TRY(SL_ARRAY_ROOM(context, &s->occluders, 1));
    const uint32_t number = (uint32_t)s->occluders.count++;
    s->occluders.items[number] = o;
    const sl_sector whole = {sl_ray_to(o.a), sl_ray_to(o.b)};
    sl_sector parts[2];
    bool cut = false, added = false;
    const unsigned count = sl_sector_in_cone(&s->pivot, cone, &whole, parts, &cut);
    for (unsigned i = 0; i < count; i++)
        SL_TRY(test->add(context, occlusion, number, &parts[i], &added));
    if (!added) s->occluders.count--;
    return SL_OK;
}

sl_status sl_chooser_choose(sl_context *context, sl_chooser *c, const sl_view *view,
                            const sl_walk_cone *cone, uint32_t most, const sl_node_test_calls *test,
                            sl_occlusion *occlusion) {
    if (!most) return SL_OK;
    const sl_shadows *s = &occlusion->shadows;
    for (uint32_t left = gather(c, view, cone); left && s->occluders.count < most;) {
        SL_TRY(try_wall(context, &c->walls[c->heap[0].wall], cone, test, occlusion));
        c->heap[0] = c->heap[--left];
        sift_down(c->heap, left, 0);
    }
    return SL_OK;
}

/// The search for a shortest way through convex cells (Cui, Harabor and Grastien 2017,
/// Compromise-free Pathfinding on a Navigation Mesh: Polyanya).
///
/// A node is a root, the last corner of a way, and the directions from it that go on straight into
/// a cell. Each portal of the cell gets the directions that pass it. Where the directions end at a
/// corner, the way may turn there, and that corner becomes the root:
///
///              left limit    .
///               /        .'      the portal Q is seen whole, the portal S in part
///          [   Q   ].-'---[  S  ]
///             /  .-'           right limit, at the corner R of a wall: beyond it one turns right
///            /.-'              around R, and the ray from the root through R limits that at its
///          root                left
///
/// Limits are rays through corners, so all that is decided about them is exact. An A* search takes
/// the node with the least bound first: the way to the root, and on to the goal by way of the piece
/// of the portal that the directions pass (by the goal's mirror image where it lies before the
/// portal). The bound is rounded down, so that the first way to arrive is the shortest.
///
/// A corner is turned at by the shortest way to it only. Of ways of the same length (SAME), those
/// count from which most can be turned to: so a corner is left by a few nodes, and the cost does
/// not grow with the number of ways of the same length.
///
/// For the distances of all cells from a point (sli_route_spread) there is no goal: the bound of a
/// node is how far the piece of its portal is, so the first node that enters a cell has the cell's
/// distance. A cell is convex, so all of it is known to be within a distance then, by way of that
/// node's nearest point. Nodes that come from farther away bring nothing.
#include "analysis/route/route.h"

#include "geometry/length.h"
#include "geometry/orient.h"

/// Lengths count as the same up to this share.
static const double SAME = 0x1p-42;

typedef struct search {
    sl_context *context;
    sl_route_finder *finder;
    const sl_space *space;
    sl_point from, goal;
    const sl_route_near *cells; ///< by cell: what is known of it; NULL: one goal is searched
    double limit;               ///< nodes with a higher bound are left out
    sli_route_take take;        ///< NULL: nobody asks for the nodes
    void *user;
    double scale; ///< a power of two that brings the bounds to about 1: products neither overflow
                  ///< nor underflow
} search;

static double distance(sl_point a, sl_point b) {
    return sli_length(b.x - a.x, b.y - a.y);
}

/// The side of a limit that a point lies on: 1 left, -1 right, 0 on it.
static int limit_side(const sli_route_node *n, int side, sl_point p) {
    const sli_route_limit *limit = &n->limit[side];
    return limit->kind == SLI_LIMIT_RAY ? sli_orient(n->root, limit->point, p)
                                        : sli_orient(limit->point, n->root, p);
}

bool sli_route_is_beyond(const sli_route_node *n, int side, sl_point p) {
    return n->limit[side].kind != SLI_LIMIT_NONE &&
           limit_side(n, side, p) == (side == SLI_ROUTE_LEFT ? 1 : -1);
}

// --- the bound

static sl_point offset(const search *s, sl_point from, sl_point to) {
    return (sl_point){(to.x - from.x) * s->scale, (to.y - from.y) * s->scale};
}

static double size_of(sl_point p) {
    return fabs(p.x) + fabs(p.y);
}

/// The end of what a node's directions pass of its portal, at one side, as seen from its root:
/// between r and l, the ends of the portal. Where it is rounded, it lies rather too far out than
/// too far in.
static sl_point passed_end(const search *s, const sli_route_node *n, int side, sl_point r,
                           sl_point l) {
    const sl_directed_portal *d = &s->space->directed[n->entry];
    const sli_route_limit *limit = &n->limit[side];
    const sl_point whole = side == SLI_ROUTE_LEFT ? l : r;
    if (limit->kind == SLI_LIMIT_NONE ||
        !sli_route_is_beyond(n, side, side == SLI_ROUTE_LEFT ? d->left : d->right))
        return whole;
    const sl_point ray = limit->kind == SLI_LIMIT_RAY ? offset(s, n->root, limit->point)
                                                      : offset(s, limit->point, n->root);
    const double at_right = -sli_cross(ray, r), sum = at_right + sli_cross(ray, l);
    const double slack = 0x1p-48 * size_of(ray) * (size_of(r) + size_of(l)) / sum;
    const double share = at_right / sum + (side == SLI_ROUTE_LEFT ? slack : -slack);
    if (!(share > 0 && share < 1)) return whole;
    return (sl_point){r.x + share * (l.x - r.x), r.y + share * (l.y - r.y)};
}

/// How far it is at least from a node's root to the goal, through its portal.
static double bound(const search *s, const sli_route_node *n) {
    const sl_directed_portal *d = &s->space->directed[n->entry];
    const sl_point start = offset(s, n->root, d->right), end = offset(s, n->root, d->left),
                   along = offset(s, d->right, d->left), past = offset(s, d->right, s->goal);
    const sl_point r = passed_end(s, n, SLI_ROUTE_RIGHT, start, end),
                   l = passed_end(s, n, SLI_ROUTE_LEFT, start, end);
    sl_point t = offset(s, n->root, s->goal);
    const double reach = size_of(t) + size_of(start) + size_of(along);
    const double over = sli_cross(along, past);
    if (over > 0) { // the goal lies before the portal: its image behind it
        const double twice = 2 * (over / sli_dot(along, along));
        t.x += twice * along.y;
        t.y -= twice * along.x;
    }
    double h;
    if (sli_cross(r, t) < 0)
        h = sli_length(r.x, r.y) + sli_length(t.x - r.x, t.y - r.y);
    else if (sli_cross(l, t) > 0)
        h = sli_length(l.x, l.y) + sli_length(t.x - l.x, t.y - l.y);
    else
        h = sli_length(t.x, t.y);
    return fmax(distance(n->root, s->goal), (h - 0x1p-46 * reach) / s->scale);
}

/// The nearest point to a node's root on the piece of its portal, from the root, scaled.
static sl_point nearest_passed(const search *s, const sli_route_node *n) {
    const sl_directed_portal *d = &s->space->directed[n->entry];
    const sl_point start = offset(s, n->root, d->right), end = offset(s, n->root, d->left);
    return sli_route_nearest_on(passed_end(s, n, SLI_ROUTE_RIGHT, start, end),
                                passed_end(s, n, SLI_ROUTE_LEFT, start, end), (sl_point){0, 0});
}

// --- the open nodes: a heap

static bool before(const sli_route_open *a, const sli_route_open *b) {
    return a->f != b->f ? a->f < b->f : a->node < b->node;
}

/// Adds a node that is not open.
static sl_status keep(search *s, const sli_route_node *node) {
    sl_route_finder *finder = s->finder;
    SL_TRY(SL_ARRAY_ROOM(s->context, &finder->nodes, 1));
    if (finder->nodes.count >= SLI_ROUTE_NONE)
        return sl_fail(s->context, SL_NO_MEMORY, "too many search nodes");
    finder->nodes.items[finder->nodes.count++] = *node;
    return SL_OK;
}

static sl_status push(search *s, const sli_route_node *node, double f) {
    sl_route_finder *finder = s->finder;
    SL_TRY(keep(s, node));
    SL_TRY(SL_ARRAY_ROOM(s->context, &finder->open, 1));
    const sli_route_open item = {f * (1 - 0x1p-50), (uint32_t)finder->nodes.count - 1};
    sli_route_open *heap = finder->open.items;
    size_t i = finder->open.count++;
    for (; i && before(&item, &heap[(i - 1) / 2]); i = (i - 1) / 2) heap[i] = heap[(i - 1) / 2];
    heap[i] = item;
    return SL_OK;
}

static uint32_t pop(sl_route_finder *finder) {
    sli_route_open *heap = finder->open.items;
    const uint32_t least = heap[0].node;
    const sli_route_open last = heap[--finder->open.count];
    size_t i = 0;
    for (size_t child; (child = 2 * i + 1) < finder->open.count; i = child) {
        if (child + 1 < finder->open.count && before(&heap[child + 1], &heap[child])) child++;
        if (!before(&heap[child], &last)) break;
        heap[i] = heap[child];
    }
    heap[i] = last;
    return least;
}

// --- corners

/// Whether `other` reaches directions beyond those from `known`, turning to one side at `at`.
static bool turns_more(sl_point known, sl_point other, sl_point at, int side) {
    const int turn = sli_turn(known, at, other, at);
    return side == SLI_ROUTE_RIGHT ? turn > 0 : turn < 0;
}

/// Whether a way of length g that comes from `from` is worth turning at a corner; keeps it then.
static bool enter_corner(search *s, uint32_t entry, int side, sl_point from, sl_point at,
                         double g) {
    const size_t end = 2 * (size_t)entry + (size_t)side;
    const uint32_t number = s->finder->corner_of[end], stamp = s->finder->stamp;
    if (number == SLI_ROUTE_NONE) return false;
    sli_route_corner *corner = &s->finder->corners[number];
    if (corner->stamp != stamp || g < corner->g * (1 - SAME))
        *corner = (sli_route_corner){.stamp = stamp, .g = g};
    if (g > corner->g * (1 + SAME)) return false;
    if (corner->has[side] && !sli_same_point(corner->before[side], from) &&
        !turns_more(corner->before[side], from, at, side))
        return false;
    corner->has[side] = true;
    corner->before[side] = from;
    sli_route_turn *turn = &s->finder->turns[end];
    if (turn->stamp == stamp && sli_same_point(turn->before, from) && turn->g <= g) return false;
    *turn = (sli_route_turn){stamp, g, from};
    return true;
}

/// Makes the root of a node the corner at one end of a directed portal.
static bool turn_at(search *s, sli_route_node *n, uint32_t entry, int side) {
    const sl_directed_portal *d = &s->space->directed[entry];
    const sl_point at = side == SLI_ROUTE_LEFT ? d->left : d->right;
    const double g = n->g + distance(n->root, at);
    if (!enter_corner(s, entry, side, n->root, at, g)) return false;
    n->limit[side] = (sli_route_limit){SLI_LIMIT_NONE, at};
    n->limit[!side] = (sli_route_limit){SLI_LIMIT_ON, n->root};
    n->root = at;
    n->g = g;
    return true;
}

// --- the portals of a cell

static sl_status push_across(search *s, sli_route_node *node, uint32_t across) {
    node->entry = across;
    node->cell = s->space->directed[across].cell;
    if (!s->cells) return push(s, node, node->g + bound(s, node));
    const sl_point at = nearest_passed(s, node);
    const double f = node->g + sli_length(at.x, at.y) / s->scale;
    return f * (1 - SAME) > fmin(s->limit, s->finder->upper[node->cell]) ? SL_OK : push(s, node, f);
}

/// A portal that is seen edge-on: straight to its nearer end, and around that. A root on the portal
/// is the start, which stands in the cell behind it, too; where there is a loss, it does not.
static sl_status cross_edge_on(search *s, const sli_route_node *from, uint32_t across) {
    const sl_directed_portal *d = &s->space->directed[across];
    const double loss = sli_route_loss(s->finder, d->portal);
    sli_route_node node = *from;
    int side;
    node.g += loss;
    if (sli_goes_on(node.root, d->right, d->left))
        side = SLI_ROUTE_RIGHT;
    else if (sli_goes_on(node.root, d->left, d->right))
        side = SLI_ROUTE_LEFT;
    else
        return loss > 0 ? push_across(s, &node, across) : SL_OK;
    const sl_point end = side == SLI_ROUTE_LEFT ? d->left : d->right;
    if (sli_route_is_beyond(&node, SLI_ROUTE_RIGHT, end) ||
        sli_route_is_beyond(&node, SLI_ROUTE_LEFT, end))
        return SL_OK;
    return turn_at(s, &node, across, side) ? push_across(s, &node, across) : SL_OK;
}

/// Whether a root is the start, and the start stands in a cell: turning around it leads nowhere.
static bool stands_there(const search *s, sl_point root, uint32_t cell) {
    return sli_same_point(root, s->from) && s->finder->at_start[cell] == s->finder->stamp;
}

/// Whether a portal around the root ends just where the way came from. Nobody needs to pass it: the
/// way came along its other side.
static bool turns_back(const sli_route_node *n, int side, sl_point end) {
    return n->limit[side].kind == SLI_LIMIT_ON && limit_side(n, side, end) == 0 &&
           !sli_goes_on(n->limit[side].point, n->root, end);
}

/// Takes a node through a portal of its cell.
static sl_status cross(search *s, const sli_route_node *from, uint32_t across) {
    const sl_directed_portal *d = &s->space->directed[across];
    const sl_point ends[2] = {d->right, d->left};
    const double loss = sli_route_loss(s->finder, d->portal);
    sli_route_node node = *from;
    node.g += loss;
    for (int side = 0; side < 2; side++)
        if (sli_same_point(node.root, ends[side])) { // around the root
            if (sli_route_is_beyond(from, !side, ends[!side]) ||
                turns_back(from, !side, ends[!side]) || stands_there(s, node.root, d->cell))
                return SL_OK;
            node.limit[side].kind = SLI_LIMIT_NONE;
            return push_across(s, &node, across);
        }
    const int facing = sli_orient(node.root, d->right, d->left);
    if (facing < 0) return SL_OK;
    if (!facing) return cross_edge_on(s, from, across);
    for (int side = 0; side < 2; side++) {
        const int out = side == SLI_ROUTE_LEFT ? 1 : -1;
        if (from->limit[side].kind != SLI_LIMIT_NONE) {
            const int near = limit_side(from, side, ends[side]) * out,
                      far = limit_side(from, side, ends[!side]) * out;
            if (near >= 0 && far >= 0) return SL_OK;
            if (near > 0) continue;
        }
        node.limit[side] = (sli_route_limit){SLI_LIMIT_RAY, ends[side]};
    }
    return push_across(s, &node, across);
}

/// Straight on from a node's root: to the goal if it is in the cell, and through the portals.
static sl_status go_on(search *s, const sli_route_node *node) {
    if (s->take) SL_TRY(s->take(s->context, node, s->user));
    const sl_cell *cell = &s->space->cells[node->cell];
    const uint32_t back =
        node->entry == SLI_ROUTE_NONE ? SLI_ROUTE_NONE : s->space->directed[node->entry].portal;
    if (s->finder->at_goal[node->cell] == s->finder->stamp &&
        !sli_route_is_beyond(node, SLI_ROUTE_RIGHT, s->goal) &&
        !sli_route_is_beyond(node, SLI_ROUTE_LEFT, s->goal)) {
        sli_route_node last = *node;
        last.is_last = true;
        SL_TRY(push(s, &last, node->g + distance(node->root, s->goal)));
    }
    for (uint32_t k = 0; k < cell->directed_count; k++) {
        const uint32_t across = cell->first_directed + k;
        if (s->space->directed[across].portal != back) SL_TRY(cross(s, node, across));
    }
    return SL_OK;
}

static sl_status expand(search *s, uint32_t number) {
    sli_route_node node = s->finder->nodes.items[number];
    node.parent = number;
    SL_TRY(go_on(s, &node));
    if (node.entry == SLI_ROUTE_NONE) return SL_OK;
    const sl_directed_portal *d = &s->space->directed[node.entry];
    for (int side = 0; side < 2; side++) {
        const sl_point end = side == SLI_ROUTE_LEFT ? d->left : d->right;
        sli_route_node turned = node;
        if (node.limit[side].kind != SLI_LIMIT_RAY ||
            !sli_same_point(node.limit[side].point, end) || !turn_at(s, &turned, node.entry, side))
            continue;
        SL_TRY(keep(s, &turned));
        turned.parent = (uint32_t)s->finder->nodes.count - 1;
        SL_TRY(go_on(s, &turned));
    }
    return SL_OK;
}

/// Opens the cells that a point stands in.
static sl_status start_at(search *s, sl_point from) {
    sl_route_finder *finder = s->finder;
    const sl_box *b = &s->space->bounds;
    int exponent;
    frexp(sli_greater(b->max.x - b->min.x, b->max.y - b->min.y), &exponent);
    s->scale = ldexp(1, -exponent);
    const uint32_t count =
        sli_route_stand(finder, from, sl_space_locate(s->space, from), finder->at_start);
    finder->nodes.count = finder->open.count = 0;
    for (uint32_t i = 0; i < count; i++) {
        const sli_route_node node = {.root = from,
                                     .parent = SLI_ROUTE_NONE,
                                     .entry = SLI_ROUTE_NONE,
                                     .cell = finder->list[i]};
        SL_TRY(push(s, &node, 0));
    }
    return SL_OK;
}

sl_status sli_route_search(sl_context *context, sl_route_finder *finder, sl_point from, sl_point to,
                           uint64_t *expanded, uint32_t *out) {
    search s = {
        .context = context, .finder = finder, .space = finder->space, .from = from, .goal = to};
    *expanded = 0;
    *out = SLI_ROUTE_NONE;
    SL_TRY(start_at(&s, from));
    while (finder->open.count) {
        const uint32_t next = pop(finder);
        if (finder->nodes.items[next].is_last) {
            *out = next;
            return SL_OK;
        }
        if ((++*expanded & 0xfff) == 0) SL_TRY(sl_check_cancelled(context));
        SL_TRY(expand(&s, next));
    }
    return SL_OK;
}

/// No point of a cell is farther than a known one and the way from there straight to it.
static double farthest(const sl_space *space, uint32_t cell, const sl_route_near *known) {
    const sl_cell *c = &space->cells[cell];
    double most = 0;
    for (uint32_t k = 0; k < c->vertex_count; k++)
        most = fmax(most, distance(known->at, space->vertices[c->first_vertex + k]));
    return (known->distance + most) * (1 + SAME);
}

sl_status sli_route_spread(sl_context *context, sl_route_finder *finder, sl_point from,
                           double limit, sl_route_near *cells, sli_route_take take, void *user) {
    search s = {.context = context,
                .finder = finder,
                .space = finder->space,
                .from = from,
                .cells = cells,
                .limit = limit,
                .take = take,
                .user = user};
    for (uint32_t c = 0; c < s.space->cell_count; c++) {
        finder->upper[c] = INFINITY;
        cells[c] = (sl_route_near){INFINITY, {0, 0}};
    }
    SL_TRY(start_at(&s, from));
    for (uint64_t expanded = 1; finder->open.count; expanded++) {
        const uint32_t next = pop(finder);
        const sli_route_node node = finder->nodes.items[next];
        sl_route_near here = {0, from};
        if (node.entry != SLI_ROUTE_NONE) {
            const sl_point at = nearest_passed(&s, &node);
            here.distance = node.g + sli_length(at.x, at.y) / s.scale;
            here.at = (sl_point){node.root.x + at.x / s.scale, node.root.y + at.y / s.scale};
        }
        if (here.distance * (1 - SAME) > finder->upper[node.cell]) continue;
        if (here.distance < cells[node.cell].distance) cells[node.cell] = here;
        finder->upper[node.cell] =
            fmin(finder->upper[node.cell], farthest(s.space, node.cell, &here));
        if ((expanded & 0xfff) == 0) SL_TRY(sl_check_cancelled(context));
        SL_TRY(expand(&s, next));
    }
    return SL_OK;
}

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
/// not grow with the number of ways of the same length. The search goes on through all nodes whose
/// bound is that length. Then the corners alone decide which way it is, and not the order of nodes:
/// the way is read from its end, each time to the corner that comes first around the last one.
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

/// A limit runs from one point through another one.
typedef struct limit_line {
    sl_point from, to;
} limit_line;

static limit_line line_of(const sli_route_node *n, int side) {
    const sli_route_limit *limit = &n->limit[side];
    return limit->kind == SLI_LIMIT_RAY ? (limit_line){n->root, limit->point}
                                        : (limit_line){limit->point, n->root};
}

/// The side of a limit that a point lies on: 1 left, -1 right, 0 on it.
static int side_of(const limit_line *limit, sl_point p) {
    return sli_same_point(p, limit->from) || sli_same_point(p, limit->to)
               ? 0
               : sli_orient(limit->from, limit->to, p);
}

bool sli_route_is_beyond(const sli_route_node *n, int side, sl_point p) {
    const limit_line limit = line_of(n, side);
    return n->limit[side].kind != SLI_LIMIT_NONE &&
           side_of(&limit, p) == (side == SLI_ROUTE_LEFT ? 1 : -1);
}

// --- the bound

static sl_point offset(const search *s, sl_point from, sl_point to) {
    return (sl_point){(to.x - from.x) * s->scale, (to.y - from.y) * s->scale};
}

static double size_of(sl_point p) {
    return fabs(p.x) + fabs(p.y);
}

/// What a node's directions pass of its portal, as seen from its root, scaled. Where an end is
/// rounded, it lies rather too far out than too far in.
typedef struct passed {
    sl_point end[2];
    double error; ///< how much too far out the ends may lie
    double reach; ///< how large the numbers are that they are made of
} passed;

/// Moves an end that is beyond a limit to it. `r` and `l` are the ends of the portal.
static void cut_end(const search *s, const sli_route_node *n, int side, sl_point r, sl_point l,
                    passed *out) {
    const limit_line limit = line_of(n, side);
    const sl_point ray = offset(s, limit.from, limit.to);
    const double at_right = -sli_cross(ray, r), sum = at_right + sli_cross(ray, l);
    const double slack = 0x1p-48 * size_of(ray) * (size_of(r) + size_of(l)) / sum;
    const double share = at_right / sum + (side == SLI_ROUTE_LEFT ? slack : -slack);
    const bool is_known = share > 0 && share < 1;
    out->error += (is_known ? 2 * slack : 1) * (fabs(l.x - r.x) + fabs(l.y - r.y));
    if (is_known) out->end[side] = (sl_point){r.x + share * (l.x - r.x), r.y + share * (l.y - r.y)};
}

static passed passed_by(const search *s, const sli_route_node *n) {
    const sl_directed_portal *d = &s->space->directed[n->entry];
    const sl_point r = offset(s, n->root, d->right), l = offset(s, n->root, d->left);
    passed out = {.end = {r, l}, .reach = size_of(r) + size_of(offset(s, d->right, d->left))};
    for (int side = 0; side < 2; side++)
        if (n->cuts[side]) cut_end(s, n, side, r, l, &out);
    return out;
}

/// How far it is at least from a node's root to the goal, through its portal.
static double bound(const search *s, const sli_route_node *n, const passed *piece) {
    const sl_directed_portal *d = &s->space->directed[n->entry];
    const sl_point along = offset(s, d->right, d->left), past = offset(s, d->right, s->goal);
    const sl_point r = piece->end[SLI_ROUTE_RIGHT], l = piece->end[SLI_ROUTE_LEFT];
    sl_point t = offset(s, n->root, s->goal);
    const double reach = size_of(t) + piece->reach;
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
    return sli_greater(distance(n->root, s->goal), (h - 0x1p-46 * reach) / s->scale);
}

// --- what is known of a cell

static sli_route_cell *known_of(const search *s, uint32_t cell) {
    sli_route_cell *known = &s->finder->cells[cell];
    if (known->stamp != s->finder->stamp)
        *known = (sli_route_cell){.stamp = s->finder->stamp, .least = INFINITY, .most = INFINITY};
    return known;
}

/// Whether all of a cell is known to be nearer than that: what is as far brings nothing to it.
static bool is_known_nearer(const search *s, uint32_t cell, double far) {
    return far * (1 - SAME) > known_of(s, cell)->most;
}

/// Notes that a place in a cell, scaled from an origin, is so far: no point of the cell is farther
/// than that and the way from there straight to it.
static void note_place(const search *s, uint32_t cell, sl_point origin, sl_point at, double far) {
    sli_route_cell *known = known_of(s, cell);
    const sl_cell *c = &s->space->cells[cell];
    double most = 0;
    if (far >= known->least) return; // it would hardly help
    known->least = far;
    for (uint32_t k = 0; k < c->vertex_count; k++) {
        const sl_point to = offset(s, origin, s->space->vertices[c->first_vertex + k]);
        const double x = to.x - at.x, y = to.y - at.y;
        most = sli_greater(most, x * x + y * y);
    }
    known->most = sli_lesser(known->most, (far + sqrt(most) / s->scale) * (1 + SAME));
}

// --- the open nodes

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
    const sli_route_open item = {f * (1 - 0x1p-50), (uint32_t)finder->nodes.count - 1};
    return sli_route_heap_push(s->context, &finder->open, item);
}

// --- corners

/// Whether `other` reaches directions beyond those from `known`, turning to one side at `at`.
static bool turns_more(sl_point known, sl_point other, sl_point at, int side) {
    const int turn = sli_turn(known, at, other, at);
    return side == SLI_ROUTE_RIGHT ? turn > 0 : turn < 0;
}

/// What a way to a corner is worth: nothing, a place among the ways of the same length, or a search
/// from there, too.
typedef enum corner_worth { WORTH_NOTHING, WORTH_KEEPING, WORTH_SEARCHING } corner_worth;

/// Enters a way of length g that comes from `from` at a corner. The node that turns there must be
/// kept next.
static corner_worth enter_corner(search *s, size_t end, int side, sl_point from, sl_point at,
                                 double g) {
    const uint32_t number = s->finder->corner_of[end], stamp = s->finder->stamp,
                   node = (uint32_t)s->finder->nodes.count;
    sli_route_corner *corner = &s->finder->corners[number];
    sli_route_turn *turn = &s->finder->turns[end];
    corner_worth worth = WORTH_SEARCHING;
    if (corner->stamp != stamp || g < corner->g * (1 - SAME))
        *corner = (sli_route_corner){stamp, {SLI_ROUTE_NONE, SLI_ROUTE_NONE}, g, {{0, 0}, {0, 0}}};
    if (g > corner->g * (1 + SAME)) return WORTH_NOTHING;
    const sl_point known = corner->before[side];
    const bool is_new = corner->node[side] == SLI_ROUTE_NONE || !sli_same_point(known, from);
    if (corner->node[side] != SLI_ROUTE_NONE && is_new && !turns_more(known, from, at, side)) {
        if (turns_more(from, known, at, side) || !sli_goes_on(known, from, at))
            return WORTH_NOTHING;
        worth = WORTH_KEEPING;
    }
    corner->before[side] = from;
    if (turn->stamp == stamp && sli_same_point(turn->before, from) && turn->g <= g) {
        if (is_new) corner->node[side] = turn->node;
        return WORTH_NOTHING;
    }
    if (is_new) corner->node[side] = node;
    *turn = (sli_route_turn){stamp, node, g, from};
    return worth;
}

/// Makes the root of a node the corner at one end of a directed portal, if that is worth searching
/// from.
static sl_status turn_at(search *s, sli_route_node *n, uint32_t entry, int side, bool *out) {
    const sl_directed_portal *d = &s->space->directed[entry];
    const sl_point at = side == SLI_ROUTE_LEFT ? d->left : d->right;
    const size_t end = 2 * (size_t)entry + (size_t)side;
    *out = false;
    if (s->finder->corner_of[end] == SLI_ROUTE_NONE) return SL_OK;
    const double g = n->g + distance(n->root, at);
    if (is_known_nearer(s, d->cell, g)) return SL_OK;
    const corner_worth worth = enter_corner(s, end, side, n->root, at, g);
    n->limit[side] = (sli_route_limit){SLI_LIMIT_NONE, at};
    n->limit[!side] = (sli_route_limit){SLI_LIMIT_ON, n->root};
    n->root = at;
    n->entry = entry;
    n->cell = d->cell;
    n->is_behind = false;
    n->g = g;
    *out = worth == WORTH_SEARCHING;
    return worth == WORTH_KEEPING ? keep(s, n) : SL_OK;
}

// --- the portals of a cell

/// An end of a portal as a node's root sees it.
typedef struct seen_end {
    sl_point at;
    int out[2]; ///< by limit: 1 beyond it, 0 on it, -1 within or no limit
} seen_end;

/// The nearest point to a node's root on what it passes of its portal, from the root, scaled.
static sl_point nearest_passed(const passed *piece) {
    return sli_nearest_on(piece->end[SLI_ROUTE_RIGHT], piece->end[SLI_ROUTE_LEFT],
                          (sl_point){0, 0});
}

static sl_status push_across(search *s, sli_route_node *node, uint32_t across) {
    node->entry = across;
    node->cell = s->space->directed[across].cell;
    const passed piece = passed_by(s, node);
    const sl_point at = nearest_passed(&piece);
    node->near = node->g + sli_length(at.x, at.y) / s->scale;
    if (is_known_nearer(s, node->cell, node->near)) return SL_OK;
    note_place(s, node->cell, node->root, at, node->near + 2 * piece.error / s->scale);
    if (!s->cells) return push(s, node, node->g + bound(s, node, &piece));
    return node->near * (1 - SAME) > s->limit ? SL_OK : push(s, node, node->near);
}

/// A portal that is seen edge-on: straight to its nearer end, and around that. A root on the portal
/// is the start, which stands in the cell behind it, too; where there is a loss, it does not.
static sl_status cross_edge_on(search *s, const sli_route_node *from, uint32_t across) {
    const sl_directed_portal *d = &s->space->directed[across];
    const double loss = sli_route_loss(s->finder, d->portal);
    sli_route_node node = *from;
    int side;
    node.g += loss;
    node.is_behind = false;
    node.cuts[SLI_ROUTE_RIGHT] = node.cuts[SLI_ROUTE_LEFT] = false;
    if (sli_goes_on(node.root, d->right, d->left))
        side = SLI_ROUTE_RIGHT;
    else if (sli_goes_on(node.root, d->left, d->right))
        side = SLI_ROUTE_LEFT;
    else
        return loss > 0 ? push_across(s, &node, across) : SL_OK; // the root is on it
    const sl_point end = side == SLI_ROUTE_LEFT ? d->left : d->right;
    if (sli_route_is_beyond(&node, SLI_ROUTE_RIGHT, end) ||
        sli_route_is_beyond(&node, SLI_ROUTE_LEFT, end))
        return SL_OK;
    bool is_turned;
    SL_TRY(turn_at(s, &node, across, side, &is_turned));
    return is_turned ? push_across(s, &node, across) : SL_OK;
}

/// A node that looks around in its cell.
typedef struct sight {
    const sli_route_node *node;
    bool is_ordered; ///< the root is behind the cell: it sees the portals from right to left
    bool is_limited[2];
    limit_line limit[2];
} sight;

static sight sight_of(const sli_route_node *n, bool is_ordered) {
    sight out = {.node = n, .is_ordered = is_ordered};
    for (int side = 0; side < 2; side++) {
        out.is_limited[side] = n->limit[side].kind != SLI_LIMIT_NONE;
        out.limit[side] = line_of(n, side);
    }
    return out;
}

/// Whether a root is the start, and the start stands in a cell: turning around it leads nowhere.
static bool stands_there(const search *s, sl_point root, uint32_t cell) {
    return sli_same_point(root, s->from) && s->finder->at_start[cell] == s->finder->stamp;
}

/// Whether a portal around the root ends just where the way came from. Nobody needs to pass it: the
/// way came along its other side.
static bool turns_back(const sli_route_node *n, int side, const seen_end *end) {
    return n->limit[side].kind == SLI_LIMIT_ON && end->out[side] == 0 &&
           !sli_goes_on(n->limit[side].point, n->root, end->at);
}

/// Takes a node through a portal that ends at its root, around that. `other` is the other end.
static sl_status cross_around(search *s, const sli_route_node *from, uint32_t across, int side,
                              const seen_end *other) {
    const sl_directed_portal *d = &s->space->directed[across];
    sli_route_node node = *from;
    if (other->out[!side] > 0 || turns_back(from, !side, other) ||
        stands_there(s, node.root, d->cell))
        return SL_OK;
    node.g += sli_route_loss(s->finder, d->portal);
    node.is_behind = node.cuts[SLI_ROUTE_RIGHT] = node.cuts[SLI_ROUTE_LEFT] = false;
    node.limit[side].kind = SLI_LIMIT_NONE;
    return push_across(s, &node, across);
}

/// Takes a node through a portal of its cell. `ends` are those of the portal, right and left.
static sl_status cross(search *s, const sight *view, uint32_t across, const seen_end *ends) {
    const sl_directed_portal *d = &s->space->directed[across];
    const sli_route_node *from = view->node;
    bool is_out = false;
    for (int side = 0; side < 2; side++)
        is_out |= ends[side].out[side] >= 0 && ends[!side].out[side] >= 0;
    if (!view->is_ordered || is_out) { // else a root behind the cell faces it
        for (int side = 0; side < 2; side++)
            if (sli_same_point(from->root, ends[side].at))
                return cross_around(s, from, across, side, &ends[!side]);
        const int facing = sli_orient(from->root, d->right, d->left);
        if (facing < 0) return SL_OK;
        if (!facing) return cross_edge_on(s, from, across);
        if (is_out) return SL_OK;
    }
    sli_route_node node = *from;
    node.g += sli_route_loss(s->finder, d->portal);
    node.is_behind = true;
    for (int side = 0; side < 2; side++) {
        node.cuts[side] = ends[side].out[side] > 0;
        if (!node.cuts[side]) node.limit[side] = (sli_route_limit){SLI_LIMIT_RAY, ends[side].at};
    }
    return push_across(s, &node, across);
}

/// Looks at an end. Where ends are met in order, from right to left, `last` is the one before it.
static seen_end look_at(const sight *view, sl_point at, const seen_end *last) {
    seen_end end = {at, {-1, -1}};
    if (view->is_limited[SLI_ROUTE_RIGHT] && !(view->is_ordered && last->out[SLI_ROUTE_RIGHT] < 0))
        end.out[SLI_ROUTE_RIGHT] = -side_of(&view->limit[SLI_ROUTE_RIGHT], at);
    if (view->is_limited[SLI_ROUTE_LEFT] && !(view->is_ordered && end.out[SLI_ROUTE_RIGHT] > 0))
        end.out[SLI_ROUTE_LEFT] = side_of(&view->limit[SLI_ROUTE_LEFT], at);
    return end;
}

/// The number of the portal that a node came by, among those of its cell; their count for none.
static uint32_t way_back(const search *s, const sli_route_node *node) {
    const sl_cell *cell = &s->space->cells[node->cell];
    const sl_directed_portal *directed = s->space->directed + cell->first_directed;
    uint32_t k = 0;
    if (node->entry == SLI_ROUTE_NONE) return cell->directed_count;
    while (k < cell->directed_count && directed[k].portal != s->space->directed[node->entry].portal)
        k++;
    return k;
}

/// Takes a node through the portals of its cell but the one that it came by. From there on,
/// counter-clockwise, a root behind it sees the others from right to left: first those beyond the
/// right limit, last those beyond the left one.
static sl_status cross_all(search *s, const sli_route_node *node) {
    const sl_cell *cell = &s->space->cells[node->cell];
    const uint32_t count = cell->directed_count, back = way_back(s, node);
    const sight view = sight_of(node, node->is_behind && back < count);
    seen_end last = {{NAN, NAN}, {1, -1}};
    for (uint32_t i = 1; i <= count && !(view.is_ordered && last.out[SLI_ROUTE_LEFT] > 0); i++) {
        const uint32_t k = back + i < count ? back + i : (back + i) % count;
        const sl_directed_portal *d = &s->space->directed[cell->first_directed + k];
        if (k == back || (!s->cells && !sli_route_is_open(s->finder, d->portal))) continue;
        const seen_end left = look_at(&view, d->left, &last);
        if (view.is_ordered && left.out[SLI_ROUTE_RIGHT] > 0) {
            last = left;
            continue;
        }
        const seen_end ends[2] = {
            sli_same_point(last.at, d->right) ? last : look_at(&view, d->right, &last), left};
        last = left;
        SL_TRY(cross(s, &view, cell->first_directed + k, ends));
    }
    return SL_OK;
}

/// Straight on from a node's root: to the goal if it is in the cell, and through the portals.
static sl_status go_on(search *s, const sli_route_node *node) {
    if (s->take) SL_TRY(s->take(s->context, node, s->user));
    if (s->finder->at_goal[node->cell] == s->finder->stamp &&
        !sli_route_is_beyond(node, SLI_ROUTE_RIGHT, s->goal) &&
        !sli_route_is_beyond(node, SLI_ROUTE_LEFT, s->goal)) {
        sli_route_node last = *node;
        last.is_last = true;
        SL_TRY(push(s, &last, node->g + distance(node->root, s->goal)));
    }
    return cross_all(s, node);
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
        bool is_turned;
        if (node.limit[side].kind != SLI_LIMIT_RAY || !sli_same_point(node.limit[side].point, end))
            continue;
        SL_TRY(turn_at(s, &turned, node.entry, side, &is_turned));
        if (!is_turned) continue;
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
    const uint32_t goal = s->cells ? SL_NO_CELL : sl_space_locate(s->space, s->goal);
    const uint32_t count =
        sli_route_stand(finder, from, sl_space_locate(s->space, from), finder->at_start);
    finder->nodes.count = finder->open.count = 0;
    for (uint32_t i = 0; i < count; i++) {
        if (!s->cells) sli_route_open_blocks(finder, finder->list[i], goal);
        const sli_route_node node = {.root = from,
                                     .parent = SLI_ROUTE_NONE,
                                     .entry = SLI_ROUTE_NONE,
                                     .cell = finder->list[i]};
        note_place(s, node.cell, from, (sl_point){0, 0}, 0);
        SL_TRY(push(s, &node, 0));
    }
    return SL_OK;
}

/// Where a node comes from: its root, or where the way turns before if it turns there.
static sl_point origin_of(const sl_route_finder *f, const sli_route_node *n) {
    return n->is_last ? n->root : f->nodes.items[n->parent].root;
}

/// Of two nodes that end at a place, the one whose way comes to it from the point that is first
/// around it. The first node may be SLI_ROUTE_NONE.
static uint32_t first_around(const sl_route_finder *f, sl_point at, uint32_t a, uint32_t b) {
    const sli_route_node *nodes = f->nodes.items;
    if (a == SLI_ROUTE_NONE) return b;
    return sli_compare_around(at, origin_of(f, &nodes[a]), origin_of(f, &nodes[b])) <= 0 ? a : b;
}

uint32_t sli_route_turning(const sl_route_finder *f, uint32_t number) {
    const sli_route_node *nodes = f->nodes.items, *n = &nodes[number];
    if (n->parent == SLI_ROUTE_NONE || sli_same_point(nodes[n->parent].root, n->root))
        return number;
    const int side = n->limit[SLI_ROUTE_LEFT].kind == SLI_LIMIT_NONE;
    const sli_route_corner *corner = &f->corners[f->corner_of[2 * (size_t)n->entry + (size_t)side]];
    uint32_t first = SLI_ROUTE_NONE;
    for (int k = 0; k < 2; k++) {
        const uint32_t turned = corner->node[k];
        // A piece that is longer than what counts as the same leads nearer to the start.
        if (turned != SLI_ROUTE_NONE &&
            distance(nodes[nodes[turned].parent].root, n->root) > 4 * SAME * n->g)
            first = first_around(f, n->root, first, turned);
    }
    return first == SLI_ROUTE_NONE ? number : first;
}

sl_status sli_route_search(sl_context *context, sl_route_finder *finder, sl_point from, sl_point to,
                           uint64_t *expanded, uint32_t *out) {
    search s = {
        .context = context, .finder = finder, .space = finder->space, .from = from, .goal = to};
    *expanded = 0;
    *out = SLI_ROUTE_NONE;
    SL_TRY(start_at(&s, from));
    double most = INFINITY;
    while (finder->open.count && finder->open.items[0].f <= most) {
        const double f = finder->open.items[0].f;
        const uint32_t next = sli_route_heap_pop(&finder->open).node;
        if (finder->nodes.items[next].is_last) {
            if (*out == SLI_ROUTE_NONE) most = f * (1 + SAME);
            *out = first_around(finder, to, *out, next);
            continue;
        }
        if (is_known_nearer(&s, finder->nodes.items[next].cell, finder->nodes.items[next].near))
            continue;
        if ((++*expanded & 0xfff) == 0) SL_TRY(sl_check_cancelled(context));
        SL_TRY(expand(&s, next));
    }
    return SL_OK;
}

/// The nearest point of a node's cell that it leads to, rounded.
static sl_point nearest_of(const search *s, const sli_route_node *node) {
    if (node->entry == SLI_ROUTE_NONE) return s->from;
    const passed piece = passed_by(s, node);
    const sl_point at = nearest_passed(&piece);
    return (sl_point){node->root.x + at.x / s->scale, node->root.y + at.y / s->scale};
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
    for (uint32_t c = 0; c < s.space->cell_count; c++) cells[c] = (sl_route_near){INFINITY, {0, 0}};
    SL_TRY(start_at(&s, from));
    for (uint64_t expanded = 1; finder->open.count; expanded++) {
        const uint32_t next = sli_route_heap_pop(&finder->open).node;
        const sli_route_node *node = &finder->nodes.items[next];
        if (is_known_nearer(&s, node->cell, node->near)) continue;
        if (node->near < cells[node->cell].distance)
            cells[node->cell] = (sl_route_near){node->near, nearest_of(&s, node)};
        if ((expanded & 0xfff) == 0) SL_TRY(sl_check_cancelled(context));
        SL_TRY(expand(&s, next));
    }
    return SL_OK;
}

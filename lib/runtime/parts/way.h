/// The shortest way through convex cells (Cui, Harabor and Grastien 2017: Polyanya).

// As lib/analysis/route/search.c, which explains it, in memory of the caller. A node is a root, the
// last corner of a way, and the directions from it that go on straight into a cell. Limits of the
// directions are rays through corners, so each sign is exact. An A* search takes the node with the
// least bound first; bounds are rounded down. A corner is turned at by the shortest way to it only,
// and of ways of the same length by those from which most can be turned to.
//
// Nodes that turn are what is known of a corner. Two tables find them, by gate and by row; they are
// hash tables, so that no memory has to be cleared for each portal of the level.

/// Lengths count as the same up to this share: 2^-42.
#define SLRT_SAME_LENGTH 2.2737367544323206e-13

/// A limit of directions: none, the ray from the root through `limit`, or the ray that goes on from
/// `limit` through the root.
enum { SLRT_LIMIT_NONE, SLRT_LIMIT_RAY, SLRT_LIMIT_ON };

/// A way to `root` of length `g`, and the directions from there that enter `cell` by gate `entry`.
typedef struct slrt_way_node {
    double root[2], limit[2][2], g;
    uint32_t parent, entry; ///< SLRT_NONE for the first ones
    uint32_t cell;
    uint32_t row, turn; ///< of one that turns: the corner, and 2 * gate + side; else of no meaning
    unsigned char kind[2];
    bool is_last; ///< leads from its root straight to the goal
} slrt_way_node;

enum {
    SLRT_WAY_NODE_WORDS = sizeof(slrt_way_node) / sizeof(uint32_t),
    SLRT_WAY_ROW = offsetof(slrt_way_node, row) / sizeof(uint32_t),
    SLRT_WAY_TURN = offsetof(slrt_way_node, turn) / sizeof(uint32_t)
};

/// A node that is open.
typedef struct slrt_way_open {
    double f;
    uint32_t node, unused;
} slrt_way_open;

enum { SLRT_WAY_OPEN_WORDS = sizeof(slrt_way_open) / sizeof(uint32_t) };

typedef struct slrt_way {
    const sl_runtime *rt;
    const unsigned char *shut;
    double from[2], to[2], scale;                  ///< scale: brings bounds to about 1
    uint32_t *list, *at_start, *at_goal, *reached; ///< cells, and a bit for each
    uint32_t *nodes, node_count, node_room;
    uint32_t *open, open_count;
    uint32_t *turns; ///< of table_size nodes, by gate and side
    uint32_t *rows;  ///< of three times as many: of a corner, the first node, the last by side
    uint32_t table_size;
    uint64_t patience;
    bool full; ///< there was no room for a node
} slrt_way;

// --- memory

static uint32_t slrt_way_table(uint32_t nodes) {
    uint32_t size = 2;
    while (size < 2 * (uint64_t)nodes && size < UINT32_C(1) << 31) size *= 2;
    return size;
}

SL_RUNTIME_API size_t sl_runtime_way_scratch_count(const sl_runtime *runtime, uint32_t nodes) {
    const size_t cells = runtime->cell_count;
    return cells + 3 * ((cells + 31) / 32) +
           (size_t)(SLRT_WAY_NODE_WORDS + SLRT_WAY_OPEN_WORDS) * nodes +
           4 * (size_t)slrt_way_table(nodes);
}

static void slrt_way_start(slrt_way *w, const sl_runtime *rt, const unsigned char *shut,
                           uint32_t *scratch, uint32_t nodes) {
    const size_t cells = rt->cell_count, bits = (cells + 31) / 32;
    const double wide = rt->max_x - rt->min_x, high = rt->max_y - rt->min_y;
    memset(w, 0, sizeof *w);
    w->rt = rt;
    w->shut = shut;
    w->scale = slrt_scale_of(wide > high ? wide : high);
    w->node_room = nodes < UINT32_C(1) << 30 ? nodes : UINT32_C(1) << 30;
    w->table_size = slrt_way_table(nodes);
    w->patience = 256 * ((uint64_t)rt->directed_count + rt->passage_count + w->node_room + 16);
    w->list = scratch;
    w->at_start = w->list + cells;
    w->at_goal = w->at_start + bits;
    w->reached = w->at_goal + bits;
    w->nodes = w->reached + bits;
    w->open = w->nodes + (size_t)SLRT_WAY_NODE_WORDS * nodes;
    w->turns = w->open + (size_t)SLRT_WAY_OPEN_WORDS * nodes;
    w->rows = w->turns + w->table_size;
    memset(w->at_start, 0, 3 * bits * sizeof *scratch);
    memset(w->turns, 0xff, 4 * (size_t)w->table_size * sizeof *scratch);
}

static slrt_way_node slrt_way_node_at(const slrt_way *w, uint32_t number) {
    slrt_way_node node;
    memcpy(&node, w->nodes + SLRT_WAY_NODE_WORDS * (size_t)number, sizeof node);
    return node;
}

static void slrt_way_keep(slrt_way *w, const slrt_way_node *node) {
    w->full = w->full || w->node_count == w->node_room;
    if (w->full) return;
    memcpy(w->nodes + SLRT_WAY_NODE_WORDS * (size_t)w->node_count++, node, sizeof *node);
}

static bool slrt_has_bit(const uint32_t *bits, uint32_t cell) {
    return bits[cell / 32] >> cell % 32 & 1;
}

/// Adds a cell to the list that has no bit yet.
static void slrt_way_list(slrt_way *w, uint32_t *bits, uint32_t cell, uint32_t *count) {
    if (slrt_has_bit(bits, cell)) return;
    bits[cell / 32] |= UINT32_C(1) << cell % 32;
    w->list[(*count)++] = cell;
}

// --- the open nodes: a heap

static slrt_way_open slrt_way_open_at(const slrt_way *w, uint32_t i) {
    slrt_way_open item;
    memcpy(&item, w->open + SLRT_WAY_OPEN_WORDS * (size_t)i, sizeof item);
    return item;
}

static void slrt_way_set_open(slrt_way *w, uint32_t i, const slrt_way_open *item) {
    memcpy(w->open + SLRT_WAY_OPEN_WORDS * (size_t)i, item, sizeof *item);
}

static bool slrt_opens_before(const slrt_way_open *a, const slrt_way_open *b) {
    return a->f != b->f ? a->f < b->f : a->node < b->node;
}

static void slrt_way_push(slrt_way *w, const slrt_way_node *node, double f) {
    slrt_way_open item;
    uint32_t i = w->open_count;
    slrt_way_keep(w, node);
    if (w->full) return;
    item.f = f * (1 - 8.8817841970012523e-16); // 2^-50
    item.node = w->node_count - 1;
    item.unused = 0;
    w->open_count++;
    while (i) {
        const slrt_way_open above = slrt_way_open_at(w, (i - 1) / 2);
        if (!slrt_opens_before(&item, &above)) break;
        slrt_way_set_open(w, i, &above);
        i = (i - 1) / 2;
    }
    slrt_way_set_open(w, i, &item);
}

static uint32_t slrt_way_pop(slrt_way *w) {
    const uint32_t least = slrt_way_open_at(w, 0).node;
    const slrt_way_open last = slrt_way_open_at(w, --w->open_count);
    uint32_t i = 0, child;
    while ((child = 2 * i + 1) < w->open_count) {
        slrt_way_open below = slrt_way_open_at(w, child);
        if (child + 1 < w->open_count) {
            const slrt_way_open other = slrt_way_open_at(w, child + 1);
            if (slrt_opens_before(&other, &below)) {
                below = other;
                child++;
            }
        }
        if (!slrt_opens_before(&below, &last)) break;
        slrt_way_set_open(w, i, &below);
        i = child;
    }
    slrt_way_set_open(w, i, &last);
    return least;
}

// --- lengths and bounds

/// A length, off by a few units in the last place.
static double slrt_length(double x, double y) {
    const double larger = slrt_larger(x, y), scale = slrt_scale_of(larger);
    double u[2];
    if (!(larger > 0)) return 0;
    u[0] = x * scale;
    u[1] = y * scale;
    return slrt_root(slrt_dot(u, u)) / scale;
}

static double slrt_distance(const double *a, const double *b) {
    return slrt_length(b[0] - a[0], b[1] - a[1]);
}

/// The side of a limit that a point lies on: 1 left, -1 right, 0 on it.
static int slrt_limit_side(const slrt_way_node *n, int side, const double *point) {
    return n->kind[side] == SLRT_LIMIT_RAY ? slrt_turn(n->root, n->limit[side], point)
                                           : slrt_turn(n->limit[side], n->root, point);
}

/// Whether a point is out of the directions of a node on one side.
static bool slrt_is_past_limit(const slrt_way_node *n, int side, const double *point) {
    return n->kind[side] != SLRT_LIMIT_NONE &&
           slrt_limit_side(n, side, point) == (side == SLRT_GATE_LEFT ? 1 : -1);
}

/// Whether the way from a through p to b goes straight on or turns left. A way back is neither.
static bool slrt_goes_on(const double *a, const double *p, const double *b) {
    const slrt_arm to = slrt_make_arm(a[0], a[1], p[0], p[1]);
    const slrt_arm on = slrt_make_arm(p[0], p[1], b[0], b[1]);
    const int turn = slrt_side(&to, &on);
    return turn ? turn > 0 : slrt_same_way(&to, &on);
}

static void slrt_offset(const slrt_way *w, const double *from, const double *to, double *out) {
    out[0] = (to[0] - from[0]) * w->scale;
    out[1] = (to[1] - from[1]) * w->scale;
}

/// The end of what a node's directions pass of its gate, as seen from its root: between r and l,
/// the ends of the gate. Where it is rounded, it lies rather too far out than too far in.
static void slrt_passed_end(const slrt_way *w, const slrt_way_node *n, const slrt_gate *gate,
                            int side, const double *r, const double *l, double *out) {
    double ray[2], at_right, sum, slack, share;
    memcpy(out, side == SLRT_GATE_LEFT ? l : r, 2 * sizeof *out);
    if (!slrt_is_past_limit(n, side, gate->end[side])) return;
    if (n->kind[side] == SLRT_LIMIT_RAY)
        slrt_offset(w, n->root, n->limit[side], ray);
    else
        slrt_offset(w, n->limit[side], n->root, ray);
    at_right = -slrt_turned(ray, r);
    sum = at_right + slrt_turned(ray, l);
    slack = 3.5527136788005009e-15 * slrt_size(ray[0], ray[1]) * // 2^-48
            (slrt_size(r[0], r[1]) + slrt_size(l[0], l[1])) / sum;
    share = at_right / sum + (side == SLRT_GATE_LEFT ? slack : -slack);
    if (!(share > 0 && share < 1)) return;
    out[0] = r[0] + share * (l[0] - r[0]);
    out[1] = r[1] + share * (l[1] - r[1]);
}

/// How far it is at least from a node's root to the goal, through its gate.
static double slrt_way_bound(const slrt_way *w, const slrt_way_node *n, const slrt_gate *gate) {
    const double straight = slrt_distance(n->root, w->to);
    double start[2], end[2], along[2], past[2], r[2], l[2], t[2], reach, over, least;
    slrt_offset(w, n->root, gate->end[SLRT_GATE_RIGHT], start);
    slrt_offset(w, n->root, gate->end[SLRT_GATE_LEFT], end);
    slrt_offset(w, gate->end[SLRT_GATE_RIGHT], gate->end[SLRT_GATE_LEFT], along);
    slrt_offset(w, gate->end[SLRT_GATE_RIGHT], w->to, past);
    slrt_offset(w, n->root, w->to, t);
    slrt_passed_end(w, n, gate, SLRT_GATE_RIGHT, start, end, r);
    slrt_passed_end(w, n, gate, SLRT_GATE_LEFT, start, end, l);
    reach = slrt_size(t[0], t[1]) + slrt_size(start[0], start[1]) + slrt_size(along[0], along[1]);
    over = slrt_turned(along, past);
    if (over > 0) { // the goal lies before the gate: its image behind it
        const double twice = 2 * (over / slrt_dot(along, along));
        t[0] += twice * along[1];
        t[1] -= twice * along[0];
    }
    if (slrt_turned(r, t) < 0)
        least = slrt_length(r[0], r[1]) + slrt_distance(r, t);
    else if (slrt_turned(l, t) > 0)
        least = slrt_length(l[0], l[1]) + slrt_distance(l, t);
    else
        least = slrt_length(t[0], t[1]);
    least = (least - 1.4210854715202004e-14 * reach) / w->scale; // 2^-46
    return least > straight ? least : straight;
}

// --- corners

/// Where a table has a number, or where it is to be put. In the first of `step` words is a node, of
/// which `word` is that number.
static uint32_t *slrt_way_find(const slrt_way *w, uint32_t *table, uint32_t step, uint32_t word,
                               uint32_t number) {
    uint32_t at = number * UINT32_C(2654435769);
    at ^= at >> 16;
    while (true) {
        uint32_t *slot = table + step * (size_t)(at & (w->table_size - 1));
        if (*slot == SLRT_NONE || w->nodes[SLRT_WAY_NODE_WORDS * (size_t)*slot + word] == number)
            return slot;
        at++;
    }
}

/// Whether `other` reaches directions beyond those from `known`, turning to one side at `at`.
static bool slrt_turns_more(const double *known, const double *other, const double *at, int side) {
    const slrt_arm a = slrt_make_arm(known[0], known[1], at[0], at[1]);
    const slrt_arm b = slrt_make_arm(other[0], other[1], at[0], at[1]);
    const int turn = slrt_side(&a, &b);
    return side == SLRT_GATE_RIGHT ? turn > 0 : turn < 0;
}

/// Makes the root of a node, in `cell`, the corner at one end of a gate. False if that is no corner
/// or not worth it. The node must be kept next.
static bool slrt_turn_at(slrt_way *w, slrt_way_node *n, uint32_t cell, const slrt_gate *gate,
                         int side) {
    const double *at = gate->end[side];
    const double g = n->g + slrt_distance(n->root, at);
    const uint32_t turn = 2 * gate->number + (uint32_t)side;
    uint32_t *known = slrt_way_find(w, w->turns, 1, SLRT_WAY_TURN, turn), *row, number;
    slrt_way_node first;
    bool searches = true;
    if (*known != SLRT_NONE)
        number = slrt_way_node_at(w, *known).row;
    else
        number = slrt_row_at(w->rt, w->shut, cell, gate, side, &w->patience);
    if (number == SLRT_NONE) return false;
    row = slrt_way_find(w, w->rows, 3, SLRT_WAY_ROW, number);
    if (*row != SLRT_NONE) first = slrt_way_node_at(w, *row);
    if (*row == SLRT_NONE || g < first.g * (1 - SLRT_SAME_LENGTH)) {
        row[0] = w->node_count;
        row[1] = row[2] = SLRT_NONE;
    } else if (g > first.g * (1 + SLRT_SAME_LENGTH)) {
        return false;
    }
    if (row[1 + side] != SLRT_NONE) {
        const slrt_way_node last = slrt_way_node_at(w, row[1 + side]);
        const double *before = last.limit[!side];
        searches = slrt_same_place(before, n->root) || slrt_turns_more(before, n->root, at, side);
        if (!searches && (slrt_turns_more(n->root, before, at, side) ||
                          !slrt_goes_on(before, n->root, at))) // else nearer in line: it is kept
            return false;
    }
    if (*known != SLRT_NONE) {
        const slrt_way_node last = slrt_way_node_at(w, *known);
        if (slrt_same_place(last.limit[!side], n->root) && last.g <= g) {
            row[1 + side] = *known;
            return false;
        }
    }
    *known = row[1 + side] = w->node_count;
    n->row = number;
    n->turn = turn;
    n->kind[side] = SLRT_LIMIT_NONE;
    n->kind[!side] = SLRT_LIMIT_ON;
    memcpy(n->limit[!side], n->root, sizeof n->root);
    memcpy(n->root, at, sizeof n->root);
    n->g = g;
    if (!searches) slrt_way_keep(w, n);
    return searches;
}

// --- the gates of a cell

static void slrt_push_across(slrt_way *w, slrt_way_node *node, const slrt_gate *gate) {
    node->entry = gate->number;
    node->cell = gate->cell;
    slrt_way_push(w, node, node->g + slrt_way_bound(w, node, gate));
}

/// A gate that is seen edge-on: straight to its nearer end, and around that. A root on the gate is
/// the start, which stands in the cell behind it, too.
static void slrt_cross_edge_on(slrt_way *w, const slrt_way_node *from, const slrt_gate *gate) {
    slrt_way_node node = *from;
    const double *right = gate->end[SLRT_GATE_RIGHT], *left = gate->end[SLRT_GATE_LEFT];
    int side = SLRT_GATE_RIGHT;
    if (!slrt_goes_on(node.root, right, left)) {
        side = SLRT_GATE_LEFT;
        if (!slrt_goes_on(node.root, left, right)) return;
    }
    if (slrt_is_past_limit(&node, SLRT_GATE_RIGHT, gate->end[side]) ||
        slrt_is_past_limit(&node, SLRT_GATE_LEFT, gate->end[side]))
        return;
    if (slrt_turn_at(w, &node, from->cell, gate, side)) slrt_push_across(w, &node, gate);
}

/// Whether a gate around the root ends just where the way came from. Nobody needs to pass it: the
/// way came along its other side.
static bool slrt_turns_back(const slrt_way_node *n, int side, const double *end) {
    return n->kind[side] == SLRT_LIMIT_ON && slrt_limit_side(n, side, end) == 0 &&
           !slrt_goes_on(n->limit[side], n->root, end);
}

/// Takes a node through a gate of its cell.
static void slrt_cross_gate(slrt_way *w, const slrt_way_node *from, const slrt_gate *gate) {
    slrt_way_node node = *from;
    int side, facing;
    for (side = 0; side < 2; side++) {
        if (!slrt_same_place(node.root, gate->end[side])) continue; // else around the root
        // Where the start stands, turning around it leads nowhere.
        if (slrt_is_past_limit(from, !side, gate->end[!side]) ||
            slrt_turns_back(from, !side, gate->end[!side]) ||
            (slrt_same_place(node.root, w->from) && slrt_has_bit(w->at_start, gate->cell)))
            return;
        node.kind[side] = SLRT_LIMIT_NONE;
        slrt_push_across(w, &node, gate);
        return;
    }
    facing = slrt_turn(node.root, gate->end[SLRT_GATE_RIGHT], gate->end[SLRT_GATE_LEFT]);
    if (!facing) slrt_cross_edge_on(w, from, gate);
    if (facing <= 0) return;
    for (side = 0; side < 2; side++) {
        const int out = side == SLRT_GATE_LEFT ? 1 : -1;
        if (from->kind[side] != SLRT_LIMIT_NONE) {
            const int near_side = slrt_limit_side(from, side, gate->end[side]) * out;
            const int far_side = slrt_limit_side(from, side, gate->end[!side]) * out;
            if (near_side >= 0 && far_side >= 0) return;
            if (near_side > 0) continue;
        }
        node.kind[side] = SLRT_LIMIT_RAY;
        memcpy(node.limit[side], gate->end[side], sizeof node.limit[side]);
    }
    slrt_push_across(w, &node, gate);
}

/// Straight on from a node's root: to the goal if it is in the cell, and through the gates but the
/// one that it came by.
static void slrt_way_on(slrt_way *w, const slrt_way_node *node, const slrt_gate *entry) {
    slrt_gates of = slrt_gates_of(w->rt, w->shut, node->cell);
    slrt_gate gate;
    if (slrt_has_bit(w->at_goal, node->cell) && !slrt_is_past_limit(node, SLRT_GATE_RIGHT, w->to) &&
        !slrt_is_past_limit(node, SLRT_GATE_LEFT, w->to)) {
        slrt_way_node last = *node;
        last.is_last = true;
        slrt_way_push(w, &last, node->g + slrt_distance(node->root, w->to));
    }
    while (!w->full && w->patience && slrt_next_gate(&of, &gate)) {
        w->patience--;
        if (!entry || gate.portal != entry->portal) slrt_cross_gate(w, node, &gate);
    }
}

static void slrt_way_expand(slrt_way *w, uint32_t number) {
    slrt_way_node node = slrt_way_node_at(w, number);
    const uint32_t came_from = node.parent;
    slrt_gate entry;
    uint32_t before;
    int side;
    node.parent = number;
    if (node.entry == SLRT_NONE) {
        slrt_way_on(w, &node, NULL);
        return;
    }
    before = slrt_way_node_at(w, came_from).cell;
    slrt_read_gate(w->rt, node.entry, &entry);
    slrt_way_on(w, &node, &entry);
    for (side = 0; side < 2 && !w->full; side++) {
        slrt_way_node turned = node;
        if (node.kind[side] != SLRT_LIMIT_RAY ||
            !slrt_same_place(node.limit[side], entry.end[side]) ||
            !slrt_turn_at(w, &turned, before, &entry, side))
            continue;
        slrt_way_keep(w, &turned);
        turned.parent = w->node_count - 1;
        slrt_way_on(w, &turned, &entry);
    }
}

// --- the way

/// Lists the cells that a point stands in, with bits.
static uint32_t slrt_way_stand(slrt_way *w, const double *point, uint32_t first, uint32_t *bits) {
    uint32_t count = 0, i;
    slrt_way_list(w, bits, first, &count);
    for (i = 0; i < count; i++) {
        slrt_gates of = slrt_gates_of(w->rt, w->shut, w->list[i]);
        slrt_gate gate;
        while (slrt_next_gate(&of, &gate))
            if (slrt_is_on(gate.end[0], gate.end[1], point) &&
                !slrt_turn(gate.end[0], gate.end[1], point))
                slrt_way_list(w, bits, gate.cell, &count);
    }
    return count;
}

/// Whether gates lead from the cells of the start to one of the goal. Else a search would go
/// through all that can be reached.
static bool slrt_way_exists(slrt_way *w, uint32_t count) {
    uint32_t i;
    memcpy(w->reached, w->at_start, ((size_t)w->rt->cell_count + 31) / 32 * sizeof *w->reached);
    for (i = 0; i < count; i++) {
        slrt_gates of = slrt_gates_of(w->rt, w->shut, w->list[i]);
        slrt_gate gate;
        if (slrt_has_bit(w->at_goal, w->list[i])) return true;
        while (slrt_next_gate(&of, &gate)) slrt_way_list(w, w->reached, gate.cell, &count);
    }
    return false;
}

/// The order of points around a place: counter-clockwise from the direction of x, the nearest first
/// in each direction. Whether a comes before b.
static bool slrt_is_first_around(const double *at, const double *a, const double *b) {
    const bool upper = a[1] > at[1] || (a[1] == at[1] && a[0] > at[0]);
    const bool other = b[1] > at[1] || (b[1] == at[1] && b[0] > at[0]);
    int turn;
    if (slrt_same_place(a, b) || slrt_same_place(b, at)) return false;
    if (slrt_same_place(a, at)) return true;
    if (upper != other) return upper;
    turn = slrt_turn(at, a, b);
    return turn ? turn > 0 : slrt_goes_on(at, a, b);
}

/// Of two nodes that end at a place, the one whose way comes to it from the point that is first
/// around it. The first node may be SLRT_NONE.
static uint32_t slrt_first_around(const slrt_way *w, const double *at, uint32_t a, uint32_t b) {
    uint32_t nodes[2], i;
    double from[2][2];
    nodes[0] = a;
    nodes[1] = b;
    if (a == SLRT_NONE) return b;
    for (i = 0; i < 2; i++) {
        slrt_way_node node = slrt_way_node_at(w, nodes[i]);
        if (!node.is_last) node = slrt_way_node_at(w, node.parent);
        memcpy(from[i], node.root, sizeof node.root);
    }
    return slrt_is_first_around(at, from[1], from[0]) ? b : a;
}

/// Of the nodes that turn at the same corner by ways of the same length, the one that comes to it
/// from the point that is first around it; for a node that does not turn, itself.
static uint32_t slrt_way_turning(const slrt_way *w, uint32_t number) {
    const slrt_way_node node = slrt_way_node_at(w, number);
    const uint32_t *row;
    uint32_t first = SLRT_NONE, k;
    slrt_way_node from;
    if (node.parent == SLRT_NONE) return number;
    from = slrt_way_node_at(w, node.parent);
    if (slrt_same_place(from.root, node.root)) return number;
    row = slrt_way_find(w, w->rows, 3, SLRT_WAY_ROW, node.row);
    for (k = 1; k < 3; k++) {
        if (row[k] == SLRT_NONE) continue;
        from = slrt_way_node_at(w, slrt_way_node_at(w, row[k]).parent);
        // A piece that is longer than what counts as the same leads nearer to the start.
        if (slrt_distance(from.root, node.root) > 4 * SLRT_SAME_LENGTH * node.g)
            first = slrt_first_around(w, node.root, first, row[k]);
    }
    return first == SLRT_NONE ? number : first;
}

/// The last node of the shortest way; SLRT_NONE for none, or if there is no room. Of ways of the
/// same length it is the one whose last corner is first around the goal.
static uint32_t slrt_way_search(slrt_way *w) {
    uint32_t last = SLRT_NONE;
    double most = 0;
    while (w->open_count && !w->full && w->patience) {
        const slrt_way_open least = slrt_way_open_at(w, 0);
        if (last != SLRT_NONE && least.f > most) break;
        slrt_way_pop(w);
        if (!slrt_way_node_at(w, least.node).is_last) {
            slrt_way_expand(w, least.node);
            continue;
        }
        if (last == SLRT_NONE) most = least.f * (1 + SLRT_SAME_LENGTH);
        last = slrt_first_around(w, w->to, last, least.node);
    }
    return w->full || !w->patience ? SLRT_NONE : last;
}

/// Adds a point to those of a way, which stand where the open nodes were. One in line with its
/// neighbours is no corner.
static uint32_t slrt_way_add(slrt_way *w, uint32_t count, const double *point) {
    double last[2], before[2];
    if (count) {
        memcpy(last, w->open + SLRT_WAY_OPEN_WORDS * (size_t)(count - 1), sizeof last);
        if (slrt_same_place(last, point)) return count;
    }
    for (; count > 1; count--) {
        slrt_arm to, on;
        memcpy(last, w->open + SLRT_WAY_OPEN_WORDS * (size_t)(count - 1), sizeof last);
        memcpy(before, w->open + SLRT_WAY_OPEN_WORDS * (size_t)(count - 2), sizeof before);
        to = slrt_make_arm(before[0], before[1], last[0], last[1]);
        on = slrt_make_arm(last[0], last[1], point[0], point[1]);
        if (!slrt_same_ray(&to, &on)) break;
    }
    memcpy(w->open + SLRT_WAY_OPEN_WORDS * (size_t)count, point, sizeof last);
    return count + 1;
}

/// Reads the way to a last node, from its end. There are at most as many points as nodes, and one.
static void slrt_way_read(slrt_way *w, uint32_t last, double *points, uint32_t room,
                          sl_runtime_way *out) {
    double sum = 0, rest = 0, a[2], b[2];
    uint32_t count = slrt_way_add(w, 0, w->to), i;
    for (i = last; i != SLRT_NONE;) {
        const slrt_way_node node = slrt_way_node_at(w, slrt_way_turning(w, i));
        count = slrt_way_add(w, count, node.root);
        i = node.parent;
    }
    out->count = count > 1 ? count : 2; // the two places are one
    for (i = 0; i < out->count; i++) {
        const uint32_t at = i < count ? count - 1 - i : 0;
        memcpy(b, w->open + SLRT_WAY_OPEN_WORDS * (size_t)at, sizeof b);
        if (out->count <= room) memcpy(points + 2 * (size_t)i, b, sizeof b);
        if (i) { // Knuth's sum
            const double more = slrt_distance(a, b), now = sum + more, part = now - sum;
            rest += (sum - (now - part)) + (more - part);
            sum = now;
        }
        memcpy(a, b, sizeof a);
    }
    out->length = sum + rest;
}

SL_RUNTIME_API sl_runtime_way_status sl_runtime_find_way(const sl_runtime *runtime, double x0,
                                                         double y0, double x1, double y1,
                                                         const unsigned char *shut,
                                                         uint32_t *way_scratch, uint32_t nodes,
                                                         double *points, uint32_t room,
                                                         sl_runtime_way *out) {
    const double from[2] = {slrt_no_dust(x0), slrt_no_dust(y0)};
    const double to[2] = {slrt_no_dust(x1), slrt_no_dust(y1)};
    const uint32_t start = sl_runtime_locate(runtime, from[0], from[1]);
    const uint32_t goal = sl_runtime_locate(runtime, to[0], to[1]);
    slrt_way w;
    slrt_way_node node;
    uint32_t count, last, i;
    out->count = 0;
    out->length = 0;
    if (runtime->loose || start == SL_RUNTIME_NO_CELL || goal == SL_RUNTIME_NO_CELL ||
        sl_runtime_is_solid(runtime, start) || sl_runtime_is_solid(runtime, goal))
        return SL_RUNTIME_WAY_NO_PLACE;
    slrt_way_start(&w, runtime, shut, way_scratch, nodes);
    memcpy(w.from, from, sizeof from);
    memcpy(w.to, to, sizeof to);
    slrt_way_stand(&w, to, goal, w.at_goal);
    count = slrt_way_stand(&w, from, start, w.at_start);
    memset(&node, 0, sizeof node);
    memcpy(node.root, from, sizeof from);
    node.parent = node.entry = node.row = node.turn = SLRT_NONE;
    for (i = 0; i < count; i++) {
        node.cell = w.list[i];
        slrt_way_push(&w, &node, 0);
    }
    if (!slrt_way_exists(&w, count)) return SL_RUNTIME_WAY_NONE;
    last = slrt_way_search(&w);
    if (last == SLRT_NONE)
        return w.full || !w.patience ? SL_RUNTIME_WAY_NODES : SL_RUNTIME_WAY_NONE;
    slrt_way_read(&w, last, points, room, out);
    return out->count > room ? SL_RUNTIME_WAY_ROOM : SL_RUNTIME_WAY_FOUND;
}

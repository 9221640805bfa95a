/// Maps without houses.
///
/// Maze: between any two of its squares there is just one way.
///
/// Pillars: a hall. Each pillar stands near its place on a grid, but far enough from it to reach
/// into the lines of its neighbours: no straight aisle is left.
///
/// Tunnels: chambers in solid rock, each joined with its neighbours by tunnels. A share of the
/// tunnels is open, the others are blocked half-way. After the scenes of Laine 2005, section 7: the
/// network is the same for any share, and so are the objects, one for each chamber and tunnel.
#include "study/generate/plot.h"

#include <math.h>
#include <stdio.h>

// --- a maze

enum { SQUARE = 2 }; // how wide a filtered space is

/// Of a square: whether a way leads on to the right, up; and whether the maze has come to it.
enum { TO_RIGHT = 1, UP = 2, REACHED = 4 };

typedef struct maze {
    sli_plot *plot;
    uint8_t *squares;
    uint32_t *ends; ///< squares from which the maze may still grow
    size_t end_count;
} maze;

/// A neighbour that the maze has not come to, any of them; false for none.
static bool find_new(const maze *m, uint32_t from, uint32_t *next) {
    const uint32_t columns = (uint32_t)m->plot->columns, rows = (uint32_t)m->plot->rows;
    const uint32_t x = from % columns, y = from / columns;
    uint32_t found[4];
    int count = 0;
    if (x > 0) found[count++] = from - 1;
    if (x + 1 < columns) found[count++] = from + 1;
    if (y > 0) found[count++] = from - columns;
    if (y + 1 < rows) found[count++] = from + columns;
    int kept = 0;
    for (int i = 0; i < count; i++)
        if (!(m->squares[found[i]] & REACHED)) found[kept++] = found[i];
    if (!kept) return false;
    *next = found[sli_pick(m->plot, 0, kept - 1)];
    return true;
}

static void join(maze *m, uint32_t a, uint32_t b) {
    const uint32_t first = a < b ? a : b, second = a < b ? b : a;
    m->squares[first] |= second - first == 1 && m->plot->columns > 1 ? TO_RIGHT : UP;
    m->squares[b] |= REACHED;
}

/// Grows from the newest end mostly, which makes long ways, and from any now and then, which makes
/// them branch.
static sl_status grow(maze *m) {
    m->squares[0] |= REACHED;
    m->ends[m->end_count++] = 0;
    for (uint64_t steps = 0; m->end_count; steps++) {
        if (steps % 4096 == 0) SL_TRY(sl_check_cancelled(m->plot->context));
        size_t at = m->end_count - 1;
        if (sli_chance(m->plot, 10)) at = (size_t)sl_random_below(&m->plot->random, m->end_count);
        uint32_t next;
        if (find_new(m, m->ends[at], &next)) {
            join(m, m->ends[at], next);
            m->ends[m->end_count++] = next;
        } else {
            m->ends[at] = m->ends[--m->end_count];
        }
    }
    return SL_OK;
}

/// Walls between column or row `at` - 1 and the next, in runs.
static sl_status add_line(const maze *m, bool upright, int at) {
    const int length = upright ? m->plot->rows : m->plot->columns;
    int low = 0;
    for (int i = 0; i <= length; i++) {
        const size_t x = (size_t)(upright ? at - 1 : i), y = (size_t)(upright ? i : at - 1);
        const bool filtered =
            i < length && m->squares[y * (size_t)m->plot->columns + x] & (upright ? TO_RIGHT : UP);
        if (i < length && !filtered) continue;
        SL_TRY(sli_plot_wall(m->plot, (sli_run){upright, SQUARE * at, SQUARE * low, SQUARE * i}));
        low = i + 1;
    }
    return SL_OK;
}

static sl_status add_walls(const maze *m) {
    sli_plot *plot = m->plot;
    SL_TRY(sli_plot_box(plot, (sli_rect){0, 0, SQUARE * plot->columns, SQUARE * plot->rows}));
    for (int x = 1; x < plot->columns; x++) SL_TRY(add_line(m, true, x));
    for (int y = 1; y < plot->rows; y++) {
        SL_TRY(add_line(m, false, y));
        SL_TRY(sli_plot_row_done(plot, y));
    }
    return sli_plot_start(plot, SQUARE / 2.0, SQUARE / 2.0);
}

sl_status sli_lay_maze(sli_plot *plot) {
    const size_t count = (size_t)plot->columns * (size_t)plot->rows;
    maze m = {.plot = plot,
              .squares = sl_alloc_array(plot->context, count, sizeof *m.squares),
              .ends = sl_alloc_array(plot->context, count, sizeof *m.ends)};
    sl_status status = m.squares && m.ends ? grow(&m) : SL_NO_MEMORY;
    if (status == SL_OK) status = add_walls(&m);
    sl_free(plot->context, m.squares);
    sl_free(plot->context, m.ends);
    return status;
}

// --- pillars

enum {
    PILLAR_PITCH = 16,
    SIDE_LEAST = 4,
    SIDE_MOST = 10,
    ASTRAY = 5,   // how far a pillar may be beyond its square: less than half of it
    APART = 1,    // the least way between two pillars
    ATTEMPTS = 8, // to find a place_pillar for one
};

static bool are_apart(sli_rect a, sli_rect b) {
    return a.x1 + APART <= b.x0 || b.x1 + APART <= a.x0 || a.y1 + APART <= b.y0 ||
           b.y1 + APART <= a.y0;
}

static int place_pillar(sli_plot *plot, int index, int count, int side) {
    const int low = index > 0 ? index * PILLAR_PITCH - ASTRAY : 0;
    const int high = (index + 1) * PILLAR_PITCH + (index + 1 < count ? ASTRAY : 0);
    return sli_pick(plot, low, high - side);
}

/// Whether a pillar keeps apart from those of the squares about its own that have one already.
static bool fits(const sli_plot *plot, const sli_rect *pillars, int column, int row,
                 sli_rect pillar) {
    for (int y = row > 0 ? row - 1 : 0; y <= row; y++)
        for (int x = column > 0 ? column - 1 : 0; x <= column + 1 && x < plot->columns; x++) {
            const sli_rect *other = &pillars[(size_t)y * (size_t)plot->columns + (size_t)x];
            if (other->x1 && !are_apart(*other, pillar)) return false;
        }
    return true;
}

/// No pillar where there is no place_pillar found. `pillars` are zeroed where there is none yet.
static sl_status add_pillar(sli_plot *plot, sli_rect *pillars, int column, int row) {
    for (int attempt = 0; attempt < ATTEMPTS; attempt++) {
        const int width = sli_pick(plot, SIDE_LEAST, SIDE_MOST);
        const int height = sli_pick(plot, SIDE_LEAST, SIDE_MOST);
        const int x = place_pillar(plot, column, plot->columns, width);
        const int y = place_pillar(plot, row, plot->rows, height);
        const sli_rect pillar = {x, y, x + width, y + height};
        if (!fits(plot, pillars, column, row, pillar)) continue;
        pillars[(size_t)row * (size_t)plot->columns + (size_t)column] = pillar;
        return sli_plot_box(plot, pillar);
    }
    return SL_OK;
}

static sl_status lay_hall(sli_plot *plot, sli_rect *pillars) {
    SL_TRY(sli_plot_box(plot,
                        (sli_rect){0, 0, PILLAR_PITCH * plot->columns, PILLAR_PITCH * plot->rows}));
    for (int row = 0; row < plot->rows; row++) {
        // The first square is left free for the start.
        for (int column = row == 0; column < plot->columns; column++)
            SL_TRY(add_pillar(plot, pillars, column, row));
        SL_TRY(sli_plot_row_done(plot, row));
    }
    return sli_plot_start(plot, PILLAR_PITCH / 2.0, PILLAR_PITCH / 2.0);
}

sl_status sli_lay_pillars(sli_plot *plot) {
    const size_t count = (size_t)plot->columns * (size_t)plot->rows;
    sli_rect *pillars = sl_alloc_array(plot->context, count, sizeof *pillars);
    const sl_status status = pillars ? lay_hall(plot, pillars) : SL_NO_MEMORY;
    sl_free(plot->context, pillars);
    return status;
}

// --- tunnels

enum { CHAMBER_PITCH = 12, WIDE_MOST = 2 };

/// A tunnel lies between the chamber `from` and the one to the right of it, or above.
typedef struct tunnel {
    uint32_t from;
    bool up, open;
} tunnel;

typedef struct network {
    sli_plot *plot;
    sli_rect *chambers;
    tunnel *tunnels;
    uint32_t *parts; ///< a chamber of the same part of the network, the root's own
    size_t chamber_count, tunnel_count;
} network;

static uint32_t other_end(const network *n, const tunnel *t) {
    return t->from + (t->up ? (uint32_t)n->plot->columns : 1);
}

/// All chambers have the middle of their squares, so that neighbours face each other there.
static void place_chambers(network *n) {
    for (size_t i = 0; i < n->chamber_count; i++) {
        const int x = CHAMBER_PITCH * (int)(i % (size_t)n->plot->columns);
        const int y = CHAMBER_PITCH * (int)(i / (size_t)n->plot->columns);
        n->chambers[i] = (sli_rect){x + sli_pick(n->plot, 2, 5), y + sli_pick(n->plot, 2, 5),
                                    x + sli_pick(n->plot, 7, 10), y + sli_pick(n->plot, 7, 10)};
        n->parts[i] = (uint32_t)i;
    }
}

/// Lists all tunnels, shuffles them and opens the first: those of a smaller share are open in a
/// larger one too.
static void open_tunnels(network *n) {
    for (uint32_t i = 0; i < n->chamber_count; i++) {
        if ((i + 1) % (uint32_t)n->plot->columns)
            n->tunnels[n->tunnel_count++] = (tunnel){i, false, false};
        if (i + (uint32_t)n->plot->columns < n->chamber_count)
            n->tunnels[n->tunnel_count++] = (tunnel){i, true, false};
    }
    for (size_t i = n->tunnel_count; i > 1; i--) {
        const size_t j = (size_t)sl_random_below(&n->plot->random, i);
        const tunnel swapped = n->tunnels[i - 1];
        n->tunnels[i - 1] = n->tunnels[j];
        n->tunnels[j] = swapped;
    }
    const size_t open = (size_t)floor((double)n->tunnel_count * n->plot->open / 100 + 0.5);
    for (size_t i = 0; i < open; i++) {
        tunnel *t = &n->tunnels[i];
        t->open = true;
        n->parts[sl_root_of(n->parts, other_end(n, t))] = sl_root_of(n->parts, t->from);
    }
}

static sl_status add_object(sli_plot *plot, const char *what, uint32_t chamber, sli_rect rect) {
    char name[48];
    snprintf(name, sizeof name, "%s_%u_%u", what, (unsigned)(chamber % (uint32_t)plot->columns),
             (unsigned)(chamber / (uint32_t)plot->columns));
    const sl_box box = {{rect.x0, rect.y0}, {rect.x1, rect.y1}};
    return sl_map_add_object(plot->context, plot->map, name, box, 0);
}

static int larger(int a, int b) {
    return a > b ? a : b;
}

static int smaller(int a, int b) {
    return a < b ? a : b;
}

/// Digs a tunnel between what two chambers have in common, across; notes where it breaks through
/// their walls, in `mouths`: [chamber][side] is the opening's low end, times 4, plus its width.
static sl_status dig(network *n, const tunnel *t, int (*mouths)[SLI_SIDES]) {
    sli_plot *plot = n->plot;
    const uint32_t to = other_end(n, t);
    const sli_rect a = n->chambers[t->from], b = n->chambers[to];
    const int low = t->up ? larger(a.x0, b.x0) : larger(a.y0, b.y0);
    const int high = t->up ? smaller(a.x1, b.x1) : smaller(a.y1, b.y1);
    const int wide = sli_pick(plot, 1, WIDE_MOST);
    const int at = sli_pick(plot, low, high - wide);
    const sli_rect rect =
        t->up ? (sli_rect){at, a.y1, at + wide, b.y0} : (sli_rect){a.x1, at, b.x0, at + wide};
    mouths[t->from][t->up ? SLI_TOP : SLI_RIGHT] = 4 * at + wide;
    mouths[to][t->up ? SLI_BOTTOM : SLI_LEFT] = 4 * at + wide;
    for (sl_side side = 0; side < SLI_SIDES; side++)
        if ((side == SLI_LEFT || side == SLI_RIGHT) == t->up)
            SL_TRY(sli_plot_wall(plot, sli_side_of(rect, side)));
    if (!t->open) {
        const int middle = t->up ? (rect.y0 + rect.y1) / 2 : (rect.x0 + rect.x1) / 2;
        SL_TRY(sli_plot_wall(plot, (sli_run){!t->up, middle, at, at + wide}));
    }
    return add_object(plot, t->up ? "up" : "right", t->from, rect);
}

static sl_status add_chamber(network *n, uint32_t chamber, const int mouths[SLI_SIDES]) {
    sli_plot *plot = n->plot;
    const sli_rect rect = n->chambers[chamber];
    for (sl_side side = 0; side < SLI_SIDES; side++) {
        const sli_run run = sli_side_of(rect, side);
        const int low = mouths[side] / 4, high = low + mouths[side] % 4;
        SL_TRY(mouths[side] ? sli_plot_wall_open(plot, run, low, high) : sli_plot_wall(plot, run));
    }
    if (sl_root_of(n->parts, chamber) == chamber)
        SL_TRY(sli_plot_start(plot, (rect.x0 + rect.x1) / 2.0, (rect.y0 + rect.y1) / 2.0));
    return add_object(plot, "chamber", chamber, rect);
}

static sl_status lay_network(network *n, int (*mouths)[SLI_SIDES]) {
    place_chambers(n);
    open_tunnels(n);
    for (size_t i = 0; i < n->tunnel_count; i++) SL_TRY(dig(n, &n->tunnels[i], mouths));
    const uint32_t columns = (uint32_t)n->plot->columns;
    for (uint32_t i = 0; i < n->chamber_count; i++) {
        SL_TRY(add_chamber(n, i, mouths[i]));
        if ((i + 1) % columns == 0) SL_TRY(sli_plot_row_done(n->plot, (int)(i / columns)));
    }
    return SL_OK;
}

sl_status sli_lay_tunnels(sli_plot *plot) {
    network n = {.plot = plot};
    n.chamber_count = (size_t)plot->columns * (size_t)plot->rows;
    n.chambers = sl_alloc_array(plot->context, n.chamber_count, sizeof *n.chambers);
    n.tunnels = sl_alloc_array(plot->context, 2 * n.chamber_count, sizeof *n.tunnels);
    n.parts = sl_alloc_array(plot->context, n.chamber_count, sizeof *n.parts);
    int(*mouths)[SLI_SIDES] = sl_alloc_array(plot->context, n.chamber_count, sizeof *mouths);
    const bool room = n.chambers && n.tunnels && n.parts && mouths;
    const sl_status status = room ? lay_network(&n, mouths) : SL_NO_MEMORY;
    sl_free(plot->context, mouths);
    sl_free(plot->context, n.parts);
    sl_free(plot->context, n.tunnels);
    sl_free(plot->context, n.chambers);
    return status;
}

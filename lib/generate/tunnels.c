/// Chambers in solid rock, each joined with its neighbours by tunnels, of which a share is open and
/// the others are blocked half-way. After the scenes of Laine 2005, section 7: the network is the
/// same for any share, and so are the objects, one for each chamber and tunnel.
#include "generate/plot.h"

#include <math.h>
#include <stdio.h>

enum { PITCH = 12, WIDE_MOST = 2 };

/// A tunnel lies between the chamber `from` and the one to the right of it, or above.
typedef struct tunnel {
    uint32_t from;
    bool up, open;
} tunnel;

typedef struct network {
    sl_plot *plot;
    sl_rect *chambers;
    tunnel *tunnels;
    uint32_t *parts; ///< a chamber of the same part of the network, the root's own
    size_t chamber_count, tunnel_count;
} network;

static uint32_t part_of(uint32_t *parts, uint32_t chamber) {
    while (parts[chamber] != chamber) chamber = parts[chamber] = parts[parts[chamber]];
    return chamber;
}

static uint32_t other_end(const network *n, const tunnel *t) {
    return t->from + (t->up ? (uint32_t)n->plot->columns : 1);
}

/// All chambers have the middle of their squares, so that neighbours face each other there.
static void place_chambers(network *n) {
    for (size_t i = 0; i < n->chamber_count; i++) {
        const int x = PITCH * (int)(i % (size_t)n->plot->columns);
        const int y = PITCH * (int)(i / (size_t)n->plot->columns);
        n->chambers[i] = (sl_rect){x + sl_pick(n->plot, 2, 5), y + sl_pick(n->plot, 2, 5),
                                   x + sl_pick(n->plot, 7, 10), y + sl_pick(n->plot, 7, 10)};
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
        const size_t j = sl_random_below(&n->plot->random, i);
        const tunnel swapped = n->tunnels[i - 1];
        n->tunnels[i - 1] = n->tunnels[j];
        n->tunnels[j] = swapped;
    }
    const size_t open = (size_t)floor((double)n->tunnel_count * n->plot->open / 100 + 0.5);
    for (size_t i = 0; i < open; i++) {
        tunnel *t = &n->tunnels[i];
        t->open = true;
        n->parts[part_of(n->parts, other_end(n, t))] = part_of(n->parts, t->from);
    }
}

static sl_status add_object(sl_plot *plot, const char *what, uint32_t chamber, sl_rect rect) {
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
static sl_status dig(network *n, const tunnel *t, int (*mouths)[SL_SIDES]) {
    sl_plot *plot = n->plot;
    const uint32_t to = other_end(n, t);
    const sl_rect a = n->chambers[t->from], b = n->chambers[to];
    const int low = t->up ? larger(a.x0, b.x0) : larger(a.y0, b.y0);
    const int high = t->up ? smaller(a.x1, b.x1) : smaller(a.y1, b.y1);
    const int wide = sl_pick(plot, 1, WIDE_MOST);
    const int at = sl_pick(plot, low, high - wide);
    const sl_rect rect =
        t->up ? (sl_rect){at, a.y1, at + wide, b.y0} : (sl_rect){a.x1, at, b.x0, at + wide};
    mouths[t->from][t->up ? SL_TOP : SL_RIGHT] = 4 * at + wide;
    mouths[to][t->up ? SL_BOTTOM : SL_LEFT] = 4 * at + wide;
    for (sl_side side = 0; side < SL_SIDES; side++)
        if ((side == SL_LEFT || side == SL_RIGHT) == t->up)
            SL_TRY(sl_plot_wall(plot, sl_side_of(rect, side)));
    if (!t->open) {
        const int middle = t->up ? (rect.y0 + rect.y1) / 2 : (rect.x0 + rect.x1) / 2;
        SL_TRY(sl_plot_wall(plot, (sl_run){!t->up, middle, at, at + wide}));
    }
    return add_object(plot, t->up ? "up" : "right", t->from, rect);
}

static sl_status add_chamber(network *n, uint32_t chamber, const int mouths[SL_SIDES]) {
    sl_plot *plot = n->plot;
    const sl_rect rect = n->chambers[chamber];
    for (sl_side side = 0; side < SL_SIDES; side++) {
        const sl_run run = sl_side_of(rect, side);
        const int low = mouths[side] / 4, high = low + mouths[side] % 4;
        SL_TRY(mouths[side] ? sl_plot_wall_open(plot, run, low, high) : sl_plot_wall(plot, run));
    }
    if (part_of(n->parts, chamber) == chamber)
        SL_TRY(sl_plot_start(plot, (rect.x0 + rect.x1) / 2.0, (rect.y0 + rect.y1) / 2.0));
    return add_object(plot, "chamber", chamber, rect);
}

static sl_status lay(network *n, int (*mouths)[SL_SIDES]) {
    place_chambers(n);
    open_tunnels(n);
    for (size_t i = 0; i < n->tunnel_count; i++) SL_TRY(dig(n, &n->tunnels[i], mouths));
    const uint32_t columns = (uint32_t)n->plot->columns;
    for (uint32_t i = 0; i < n->chamber_count; i++) {
        SL_TRY(add_chamber(n, i, mouths[i]));
        if ((i + 1) % columns == 0) SL_TRY(sl_plot_row_done(n->plot, (int)(i / columns)));
    }
    return SL_OK;
}

sl_status sl_lay_tunnels(sl_plot *plot) {
    network n = {.plot = plot};
    n.chamber_count = (size_t)plot->columns * (size_t)plot->rows;
    n.chambers = sl_alloc_array(plot->context, n.chamber_count, sizeof *n.chambers);
    n.tunnels = sl_alloc_array(plot->context, 2 * n.chamber_count, sizeof *n.tunnels);
    n.parts = sl_alloc_array(plot->context, n.chamber_count, sizeof *n.parts);
    int(*mouths)[SL_SIDES] = sl_alloc_array(plot->context, n.chamber_count, sizeof *mouths);
    const bool room = n.chambers && n.tunnels && n.parts && mouths;
    const sl_status status = room ? lay(&n, mouths) : SL_NO_MEMORY;
    sl_free(plot->context, mouths);
    sl_free(plot->context, n.parts);
    sl_free(plot->context, n.tunnels);
    sl_free(plot->context, n.chambers);
    return status;
}

/// A maze: between any two of its squares there is just one way.
#include "generate/plot.h"

enum { SQUARE = 2 }; // how wide a filtered space is

/// Of a square: whether a way leads on to the right, up; and whether the maze has come to it.
enum { TO_RIGHT = 1, UP = 2, REACHED = 4 };

typedef struct maze {
    sl_plot *plot;
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
    *next = found[sl_pick(m->plot, 0, kept - 1)];
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
        if (sl_chance(m->plot, 10)) at = sl_random_below(&m->plot->random, m->end_count);
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
        SL_TRY(sl_plot_wall(m->plot, (sl_run){upright, SQUARE * at, SQUARE * low, SQUARE * i}));
        low = i + 1;
    }
    return SL_OK;
}

static sl_status add_walls(const maze *m) {
    sl_plot *plot = m->plot;
    SL_TRY(sl_plot_box(plot, (sl_rect){0, 0, SQUARE * plot->columns, SQUARE * plot->rows}));
    for (int x = 1; x < plot->columns; x++) SL_TRY(add_line(m, true, x));
    for (int y = 1; y < plot->rows; y++) {
        SL_TRY(add_line(m, false, y));
        SL_TRY(sl_plot_row_done(plot, y));
    }
    return sl_plot_start(plot, SQUARE / 2.0, SQUARE / 2.0);
}

sl_status sl_lay_maze(sl_plot *plot) {
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

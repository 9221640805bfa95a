// The oracles themselves, on spaces laid out by hand: what is plainly visible, plainly hidden, and
// what only grazes must come out as such, and the two oracles must agree where both answer.
#include "oracle/oracle.h"
#include "sightline/support.h"

#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

enum { MOST = 12 };

static oracle_portal scaled(double left_x, double left_y, double right_x, double right_y,
                            double scale) {
    return (oracle_portal){{left_x * scale, left_y * scale}, {right_x * scale, right_y * scale}};
}

typedef struct gate {
    double low, high;
} gate;

/// Gates crossed towards +x at x = 0, 1, 2 ..., from low to high.
static sl_stab_verdict stab_gates(const gate gates[], size_t count, double scale) {
    oracle_portal portals[MOST];
    for (size_t i = 0; i < count; i++) {
        portals[i] = scaled((double)i, gates[i].high, (double)i, gates[i].low, scale);
    }
    return oracle_stab(portals, count);
}

static void test_stab_gates(void **state) {
    (void)state;
    const double scales[] = {1, 0x1p-400, 0x1p400, 3};
    const gate single[] = {{0, 1}}, same[] = {{0, 1}, {0, 1}, {0, 1}};
    const gate zigzag[] = {{0, 1}, {2, 3}, {0, 1}}, slanted[] = {{0, 1}, {2, 3}, {4, 5}};
    const gate touching[] = {{0, 1}, {1, 2}, {0, 1}};
    const gate pinched[] = {{0, 1}, {1, 2}, {2, 3}, {3, 3.5}, {0, 3}};
    for (size_t i = 0; i < sizeof scales / sizeof *scales; i++) {
        assert_int_equal(stab_gates(single, 1, scales[i]), SL_STABBED);
        assert_int_equal(stab_gates(same, 3, scales[i]), SL_STABBED);
        assert_int_equal(stab_gates(zigzag, 2, scales[i]), SL_STABBED);
        assert_int_equal(stab_gates(zigzag, 3, scales[i]), SL_HIDDEN);
        assert_int_equal(stab_gates(slanted, 3, scales[i]), SL_STABBED);
        assert_int_equal(stab_gates(touching, 3, scales[i]), SL_GRAZING);
        assert_int_equal(stab_gates(pinched, 4, scales[i]), SL_STABBED);
        assert_int_equal(stab_gates(pinched, 5, scales[i]), SL_HIDDEN);
    }
}

static void test_stab_decides_by_the_last_bit(void **state) {
    (void)state;
    gate gates[] = {{0, 1}, {1, 2}, {0, 1}};
    gates[1].low = nextafter(1, 0);
    assert_int_equal(stab_gates(gates, 3, 1), SL_STABBED);
    gates[1].low = nextafter(1, 2);
    assert_int_equal(stab_gates(gates, 3, 1), SL_HIDDEN);
    // Coordinates far apart in magnitude: nothing is lost between 1e-150 and 1e150.
    gate far[] = {{-1e150, 1e-150}, {1e-150, 1e150}, {-1e150, 1e-150}};
    assert_int_equal(stab_gates(far, 3, 1), SL_GRAZING);
    far[1].low = 2e-150;
    assert_int_equal(stab_gates(far, 3, 1), SL_HIDDEN);
}

static void test_stab_round_corners(void **state) {
    (void)state;
    // To the right, up, and right again; and up a stair that turns back.
    const oracle_portal right = {{1, 1}, {1, 0}}, up = {{1, 1}, {2, 1}}, on = {{2, 2}, {2, 1}};
    const oracle_portal back = {{1, 1}, {1, 2}}, far = {{2, 3}, {2, 2}}, low = {{5, 1.2}, {5, 1}};
    assert_int_equal(oracle_stab((const oracle_portal[]){right, up}, 2), SL_STABBED);
    assert_int_equal(oracle_stab((const oracle_portal[]){right, up, on}, 3), SL_STABBED);
    assert_int_equal(oracle_stab((const oracle_portal[]){right, up, far}, 3), SL_STABBED);
    assert_int_equal(oracle_stab((const oracle_portal[]){right, up, far, low}, 4), SL_HIDDEN);
    // Crossed both ways: no direction does.
    assert_int_equal(oracle_stab((const oracle_portal[]){right, up, back}, 3), SL_HIDDEN);
    // Three oblique portals that close a half turn pairwise, though no two are opposed.
    const oracle_portal turns[] = {{{0, 1}, {0, 0}}, {{0, 0}, {2, 1}}, {{3, 0}, {0, 1}}};
    oracle_sequence *sequence = oracle_sequence_create(NULL, 0);
    assert_true(oracle_sequence_forwards(sequence, turns[0]));
    oracle_sequence_push(sequence, turns[0]);
    assert_true(oracle_sequence_forwards(sequence, turns[1]));
    oracle_sequence_push(sequence, turns[1]);
    assert_false(oracle_sequence_forwards(sequence, turns[2]));
    oracle_sequence_pop(sequence);
    oracle_sequence_destroy(sequence);
}

/// A space of rectangles in the caller's arrays, made without the library.
typedef struct layout {
    sl_space space;
    sl_cell cells[MOST];
    sl_point vertices[4 * MOST];
    sl_directed_portal directed[8 * MOST];
    sl_wall walls[8 * MOST];
    size_t wall_count;
    sl_portal portals[4 * MOST];
    size_t portal_count;
} layout;

static void add_cell(layout *l, double x0, double y0, double x1, double y1) {
    sl_cell *cell = &l->cells[l->space.cell_count];
    *cell = (sl_cell){.first_vertex = 4 * l->space.cell_count++, .vertex_count = 4};
    sl_point *v = l->vertices + cell->first_vertex;
    v[0] = (sl_point){x0, y0};
    v[1] = (sl_point){x1, y0};
    v[2] = (sl_point){x1, y1};
    v[3] = (sl_point){x0, y1};
    l->space.vertex_count += 4;
}

static void add_wall(layout *l, double x0, double y0, double x1, double y1) {
    l->walls[l->wall_count++] = (sl_wall){{x0, y0}, {x1, y1}, 0, 0};
}

/// Crossed from cell a to cell b.
static void add_portal(layout *l, uint32_t a, uint32_t b, double left_x, double left_y,
                       double right_x, double right_y) {
    l->portals[l->portal_count++] = (sl_portal){{a, b}, {left_x, left_y}, {right_x, right_y}};
}

static void close_layout(layout *l) {
    uint32_t directed = 0;
    for (uint32_t c = 0; c < l->space.cell_count; c++) {
        l->cells[c].first_directed = directed;
        for (uint32_t p = 0; p < l->portal_count; p++) {
            const sl_portal *portal = &l->portals[p];
            if (portal->cell[0] == c) {
                l->directed[directed++] =
                    (sl_directed_portal){p, portal->cell[1], portal->left, portal->right};
            } else if (portal->cell[1] == c) {
                l->directed[directed++] =
                    (sl_directed_portal){p, portal->cell[0], portal->right, portal->left};
            }
        }
        l->cells[c].directed_count = directed - l->cells[c].first_directed;
    }
    l->space.cells = l->cells;
    l->space.vertices = l->vertices;
    l->space.directed = l->directed;
    l->space.directed_count = directed;
}

/// One or two gaps in a wall; the second is empty for one.
typedef struct gaps {
    gate gap[2];
} gaps;

/// Columns of width 1 and the given height, with gaps in every wall between them.
static void add_columns(layout *l, uint32_t columns, double height, const gaps between[]) {
    for (uint32_t i = 0; i < columns; i++) add_cell(l, i, 0, i + 1, height);
    for (uint32_t i = 0; i + 1 < columns; i++) {
        double from = 0, x = i + 1;
        for (int g = 0; g < 2 && between[i].gap[g].low < between[i].gap[g].high; g++) {
            add_portal(l, i, i + 1, x, between[i].gap[g].high, x, between[i].gap[g].low);
            if (from < between[i].gap[g].low) add_wall(l, x, from, x, between[i].gap[g].low);
            from = between[i].gap[g].high;
        }
        if (from < height) add_wall(l, x, from, x, height);
    }
    close_layout(l);
}

typedef struct answers {
    bool closed[MOST * MOST], open[MOST * MOST], by_lines[MOST * MOST];
} answers;

static answers *ask(const layout *l) {
    const char *reason;
    answers *a = calloc(1, sizeof *a);
    assert_non_null(a);
    assert_true(oracle_by_sequences(&l->space, UINT64_MAX, a->closed, a->open));
    assert_true(oracle_by_lines(&l->space, l->walls, l->wall_count, a->by_lines, &reason));
    return a;
}

/// The row of a cell as text: o seen, + by grazing lines only, . hidden; "?" where oracles
/// disagree.
static const char *row(const answers *a, uint32_t cells, uint32_t cell, char *text) {
    for (uint32_t i = 0; i < cells; i++) {
        size_t at = cell * cells + i;
        text[i] = a->closed[at] ? '+' : '.';
        if (a->open[at]) text[i] = a->closed[at] ? 'o' : '?';
        if (a->open[at] != a->by_lines[at]) text[i] = '?';
    }
    text[cells] = 0;
    return text;
}

static void test_columns(void **state) {
    (void)state;
    char text[MOST + 1];
    layout l = {0};
    const gaps between[] = {{{{0, 1}}}, {{{1, 2}}}, {{{0, 1}}}, {{{3, 4}}}};
    add_columns(&l, 5, 4, between);
    answers *a = ask(&l);
    assert_string_equal(row(a, 5, 0, text), "ooo+.");
    assert_string_equal(row(a, 5, 1, text), "oooo.");
    assert_string_equal(row(a, 5, 2, text), "ooooo");
    assert_string_equal(row(a, 5, 3, text), "+oooo");
    assert_string_equal(row(a, 5, 4, text), "..ooo");
    free(a);
}

static void test_corner(void **state) {
    (void)state;
    // Four squares round (1, 1) with a wall between the first and the last: no way round the end.
    char text[MOST + 1];
    layout l = {0};
    add_cell(&l, 0, 0, 1, 1);
    add_cell(&l, 1, 0, 2, 1);
    add_cell(&l, 1, 1, 2, 2);
    add_cell(&l, 0, 1, 1, 2);
    add_portal(&l, 0, 1, 1, 1, 1, 0);
    add_portal(&l, 1, 2, 1, 1, 2, 1);
    add_portal(&l, 2, 3, 1, 1, 1, 2);
    add_wall(&l, 0, 1, 1, 1);
    close_layout(&l);
    answers *a = ask(&l);
    assert_string_equal(row(a, 4, 0, text), "ooo.");
    assert_string_equal(row(a, 4, 1, text), "oooo");
    assert_string_equal(row(a, 4, 3, text), ".ooo");
    free(a);
}

static void test_lines_ask_for_sound_input(void **state) {
    (void)state;
    const char *reason;
    bool open[MOST * MOST] = {0};
    layout l = {0};
    const gaps between[] = {{{{0, 1}}}, {{{1, 2}}}};
    add_columns(&l, 3, 4, between);
    add_wall(&l, 0, 3, 0.5, 3);
    assert_false(oracle_by_lines(&l.space, l.walls, l.wall_count, open, &reason));
    assert_string_equal(reason, "a wall passes through a cell");
    l.walls[l.wall_count - 1].b.y = 0.1;
    assert_false(oracle_by_lines(&l.space, l.walls, l.wall_count, open, &reason));
    assert_string_equal(reason, "coordinates are no small multiples of one power of two");
}

static void test_search_ends_at_its_limit(void **state) {
    (void)state;
    bool closed[MOST * MOST] = {0}, open[MOST * MOST] = {0};
    layout l = {0};
    const gaps between[] = {{{{0, 1}}}, {{{1, 2}}}};
    add_columns(&l, 3, 4, between);
    assert_false(oracle_by_sequences(&l.space, 3, closed, open));
}

static void test_random_columns(void **state) {
    (void)state;
    size_t grazing = 0, hidden = 0;
    for (uint64_t seed = 1; seed <= 150; seed++) {
        sl_random random = {seed};
        uint32_t columns = 3 + (uint32_t)sl_random_below(&random, MOST - 4);
        gaps between[MOST];
        for (uint32_t i = 0; i < columns; i++) {
            double low = (double)sl_random_below(&random, 6);
            double middle = low + 1 + (double)sl_random_below(&random, 4);
            double end =
                middle + (double)sl_random_below(&random, 4); // often there is no second gap
            between[i] = (gaps){{{low, middle}, {middle + 1, end}}};
        }
        layout l = {0};
        add_columns(&l, columns, 14, between);
        answers *a = ask(&l);
        for (uint32_t i = 0; i < columns * columns; i++) {
            assert_int_equal(a->open[i], a->by_lines[i]);
            assert_true(a->closed[i] || !a->open[i]);
            assert_int_equal(a->closed[i], a->closed[i % columns * columns + i / columns]);
            grazing += a->closed[i] && !a->open[i];
            hidden += !a->closed[i];
        }
        free(a);
    }
    assert_true(grazing > 0 && hidden > 0);
}

/// Lines are a compact set: a sequence has a closed sightline iff it has an open one however little
/// every portal is widened. On small integers a narrow miss is far wider than this widening.
static void test_closed_is_open_of_the_widened(void **state) {
    (void)state;
    const double wider = 0x1p-40;
    size_t grazing = 0;
    for (uint64_t seed = 1; seed <= 3000; seed++) {
        sl_random random = {seed};
        size_t count = 3 + sl_random_below(&random, 4);
        gate gates[MOST], widened[MOST];
        for (size_t i = 0; i < count; i++) {
            gates[i].low = (double)sl_random_below(&random, 8);
            gates[i].high = gates[i].low + 1 + (double)sl_random_below(&random, 4);
            widened[i].low = gates[i].low - wider;
            widened[i].high = gates[i].high + wider;
        }
        sl_stab_verdict verdict = stab_gates(gates, count, 1);
        sl_stab_verdict wide = stab_gates(widened, count, 1);
        assert_int_equal(verdict != SL_HIDDEN, wide == SL_STABBED);
        grazing += verdict == SL_GRAZING;
    }
    assert_true(grazing > 100);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_stab_gates),
        cmocka_unit_test(test_stab_decides_by_the_last_bit),
        cmocka_unit_test(test_stab_round_corners),
        cmocka_unit_test(test_columns),
        cmocka_unit_test(test_corner),
        cmocka_unit_test(test_lines_ask_for_sound_input),
        cmocka_unit_test(test_search_ends_at_its_limit),
        cmocka_unit_test(test_random_columns),
        cmocka_unit_test(test_closed_is_open_of_the_widened),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}

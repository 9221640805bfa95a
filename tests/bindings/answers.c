/// Answers of the runtime header and of the library about a baked file, for tests of bindings:
/// answers FILE.slv < QUESTIONS. A question is a line, its answer is a line of numbers.
///
///     l x y                            cell, or -1
///     c a b                            1 if cell a can see cell b, with the doors as they stand
///     p x0 y0 x1 y1                    1 if the points see each other (by the library)
///     k x y full rx ry lx ly range     cells that an eye sees
///     v x y full rx ry lx ly range     the polygon that it sees
///     d number shut                    shuts or opens a door; no answer
#include "sightline/query.h"
#include "sightline/support.h"

#define SIGHTLINE_RUNTIME_IMPLEMENTATION
#include "runtime/sightline_runtime.h"

#include <stdlib.h>
#include <string.h>

typedef struct answerer {
    sl_context *context;
    sl_query *query;
    sl_runtime level;
    unsigned char *shut;
    uint32_t *scratch, *cells;
    double *points;
    uint32_t room;
} answerer;

/// A number of the question that is being read.
static double number(void) {
    return strtod(strtok(NULL, " \n"), NULL);
}

static sl_runtime_view view(void) {
    sl_runtime_view v = {.x = number(), .y = number(), .all_round = number() != 0};
    for (int i = 0; i < 2; i++) v.right[i] = number();
    for (int i = 0; i < 2; i++) v.left[i] = number();
    return v;
}

static void look(const answerer *a) {
    const sl_runtime_view v = view();
    const uint32_t count = sl_runtime_look_past(&a->level, &v, a->shut, number(), a->scratch,
                                                a->cells, a->level.cell_count);
    for (uint32_t i = 0; i < count; i++) printf("%s%u", i ? " " : "", (unsigned)a->cells[i]);
    putchar('\n');
}

static void polygon(answerer *a) {
    const sl_runtime_view v = view();
    const double range = number();
    uint32_t count;
    while ((count = sl_runtime_visible_polygon(&a->level, &v, a->shut, range, a->scratch, a->points,
                                               a->room)) > a->room) {
        a->room = count;
        a->points = realloc(a->points, 2 * sizeof *a->points * a->room);
        if (!a->points) abort();
    }
    for (uint32_t i = 0; i < 2 * count; i++) printf("%s%.17g", i ? " " : "", a->points[i]);
    putchar('\n');
}

static void set_door(answerer *a) {
    const uint32_t door = (uint32_t)number();
    a->shut[door] = number() != 0;
    const char *name = sl_query_baked(a->query)->map.doors[door].name;
    if (sl_query_set_door(a->context, a->query, name, !a->shut[door]) != SL_OK) abort();
}

static void points_see(const answerer *a) {
    const sl_point eye = {number(), number()}, to = {number(), number()};
    bool sees = false;
    if (sl_query_can_see(a->context, a->query, eye, to, &sees) != SL_OK) abort();
    printf("%d\n", sees);
}

static void answer(answerer *a, const char *kind) {
    if (*kind == 'l') {
        const double x = number(), y = number();
        const uint32_t cell = sl_runtime_locate(&a->level, x, y);
        printf("%lld\n", cell == SL_RUNTIME_NO_CELL ? -1LL : (long long)cell);
    } else if (*kind == 'c') {
        const uint32_t from = (uint32_t)number(), to = (uint32_t)number();
        printf("%d\n", sl_runtime_can_see_past(&a->level, from, to, a->shut));
    } else if (*kind == 'p')
        points_see(a);
    else if (*kind == 'k')
        look(a);
    else if (*kind == 'v')
        polygon(a);
    else
        set_door(a);
}

int main(int argc, char **argv) {
    answerer a = {.context = sl_context_create(NULL)};
    sl_bytes file = {0};
    char line[1024];
    if (argc != 2 || !a.context || sl_file_read(a.context, argv[1], &file) != SL_OK) return 2;
    if (sl_query_open(a.context, argv[1], &a.query) != SL_OK) return 2;
    if (sl_runtime_open(file.data, file.size, &a.level) != SL_RUNTIME_OK) return 2;
    a.shut = calloc(a.level.door_count + 1, 1);
    a.scratch = calloc(sl_runtime_scratch_count(&a.level), sizeof *a.scratch);
    a.cells = calloc(a.level.cell_count, sizeof *a.cells);
    if (!a.shut || !a.scratch || !a.cells) return 2;
    for (uint32_t i = 0; i < a.level.door_count; i++)
        a.shut[i] = !sl_runtime_door_open(&a.level, i);
    while (fgets(line, sizeof line, stdin)) answer(&a, strtok(line, " \n"));
    free(a.points);
    free(a.cells);
    free(a.scratch);
    free(a.shut);
    sl_query_destroy(a.context, a.query);
    sl_free(a.context, file.data);
    sl_context_destroy(a.context);
    return 0;
}

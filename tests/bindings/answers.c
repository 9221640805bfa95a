/// Answers of the runtime header and of the library about a baked file, for tests of bindings:
/// answers FILE.slv < QUESTIONS. A question is a line, its answer is a line of numbers.
///
///     l x y                            cell, or -1
///     c a b                            1 if cell a can see cell b, with the doors as they stand
///     p x0 y0 x1 y1                    1 if the points see each other (by the library)
///     k x y full rx ry lx ly range     cells that an eye sees
///     C a b, K x y ...                 likewise, directly or by mirror; K: how many directly, then
///                                      the cells
///     s a b, S a b                     cells seen from anywhere in a or b; S: or by mirror
///     m                                what the file holds of mirrors (sl_runtime_mirrors)
///     v x y full rx ry lx ly range     the polygon that it sees
///     d number shut                    shuts or opens a door; no answer
///     b count                          so many boxes, which are nowhere; no answer
///     bm box x0 y0 x1 y1 blocks        moves a box; no answer
///     bk, bv x y full ... range        as k and v, past boxes
///     bs x y full ... range            1 or 0 for each box: whether the eye sees it
///     bp x0 y0 x1 y1                   1 if the points see each other past boxes
///     bw x0 y0 x1 y1 box               1 if one may walk there; its own box, or -1
///     tk x y ..., tv ..., tr ...       microseconds that cells, polygons or (library) regions of
///                                      these eyes take together: the least of several times
#include "sightline/bake.h"
#include "sightline/support.h"

#include "runtime/sightline_runtime.h"

#include <math.h>
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
    sl_region region;
    sl_runtime_boxes boxes;
    uint32_t *boxes_scratch;
    unsigned char *seen;
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

static void look(const answerer *a, bool past_boxes) {
    const sl_runtime_view v = view();
    const double range = number();
    const uint32_t most = a->level.cell_count;
    const uint32_t count =
        past_boxes
            ? sl_runtime_look_past_boxes(&a->boxes, &v, a->shut, range, a->boxes_scratch, a->seen,
                                         a->cells, most)
            : sl_runtime_look_past(&a->level, &v, a->shut, range, a->scratch, a->cells, most);
    for (uint32_t i = 0; i < count; i++) printf("%s%u", i ? " " : "", (unsigned)a->cells[i]);
    putchar('\n');
}

static void look_mirrored(const answerer *a) {
    const sl_runtime_view v = view();
    uint32_t direct;
    const uint32_t count = sl_runtime_look_mirrored(&a->level, &v, a->shut, number(), a->scratch,
                                                    a->cells, a->level.cell_count, &direct);
    printf("%u", (unsigned)direct);
    for (uint32_t i = 0; i < count; i++) printf(" %u", (unsigned)a->cells[i]);
    putchar('\n');
}

static void seen_from(const answerer *a, bool mirrored) {
    const uint32_t cells[] = {(uint32_t)number(), (uint32_t)number()};
    unsigned char *bits = (unsigned char *)a->scratch;
    const char *between = "";
    (mirrored ? sl_runtime_seen_from_mirrored : sl_runtime_seen_from)(&a->level, cells, 2, a->shut,
                                                                      bits);
    for (uint32_t i = 0; i < a->level.cell_count; i++) {
        if (!(bits[i / 8] >> i % 8 & 1)) continue;
        printf("%s%u", between, (unsigned)i);
        between = " ";
    }
    putchar('\n');
}

static void polygon(answerer *a, bool past_boxes) {
    const sl_runtime_view v = view();
    const double range = number();
    uint32_t count;
    while ((count = past_boxes
                        ? sl_runtime_visible_polygon_past_boxes(
                              &a->boxes, &v, a->shut, range, a->boxes_scratch, a->points, a->room)
                        : sl_runtime_visible_polygon(&a->level, &v, a->shut, range, a->scratch,
                                                     a->points, a->room)) > a->room) {
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
    const char *name = sl_query_map(a->query)->doors[door].name;
    if (sl_query_set_door(a->context, a->query, name, !a->shut[door]) != SL_OK) abort();
}

static void points_see(const answerer *a) {
    const sl_point eye = {number(), number()}, to = {number(), number()};
    bool sees = false;
    if (sl_query_sees(a->context, a->query, eye, to, &sees) != SL_OK) abort();
    printf("%d\n", sees);
}

/// What an eye all round sees, by the kind of question.
static void ask(answerer *a, char kind, sl_point eye) {
    const sl_runtime_view v = sl_runtime_view_all_round(eye.x, eye.y);
    const sl_view view = sl_query_view(a->query, eye, 0, 360);
    if (kind == 'k')
        sl_runtime_look_past(&a->level, &v, a->shut, 0, a->scratch, a->cells, a->level.cell_count);
    else if (kind == 'v')
        sl_runtime_visible_polygon(&a->level, &v, a->shut, 0, a->scratch, a->points, a->room);
    else if (sl_query_region(a->context, a->query, &view, &a->region) != SL_OK)
        abort();
}

static void take_time(answerer *a, char kind) {
    enum { RUNS = 9, MOST = 10000 };
    static sl_point eyes[MOST];
    size_t count = 0;
    double least = INFINITY;
    for (char *word; count < MOST && (word = strtok(NULL, " \n")); count++) {
        eyes[count].x = strtod(word, NULL);
        eyes[count].y = number();
    }
    for (int run = 0; run < RUNS; run++) {
        const double from = sl_seconds();
        for (size_t i = 0; i < count; i++) ask(a, kind, eyes[i]);
        least = fmin(least, sl_seconds() - from);
    }
    printf("%.17g\n", 1e6 * least);
}

static void start_boxes(answerer *a) {
    enum { PAIRS = 64 }; // of a box and a cell, for each box: more than any test has
    const uint32_t count = (uint32_t)number();
    const size_t size = sl_runtime_boxes_count(&a->level, count, PAIRS * count);
    free(a->boxes.boxes);
    free(a->boxes.memory);
    free(a->boxes_scratch);
    free(a->seen);
    sl_runtime_box *list = calloc(count, sizeof *list);
    uint32_t *memory = calloc(size, sizeof *memory);
    a->seen = calloc(count, 1);
    if (!list || !memory || !a->seen) abort();
    sl_runtime_boxes_start(&a->boxes, &a->level, list, count, PAIRS * count, memory);
    a->boxes_scratch = calloc(sl_runtime_boxes_scratch_count(&a->boxes), sizeof *a->boxes_scratch);
    if (!a->boxes_scratch) abort();
}

static void boxes_seen(const answerer *a) {
    const sl_runtime_view v = view();
    sl_runtime_boxes_seen(&a->boxes, &v, a->shut, number(), a->boxes_scratch, a->seen);
    for (uint32_t i = 0; i < a->boxes.count; i++) printf("%s%d", i ? " " : "", a->seen[i]);
    putchar('\n');
}

/// What is asked of boxes, by the letter after the b.
static void answer_boxes(answerer *a, char kind) {
    if (kind == 'k')
        look(a, true);
    else if (kind == 'v')
        polygon(a, true);
    else if (kind == 's')
        boxes_seen(a);
    else if (kind == 'm') {
        const uint32_t box = (uint32_t)number();
        sl_runtime_box to = {number(), number(), number(), number(), false};
        to.blocks = number() != 0;
        if (!sl_runtime_boxes_move(&a->boxes, box, &to)) abort();
    } else if (kind == 'p' || kind == 'w') {
        const sl_point from = {number(), number()}, to = {number(), number()};
        printf("%d\n", kind == 'p'
                           ? sl_runtime_sees_past_boxes(&a->boxes, from.x, from.y, to.x, to.y,
                                                        a->shut, 0, a->boxes_scratch)
                           : sl_runtime_can_walk_past_boxes(&a->boxes, from.x, from.y, to.x, to.y,
                                                            a->shut, (uint32_t)(int)number()));
    } else
        start_boxes(a);
}

static void answer(answerer *a, const char *kind) {
    if (*kind == 'l') {
        const double x = number(), y = number();
        const uint32_t cell = sl_runtime_locate(&a->level, x, y);
        printf("%lld\n", cell == SL_RUNTIME_NO_CELL ? -1LL : (long long)cell);
    } else if (*kind == 'c') {
        const uint32_t from = (uint32_t)number(), to = (uint32_t)number();
        printf("%d\n", sl_runtime_can_see_past(&a->level, from, to, a->shut));
    } else if (*kind == 'C') {
        const uint32_t from = (uint32_t)number(), to = (uint32_t)number();
        printf("%d\n", sl_runtime_can_see_mirrored(&a->level, from, to, a->shut));
    } else if (*kind == 's' || *kind == 'S')
        seen_from(a, *kind == 'S');
    else if (*kind == 'm')
        printf("%d\n", (int)a->level.mirrors);
    else if (*kind == 'K')
        look_mirrored(a);
    else if (*kind == 'p')
        points_see(a);
    else if (*kind == 't')
        take_time(a, kind[1]);
    else if (*kind == 'k')
        look(a, false);
    else if (*kind == 'v')
        polygon(a, false);
    else if (*kind == 'b')
        answer_boxes(a, kind[1]);
    else
        set_door(a);
}

int main(int argc, char **argv) {
    answerer a = {.context = sl_context_create(NULL)};
    sl_bytes file = {0};
    static char line[1 << 20];
    if (argc != 2 || !a.context || sl_file_read(a.context, argv[1], &file) != SL_OK) return 2;
    if (sl_query_open(a.context, argv[1], &a.query) != SL_OK) return 2;
    if (sl_runtime_open(file.data, file.size, &a.level) != SL_RUNTIME_OK) return 2;
    a.shut = calloc(a.level.door_count + 1, 1);
    a.scratch = calloc(sl_runtime_scratch_count(&a.level), sizeof *a.scratch);
    a.cells = calloc(a.level.cell_count, sizeof *a.cells);
    a.room = 4096;
    a.points = calloc(a.room, 2 * sizeof *a.points);
    if (!a.shut || !a.scratch || !a.cells || !a.points) return 2;
    for (uint32_t i = 0; i < a.level.door_count; i++)
        a.shut[i] = !sl_runtime_door_open(&a.level, i);
    while (fgets(line, sizeof line, stdin)) answer(&a, strtok(line, " \n"));
    sl_region_destroy(a.context, &a.region);
    free(a.boxes.boxes);
    free(a.boxes.memory);
    free(a.boxes_scratch);
    free(a.seen);
    free(a.points);
    free(a.cells);
    free(a.scratch);
    free(a.shut);
    sl_query_destroy(a.context, a.query);
    sl_free(a.context, file.data);
    sl_context_destroy(a.context);
    return 0;
}

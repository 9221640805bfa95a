// What a server pays for a tick: 64 players, 1,000 things, and who may see what before the next
// tick; beside what it could do with the calls for one eye.
//   bench_relevant KIND:N[:DEGREES]    a generated map, turned: office:40:17
//   bench_relevant MAP [Z]             a map file, and the height of its slice or its level
//   bench_relevant FILE.slv            a baked file
// Players and things are 0.6 wide, and the margin is 0.4: doors of generated maps are 1 wide.
// CSV: map, cells, what was asked, milliseconds a tick, times the first's, pairs, pairs missed and
// added in percent. By 2,000 rays a pair that the first says; rays may miss, so `added` is a bound.
#include "bench.h"

#include "baked_bytes.h"
#include "sightline/sightline.h"
#include "sightline/support.h"

#define SIGHTLINE_RUNTIME_IMPLEMENTATION
#include "runtime/sightline_runtime.h"

#include <math.h>

enum {
    PLAYERS = 64,
    THINGS = 1000,
    STRIDE = (THINGS + 7) / 8,
    ROUNDS = 15,
    RAYS = 2000,
    ROOM = 64
};

static const double half = 0.3, margin = 0.4;

typedef unsigned char pairs[PLAYERS * STRIDE];

typedef struct bench {
    sl_runtime runtime;
    sl_runtime_box players[PLAYERS], things[THINGS];
    uint32_t *scratch, *relevant_scratch;
    unsigned char *cell_bits;
} bench;

static void *room(size_t count, size_t size) {
    void *block = calloc(count ? count : 1, size);
    if (!block) bench_fail("out of memory");
    return block;
}

static void say(unsigned char *bits, size_t player, size_t thing) {
    bits[player * STRIDE + thing / 8] |= (unsigned char)(1 << thing % 8);
}

static bool says(const unsigned char *bits, size_t player, size_t thing) {
    return bits[player * STRIDE + thing / 8] >> thing % 8 & 1;
}

/// A place in the player's box, grown, or the thing's: t from 0 to 1 along each axis.
static sl_point place(const sl_runtime_box *box, double grown, double x, double y) {
    const double low_x = box->min_x - grown, low_y = box->min_y - grown;
    return (sl_point){low_x + x * (box->max_x + grown - low_x),
                      low_y + y * (box->max_y + grown - low_y)};
}

static bool ray(const bench *b, size_t player, size_t thing, const double t[4]) {
    const sl_point p = place(&b->players[player], margin, t[0], t[1]);
    const sl_point q = place(&b->things[thing], 0, t[2], t[3]);
    return sl_runtime_sees(&b->runtime, p.x, p.y, q.x, q.y, NULL, 0, b->scratch);
}

// --- the questions: each fills the pairs of a tick

typedef void question(const bench *b, unsigned char *bits);

static void ask_relevant(const bench *b, unsigned char *bits) {
    sl_runtime_relevant(&b->runtime, b->players, PLAYERS, margin, b->things, THINGS, NULL, 0,
                        b->relevant_scratch, bits);
}

/// The cells that can be seen from those of the player's grown box.
static void ask_rows(const bench *b, unsigned char *bits) {
    static uint32_t cells[THINGS][ROOM], counts[THINGS];
    const sl_runtime *r = &b->runtime;
    for (size_t k = 0; k < THINGS; k++) {
        const sl_runtime_box *t = &b->things[k];
        counts[k] = sl_runtime_box_cells(r, t->min_x, t->min_y, t->max_x, t->max_y, cells[k], ROOM);
        if (counts[k] > ROOM) bench_fail("a thing is in too many cells");
    }
    for (size_t i = 0; i < PLAYERS; i++) {
        const sl_point low = place(&b->players[i], margin, 0, 0);
        const sl_point high = place(&b->players[i], margin, 1, 1);
        uint32_t from[ROOM];
        const uint32_t count = sl_runtime_box_cells(r, low.x, low.y, high.x, high.y, from, ROOM);
        if (count > ROOM) bench_fail("a player is in too many cells");
        sl_runtime_seen_from(r, from, count, NULL, b->cell_bits);
        for (size_t k = 0; k < THINGS; k++)
            for (uint32_t c = 0; c < counts[k]; c++)
                if (b->cell_bits[cells[k][c] / 8] >> cells[k][c] % 8 & 1) say(bits, i, k);
    }
}

/// From the middle and the corners of the player's grown box, the things that an eye sees.
static void ask_five_looks(const bench *b, unsigned char *bits) {
    static const double at[5][2] = {{0.5, 0.5}, {0, 0}, {1, 0}, {0, 1}, {1, 1}};
    static sl_runtime_box list[THINGS];
    static unsigned char seen[THINGS];
    const size_t size = sl_runtime_boxes_count(&b->runtime, THINGS, ROOM * THINGS);
    uint32_t *memory = room(size, sizeof *memory);
    sl_runtime_boxes boxes;
    sl_runtime_boxes_start(&boxes, &b->runtime, list, THINGS, ROOM * THINGS, memory);
    uint32_t *scratch = room(sl_runtime_boxes_scratch_count(&boxes), sizeof *scratch);
    for (uint32_t k = 0; k < THINGS; k++) sl_runtime_boxes_move(&boxes, k, &b->things[k]);
    for (size_t i = 0; i < PLAYERS; i++)
        for (size_t m = 0; m < 5; m++) {
            const sl_point eye = place(&b->players[i], margin, at[m][0], at[m][1]);
            const sl_runtime_view view = sl_runtime_view_all_round(eye.x, eye.y);
            sl_runtime_boxes_seen(&boxes, &view, NULL, 0, scratch, seen);
            for (size_t k = 0; k < THINGS; k++)
                if (seen[k]) say(bits, i, k);
        }
    free(scratch);
    free(memory);
}

/// From three places of the player's grown box to three of the thing's, for each pair.
static void ask_nine_rays(const bench *b, unsigned char *bits) {
    static const double at[3][2] = {{0.5, 0.5}, {0, 0.9}, {1, 0.1}};
    for (size_t i = 0; i < PLAYERS; i++)
        for (size_t k = 0; k < THINGS; k++)
            for (int m = 0; m < 9 && !says(bits, i, k); m++) {
                const double t[4] = {at[m / 3][0], at[m / 3][1], at[m % 3][0], at[m % 3][1]};
                if (ray(b, i, k, t)) say(bits, i, k);
            }
}

static void ask_each_pair(const bench *b, unsigned char *bits) {
    for (size_t i = 0; i < PLAYERS; i++)
        for (size_t k = 0; k < THINGS; k++) {
            const sl_point p = place(&b->players[i], 0, 0.5, 0.5);
            const sl_point q = place(&b->things[k], 0, 0.5, 0.5);
            if (sl_runtime_sees_within(&b->runtime, p.x, p.y, half + margin, q.x, q.y, half, NULL,
                                       0, b->scratch))
                say(bits, i, k);
        }
}

// --- the table

static double now(void) {
    struct timespec time;
    clock_gettime(CLOCK_MONOTONIC, &time);
    return 1e3 * (double)time.tv_sec + 1e-6 * (double)time.tv_nsec;
}

/// The pairs that rays find, of those that are not hidden for sure.
static void find_seen(const bench *b, const unsigned char *maybe, unsigned char *bits) {
    sl_random random = {3};
    for (size_t i = 0; i < PLAYERS; i++)
        for (size_t k = 0; k < THINGS; k++)
            for (int m = 0; m < RAYS && says(maybe, i, k) && !says(bits, i, k); m++) {
                double t[4];
                // Every second ray leads from side to side.
                for (int n = 0; n < 4; n++) t[n] = sl_random_unit(&random);
                if (m % 2) t[sl_random_below(&random, 2)] = (double)sl_random_below(&random, 2);
                if (m % 2) t[2 + sl_random_below(&random, 2)] = (double)sl_random_below(&random, 2);
                if (ray(b, i, k, t)) say(bits, i, k);
            }
}

static void print_row(const bench *b, const char *name, const char *what, question *ask, int rounds,
                      const unsigned char *seen, double *first) {
    static pairs bits;
    double least = INFINITY;
    size_t count = 0, missed = 0, added = 0, all = 0;
    for (int i = 0; i < rounds; i++) {
        memset(bits, 0, sizeof bits);
        const double start = now();
        ask(b, bits);
        least = fmin(least, now() - start);
    }
    for (size_t i = 0; i < PLAYERS; i++)
        for (size_t k = 0; k < THINGS; k++) {
            const bool said = says(bits, i, k), sees = says(seen, i, k);
            count += said;
            all += sees;
            missed += sees && !said;
            added += said && !sees;
        }
    if (!*first) *first = least;
    printf("%s,%u,%s,%.3f,%.1f,%zu,%.1f,%.1f\n", name, b->runtime.cell_count, what, least,
           least / *first, count, 100 * (double)missed / (double)all,
           100 * (double)added / (double)all);
}

static void choose_boxes(bench *b) {
    const sl_runtime *r = &b->runtime;
    sl_random random = {7};
    for (size_t i = 0; i < PLAYERS + THINGS;) {
        const double x = r->min_x + sl_random_unit(&random) * (r->max_x - r->min_x);
        const double y = r->min_y + sl_random_unit(&random) * (r->max_y - r->min_y);
        if (!sl_runtime_is_inside(r, sl_runtime_locate(r, x, y))) continue;
        (i < PLAYERS ? b->players : b->things - PLAYERS)[i] =
            (sl_runtime_box){x - half, y - half, x + half, y + half, false};
        i++;
    }
}

static void print_table(const bench *b, const char *name) {
    static pairs maybe, seen;
    double first = 0;
    ask_relevant(b, maybe);
    find_seen(b, maybe, seen);
    puts("map,cells,asked,milliseconds,times,pairs,missed,added");
    print_row(b, name, "relevant", ask_relevant, ROUNDS, seen, &first);
    print_row(b, name, "rows of the cells", ask_rows, ROUNDS, seen, &first);
    print_row(b, name, "five looks a player", ask_five_looks, ROUNDS, seen, &first);
    print_row(b, name, "nine rays a pair", ask_nine_rays, 1, seen, &first);
    print_row(b, name, "each pair by sees_within", ask_each_pair, 1, seen, &first);
}

/// The baked file's bytes, for free().
static char *read_or_bake(const char *name, const char *slice, size_t *size) {
    const size_t length = strlen(name);
    if (length > 4 && strcmp(name + length - 4, ".slv") == 0) return bench_read_file(name, size);
    sl_context *context = sl_context_create(NULL);
    sl_baked baked;
    if (!context) bench_fail("out of memory");
    bench_bake(context, name, slice, &baked);
    char *bytes = baked_bytes(context, &baked, size);
    sl_baked_destroy(context, &baked);
    sl_context_destroy(context);
    return bytes;
}

int main(int argc, char **argv) {
    if (argc < 2) bench_fail("usage: bench_relevant MAP [Z] | KIND:N[:DEGREES] | FILE.slv");
    size_t size;
    char *bytes = read_or_bake(argv[1], argc > 2 ? argv[2] : NULL, &size);
    bench *b = room(1, sizeof *b);
    const sl_runtime_status status = sl_runtime_open(bytes, size, &b->runtime);
    if (status != SL_RUNTIME_OK) bench_fail(sl_runtime_status_text(status));
    b->scratch = room(sl_runtime_scratch_count(&b->runtime), sizeof *b->scratch);
    b->relevant_scratch =
        room(sl_runtime_relevant_count(&b->runtime, THINGS), sizeof *b->relevant_scratch);
    b->cell_bits = room(((size_t)b->runtime.cell_count + 7) / 8, 1);
    choose_boxes(b);
    print_table(b, argv[1]);
    free(b->scratch);
    free(b->relevant_scratch);
    free(b->cell_bits);
    free(b);
    free(bytes);
    return 0;
}

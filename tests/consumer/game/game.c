// A game loop on the runtime: a player goes about a level and guards stand in it. The level is a
// baked file; the implementation of the header is compiled in game_runtime.c.
//   game LEVEL.slv
#include <sightline_runtime.h>

#include <stdio.h>
#include <stdlib.h>

enum { GUARDS = 64, FRAMES = 600 };

typedef struct guard {
    double x, y;
    uint32_t cell; // looked up once: guards stand
} guard;

typedef struct game {
    void *bytes;
    sl_runtime level;
    guard guards[GUARDS];
    uint32_t *scratch, *cells;
    unsigned char *row, *to_draw; // a bit a cell
    uint32_t cell;                // the player's
    unsigned long moves, awake, drawn, cells_drawn;
} game;

static int read_level(const char *path, game *g) {
    FILE *file = fopen(path, "rb");
    if (!file) return 0;
    fseek(file, 0, SEEK_END);
    const long size = ftell(file);
    rewind(file);
    g->bytes = size > 0 ? malloc((size_t)size) : NULL;
    const int whole = g->bytes && fread(g->bytes, 1, (size_t)size, file) == (size_t)size;
    fclose(file);
    if (!whole) return 0;
    const sl_runtime_status status = sl_runtime_open(g->bytes, (size_t)size, &g->level);
    if (status != SL_RUNTIME_OK) fprintf(stderr, "%s: %s\n", path, sl_runtime_status_text(status));
    return status == SL_RUNTIME_OK;
}

// All memory that the game will ever need.
static int make_room(game *g) {
    const size_t cells = g->level.cell_count;
    g->scratch = malloc(sl_runtime_scratch_count(&g->level) * sizeof *g->scratch);
    g->cells = malloc(cells * sizeof *g->cells);
    g->row = malloc((cells + 7) / 8);
    g->to_draw = malloc((cells + 7) / 8);
    return g->scratch && g->cells && g->row && g->to_draw;
}

static double unit(unsigned *random) {
    *random = *random * 1664525u + 1013904223u;
    return (*random >> 8) / 16777216.0;
}

static void place_guards(game *g) {
    unsigned random = 1;
    for (int i = 0; i < GUARDS;) {
        guard *it = &g->guards[i];
        it->x = g->level.min_x + unit(&random) * (g->level.max_x - g->level.min_x);
        it->y = g->level.min_y + unit(&random) * (g->level.max_y - g->level.min_y);
        it->cell = sl_runtime_locate(&g->level, it->x, it->y);
        i += sl_runtime_has_row(&g->level, it->cell);
    }
}

static int has(const unsigned char *bits, uint32_t cell) {
    return bits[cell / 8] >> cell % 8 & 1;
}

static void frame(game *g, double x, double y, double to_x, double to_y) {
    const uint32_t cell = sl_runtime_locate(&g->level, x, y);
    if (cell == SL_RUNTIME_NO_CELL) return;
    if (cell != g->cell) { // what holds for the whole cell is asked when the cell changes
        g->cell = cell;
        g->moves++;
        sl_runtime_row_bits(&g->level, cell, g->row);
    }
    const sl_runtime_view view = sl_runtime_view_toward(x, y, to_x, to_y, 0.577); // 60 degrees
    const uint32_t seen =
        sl_runtime_look(&g->level, &view, g->scratch, g->cells, g->level.cell_count);
    for (size_t i = 0; i < (g->level.cell_count + 7) / 8; i++) g->to_draw[i] = 0;
    for (uint32_t i = 0; i < seen; i++)
        g->to_draw[g->cells[i] / 8] |= (unsigned char)(1 << g->cells[i] % 8);
    g->cells_drawn += seen;
    for (int i = 0; i < GUARDS; i++) {
        g->awake += (unsigned long)has(g->row, g->guards[i].cell);     // may think: could see us
        g->drawn += (unsigned long)has(g->to_draw, g->guards[i].cell); // may be on the screen
    }
}

// The player walks straight on and turns at the level's bounds.
static void play(game *g) {
    const double width = g->level.max_x - g->level.min_x, height = g->level.max_y - g->level.min_y;
    double x = g->level.min_x + 0.4 * width, y = g->level.min_y + 0.6 * height;
    double step_x = 0.0037 * width, step_y = 0.0023 * height;
    for (int i = 0; i < FRAMES; i++) {
        frame(g, x, y, step_x, step_y);
        if (x + step_x > g->level.max_x || x + step_x < g->level.min_x) step_x = -step_x;
        if (y + step_y > g->level.max_y || y + step_y < g->level.min_y) step_y = -step_y;
        x += step_x;
        y += step_y;
    }
}

int main(int argc, char **argv) {
    static game g;
    if (argc != 2 || !read_level(argv[1], &g) || !make_room(&g)) return 1;
    g.cell = SL_RUNTIME_NO_CELL;
    place_guards(&g);
    play(&g);
    printf(
        "%d frames, %lu changes of cell; of %d guards %.1f awake and %.1f drawn, of %u cells %.1f "
        "drawn\n",
        FRAMES, g.moves, GUARDS, (double)g.awake / FRAMES, (double)g.drawn / FRAMES,
        (unsigned)g.level.cell_count, (double)g.cells_drawn / FRAMES);
    free(g.scratch);
    free(g.cells);
    free(g.row);
    free(g.to_draw);
    free(g.bytes);
    // Who is drawn is in sight, and someone is.
    return g.drawn && g.drawn <= g.awake ? 0 : 1;
}

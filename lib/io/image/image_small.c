/// Small pieces of solid pixels that touch nothing: lettering and symbols of a scanned plan, but
/// columns too. Pixels that meet at corners are of one piece. Pieces are found by runs: each run of
/// solid pixels in a row joins those of the row above that it touches, in a forest of sets.
#include "io/image/image.h"
#include "sightline/support.h"

typedef struct run {
    size_t row, first, end;
    size_t piece; ///< a run of the same piece before it, or itself
} run;

/// The box about a piece, kept with its first run.
typedef struct piece_box {
    size_t x0, y0, x1, y1; ///< x1, y1: behind the last
} piece_box;

typedef struct run_list {
    SL_ARRAY(run) runs;
    piece_box *boxes; ///< by run; of the first of each piece
} run_list;

static size_t first_of(run_list *list, size_t at) {
    run *runs = list->runs.items;
    while (runs[at].piece != at) at = runs[at].piece = runs[runs[at].piece].piece;
    return at;
}

static void join(run_list *list, size_t a, size_t b) {
    a = first_of(list, a);
    b = first_of(list, b);
    if (a < b)
        list->runs.items[b].piece = a;
    else
        list->runs.items[a].piece = b;
}

static sl_status find_runs(sl_context *context, const sli_grid *grid, run_list *list) {
    const size_t width = grid->rows[0].length;
    size_t above = 0, above_end = 0;
    for (size_t y = 0; y < grid->count; y++) {
        const char *row = grid->rows[y].at;
        const size_t begin = list->runs.count;
        if (y % 256 == 0) SL_TRY(sl_check_cancelled(context));
        for (size_t x = 0, end; x < width; x = end) {
            end = x + 1;
            if (row[x] != '#') continue;
            while (end < width && row[end] == '#') end++;
            SL_TRY(SL_ARRAY_ROOM(context, &list->runs, 1));
            const size_t at = list->runs.count++;
            list->runs.items[at] = (run){y, x, end, at};
            while (above < above_end && list->runs.items[above].end < x) above++;
            for (size_t k = above; k < above_end && list->runs.items[k].first <= end; k++)
                join(list, k, at);
        }
        above = begin;
        above_end = list->runs.count;
    }
    return SL_OK;
}

static void grow(piece_box *box, const run *part) {
    if (box->x1 == 0 || part->first < box->x0) box->x0 = part->first;
    if (box->x1 == 0) box->y0 = part->row;
    if (part->end > box->x1) box->x1 = part->end;
    box->y1 = part->row + 1;
}

static bool is_small(const piece_box *box, size_t most) {
    return box->x1 - box->x0 <= most && box->y1 - box->y0 <= most;
}

static void take_small(run_list *list, sli_grid *grid, size_t most, bool open,
                       sli_image_small *out) {
    for (size_t i = 0; i < list->runs.count; i++) {
        const run *part = &list->runs.items[i];
        const piece_box *box = &list->boxes[first_of(list, i)];
        if (!is_small(box, most)) continue;
        if (first_of(list, i) == i) {
            out->count++;
            if (box->x1 - box->x0 > out->width) out->width = box->x1 - box->x0;
            if (box->y1 - box->y0 > out->height) out->height = box->y1 - box->y0;
        }
        char *row = grid->squares + part->row * grid->rows[0].length;
        for (size_t x = part->first; open && x < part->end; x++) row[x] = '.';
    }
}

sl_status sli_image_find_small(sl_context *context, sli_grid *grid, bool open,
                               sli_image_small *out) {
    enum { SHARE = 20, LEAST = 3 }; // of the drawing's longer side; pixels that a letter needs
    run_list list = {.boxes = NULL};
    piece_box all = {0};
    *out = (sli_image_small){0};
    sl_status status = find_runs(context, grid, &list);
    if (status == SL_OK) {
        list.boxes = sl_alloc_array(context, list.runs.count + 1, sizeof *list.boxes);
        if (!list.boxes) status = SL_NO_MEMORY;
    }
    for (size_t i = 0; status == SL_OK && i < list.runs.count; i++) {
        grow(&all, &list.runs.items[i]);
        grow(&list.boxes[first_of(&list, i)], &list.runs.items[i]);
    }
    const size_t wide = all.x1 - all.x0, high = all.y1 - all.y0;
    const size_t most = (wide > high ? wide : high) / SHARE;
    if (status == SL_OK && most >= LEAST) take_small(&list, grid, most, open, out);
    sl_free(context, list.runs.items);
    sl_free(context, list.boxes);
    return status;
}

/// Small pieces of solid pixels that touch nothing: lettering and symbols of a scanned plan, but
/// columns too, which stay unless all are left out. Pixels that meet at corners are of one piece.
/// Pieces are found by runs: each run of solid pixels in a row joins those of the row above that it
/// touches, in a forest of sets.
#include "io/image/image.h"
#include "sightline/support.h"

typedef struct run {
    size_t row, first, end;
    size_t piece; ///< a run of the same piece before it, or itself
} run;

typedef struct run_list {
    SL_ARRAY(run) runs;
    sli_piece *pieces; ///< by run; of the first of each piece
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

static void grow(sli_piece *piece, const run *part) {
    if (!piece->area || part->first < piece->low[0]) piece->low[0] = part->first;
    if (!piece->area) piece->low[1] = part->row;
    if (part->end > piece->high[0]) piece->high[0] = part->end;
    piece->high[1] = part->row + 1;
    piece->area += part->end - part->first;
}

static bool is_small(const sli_piece *piece, size_t most) {
    return piece->high[0] - piece->low[0] <= most && piece->high[1] - piece->low[1] <= most;
}

/// Marks the small pieces that are letters.
static sl_status find_letters(sl_context *context, run_list *list, size_t most) {
    SL_ARRAY(sli_piece *) small = {0};
    sl_status status = SL_OK;
    for (size_t i = 0; status == SL_OK && i < list->runs.count; i++) {
        if (list->runs.items[i].piece != i || !is_small(&list->pieces[i], most)) continue;
        status = SL_ARRAY_ROOM(context, &small, 1);
        if (status == SL_OK) small.items[small.count++] = &list->pieces[i];
    }
    if (status == SL_OK) status = sli_image_find_letters(context, small.items, small.count);
    sl_free(context, small.items);
    return status;
}

static void take_small(run_list *list, sli_grid *grid, size_t most, sli_image_left_out left_out,
                       sli_image_small *out) {
    for (size_t i = 0; i < list->runs.count; i++) {
        const run *part = &list->runs.items[i];
        const size_t first = first_of(list, i);
        const sli_piece *piece = &list->pieces[first];
        if (!is_small(piece, most)) continue;
        if (first == i && piece->letter) {
            out->letters++;
        } else if (first == i) {
            out->count++;
            if (piece->high[0] - piece->low[0] > out->width)
                out->width = piece->high[0] - piece->low[0];
            if (piece->high[1] - piece->low[1] > out->height)
                out->height = piece->high[1] - piece->low[1];
        }
        if (!piece->letter && left_out != SLI_LEAVE_OUT_SMALL) continue;
        char *row = grid->squares + part->row * grid->rows[0].length;
        for (size_t x = part->first; x < part->end; x++) row[x] = '.';
    }
}

/// The extent of the drawing, along its longer side.
static size_t longer_side(const run_list *list) {
    sli_piece all = {0};
    for (size_t i = 0; i < list->runs.count; i++) grow(&all, &list->runs.items[i]);
    const size_t wide = all.high[0] - all.low[0], high = all.high[1] - all.low[1];
    return wide > high ? wide : high;
}

sl_status sli_image_find_small(sl_context *context, sli_grid *grid, sli_image_left_out left_out,
                               sli_image_small *out) {
    enum { SHARE = 20, LEAST = 3 }; // of the drawing's longer side; pixels that a letter needs
    run_list list = {.pieces = NULL};
    *out = (sli_image_small){0};
    sl_status status = find_runs(context, grid, &list);
    if (status == SL_OK) {
        list.pieces = sl_alloc_array(context, list.runs.count + 1, sizeof *list.pieces);
        if (!list.pieces) status = SL_NO_MEMORY;
    }
    for (size_t i = 0; status == SL_OK && i < list.runs.count; i++)
        grow(&list.pieces[first_of(&list, i)], &list.runs.items[i]);
    const size_t most = longer_side(&list) / SHARE;
    if (status == SL_OK && left_out == SLI_LEAVE_OUT_LETTERS && most >= LEAST)
        status = find_letters(context, &list, most);
    if (status == SL_OK && most >= LEAST) take_small(&list, grid, most, left_out, out);
    sl_free(context, list.runs.items);
    sl_free(context, list.pieces);
    return status;
}

/// Lettering among small pieces of solid pixels: words are pieces of like height in a row, each
/// close behind the one before it.
///
///     overlap  +--+ +-+  +---+      A word has at least three pieces, or two as high as those of
///              |  | | |  |   |      another word. Its pieces are not alike, and they do not fill
///              +--+ +-+  +---+      their boxes: so rows of columns, dashes and steps of stairs
///                  gap              are no words, and neither are outlines, as of furniture.
///
/// Rows run from left to right, or up a wall, so all is done along one axis and then along the
/// other. What is smaller and within a word or a space away from it belongs to it: dots, accents, a
/// letter alone. A full square as large as a letter does not: it is a column.
#include "io/image/image.h"
#include "sightline/support.h"

#include <stdlib.h>

/// The least height of a letter, in pixels.
enum { LETTER = 4 };

typedef struct word_sum {
    size_t pieces, area, boxes; ///< boxes: the area of the boxes of its pieces
    size_t least, most;         ///< areas of pieces
    size_t height;              ///< of the highest piece
    size_t low[2], high[2];
    bool is_word;
} word_sum;

typedef struct lettering {
    sli_piece **pieces; ///< in their order along the axis
    size_t count;
    int along, across; ///< the axes
    size_t *word;      ///< by piece: one before it that is of its word, or itself
    word_sum *sums;    ///< by piece; those of the first of each word
} lettering;

static int compare_along(const sli_piece *a, const sli_piece *b, int axis) {
    if (a->low[axis] != b->low[axis]) return a->low[axis] < b->low[axis] ? -1 : 1;
    return (a->low[!axis] > b->low[!axis]) - (a->low[!axis] < b->low[!axis]);
}

static int compare_x(const void *a, const void *b) {
    return compare_along(*(sli_piece *const *)a, *(sli_piece *const *)b, 0);
}

static int compare_y(const void *a, const void *b) {
    return compare_along(*(sli_piece *const *)a, *(sli_piece *const *)b, 1);
}

static size_t extent(const sli_piece *piece, int axis) {
    return piece->high[axis] - piece->low[axis];
}

static size_t larger(size_t a, size_t b) {
    return a > b ? a : b;
}

static size_t smaller(size_t a, size_t b) {
    return a < b ? a : b;
}

/// Whether a piece is as large as a letter and full: a column.
static bool is_column(const sli_piece *piece, size_t height) {
    const size_t wide = extent(piece, 0), high = extent(piece, 1);
    return 2 * smaller(wide, high) >= height && 10 * piece->area >= 9 * wide * high;
}

/// Whether `b` may be the next letter behind `a`.
static bool follows(const lettering *l, const sli_piece *a, const sli_piece *b) {
    const size_t high_a = extent(a, l->across), high_b = extent(b, l->across);
    const size_t low = larger(a->low[l->across], b->low[l->across]);
    const size_t high = smaller(a->high[l->across], b->high[l->across]);
    if (smaller(high_a, high_b) < LETTER || larger(high_a, high_b) > 2 * smaller(high_a, high_b))
        return false;
    if (is_column(a, high_a) || is_column(b, high_b)) return false;
    if (high < low || 2 * (high - low) < smaller(high_a, high_b)) return false;
    if (b->high[l->along] <= a->high[l->along]) return false;
    const size_t from = smaller(a->high[l->along], b->low[l->along]);
    return 5 * (b->low[l->along] - from) <= 3 * larger(high_a, high_b);
}

static size_t first_of(size_t *word, size_t at) {
    while (word[at] != at) at = word[at] = word[word[at]];
    return at;
}

static void join_letters(lettering *l) {
    for (size_t i = 0; i < l->count; i++) l->word[i] = i;
    for (size_t i = 0; i < l->count; i++) {
        const sli_piece *piece = l->pieces[i];
        const size_t end = piece->high[l->along] + 6 * extent(piece, l->across) / 5;
        for (size_t k = i + 1; k < l->count && l->pieces[k]->low[l->along] <= end; k++) {
            if (piece->letter || l->pieces[k]->letter || !follows(l, piece, l->pieces[k])) continue;
            const size_t a = first_of(l->word, i), b = first_of(l->word, k);
            l->word[larger(a, b)] = smaller(a, b);
            break;
        }
    }
}

static void add_letter(word_sum *sum, const sli_piece *piece, int across) {
    for (int axis = 0; axis < 2; axis++) {
        if (!sum->pieces || piece->low[axis] < sum->low[axis]) sum->low[axis] = piece->low[axis];
        sum->high[axis] = larger(sum->high[axis], piece->high[axis]);
    }
    if (!sum->pieces || piece->area < sum->least) sum->least = piece->area;
    sum->most = larger(sum->most, piece->area);
    sum->height = larger(sum->height, extent(piece, across));
    sum->area += piece->area;
    sum->boxes += extent(piece, 0) * extent(piece, 1);
    sum->pieces++;
}

/// Whether the pieces, of any number above one, look like letters.
static bool are_letters(const word_sum *sum) {
    return sum->pieces > 1 && 10 * sum->area < 7 * sum->boxes && 8 * sum->area >= sum->boxes &&
           10 * sum->most > 11 * sum->least;
}

/// Finds the words. Two letters are one if a word of three is as high, up to a fifth.
static sl_status find_words(sl_context *context, lettering *l) {
    size_t tallest = 0;
    for (size_t i = 0; i < l->count; i++) {
        word_sum *sum = &l->sums[first_of(l->word, i)];
        add_letter(sum, l->pieces[i], l->across);
        tallest = larger(tallest, sum->height);
    }
    bool *is_height = sl_alloc_array(context, tallest + 1, sizeof *is_height);
    if (!is_height) return SL_NO_MEMORY;
    for (size_t i = 0; i < l->count; i++) {
        word_sum *sum = &l->sums[i];
        sum->is_word = sum->pieces > 2 && are_letters(sum);
        const size_t most = smaller(tallest, sum->height + sum->height / 5);
        for (size_t h = sum->height - sum->height / 5; sum->is_word && h <= most; h++)
            is_height[h] = true;
    }
    for (size_t i = 0; i < l->count; i++)
        l->sums[i].is_word |= is_height[l->sums[i].height] && are_letters(&l->sums[i]);
    sl_free(context, is_height);
    return SL_OK;
}

/// Whether a piece lies within a word or beside it, at most a space away, and is no higher.
static bool is_within(const lettering *l, const sli_piece *piece, const word_sum *sum) {
    const size_t behind = sum->height, above = sum->height / 3;
    return !is_column(piece, sum->height) && extent(piece, l->across) <= sum->height &&
           extent(piece, l->along) <= sum->height &&
           piece->low[l->across] + above >= sum->low[l->across] &&
           piece->high[l->across] <= sum->high[l->across] + above &&
           piece->high[l->along] + behind >= sum->low[l->along] &&
           piece->high[l->along] <= sum->high[l->along] + behind + extent(piece, l->along);
}

static size_t first_from(const lettering *l, size_t least) {
    size_t low = 0, high = l->count;
    while (low < high) {
        const size_t middle = low + (high - low) / 2;
        if (l->pieces[middle]->low[l->along] < least)
            low = middle + 1;
        else
            high = middle;
    }
    return low;
}

static void mark_letters(lettering *l) {
    for (size_t i = 0; i < l->count; i++)
        l->pieces[i]->letter |= l->sums[first_of(l->word, i)].is_word;
    for (size_t i = 0; i < l->count; i++) {
        const word_sum *sum = &l->sums[i];
        if (!sum->is_word) continue;
        const size_t low = sum->low[l->along] - smaller(sum->low[l->along], 2 * sum->height);
        for (size_t k = first_from(l, low);
             k < l->count && l->pieces[k]->low[l->along] <= sum->high[l->along] + sum->height; k++)
            l->pieces[k]->letter |= is_within(l, l->pieces[k], sum);
    }
}

static sl_status find_along(sl_context *context, lettering *l, int axis) {
    l->along = axis;
    l->across = !axis;
    qsort(l->pieces, l->count, sizeof *l->pieces, axis ? compare_y : compare_x);
    join_letters(l);
    for (size_t i = 0; i < l->count; i++) l->sums[i] = (word_sum){0};
    SL_TRY(find_words(context, l));
    mark_letters(l);
    return SL_OK;
}

sl_status sli_image_find_letters(sl_context *context, sli_piece **pieces, size_t count) {
    if (!count) return SL_OK;
    lettering l = {.pieces = pieces, .count = count};
    l.word = sl_alloc_array(context, count, sizeof *l.word);
    l.sums = sl_alloc_array(context, count, sizeof *l.sums);
    sl_status status = l.word && l.sums ? SL_OK : SL_NO_MEMORY;
    for (int axis = 0; status == SL_OK && axis < 2; axis++) status = find_along(context, &l, axis);
    sl_free(context, l.word);
    sl_free(context, l.sums);
    return status;
}

/// A building in an otherwise empty level of LDtk. Through a gap in its walls the empty squares
/// about it are joined to its rooms, and count as inside. Nothing says whether one walks there, so
/// a note tells how much that is, and what leaves it out.
///
/// The box of all that is drawn tells: cells that are solid or water, and tiles of any layer. It is
/// that of a building if walls stand along a third of it or more, and three of its sides lie off
/// the level's edge: a platformer's ground reaches the edge at three. Time O(squares).
#include "io/ldtk.h"

#include <math.h>

/// Grows a box by what is drawn in a block.
static void add_drawn(const sli_tile_block *block, sl_box *box) {
    for (size_t i = 0; i < block->columns * block->rows; i++) {
        if (block->squares[i] == '.' || block->squares[i] == ' ') continue;
        const double x = block->corner.x + (double)(i % block->columns) * block->step.x;
        const double y = block->corner.y + (double)(i / block->columns) * block->step.y;
        box->min = (sl_point){fmin(box->min.x, x), fmin(box->min.y, y)};
        box->max =
            (sl_point){fmax(box->max.x, x + block->step.x), fmax(box->max.y, y + block->step.y)};
    }
}

/// The solid area of a block, and how much of a box's border is solid in it, by length.
static void measure(const sli_tile_block *block, const sl_box *box, double *area, double *border) {
    *area = *border = 0;
    for (size_t i = 0; i < block->columns * block->rows; i++) {
        if (block->squares[i] != '#') continue;
        const double x = block->corner.x + (double)(i % block->columns) * block->step.x;
        const double y = block->corner.y + (double)(i / block->columns) * block->step.y;
        *area += block->step.x * block->step.y;
        if (x == box->min.x || x + block->step.x == box->max.x) *border += block->step.y;
        if (y == box->min.y || y + block->step.y == box->max.y) *border += block->step.x;
    }
}

static double area_of(const sl_box *box) {
    return (box->max.x - box->min.x) * (box->max.y - box->min.y);
}

void sli_ldtk_note_outside(const sli_ldtk *reader) {
    const double least = 0.25;
    sl_box box = {{INFINITY, INFINITY}, {-INFINITY, -INFINITY}};
    double solid = 0, border = 0;
    if (reader->pages.count != 1 || !reader->layers || reader->options->layers ||
        reader->options->has_crop)
        return;
    const sl_box *page = &reader->pages.items[0];
    for (size_t i = 0; i < reader->tiles.blocks.count; i++)
        add_drawn(&reader->tiles.blocks.items[i], &box);
    for (size_t i = 0; i < reader->shown.blocks.count; i++)
        add_drawn(&reader->shown.blocks.items[i], &box);
    const int free_sides = (box.min.x > page->min.x) + (box.min.y > page->min.y) +
                           (box.max.x < page->max.x) + (box.max.y < page->max.y);
    if (!(box.min.x < box.max.x) || free_sides < 3) return;
    for (size_t i = 0; i < reader->tiles.blocks.count; i++) {
        double area, along;
        measure(&reader->tiles.blocks.items[i], &box, &area, &along);
        solid = fmax(solid, area);
        border = fmax(border, along);
    }
    const double length = 2 * (box.max.x - box.min.x + box.max.y - box.min.y);
    const double outside = (area_of(page) - area_of(&box)) / (area_of(page) - solid);
    if (3 * border < length || outside < least) return;
    sl_note(
        reader->context,
        "%s: %.0f %% of the open ground lies about all that is drawn, and is inside where a gap "
        "in the walls leads to it; if one does not walk there: sightline check '%.300s' --map "
        "'%.40s' --crop %.9g,%.9g,%.9g,%.9g -o map.png",
        reader->name, 100 * outside, reader->name, reader->taken, box.min.x,
        reader->bottom - box.max.y, box.max.x, reader->bottom - box.min.y);
}

/// The cells in which a box lies: by separating lines, the box's own and those of the cell's sides.
#include "sightline/moving.h"

#include "base/bits.h"
#include "geometry/orient.h"

#include <string.h>

/// Whether no line along a side of either has both strictly apart, given the box's corners.
static bool meets(const sl_space *space, uint32_t number, const sl_box *box,
                  const sl_point *corners) {
    const sl_cell *cell = &space->cells[number];
    const sl_point *v = space->vertices + cell->first_vertex;
    bool left = true, right = true, under = true, over = true;
    for (uint32_t i = 0; i < cell->vertex_count; i++) {
        const sl_point next = v[i + 1 == cell->vertex_count ? 0 : i + 1];
        bool outside = true;
        for (int k = 0; k < 4 && outside; k++) outside = sl_orient(v[i], next, corners[k]) < 0;
        if (outside) return false;
        left &= v[i].x < box->min.x;
        right &= v[i].x > box->max.x;
        under &= v[i].y < box->min.y;
        over &= v[i].y > box->max.y;
    }
    return !left && !right && !under && !over;
}

void sl_cells_of_box(const sl_space *space, sl_box box, uint64_t *cells) {
    const sl_point corners[4] = {box.min, {box.max.x, box.min.y}, box.max, {box.min.x, box.max.y}};
    memset(cells, 0, sl_eye_words(space) * sizeof *cells);
    for (uint32_t i = 0; i < space->cell_count; i++)
        if (meets(space, i, &box, corners)) sl_bits_add(cells, i);
}

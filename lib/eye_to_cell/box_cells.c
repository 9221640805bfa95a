/// The cells in which a box lies.
#include "sightline/moving.h"

#include "sightline/support.h"
#include "space/boxes.h"
#include "space/index.h"

#include <string.h>

void sl_cells_of_box(const sl_space *space, sl_box box, uint64_t *cells) {
    memset(cells, 0, sl_eye_words(space) * sizeof *cells);
    if (!space->neighbour) {
        for (uint32_t i = 0; i < space->cell_count; i++)
            if (sl_cell_meets_box(space, i, box)) sl_bits_add(cells, i);
        return;
    }
    sl_cell_grid_range r = sl_cell_grid_range_of(space, box);
    for (uint32_t i; sl_cell_grid_next(&space->grid, &r, &i);)
        if (!sl_bits_has(cells, i) && sl_cell_meets_box(space, i, box)) sl_bits_add(cells, i);
}

/// The linear program of a portal sequence and GLPK's answer, for a page that shows them. This
/// module is under the GPL 3, as GLPK is: it is no part of the package.
#include "sightline/glpk.h"
#include "bindings/js/src/bindings.h"

// JavaScript reads rows by these places.
_Static_assert(sizeof(sl_program_row) == 64, "the size of a row");
_Static_assert(offsetof(sl_program_row, left) == 4, "the side of a row");
_Static_assert(offsetof(sl_program_row, coefficients) == 8, "coefficients, value and price");
_Static_assert(offsetof(sl_program_row, basic) == 56, "the basis of a row");

/// Of `count` portals, each left x, y, right x, y. integers: rows, their place, whether it is
/// solved. numbers: the origin, the unit, the four columns, the margin in units of the map.
SLI_EXPORT(int, program, const sl_portal_ends *portals, uint32_t count) {
    static sl_program made;
    sl_program_destroy(sli_module.context, &made);
    if (!sli_done(sl_program_make(sli_module.context, portals, count, &made)))
        return (int)sli_module.status;
    sli_module.integers[0] = made.row_count;
    sli_module.integers[1] = (uint32_t)(uintptr_t)made.rows;
    sli_module.integers[2] = made.solved;
    double *to = sli_module.numbers;
    *to++ = made.origin.x;
    *to++ = made.origin.y;
    *to++ = made.unit;
    for (int i = 0; i < SL_PROGRAM_COLUMNS; i++) *to++ = made.values[i];
    *to = made.margin;
    return SL_OK;
}

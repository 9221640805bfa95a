/// The table of culling methods, from the loosest to the exact one.
#include "eye_to_cell/eye_methods.h"

const sl_eye_method *sl_eye_methods(size_t *count) {
    static const sl_eye_method methods[] = {
        {"cell_to_cell", "no culling: all that the eye's cell sees", SL_CONSERVATIVE, true,
         sl_eye_cell_to_cell, sl_eye_cell_to_cell_mirrored},
        {"disjoint_cell", "of those, the cells that meet the view cone", SL_CONSERVATIVE, true,
         sl_eye_disjoint_cell, NULL},
        {"connected_component", "of those, the cells connected to the eye's through such cells",
         SL_CONSERVATIVE, true, sl_eye_connected_component, NULL},
        {"incident_portals", "of those, the cells reached through portals that meet the cone",
         SL_CONSERVATIVE, true, sl_eye_incident_portals, NULL},
        {"exact", "of those, the cells with a sightline from the eye within the cone", SL_EXACT,
         false, sl_eye_exact, sl_eye_exact_mirrored},
    };
    *count = sizeof methods / sizeof *methods;
    return methods;
}

/// A pass of the multipass method: the faces through which a sector's sightlines leave each cell,
/// and the order in which that lets cells be done (Laine 2005, section 4).
#ifndef SL_PASS_H
#define SL_PASS_H

#include "cell_to_cell/dependence.h"
#include "cell_to_cell/sectors.h"

/// What sl_pass.faces says of a directed portal that no sightline of the sector leaves by.
#define SL_NO_FACE UINT32_MAX

typedef struct sl_pass {
    sl_cone cone;
    uint32_t *faces; ///< by directed portal: its number among those that face the sector
    uint32_t face_count;
    uint32_t *first, *to; ///< the graph: a cell depends on those behind its faces
    sl_order order;
} sl_pass;

/// `inside_only`: what is not inside has no faces, and is behind none.
sl_status sl_pass_create(sl_context *context, const sl_space *space, bool inside_only, sl_cone cone,
                         sl_pass *out);
void sl_pass_destroy(sl_context *context, sl_pass *pass);

#endif

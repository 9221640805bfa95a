#include "cell_to_cell/pass.h"

#include "sightline/support.h"

static bool faces(const sl_space *space, bool inside_only, uint32_t cell,
                  const sl_directed_portal *directed, sl_cone cone) {
    if (inside_only && !(space->cells[cell].inside && space->cells[directed->cell].inside))
        return false;
    return sl_cone_cut(&cone, directed);
}

static sl_status fill(sl_context *context, const sl_space *space, bool inside_only, sl_pass *pass) {
    for (uint32_t cell = 0; cell < space->cell_count; cell++) {
        const sl_cell *c = &space->cells[cell];
        for (uint32_t e = c->first_directed; e < c->first_directed + c->directed_count; e++) {
            pass->faces[e] = SL_NO_FACE;
            if (!faces(space, inside_only, cell, &space->directed[e], pass->cone)) continue;
            pass->to[pass->face_count] = space->directed[e].cell;
            pass->faces[e] = pass->face_count++;
        }
        pass->first[cell + 1] = pass->face_count;
    }
    const sl_dependence graph = {space->cell_count, pass->first, pass->to};
    return sl_order_create(context, &graph, &pass->order);
}

sl_status sl_pass_create(sl_context *context, const sl_space *space, bool inside_only, sl_cone cone,
                         sl_pass *out) {
    sl_pass pass = {.cone = cone,
                    .faces = sl_alloc_array(context, space->directed_count, sizeof *pass.faces),
                    .first =
                        sl_alloc_array(context, (size_t)space->cell_count + 1, sizeof *pass.first),
                    .to = sl_alloc_array(context, space->directed_count, sizeof *pass.to)};
    sl_status status = pass.faces && pass.first && pass.to ? SL_OK : SL_NO_MEMORY;
    if (status == SL_OK) status = fill(context, space, inside_only, &pass);
    if (status == SL_OK)
        *out = pass;
    else
        sl_pass_destroy(context, &pass);
    return status;
}

void sl_pass_destroy(sl_context *context, sl_pass *pass) {
    sl_free(context, pass->faces);
    sl_free(context, pass->first);
    sl_free(context, pass->to);
    sl_order_destroy(context, &pass->order);
    *pass = (sl_pass){0};
}

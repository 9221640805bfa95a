/// A copy of a living space without gaps.
#include "world/live.h"

#include "geometry/orient.h"

#include <string.h>

/// Walls and cells get new numbers, in their old order.
typedef struct packer {
    const sli_live *live;
    uint32_t *cells, *walls;
    sl_space *out;
} packer;

static void number(packer *p) {
    const sl_space *s = &p->live->space;
    for (uint32_t c = 0; c < s->cell_count; c++) {
        p->cells[c] = s->cells[c].vertex_count ? p->out->cell_count++ : SL_NO_CELL;
        p->out->vertex_count += s->cells[c].vertex_count;
        p->out->directed_count += s->cells[c].directed_count;
        p->out->inside_count += s->cells[c].inside;
    }
    for (uint32_t i = 0; i < s->wall_count; i++)
        p->walls[i] =
            sli_same_point(s->walls[i].a, s->walls[i].b) ? UINT32_MAX : p->out->wall_count++;
}

static sl_status make_room(sl_context *context, sl_space *o) {
    o->cells = sl_alloc_array(context, o->cell_count, sizeof *o->cells);
    o->vertices = sl_alloc_array(context, o->vertex_count, sizeof *o->vertices);
    o->neighbour = sl_alloc_array(context, o->vertex_count, sizeof *o->neighbour);
    o->walls = sl_alloc_array(context, o->wall_count, sizeof *o->walls);
    return o->cells && o->vertices && o->neighbour && o->walls ? SL_OK : SL_NO_MEMORY;
}

static void write_cells(const packer *p, uint32_t *place) {
    const sl_space *s = &p->live->space;
    sl_space *o = p->out;
    uint32_t vertex = 0, directed = 0;
    for (uint32_t c = 0; c < s->cell_count; c++) {
        const sl_cell *from = &s->cells[c];
        if (!from->vertex_count) continue;
        sl_cell *to = &o->cells[p->cells[c]];
        *to = *from;
        to->first_vertex = vertex;
        to->first_directed = directed;
        for (uint32_t i = from->first_vertex; i < from->first_vertex + from->vertex_count; i++) {
            const uint32_t is = s->neighbour[i], side = is & SL_NEIGHBOUR_RIGHT;
            o->vertices[vertex] = s->vertices[i];
            o->neighbour[vertex++] =
                is >= SL_NEIGHBOUR_BORDER ? is : p->walls[is & ~SL_NEIGHBOUR_RIGHT] | side;
        }
        for (uint32_t i = 0; i < from->directed_count; i++) {
            const sl_directed_portal *d = &s->directed[from->first_directed + i];
            place[2 * d->portal + (s->portals[d->portal].cell[0] == c ? 0 : 1)] = directed++;
        }
    }
    for (uint32_t i = 0; i < s->wall_count; i++)
        if (p->walls[i] != UINT32_MAX) o->walls[p->walls[i]] = s->walls[i];
}

/// Writes the glass on portals, one seam for each.
static sl_status write_glass(sl_context *context, const packer *p, const sli_mesh_joint *joints) {
    const sl_space *s = &p->live->space;
    sl_space *o = p->out;
    if (!s->seam_portal_count) return SL_OK;
    o->seams = sl_alloc_array(context, s->seam_portal_count, sizeof *o->seams);
    o->seam_portals = sl_alloc_array(context, s->seam_portal_count, sizeof *o->seam_portals);
    if (!o->seams || !o->seam_portals) return SL_NO_MEMORY;
    for (uint32_t i = 0; i < o->portal_count; i++) {
        const sl_portal *portal = &o->portals[i];
        size_t count;
        const sl_seam_portal *on = sl_space_seams_of(s, joints[i].half, &count);
        for (size_t k = 0; k < count; k++) {
            sl_seam seam = s->seams[on[k].seam];
            seam.at = on[k].forward ? (sl_segment){portal->left, portal->right}
                                    : (sl_segment){portal->right, portal->left};
            o->seams[o->seam_count] = seam;
            o->seam_portals[o->seam_portal_count++] =
                (sl_seam_portal){i, o->seam_count++, on[k].forward};
        }
    }
    return SL_OK;
}

static sl_status write_portals(sl_context *context, const packer *p, const uint32_t *place) {
    const sl_space *s = &p->live->space;
    const uint32_t most = p->out->directed_count / 2;
    sli_mesh_joint *joints = sl_alloc_array(context, most, sizeof *joints);
    if (!joints) return SL_NO_MEMORY;
    uint32_t count = 0;
    for (uint32_t i = 0; i < s->portal_count; i++) {
        sl_portal portal = s->portals[i];
        if (portal.cell[0] == SL_NO_CELL) continue;
        portal.cell[0] = p->cells[portal.cell[0]];
        portal.cell[1] = p->cells[portal.cell[1]];
        joints[count++] = (sli_mesh_joint){portal, {place[2 * i], place[2 * i + 1]}, i};
    }
    sl_status status = sli_mesh_join(context, joints, count, p->out);
    if (status == SL_OK) status = write_glass(context, p, joints);
    sl_free(context, joints);
    return status;
}

static sl_status pack(sl_context *context, packer *p) {
    const sl_space *s = &p->live->space;
    number(p);
    SL_TRY(make_room(context, p->out));
    uint32_t *place = sl_alloc_array(context, 2 * (size_t)s->portal_count, sizeof *place);
    if (!place) return SL_NO_MEMORY;
    write_cells(p, place);
    const sl_status status = write_portals(context, p, place);
    sl_free(context, place);
    SL_TRY(status);
    return sli_cell_grid_make(context, p->out);
}

sl_status sli_live_pack(sl_context *context, const sli_live *live, uint32_t *numbers,
                        sl_space *out) {
    const sl_space *s = &live->space;
    sl_space made = {.bounds = s->bounds};
    packer p = {.live = live,
                .cells = sl_alloc_array(context, s->cell_count, sizeof *p.cells),
                .walls = sl_alloc_array(context, s->wall_count, sizeof *p.walls),
                .out = &made};
    const sl_status status = p.cells && p.walls ? pack(context, &p) : SL_NO_MEMORY;
    if (status == SL_OK) {
        if (numbers) memcpy(numbers, p.cells, s->cell_count * sizeof *numbers);
        *out = made;
    } else {
        sl_space_destroy(context, &made);
    }
    sl_free(context, p.cells);
    sl_free(context, p.walls);
    return status;
}

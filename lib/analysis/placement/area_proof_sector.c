/// Witnesses on borders of views, for the check of placements (area_proof_check.c).
///
///     B  .   |
///       . .  |  A         x is on the borders of A and B: neither sees all around it.
///     .......x            But A sees all of a sector at x.
///
/// Who sees all that the places can see, sees this sector close to x too, as often as places do.
/// Regions are closed: who sees points of it, as close to x as one likes, sees x. So of those that
/// see x, sets hold as many as see one sector, and the best sector counts.
#include "analysis/placement/area_proof.h"
#include "analysis/placement/proof_view.h"

typedef struct seer {
    sli_eye eye;
    sli_proof_view view;
} seer;

static sl_status make_seer(sl_context *context, sl_query *query, const sli_proof_scene *scene,
                           const sl_viewpoint *place, seer *s) {
    bool on_wall;
    SL_TRY(sli_eye_make(context, scene, place->at, &s->eye, &on_wall));
    return sli_proof_view_make(context, query, place, &s->eye, sli_box_of_eye(scene, &s->eye),
                               SLI_VIEW_BARE, &s->view);
}

static uint32_t count_sector(const sli_proof_scene *scene, const seer *seers, uint32_t count,
                             const sli_meet *p, const sli_direction *sector) {
    uint32_t seen = 0;
    for (uint32_t i = 0; i < count; i++)
        seen += sli_proof_view_reaches(&seers[i].view, p->at, true) &&
                sli_proof_view_sees_sector(scene, &seers[i].view, p, sector);
    return seen;
}

sl_status sli_area_proof_sector(sl_context *context, sl_query *query, const sli_proof_scene *scene,
                                const sl_viewpoint *places, const uint32_t *which, uint32_t count,
                                sl_point at, uint32_t *most) {
    const sli_meet p = sli_meet_point(at);
    sli_directions around = {0};
    seer *seers = sl_alloc_array(context, count, sizeof *seers);
    sl_status status = seers ? SL_OK : SL_NO_MEMORY;
    *most = 0;
    for (uint32_t i = 0; i < count && status == SL_OK; i++) {
        status = make_seer(context, query, scene, &places[which[i]], &seers[i]);
        if (status == SL_OK)
            status = sli_proof_view_add_directions(context, scene, &seers[i].view, &p, &around);
    }
    sli_directions_sort(&around);
    for (size_t i = 0; i < around.count && status == SL_OK; i++) {
        const sli_direction sector[] = {around.items[i], around.items[(i + 1) % around.count]};
        const uint32_t seen = count_sector(scene, seers, count, &p, sector);
        if (seen > *most) *most = seen;
    }
    for (uint32_t i = 0; seers && i < count; i++) {
        sli_proof_view_destroy(context, &seers[i].view);
        sli_eye_destroy(context, &seers[i].eye);
    }
    sl_free(context, seers);
    sl_free(context, around.items);
    return status;
}

#include "explain_answer.h"

said said_by(const answer *a) {
    const sl_visibility *v = &a->baked->visibility;
    const sl_explanation *e = &a->e.now;
    if (!sl_pvs_count(&v->pvs, e->from)) return SAID_NOTHING;
    return sl_pvs_sees(&v->pvs, e->from, e->to) &&
                   sl_door_sets_open(&v->doors, e->from, e->to, a->shut)
               ? SAID_SEEN
               : SAID_HIDDEN;
}

bool is_doubtful(const answer *a) {
    const sl_pvs *doubtful = &a->baked->visibility.doubtful;
    return doubtful->cell_count && sl_pvs_sees(doubtful, a->e.now.from, a->e.now.to);
}

const sl_seam *seam_of(const sl_space *space, uint32_t directed, sl_seam_kind kind) {
    size_t count;
    const sl_seam_portal *on = sl_space_seams_of(space, space->directed[directed].portal, &count);
    for (size_t i = 0; i < count; i++)
        if (space->seams[on[i].seam].kind == kind) return &space->seams[on[i].seam];
    return NULL;
}

uint32_t way_count(const way *w) {
    return w->bent ? w->bent->step_count : w->sequence->directed_count;
}

uint32_t way_at(const way *w, uint32_t i) {
    return w->bent ? w->bent->steps[i].directed : w->sequence->directed[i];
}

way way_direct(const sl_explanation *e) {
    return (way){&e->sequence, NULL, e->length};
}

way way_bent(const sl_bent_sightline *bent) {
    return (way){NULL, bent, bent->length};
}

bool mark_doors(const answer *a, const way *w, bool shut, bool *marked) {
    bool any = false;
    for (size_t i = 0; i < a->baked->map.door_count; i++) marked[i] = false;
    for (uint32_t i = 0; i < way_count(w); i++) {
        const uint32_t directed = way_at(w, i);
        const sl_seam *door =
            directed == UINT32_MAX ? NULL : seam_of(&a->baked->space, directed, SL_SEAM_DOOR);
        if (door && a->shut[door->number] == shut) any = marked[door->number] = true;
    }
    return any;
}

bool is_first(const sl_map *map, const bool *marked, size_t door) {
    for (size_t i = 0; i < door; i++)
        if (marked[i] && strcmp(map->doors[i].name, map->doors[door].name) == 0) return false;
    return marked[door];
}

const hiding_effect hiding[HIDING] = {{SL_EFFECT_DOOR, "door", "shut doors"},
                                      {SL_EFFECT_ONEWAY, "oneway", "one-way glass"},
                                      {SL_EFFECT_RANGE, "range", "the view range"}};

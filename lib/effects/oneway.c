#include "effects/effects.h"

static size_t count(const sl_map *map) {
    return map->oneway_count;
}

static uint32_t line(const sl_map *map) {
    return map->oneways[0].line;
}

static void leave_out(sl_context *context, sl_map *map) {
    (void)context;
    map->oneway_count = 0;
}

const sl_effect sl_effect_oneway = {
    .name = "oneway",
    .several = "one-way glass",
    .adds = "cells end at glass; sequences cross it one way, pairs are no longer mutual",
    .without = "sight passes it both ways",
    .mutual = false,
    .count = count,
    .line = line,
    .leave_out = leave_out,
};

bool sl_portal_is_blocked(const sl_space *space, uint32_t cell, uint32_t directed) {
    const uint32_t portal = space->directed[directed].portal;
    const bool forward = space->portals[portal].cell[0] == cell;
    size_t count;
    const sl_seam_portal *on = sl_space_seams_of(space, portal, &count);
    for (size_t i = 0; i < count; i++)
        if (space->seams[on[i].seam].kind == SL_SEAM_ONEWAY && on[i].forward != forward)
            return true;
    return false;
}

sl_status sl_oneway_filtered(sl_context *context, const sl_space *space, const sl_plan *plan,
                             sl_space *made, const sl_space **through) {
    const sl_filtered_space filtered = {.one_way = true};
    const bool called_for = plan && plan->effects & SL_EFFECT_ONEWAY;
    if (called_for) SL_TRY(sl_filtered_space_make(context, space, &filtered, NULL, made));
    *through = called_for ? made : space;
    return SL_OK;
}

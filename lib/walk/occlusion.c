/// The leaves that both tests have in common.
#include "walk/occlusion.h"

bool sl_shadows_hide(sl_shadows *shadows, int32_t leaf, uint32_t occluder) {
    const sl_occluder *occluders = shadows->occluders.items;
    for (; leaf >= 0; leaf = shadows->shadows.items[leaf].next)
        if (sl_occluder_is_behind(&occluders[occluder],
                                  &occluders[shadows->shadows.items[leaf].occluder]))
            return true;
    return false;
}

static sl_status put(sl_context *context, sl_shadows *shadows, uint32_t occluder, int32_t next,
                     int32_t *out) {
    SL_TRY(SL_ARRAY_ROOM(context, &shadows->shadows, 1));
    *out = (int32_t)shadows->shadows.count;
    shadows->shadows.items[shadows->shadows.count++] = (sl_shadow){occluder, next};
    return SL_OK;
}

sl_status sl_shadows_add(sl_context *context, sl_shadows *shadows, int32_t leaf, uint32_t occluder,
                         int32_t *out) {
    int32_t kept = -1;
    for (; leaf >= 0; leaf = shadows->shadows.items[leaf].next) {
        const uint32_t other = shadows->shadows.items[leaf].occluder;
        const sl_occluder *o = shadows->occluders.items;
        if (!sl_occluder_is_behind(&o[other], &o[occluder]))
            SL_TRY(put(context, shadows, other, kept, &kept));
    }
    return put(context, shadows, occluder, kept, out);
}

void sl_shadows_look(sl_shadows *shadows, int32_t leaf, const sl_shape *shape,
                     const sl_sector *sector, unsigned *bits) {
    unsigned before = SL_BEFORE;
    for (; leaf >= 0 && *bits != SL_LOOK_BOTH; leaf = shadows->shadows.items[leaf].next) {
        const uint32_t o = shadows->shadows.items[leaf].occluder;
        const unsigned about =
            sl_shape_about(&shadows->pivot, shape, sector, &shadows->occluders.items[o]);
        *bits |= about & SL_BEHIND;
        before &= about;
    }
    *bits |= before;
}

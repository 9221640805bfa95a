/// A baked file with doors shut: what is left to see, without a new bake.
#include "effects/filtered.h"
#include "sightline/bake.h"

#include "cell_to_cell/pvs_rows.h"
#include "sightline/support.h"

#include <string.h>

/// What a row keeps of its cells.
static sl_status keep_row(sl_context *context, const sl_pvs *pvs, const sl_door_sets *doors,
                          uint32_t row, const bool *shut, sl_bits *set, sli_row_bytes *out) {
    const uint32_t count = pvs->cell_count;
    memset(set, 0, sl_bits_words(count) * sizeof *set);
    sli_row_add_open_to(pvs, doors, row, shut, set);
    return sli_row_append(context, out, set, count);
}

/// What the visible sets keep, or the sets of what is seen by mirror.
static sl_status keep_rows(sl_context *context, const sl_pvs *pvs, const sl_door_sets *doors,
                           const bool *shut, sl_pvs *out, uint64_t *pairs) {
    const uint32_t count = pvs->cell_count;
    sli_row_bytes *rows = sl_alloc_array(context, count, sizeof *rows);
    sl_bits *set = sl_alloc_array(context, sl_bits_words(count), sizeof *set);
    sl_status status = rows && set ? SL_OK : SL_NO_MEMORY;
    for (uint32_t i = 0; i < count && status == SL_OK; i++)
        status = keep_row(context, pvs, doors, i, shut, set, &rows[i]);
    if (status == SL_OK) status = sli_pvs_join(context, rows, count, out);
    for (uint32_t i = 0; rows && i < count; i++) sl_free(context, rows[i].items);
    sl_free(context, rows);
    sl_free(context, set);
    *pairs = 0;
    for (uint32_t i = 0; i < count && status == SL_OK; i++) *pairs += sl_pvs_count(out, i);
    return status;
}

sl_status sl_baked_shut(sl_context *context, const sl_baked *baked, const bool *shut,
                        sl_space *space, sl_visibility *visibility) {
    const sli_filtered_space filtered = {.shut = shut};
    const sl_visibility *v = &baked->visibility;
    sl_visibility kept = {.sight = v->sight, .guarantee = v->guarantee, .account = v->account};
    SL_TRY(sli_filtered_space_make(context, &baked->space, &filtered, NULL, space));
    sl_status status = keep_rows(context, &v->pvs, &v->doors, shut, &kept.pvs, &kept.account.pairs);
    if (status == SL_OK && v->mirrored.cell_count)
        status = keep_rows(context, &v->mirrored, &v->mirrored_doors, shut, &kept.mirrored,
                           &kept.account.mirrored_pairs);
    if (status == SL_OK) {
        *visibility = kept;
        return SL_OK;
    }
    sl_space_destroy(context, space);
    sl_visibility_destroy(context, &kept);
    return status;
}

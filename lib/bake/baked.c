#include "sightline/bake.h"

#include "bake/slv.h"
#include "base/base.h"

#include <string.h>

bool sl_slv_is_name(const char name[16]) {
    static const char letters[] = "abcdefghijklmnopqrstuvwxyz0123456789-";
    size_t length = 0;
    while (length < 16 && name[length] && strchr(letters, name[length])) length++;
    const char zeros[16] = {0};
    return length < 16 && memcmp(name + length, zeros, 16 - length) == 0;
}

bool sl_baked_counts(const sl_baked *baked, uint32_t cell) {
    const sl_pvs *pvs = &baked->visibility.pvs;
    if (cell < pvs->cell_count && pvs->offsets[cell] == pvs->offsets[cell + 1]) return false;
    return !baked->map.start_count || baked->space.cells[cell].inside;
}

void sl_baked_destroy(sl_context *context, sl_baked *baked) {
    sl_map_destroy(context, &baked->map);
    sl_space_destroy(context, &baked->space);
    sl_visibility_destroy(context, &baked->visibility);
    *baked = (sl_baked){0};
}

/// Questions to baked maps and files: all else is the query's.
#include "sight/query.h"

#include "sightline/bake.h"
#include "sightline/support.h"

sl_status sl_query_create(sl_context *context, const sl_baked *baked, sl_query **out) {
    if (sl_baked_is_shard(baked))
        return sl_fail(context, SL_BAD_ARGUMENT,
                       "this is one shard of a bake, without visible sets: merge the shards first");
    return sl_query_over(context, &baked->space, &baked->map, &baked->visibility, out);
}

static void destroy_baked(sl_context *context, void *what) {
    sl_baked_destroy(context, what);
    sl_free(context, what);
}

sl_status sl_query_open(sl_context *context, const char *path, sl_query **out) {
    sl_baked *baked = sl_alloc_array(context, 1, sizeof *baked);
    if (!baked) return SL_NO_MEMORY;
    sl_status status = sl_baked_read(context, path, baked);
    if (status == SL_OK) status = sl_query_create(context, baked, out);
    if (status == SL_OK)
        sli_query_own(*out, (sli_query_owner){baked, destroy_baked});
    else
        destroy_baked(context, baked);
    return status;
}

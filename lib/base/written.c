/// Reading back what was written, before it takes the place of a file. A writer and a reader that
/// disagree are a fault of ours: it must not cost the user a file. What is read back is the
/// writer's choice: a map is read whole; of a baked file see slv_write.c.
#include "base/base.h"

#include <string.h>

bool sli_again_take(sli_again *again, void *buffer, size_t count) {
    if (count > again->left) return false;
    again->left -= count;
    if (again->stream) return fread(buffer, 1, count, again->stream) == count;
    if (count) memcpy(buffer, again->at, count);
    again->at += count;
    return true;
}

sl_status sli_read_back(sl_context *context, const char *path, const sli_to_write *file,
                        sli_again again) {
    char why[sizeof context->message];
    const sl_hooks hooks = context->hooks;
    context->hooks.note = NULL;
    context->hooks.progress = NULL;
    const sl_status status = file->read_back(context, file->user, path, &again);
    context->hooks = hooks;
    if (status != SL_BAD_INPUT && status != SL_BAD_ARGUMENT && status != SL_UNSUPPORTED)
        return status;
    memcpy(why, context->message, sizeof why);
    return sl_fail(context, SL_UNSUPPORTED,
                   "%s: not written, as it could not be read again: %.900s", path, why);
}

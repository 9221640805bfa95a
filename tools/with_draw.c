#include "built.h"

sl_status sl_built_need_pictures(sl_context *context) {
    (void)context;
    return SL_OK;
}

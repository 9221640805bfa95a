#include "built.h"

sl_status built_need_pictures(sl_context *context) {
    (void)context;
    return SL_OK;
}

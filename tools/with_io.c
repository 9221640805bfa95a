#include "built.h"

#include "sightline/io.h"

sl_status built_use_formats(sl_context *context) {
    return sl_io_use(context);
}

/// The context, as the library itself knows it.
#ifndef SL_BASE_H
#define SL_BASE_H

#include "sightline/support.h"

struct sl_context {
    sl_hooks hooks;
    char message[1024];
};

#endif

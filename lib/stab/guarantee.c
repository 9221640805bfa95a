#include "sightline/stab.h"

const char *sl_guarantee_name(sl_guarantee guarantee) {
    switch (guarantee) {
    case SL_EXACT:
        return "exact";
    case SL_CONSERVATIVE:
        return "conservative";
    case SL_AGGRESSIVE:
        return "aggressive";
    case SL_ROUNDED:
        return "rounded";
    }
    return "unknown";
}

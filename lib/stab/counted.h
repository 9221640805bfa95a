/// The exact predicate, its uses counted.
#ifndef SL_COUNTED_H
#define SL_COUNTED_H

#include "geometry/orient.h"
#include "sightline/stab.h"

static inline int sl_orient_counted(sl_stab_account *account, sl_point a, sl_point b, sl_point c) {
    account->orientations++;
    const int sign = sl_orient_filter(a, b, c);
    if (sign) return sign;
    account->exact++;
    return sl_orient_exact(a, b, c);
}

#endif

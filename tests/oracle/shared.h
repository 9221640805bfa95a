/// Small helpers of the oracles that prove graphs and tilings.
#ifndef SL_TESTS_ORACLE_SHARED_H
#define SL_TESTS_ORACLE_SHARED_H

#include "oracle/must.h"
#include "oracle/planar_graph.h"

#include <stdarg.h>
#include <stdio.h>

/// Describes a fault; returns false.
__attribute__((format(printf, 2, 3))) static inline bool fault(char *why, const char *format, ...) {
    va_list arguments;
    va_start(arguments, format);
    vsnprintf(why, ORACLE_WHY, format, arguments);
    va_end(arguments);
    return false;
}

static inline bool same(sl_point a, sl_point b) {
    return a.x == b.x && a.y == b.y;
}

/// Whether p comes before q: by x, then by y.
static inline bool is_before(sl_point p, sl_point q) {
    return p.x < q.x || (p.x == q.x && p.y < q.y);
}

#endif

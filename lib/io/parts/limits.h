/// Limits: how much a reader makes of a file at most. A short file may ask for any amount, by
/// packed data, by numbers that it only names, or by blocks that insert one another. A reader
/// knows the amount and holds it against its limit before it works.
#ifndef SL_LIMITS_H
#define SL_LIMITS_H

#include "sightline/context.h"

typedef enum sli_limit {
    SLI_LIMIT_SQUARES,
    SLI_LIMIT_PIXELS,
    SLI_LIMIT_WALLS,
    SLI_LIMIT_ENTITIES,
    SLI_LIMIT_DEPTH,
} sli_limit;

/// SL_BAD_INPUT where there are more than the context allows:
/// "FILE:LINE: WHAT: 484000000 squares, more than the limit of 134217728; --max-squares raises it".
/// `what` may be empty. UINT64_MAX stands for any number.
sl_status sli_limit_check(sl_context *context, const char *name, unsigned line, sli_limit which,
                          uint64_t found, const char *what);

/// Sums and products that stay at UINT64_MAX instead of beginning again at 0.
uint64_t sli_limit_sum(uint64_t a, uint64_t b);
uint64_t sli_limit_product(uint64_t a, uint64_t b); ///< likewise

#endif

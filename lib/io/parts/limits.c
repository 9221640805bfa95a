/// The one message for files that ask for too much.
#include "io/parts/limits.h"

#include "base/base.h"
#include "sightline/support.h"

#include <inttypes.h>

static const struct {
    const char *option, *unit;
    uint64_t usual;
} limits[] = {
    [SLI_LIMIT_SQUARES] = {"max-squares", "squares", (uint64_t)1 << 27},
    [SLI_LIMIT_PIXELS] = {"max-pixels", "pixels", (uint64_t)1 << 28},
    [SLI_LIMIT_WALLS] = {"max-walls", "walls", (uint64_t)1 << 24},
    [SLI_LIMIT_ENTITIES] = {"max-entities", "entities", (uint64_t)1 << 24},
    [SLI_LIMIT_DEPTH] = {"max-depth", "levels", 512},
};

/// That of the context, or the usual one.
static uint64_t limit_of(const sl_context *context, sli_limit which) {
    const sl_limits *given = &context->limits;
    const uint64_t values[] = {
        [SLI_LIMIT_SQUARES] = given->squares, [SLI_LIMIT_PIXELS] = given->pixels,
        [SLI_LIMIT_WALLS] = given->walls,     [SLI_LIMIT_ENTITIES] = given->entities,
        [SLI_LIMIT_DEPTH] = given->depth,
    };
    return values[which] ? values[which] : limits[which].usual;
}

sl_status sli_limit_check(sl_context *context, const char *name, unsigned line, sli_limit which,
                          uint64_t found, const char *what) {
    const uint64_t most = limit_of(context, which);
    char count[32] = "countless";
    if (found <= most) return SL_OK;
    if (found < UINT64_MAX) snprintf(count, sizeof count, "%" PRIu64, found);
    return sl_fail_at(context, name, line,
                      "%s%s%s %s, more than the limit of %" PRIu64 "; --%s raises it", what,
                      *what ? ": " : "", count, limits[which].unit, most, limits[which].option);
}

uint64_t sli_limit_sum(uint64_t a, uint64_t b) {
    return a > UINT64_MAX - b ? UINT64_MAX : a + b;
}

uint64_t sli_limit_product(uint64_t a, uint64_t b) {
    return b && a > UINT64_MAX / b ? UINT64_MAX : a * b;
}

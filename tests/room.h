/// A map of some statements, its space and a query, for tests that ask.
#ifndef SL_ROOM_H
#define SL_ROOM_H

#include "testing.h"

typedef struct room {
    sl_context *context;
    sl_map map;
    sl_space space;
    sl_query *query;
} room;

/// `memory` as for testing_context().
static inline void make_room(room *r, testing_memory *memory, const char *statements) {
    *r = (room){.context = testing_context(memory)};
    testing_space(r->context, statements, &r->map, &r->space);
    assert_ok(r->context, sl_query_over(r->context, &r->space, &r->map, NULL, &r->query));
}

static inline void end_map(room *r) {
    sl_query_destroy(r->context, r->query);
    sl_space_destroy(r->context, &r->space);
    sl_map_destroy(r->context, &r->map);
}

static inline void end_room(room *r) {
    end_map(r);
    sl_context_destroy(r->context);
}

static inline sl_point random_point(const sl_box *b, sl_random *random) {
    return (sl_point){b->min.x + sl_random_unit(random) * (b->max.x - b->min.x),
                      b->min.y + sl_random_unit(random) * (b->max.y - b->min.y)};
}

#endif

/// What is seen from a line or an area: how it is given, and its files.
#ifndef ISOVIST_SET_H
#define ISOVIST_SET_H

#include "sightline/bake.h"
#include "sightline/draw.h"
#include "sightline/set_sight.h"
#include "sightline/support.h"

/// How a set is given: one of these, or none.
typedef struct set_choice {
    const char *line;  ///< --from-line X,Y,X,Y,...
    const char *area;  ///< --from-area X,Y,X,Y,X,Y,... or X,Y,R
    const char *along; ///< --along PATH, or a table
} set_choice;

static inline int set_choices(const set_choice *c) {
    return (c->line != NULL) + (c->area != NULL) + (c->along != NULL);
}

/// What is seen. Zeroed, it is empty.
typedef struct isovist_set {
    sl_point *points;
    size_t count;
    sl_set_kind kind;
    sl_set_region regions[2]; ///< by sl_set_seen
} isovist_set;

/// Reads the set and finds both regions. `query` has the doors as they stand.
sl_status isovist_set_make(sl_context *context, const set_choice *choice, const sl_baked *baked,
                           sl_query *query, isovist_set *out);
void isovist_set_destroy(sl_context *context, isovist_set *set);

/// Writes the areas; "-" is stdout. A name that ends in .geojson: the regions as GeoJSON.
sl_status isovist_set_write(sl_context *context, const isovist_set *set, const sl_earth *earth,
                            const char *path);

/// "some point of it sees 52 m², all points see 20 m²"
void isovist_set_say(const isovist_set *set, const char *unit, char *text, size_t size);

#endif

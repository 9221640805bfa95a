/// The search for what is inside by entrances: shared by access.c, which finds how wide a disc gets
/// where, interior_parts.c, which finds the parts that are inside, and entrances.c.
#ifndef SL_ENTRANCES_H
#define SL_ENTRANCES_H

#include "sightline/map.h"
#include "sightline/support.h"
#include "space/channels.h"
#include "space/clearance.h"

#include "geometry/length.h"

#define SLI_NO_TRIANGLE UINT32_MAX

/// Openings up to so many times a width that is found, that of a narrow door, are doubtful.
#define SLI_DOUBT_FOUND 3.5
/// How much roomier than its opening a part or pocket is.
#define SLI_ROOMIER (4.0 / 3)

/// Triangles that belong together.
typedef struct sli_access_group {
    uint32_t first, count; ///< in `order`
    double access;         ///< the largest of its triangles
    double area, reached;  ///< `reached`: the length of walls around it
    sl_point place;        ///< far from walls
    double clearance;      ///< there
    bool inside;
} sli_access_group;

/// The points between which an opening is.
typedef struct sli_doubtful_opening {
    uint32_t from, to;
} sli_doubtful_opening;

typedef struct sli_entrances {
    sl_context *context;
    sl_map *map;
    double weld;
    sl_box bounds;
    sl_box border; ///< of the space: farther out where the map ends at a window
    double doubt;  ///< for SL_ENTRANCE_WIDE: openings up to this width are doubtful
    sli_channels channels;
    sli_clearance clearance;
    sli_wall_index walls; ///< of maps that say what is solid
    uint32_t *triangle;   ///< by half-edge; SLI_NO_TRIANGLE outside of the box
    uint32_t *half;       ///< by triangle: one of its half-edges
    uint32_t count;
    double *access; ///< by triangle
    double *closed; ///< by triangle: the least clearance that no place in it has, of those that
                    ///< were looked for; 0 for none
    uint32_t *parent, *following;
    uint32_t *group_of, *order;
    SL_ARRAY(sli_access_group) groups;
    SL_ARRAY(sli_doubtful_opening) openings; ///< the doubtful ones
    sl_interior found;
} sli_entrances;

static inline const sli_triangulation *sli_entrances_triangles(const sli_entrances *f) {
    return &f->channels.triangles;
}

static inline sl_point sli_entrances_start(const sli_entrances *f, uint32_t half) {
    return sli_entrances_triangles(f)
        ->points.items[sli_entrances_triangles(f)->halves.items[half].from];
}

static inline uint32_t sli_entrances_label(const sli_entrances *f, uint32_t half) {
    return f->channels.label[half / 2];
}

static inline double sli_entrances_length(const sli_entrances *f, uint32_t half) {
    const sl_point a = sli_entrances_start(f, half), b = sli_entrances_start(f, half ^ 1);
    return sli_length(b.x - a.x, b.y - a.y);
}

/// Whether the map says what is solid: then what walls enclose is inside, however narrow.
static inline bool sli_entrances_say_ground(const sl_map *map) {
    bool any = false;
    for (size_t i = 0; i < map->wall_count; i++) any |= map->walls[i].ground != 0;
    return any;
}

// --- access

/// Numbers the triangles of the channels, and makes room for what is known of each.
sl_status sli_access_number(sli_entrances *f);
/// Finds the access of each triangle.
sl_status sli_access_find(sli_entrances *f);

/// Which triangles make groups: those of an access from `least` to `most`; of one access, or of
/// any.
typedef struct sli_access_choice {
    double least, most;
    bool same;
} sli_access_choice;

/// Makes the groups that a choice tells of.
sl_status sli_access_gather(sli_entrances *f, sli_access_choice c);
/// Whether a disc fits in a group.
sl_status sli_access_fits(sli_entrances *f, sli_access_group *g, double width, bool *out);

// --- parts

/// How wide doubtful openings are.
double sli_parts_doubtful_up_to(const sli_entrances *f, double width);
/// Makes the parts of a width, and says which are inside.
sl_status sli_parts_choose(sli_entrances *f, double width);
/// Finds halls: what all ways out of a part lead to, with an opening somewhat wider than the width.
/// A corridor with an open end is one, though it is no wider than its opening. 1 in `halls`, by
/// triangle.
sl_status sli_parts_find_halls(sli_entrances *f, double width, uint8_t *halls);
/// Looks for halls, and for pockets with an opening somewhat wider than the width. `marks` gets all
/// that is about them.
sl_status sli_parts_find_doubts(sli_entrances *f, double width, const uint8_t *halls,
                                uint8_t *marks);
/// A building is inside as a whole or not at all: parts do not count that a doubtful pocket leads
/// to, or that belong to a building with a doubtful opening or with such a part.
sl_status sli_parts_drop_doubtful(sli_entrances *f, const uint8_t *marks);

// --- the width

/// Tries one way to know the width, up to `most` (what is doubtful, by SL_ENTRANCE_WIDE). *found:
/// there is an answer, and the map has it.
sl_status sli_entrances_try(sl_context *context, sl_map *map, sl_entrance by, double width,
                            double most, bool *found);
/// Forgets what was found before.
void sli_entrances_forget(sl_context *context, sl_map *map);
/// Whether about as much of the map's box is inside with openings up to a width and up to twice as
/// wide ones, if nothing is doubtful; and no less than with the narrow width. It must be a
/// building.
sl_status sli_entrances_are_steady(sl_context *context, sl_map *map, double narrow, double width,
                                   bool *steady);
/// Where an opening is in doubt in a plan that is drawn: takes a wider one as an entrance, if that
/// leaves no doubt.
sl_status sli_entrances_widen(sl_context *context, sl_map *map);

#endif

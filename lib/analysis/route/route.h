/// What the finder of ways keeps, and the parts of its work.
#ifndef SL_ROUTE_H
#define SL_ROUTE_H

#include "base/heap.h"
#include "sightline/path.h"
#include "sightline/support.h"
#include "space/index.h"

/// No corner, no node, no directed portal.
#define SLI_ROUTE_NONE UINT32_MAX

/// Sides of a directed portal.
enum { SLI_ROUTE_RIGHT, SLI_ROUTE_LEFT };

/// A limit of the directions that a node's root looks in: none, the ray from the root through
/// `point`, or the ray that goes on from `point` through the root.
typedef enum sli_route_limit_kind { SLI_LIMIT_NONE, SLI_LIMIT_RAY, SLI_LIMIT_ON } sli_limit_kind;

typedef struct sli_route_limit {
    sli_limit_kind kind;
    sl_point point;
} sli_route_limit;

/// A node of the search: a way to `root` of length g, and the directions from there that enter
/// `cell` through the directed portal `entry`. A last node (`is_last`) leads from its root straight
/// to the goal.
typedef struct sli_route_node {
    sl_point root;
    sli_route_limit limit[2]; ///< right and left
    double g;
    double near;     ///< how far the nearest point is that it passes of its entry
    uint32_t parent; ///< a node; SLI_ROUTE_NONE for the first ones
    uint32_t entry;  ///< SLI_ROUTE_NONE for the cells at the start
    uint32_t cell;
    bool cuts[2];   ///< by limit: an end of the entry is beyond it
    bool is_behind; ///< the root lies strictly behind the entry
    bool is_last;
} sli_route_node;

/// What is known of a corner in one search: the shortest way to it, and by turn the point before
/// it from which the most directions can be turned to, the nearest of those in line.
typedef struct sli_route_corner {
    uint32_t stamp;   ///< of the search that the rest belongs to
    uint32_t node[2]; ///< that turns there; SLI_ROUTE_NONE: none
    double g;
    sl_point before[2];
} sli_route_corner;

/// The last turn at one end of a directed portal.
typedef struct sli_route_turn {
    uint32_t stamp, node;
    double g;
    sl_point before;
} sli_route_turn;

/// What is known of a cell in one search.
typedef struct sli_route_cell {
    uint32_t stamp; ///< of the search that the rest belongs to
    double least;   ///< how far the nearest place is that is known
    double most;    ///< no point of the cell is farther
} sli_route_cell;

typedef struct sli_route_open {
    double f;
    uint32_t node;
} sli_route_open;

static inline bool sli_route_is_before(const sli_route_open *a, const sli_route_open *b) {
    return a->f != b->f ? a->f < b->f : a->node < b->node;
}
SLI_HEAP(sli_route_heap, sli_route_open, sli_route_is_before)

/// Blocks of cells that single cells join (blocks.c). All NULL in a space with one-way glass.
typedef struct sli_route_blocks {
    uint32_t *of;    ///< by portal
    uint32_t *above; ///< by cell: the block above it; SLI_ROUTE_NONE for the first cell of a part
    uint32_t *depth; ///< by cell: the number of blocks above it
    uint32_t *top;   ///< by block: the cell above it
    uint32_t *stamp; ///< by block: the search in which it is open
} sli_route_blocks;

struct sl_route_finder {
    sl_query *query;
    const sl_space *space;
    uint32_t *corner_of; ///< by directed portal and side: the corner there, SLI_ROUTE_NONE where
                         ///< nothing is to turn around
    uint32_t *part_of;   ///< by cell: the part of the space that portals join it with
    uint32_t *ends;      ///< by end of a portal: for union-find. Where passing a portal has a loss,
                         ///< its ends are two: those of its second directed portal follow all
    uint32_t *counts;    ///< by end of a portal, likewise
    double *by_door;     ///< the loss by door of the map; NULL: none
    size_t door_count;
    double *losses;               ///< by portal; NULL: none
    bool has_glass;               ///< some portal is crossed one way only
    double radius;                ///< of the walker
    sl_space room;                ///< where its middle may be, for a radius above 0: `space`
    bool has_all;                 ///< in the room all walls are grown
    size_t grown;                 ///< walls grown for single ways
    sl_route_finder *point;       ///< for a radius above 0: of the ways of a point
    sli_box_tree walls;           ///< boxes of the walls that it must stay away from
    sli_route_cell *cells;        ///< by cell
    sli_route_corner *corners;    ///< by corner: the end of a portal that stands for it
    sli_route_turn *turns;        ///< by directed portal and side
    uint32_t *at_start, *at_goal; ///< by cell: the search in which it is there
    uint32_t *list;               ///< cells, for walks
    sli_route_blocks blocks;
    uint32_t stamp;
    SL_ARRAY(sli_route_node) nodes;
    sli_route_heap open;
};

/// Finds the corners and the parts of the finder's space.
sl_status sli_route_corners(sl_context *context, sl_route_finder *finder);

/// Finds the blocks of the finder's space; frees them.
sl_status sli_route_find_blocks(sl_context *context, sl_route_finder *finder);
void sli_route_drop_blocks(sl_context *context, sli_route_blocks *blocks);

/// Opens the blocks that lie between two cells of one part for this search.
void sli_route_open_blocks(sl_route_finder *finder, uint32_t from, uint32_t to);

/// Whether a portal is in an open block.
static inline bool sli_route_is_open(const sl_route_finder *finder, uint32_t portal) {
    const sli_route_blocks *b = &finder->blocks;
    return !b->of || b->stamp[b->of[portal]] == finder->stamp;
}

/// The cells that a point stands in (view.h): marks them, lists them, and returns their number.
uint32_t sli_route_stand(sl_route_finder *finder, sl_point point, uint32_t first, uint32_t *marks);

/// A place that can be reached from the cells marked as the start, next to the one that is nearest
/// to `to`.
sl_point sli_route_nearest(sl_route_finder *finder, sl_point to);

/// Searches from the cells that are marked. *out is the last node of the shortest way;
/// SLI_ROUTE_NONE for none. Of ways of the same length it is the one whose last corner comes first
/// around the goal (sli_compare_around).
sl_status sli_route_search(sl_context *context, sl_route_finder *finder, sl_point from, sl_point to,
                           uint64_t *expanded, uint32_t *out);

/// Of the nodes that turn at the same corner by ways of the same length, the one that comes to it
/// from the point that is first around it; for a node that does not turn, itself.
uint32_t sli_route_turning(const sl_route_finder *finder, uint32_t node);

/// Takes a node that goes on straight into its cell.
typedef sl_status (*sli_route_take)(sl_context *context, const sli_route_node *node, void *user);

/// How far each cell is from a point, up to a limit (sl_route_distances). `take`, which may be
/// NULL, is called for all nodes that bring something to their cells.
sl_status sli_route_spread(sl_context *context, sl_route_finder *finder, sl_point from,
                           double limit, sl_route_near *cells, sli_route_take take, void *user);

/// The side of a node's limit that a point lies on is out of its directions, strictly.
bool sli_route_is_beyond(const sli_route_node *node, int side, sl_point p);

/// A new search: no mark of an earlier one counts.
void sli_route_begin(sl_route_finder *finder);

/// The cell that a point stands in, if it can be walked in.
sl_status sli_route_stand_in(sl_context *context, const sl_route_finder *finder, const char *name,
                             sl_point at, uint32_t *cell);

/// A limit of distances that no cell misses by the rounding of its distance. Fails for no limit.
sl_status sli_route_widen(sl_context *context, const sl_space *space, double limit, double *out);

/// A part of a space: some of its cells, and walls, all near those cells among them.
typedef struct sli_route_part {
    bool *has_cell, *has_wall;
    uint32_t wall_count; ///< of has_wall
} sli_route_part;

/// The cells between the walls of a space, grown by a radius above 0; `out` must be empty. With a
/// part (NULL: all), only its walls are grown, and portals that lead out of its cells are walls.
sl_status sli_route_grow(sl_context *context, const sl_space *space, double radius,
                         const sli_route_part *part, sl_space *out);

/// Makes the room of a walker with a radius, of all walls or those of a part, and its tables.
sl_status sli_route_make_room(sl_context *context, sl_route_finder *finder,
                              const sli_route_part *part);

/// The shortest way in the finder's space, between places in it. No way: route->nearest is not set.
sl_status sli_route_find_here(sl_context *context, sl_route_finder *finder, sl_point from,
                              sl_point to, sl_route *route);

/// The shortest way of a walker with a radius above 0. If there is none, all walls are grown.
sl_status sli_route_find_wide(sl_context *context, sl_route_finder *finder, sl_point from,
                              sl_point to, sl_route *route);

/// The boxes of a space's walls, for sli_route_check_room(). `out` must be empty.
sl_status sli_route_index_walls(sl_context *context, const sl_space *space, sli_box_tree *out);

/// How far from the walls of a space a walker with a radius has room: its grown walls end nearer.
double sli_route_needed(const sl_space *space, double radius);

/// Fails where a place is too near to a wall of the space for a walker with a radius. `walls` is of
/// sli_route_index_walls().
sl_status sli_route_check_room(sl_context *context, const sl_space *space,
                               const sli_box_tree *walls, double radius, const char *name,
                               sl_point at);

/// What passing a portal costs beside its length.
static inline double sli_route_loss(const sl_route_finder *finder, uint32_t portal) {
    return finder->losses ? finder->losses[portal] : 0;
}

#endif

/// Sight for checks of placements: other code than regions and looks, and exact. All is
/// decided by the sides of places against lines through pairs of given points.
///
/// An eye sorts the corners of all walls around it. No wall ends within a cone between two
/// neighbours, so the walls that cross the cone are in one order, and the nearest one ends sight:
///
///       \  wall of the cone  /
///     ray i+1 ---------- ray i        A place in the cone is seen if it is not beyond the wall.
///          \            /             On a ray itself sight is closed: it ends at a wall that
///           \   cone   /              crosses the ray, or at a corner with walls on both sides.
///            \        /
///               eye
#ifndef SLI_PROOF_SIGHT_H
#define SLI_PROOF_SIGHT_H

#include "sightline/space.h"
#include "sightline/support.h"
#include "space/index.h"

/// A place: a given point, or where the lines of two segments meet, which are not parallel.
typedef struct sli_meet {
    sl_segment s, t;
    bool given;   ///< the point is `at` itself
    sl_point at;  ///< rounded
    double error; ///< at most, of each coordinate of `at`
} sli_meet;

sli_meet sli_meet_point(sl_point at);
sli_meet sli_meet_lines(sl_segment s, sl_segment t);
/// The side of the line from a to b, as sli_orient. Exact.
int sli_meet_side(const sli_meet *p, sl_point a, sl_point b);
void sli_box_widen(sl_box *box, const sli_meet *p);

/// The end of a wall, and the walls that end there: other ends, sorted around it.
typedef struct sli_corner {
    sl_point at;
    uint32_t first, count; ///< in sli_proof_scene.others
} sli_corner;

/// The walls of a space, and four around all of it.
typedef struct sli_proof_scene {
    const sl_space *space;
    sl_box bounds; ///< of the four
    sl_segment *walls;
    uint32_t *ends; ///< by wall, twice: the corners
    sli_corner *corners;
    sl_point *others;
    uint32_t *other_walls; ///< by other end: the wall between
    uint32_t wall_count, corner_count;
    uint32_t around;   ///< the first of the four walls around
    sli_box_tree tree; ///< of the walls
} sli_proof_scene;

/// `map`: whose doors the space has.
sl_status sli_proof_scene_make(sl_context *context, const sl_space *space, const sl_map *map,
                               sli_proof_scene *out);
void sli_proof_scene_destroy(sl_context *context, sli_proof_scene *scene);

enum { SLI_NO_WALL = -1, SLI_SHUT = -2 };

/// A direction of an eye, and the cone that follows counter-clockwise.
typedef struct sli_proof_ray {
    sl_point to;
    int32_t cone; ///< the wall that ends sight in the cone; SLI_SHUT: the eye is behind a wall
    int32_t end;  ///< a wall whose line ends sight on the ray itself, or SLI_NO_WALL
    bool window;  ///< a border of what is seen may run on the ray, beyond `to`
} sli_proof_ray;

typedef struct sli_eye {
    sl_point at, north;       ///< and a point north of it
    uint32_t ray_count, west; ///< the first ray of the lower half
    sli_proof_ray *rays;      ///< counter-clockwise, from east
} sli_eye;

/// An eye on a wall stands in the cell that sl_space_locate gives. *on_wall: it does stand on one.
sl_status sli_eye_make(sl_context *context, const sli_proof_scene *scene, sl_point at, sli_eye *out,
                       bool *on_wall);
void sli_eye_destroy(sl_context *context, sli_eye *eye);
/// Holds all that an eye sees within the bounds.
sl_box sli_box_of_eye(const sli_proof_scene *scene, const sli_eye *eye);

/// Where a place is as the eye sees it.
typedef struct sli_bearing {
    uint32_t ray; ///< its cone holds the place
    bool on;      ///< the place is on the ray
    bool here;    ///< the place is the eye itself
} sli_bearing;

sli_bearing sli_eye_bearing(const sli_eye *eye, const sli_meet *p);
/// Whether the eye sees a place with closed sight, from some side of it. Exact.
bool sli_eye_sees(const sli_proof_scene *scene, const sli_eye *eye, const sli_meet *p);
/// The side of a wall's line on which a place is: 1 where the eye is, -1 beyond, 0 on it.
int sli_eye_side(const sli_proof_scene *scene, const sli_eye *eye, int32_t wall, const sli_meet *p);

#endif

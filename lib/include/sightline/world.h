/// Worlds: walls that change while they are asked. An edit costs what it touches, and no bake.
///
///     sl_world *world;
///     sl_world_create(context, &map, NULL, &world);
///     sl_world_add_wall(context, world, (sl_segment){{3, 0}, {3, 4}}, &wall);
///     sl_world_remove(context, world, 17);
///     sl_world_commit(context, world, NULL);
///     sl_query_sees(context, sl_world_query(world), eye, point, &sees);
///
/// A world holds the walls as they were given, and a mesh of convex cells that lives. A commit cuts
/// the mesh again around the walls that changed: the triangles there, then the cells that lost a
/// triangle. All other cells keep their numbers. A commit takes all edits since the last one, or
/// none of them: if it fails, the world is as it was. Undo is an edit.
///
/// Questions go through sl_query alone. Answers are those of a space that is made anew from the
/// walls as they are now (the subdivision "mesh"), exactly, and right after the commit. Two things
/// depend on what was edited before: how the plane is cut into cells, and their numbers. So compare
/// points, not cells. And an eye that is within a wall, or where walls meet, sees the side of its
/// cell (view.h), which their numbers decide, and what is inside (sl_world_mark_inside).
///
/// Nothing is welded: where walls of a file meet but for rounding, clean the map first
/// (sl_map_clean), or slits stay that a bake closes.
///
/// Where walls cross or touch they are cut, as by the mesh. Each wall keeps the place that it was
/// given: when another one goes, it is as if that had never been there. Places where oblique walls
/// cross are rounded to the nearest doubles, as in a clean map.
///
/// Doors, one-way glass, mirrors and walls that do not stop sight are walls of other kinds, with
/// numbers of the same row. A shut door is a wall, an open one is not there for sight, nor is a
/// wall that neither stops nor limits it; these do not cut cells. The query knows nothing of doors:
/// they open by edits.
///
/// A mirror is a wall, too. Regions and looks by mirror are those of the query
/// (sl_query_mirrored_region, sl_query_look_mirrored); the first after a commit takes time that
/// grows with the world. Where there are mirrors or limited walls, so does the first look.
///
/// Numbers have gaps. In the space that is asked (sl_query_asked), a number without a cell has no
/// corners, one without a portal has SL_NO_CELL for its cells, and one without a wall has no
/// length. The query's map has no walls: sl_world_copy_map has them.
///
/// One thread at a time uses a world and its query.
#ifndef SIGHTLINE_WORLD_H
#define SIGHTLINE_WORLD_H

#include "sightline/query.h"

#ifdef __cplusplus
extern "C" {
#endif

/// Walls, their cells, and a query to them.
typedef struct sl_world sl_world;

/// Which visible sets a world keeps.
typedef enum sl_world_rows {
    SL_WORLD_NO_ROWS,    ///< none: sl_query_look searches without them
    SL_WORLD_ROWS_NOW,   ///< exact after each commit
    SL_WORLD_ROWS_LATER, ///< after each commit they miss nothing (SL_CONSERVATIVE);
                         ///< sl_world_settle makes them exact
} sl_world_rows;

/// Start from sl_world_options_default().
typedef struct sl_world_options {
    sl_world_rows rows;
    sl_sight sight; ///< of the visible sets
    /// Walls must lie within this box, not on its border. An empty box: the bounds of the map, and
    /// an eighth of their size more on each side.
    sl_box bounds;
} sl_world_options;

/// The usual options: bounds by the map, no visible sets, closed sight.
SL_API sl_world_options sl_world_options_default(void);

/// What a wall of a world is.
typedef enum sl_world_kind {
    SL_WORLD_WALL,
    SL_WORLD_DOOR,   ///< a wall that opens
    SL_WORLD_ONEWAY, ///< one-way glass
    SL_WORLD_SEAM,   ///< a wall that does not stop sight, or a seam of the map
    SL_WORLD_MIRROR,
} sl_world_kind;

/// Makes a world of the walls of a map, which is copied. Wall i of the map is wall i of the world;
/// then come its doors, its one-way glass, its seams and its mirrors. In a clean map a wall lies
/// beneath each mirror, and stays when the mirror goes. `options`: NULL for the usual ones.
/// SL_UNSUPPORTED for a map with cells of its own, which a world would cut anew; SL_BAD_INPUT for a
/// wall outside the bounds, and as the mesh refuses a map that is not clean. Time: that of the
/// mesh.
SL_API sl_status sl_world_create(sl_context *context, const sl_map *map,
                                 const sl_world_options *options, sl_world **out);
/// Frees a world and its query. NULL is allowed.
SL_API void sl_world_destroy(sl_context *context, sl_world *world);

/// The query to the world. It belongs to the world, and its settings stay after a commit. What it
/// gave before (spaces, outlines) is void then. Boxes that block are SL_UNSUPPORTED where they need
/// cut cells (sl_query_set_boxes): sl_query_region and sl_query_sees take them. So are
/// sl_query_copy and sl_query_copy_space.
SL_API sl_query *sl_world_query(sl_world *world);

// --- edits

/// Adds a wall at the next commit. *wall is its number, from then on until it is removed; numbers
/// of removed walls are given again. Walls may cross, touch and cover each other. SL_BAD_ARGUMENT
/// for a wall of no length, or not within the bounds.
SL_API sl_status sl_world_add_wall(sl_context *context, sl_world *world, sl_segment at,
                                   uint32_t *wall);
/// Adds a door. As sl_world_add_wall. Doors of one name are no more than neighbours here: each
/// opens by itself.
SL_API sl_status sl_world_add_door(sl_context *context, sl_world *world, const char *name,
                                   sl_segment at, bool open, uint32_t *wall);
/// Adds one-way glass, seen through from its right to its left. As sl_world_add_wall. Where there
/// is some, the first question after a commit takes time that grows with the world.
SL_API sl_status sl_world_add_oneway(sl_context *context, sl_world *world, sl_segment at,
                                     uint32_t *wall);
/// Adds a mirror, which reflects on its left alone, going from a to b, or on both sides. As
/// sl_world_add_wall.
SL_API sl_status sl_world_add_mirror(sl_context *context, sl_world *world, sl_segment at,
                                     bool one_sided, uint32_t *wall);
/// Adds a wall that stops only what the bits of SL_STOPS_SIGHT ... say, and nothing for 0. As
/// sl_world_add_wall; SL_BAD_ARGUMENT for SL_STOPS_SIGHT with SL_STOPS_LIMITED.
SL_API sl_status sl_world_add_partial(sl_context *context, sl_world *world, sl_segment at,
                                      uint32_t stops, uint32_t *wall);
/// Adds a polygon of solid ground: its walls, which get the numbers walls[0 .. count). It goes when
/// these are removed. As sl_map_add_solid and sl_world_add_wall; corners that repeat the one before
/// are SL_BAD_ARGUMENT.
SL_API sl_status sl_world_add_solid(sl_context *context, sl_world *world, const sl_point *corners,
                                    size_t count, uint32_t *walls);
/// Opens or shuts a door at the next commit. SL_BAD_ARGUMENT for what is no door.
SL_API sl_status sl_world_set_open(sl_context *context, sl_world *world, uint32_t wall, bool open);
/// Removes a wall at the next commit. SL_BAD_ARGUMENT if there is none of that number.
SL_API sl_status sl_world_remove(sl_context *context, sl_world *world, uint32_t wall);
/// Moves a wall at the next commit; it keeps its number. As the two above.
SL_API sl_status sl_world_move(sl_context *context, sl_world *world, uint32_t wall, sl_segment at);
/// Forgets the edits since the last commit.
SL_API void sl_world_discard(sl_world *world);

/// What a commit did to the cells. The lists are valid until the next commit. A number may be in
/// `gone` and `came`: it then stands for another cell.
typedef struct sl_world_changes {
    const uint32_t *gone, *came;
    size_t gone_count, came_count;
    const uint32_t *rows; ///< cells whose visible sets may have changed, those that came among them
    size_t row_count;
} sl_world_changes;

/// Makes the edits. `changes` may be NULL. If it fails, the edits are forgotten and the world is as
/// it was: SL_NO_MEMORY; SL_UNSUPPORTED where walls run along each other within steps of doubles
/// and bend each other without end. Time: that of the cells around the walls that changed, whatever
/// the size of the world.
SL_API sl_status sl_world_commit(sl_context *context, sl_world *world, sl_world_changes *changes);

// --- visible sets

/// Makes visible sets exact, for about so many milliseconds, at least one set. *left: how many are
/// still conservative; NULL for none. An exact one is made by a search over portal sequences from
/// its cell. A commit searches again from the cells that saw a cell that went, and from those that
/// came: no other set can change. If it takes walls away and does nothing else, it follows from the
/// former only lines through these walls. If a commit lacks memory for its sets alone, it holds,
/// and there are none (sl_world_visibility) until this makes them; questions are answered as
/// before.
SL_API sl_status sl_world_settle(sl_context *context, sl_world *world, double milliseconds,
                                 size_t *left);

/// The visible sets, by cell of the world, also as the query has them; without rows where there are
/// none. `guarantee` says whether they are exact now: as those of a bake they take limited walls as
/// open, and are SL_CONSERVATIVE while there are some. They know nothing of mirrors. Valid until
/// the next commit.
SL_API const sl_visibility *sl_world_visibility(const sl_world *world);

// --- what there is

/// One more than the highest number of a wall.
SL_API uint32_t sl_world_wall_count(const sl_world *world);
/// A wall as it was given, at the last commit. False if there is none of that number.
SL_API bool sl_world_wall(const sl_world *world, uint32_t wall, sl_segment *at);
/// What a wall is, as sl_world_wall finds it.
SL_API sl_world_kind sl_world_kind_of(const sl_world *world, uint32_t wall);
/// Whether a door is open, at the last commit; false for what is none.
SL_API bool sl_world_is_open(const sl_world *world, uint32_t wall);
/// The wall that a mirror of the query's map is (sl_mirror_part.mirror; sl_query_map), or is a
/// piece of, as of the last commit: rounding may have bent it where others cross it. UINT32_MAX if
/// there is none of that number.
SL_API uint32_t sl_world_mirror_wall(const sl_world *world, uint32_t mirror);
/// How many cells there are.
SL_API uint32_t sl_world_cell_count(const sl_world *world);

/// The walls as they were given, at the last commit, as a map of its own: for files, bakes and
/// other work. `numbers`, NULL for none: by wall of the world, its number among the map's walls,
/// doors, one-way glass, seams or mirrors; UINT32_MAX for none.
SL_API sl_status sl_world_copy_map(sl_context *context, const sl_world *world, uint32_t *numbers,
                                   sl_map *out);
/// The space as it is, as a copy without gaps in its numbers; it passes sl_space_check. Shut doors
/// are walls of it. `numbers`,
/// NULL for none: by cell of the world (sl_query_asked), its number in the copy; SL_NO_CELL for
/// none.
SL_API sl_status sl_world_copy_space(sl_context *context, const sl_world *world, uint32_t *numbers,
                                     sl_space *out);

/// Marks which cells are inside and which are solid ground (sl_space), as in a copy of the space.
/// An eye on a wall with the inside on one side alone then stands there, as in a bake. Before, all
/// cells count as inside. A new cell has the mark of those that went where these have the same one,
/// else it counts as inside: mark again after edits that open or close the outline. Starts of the
/// map do not count here. Fails as sl_world_copy_space, and leaves the marks then. Time: that of
/// the copy, which grows with the world.
SL_API sl_status sl_world_mark_inside(sl_context *context, sl_world *world);

#ifdef __cplusplus
}
#endif

#endif
